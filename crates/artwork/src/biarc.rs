//! Smooth curves as tangent-continuous chains of arcs.
//!
//! A **biarc** is two arcs that share a tangent where they meet, and the ends and end tangents of a piece of curve. Its
//! distance from the curve falls with the cube of the piece's length, so each step is chosen from the error of the one
//! before (D. S. Meek, D. J. Walton, "Approximating smooth planar curves by arc splines", J. Comput. Appl. Math. 59
//! (1995) 221). Arcs of pieces that meet at a smooth point are tangent there too.

use geom::straight::{is_straight, push_arc, push_line};
use geom::{Arc, Line, Point, Segment, Vec2};

/// A curve over the parameter 0 to 1.
pub(crate) trait Curve {
    /// The point at `t`.
    fn point(&self, t: f64) -> Point;
    /// The curve's derivative by `t`.
    fn derivative(&self, t: f64) -> Vec2;
}

/// Points at which the distance of curve and arcs is measured. Between them it is at most 3 % larger on the cubics of
/// the property tests; `SHARE` covers that.
const SAMPLES: u32 = 12;
/// Share of the tolerance that the measured distance may take.
const SHARE: f64 = 0.9;
/// Cosine of the largest angle between an end tangent and the chord (60 deg): up to it neither curve nor arcs turn back,
/// so that distances from samples bound the distance of both.
const FLATNESS: f64 = 0.5;
/// Share of the tolerance by which an arc may leave its chord to be written as a line: its radius would be so large
/// that the ends lose digits.
const STRAIGHT: f64 = 1e-3;
/// Shortest step. A piece of this length is a line whatever it leaves; the extent of a drawing is bounded, so that is
/// below 1e-6 mm.
const SHORTEST: f64 = 1e-13;

/// Appends arcs and lines within `tolerance` of the curve; `false` if `segments` would exceed `limit` segments.
pub(crate) fn fit(curve: &impl Curve, tolerance: f64, limit: usize, segments: &mut Vec<Segment>) -> bool {
    let (allowed, straight) = (SHARE * tolerance, STRAIGHT * tolerance);
    let first = segments.len();
    let mut start = 0.0;
    let mut step = 1.0;
    while start < 1.0 {
        let end = if start + step > 1.0 - SHORTEST { 1.0 } else { start + step };
        let piece = Span::new(curve, start, end);
        // A straight piece is a line, although arcs would be nearer: their radius would be kilometres.
        let biarc = if piece.is_straight(allowed) { None } else { piece.biarc() };
        let error = biarc.map_or(f64::INFINITY, |arcs| piece.distance(&arcs, straight));
        let accepted = error <= allowed || piece.is_line(allowed) || step <= SHORTEST;
        if accepted {
            match biarc.filter(|_| error <= allowed) {
                Some(arcs) => {
                    let bounds = ArcBounds { straight, chordal: tolerance - allowed, limit };
                    if !arcs.append(&bounds, first, segments) {
                        return false;
                    }
                }
                None => push_line(Line::new(piece.ends[0], piece.ends[1]), segments),
            }
            if segments.len() > limit {
                return false;
            }
            start = end;
        }
        // Error is proportional to the cube of the step; the bounds keep one odd measurement from ruling.
        let factor = if error.is_finite() { 0.9 * libm::cbrt(allowed / error.max(1e-300)) } else { 0.5 };
        let bounds = if accepted { (0.8, 4.0) } else { (0.2, 0.8) };
        let factor = if accepted && error.is_infinite() { 2.0 } else { factor.clamp(bounds.0, bounds.1) };
        step = (step * factor).max(SHORTEST);
        let rest = 1.0 - start;
        if step < rest && rest < 2.0 * step {
            step = rest / 2.0; // two equal pieces instead of a long and a short one
        }
    }
    true
}

/// A piece of a curve with the data to compare it.
struct Span {
    ends: [Point; 2],
    tangents: [Vec2; 2],
    samples: [Point; SAMPLES as usize - 1],
}

impl Span {
    fn new(curve: &impl Curve, a: f64, b: f64) -> Self {
        let mut samples = [Point::ORIGIN; SAMPLES as usize - 1];
        for (sample, i) in samples.iter_mut().zip(1..) {
            *sample = curve.point(a + (b - a) * f64::from(i) / f64::from(SAMPLES));
        }
        // A derivative that vanishes at an end (a control point on the end) has the direction of the next point.
        let ends = [curve.point(a), curve.point(b)];
        let chord = (ends[1] - ends[0]).length();
        let small = 1e-9 * (chord + samples[0].distance(ends[0])) / (b - a);
        let small_step = 1e-4 * (b - a);
        let tangents = [(a, a + small_step, 1.0), (b, b - small_step, -1.0)].map(|(t, inner, sign)| {
            let v = curve.derivative(t);
            let v = if v.length() > small { v } else { (curve.point(inner) - curve.point(t)) * sign };
            v.normalized()
        });
        Self { ends, tangents, samples }
    }

    /// The biarc with equal lengths of its two control legs; `None` if the piece turns too far for one.
    ///
    /// The joint is the middle of the legs' ends `q0 = p0 + d t0`, `q1 = p1 - d t1` with `|q1 - q0| = 2 d`.
    fn biarc(&self) -> Option<Biarc> {
        let [p0, p1] = self.ends;
        let [t0, t1] = self.tangents;
        let chord = p1 - p0;
        let length = chord.length();
        if length == 0.0 || t0.dot(chord) < FLATNESS * length || t1.dot(chord) < FLATNESS * length {
            return None;
        }
        let sum_component = chord.dot(t0 + t1);
        let tangent_difference = t1 - t0;
        let d = length * length
            / (sum_component
                + (sum_component * sum_component
                    + tangent_difference.dot(tangent_difference) * length * length)
                    .sqrt());
        let (q0, q1) = (p0 + t0 * d, p1 + t1 * -d);
        let joint = q0.midpoint(q1);
        let tangent = (q1 - q0).normalized();
        Some(Biarc { points: [p0, joint, p1], tangents: [t0, tangent] })
    }

