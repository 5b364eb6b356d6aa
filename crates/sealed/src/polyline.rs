//! Closed paths as vertices and bulges, for operations on regions.

use cavalier_contours::polyline::{PlineSource, PlineSourceMut, Polyline};
use geom::{Arc, Line, Path, Point, Segment};

/// A path as vertices and bulges, arcs above half a turn in two.
pub fn polyline(path: &Path) -> Polyline<f64> {
    let mut line: Polyline<f64> = Polyline::new_closed();
    for segment in &path.segments {
        // A bulge can express up to half a turn.
        for part in halves(segment) {
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

/// A segment in parts that turn by half a circle at most.
pub(super) fn halves(segment: &Segment) -> impl Iterator<Item = Segment> {
    let count = match segment {
        Segment::Arc(arc) if arc.sweep.abs() > 3.0 => 2,
        _ => 1,
    };
    (0..count)
        .map(move |i| segment.part(f64::from(i) / f64::from(count), f64::from(i + 1) / f64::from(count)))
}
