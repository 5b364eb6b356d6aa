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
    let least = shortest(spec);
    let Some(end) = pieces.last().map(Segment::end) else { return pieces };
    if pieces.iter().all(|piece| piece.length() >= least) {
        return pieces;
    }
    let mut kept: Vec<Segment> = Vec::with_capacity(pieces.len());
    let mut at = pieces[0].start();
    for piece in &pieces {
        // From the last end that was kept, so that many crumbs are a way. Pieces turn by 90 degrees at most: none ends where it began.
        if piece.end().distance(at) >= least {
            kept.push(between(piece, at, piece.end()));
            at = piece.end();
        }
    }
    let Some(last) = kept.pop() else { return pieces };
    kept.push(between(&last, last.start(), end));
    kept
}

/// The piece with other ends, to the bit as it is where they are its own.
fn between(piece: &Segment, start: Point, end: Point) -> Segment {
    if piece.start() == start && piece.end() == end { *piece } else { piece.between(start, end) }
}

/// The reason for which the ramps of `programs` are too steep.
pub(super) fn too_steep(spec: &Spec, machine: &Machine, programs: &[Program]) -> Option<Refusal> {
    let least = |program: &Program| {
        let ramps = program.steps.iter().filter_map(|step| match step {
            Step::TouchDown(ramp) | Step::Lift(ramp) => Some(ramp),
            _ => None,
        });
        ramps.map(|ramp| least_move(ramp, program.pace)).fold(f64::INFINITY, f64::min)
    };
    let (found, needed) = (programs.iter().map(least).fold(f64::INFINITY, f64::min), shortest(spec));
    if found >= needed {
        return None;
    }
    let ramp = machine.process.ramp;
    Some(Refusal::new(
        key::machine::PROFILE,
        RefusalCode::SteepRamp,
        format!("on the profile's ramp of {ramp} the iron moves {found:.6} mm along the fabric at a time"),
        format!("a ramp of at least {} mm is needed", Least(ramp.0 * needed / found)),
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
        let spec = spec();
        let least = shortest(&spec);
        let c = 0.4 * least;
        let mut ramp =
            chain(&[(-c, 0.0), (0.0, 0.0), (2.0, 0.0), (2.0, c), (2.0, 2.0 * c), (2.0, 3.0 * c), (2.0, 3.0)]);
        ramp.push(Arc::new(Point::new(1.0, 3.0), 1.0, 0.0, 1.5).into());
        let at = ramp[6].end();
        ramp.push(Line::new(at, Point::new(at.x, at.y + c)).into());
        let kept = without_crumbs(ramp.clone(), &spec);
        assert_eq!(kept.len(), 4, "{kept:?}");
        assert!(kept.iter().all(|piece| piece.length() >= least));
        assert!(kept.windows(2).all(|pair| pair[0].end().distance(pair[1].start()) < 1e-12));
        assert!(
            kept[0].start().distance(ramp[0].start()) < 1e-12
                && kept[3].end().distance(ramp[7].end()) < 1e-12
        );
        let way = |pieces: &[Segment], t: f64| {
            pieces.iter().map(|piece| piece.distance(Point::new(2.0, t))).fold(f64::INFINITY, f64::min)
        };
        assert!(way(&kept, 1.5) < least);
    }

    #[test]
    fn what_has_no_crumbs_stays_as_it_is_and_one_crumb_alone_too() {
        let spec = spec();
        let ramp = chain(&[(0.0, 0.0), (0.01, 0.0), (3.0, 1.0)]);
        assert_eq!(without_crumbs(ramp.clone(), &spec), ramp);
        let short = chain(&[(0.0, 0.0), (1e-5, 0.0)]);
        assert_eq!(without_crumbs(short.clone(), &spec), short);
    }
}
