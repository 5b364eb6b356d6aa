//! The exact path as something to be followed: which part of it is near, and what can be said of a step without measuring it.

use crate::geom::{Path, Point, Segment};
use crate::verify::judge::path::measure::Prepared;

/// Two places on the exact path that differ by less in their distance are equally near: both passes of an overlap.
pub(super) const TIE: f64 = 1e-6;

/// The exact path with the arc length at which each segment begins.
pub(super) struct Track {
    pub(super) targets: Vec<Prepared>,
    pub(super) begins: Vec<f64>,
    pub(super) length: f64,
}

impl Track {
    pub(super) fn new(path: &Path) -> Self {
        let mut length = 0.0;
        let mut track = Self { targets: Vec::new(), begins: Vec::new(), length };
        for segment in &path.segments {
            let target = Prepared::new(*segment);
            if target.length > 0.0 {
                track.targets.push(target);
                track.begins.push(length);
                length += target.length;
            }
        }
        Self { length, ..track }
    }

    /// The part of `[from, to]` that exists.
    pub(super) fn within(&self, from: f64, to: f64) -> (f64, f64) {
        (from.max(0.0), to.min(self.length))
    }

    /// Indices of the segments that share more than a point with `[from, to]`; at least one.
    pub(super) fn between(&self, from: f64, to: f64) -> std::ops::Range<usize> {
        let first = self.begins.partition_point(|s| *s <= from).saturating_sub(1);
        let last = self.begins.partition_point(|s| *s < to).max(first + 1);
        first..last
    }

    /// The arc length in `[from, to]` of the point nearest to `p`, and its distance; of those within `tie` the one next to
    /// `expected`.
    pub(super) fn project(&self, p: Point, (from, to): (f64, f64), expected: f64, tie: f64) -> (f64, f64) {
        let mut best = (from, f64::INFINITY);
        for i in self.between(from, to) {
            let (target, begin) = (&self.targets[i], self.begins[i]);
            if target.bounds.distance(p) >= best.1 + tie {
                continue;
            }
            let s = (begin + target.segment.nearest_fraction(p) * target.length).clamp(from, to);
            let distance = target.segment.point((s - begin) / target.length).distance(p);
            let nearer = distance < best.1 - tie;
            if nearer || (distance <= best.1 + tie && (s - expected).abs() < (best.0 - expected).abs()) {
                best = (s, distance);
            }
        }
        best
    }

    /// The most by which a straight step may be away from the part of the path between `low` and `high`, either way, if its
    /// ends are no farther than `off` from those of that part; `None` if the part bends.
    pub(super) fn bound(&self, step: &Prepared, (low, high): (f64, f64), off: f64) -> Option<f64> {
        let covered = self.between(low, high);
        let target = self.targets.get(covered.start).filter(|_| covered.len() == 1)?;
        match (&step.segment, &target.segment) {
            (Segment::Line(_), Segment::Line(_)) => Some(off),
            // Two lines are no farther apart than their ends, and an arc from its chord by no more than its sagitta.
            (Segment::Line(_), Segment::Arc(arc)) if high - low < arc.radius => {
                Some(off + (high - low).powi(2) / (8.0 * arc.radius))
            }
            _ => None,
        }
    }
}