    /// Largest distance of the samples from the biarc; infinite if they turn back.
    fn distance(&self, biarc: &Biarc, straight: f64) -> f64 {
        if !self.advances() {
            return f64::INFINITY;
        }
        let [first, second] = biarc.segments(straight);
        let (joint, tangent) = (biarc.points[1], biarc.tangents[1]);
        // From the whole circle or line: the samples are beside it.
        let deviation = |p: &Point| match if (*p - joint).dot(tangent) < 0.0 { first } else { second } {
            Segment::Arc(arc) => (p.distance(arc.center) - arc.radius).abs(),
            Segment::Line(line) => line.direction().cross(*p - line.start).abs(),
        };
        self.samples.iter().map(deviation).fold(0.0, f64::max)
    }

    /// Whether all samples lie within `allowed` of the chord and in its order, and it comes from no place beyond an end, where it turned
    /// between two samples; or whether they lie within `allowed` of the first end.
    fn is_line(&self, allowed: f64) -> bool {
        let [a, b] = self.ends;
        let direction = (b - a).normalized();
        let point = self.samples.iter().chain([&b]).all(|p| p.distance(a) <= allowed);
        let forward = self.tangents.iter().all(|tangent| tangent.dot(direction) >= 0.0);
        point
            || forward
                && self.advances()
                && self.samples.iter().all(|p| direction.cross(*p - a).abs() <= allowed)
    }

    /// Whether the piece is straight: within `allowed` of its chord, and without a turn.
    fn is_straight(&self, allowed: f64) -> bool {
        let chord = self.ends[1] - self.ends[0];
        let turn = |tangent: &Vec2| libm::atan2(tangent.cross(chord), tangent.dot(chord)).abs();
        let largest = self.tangents.iter().map(turn).fold(0.0, f64::max);
        is_straight(0.0, largest, allowed) && self.is_line(allowed)
    }

    /// Whether the samples advance along the chord.
    fn advances(&self) -> bool {
        let [a, b] = self.ends;
        let mut last = 0.0;
        self.samples.iter().chain([&b]).all(|p| {
            let next = (*p - a).dot(b - a);
            std::mem::replace(&mut last, next) < next
        })
    }
}

/// Bounds on arcs that are written.
struct ArcBounds {
    /// An arc that leaves its chord by less is written as a line, mm.
    straight: f64,
    /// Distance of the chords that replace an arc of too large a radius, mm.
    chordal: f64,
    /// Most segments of the curve.
    limit: usize,
}

/// Two arcs through three points, with the tangents at the first two.
#[derive(Clone, Copy)]
struct Biarc {
    points: [Point; 3],
    tangents: [Vec2; 2],
}

impl Biarc {
    /// Appends the arcs within `bounds`; arcs of one circle become one, also with the arc before it (from index `first` on). `false` if
    /// `segments` would exceed the limit.
    fn append(&self, bounds: &ArcBounds, first: usize, segments: &mut Vec<Segment>) -> bool {
        let ArcBounds { straight, chordal, limit } = *bounds;
        let ends = [[self.points[0], self.points[1]], [self.points[1], self.points[2]]];
        self.segments(straight).iter().zip(ends).all(|(segment, ends)| {
            match (segment, segments[first..].last_mut()) {
                (Segment::Arc(arc), Some(Segment::Arc(before))) if same_circle(before, arc) => {
                    before.sweep += arc.sweep;
                }
                (Segment::Arc(arc), _) => return push_arc(arc, ends, chordal, limit, segments),
                (Segment::Line(line), _) => push_line(*line, segments),
            }
            true
        })
    }

    /// Both arcs; a line in place of one that leaves its chord by less than `straight`.
    fn segments(&self, straight: f64) -> [Segment; 2] {
        [0, 1].map(|i| {
            let [start, end] = [self.points[i], self.points[i + 1]];
            let arc = arc_from(start, end, self.tangents[i], straight);
            arc.map_or_else(|| Line::new(start, end).into(), Segment::from)
        })
    }
}

/// Whether two arcs turn the same way on one circle, to rounding.
fn same_circle(a: &Arc, b: &Arc) -> bool {
    let slack = 1e-10 * a.radius;
    a.sweep * b.sweep > 0.0 && (a.radius - b.radius).abs() <= slack && a.center.distance(b.center) <= slack
}

/// The arc from `start` in direction `tangent` to `end`; `None` if it leaves its chord by less than `straight`.
fn arc_from(start: Point, end: Point, tangent: Vec2, straight: f64) -> Option<Arc> {
    let chord = end - start;
    let (across, along) = (tangent.cross(chord), tangent.dot(chord));
    let half = libm::atan2(across, along);
    // For a longer chord the arc may be flatter still: its ends err by 2e-16 of a radius of chord^2 / (8 sagitta), which is kept
    // below 1e-6 mm as far as the tolerance allows.
    let straight = straight.max((2.5e-11 * chord.dot(chord)).min(300.0 * straight));
    if chord.length() * half.abs() < 4.0 * straight {
        return None;
    }
    let radius = chord.dot(chord) / (2.0 * across);
    let center = start + tangent.perp() * radius;
    Some(Arc::new(center, radius.abs(), (start - center).angle(), 2.0 * half))
}
