//! Registration holes: one pattern that lets a part lie in one position only.
//!
//! Three holes beside the tips' arcs: one on the ray of the tip after the first, one on the same tip
//! turned by up to 40 degrees, one on the ray of a tip across the star. The triangle is scalene for
//! every n: its short side is a chord of one tip's arc, and the third hole lies off that chord's
//! bisector by at least the sine of half the turn times the star's diameter.

use crate::{Refusal, RefusalCode, Star};
use geom::{Arc, Point, Segment, Vec2};
use spec::units::{Length, Readable};
use spec::{Seal, key};

/// Turn of the second hole, rad: 40 degrees, well inside the 150-degree arcs of the paper's tips and far from a mirror image.
const TURN: f64 = 40.0 * std::f64::consts::PI / 180.0;

/// The place of one hole, in polar coordinates around its tip's centre T.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Site {
    /// The tip.
    pub(super) tip: u32,
    /// Direction against the tip's ray, rad.
    turn: f64,
    /// Distance from T.
    radius: f64,
    /// Radius of the ear around the hole; `None` where the flap is wide enough.
    ear: Option<f64>,
}

/// The point where an ear leaves the tip's arc.
struct Root {
    /// Half the angle that the ear takes of the arc, seen from T.
    beta: f64,
    /// Half the angle of the ear's own arc, seen from its hole.
    foot: f64,
}

impl Site {
    pub(super) fn center(&self, star: &Star) -> Point {
        star.tip_center(self.tip) + Vec2::unit(star.tip_ray(self.tip) + self.turn) * self.radius
    }

    /// The root of an ear of radius `ear` on the arc of radius `rim`: law of cosines.
    fn root(&self, ear: f64, rim: f64) -> Root {
        let c = self.radius;
        let beta = libm::acos(((rim * rim + c * c - ear * ear) / (2.0 * rim * c)).clamp(-1.0, 1.0));
        Root { beta, foot: Vec2::new(rim * libm::cos(beta) - c, rim * libm::sin(beta)).angle() }
    }

    /// Area that the site's ear, if it has one, adds to the region inside the arc of radius `rim`.
    pub(super) fn ear_area(&self, rim: f64) -> f64 {
        let Some(ear) = self.ear else { return 0.0 };
        let Root { beta, foot } = self.root(ear, rim);
        // The ear's sector and the kite between the two centres, without the arc's own sector.
        ear * ear * foot + self.radius * rim * libm::sin(beta) - rim * rim * beta
    }
}

/// The three sites beside the arcs of the tips' flap, of which each turns by `half` to either side of its ray.
///
/// A hole keeps a band's width from the seal and its own radius of fabric to the cut.
///
/// # Errors
/// If the tips' arcs have no room for them.
pub(super) fn sites(
    star: &Star,
    half: f64,
    first: u32,
    seal: &Seal,
    diameter: f64,
) -> Result<[Site; 3], Refusal> {
    let r = diameter / 2.0;
    let nearest = star.r_i + star.w + 2.0 * seal.band.0 + r;
    let cut = star.r_i + star.w + seal.band.0 + seal.allowance.0;
    let (radius, ear) = if nearest <= cut - 2.0 * r {
        (0.5 * (nearest + cut - 2.0 * r), None)
    } else {
        // The ear reaches at least a hole's radius into the flap, so that it hangs on firmly.
        (nearest, Some((2.0 * r).max(nearest - cut + r)))
    };
    let [neighbour, opposite] = [first, first + star.n / 2].map(|k| k % star.n + 1);
    let round = ear.unwrap_or(2.0 * r);
    let reach = libm::asin((round / radius).min(1.0));
    let turn = TURN.min(half - 1.1 * reach);
    if turn * radius < 2.0 * round {
        let (hole, arc) = (Length(diameter), Readable(half * radius));
        let needed_room = Readable(radius * 2.2 * reach + 2.0 * round);
        return Err(Refusal::new(
            key::sheet::HOLE_DIAMETER,
            RefusalCode::NoRoomForHoles,
            format!("two holes of {hole} side by side need {needed_room} mm of a tip's arc of {arc} mm"),
            "make hole_diameter smaller, or \"0 mm\" for no registration holes",
        ));
    }
    let site = Site { tip: neighbour, turn: 0.0, radius, ear };
    Ok([site, Site { turn, ..site }, Site { tip: opposite, ..site }])
}

/// The tip's arc `segment` with an ear around every hole of `sites` that needs one.
pub(super) fn with_ears<'a>(segment: Segment, sites: impl Iterator<Item = &'a Site>) -> Vec<Segment> {
    let Segment::Arc(arc) = segment else { return vec![segment] };
    let ray = arc.start_angle + arc.sweep / 2.0;
    let mut pieces = Vec::new();
    let mut angle = arc.start_angle;
    for site in sites {
        let Some(ear) = site.ear else { continue };
        let Root { beta, foot } = site.root(ear, arc.radius);
        let direction = ray + site.turn;
        let center = arc.center + Vec2::unit(direction) * site.radius;
        pieces.push(Arc::new(arc.center, arc.radius, angle, direction - beta - angle).into());
        pieces.push(Arc::new(center, ear, direction - foot, 2.0 * foot).into());
        angle = direction + beta;
    }
    pieces.push(Arc::new(arc.center, arc.radius, angle, arc.end_angle() - angle).into());
    pieces
}
