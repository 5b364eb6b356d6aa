//! Walls and welds as far as they lie in the air.

use inflatable::geom::{Enclosures, Line, Path, Point, Segment, intersections};

/// Ends of walls nearer to an edge than this end on it, mm, whatever the value of `join`.
const LEAST_JOIN: f64 = 1e-3;

/// The parts of `path` that lie in the air, which `loops` bound. An end that lies within `join` of a loop ends on it.
pub(super) fn within_air(path: &Path, loops: &[Path], join: f64) -> Vec<Path> {
    let join = join.max(LEAST_JOIN);
    let around = Enclosures::new(loops);
    let is_in = |p: Point| around.around(p).len() % 2 == 1;
    let mut out: Vec<Vec<Segment>> = vec![Vec::new()];
    for segment in reaching(path, loops, join) {
        let hits = loops
            .iter()
            .flat_map(|edge| edge.segments.iter().flat_map(|other| intersections(&segment, other)));
        let mut cuts: Vec<f64> = hits.map(|hit| segment.nearest_fraction(hit)).chain([0.0, 1.0]).collect();
        cuts.sort_by(f64::total_cmp);
        for cut in cuts.windows(2).filter(|cut| (cut[1] - cut[0]) * segment.length() > 1e-6) {
            let part = segment.part(cut[0], cut[1]);
            if !is_in(part.point(0.5)) {
                out.push(Vec::new());
            } else if let Some(last) = out.last_mut() {
                last.push(part);
            }
        }
    }
    out.into_iter().filter(|segments| !segments.is_empty()).map(Path::open).collect()
}

/// The segments of `path`, and straight on over the loop at an end that lies on it.
fn reaching(path: &Path, loops: &[Path], join: f64) -> Vec<Segment> {
    let mut segments = path.segments.clone();
    let near = |p: &Point| !path.closed && loops.iter().any(|edge| edge.distance(*p) <= join);
    if let Some((end, along)) = path.end().filter(near).zip(path.tangent_at(path.length())) {
        segments.push(Line::new(end, end + along * (2.0 * join)).into());
    }
    if let Some((start, along)) = path.start().filter(near).zip(path.tangent_at(0.0)) {
        segments.insert(0, Line::new(start - along * (2.0 * join), start).into());
    }
    segments
}
