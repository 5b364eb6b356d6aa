//! Closed paths of lines and arcs, offset exactly.

use cavalier_contours::polyline::{PlineOffsetOptions, PlineSource, PlineSourceMut, Polyline};

use inflatable::geom::{Arc, Line, Path, Point, Segment};

/// Positions nearer than this are one, mm: above the rounding of coordinates of metres, below what a file can say.
const SAME: f64 = 1e-9;
/// By how much a point of an offset may be nearer to its path than the distance, mm.
const SLACK: f64 = 1e-8;

/// Neighbours that differ by less from one line or circle are one segment, mm: below the largest gap of a seam.
const ALIKE: f64 = 1e-10;

/// The closed paths at `by` mm to the right of the closed `path`: lines and arcs, round at corners that turn left, trimmed at those
/// that turn right. None where nothing is left; several where it falls apart.
pub fn offset_right(path: &Path, by: f64) -> Vec<Path> {
    if by == 0.0 {
        return vec![path.clone()];
    }
    let options =
        PlineOffsetOptions { pos_equal_eps: SAME, offset_dist_eps: SLACK, ..PlineOffsetOptions::new() };
    let loops = polyline(path).parallel_offset_opt(-by, &options);
    loops.iter().map(of_polyline).map(|path| merged(&path)).collect()
}

/// A path as vertices and bulges, arcs above half a turn in two.
pub fn polyline(path: &Path) -> Polyline<f64> {
    let mut line: Polyline<f64> = Polyline::new_closed();
    for segment in &path.segments {
        // A bulge can say up to half a turn.
        let pieces = match segment {
            Segment::Arc(arc) if arc.sweep.abs() > 3.0 => 2,
            _ => 1,
        };
        for i in 0..pieces {
            let part = segment.part(f64::from(i) / f64::from(pieces), f64::from(i + 1) / f64::from(pieces));
            let bulge = if let Segment::Arc(arc) = part { arc.bulge() } else { 0.0 };
            let start = part.start();
            line.add(start.x, start.y, bulge);
        }
    }
    line
}

/// Vertices and bulges as a closed path.
pub fn of_polyline(line: &Polyline<f64>) -> Path {
    let segments = line.iter_segments().map(|(a, b)| {
        let (from, to) = (Point::new(a.x, a.y), Point::new(b.x, b.y));
        Arc::from_bulge(from, to, a.bulge).map_or_else(|| Line::new(from, to).into(), Segment::from)
    });
    Path::closed(segments.collect())
}

/// The path with neighbours on one line or one circle as one segment, and without segments of no length.
pub(super) fn merged(path: &Path) -> Path {
    let mut segments: Vec<Segment> = Vec::with_capacity(path.segments.len());
    for segment in path.segments.iter().filter(|segment| segment.length() > SAME) {
        match segments.last().and_then(|last| joined(last, segment)) {
            Some(both) => {
                let _ = segments.pop();
                segments.push(both);
            }
            None => segments.push(*segment),
        }
    }
    if path.closed
        && segments.len() > 2
        && let Some(both) = joined(&segments[segments.len() - 1], &segments[0])
    {
        let _ = segments.pop();
        segments[0] = both;
    }
    Path { segments, closed: path.closed }
}

/// Two neighbours as one segment, if they are one to `SAME`.
fn joined(a: &Segment, b: &Segment) -> Option<Segment> {
    match (a, b) {
        (Segment::Line(a), Segment::Line(b)) => {
            let both = Line::new(a.start, b.end);
            let bend = both.direction().cross(a.end - a.start).abs();
            let onward = a.direction().dot(b.direction()) > 0.0;
            (onward && bend < ALIKE).then(|| both.into())
        }
        (Segment::Arc(p), Segment::Arc(q)) => {
            let sweep = p.sweep + q.sweep;
            let both = Arc { sweep, ..*p };
            let onward = p.sweep * q.sweep > 0.0 && sweep.abs() < 6.2;
            let same = (p.radius - q.radius).abs() < ALIKE && both.end().distance(q.end()) < ALIKE;
            (same && onward && p.center.distance(q.center) < ALIKE).then(|| both.into())
        }
        _ => None,
    }
}
