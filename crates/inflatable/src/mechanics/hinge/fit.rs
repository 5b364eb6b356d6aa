//! The published constants: target coiling 1.28, stiffness from a straight-line fit, a parabola for the volume.
//!
//! Source: Andrade-Silva & Marthelot, "Fabric-Based Star Soft Robotic Gripper": lambda_t is given for
//! R* = 0.1 only; `V_bar''(lambda_t) = -(0.4659 R* + 0.3986)` is their fit, used from R* = 0.05 to 2.
//! Outside of these the constants are still returned, and [`covers`] reports that they do not apply.

use crate::mechanics::fault::HingeFault;
use crate::mechanics::hinge::{HingeEffort, HingeModel, HingeState, Level, check_lambda, check_r_star};
use std::ops::RangeInclusive;

/// Published target coiling factor, for R* = 0.1.
pub const TARGET_COILING: f64 = 1.28;
/// R* for which the target coiling was published.
pub const TARGET_R_STAR: f64 = 0.1;
/// R* for which the fit of the stiffness was published.
pub const STIFFNESS_R_STAR: RangeInclusive<f64> = 0.05..=2.0;
/// Largest error of the fit's V_bar'' against the exact ring on its own range, relative (docs/paper.md).
pub const STIFFNESS_ERROR: f64 = 0.14;

/// Published straight line for V_bar'' at the target.
pub fn target_curvature(r_star: f64) -> f64 {
    -(0.4659 * r_star + 0.3986)
}

/// Whether the published constants were given for this R*: the target coiling and the stiffness.
pub fn covers(r_star: f64) -> (bool, bool) {
    ((r_star - TARGET_R_STAR).abs() < 1e-9, STIFFNESS_R_STAR.contains(&r_star))
}

/// The published constants as a model: a parabola around the target.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fit;

impl HingeModel for Fit {
    fn level(&self) -> Level {
        Level::Fit
    }

    fn state(&self, r_star: f64, lambda: f64) -> Result<HingeState, HingeFault> {
        check_r_star(r_star, f64::MAX)?;
        check_lambda(lambda, 0.0, f64::MAX)?;
        let curvature = target_curvature(r_star);
        Ok(HingeState {
            lambda,
            volume: None,
            slope: curvature * (lambda - TARGET_COILING),
            curvature,
            edges: None,
            effort: HingeEffort::default(),
        })
    }

    fn target(&self, r_star: f64) -> Result<HingeState, HingeFault> {
        self.state(r_star, TARGET_COILING)
    }
}
