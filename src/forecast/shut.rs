//! The shape of a star that has closed: for pictures.

use std::f64::consts::PI;

use crate::design::{Design, Star};
use crate::forecast::case::mechanism;
use crate::forecast::prediction::Prediction;
use crate::mechanics::fault::StarFault;
use crate::mechanics::star::{Correction, Mechanism};
use crate::numerics::bracketed_root;
use crate::units::Length;

/// Every star of `design`, bottom first, as wide as `prediction` has it close: on the object of radius `object`, or of that at its own
/// height, where that is wider and the inflated star reaches it, else as far as it goes. Lengths in mm. Empty where it is not known how far they close.
pub fn shut(design: &Design, prediction: &Prediction, object: Option<Length>) -> Vec<Star> {
    let stars = design.stars.iter().zip(&prediction.stars);
    let shut = stars.map(|(placed, predicted)| {
        let star = &design.part(placed).star;
        let moves = Mechanism { correction: predicted.correction, ..mechanism(star) };
        let object = object.map(|object| predicted.object_radius_mm.map_or(object, Length));
        let rest = predicted.tip_equilibrium_angle_deg?.to_radians().max(predicted.correction.touch);
        Some(at_angle(star, &moves, held(&moves, rest, object).unwrap_or(rest)))
    });
    shut.collect::<Option<_>>().unwrap_or_default()
}

/// The tips' angle, rad, at which the star touches the object; `None` if at rest it does not.
pub(super) fn held(moves: &Mechanism, rest: f64, object: Option<Length>) -> Option<f64> {
    let rho = object?.metres();
    let widest = moves.widest(rest);
    if rho <= moves.radius(rest).value || rho >= widest.radius {
        return None;
    }
    let beyond = |phi: f64| Ok::<f64, StarFault>(moves.radius(phi).value - rho);
    bracketed_root(rest, widest.angle, 1e-9, beyond).ok()
}

/// The inflated star at the tips' angle `phi`, rad: a coiled hinge keeps the length of its inner arc.
pub(super) fn at_angle(flat: &Star, moves: &Mechanism, phi: f64) -> Star {
    let turn = flat.phi_e - flat.phi_i;
    let coiled = |radius: f64, from: f64, to: f64| radius * (PI - from) / (PI - to);
    let Correction { width, .. } = moves.correction;
    let (w, phi_e) = (width * flat.w, phi + turn);
    let (r_i, r_e) = (coiled(flat.r_i, flat.phi_i, phi), coiled(flat.r_e, flat.phi_e, phi_e));
    let rho_0 = moves.radius(phi).value * 1e3;
    let d_p = rho_0 + w + r_e;
    let (sin, cos) = (0.5 * phi).sin_cos();
    let d_t = d_p * flat.half_sector().cos() - (w + r_i + r_e) * sin + flat.l * cos;
    Star { rho_0, w, phi_i: phi, phi_e, r_i, r_e, d_t, d_p, ..*flat }
}
