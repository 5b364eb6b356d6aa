//! Equilibrium and response of an inflated star: closing, and force against radius.
//!
//! With E = -p (n V_tip + n V_corner) and the tip's angle as coordinate the **torque** that closes the star is
//!
//! ```text
//! dE/dphi = n p W^3 [V_bar'(lambda_i) + V_bar'(lambda_e)]
//! ```
//!
//! and the radial force, summed over all n corners, `F = dE/drho = (dE/dphi) / (drho/dphi)`. The hinge
//! model's V_bar' is used as it is: with the published parabola this is the paper's star of linear
//! hinges, with the exact ring it is softer on closing than on opening.

use crate::mechanics::fault::StarFault;
use crate::mechanics::hinge::{Arms, HingeModel, HingeState, Level};
use crate::mechanics::star::grasp::{Grasp, HingePair};
use crate::mechanics::star::{Mechanism, Radius, Widest};
use crate::numerics::bracketed_root;

/// Angles are found to this, rad: 1e-10 of a rad moves no radius by more than 1e-8 mm.
const ANGLE_TOLERANCE: f64 = 1e-12;

/// An inflated star with its hinge model.
#[derive(Clone, Copy)]
pub struct Inflated<'a> {
    star: &'a Mechanism,
    model: &'a dyn HingeModel,
    /// Gauge pressure p, Pa.
    pressure: f64,
    /// Tip and corner at their targets.
    hinges: [HingeState; 2],
    /// The effect of the arms on both.
    arms: [Option<Arms>; 2],
}

/// The equilibrium of a star.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rest {
    /// Angle phi_i^eq at which the torque vanishes, rad; below [`Rest::angle`] the arms would cross.
    pub equilibrium: f64,
    /// Angle at which it rests: that, but not less than where the arms touch, which is 0 without a correction.
    pub angle: f64,
    /// Final inner radius rho_f, m.
    pub radius: f64,
    /// Radial force that is stored in a star that is pressed shut, N; 0 for one that is free.
    pub preload: f64,
    /// Radial stiffness dF/drho there, N per m.
    pub stiffness: f64,
    /// The widest opening from there.
    pub widest: Widest,
}

impl<'a> Inflated<'a> {
    /// The star at the gauge pressure `pressure` (Pa).
    ///
    /// # Errors
    /// If the model refuses one of the hinges.
    pub fn new(star: &'a Mechanism, model: &'a dyn HingeModel, pressure: f64) -> Result<Self, StarFault> {
        let arms = [star.tip(), star.corner()].map(|hinge| hinge.arms(model));
        let hinges = [star.tip().rest_between(arms[0], model)?, star.corner().rest_between(arms[1], model)?];
        if !(pressure >= 0.0 && pressure.is_finite()) {
            return Err(StarFault::Dimension { symbol: "p", found: pressure, allowed: "0 or more" });
        }
        let inflated = Self { star, model, pressure, hinges, arms };
        let [c_i, c_e] = inflated.hinge_stiffness();
        if (c_i + c_e).is_finite() {
            Ok(inflated)
        } else {
            Err(StarFault::Dimension { symbol: "p", found: pressure, allowed: "such that p W^3 is finite" })
        }
    }

    /// The model's level.
    pub fn level(&self) -> Level {
        self.model.level()
    }

