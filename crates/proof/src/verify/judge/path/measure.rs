//! The largest distance from a segment to other segments, exact to rounding.
//!
//! Sampling alone would need steps of a few micrometres to see a micrometre. Instead the distance is
//! evaluated where it can be largest. From a **probe** (the segment that is walked along) to the **carrier**
//! (line or circle) of one target, the distance has its extremes at the probe's ends and at its **critical
//! points**: on a line the foot of a circle's centre; on an arc the two points in line with both centres,
//! or in the direction of the line's normal. Where the nearest point of a target changes from its inside to
//! an end, the probe's nearest point to that end is one more candidate (and, on an arc, the farthest); behind an arc,
//! the kink where both of its ends are equally far. Between two candidates that have
//! different nearest targets the change-over, where the smaller of two distances may peak, is found by
//! bisection.

use std::borrow::Borrow;

use geom::{Bounds, Path, Point, Segment, Vec2};

/// Bisections of a change-over between two targets: 5 mm / 2^32 is below any rounding in a file.
const BISECTIONS: u32 = 32;

/// Carriers whose centres are closer than this are concentric: the distance is constant to rounding.
const CONCENTRIC: f64 = 1e-12;

/// A segment prepared for many distance queries without trigonometry.
#[derive(Clone, Copy, Debug)]
pub(in crate::verify) struct Prepared {
    pub(in crate::verify) segment: Segment,
    pub(in crate::verify) start: Point,
    pub(in crate::verify) end: Point,
    pub(in crate::verify) length: f64,
    pub(in crate::verify) bounds: Bounds,
    /// Direction from an arc's centre to its middle; null for a line.
    axis: Vec2,
}

impl Prepared {
    pub(in crate::verify) fn new(segment: Segment) -> Self {
        let (start, end) = (segment.start(), segment.end());
        let axis = match &segment {
            Segment::Line(_) => Vec2::default(),
            Segment::Arc(arc) => Vec2::unit(arc.start_angle + 0.5 * arc.sweep),
        };
        Self { segment, start, end, length: segment.length(), bounds: segment.bounds_of([start, end]), axis }
    }

