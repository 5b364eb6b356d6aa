//! Moves: a path cut into moves short enough for pausing, progress and arcs that controllers read well.

use std::f64::consts::FRAC_PI_2;

use crate::plan::chop::Chop;
use crate::plan::written::STRAIGHT;
use geom::{Arc, Path, Segment};
use spec::{FeedFloor, Machine, Spec};

/// Longest single move in contact, mm. At 0.1 mm/s it takes 50 s: the most that a pause has to wait for.
pub const LONGEST_MOVE: f64 = 5.0;

/// The largest sagitta of a chord, as a part of the tolerance; rounding takes a tenth at most.
const COARSE: f64 = 0.8;

/// The rules by which paths are cut into moves.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cuts {
    /// Longest move, mm.
    longest: f64,
    /// Largest sagitta of an arc's move, mm, and of one that would else be too short for the controller; `None` where the
    /// machine draws arcs.
    sagitta: Option<[f64; 2]>,
    /// Longest stroke, and the shortest that the controller makes in every direction, mm; `None` without strokes.
    stroke: Option<[f64; 2]>,
}

/// Cuts every segment of `path` into equal moves of at most `longest` mm; arcs also at 90 degrees.
pub fn moves(path: &Path, longest: f64) -> Vec<Segment> {
    Cuts { longest, sagitta: None, stroke: None }.moves(path)
}

impl Cuts {
    /// The cuts of a seal.
    pub(super) fn of_seal(spec: &Spec, machine: &Machine) -> Self {
        let chops = spec.machine.feed_floor == FeedFloor::Chop;
        let chop = Chop::new(spec, machine).filter(|_| chops);
        let stroke = chop.map(|chop| [chop.longest, chop.least]);
        Self { longest: LONGEST_MOVE, stroke, ..Self::of_trace(spec, machine) }
    }

    /// The cuts of a trace. A trace has no dwells, so moves are as long as the segments; arcs are cut at 90 degrees all the same.
    pub(super) fn of_trace(spec: &Spec, machine: &Machine) -> Self {
        // A little shorter than a move that is written as a straight move where there are arcs.
        let path = spec.accuracy.path.0;
        let sagitta = (!machine.controller.arcs).then_some([0.996 * STRAIGHT * path, COARSE * path]);
        Self { longest: f64::INFINITY, sagitta, stroke: None }
    }

    /// The moves of `path`, in order.
    pub(super) fn moves(&self, path: &Path) -> Vec<Segment> {
        let mut moves = Vec::with_capacity(path.segments.len());
        for segment in &path.segments {
            let count = self.count(segment);
            let steps = f64::from(count);
            moves.extend((0..count).map(|i| segment.part(f64::from(i) / steps, f64::from(i + 1) / steps)));
        }
        moves
    }

    /// The number of moves of one segment.
    pub(super) fn count(&self, segment: &Segment) -> u32 {
        let count = ceiling(segment.length() / self.longest);
        match segment {
            Segment::Arc(arc) => self.chords(arc, count),
            Segment::Line(_) => count,
        }
    }

    /// The number of moves of an arc, at least `count`.
    fn chords(&self, arc: &Arc, count: u32) -> u32 {
        let count = count.max(ceiling(arc.sweep.abs() / FRAC_PI_2));
        let Some([fine, coarse]) = self.sagitta else { return count };
        let (length, plain) = (arc.length(), chord_count(arc, fine, count));
        match self.stroke {
            Some([longest, least]) if least > 0.0 && length < 2.0 * least * f64::from(plain) => {
                let room = floor(length / least);
                if length < least * f64::from(plain) {
                    // As many chords to each of the controller's shortest strokes, mostly one.
                    room * chord_count(arc, coarse, count).div_ceil(room)
                } else {
                    plain.max(ceiling(length / longest).min(room))
                }
            }
            _ => plain,
        }
    }
}

/// The number of chords of an arc that leave it by `sagitta` at most; at least `count`.
fn chord_count(arc: &Arc, sagitta: f64, count: u32) -> u32 {
    let angle = libm::acos((1.0 - sagitta / arc.radius).max(-1.0));
    if sagitta < arc.radius { count.max(ceiling(arc.sweep.abs() / (2.0 * angle))) } else { count }
}

/// The number of moves for a ratio: its ceiling, where an excess of rounding does not count.
fn ceiling(ratio: f64) -> u32 {
    number((ratio - 1e-9).ceil())
}

/// The whole number below a ratio, at least 1.
fn floor(ratio: f64) -> u32 {
    number((ratio + 1e-9).floor())
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "path lengths are far below 2^32 moves"
)]
fn number(count: f64) -> u32 {
    count.max(1.0) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use geom::Point;

    /// Six steps at 80 steps/mm and 45 degrees are 0.106 mm: chords are as long, or two go to a stroke.
    #[test]
    fn chords_divide_the_shortest_strokes() {
        let shortest = 6.0 * 2.0_f64.sqrt() / 80.0;
        let cuts = |stroke| Cuts { longest: 5.0, sagitta: Some([0.000_249, 0.000_8]), stroke };
        for (radius, to_each) in [(0.5, 2.0), (1.0, 2.0), (1.7, 2.0), (2.0, 1.0), (6.0, 1.0), (14.0, 1.0)] {
            let arc = Arc::new(Point::ORIGIN, radius, 0.3, 2.0);
            let chord = arc.length() / f64::from(cuts(Some([2.0 / 15.0, shortest])).chords(&arc, 1));
            assert!(chord * chord / (8.0 * radius) < 0.000_8 + 1e-9, "{radius}: {chord}");
            let stroke = to_each * chord;
            assert!(stroke >= shortest && stroke < 1.3 * shortest, "{radius}: {stroke}");
        }
        // Where the steps are fine, or not counted, nothing changes.
        let arc = Arc::new(Point::ORIGIN, 1.0, 0.3, 2.0);
        for shortest in [0.0, 0.01] {
            assert_eq!(cuts(Some([2.0 / 15.0, shortest])).chords(&arc, 1), cuts(None).chords(&arc, 1));
        }
    }
}
