//! The ring for R* -> infinity: a straight tube that is bent.
//!
//! The section becomes half a circle of radius 1/pi (per W), on which `lambda r = s` is first reached
//! where `theta = tan(theta / 2)`, with `theta` the angle from the inner edge. The volume's
//! leading term `R* / pi` does not depend on lambda below `lambda_c`, and falls with `R* G''` beyond, so the
//! target moves onto the onset like 1/R*.

use std::f64::consts::FRAC_1_PI;

/// Limits of the ring for R* -> infinity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RingLimit {
    /// Limit of both lambda_t and lambda_c: `x0 / (1 - cos x0)` with `x0 = tan(x0 / 2)`.
    pub lambda: f64,
    /// Limit of `V_bar''(lambda_t) / R*`.
    pub curvature_per_r_star: f64,
    /// Limit of the seal load k: a straight tube's 1/pi.
    pub seal_load: f64,
    /// Limit of the inflated width r(1): 2/pi.
    pub width: f64,
}

/// The limits, from closed forms and one root.
///
/// The curvature follows from the plane problem, the largest area under `lambda r <= s`. A short cone of
/// length `L` at the contact point `r_c = x0 / (pi lambda)` turns the start of the first arc by
/// `pi L / sin(gamma)` (closing), which lifts the contact point's s by `L / sin(gamma)`, so `u = 0`
/// there gives `dL/dlambda = r_c sin(gamma)`; with the hoop tension `h = R* / (lambda sin(gamma))`,
/// `V_bar' = -2 h r_c L` has the slope `-2 R* r_c^2 / lambda`.
pub fn limit() -> RingLimit {
    // Newton on tan(x/2) - x: the root is simple, and 2.33 is within 2e-3 of it.
    let mut x0: f64 = 2.33;
    for _ in 0..6 {
        let tan = libm::tan(0.5 * x0);
        x0 -= (tan - x0) / (0.5 * (1.0 + tan * tan) - 1.0);
    }
    let lambda = x0 / (1.0 - libm::cos(x0));
    let contact = x0 * FRAC_1_PI / lambda;
    RingLimit {
        lambda,
        curvature_per_r_star: -2.0 * contact * contact / lambda,
        seal_load: FRAC_1_PI,
        width: 2.0 * FRAC_1_PI,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::hinge::ring::{Ring, cone_at_target};
    use crate::mechanics::hinge::{HingeModel, seal_load};

    #[test]
    fn the_ring_tends_to_it_like_one_over_r_star() {
        let thin_limit = limit();
        for r_star in [1e2, 1e3, 1e4, 1e6] {
            let state = Ring.target(r_star).expect("solved");
            let close = |value: f64, thin_limit: f64| (value / thin_limit - 1.0).abs() * r_star;
            assert!(close(state.lambda, thin_limit.lambda) < 0.1, "lambda {}", state.lambda);
            assert!(
                close(state.curvature / r_star, thin_limit.curvature_per_r_star) < 1.0,
                "V'' {}",
                state.curvature
            );
            assert!(close(seal_load(r_star, &state).unwrap_or(0.0), thin_limit.seal_load) < 1.0);
            assert!(close(state.edges.map_or(0.0, |e| e.width), thin_limit.width) < 0.1);
            assert!(cone_at_target(r_star) * r_star < 0.1);
        }
    }

    /// Limit of `V_bar(lambda) - R*/pi` for lambda up to lambda_c: `lambda / pi^2`.
    fn limit_volume_above_tube(lambda: f64) -> f64 {
        lambda * FRAC_1_PI.powi(2)
    }

    #[test]
    fn volume_tends_to_the_tube_plus_a_term_in_lambda() {
        for lambda in [0.8, 1.0, 1.2, 1.35] {
            let r_star = 1e4;
            let volume = Ring.state(r_star, lambda).expect("solved").volume.unwrap_or(f64::NAN);
            let volume_above_tube = volume - r_star * FRAC_1_PI;
            assert!(
                (volume_above_tube - limit_volume_above_tube(lambda)).abs() < 1e-4,
                "{volume_above_tube}"
            );
        }
    }
}
