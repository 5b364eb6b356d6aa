//! The exact path, prepared for following: the part of it that is near, and bounds for a step without measuring it.

use crate::verify::judge::path::measure::Prepared;
use geom::{Path, Point, Segment, Vec2};

/// Two places on the exact path that differ by less in their distance are equally near: both passes of an overlap.
pub(super) const TIE: f64 = 1e-6;

/// The exact path with the arc length at which each segment begins.
#[derive(Default)]
pub(super) struct Track {
    pub(super) targets: Vec<Prepared>,
    pub(super) begins: Vec<f64>,
    pub(super) length: f64,
}

/// The passage of the path by some point.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Passing {
    /// Arc length to there.
    pub(super) s: f64,
    /// The place on the path, and how far it is from the point.
    pub(super) place: Point,
    pub(super) distance: f64,
}

impl Track {
    pub(super) fn new(path: &Path) -> Self {
        let mut track = Self::default();
        for target in Prepared::prepare_all([path]).into_iter().filter(|target| target.length > 0.0) {
            track.begins.push(track.length);
            track.length += target.length;
            track.targets.push(target);
        }
        track
    }

    /// The part of `[from, to]` that exists.
    pub(super) fn clamped(&self, from: f64, to: f64) -> (f64, f64) {
        (from.max(0.0), to.min(self.length))
    }

    /// Indices of the segments that share more than a point with `[from, to]`; at least one.
    pub(super) fn indices(&self, from: f64, to: f64) -> std::ops::Range<usize> {
        let first = self.begins.partition_point(|s| *s <= from).saturating_sub(1);
        let last = self.begins.partition_point(|s| *s < to).max(first + 1);
        first..last
    }

    /// The passage in `[from, to]` nearest to `p`; of places within `tie` the one next to `expected`.
    pub(super) fn project(&self, p: Point, (from, to): (f64, f64), expected: f64, tie: f64) -> Passing {
        let mut best = Passing { s: from, place: p, distance: f64::INFINITY };
        for i in self.indices(from, to) {
            let (target, begin) = (&self.targets[i], self.begins[i]);
            if target.bounds.distance(p) >= best.distance + tie {
                continue;
            }
            let nearest = target.segment.nearest_fraction(p);
            let free = begin + nearest * target.length;
            let s = free.clamp(from, to);
            let place = if s == free {
                target.foot(p, nearest)
            } else {
                target.segment.point((s - begin) / target.length)
            };
            let distance = place.distance(p);
            let nearer = distance < best.distance - tie;
            if nearer || (distance <= best.distance + tie && (s - expected).abs() < (best.s - expected).abs())
            {
                best = Passing { s, place, distance };
            }
        }
        best
    }

    /// The most by which a straight step may be away from the part of the path between `low` and `high`, either way; `ends` are
    /// those of that part, in the order of the step. `None` if the part bends.
    pub(super) fn bound(&self, step: &Prepared, (low, high): (f64, f64), ends: [Point; 2]) -> Option<f64> {
        let covered = self.indices(low, high);
        let target = self.targets.get(covered.start).filter(|_| covered.len() == 1)?;
        let offsets = [step.start - ends[0], step.end - ends[1]];
        match (&step.segment, &target.segment) {
            // Two lines are no farther apart than their ends.
            (Segment::Line(_), Segment::Line(_)) => Some(offsets[0].length().max(offsets[1].length())),
            (Segment::Line(_), Segment::Arc(arc)) if high - low < arc.radius => {
                Some(from_arc(offsets, ends, arc.center))
            }
            _ => None,
        }
    }
}

/// The largest distance of a straight step from an arc around `center`, whose `ends` it misses by `offsets`; the arc is less than 1
/// rad.
///
/// At a part `t` of the way along its chord, the arc is above it by 0 to `4 rise t (1 - t)`, with `rise = a^2 / (2 h)` for half a
/// chord `a` at a distance `h` from the centre (from `sqrt(h^2 + z) - h <= z / (2 h)`), and the step by a value that is linear
/// between the two of `offsets`: their difference is at most the height of a parabola, or one of `offsets` where the step is above.
fn from_arc(offsets: [Vec2; 2], ends: [Point; 2], center: Point) -> f64 {
    let chord = ends[1] - ends[0];
    if chord == Vec2::default() {
        return offsets[0].length().max(offsets[1].length());
    }
    let direction = chord.normalized();
    let outward = ends[0].midpoint(ends[1]) - center;
    let upward = direction.perp() * direction.perp().dot(outward).signum();
    let rise = chord.dot(chord) / (8.0 * upward.dot(outward));
    let [a, b] = offsets.map(|offsets| offsets.dot(upward));
    let height = if (a - b).abs() < 4.0 * rise {
        rise - 0.5 * (a + b) + (a - b).powi(2) / (16.0 * rise)
    } else {
        f64::max(-a, -b)
    };
    let [c, d] = offsets.map(|offsets| offsets.dot(direction));
    Vec2::new(height.max(a).max(b), c.abs().max(d.abs())).length()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::verify::judge::path::measure::furthest;
    use geom::{Arc, Line};

    proptest! {
        /// No measured distance exceeds the bound, and the bound is hardly more than the sagitta plus the error of the ends.
        #[test]
        fn no_step_is_farther_from_its_arc_than_the_bound(
            radius in 0.5..200.0_f64,
            start in -3.0..3.0_f64,
            sweep in prop_oneof![-0.99..-1e-6_f64, 1e-6..0.99_f64],
            offsets in prop::array::uniform4(-1.0..1.0_f64),
            size in prop_oneof![Just(0.0), Just(1e-4), Just(0.1)],
        ) {
            let arc = Arc::new(Point::new(3.0, -4.0), radius, start, sweep);
            let ends = [arc.start(), arc.end()];
            let [a, b, c, d] = offsets.map(|x| x * size);
            let line = Line::new(ends[0] + Vec2::new(a, b), ends[1] + Vec2::new(c, d));
            let (step, exact) = (Prepared::new(line.into()), Prepared::new(arc.into()));
            let mut scratch = Vec::new();
            let forth = furthest(&step, std::slice::from_ref(&exact), &mut scratch);
            let back = furthest(&exact, std::slice::from_ref(&step), &mut scratch);
            let bound = from_arc([line.start - ends[0], line.end - ends[1]], ends, arc.center);
            prop_assert!(forth.max(back).distance <= bound + 1e-12, "{} {}", forth.max(back).distance, bound);
            let sagitta = radius * (1.0 - (0.5 * sweep).cos());
            prop_assert!(bound <= 1.2 * sagitta + 1.5 * size, "{bound}, a sagitta of {sagitta}");
        }
    }

    #[test]
    fn a_step_on_the_spot_is_as_far_off_as_its_ends() {
        let center = Point::new(1.0, 0.0);
        assert_eq!(from_arc([Vec2::new(3.0, 4.0), Vec2::new(0.0, 1.0)], [center; 2], Point::ORIGIN), 5.0);
    }
}
