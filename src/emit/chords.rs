//! Chords: a path of lines and arcs as a polygon, for formats without arcs.

use geom::{Path, Point, Segment};

/// The corners of `path` as a polygon that leaves it by `tolerance` (mm) at most; no two neighbours are the same. The end of an open
/// path is its last corner.
pub fn chords(path: &Path, tolerance: f64) -> Vec<Point> {
    let mut corners: Vec<Point> = Vec::new();
    for segment in &path.segments {
        let count = pieces(segment, tolerance);
        let mut i = 0.0;
        while i < count {
            corners.push(segment.point(i / count));
            i += 1.0;
        }
    }
    if !path.closed {
        corners.extend(path.end());
    }
    corners.dedup_by(|a, b| a.distance(*b) < 1e-9);
    corners
}

/// Number of chords that stay within `tolerance` of an arc: r (1 - cos(sweep / 2)) each.
fn pieces(segment: &Segment, tolerance: f64) -> f64 {
    let Segment::Arc(arc) = segment else { return 1.0 };
    let widest = 2.0 * libm::acos(1.0 - (tolerance / arc.radius).min(1.0));
    (arc.sweep.abs() / widest).ceil().max(1.0)
}
