//! Ramps on which a move has no length in the plane: the iron would go straight down. Crumbs of a path are left out, short ramps refused.

use crate::plan::{Pace, Program, Ramp, Step};
use design::{Refusal, RefusalCode};
use geom::{Point, Segment};
use spec::units::Least;
use spec::{Machine, Spec, key};

/// Shortest way in the plane, mm, of a move on a ramp: a program can express two places that are a fifth of the tolerance from
/// each other, and 0.002 mm, whatever the tolerance.
fn shortest(spec: &Spec) -> f64 {
    (0.2 * spec.accuracy.path.0).clamp(2e-6, 2e-3)
}

/// The pieces of a ramp without **crumbs**: pieces whose start and end are the same in a program. The piece after a crumb begins
/// where the one before it ends, so the way moves by less than a crumb; start and end of the ramp do not change.
pub(super) fn without_crumbs(pieces: Vec<Segment>, spec: &Spec) -> Vec<Segment> {
    let limit = shortest(spec);
    let Some(end) = pieces.last().map(Segment::end) else { return pieces };
    if pieces.iter().all(|piece| piece.length() >= limit) {
        return pieces;
    }
    let mut long_enough: Vec<Segment> = Vec::with_capacity(pieces.len());
    let mut end_so_far = pieces[0].start();
    for piece in &pieces {
        // From the last end that was kept, so that many crumbs are a way. Pieces turn by 90 degrees at most: none ends where it began.
        if piece.end().distance(end_so_far) >= limit {
            long_enough.push(with_ends(piece, end_so_far, piece.end()));
            end_so_far = piece.end();
        }
    }
    let Some(last) = long_enough.pop() else { return pieces };
    long_enough.push(with_ends(&last, last.start(), end));
    long_enough
}

/// The piece with other ends, to the bit as it is where they are its own.
fn with_ends(piece: &Segment, start: Point, end: Point) -> Segment {
    if piece.start() == start && piece.end() == end { *piece } else { piece.with_ends(start, end) }
}

/// The reason for which the ramps of `programs` are too steep.
pub(super) fn too_steep(spec: &Spec, machine: &Machine, programs: &[Program]) -> Option<Refusal> {
    let shortest_of = |program: &Program| {
        let ramps = program.steps.iter().filter_map(Step::ramp);
        // The longest strokes decide nothing here: those of any process are as short.
        let paces = program.processes.iter().map(|paced| paced.pace);
        let shortest_with =
            |pace: Pace| ramps.clone().map(|ramp| least_move(ramp, pace)).fold(f64::INFINITY, f64::min);
        paces.map(shortest_with).fold(f64::INFINITY, f64::min)
    };
    let (shortest_part, limit) =
        (programs.iter().map(shortest_of).fold(f64::INFINITY, f64::min), shortest(spec));
    if shortest_part >= limit {
        return None;
    }
    let ramp = machine.process.ramp;
    Some(Refusal::new(
        key::machine::PROFILE,
        RefusalCode::SteepRamp,
        format!(
            "on the profile's ramp of {ramp} the iron moves {shortest_part:.6} mm along the fabric at a time"
        ),
        format!("a ramp of at least {} mm is needed", Least(ramp.0 * limit / shortest_part)),
    ))
}

/// The shortest way in the plane of a move on `ramp`, mm.
fn least_move(ramp: &Ramp, pace: Pace) -> f64 {
    let of_piece = |(piece, from, to): (&Segment, f64, f64)| {
        let flat = piece.length();
        match pace {
            Pace::Steady => flat,
            Pace::Chopped(chop) => flat / chop.strokes(libm::hypot(flat, to - from)),
        }
    };
    ramp.with_heights().map(of_piece).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use geom::{Arc, Line};
    use spec::{Source, read};

    fn spec() -> Spec {
        let text = include_str!("../../../../designs/paper-gripper.toml");
        read(&Source::new("x", text)).unwrap_or_else(|faults| panic!("{faults}")).spec
    }

    fn chain(corners: &[(f64, f64)]) -> Vec<Segment> {
        let points: Vec<Point> = corners.iter().map(|(x, y)| Point::new(*x, *y)).collect();
        points.windows(2).map(|ends| Line::new(ends[0], ends[1]).into()).collect()
    }

    /// Crumbs at the start, one after another in the middle, and at the end: the ramp begins and ends where it did.
    #[test]
    fn crumbs_are_left_out_and_the_ends_stay() {
        let design_spec = spec();
        let limit = shortest(&design_spec);
        let c = 0.4 * limit;
        let mut ramp =
            chain(&[(-c, 0.0), (0.0, 0.0), (2.0, 0.0), (2.0, c), (2.0, 2.0 * c), (2.0, 3.0 * c), (2.0, 3.0)]);
        ramp.push(Arc::new(Point::new(1.0, 3.0), 1.0, 0.0, 1.5).into());
        let end = ramp[6].end();
        ramp.push(Line::new(end, Point::new(end.x, end.y + c)).into());
        let pieces = without_crumbs(ramp.clone(), &design_spec);
        assert_eq!(pieces.len(), 4, "{pieces:?}");
        assert!(pieces.iter().all(|piece| piece.length() >= limit));
        assert!(pieces.windows(2).all(|pair| pair[0].end().distance(pair[1].start()) < 1e-12));
        assert!(
            pieces[0].start().distance(ramp[0].start()) < 1e-12
                && pieces[3].end().distance(ramp[7].end()) < 1e-12
        );
        assert!(way_to(&pieces, 1.5) < limit);
    }

    fn way_to(pieces: &[Segment], t: f64) -> f64 {
        pieces.iter().map(|piece| piece.distance(Point::new(2.0, t))).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn what_has_no_crumbs_stays_as_it_is_and_one_crumb_alone_too() {
        let design_spec = spec();
        let ramp = chain(&[(0.0, 0.0), (0.01, 0.0), (3.0, 1.0)]);
        assert_eq!(without_crumbs(ramp.clone(), &design_spec), ramp);
        let short = chain(&[(0.0, 0.0), (1e-5, 0.0)]);
        assert_eq!(without_crumbs(short.clone(), &design_spec), short);
    }
}