    /// All segments of `paths`.
    pub(in crate::verify) fn prepare_all<'a>(paths: impl IntoIterator<Item = &'a Path>) -> Vec<Self> {
        paths.into_iter().flat_map(|path| &path.segments).map(|segment| Self::new(*segment)).collect()
    }

    /// The point at fraction `t`.
    fn point(&self, t: f64) -> Point {
        match t {
            0.0 => self.start,
            1.0 => self.end,
            _ => self.segment.point(t),
        }
    }

    /// The point nearest to `p`, which is at `fraction` of the segment.
    pub(in crate::verify) fn foot(&self, p: Point, fraction: f64) -> Point {
        match &self.segment {
            Segment::Arc(arc) if 0.0 < fraction && fraction < 1.0 => {
                arc.center + (p - arc.center).normalized() * arc.radius
            }
            _ => self.point(fraction),
        }
    }

    /// Distance from `p` to the nearest point of the segment.
    pub(in crate::verify) fn distance(&self, p: Point) -> f64 {
        match &self.segment {
            Segment::Line(line) => {
                let foot = line.start.lerp(line.end, line.nearest_fraction(p));
                norm(p - foot)
            }
            Segment::Arc(arc) => {
                let v = p - arc.center;
                if self.faces(v) {
                    (norm(v) - arc.radius).abs()
                } else {
                    norm(p - self.start).min(norm(p - self.end))
                }
            }
        }
    }

    /// Whether the direction `v` from an arc's centre points at the arc; true for a line.
    fn faces(&self, v: Vec2) -> bool {
        let Segment::Arc(arc) = &self.segment else { return true };
        let sweep = arc.sweep.abs();
        if sweep >= std::f64::consts::TAU {
            return true;
        }
        let sign = arc.sweep.signum();
        let after_start = (self.start - arc.center).cross(v) * sign >= 0.0;
        let before_end = v.cross(self.end - arc.center) * sign >= 0.0;
        if sweep <= std::f64::consts::PI { after_start && before_end } else { after_start || before_end }
    }

    /// Adds the fractions of this segment at which its distance to `other` can be largest.
    fn candidates(&self, other: &Self, fractions: &mut Vec<f64>) {
        match (&self.segment, &other.segment) {
            (Segment::Line(_), Segment::Line(_)) => {}
            (Segment::Line(line), Segment::Arc(arc)) => fractions.push(line.nearest_fraction(arc.center)),
            (Segment::Arc(_), Segment::Line(line)) => {
                self.add_directions((line.end - line.start).perp(), fractions);
            }
            (Segment::Arc(a), Segment::Arc(b)) => {
                let axis = a.center - b.center;
                if norm(axis) > CONCENTRIC {
                    self.add_directions(axis, fractions);
                }
            }
        }
        for p in [other.start, other.end] {
            match &self.segment {
                Segment::Line(line) => fractions.push(line.nearest_fraction(p)),
                Segment::Arc(arc) => self.add_directions(p - arc.center, fractions),
            }
        }
        self.axis_crossings(other, fractions);
    }

    /// Adds the fractions at which this segment crosses the axis of an arc behind it, as far from one end as the other.
    fn axis_crossings(&self, other: &Self, fractions: &mut Vec<f64>) {
        let Segment::Arc(target) = &other.segment else { return };
        if other.faces(-other.axis) {
            return;
        }
        let normal = other.axis.perp();
        match &self.segment {
            Segment::Line(line) => {
                let (from, to) =
                    ((line.start - target.center).dot(normal), (line.end - target.center).dot(normal));
                if from * to < 0.0 {
                    fractions.push(from / (from - to));
                }
            }
            Segment::Arc(arc) => {
                let distance = (target.center - arc.center).dot(normal);
                let square = arc.radius * arc.radius - distance * distance;
                if square >= 0.0 {
                    let to_axis = normal * distance;
                    for v in [to_axis + other.axis * square.sqrt(), to_axis + other.axis * -square.sqrt()] {
                        let p = arc.center + v;
                        if self.faces(v) && (p - target.center).dot(other.axis) < 0.0 {
                            fractions.extend(arc.fraction_of(v.angle(), 1e-9));
                        }
                    }
                }
            }
        }
    }

    /// Adds the fractions at which an arc points along `u`, forwards or backwards, from its centre.
    fn add_directions(&self, u: Vec2, fractions: &mut Vec<f64>) {
        let Segment::Arc(arc) = &self.segment else { return };
        for v in [u, -u] {
            if self.faces(v) {
                fractions.extend(arc.fraction_of(v.angle(), 1e-9));
            }
        }
    }
}

/// A distance and where it was measured.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::verify) struct Farthest {
    pub(in crate::verify) distance: f64,
    pub(in crate::verify) at: Point,
}

impl Farthest {
    /// The larger of both.
    pub(in crate::verify) fn max(self, other: Self) -> Self {
        if other.distance > self.distance { other } else { self }
    }
}

/// The largest distance from a point of `probe` to the nearest of `targets`; infinite if there is none.
///
/// `scratch` is room for the candidates, kept between calls.
pub(in crate::verify) fn furthest<T: Borrow<Prepared>>(
    probe: &Prepared,
    targets: &[T],
    scratch: &mut Vec<f64>,
) -> Farthest {
    let (first, first_index) = nearest_target(probe, targets, 0.0);
    let (last, last_index) = nearest_target(probe, targets, 1.0);
    let mut worst = first.max(last);
    scratch.clear();
    // Distance grows at most as fast as the way along the probe: farther targets are nowhere the nearest.
    let reach = worst.distance + 0.5 * probe.length;
    for target in targets.iter().map(Borrow::borrow) {
        if targets.len() <= 2 || target.bounds.outset(reach).overlaps(&probe.bounds) {
            probe.candidates(target, scratch);
        }
    }
    scratch.sort_by(f64::total_cmp);
    scratch.dedup();
    let mut before = Sample { t: 0.0, index: first_index, distance: first.distance };
    for i in 0..=scratch.len() {
        let t = scratch.get(i).copied().unwrap_or(1.0);
        let (farthest, index) =
            if i == scratch.len() { (last, last_index) } else { nearest_target(probe, targets, t) };
        let after = Sample { t, index, distance: farthest.distance };
        worst = change_over(before, after, probe.length, BISECTIONS, worst.max(farthest), &|t| {
            nearest_target(probe, targets, t)
        });
        before = after;
    }
    worst
}

