//! Seams: what the iron travels on one star, in contact.

use crate::design::star_fault::blamed;
use crate::design::{Channel, Part, Refusal, RefusalCode, Side, Star};
use crate::geom::{Line, Path};
use crate::spec::{Seal, key};
use crate::units::{Least, Most, Readable};

/// How far the bands of an inlet run past the cut at full contact, mm, so that the cut edge is sealed to its end.
pub const MOUTH_OVERRUN: f64 = 1.0;

/// One seam: the centre line of a band.
#[derive(Clone, Debug, PartialEq)]
pub struct Seam {
    /// Which edge of the tube it makes.
    pub side: Side,
    /// The band's centre line: closed and beginning at its start in the middle of an arm, or, where the
    /// inlet opens it, open from mouth to mouth.
    pub center_line: Path,
    /// Path covered twice where the loop closes; 0 for an open one.
    pub overlap: f64,
}

impl Seam {
    /// The seam on `side` of `star`, opened by `channel` if there is one and the side is the outer one.
    ///
    /// # Errors
    /// All reasons for which the band cannot be sealed.
    pub fn new(star: &Star, side: Side, channel: Option<&Channel>, seal: &Seal) -> Result<Self, Refusal> {
        let half_band = seal.band.0 / 2.0;
        let contour = star.contour(side, half_band, 0.0).ok_or_else(|| hole_closed(star, seal))?;
        if contour.arm <= 0.0 {
            return Err(band_eats_arm(star, side, seal));
        }
        if let (Side::Outside, Some(channel)) = (side, channel) {
            let center_line = channel.open(star, &contour, half_band, 0.0, MOUTH_OVERRUN)?;
            return Ok(Self { side, center_line, overlap: 0.0 });
        }
        // Opposite arms, so that neither start lies near the other's closure.
        let arm = if side == Side::Hole { 1 } else { star.n + 1 };
        let start = contour.middle_of(Part::Arm(arm)).unwrap_or(0.0);
        let center_line = contour.path().starting_at(start);
        let overlap = seal.overlap.0;
        let length = center_line.length();
        if overlap > length / 2.0 {
            return Err(Refusal::new(
                key::seal::OVERLAP,
                RefusalCode::LongOverlap,
                format!("an overlap of {} on a loop of {} mm", seal.overlap, Readable(length)),
                format!("overlap must be at most half the loop, {} mm", Most(length / 2.0)),
            ));
        }
        Ok(Self { side, center_line, overlap })
    }

    /// What the iron covers in contact: the loop and its overlap.
    pub fn run(&self) -> Path {
        if self.center_line.closed {
            self.center_line.part(0.0, self.center_line.length() + self.overlap)
        } else {
            self.center_line.clone()
        }
    }

    /// The path of `length` on which the iron goes down before the run: along the loop, or straight on outside the mouth.
    pub fn lead_in(&self, length: f64) -> Path {
        if self.center_line.closed {
            return self.center_line.part(-length, 0.0);
        }
        straight_in(&self.center_line, length)
    }

    /// The path of `length` on which the iron goes up after the run.
    pub fn lead_out(&self, length: f64) -> Path {
        if self.center_line.closed {
            return self.center_line.part(self.overlap, self.overlap + length);
        }
        straight_out(&self.center_line, length)
    }
}

/// The straight way of `length` that ends where the open `path` begins.
pub(super) fn straight_in(path: &Path, length: f64) -> Path {
    let (Some(start), Some(tangent)) = (path.start(), path.tangent_at(0.0)) else { return Path::default() };
    Path::open(vec![Line::new(start - tangent * length, start).into()])
}

/// The straight way of `length` that goes on where the open `path` ends.
pub(super) fn straight_out(path: &Path, length: f64) -> Path {
    let (Some(end), Some(tangent)) = (path.end(), path.tangent_at(path.length())) else {
        return Path::default();
    };
    Path::open(vec![Line::new(end, end + tangent * length).into()])
}

pub(super) fn hole_closed(star: &Star, seal: &Seal) -> Refusal {
    // Which of the three is out of line: compared with the defaults, and with the paper's radius.
    let key = blamed([
        (key::star::INNER_RADIUS, 50.0 / star.rho_0),
        (key::seal::BAND, seal.band.0 / 2.0),
        (key::seal::HOLE_ALLOWANCE, seal.hole_allowance.0),
    ]);
    Refusal::new(
        key,
        RefusalCode::HoleClosed,
        format!(
            "a band of {} and a flap of {} close the hole of radius {} mm",
            seal.band,
            seal.hole_allowance,
            Readable(star.rho_0)
        ),
        format!(
            "inner_radius must be above band and hole_allowance together, {} mm",
            Least(seal.band.0 + seal.hole_allowance.0)
        ),
    )
}

fn band_eats_arm(star: &Star, side: Side, seal: &Seal) -> Refusal {
    let (radius, phi, hinge, key) = match side {
        Side::Hole => (star.r_i, star.phi_i, "tips", "tip_radius"),
        Side::Outside => (star.r_e, star.phi_e, "reentrant corners", "corner_radius"),
    };
    let eaten = (seal.band.0 / 2.0 - radius) / (phi / 2.0).tan();
    let widest = 2.0 * (radius + star.l * (phi / 2.0).tan());
    Refusal::new(
        key::seal::BAND,
        RefusalCode::BandEatsArm,
        format!(
            "at the {hinge} a band of {} takes {} mm of arms that are {} mm long",
            seal.band,
            Readable(eaten),
            Readable(star.l)
        ),
        format!("band must be below {} mm, or {key} larger", Most(widest)),
    )
}
