//! The two seams of a star: the inner and the outer edge of its tube.

use crate::star_fault::{arms_for_band, blamed};
use crate::{Channel, Part, Refusal, RefusalCode, Side, Star};
use sealed::{Role, Seam};
use spec::units::{Least, Length, Most, Readable};
use spec::{Seal, key};

/// Overrun of an inlet's bands past the cut at full contact, mm, so that the cut edge is sealed to its end.
pub const MOUTH_OVERRUN: f64 = 1.0;

/// The seam on `side` of `star`, opened by `channel` if there is one and the side is the outer one.
///
/// # Errors
/// All reasons for which the band cannot be sealed.
pub(super) fn star_seam(
    star: &Star,
    side: Side,
    channel: Option<&Channel>,
    seal: &Seal,
) -> Result<Seam, Refusal> {
    let half_band = seal.band.0 / 2.0;
    let contour = star.contour(side, half_band, 0.0).ok_or_else(|| hole_closed(star, seal))?;
    if contour.arm <= 0.0 {
        return Err(band_eats_arm(star, side, seal.band));
    }
    let (name, role) = (side.loop_name().to_owned(), Role::Boundary);
    if let (Side::Outside, Some(channel)) = (side, channel) {
        let center_line = channel.open(star, &contour, half_band, 0.0, MOUTH_OVERRUN)?;
        return Ok(Seam { name, role, center_line, overlap: 0.0 });
    }
    // Opposite arms, so that neither start lies near the other's closure.
    let arm = if side == Side::Hole { 1 } else { star.n + 1 };
    let start = contour.middle_of(Part::Arm(arm)).unwrap_or(0.0);
    let center_line = contour.path().starting_at(start);
    let overlap = seal.overlap.0;
    let length = center_line.length();
    if overlap > length / 2.0 {
        let fault = format!("an overlap of {} on a loop of {} mm", seal.overlap, Readable(length));
        let remedy = format!("overlap must be at most half the loop, {} mm", Most(length / 2.0));
        return Err(Refusal::new(key::seal::OVERLAP, RefusalCode::LongOverlap, fault, remedy));
    }
    Ok(Seam { name, role, center_line, overlap })
}

pub(super) fn hole_closed(star: &Star, seal: &Seal) -> Refusal {
    // The value out of line among the three: compared with the defaults, and with the paper's radius.
    let key = blamed([
        (key::star::INNER_RADIUS, 50.0 / star.rho_0),
        (key::seal::BAND, seal.band.0 / 2.0),
        (key::seal::HOLE_ALLOWANCE, seal.hole_allowance.0),
    ]);
    let Seal { band, hole_allowance: flap, .. } = seal;
    let (radius, smallest) = (Readable(star.rho_0), Least(band.0 + flap.0));
    let fault = format!("a band of {band} and a flap of {flap} close the hole of radius {radius} mm");
    let remedy = format!("inner_radius must be above band and hole_allowance together, {smallest} mm");
    Refusal::new(key, RefusalCode::HoleClosed, fault, remedy)
}

fn band_eats_arm(star: &Star, side: Side, band: Length) -> Refusal {
    let (radius, phi, hinge) = match side {
        Side::Hole => (star.r_i, star.phi_i, "tips"),
        Side::Outside => (star.r_e, star.phi_e, "reentrant corners"),
    };
    let (key, remedy) = arms_for_band(&star.spec(), band);
    let [loss, long] = [(band.0 / 2.0 - radius) / libm::tan(phi / 2.0), star.l].map(Readable);
    let fault = format!("at the {hinge} a band of {band} takes {loss} mm of arms that are {long} mm long");
    Refusal::new(key, RefusalCode::BandEatsArm, fault, remedy)
}
