//! The **hinge**: one bend of the tube, an annulus sector of inner radius `R`, width `W` and arc `pi - phi_0`.
//!
//! When inflated it coils: the **coiling factor** is `lambda = (pi - phi) / (pi - phi_0)`. A
//! model gives the dimensionless volume of a hinge, `V_bar(lambda) = V / [W^3 (pi - phi_0)]`,
//! which depends on `R* = R / W` only; angle, moment and stiffness follow from it.

pub mod bvp;
#[cfg(test)]
mod contract;
pub mod fit;
pub mod ring;
pub mod section;

use crate::mechanics::fault::HingeFault;
use std::f64::consts::PI;

/// The models, from the fastest to the most faithful.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Published constants.
    Fit,
    /// Exact membrane limit.
    Ring,
    /// Penalised boundary-value problem at finite beta.
    Bvp,
    /// Bending, stretch and hoop compression at a pressure.
    Section,
}

impl Level {
    /// Name in specs and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Fit => "fit",
            Self::Ring => "ring",
            Self::Bvp => "bvp",
            Self::Section => "section",
        }
    }
}

/// Laws of a hinge that some model implements.
///
/// All methods are pure: the same arguments give the same bits.
pub trait HingeModel: Sync {
    /// Which model this is.
    fn level(&self) -> Level;

    /// The hinge at `lambda`.
    ///
    /// # Errors
    /// If `r_star` or `lambda` is outside of the model's range, or the model's equations cannot be solved.
    fn state(&self, r_star: f64, lambda: f64) -> Result<HingeState, HingeFault>;

    /// The hinge at its target, where the volume is largest: `V_bar'(lambda_t) = 0`.
    ///
    /// # Errors
    /// The errors of [`HingeModel::state`].
    fn target(&self, r_star: f64) -> Result<HingeState, HingeFault>;

    /// The coiling factor `lambda_c` at which hoop tension sets in away from the rim, and V_bar'' jumps;
    /// `None` if the model has none: in a sheet that stretches it is there from the start, at finite beta it sets in gradually.
    ///
    /// # Errors
    /// If `r_star` is no finite number from 0 on, or the model has an onset and refuses the hinge.
    fn onset(&self, r_star: f64) -> Result<Option<f64>, HingeFault> {
        check_r_star(r_star, f64::MAX).map(|()| None)
    }

    /// The effect of the arms on a hinge of the flat arc `arc` (rad); `None` if the model does not give it.
    fn arms(&self, _r_star: f64, _arc: f64) -> Option<Arms> {
        None
    }
}

/// The effect of arms on the hinge between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arms {
    /// By how much further it coils, because hoop compression is let out into them at both ends: to `lambda alpha_0` and that, rad.
    pub angle: f64,
    /// g, rad: arms are as soft as that much more of hinge would be, so `C = p W^3 |V_bar''| / (alpha_0 + g)`.
    pub give: f64,
}

/// A hinge at one coiling factor. Everything is dimensionless and finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HingeState {
    /// Coiling factor lambda.
    pub lambda: f64,
    /// V_bar; `None` if the model does not give it.
    pub volume: Option<f64>,
    /// dV_bar/dlambda.
    pub slope: f64,
    /// d2V_bar/dlambda2, from the right at a jump.
    pub curvature: f64,
    /// The section's edges; `None` if the model does not give them.
    pub edges: Option<Edges>,
    /// Work and accuracy of the solution.
    pub effort: HingeEffort,
}

/// State of the inner and outer edge of the inflated hinge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edges {
    /// Meridional tension at the inner edge, per radian of the arc, in units of p W^2.
    pub tension: f64,
    /// Slope angle of the fabric at the inner edge, rad.
    pub angle: f64,
    /// Inflated width r(1): from the inner to the outer edge, in units of W.
    pub width: f64,
    /// Hoop force that the inner rim carries, both sheets together, in units of p W^2; below 0 the
    /// rim would have to push, and a real rim wrinkles instead.
    pub rim_force: f64,
}

/// Work and accuracy of the solution of a model's equations.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HingeEffort {
    /// Largest residual of the equations, scaled to order one.
    pub residual: f64,
    /// Newton steps.
    pub iterations: u32,
    /// Estimated relative error of V_bar and V_bar' against the exact solution of the same model.
    pub error: f64,
}

/// Seal load `k`: force per length of the inner edge is `k p W`, with `k = T lambda / R*`.
///
/// It tends to the straight tube's 1/pi for R* -> infinity and grows like 1/R* for R* -> 0.
/// `None` at R* = 0, where it is infinite, and for models without tension.
pub fn seal_load(r_star: f64, state: &HingeState) -> Option<f64> {
    let load = state.edges?.tension * state.lambda / r_star;
    load.is_finite().then_some(load)
}

/// One hinge of given size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hinge {
    /// R / W, 0 or more.
    pub r_star: f64,
    /// Flat width W, m, above 0.
    pub width: f64,
    /// Angle phi_0 between the arms when flat, rad, in (0, pi).
    pub rest_angle: f64,
}

impl Hinge {
    /// Arc of the annulus sector when flat, `alpha_0 = pi - phi_0`, rad.
    pub fn arc(&self) -> f64 {
        PI - self.rest_angle
    }

