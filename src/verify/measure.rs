//! The largest distance from a segment to other segments, exact to rounding.
//!
//! Sampling alone would need steps of a few micrometres to see a micrometre. Instead the distance is
//! evaluated where it can be largest. From a **probe** (the segment that is walked along) to the **carrier**
//! (line or circle) of one target, the distance has its extremes at the probe's ends and at its **critical
//! points**: on a line the foot of a circle's centre; on an arc the two points in line with both centres,
//! or in the direction of the line's normal. Where the nearest point of a target changes from its inside to
//! an end, the probe's nearest point to that end is one more candidate. Between two candidates that have
//! different nearest targets the change-over, where the smaller of two distances may peak, is found by
//! bisection.

use crate::geom::Bounds;
use crate::geom::Point;
use crate::geom::Segment;
use crate::geom::Vec2;

/// Bisections of a change-over between two targets: 5 mm / 2^32 is below any rounding in a file.
const BISECTIONS: usize = 32;

/// Carriers whose centres are closer than this are concentric: the distance is constant to rounding.
const CONCENTRIC: f64 = 1e-12;

/// A segment prepared for many distance queries without trigonometry.
#[derive(Clone, Copy, Debug)]
pub(super) struct Target {
    pub(super) segment: Segment,
    pub(super) start: Point,
    pub(super) end: Point,
    pub(super) length: f64,
    pub(super) bounds: Bounds,
}

impl Target {
    pub(super) fn new(segment: Segment) -> Self {
        let (start, end) = (segment.start(), segment.end());
        Self { segment, start, end, length: segment.length(), bounds: segment.bounds() }
    }

    /// Distance from `p` to the nearest point of the segment.
    pub(super) fn distance(&self, p: Point) -> f64 {
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
    fn candidates(&self, other: &Self, out: &mut Vec<f64>) {
        let mut at_direction = |u: Vec2| {
            for v in [u, -u] {
                if let Segment::Arc(arc) = &self.segment
                    && self.faces(v)
                {
                    out.extend(arc.fraction_of(v.angle(), 1e-9));
                }
            }
        };
        match (&self.segment, &other.segment) {
            (Segment::Line(_), Segment::Line(_)) => {}
            (Segment::Line(line), Segment::Arc(arc)) => out.push(line.nearest_fraction(arc.center)),
            (Segment::Arc(_), Segment::Line(line)) => at_direction((line.end - line.start).perp()),
            (Segment::Arc(a), Segment::Arc(b)) => {
                let between = a.center - b.center;
                if norm(between) > CONCENTRIC {
                    at_direction(between);
                }
            }
        }
        for p in [other.start, other.end] {
            let t = self.segment.nearest_fraction(p);
            if t > 0.0 && t < 1.0 {
                out.push(t);
            }
        }
    }
}

/// A distance and where it was measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Worst {
    pub(super) distance: f64,
    pub(super) at: Point,
}

impl Worst {
    pub(super) const NONE: Self = Self { distance: 0.0, at: Point::ORIGIN };

    /// The larger of both.
    pub(super) fn max(self, other: Self) -> Self {
        if other.distance > self.distance { other } else { self }
    }
}

/// The largest distance from a point of `probe` to the nearest of `targets`; infinite if there is none.
///
/// `scratch` is room for the candidates, kept between calls.
pub(super) fn furthest(probe: &Target, targets: &[Target], scratch: &mut Vec<f64>) -> Worst {
    let nearest = |t: f64| {
        let p = probe.segment.point(t);
        let (mut best, mut index) = (f64::INFINITY, 0);
        for (i, target) in targets.iter().enumerate() {
            // The box is worth its price only where there is a choice.
            if targets.len() > 2 && target.bounds.distance(p) > best {
                continue;
            }
            let distance = target.distance(p);
            if distance < best {
                (best, index) = (distance, i);
            }
        }
        (Worst { distance: best, at: p }, index)
    };
    let (first, first_index) = nearest(0.0);
    let (last, last_index) = nearest(1.0);
    let mut worst = first.max(last);
    scratch.clear();
    // Distance grows at most as fast as the way along the probe: farther targets are nowhere the nearest.
    let reach = worst.distance + 0.5 * probe.length;
    for target in targets {
        if targets.len() <= 2 || target.bounds.grown(reach).overlaps(&probe.bounds) {
            probe.candidates(target, scratch);
        }
    }
    scratch.sort_by(f64::total_cmp);
    scratch.dedup();
    let (mut before, mut before_index, mut before_distance) = (0.0, first_index, first.distance);
    for i in 0..=scratch.len() {
        let t = scratch.get(i).copied().unwrap_or(1.0);
        let (here, index) = if i == scratch.len() { (last, last_index) } else { nearest(t) };
        worst = worst.max(here);
        let step = (t - before) * probe.length;
        if index != before_index && 0.5 * (before_distance + here.distance + step) > worst.distance {
            worst = worst.max(change_over(before, before_index, t, &nearest));
        }
        (before, before_index, before_distance) = (t, index, here.distance);
    }
    worst
}

/// The distance where the nearest target stops being `index`, between the fractions `lo` and `hi`.
fn change_over(mut lo: f64, index: usize, mut hi: f64, nearest: &impl Fn(f64) -> (Worst, usize)) -> Worst {
    let mut worst = Worst::NONE;
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (lo + hi);
        let (here, found) = nearest(middle);
        worst = worst.max(here);
        if found == index {
            lo = middle;
        } else {
            hi = middle;
        }
    }
    worst
}

/// Euclidean length; the readers' numbers are small enough to be squared.
fn norm(v: Vec2) -> f64 {
    v.dot(v).sqrt()
}
