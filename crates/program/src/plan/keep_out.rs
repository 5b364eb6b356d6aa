//! Clamps: places that the iron must not enter.

use crate::plan::lowest_feed::contact as contact_pieces;
use crate::plan::{Program, Purpose, Step};
use design::{Refusal, RefusalCode};
use geom::{Bounds, BoxIndex, Line, Point, Segment, Vec2, box_distance};
use sealed::PieceName;
use spec::{KeepOut, Machine, Spec, key};

/// The rectangle of a clamp.
pub fn clamp_bounds(clamp: &KeepOut) -> Bounds {
    let min = Point::new(clamp.x.0, clamp.y.0);
    Bounds { min, max: min + Vec2::new(clamp.width.0, clamp.depth.0) }
}

/// A way of the iron, and how near to it no clamp may be.
struct Way<'a> {
    subject: &'static str,
    program: &'a Program,
    piece: Segment,
    /// The piece's box, grown by the reach.
    reach_box: Bounds,
    reach: f64,
    /// Whether the iron is down, so that it cannot pass above a clamp.
    is_down: bool,
}

impl<'a> Way<'a> {
    /// The way along `piece`, to which no clamp may be nearer than `reach`.
    fn new(program: &'a Program, subject: &'static str, piece: Segment, reach: f64, is_down: bool) -> Self {
        let reach_box = piece.bounds().outset(reach);
        Self { subject, program, piece, reach_box, reach, is_down }
    }
}

/// The reasons why the seals, or else the traces, cannot be run between the clamps of `machine`: one reason a clamp, that of the
/// first way that it meets.
pub(super) fn clamps_in_the_way(
    spec: &Spec,
    machine: &Machine,
    seals: &[Program],
    traces: &[Program],
) -> Vec<Refusal> {
    if machine.bench.keep_out.is_empty() {
        return Vec::new();
    }
    let reach = spec.seal.band.0 / 2.0;
    let ways: Vec<Way<'_>> = seals.iter().chain(traces).flat_map(|program| ways(program, reach)).collect();
    let index = BoxIndex::new(ways.iter().map(|way| way.reach_box));
    let refusal = |clamp: &KeepOut| {
        let is_below_travel = clamp.height.is_some_and(|height| height.0 < machine.process.heights.travel.0);
        let place = clamp_bounds(clamp);
        let candidates = index.overlapping(&place);
        let mut collisions = candidates
            .into_iter()
            .map(|number| &ways[number])
            .filter(|way| (way.is_down || !is_below_travel) && box_distance(&place, &way.piece) <= way.reach);
        let first = collisions.next()?;
        // A way with the iron down meets the clamp whatever its height.
        let collision =
            if first.is_down { first } else { collisions.find(|way| way.is_down).unwrap_or(first) };
        let piece = listed(&collision.program.pieces);
        let travel = machine.process.heights.travel;
        let height_remedy = match clamp.height {
            _ if collision.is_down => String::new(),
            None => format!("; give its height, if it is below the travel height of {travel}"),
            Some(height) if machine.process.heights.park <= height => {
                format!("; or raise the travel height above {height}, and the park height above that")
            }
            Some(height) => format!("; or raise the travel height above {height}"),
        };
        let sheet_remedy = if collision.program.pieces.is_empty() { "" } else { "; or change [sheet]" };
        let meeting_point = collision.piece.point(collision.piece.nearest_fraction(place.center()));
        Some(Refusal::new(
            key::machine::PROFILE,
            RefusalCode::ClampInTheWay,
            format!(
                "{} of {piece} meets the clamp {:?} at X {:.1} Y {:.1} mm",
                collision.subject, clamp.name, meeting_point.x, meeting_point.y
            ),
            format!("move the clamp{height_remedy}{sheet_remedy}"),
        ))
    };
    machine.bench.keep_out.iter().filter_map(refusal).collect()
}

/// The pieces in words: "stars 1, 2", "disc"; without pieces it is a feed check.
fn listed(pieces: &[PieceName]) -> String {
    let numbers: Vec<String> =
        pieces.iter().filter_map(PieceName::number).map(|number| number.to_string()).collect();
    match pieces {
        [first, _, ..] if numbers.len() > 1 => format!("{}s {}", first.kind(), numbers.join(", ")),
        [first, ..] => first.to_string(),
        [] => "the feed check".to_owned(),
    }
}

/// The ways of a program, from X0 Y0 on: contacts first, as a clamp in a seal's way is best reported as such.
fn ways(program: &Program, reach: f64) -> Vec<Way<'_>> {
    let followed = |piece: &Segment| match program.purpose {
        Purpose::Seal => Way::new(program, "the seal", *piece, reach, true),
        Purpose::Trace => Way::new(program, "the trace", *piece, 0.0, false),
        Purpose::Cut => Way::new(program, "the cut", *piece, reach, true),
    };
    let mut ways: Vec<Way<'_>> = contact_pieces(&program.steps).map(|(piece, _)| followed(piece)).collect();
    let mut position = Point::ORIGIN;
    for step in &program.steps {
        match step {
            Step::Trace(pieces) => ways.extend(pieces.iter().map(followed)),
            Step::Travel(to) if position != *to => {
                let line = Line::new(position, *to).into();
                ways.push(Way::new(program, "the way to or from a seam", line, reach, false));
            }
            Step::Height(_)
            | Step::Heat(_)
            | Step::Pause(_)
            | Step::Cool(_)
            | Step::Travel(_)
            | Step::Seam(_)
            | Step::TouchDown(_)
            | Step::Seal(_)
            | Step::Lift(_) => {}
        }
        position = step.end().unwrap_or(position);
    }
    ways
}