    /// Coiling factor at the angle `phi` (rad).
    pub fn coiling(&self, phi: f64) -> f64 {
        (PI - phi) / self.arc()
    }

    /// Angle phi (rad) at the coiling factor `lambda`; below 0 if the arms would cross.
    pub fn angle(&self, lambda: f64) -> f64 {
        PI - lambda * self.arc()
    }

    /// The effect of the arms by `model`; `None` where it is unknown.
    pub fn arms(&self, model: &dyn HingeModel) -> Option<Arms> {
        model.arms(self.r_star, self.arc())
    }

    /// The angle phi (rad) at which `model`'s state `state` is, arms included.
    pub fn angle_of(&self, model: &dyn HingeModel, state: &HingeState) -> f64 {
        self.angle_between(self.arms(model), state)
    }

    /// The angle with a given effect of the arms.
    pub(super) fn angle_between(&self, arms: Option<Arms>, state: &HingeState) -> f64 {
        self.angle(state.lambda) - let_out(arms)
    }

    /// `model`'s state at the angle `phi` (rad), arms included.
    ///
    /// # Errors
    /// The errors of [`HingeModel::state`].
    pub fn state_at(&self, model: &dyn HingeModel, phi: f64) -> Result<HingeState, HingeFault> {
        let arms = self.arms(model);
        let without_arms = model.state(self.r_star, self.coiling(phi + let_out(arms)))?;
        Ok(self.between_arms(arms, without_arms))
    }

    /// `model`'s state at rest, arms included.
    ///
    /// # Errors
    /// The errors of [`HingeModel::target`].
    pub fn rest(&self, model: &dyn HingeModel) -> Result<HingeState, HingeFault> {
        self.rest_between(self.arms(model), model)
    }

    /// The state at rest with a given effect of the arms.
    pub(super) fn rest_between(
        &self,
        arms: Option<Arms>,
        model: &dyn HingeModel,
    ) -> Result<HingeState, HingeFault> {
        Ok(self.between_arms(arms, model.target(self.r_star)?))
    }

    /// The hinge made softer by its arms, in the same part at all angles: the shell is up to a tenth off that on either side.
    fn between_arms(&self, arms: Option<Arms>, without_arms: HingeState) -> HingeState {
        let part = arms.map_or(1.0, |arms| self.arc() / (self.arc() + arms.give));
        HingeState {
            slope: part * without_arms.slope,
            curvature: part * without_arms.curvature,
            ..without_arms
        }
    }

    /// Moment `M = p dV/dphi = -p W^3 V_bar'` that drives phi, N m, at the gauge pressure `p` (Pa).
    ///
    /// It is negative (closing) below the target coiling and positive (opening) above.
    pub fn moment(&self, p: f64, state: &HingeState) -> f64 {
        -p * self.width.powi(3) * state.slope
    }

    /// Stiffness `C = -dM/dphi = -p W^3 V_bar'' / (pi - phi_0)`, N m per rad, at the gauge pressure `p` (Pa).
    ///
    /// At the target this is the paper's hinge stiffness. It diverges for phi_0 -> pi, like 1 / arc.
    pub fn stiffness(&self, p: f64, state: &HingeState) -> f64 {
        -p * self.width.powi(3) * state.curvature / self.arc()
    }
}

/// The angle (rad) by which `arms` let a hinge coil further than its model's lambda gives; 0 where it is unknown.
fn let_out(arms: Option<Arms>) -> f64 {
    arms.map_or(0.0, |arms| arms.angle)
}

/// Refuses an `R*` that is not a number from 0 to `maximum`.
pub(super) fn check_r_star(r_star: f64, maximum: f64) -> Result<(), HingeFault> {
    if (0.0..=maximum).contains(&r_star) {
        Ok(())
    } else {
        Err(HingeFault::RStar { found: r_star, most: maximum })
    }
}

/// Refuses a `lambda` that is not a number from `minimum` to `maximum`.
pub(super) fn check_lambda(lambda: f64, minimum: f64, maximum: f64) -> Result<(), HingeFault> {
    if (minimum..=maximum).contains(&lambda) {
        Ok(())
    } else {
        Err(HingeFault::Coiling { found: lambda, least: minimum, most: maximum })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angle_and_coiling_are_inverse() {
        let hinge = Hinge { r_star: 0.1, width: 0.02, rest_angle: 30.0_f64.to_radians() };
        assert!((hinge.angle(1.28).to_degrees() - (180.0 - 1.28 * 150.0)).abs() < 1e-12);
        assert!((hinge.coiling(hinge.angle(1.17)) - 1.17).abs() < 1e-15);
        assert_eq!(hinge.coiling(hinge.rest_angle), 1.0);
    }

    #[test]
    fn bad_arguments_are_refused_with_what_is_allowed() {
        assert_eq!(check_r_star(-0.1, 10.0), Err(HingeFault::RStar { found: -0.1, most: 10.0 }));
        assert!(check_r_star(f64::NAN, 10.0).is_err() && check_r_star(11.0, 10.0).is_err());
        assert!(check_lambda(f64::NAN, 0.5, 2.0).is_err() && check_lambda(2.1, 0.5, 2.0).is_err());
        assert!(check_r_star(0.0, 10.0).is_ok() && check_lambda(2.0, 0.5, 2.0).is_ok());
    }
}
