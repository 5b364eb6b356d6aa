//! Clamps: places that the iron must not enter.

use crate::design::{Refusal, RefusalCode};
use crate::geom::{Bounds, Line, Point, Segment, segment_distance};
use crate::plan::lowest_feed::contact;
use crate::plan::{Program, Step};
use crate::spec::{KeepOut, Machine, Spec, key};

/// The sides of a clamp, counterclockwise.
fn sides(zone: &KeepOut) -> [Segment; 4] {
    let (a, c) = (corner(zone), Point::new(zone.x.0 + zone.width.0, zone.y.0 + zone.depth.0));
    let (b, d) = (Point::new(c.x, a.y), Point::new(a.x, c.y));
    [(a, b), (b, c), (c, d), (d, a)].map(|(from, to)| Line::new(from, to).into())
}

fn corner(zone: &KeepOut) -> Point {
    Point::new(zone.x.0, zone.y.0)
}

/// Distance from a path to a clamp; 0 inside.
fn distance(zone: &KeepOut, piece: &Segment) -> f64 {
    let size = Point::new(zone.x.0 + zone.width.0, zone.y.0 + zone.depth.0);
    if (Bounds { min: corner(zone), max: size }).contains(piece.start()) {
        return 0.0;
    }
    sides(zone).iter().map(|side| segment_distance(side, piece)).fold(f64::INFINITY, f64::min)
}

pub(super) fn clamp_in_the_way(
    spec: &Spec,
    machine: &Machine,
    programs: &[Program],
    zone: &KeepOut,
) -> Option<Refusal> {
    let half_band = spec.seal.band.0 / 2.0;
    let passes = zone.height.is_some_and(|height| height.0 < machine.process.heights.travel.0);
    let refusal = |what: &str, program: &Program| {
        let stars: Vec<String> = program.stars.iter().map(ToString::to_string).collect();
        let piece = program.piece.clone().unwrap_or_else(|| format!("star {}", stars.join(", ")));
        Refusal::new(
            key::machine::PROFILE,
            RefusalCode::ClampInTheWay,
            format!("{what} of {piece} meets the clamp {:?}", zone.name),
            "move the clamp; give its height, if it is below travel height; or change [sheet]".to_owned(),
        )
    };
    for program in programs {
        if contact(&program.steps).any(|(piece, _)| distance(zone, piece) <= half_band) {
            return Some(refusal("the seal", program));
        }
        let mut at: Option<Point> = None;
        for step in &program.steps {
            if let (Step::Trace(pieces), false) = (step, passes)
                && pieces.iter().any(|piece| distance(zone, piece) <= 0.0)
            {
                return Some(refusal("the trace", program));
            }
            if let (Step::Travel(to), Some(from), false) = (step, at, passes)
                && from != *to
                && distance(zone, &Line::new(from, *to).into()) <= half_band
            {
                return Some(refusal("the way to or from a seam", program));
            }
            at = match step {
                Step::Travel(to) => Some(*to),
                Step::Lift(ramp) => ramp.pieces.last().map(Segment::end),
                Step::Trace(pieces) => pieces.last().map(Segment::end),
                _ => at,
            };
        }
    }
    None
}
