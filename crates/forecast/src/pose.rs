//! The shape of an inflated star, a [`PosedStar`]: for all pictures, flat or in three dimensions, and for their checks.
//!
//! It is the mechanism of the prediction: arms stay straight and as long as they are, the tube is everywhere as wide as the prediction has
//! it between the centres of a tip's and a corner's arc, and a coiled hinge keeps the length of its inner arc.

use std::f64::consts::PI;

use crate::case::mechanism;
use crate::prediction::{Prediction, StarPrediction};
use design::{Design, Side, Star};
use geom::Path;
use inflatable::mechanics::fault::StarFault;
use inflatable::mechanics::star::{Correction, Mechanism};
use inflatable::numerics::bracketed_root;
use serde::Serialize;
use spec::Spec;
use spec::units::Length;

/// A star in a pose, flat or inflated: its tube lies between r and r + w around the centres of tips and corners. Lengths in mm, angles in
/// rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PosedStar {
    /// Number of points.
    pub points: u32,
    /// Inner radius.
    pub inner_radius: f64,
    /// Width of the tube in plan view.
    pub width: f64,
    /// Angle between the arms of a tip.
    pub tip_angle: f64,
    /// Angle between the arms of a corner.
    pub corner_angle: f64,
    /// Inner radius of curvature of the tips.
    pub tip_radius: f64,
    /// Inner radius of curvature of the corners.
    pub corner_radius: f64,
    /// Length of an arm.
    pub arm: f64,
    /// Distance of a tip's centre from the axis.
    pub tip_centre: f64,
    /// Distance of a corner's centre from the axis.
    pub corner_centre: f64,
}

impl PosedStar {
    /// The star as it is cut.
    pub fn flat(star: &Star) -> Self {
        Self {
            points: star.n,
            inner_radius: star.rho_0,
            width: star.w,
            tip_angle: star.phi_i,
            corner_angle: star.phi_e,
            tip_radius: star.r_i,
            corner_radius: star.r_e,
            arm: star.l,
            tip_centre: star.d_t,
            corner_centre: star.d_p,
        }
    }

    /// Half the angle from one tip's ray to the next.
    pub fn half_sector(&self) -> f64 {
        PI / f64::from(self.points)
    }

    /// The edges of the tube: towards the hole and outside; an edge that leaves nothing is absent.
    pub fn edges(&self) -> Vec<Path> {
        // A contour needs no more than centres and radii, which a flat star of these dimensions would have.
        let star = Star {
            n: self.points,
            rho_0: self.inner_radius,
            w: self.width,
            phi_i: self.tip_angle,
            phi_e: self.corner_angle,
            r_i: self.tip_radius,
            r_e: self.corner_radius,
            l: self.arm,
            d_t: self.tip_centre,
            d_p: self.corner_centre,
        };
        let edge = |side| Some(star.contour(side, 0.0, 0.0)?.path());
        [Side::Hole, Side::Outside].into_iter().filter_map(edge).collect()
    }
}

/// The dimensions of a posed star as an answer has them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct Pose {
    /// Inner radius.
    pub inner_radius_mm: f64,
    /// Width of the tube in plan view.
    pub width_mm: f64,
    /// Angle between the arms of a tip.
    pub tip_angle_deg: f64,
    /// Inner radius of curvature of the tips.
    pub tip_radius_mm: f64,
    /// Inner radius of curvature of the corners.
    pub corner_radius_mm: f64,
    /// Distance of a tip's centre from the axis.
    pub tip_centre_mm: f64,
    /// Distance of a corner's centre from the axis.
    pub corner_centre_mm: f64,
}

impl Pose {
    /// The dimensions of `star`.
    pub fn new(star: &PosedStar) -> Self {
        Self {
            inner_radius_mm: star.inner_radius,
            width_mm: star.width,
            tip_angle_deg: star.tip_angle.to_degrees(),
            tip_radius_mm: star.tip_radius,
            corner_radius_mm: star.corner_radius,
            tip_centre_mm: star.tip_centre,
            corner_centre_mm: star.corner_centre,
        }
    }
}

/// Every star of `design`, made from `spec`, bottom first, as wide as `prediction` closes it: on the spec's object where that is wider
/// and within reach, else closed fully. Lengths in mm. Empty if the closing of any star is unknown.
pub fn inflated(spec: &Spec, design: &Design, prediction: Option<&Prediction>) -> Vec<PosedStar> {
    let object = spec.load.as_ref().and_then(|load| load.object_radius);
    let predicted = prediction.map_or(&[][..], |prediction| &prediction.stars);
    let Some(design) = design.assembly() else { return Vec::new() };
    let stars = design.stars.iter().zip(predicted);
    let inflated = stars.map(|(placed, predicted)| closed(&design.part(placed).star, predicted, object));
    inflated.collect::<Option<_>>().unwrap_or_default()
}

fn closed(star: &Star, predicted: &StarPrediction, object: Option<Length>) -> Option<PosedStar> {
    let moves = Mechanism { correction: predicted.correction, ..mechanism(star) };
    // A ball is thinner beside its middle.
    let object = object.map(|object| predicted.object_radius_mm.map_or(object, Length));
    let rest = predicted.tip_equilibrium_angle_deg?.to_radians().max(predicted.correction.contact_angle);
    Some(at_angle(star, &moves, holding_angle(&moves, rest, object).unwrap_or(rest)))
}

/// The tips' angle, rad, at which the star touches the object; `None` if at rest it does not.
pub(super) fn holding_angle(moves: &Mechanism, rest: f64, object: Option<Length>) -> Option<f64> {
    let rho = object?.metres();
    let widest = moves.widest(rest);
    if rho <= moves.radius(rest).value || rho >= widest.radius {
        return None;
    }
    let excess = |phi: f64| Ok::<f64, StarFault>(moves.radius(phi).value - rho);
    bracketed_root(rest, widest.angle, 1e-9, excess).ok()
}

/// The star `flat`, inflated with the mechanism `moves`, at the tips' angle `phi`, rad; lengths in mm.
pub fn at_angle(flat: &Star, moves: &Mechanism, phi: f64) -> PosedStar {
    let turn = flat.phi_e - flat.phi_i;
    let Correction { width, .. } = moves.correction;
    let (w, phi_e) = (width * flat.w, phi + turn);
    // An inner rim keeps its length.
    let [r_i, r_e] = [(flat.r_i, flat.phi_i, phi), (flat.r_e, flat.phi_e, phi_e)]
        .map(|(radius, flat_angle, angle)| radius * (PI - flat_angle) / (PI - angle));
    let rho_0 = moves.radius(phi).value * 1e3;
    let d_p = rho_0 + w + r_e;
    let (sin, cos) = libm::sincos(0.5 * phi);
    // From the tip's ray to the start of the arm. A corner's rim lies further out than its coiling gives; the arm keeps its length.
    let (sine, cosine) = libm::sincos(flat.half_sector());
    let offset = d_p * sine - (w + r_i + r_e) * cos;
    let reach = (flat.l.powi(2) - offset.powi(2)).max(0.0).sqrt();
    let d_t = d_p * cosine - (w + r_i + r_e) * sin + reach;
    PosedStar {
        inner_radius: rho_0,
        width: w,
        tip_angle: phi,
        corner_angle: phi_e,
        tip_radius: r_i,
        corner_radius: r_e,
        tip_centre: d_t,
        corner_centre: d_p,
        ..PosedStar::flat(flat)
    }
}
