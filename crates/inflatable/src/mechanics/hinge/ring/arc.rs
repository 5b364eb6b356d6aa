//! A free arc: a stretch of the meridian without hoop tension.
//!
//! Along it the meridional tension `T` (per radian, in units of p W^2) is constant, and with the
//! distance to the axis `Q` and the slope angle `phi`
//!
//! ```text
//! phi' = -Q / T      Q' = cos(phi)      T sin(phi) + Q^2 / 2 = const.
//! ```
//!
//! In the half angle `theta = (phi + pi/2) / 2` this is a pendulum, `Q^2 = E^2 - 4 T sin^2(theta)`
//! with the **bottom value** `E`, the Q it would have at theta = 0, and `ds = -2 T dtheta / Q`.
//! Q vanishes within reach of the arc only if `kappa = 4 T / E^2 > 1`; there the substitution
//! `sin(chi) = sqrt(kappa) sin(theta)` turns the integrand into `ds = -sqrt(T) dchi / cos(theta)`,
//! which is smooth even where Q = 0, that is at the inner edge of a hinge with R* = 0. In both
//! variables the nearest singularity keeps a distance from the interval that does not depend on
//! R*, so one Gauss rule serves for every R*.

use crate::numerics::Dual;
use crate::numerics::gauss::gauss_legendre;
use std::f64::consts::FRAC_PI_2;
use std::sync::LazyLock;

/// Points of the rule: the integrands' smallest ellipse has rho = 2.1, and 2.1^-48 is below rounding.
const POINTS: usize = 24;

static RULE: LazyLock<[(f64, f64); POINTS]> = LazyLock::new(gauss_legendre::<POINTS>);

/// The start of an arc, with its tension.
#[derive(Clone, Copy, Debug)]
pub(super) struct ArcStart<const N: usize> {
    /// Slope angle phi there, rad.
    pub(super) phi: Dual<N>,
    /// Meridional tension T per radian.
    pub(super) tension: Dual<N>,
    /// Distance Q to the axis.
    pub(super) axis: Dual<N>,
    /// Distance r to the inner edge.
    pub(super) reach: Dual<N>,
}

/// The contribution of an arc to the integrals, and its end.
#[derive(Clone, Copy, Debug)]
pub(super) struct TensionArc<const N: usize> {
    /// Length of the arc, the integral of ds.
    pub(super) length: Dual<N>,
    /// The integral of sin(phi) ds, the rise of z.
    pub(super) rise: Dual<N>,
    /// The integral of r sin(phi) ds.
    pub(super) moment: Dual<N>,
    /// The integral of r^2 sin(phi) ds.
    pub(super) second_moment: Dual<N>,
    /// Distance Q to the axis at its end.
    pub(super) axis: Dual<N>,
    /// Distance r to the inner edge at its end.
    pub(super) reach: Dual<N>,
}

impl<const N: usize> TensionArc<N> {
    /// Adds the point at the distance `reach` with the slope angle phi and this `weight` of ds.
    fn add(&mut self, weight: Dual<N>, sin_phi: Dual<N>, reach: Dual<N>) {
        let rise = weight * sin_phi;
        let moment = rise * reach;
        self.length = self.length + weight;
        self.rise = self.rise + rise;
        self.moment = self.moment + moment;
        self.second_moment = self.second_moment + moment * reach;
    }
}

/// The arc from `start` down to the slope angle `end`.
pub(super) fn free_arc<const N: usize>(start: &ArcStart<N>, end: Dual<N>) -> TensionArc<N> {
    // With theta half the slope angle from the vertical, all that is asked of the arc is an integral over theta. Where
    // the axis stays away from zero, Gauss' rule over theta serves. Where the arc nearly meets its axis, theta is
    // replaced by chi, in which the integrand stays smooth.
    let zero = Dual::constant(0.0);
    let [theta_start, theta_end] = [start.phi, end].map(|phi| (phi + FRAC_PI_2) * 0.5);
    let tension4 = start.tension * 4.0;
    let start_square = tension4 * theta_start.sin_cos().0.squared();
    let bottom_square = start.axis.squared() + start_square;
    let end_sin = theta_end.sin_cos().0;
    let end_drop = tension4 * end_sin.squared();
    let end_axis = (bottom_square - end_drop).sqrt();
    let mut arc = TensionArc {
        length: zero,
        rise: zero,
        moment: zero,
        second_moment: zero,
        axis: end_axis,
        reach: start.reach + (start_square - end_drop) / (end_axis + start.axis),
    };
    if tension4.value <= bottom_square.value {
        let span = theta_start - theta_end;
        let scale = start.tension * 2.0 * span;
        for &(node, weight) in RULE.iter() {
            let (sin, _) = (theta_end + span * node).sin_cos();
            let sin_square = sin.squared();
            let drop = tension4 * sin_square;
            let axis = (bottom_square - drop).sqrt();
            let reach = start.reach + (start_square - drop) / (axis + start.axis);
            arc.add(scale / axis * weight, sin_square * 2.0 - 1.0, reach);
        }
    } else {
        let root = start.tension.sqrt();
        let bottom = bottom_square.sqrt();
        let inverse_kappa = bottom_square / tension4;
        let chi_start = (root * 2.0 * theta_start.sin_cos().0).atan2(start.axis);
        let chi_end = (root * 2.0 * end_sin).atan2(end_axis);
        let span = chi_start - chi_end;
        let scale = root * span;
        for &(node, weight) in RULE.iter() {
            let (sin, cos) = (chi_end + span * node).sin_cos();
            let sin_square = inverse_kappa * sin.squared();
            let cos_theta = (-sin_square + 1.0).sqrt();
            let reach = start.reach + bottom * cos - start.axis;
            arc.add(scale / cos_theta * weight, sin_square * 2.0 - 1.0, reach);
        }
    }
    arc
}