/// The point of `probe` at the fraction `t` with its distance from the nearest of `targets`, and the index of that target.
fn nearest_target<T: Borrow<Prepared>>(probe: &Prepared, targets: &[T], t: f64) -> (Farthest, usize) {
    let p = probe.point(t);
    let (mut best, mut index) = (f64::INFINITY, 0);
    for (i, target) in targets.iter().map(Borrow::borrow).enumerate() {
        // The box pays only where there are several targets.
        if targets.len() > 2 && target.bounds.distance(p) > best {
            continue;
        }
        let distance = target.distance(p);
        if distance < best {
            (best, index) = (distance, i);
        }
    }
    (Farthest { distance: best, at: p }, index)
}

/// The nearest target at a fraction of the probe.
#[derive(Clone, Copy)]
struct Sample {
    t: f64,
    index: usize,
    distance: f64,
}

/// The larger of `worst` and the distances between two samples, as far as different targets are nearest there.
///
/// Where both samples have the same nearest target, its distance has no extreme between them and no other target can make the
/// smallest distance larger. Else both halves are searched, unless the slope of at most 1 rules out that they hold more than
/// `worst`.
fn change_over(
    a: Sample,
    b: Sample,
    length: f64,
    depth: u32,
    worst: Farthest,
    nearest: &impl Fn(f64) -> (Farthest, usize),
) -> Farthest {
    let bound = 0.5 * (a.distance + b.distance + (b.t - a.t) * length);
    if a.index == b.index || depth == 0 || bound <= worst.distance {
        return worst;
    }
    let t = 0.5 * (a.t + b.t);
    let (farthest, index) = nearest(t);
    let middle = Sample { t, index, distance: farthest.distance };
    let worst = change_over(a, middle, length, depth - 1, worst.max(farthest), nearest);
    change_over(middle, b, length, depth - 1, worst, nearest)
}

/// Euclidean length; the readers' numbers are small enough to be squared.
fn norm(v: Vec2) -> f64 {
    v.dot(v).sqrt()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use geom::{Arc, Line};

    /// Points at which the brute force looks along the probe.
    const SAMPLES: u32 = 1000;

    fn segment() -> impl Strategy<Value = Segment> {
        let point = || (-10.0..10.0, -10.0..10.0).prop_map(|(x, y)| Point::new(x, y));
        prop_oneof![
            (point(), point()).prop_map(|(a, b)| Line::new(a, b).into()),
            (point(), 0.01..20.0, -4.0..4.0, prop_oneof![-6.2..-0.01, 0.01..6.2])
                .prop_map(|(c, r, start, sweep)| Arc::new(c, r, start, sweep).into()),
        ]
    }

    proptest! {
        #[test]
        fn target_distance_is_the_segments(s in segment(), x in -20.0..20.0, y in -20.0..20.0) {
            let p = Point::new(x, y);
            prop_assert!((Prepared::new(s).distance(p) - s.distance(p)).abs() < 1e-9);
        }

        #[test]
        fn furthest_agrees_with_brute_force(probe in segment(), segments in proptest::collection::vec(segment(), 1..5)) {
            let targets: Vec<Prepared> = segments.into_iter().map(Prepared::new).collect();
            let worst = furthest(&Prepared::new(probe), &targets, &mut Vec::new());
            let nearest = |p| targets.iter().map(|t| t.segment.distance(p)).fold(f64::INFINITY, f64::min);
            prop_assert!((nearest(worst.at) - worst.distance).abs() < 1e-9);
            for i in 0..=SAMPLES {
                let distance = nearest(probe.point(f64::from(i) / f64::from(SAMPLES)));
                prop_assert!(distance <= worst.distance + 1e-7, "{distance} at {i} against {worst:?}");
            }
        }
    }
}
