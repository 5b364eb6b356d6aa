//! Pieces: a path cut into moves short enough for pausing, progress and arcs that controllers read well.

use std::f64::consts::FRAC_PI_2;

use crate::geom::{Path, Segment};
use crate::spec::{Machine, Spec};

/// Longest single move in contact, mm. At 0.1 mm/s it takes 50 s: the most that a pause has to wait for.
pub const LONGEST_MOVE: f64 = 5.0;

/// Cuts every segment of `path` into equal pieces of at most `longest` mm; arcs also at 90 degrees.
pub fn pieces(path: &Path, longest: f64) -> Vec<Segment> {
    flat_pieces(path, longest, None)
}

/// The same; with a `sagitta`, arcs are cut so often that each piece is no farther than that from its chord.
pub(super) fn flat_pieces(path: &Path, longest: f64, sagitta: Option<f64>) -> Vec<Segment> {
    let mut out = Vec::with_capacity(path.segments.len());
    for segment in &path.segments {
        let count = count(segment, longest, sagitta);
        let steps = f64::from(count);
        out.extend((0..count).map(|i| segment.part(f64::from(i) / steps, f64::from(i + 1) / steps)));
    }
    out
}

/// The number of pieces that [`flat_pieces`] makes of one segment.
pub(super) fn count(segment: &Segment, longest: f64, sagitta: Option<f64>) -> u32 {
    let mut count = whole(segment.length() / longest);
    if let Segment::Arc(arc) = segment {
        count = count.max(whole(arc.sweep.abs() / FRAC_PI_2));
        if let Some(sagitta) = sagitta.filter(|sagitta| *sagitta < arc.radius) {
            count = count.max(whole(arc.sweep.abs() / (2.0 * (1.0 - sagitta / arc.radius).acos())));
        }
    }
    count
}

/// The number of pieces for a ratio: its ceiling, where an excess of rounding does not count.
fn whole(ratio: f64) -> u32 {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "path lengths are far below 2^32 moves"
    )]
    let count = (ratio - 1e-9).ceil().max(1.0) as u32;
    count
}

/// The moves of a seal along `path` on `machine`.
pub fn seal_pieces(spec: &Spec, machine: &Machine, path: &Path) -> Vec<Segment> {
    flat_pieces(path, LONGEST_MOVE, sagitta(spec, machine))
}

/// The largest sagitta of a piece for `machine`: none where it draws arcs, else what the writers take for straight.
pub(super) fn sagitta(spec: &Spec, machine: &Machine) -> Option<f64> {
    // A little less than the quarter of the tolerance below which a piece is written as a straight move.
    (!machine.controller.arcs).then_some(0.249 * spec.accuracy.path.0)
}
