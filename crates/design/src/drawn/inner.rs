//! Walls and welds as far as they lie in the air; edges whose bands touch.

use geom::{Enclosures, Line, Path, Point, Segment, intersections, path_distance};

/// Ends of walls nearer to an edge than this end on it, mm, whatever the value of `join`.
const LEAST_JOIN: f64 = 1e-3;

/// The parts of `path` that lie in the air, which `loops` bound. An end that lies within `join` of a loop ends on it.
pub(super) fn within_air(path: &Path, loops: &[Path], join: f64) -> Vec<Path> {
    let join = join.max(LEAST_JOIN);
    let enclosures = Enclosures::new(loops);
    let mut runs: Vec<Vec<Segment>> = vec![Vec::new()];
    for segment in reaching(path, loops, join) {
        let hits = loops
            .iter()
            .flat_map(|edge| edge.segments.iter().flat_map(|other| intersections(&segment, other)));
        let mut cuts: Vec<f64> = hits.map(|hit| segment.nearest_fraction(hit)).chain([0.0, 1.0]).collect();
        cuts.sort_by(f64::total_cmp);
        for cut in cuts.windows(2).filter(|cut| (cut[1] - cut[0]) * segment.length() > 1e-6) {
            let part = segment.part(cut[0], cut[1]);
            if enclosures.enclosing(part.point(0.5)).len().is_multiple_of(2) {
                runs.push(Vec::new());
            } else if let Some(last) = runs.last_mut() {
                last.push(part);
            }
        }
    }
    runs.into_iter().filter(|segments| !segments.is_empty()).map(Path::open).collect()
}

/// The segments of `path`, and straight on over the loop at an end that lies on it.
fn reaching(path: &Path, loops: &[Path], join: f64) -> Vec<Segment> {
    let mut segments = path.segments.clone();
    let is_near_air = |p: &Point| !path.closed && loops.iter().any(|edge| edge.distance(*p) <= join);
    if let Some((end, direction)) = path.end().filter(is_near_air).zip(path.tangent_at(path.length())) {
        segments.push(Line::new(end, end + direction * (2.0 * join)).into());
    }
    if let Some((start, direction)) = path.start().filter(is_near_air).zip(path.tangent_at(0.0)) {
        segments.insert(0, Line::new(start - direction * (2.0 * join), start).into());
    }
    segments
}

/// Whether two regions of air are so near to each other that their seams share a band, or lie within a band's width of each other.
pub(super) fn share_a_band(air: &[Path], band: f64) -> bool {
    let limit = 3.0 * band + 1e-3;
    let regions: Vec<Enclosures> = air.iter().map(|edge| Enclosures::new([edge])).collect();
    let count = air.len();
    let is_island: Vec<bool> = (0..count)
        .map(|edge| (0..count).filter(|outer| is_within(air, &regions, edge, *outer)).count() % 2 == 1)
        .collect();
    (0..count).any(|a| {
        (0..a).any(|b| {
            if !air[a].bounds().outset(limit).overlaps(&air[b].bounds()) {
                return false;
            }
            // Fabric lies between two chambers, and between an island and a chamber in it.
            let parted_by_fabric = match (is_island[a], is_island[b]) {
                (false, false) => true,
                (true, false) => is_within(air, &regions, b, a),
                (false, true) => is_within(air, &regions, a, b),
                (true, true) => false,
            };
            parted_by_fabric && path_distance(&air[a], &air[b]) <= limit
        })
    })
}

/// Whether the edge `inner` of `air` begins within the region of another edge, `outer`.
fn is_within(air: &[Path], regions: &[Enclosures], inner: usize, outer: usize) -> bool {
    let start = air[inner].start();
    inner != outer && start.is_some_and(|start| !regions[outer].enclosing(start).is_empty())
}