    /// The model.
    pub fn model(&self) -> &'a dyn HingeModel {
        self.model
    }

    /// Tip and corner at their targets.
    pub fn hinges(&self) -> &[HingeState; 2] {
        &self.hinges
    }

    /// Stiffnesses C_i and C_e of tip and corner at their targets, N m per rad.
    pub fn hinge_stiffness(&self) -> [f64; 2] {
        let [tip, corner] = &self.hinges;
        [self.star.tip().stiffness(self.pressure, tip), self.star.corner().stiffness(self.pressure, corner)]
    }

    /// Target angles phi_it and phi_et of tip and corner, rad.
    pub fn target_angles(&self) -> [f64; 2] {
        let ([tip, corner], [of_tip, of_corner]) = (&self.hinges, self.arms);
        [self.star.tip().angle_between(of_tip, tip), self.star.corner().angle_between(of_corner, corner)]
    }

    /// Whether the model gives the effect of the arms on both hinges.
    pub fn has_arms(&self) -> bool {
        self.arms.iter().all(Option::is_some)
    }

    /// The tips' angles at which tip and corner would rest in the star, rad: those of their targets, moved by what shells give beyond them.
    fn own_rests(&self) -> [f64; 2] {
        let [phi_it, phi_et] = self.target_angles();
        [phi_it, phi_et - self.star.turn()].map(|angle| angle + self.star.correction.angle_offset)
    }

    /// The stiffness of tip and corner in the equilibrium; the ratio does not depend on the pressure, which may be 0.
    fn weights(&self) -> [f64; 2] {
        let [tip, corner] = &self.hinges;
        [(self.star.tip(), tip), (self.star.corner(), corner)]
            .map(|(hinge, state)| self.star.correction.stiffness_between_arms(-state.curvature / hinge.arc()))
    }

    /// The spring `n (C_i + C_e)` times `softness`, N m per rad.
    fn spring(&self, softness: f64) -> f64 {
        let [tip, corner] = self.hinge_stiffness();
        softness * f64::from(self.star.points) * (tip + corner)
    }

    /// The spring with the correction's softness, where the radius grows by `slope` (m per rad) with the tips' angle.
    fn softened(&self, slope: f64) -> f64 {
        self.spring(self.star.correction.softness(self.star, slope))
    }

    /// Equilibrium of linear hinges in closed form, with the correction if there is one: the paper's rho_f and radial stiffness
    /// `4 n (C_i + C_e) [sin(pi/n) / (l cos(phi/2) - W' sin(phi/2))]^2`.
    ///
    /// If the arms touch, the stiffness is the one at the touching arms.
    pub fn linear_rest(&self) -> Rest {
        let equilibrium = self.star.correction.balance(self.own_rests(), self.weights());
        let angle = equilibrium.max(self.star.correction.contact_angle);
        let radius = self.star.radius(angle);
        let spring = self.softened(radius.slope);
        let widest = self.star.widest_from(angle, &radius);
        rest([equilibrium, angle], spring * (angle - equilibrium), spring, &radius, widest)
    }

    /// Rest with the model's own V_bar'.
    ///
    /// # Errors
    /// If the model refuses a coiling factor on the way, or does not let the torque vanish in its range.
    pub fn rest(&self) -> Result<Rest, StarFault> {
        let equilibrium = self.equilibrium()?;
        let angle = equilibrium.max(self.star.correction.contact_angle);
        let (mut torque, spring) = self.torque(angle)?;
        if equilibrium >= self.star.correction.contact_angle {
            // The root is only found to a tolerance; the remaining torque is not a preload.
            torque = 0.0;
        }
        let radius = self.star.radius(angle);
        Ok(rest([equilibrium, angle], torque, spring, &radius, self.star.widest_from(angle, &radius)))
    }

    /// Angle phi_i at which the torque vanishes, rad, not clamped.
    fn equilibrium(&self) -> Result<f64, StarFault> {
        let [first, other] = self.own_rests();
        if (first - other).abs() < ANGLE_TOLERANCE {
            return Ok(first);
        }
        // Between the two hinges' own rests both pull against each other, so the torque changes sign. The linear
        // equilibrium is inside; searching from it outwards avoids the far coiling of the weaker hinge.
        let [tip, corner] = self.weights();
        let start = (tip * first + corner * other) / (tip + corner);
        let (at_start, _) = self.scaled_torque(start)?;
        let (low, high) = (first.min(other), first.max(other));
        let bound = if at_start > 0.0 { low } else { high };
        let mut last = start;
        for part in [0.25, 0.5, 0.75, 1.0] {
            let next = start + part * (bound - start);
            if self.scaled_torque(next)?.0 * at_start <= 0.0 {
                return bracketed_root(last, next, ANGLE_TOLERANCE, |phi| {
                    self.scaled_torque(phi).map(|(torque, _)| torque)
                });
            }
            last = next;
        }
        // At the bound itself one hinge is at rest and the other pulls on; only rounding hides the sign.
        Ok(bound)
    }

    /// Closing torque dE/dphi (N m) at the tip angle `phi` (rad), and its own derivative (N m per rad).
    ///
    /// # Errors
    /// If the model refuses a coiling factor.
    pub fn torque(&self, phi: f64) -> Result<(f64, f64), StarFault> {
        let scale = self.pressure * self.star.width.powi(3);
        self.scaled_torque(phi).map(|(torque, spring)| (scale * torque, scale * spring))
    }

    /// The torque and its derivative in units of p W^3.
    fn scaled_torque(&self, phi: f64) -> Result<(f64, f64), StarFault> {
        let points = f64::from(self.star.points);
        let (tip, corner) = (self.star.tip(), self.star.corner());
        let phi = phi - self.star.correction.angle_offset;
        let of_tip = tip.state_at(self.model, phi)?;
        let of_corner = corner.state_at(self.model, phi + self.star.turn())?;
        let spring = -of_tip.curvature / tip.arc() - of_corner.curvature / corner.arc();
        Ok((points * (of_tip.slope + of_corner.slope), points * spring))
    }

    /// Whether at the tip angle `phi` (rad) the inner rim of a hinge would have to push.
    pub fn rim_pushes(&self, phi: f64) -> bool {
        let hinges = [(self.star.tip(), phi), (self.star.corner(), phi + self.star.turn())];
        hinges.into_iter().any(|(hinge, phi)| {
            let state = hinge.state_at(self.model, phi).ok();
            state.and_then(|state| state.edges).is_some_and(|edges| edges.rim_force < 0.0)
        })
    }

    /// Radial force F (N, all corners together) on an object of radius `rho` (m) that keeps the star open.
    ///
    /// # Errors
    /// The errors of [`Inflated::angle_at`], or if the model refuses.
    pub fn force(&self, rho: f64, rest: &Rest) -> Result<f64, StarFault> {
        let phi = self.angle_at(rho, rest)?;
        let (torque, _) = self.torque(phi)?;
        Ok(torque / self.star.radius(phi).slope)
    }

    /// Radial force (N) of linear hinges on an object of radius `rho` (m): `n (C_i + C_e) (phi - phi_eq) dphi/drho`, and with a
    /// correction that of [`Grasp`].
    ///
    /// # Errors
    /// The errors of [`Inflated::angle_at`].
    pub fn linear_force(&self, rho: f64, rest: &Rest) -> Result<f64, StarFault> {
        self.linear_force_by(self.grasp(rest).as_ref(), rho, rest)
    }

    /// [`Inflated::linear_force`] with [`Inflated::grasp`] given: a prediction and its range use the same.
    ///
    /// # Errors
    /// The errors of [`Inflated::angle_at`].
    pub fn linear_force_by(&self, grasp: Option<&Grasp>, rho: f64, rest: &Rest) -> Result<f64, StarFault> {
        if let Some(grasp) = grasp {
            check_reach(rho, rest)?;
            return Ok(grasp.force(rho));
        }
        let phi = self.angle_at(rho, rest)?;
        Ok(self.spring(1.0) * (phi - rest.equilibrium) / self.star.radius(phi).slope)
    }

    /// The force law of a star with a correction, which rests at `rest`, on objects that open it; `None` without a correction.
    ///
    /// Arms that touch press on each other only until an object keeps them apart. Then its force is that of a star whose arms cross, and
    /// which rests at the equilibrium's angle: openings count from [`Grasp::free_radius`].
    pub fn grasp(&self, rest: &Rest) -> Option<Grasp> {
        if !self.star.correction.corner_compliance {
            return None;
        }
        let hinges = HingePair { stiffness: self.hinge_stiffness(), target: self.own_rests() };
        let stiffness = if rest.equilibrium < rest.angle {
            let slope = self.star.radius(rest.equilibrium).slope;
            self.softened(slope) / (slope * slope)
        } else {
            rest.stiffness
        };
        Some(Grasp::new(self.star, hinges, [rest.equilibrium, rest.widest.angle], stiffness))
    }

    /// Tip angle (rad) at which the inner radius is `rho` (m), between rest and the widest opening.
    ///
    /// # Errors
    /// If the star is not that wide anywhere between them.
    pub fn angle_at(&self, rho: f64, rest: &Rest) -> Result<f64, StarFault> {
        check_reach(rho, rest)?;
        bracketed_root(rest.angle, rest.widest.angle, ANGLE_TOLERANCE, |phi| {
            Ok(self.star.radius(phi).value - rho)
        })
    }
}

/// Checks that a star which rests at `rest` opens to the radius `rho`, m.
fn check_reach(rho: f64, rest: &Rest) -> Result<(), StarFault> {
    let (minimum, maximum) = (rest.radius, rest.widest.radius);
    if (minimum..=maximum).contains(&rho) {
        Ok(())
    } else {
        Err(StarFault::Radius { found: rho, least: minimum, most: maximum })
    }
}

/// The rest at the angle where `radius` was taken, with the closing torque left there and the spring dtorque/dphi.
fn rest([equilibrium, angle]: [f64; 2], torque: f64, spring: f64, radius: &Radius, widest: Widest) -> Rest {
    let stiffness = (spring - torque * radius.curvature / radius.slope) / (radius.slope * radius.slope);
    Rest { equilibrium, angle, radius: radius.value, preload: torque / radius.slope, stiffness, widest }
}

#[cfg(test)]
mod tests;
