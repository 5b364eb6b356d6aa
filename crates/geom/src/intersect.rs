//! Intersections of segments.

use crate::{Arc, Line, Path, Point, Segment};

/// Distance outside its ends, relative to its size, at which a segment still counts as touched: absorbs rounding only.
const SLACK: f64 = 1e-12;

/// The points that two segments share; none for parallel lines and equal circles, even where they overlap.
pub fn intersections(a: &Segment, b: &Segment) -> Vec<Point> {
    match (a, b) {
        (Segment::Line(a), Segment::Line(b)) => line_line(a, b).into_iter().collect(),
        (Segment::Line(line), Segment::Arc(arc)) | (Segment::Arc(arc), Segment::Line(line)) => {
            line_arc(line, arc)
        }
        (Segment::Arc(a), Segment::Arc(b)) => arc_arc(a, b),
    }
}

/// The points that two different paths share.
pub fn path_intersections(a: &Path, b: &Path) -> Vec<Point> {
    let boxes: Vec<_> = b.segments.iter().map(Segment::bounds).collect();
    let mut points = Vec::new();
    for s in &a.segments {
        let bounds = s.bounds();
        for (t, other) in b.segments.iter().zip(&boxes) {
            if bounds.overlaps(other) {
                points.extend(intersections(s, t));
            }
        }
    }
    points
}

fn line_line(a: &Line, b: &Line) -> Option<Point> {
    let (u, v, w) = (a.end - a.start, b.end - b.start, b.start - a.start);
    let det = u.cross(v);
    if det.abs() <= SLACK * u.length() * v.length() {
        return None;
    }
    let (t, s) = (w.cross(v) / det, w.cross(u) / det);
    let fractions = -SLACK..=1.0 + SLACK;
    (fractions.contains(&t) && fractions.contains(&s)).then(|| a.start.lerp(a.end, t))
}

fn line_arc(line: &Line, arc: &Arc) -> Vec<Point> {
    let d = line.direction();
    let length = line.length();
    let to_center = arc.center - line.start;
    let (foot, distance) = (to_center.dot(d), d.cross(to_center));
    let square = arc.radius * arc.radius - distance * distance;
    if square < 0.0 {
        return Vec::new();
    }
    let half = square.sqrt();
    [foot - half, foot + half]
        .into_iter()
        .filter(|s| (-SLACK * length..=length * (1.0 + SLACK)).contains(s))
        .map(|s| line.start + d * s)
        .filter(|p| on_arc(arc, *p))
        .collect()
}

fn arc_arc(a: &Arc, b: &Arc) -> Vec<Point> {
    let axis = b.center - a.center;
    let d = axis.length();
    if d == 0.0 {
        return Vec::new();
    }
    let foot = (d * d + a.radius * a.radius - b.radius * b.radius) / (2.0 * d);
    let square = a.radius * a.radius - foot * foot;
    if square < 0.0 {
        return Vec::new();
    }
    let (u, half) = (axis.normalized(), square.sqrt());
    [half, -half]
        .into_iter()
        .map(|h| a.center + u * foot + u.perp() * h)
        .filter(|p| on_arc(a, *p) && on_arc(b, *p))
        .collect()
}

fn on_arc(arc: &Arc, p: Point) -> bool {
    arc.fraction_of((p - arc.center).angle(), SLACK).is_some()
}
