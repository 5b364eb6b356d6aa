//! The cross-section of an inflated ring at given unknowns: lengths, residuals, volume and its derivative.
//!
//! Lengths are in units of the flat width W, tensions per radian in units of p W^2. The unknowns are
//! the slope angle `phi_0` at the inner edge, the tension `T` there, the length `L` of the cone
//! on which the hoop tension acts, and the coiling factor `lambda`; every result carries its
//! gradient with respect to these four.
//!
//! With `z = 0` at both ends, integration by parts turns the volume and its derivative into single
//! integrals (V_bar = V / (W^3 alpha_0); envelope theorem for the second; `h = Q / sin(gamma)` is
//! the hoop tension of the cone of slope `-gamma = -arccos(1/lambda)`):
//!
//! ```text
//! V_bar  = -2 R* ∫ r sin(phi) ds - lambda ∫ r^2 sin(phi) ds
//! V_bar' = -∫ r^2 sin(phi) ds - 2 ∫_cone h r ds
//! ```

use crate::mechanics::hinge::ring::arc::{ArcStart, TensionArc, free_arc};
use crate::numerics::Dual;
use std::f64::consts::FRAC_PI_2;

/// Order of the unknowns.
pub(super) const PHI_0: usize = 0;
pub(super) const TENSION: usize = 1;
pub(super) const CONE: usize = 2;
pub(super) const LAMBDA: usize = 3;

/// A number with its gradient with respect to the four unknowns.
pub(super) type Gradient = Dual<4>;

/// The section at one point of the space of unknowns.
#[derive(Clone, Copy, Debug)]
pub(super) struct RingSection {
    /// Length of the meridian minus 1.
    pub(super) length: Gradient,
    /// z at the outer edge.
    pub(super) closing: Gradient,
    /// `u = lambda r - s` at the end of the first arc.
    pub(super) contact: Gradient,
    /// V_bar.
    pub(super) volume: Gradient,
    /// dV_bar/dlambda.
    pub(super) slope: Gradient,
    /// r at the outer edge: the inflated width over W.
    pub(super) width: Gradient,
}

/// The section without cone: one free arc, cut at a fixed angle only to share the quadrature.
pub(super) fn free_section(r_star: f64, unknowns: [f64; 4]) -> Option<RingSection> {
    let [phi_0, tension, _, lambda] = Gradient::variables(unknowns);
    admissible(unknowns)?;
    let axis = lambda.recip() * r_star;
    let start = ArcStart { phi: phi_0, tension, axis, reach: Gradient::constant(0.0) };
    let first = free_arc(&start, Gradient::constant(-0.75));
    let start = ArcStart { phi: Gradient::constant(-0.75), tension, axis: first.axis, reach: first.reach };
    let second = free_arc(&start, Gradient::constant(-FRAC_PI_2));
    let zero = Gradient::constant(0.0);
    let no_cone = TensionArc { length: zero, rise: zero, moment: zero, second_moment: zero, ..first };
    Some(assemble(r_star, lambda, [&first, &no_cone, &second], zero))
}

/// The section with a cone between two free arcs.
pub(super) fn cone_section(r_star: f64, unknowns: [f64; 4]) -> Option<RingSection> {
    admissible(unknowns)?;
    let [phi_0, tension, cone, lambda] = Gradient::variables(unknowns);
    if lambda.value <= 1.0 || phi_0.value <= -libm::acos(lambda.value.recip()) {
        return None;
    }
    let axis = lambda.recip() * r_star;
    let cos = lambda.recip();
    let sin = (-cos.squared() + 1.0).sqrt();
    let gamma = sin.atan2(cos);
    let start = ArcStart { phi: phi_0, tension, axis, reach: Gradient::constant(0.0) };
    let first = free_arc(&start, -gamma);

    // Along the cone Q and r grow by sigma cos(gamma), and T' = Q cot(gamma).
    let gain = cone * cos;
    let (q, r) = (first.axis, first.reach);
    let end_tension = tension + cone * (q + gain * 0.5) * cos / sin;
    let hoop = cone * (q * r + (q + r) * gain * 0.5 + gain.squared() * (1.0 / 3.0)) / sin;
    let frustum = TensionArc {
        length: cone,
        rise: -(sin * cone),
        moment: -(sin * cone) * (r + gain * 0.5),
        second_moment: -(sin * cone) * (r.squared() + r * gain + gain.squared() * (1.0 / 3.0)),
        axis: q + gain,
        reach: r + gain,
    };
    let start = ArcStart { phi: -gamma, tension: end_tension, axis: frustum.axis, reach: frustum.reach };
    if end_tension.value <= 0.0 || start.axis.value <= 0.0 {
        return None;
    }
    let second = free_arc(&start, Gradient::constant(-FRAC_PI_2));
    Some(assemble(r_star, lambda, [&first, &frustum, &second], hoop))
}

/// Quadrature needs T > 0 and a start above the outer edge's slope, below a full turn.
fn admissible(unknowns: [f64; 4]) -> Option<()> {
    let [phi_0, tension, _, lambda] = unknowns;
    (tension > 0.0 && lambda > 0.0 && phi_0 > -0.75 && phi_0 < 3.0).then_some(())
}

/// The section of an arc, a cone and an arc; `hoop` is the integral of h r ds over the cone.
fn assemble(r_star: f64, lambda: Gradient, parts: [&TensionArc<4>; 3], hoop: Gradient) -> RingSection {
    let sum = |of: fn(&TensionArc<4>) -> Gradient| of(parts[0]) + of(parts[1]) + of(parts[2]);
    let second_moment = sum(|part| part.second_moment);
    RingSection {
        length: sum(|part| part.length) - 1.0,
        closing: sum(|part| part.rise),
        contact: lambda * parts[0].reach - parts[0].length,
        volume: sum(|part| part.moment) * (-2.0 * r_star) - lambda * second_moment,
        slope: -second_moment - hoop * 2.0,
        width: parts[2].reach,
    }
}
