//! Nearest points and distances.

use crate::{Bounds, Path, Point, Segment, intersections};

/// The point of a path nearest to some given point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Distance from the given point.
    pub distance: f64,
    /// The point on the path.
    pub point: Point,
    /// Index of its segment.
    pub segment: usize,
    /// Arc length from the path's start.
    pub s: f64,
}

impl Path {
    /// The point of the path nearest to `p`; `None` for the empty path. Of equals the first is taken.
    pub fn nearest(&self, p: Point) -> Option<Nearest> {
        let mut best: Option<Nearest> = None;
        let mut start = 0.0;
        for (i, segment) in self.segments.iter().enumerate() {
            let length = segment.length();
            if best.is_none_or(|best| may_be_within(segment, p, best.distance)) {
                let t = segment.nearest_fraction(p);
                let point = segment.point(t);
                let distance = point.distance(p);
                if best.is_none_or(|best| distance < best.distance) {
                    best = Some(Nearest { distance, point, segment: i, s: start + t * length });
                }
            }
            start += length;
        }
        best
    }

    /// Distance from `p` to the path; infinite for the empty path.
    pub fn distance(&self, p: Point) -> f64 {
        let nearer = |least: f64, segment: &Segment| {
            if may_be_within(segment, p, least) { least.min(segment.distance(p)) } else { least }
        };
        self.segments.iter().fold(f64::INFINITY, nearer)
    }

    /// Distance from `p` to the path's furthest point; 0 for the empty path.
    pub fn furthest(&self, p: Point) -> f64 {
        self.segments.iter().map(|segment| furthest(segment, p)).fold(0.0, f64::max)
    }
}

/// Largest distance from `p` to a point of `segment`.
fn furthest(segment: &Segment, p: Point) -> f64 {
    match segment {
        // On a circle the furthest point lies beyond the centre.
        Segment::Arc(arc) if arc.fraction_of((arc.center - p).angle(), 0.0).is_some() => {
            arc.center.distance(p) + arc.radius
        }
        Segment::Line(_) | Segment::Arc(_) => segment.start().distance(p).max(segment.end().distance(p)),
    }
}

/// Whether `segment` may be within `limit` of `p`, without trigonometry: no point of an arc is nearer than its circle.
fn may_be_within(segment: &Segment, p: Point, limit: f64) -> bool {
    match segment {
        Segment::Line(_) => true,
        // The slack is above the rounding of both distances.
        Segment::Arc(arc) => {
            let from_center = arc.center.distance(p);
            (from_center - arc.radius).abs() <= limit + 1e-12 * (from_center + arc.radius)
        }
    }
}

/// Smallest distance between a box and a segment, 0 if they share a point.
pub fn box_distance(bounds: &Bounds, segment: &Segment) -> f64 {
    if bounds.contains(segment.start()) {
        return 0.0;
    }
    let sides = Path::rectangle(bounds).segments;
    sides.iter().map(|side| segment_distance(side, segment)).fold(f64::INFINITY, f64::min)
}

/// Smallest distance between two segments, 0 if they touch or cross.
pub fn segment_distance(a: &Segment, b: &Segment) -> f64 {
    if !intersections(a, b).is_empty() {
        return 0.0;
    }
    let ends = [b.distance(a.start()), b.distance(a.end()), a.distance(b.start()), a.distance(b.end())];
    // A minimum inside both segments lies on a common normal, which passes through each arc's centre.
    let inner = match (a, b) {
        (Segment::Line(_), Segment::Line(_)) => f64::INFINITY,
        (Segment::Line(_), Segment::Arc(arc)) => normal_through(arc.center, b, a),
        (Segment::Arc(arc), Segment::Line(_)) => normal_through(arc.center, a, b),
        (Segment::Arc(p), Segment::Arc(q)) => {
            normal_through(p.center, a, b).min(normal_through(q.center, b, a))
        }
    };
    ends.into_iter().fold(inner, f64::min)
}

/// Distance along the normal of `other` that passes through `center`, the centre of `arc`: both crossings of the circle.
fn normal_through(center: Point, arc: &Segment, other: &Segment) -> f64 {
    let foot = other.point(other.nearest_fraction(center));
    let mirrored = center + (center - foot);
    arc.distance(foot).min(other.distance(arc.point(arc.nearest_fraction(mirrored))))
}

/// Smallest distance between two paths, 0 if they touch or cross; infinite if one is empty.
pub fn path_distance(a: &Path, b: &Path) -> f64 {
    let boxes: Vec<Bounds> = b.segments.iter().map(Segment::bounds).collect();
    let mut best = f64::INFINITY;
    for s in &a.segments {
        let bounds = s.bounds();
        for (t, other) in b.segments.iter().zip(&boxes) {
            if bounds.outset(best).overlaps(other) {
                best = best.min(segment_distance(s, t));
            }
        }
    }
    best
}
