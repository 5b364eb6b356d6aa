//! Neighbours on one line or one circle as one segment.

use crate::clean::NOTHING;
use geom::{Arc, Line, Path, Segment};

/// Neighbours that differ by less from one line or circle are one segment, mm: below the largest gap of a seam.
const ALIKE: f64 = 1e-10;

/// The path with neighbours on one line or one circle as one segment, and without segments of no length.
pub(super) fn merged(path: &Path) -> Path {
    let mut segments: Vec<Segment> = Vec::with_capacity(path.segments.len());
    for segment in path.segments.iter().filter(|segment| segment.length() > NOTHING) {
        match segments.last().and_then(|last| joined(last, segment)) {
            Some(union) => {
                let _ = segments.pop();
                segments.push(union);
            }
            None => segments.push(*segment),
        }
    }
    if path.closed
        && segments.len() > 2
        && let Some(union) = joined(&segments[segments.len() - 1], &segments[0])
    {
        let _ = segments.pop();
        segments[0] = union;
    }
    Path { segments, closed: path.closed }
}

/// Two neighbours as one segment, if they are one to `NOTHING`.
fn joined(a: &Segment, b: &Segment) -> Option<Segment> {
    match (a, b) {
        (Segment::Line(a), Segment::Line(b)) => {
            let union = Line::new(a.start, b.end);
            let bend = union.direction().cross(a.end - a.start).abs();
            let onward = a.direction().dot(b.direction()) > 0.0;
            (onward && bend < ALIKE).then(|| union.into())
        }
        (Segment::Arc(p), Segment::Arc(q)) => {
            let sweep = p.sweep + q.sweep;
            let union = Arc { sweep, ..*p };
            let onward = p.sweep * q.sweep > 0.0 && sweep.abs() < 6.2;
            let is_same = (p.radius - q.radius).abs() < ALIKE && union.end().distance(q.end()) < ALIKE;
            (is_same && onward && p.center.distance(q.center) < ALIKE).then(|| union.into())
        }
        _ => None,
    }
}
