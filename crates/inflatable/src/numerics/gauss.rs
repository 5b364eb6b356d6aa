//! Gauss-Legendre quadrature on [0, 1].

/// Nodes and weights on [0, 1] of the rule with `N` points, exact for polynomials of degree 2 N - 1.
///
/// For an integrand that is analytic within an ellipse around the interval (sum of half-axes `rho`
/// times the half interval) the error falls like `rho^(-2 N)`.
pub fn gauss_legendre<const N: usize>() -> [(f64, f64); N] {
    let mut rule = [(0.5, 1.0); N];
    #[expect(clippy::cast_precision_loss, reason = "rules have a few dozen points")]
    let count = N as f64;
    for (i, node) in rule.iter_mut().enumerate() {
        #[expect(clippy::cast_precision_loss, reason = "rules have a few dozen points")]
        let guess = libm::cos(std::f64::consts::PI * (i as f64 + 0.75) / (count + 0.5));
        // Newton on the Legendre polynomial; the guess is within O(N^-3), so five steps are at rounding.
        let mut x = guess;
        for _ in 0..5 {
            let (value, slope) = legendre(N, x);
            x -= value / slope;
        }
        let (_, slope) = legendre(N, x);
        *node = (0.5 * (1.0 - x), 1.0 / ((1.0 - x * x) * slope * slope));
    }
    rule
}

/// The Legendre polynomial of degree `n` and its derivative at `x` in (-1, 1).
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut value) = (1.0, x);
    for k in 2..=n {
        #[expect(clippy::cast_precision_loss, reason = "rules have a few dozen points")]
        let k = k as f64;
        (previous, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * previous) / k);
    }
    #[expect(clippy::cast_precision_loss, reason = "rules have a few dozen points")]
    let slope = n as f64 * (x * value - previous) / (x * x - 1.0);
    (value, slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrates_polynomials_up_to_its_degree() {
        let rule = gauss_legendre::<8>();
        for degree in 0..16 {
            let sum: f64 = rule.iter().map(|(x, w)| w * x.powi(degree)).sum();
            assert!((sum - 1.0 / f64::from(degree + 1)).abs() < 1e-15, "degree {degree}");
        }
        let sixteenth: f64 = rule.iter().map(|(x, w)| w * x.powi(16)).sum();
        assert!((sixteenth - 1.0 / 17.0).abs() > 1e-12, "the test must be able to fail");
    }

    #[test]
    fn nodes_rise_and_mirror() {
        let rule = gauss_legendre::<24>();
        for (i, &(x, w)) in rule.iter().enumerate() {
            assert!(x > 0.0 && x < 1.0 && w > 0.0);
            assert!((x + rule[23 - i].0 - 1.0).abs() < 1e-15);
            assert!(i == 0 || x > rule[i - 1].0);
        }
    }
}
