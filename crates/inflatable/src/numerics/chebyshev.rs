//! Chebyshev series on [0, 1]: interpolation of a smooth function with an error estimate.

use std::f64::consts::PI;

/// A polynomial that interpolates a function at `N` Chebyshev points of [0, 1].
#[derive(Clone, Debug, PartialEq)]
pub struct Chebyshev {
    coefficients: Vec<f64>,
}

impl Chebyshev {
    /// The `count` interpolation points, within (0, 1), falling.
    pub fn points(count: usize) -> Vec<f64> {
        (0..count).map(|i| 0.5 + 0.5 * libm::cos(Self::angle(i, count))).collect()
    }

    /// The interpolant of `values` taken at [`Chebyshev::points`].
    pub fn interpolating(values: &[f64]) -> Self {
        let count = values.len();
        #[expect(clippy::cast_precision_loss, reason = "series have a few dozen terms")]
        let coefficient = |k: usize| {
            let sum: f64 = (0..count).map(|i| values[i] * libm::cos(k as f64 * Self::angle(i, count))).sum();
            sum * if k == 0 { 1.0 } else { 2.0 } / count as f64
        };
        Self { coefficients: (0..count).map(coefficient).collect() }
    }

    #[expect(clippy::cast_precision_loss, reason = "series have a few dozen terms")]
    fn angle(i: usize, count: usize) -> f64 {
        PI * (i as f64 + 0.5) / count as f64
    }

    /// The coefficients of T_0, T_1, ..., in 2 x - 1.
    pub fn coefficients(&self) -> &[f64] {
        &self.coefficients
    }

    /// The value at `x` in [0, 1].
    pub fn value(&self, x: f64) -> f64 {
        let twice = 2.0 * (2.0 * x - 1.0);
        let (mut first, mut second) = (0.0, 0.0);
        for &c in self.coefficients.iter().skip(1).rev() {
            (first, second) = (c + twice * first - second, first);
        }
        self.coefficients.first().copied().unwrap_or(0.0) + 0.5 * twice * first - second
    }

    /// Estimate of the largest error: the sum of the last four coefficients' sizes.
    ///
    /// For an analytic function the coefficients fall geometrically, so the truncated part is about as large.
    pub fn error(&self) -> f64 {
        self.coefficients.iter().rev().take(4).map(|c| c.abs()).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interpolates_within_its_own_estimate() {
        let f = |x: f64| (3.0 * x).sin() / (1.5 + x);
        for count in [8, 12, 16] {
            let values: Vec<f64> = Chebyshev::points(count).into_iter().map(f).collect();
            let series = Chebyshev::interpolating(&values);
            let worst = (0..=200).map(f64::from).map(|i| (series.value(i / 200.0) - f(i / 200.0)).abs());
            let worst = worst.fold(0.0, f64::max);
            assert!(worst <= series.error() + 1e-15, "{count}: {worst} {}", series.error());
            assert!(worst > 0.0);
        }
    }

    #[test]
    fn an_empty_series_is_zero() {
        assert_eq!(Chebyshev::interpolating(&[]).value(0.5), 0.0);
    }
}
