//! Registration holes of a drawn piece: three on the flap, in a pattern that lets it lie in one position only.

use crate::drawn::clearance::Clearance;
use crate::{Circle, DrawnCut, RefusalCode, Warning};
use geom::{Path, Point};
use sealed::{SealedShape, offset_right};
use spec::key;
use spec::units::Length;

/// Places on the flap that are tried.
const PLACES: f64 = 200.0;
/// Least difference of the sides of the holes' triangle, in diameters: smaller ones are not visible.
const DIFFERENCE: f64 = 2.0;

/// The registration holes of a piece of this `shape`, cut along `cut`: three of this `diameter`, or none where the flap has no room or
/// the diameter is 0.
///
/// A hole keeps a band's width from every band, its own radius of fabric to every cut, and out of the way of hoses.
pub(super) fn registration(
    shape: &SealedShape,
    cut: &DrawnCut,
    room: &Clearance<'_>,
    allowance: f64,
    diameter: f64,
) -> Vec<Circle> {
    if diameter <= 0.0 {
        return Vec::new();
    }
    let r = 0.5 * diameter;
    // In the middle of where the hole may lie, on a flap as wide as the allowance.
    let depth = 2.0 * r + 0.5 * (allowance - shape.band - 3.0 * r).max(0.0);
    let lines = offset_right(&cut.outside, -depth);
    let step = lines.iter().map(Path::length).sum::<f64>() / PLACES;
    let places = lines.iter().flat_map(|line| {
        let stations = (0_u32..).map(move |i| (f64::from(i) + 0.5) * step);
        stations.take_while(move |s| *s < line.length()).filter_map(move |s| line.point_at(s))
    });
    let slack = 1e-6;
    let free: Vec<Point> =
        places.filter(|p| room.is_free(*p, shape.band + r - slack, 2.0 * r - slack)).collect();
    let Some(corners) = triangle(&free, DIFFERENCE * diameter) else { return Vec::new() };
    corners.map(|center| Circle { center, diameter }).to_vec()
}

/// Two of `places` that are farthest apart, and a third one such that the sides of the triangle differ most; `None` where they do not
/// differ by `min_difference`. Of equal ones the first: rounding does not decide.
fn triangle(places: &[Point], min_difference: f64) -> Option<[Point; 3]> {
    let (mut ends, mut base) = (None, 0.0);
    for (i, a) in places.iter().enumerate() {
        for b in &places[i + 1..] {
            if is_better(a.distance(*b), base) {
                (ends, base) = (Some([*a, *b]), a.distance(*b));
            }
        }
    }
    let [a, b] = ends?;
    let (mut third, mut largest) = (None, 0.0);
    for c in places {
        let (first_side, other) = (a.distance(*c), b.distance(*c));
        let sides =
            [first_side, other, (first_side - other).abs(), (base - first_side).abs(), (base - other).abs()];
        let difference = sides.into_iter().fold(f64::INFINITY, f64::min);
        if is_better(difference, largest) {
            (third, largest) = (Some(*c), difference);
        }
    }
    third.filter(|_| largest >= min_difference).map(|c| [a, c, b])
}

fn is_better(value: f64, other: f64) -> bool {
    value > other + 1e-6
}

/// The warning where there is no room for registration holes of this diameter.
pub(super) fn no_room(diameter: f64) -> Warning {
    Warning::new(
        key::sheet::HOLE_DIAMETER,
        RefusalCode::NoRoomForHoles,
        format!("the flap has no room for three registration holes of {}", Length(diameter)),
        "write hole_diameter = \"0 mm\" in [sheet] to accept it; a larger allowance makes room",
    )
}
