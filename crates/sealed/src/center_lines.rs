//! The **centre lines** of a band along an edge, and **spines**: where fabric is as wide as a band, the centre lines along its two sides lie
//! on each other, and the band seals it once.

use crate::doubles::shared;
use crate::network::network;
use crate::offset::{SLACK, parallels};
use crate::offset_graph::{OffsetGraph, SharedStretch};
use crate::pieces::Piece;
use geom::{BoxIndex, Path, Point, Segment, SegmentIndex};

/// Least mean width of the loop of a closed seam, mm: the turns of a smaller one are too short for a program to follow one after the other.
/// Programs around circles, cubics and polygons failed their own proof up to 0.061 mm, and none from 0.064 mm on, whatever the band.
pub(crate) const NARROWEST_LOOP: f64 = 0.063;

/// Mean width of the loop along `path`, mm: four times its area by its length, which is the diameter of a circle.
pub(crate) fn loop_width(path: &Path) -> f64 {
    4.0 * path.area().abs() / path.length()
}

/// Whether a closed seam along `path` would be a point rather than a loop.
pub(crate) fn is_point(path: &Path) -> bool {
    loop_width(path) < NARROWEST_LOOP
}

/// The centre lines of a band along an edge.
pub(crate) struct CenterLines {
    /// The closed ones.
    pub loops: Vec<Path>,
    /// The open ones along slots and islands that are as wide as the band: it seals them once.
    pub spines: Vec<Path>,
}

/// The centre lines of a band `half` mm to the right of the closed `edge`. Fabric that is wider or narrower than the band by at most
/// `join` is as wide as the band.
pub(crate) fn center_lines(edge: &Path, half: f64, join: f64) -> CenterLines {
    let edge_index = SegmentIndex::new(edge.segments.clone());
    let edge_parallels = parallels(edge, half);
    let is_nearly_free = |p: Point| !edge_index.has_within(p, half - 1.05 * join);
    let spines = Spines::new(&edge_parallels, half, join, is_nearly_free);
    let graph =
        OffsetGraph::new(&edge_parallels, &spines.shared, join, |p| !edge_index.has_within(p, half - SLACK));
    let mut loops = graph.cycles();
    if loops.iter().all(is_point) {
        loops.clear();
    }
    if !spines.paths.is_empty() {
        // At the round end of a slot that is a little wider than the band a crumb is left.
        loops.retain(|cycle| cycle.area().abs() > join * cycle.length());
    }
    CenterLines { loops, spines: spines.paths }
}

/// The spines of a closed edge.
#[derive(Default)]
pub(super) struct Spines {
    pub paths: Vec<Path>,
    /// The stretches of parallels that lie along them.
    pub shared: Vec<SharedStretch>,
}

impl Spines {
    /// The spines along the `parallels` of an edge, at `half` a band from it, that run within `join` of each other and `are_free`.
    /// One no longer than half a band is none: the band around its end seals it.
    pub(super) fn new(parallels: &[Segment], half: f64, join: f64, is_free: impl Fn(Point) -> bool) -> Self {
        let stretches = shared_stretches(parallels, join, &is_free);
        if stretches.is_empty() {
            return Self::default();
        }
        let pieces = stretches.iter().enumerate().map(|(source, SharedStretch { lines, fractions, .. })| {
            let [start, end] = fractions[0];
            Piece { path: Path::open(vec![parallels[lines[0]].part(start, end)]), source }
        });
        let edges = network(&pieces.collect::<Vec<_>>(), 2.0 * join).edges;
        let long = edges.into_iter().filter(|edge| edge.path.length() > half && !edge.path.closed);
        let (mut paths, mut is_shared) = (Vec::new(), vec![false; stretches.len()]);
        for edge in long {
            edge.sources.iter().for_each(|source| is_shared[*source] = true);
            paths.push(trimmed(&trimmed(&edge.path, &is_free).reversed(), &is_free).reversed());
        }
        let long_stretches = stretches.into_iter().zip(is_shared).filter(|(_, is_shared)| *is_shared);
        Self { paths, shared: long_stretches.map(|(stretch, _)| stretch).collect() }
    }
}

/// The path up to the last place that `is_free`, halved up to a rounding: parallels go on into the end of a slot.
fn trimmed(path: &Path, is_free: &impl Fn(Point) -> bool) -> Path {
    let length = path.length();
    if path.point_at(length).is_some_and(is_free) {
        return path.clone();
    }
    let (mut free, mut covered) = (length / 2.0, length);
    for _ in 0..50 {
        let middle = f64::midpoint(free, covered);
        let is_middle_free = path.point_at(middle).is_some_and(is_free);
        *(if is_middle_free { &mut free } else { &mut covered }) = middle;
    }
    path.part(0.0, free)
}

/// The stretches that two of the `parallels` share, each once.
fn shared_stretches(
    parallels: &[Segment],
    join: f64,
    is_free: &impl Fn(Point) -> bool,
) -> Vec<SharedStretch> {
    let index = BoxIndex::new(parallels.iter().map(Segment::bounds));
    let mut stretches = Vec::new();
    for (i, line) in parallels.iter().enumerate() {
        index.visit(&line.bounds().outset(join), |j| {
            let other = &parallels[j];
            let Some((from, to)) = (j < i).then(|| shared(line, other, join)).flatten() else { return };
            let middle = line.point(f64::midpoint(from, to));
            let tangents = [line, other].map(|side| side.tangent(side.nearest_fraction(middle)));
            if tangents[0].dot(tangents[1]) < 0.0 && is_free(middle) {
                let ends = [line.point(from), line.point(to)];
                let fractions = [[from, to], ends.map(|end| other.nearest_fraction(end))];
                stretches.push(SharedStretch { lines: [i, j], fractions, ends });
            }
        });
    }
    stretches
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// The polygon, turned around the origin.
    fn turned(points: &[(f64, f64)], angle: f64) -> Path {
        let (sine, cosine) = libm::sincos(angle);
        let turned = points.iter().map(|(x, y)| Point::new(cosine * x - sine * y, sine * x + cosine * y));
        Path::polygon(&turned.collect::<Vec<_>>())
    }

    /// A slot and an island as wide as the band have a spine, whatever the turn and the end.
    /// The band around the outline is one loop in each case. An island has no loop but the spine.
    #[test]
    fn fabric_as_wide_as_the_band_has_a_spine() {
        for i in 0..16 {
            for width in [1.99, 1.999_999, 2.0, 2.000_001, 2.01] {
                let (a, b) = (30.0, 30.0 + width);
                let slot = [
                    (0.0, 0.0),
                    (60.0, 0.0),
                    (60.0, 40.0),
                    (b, 40.0),
                    (b, 15.0),
                    (a, 15.0),
                    (a, 40.0),
                    (0.0, 40.0),
                ];
                let lines = center_lines(&turned(&slot, 0.4 * f64::from(i)), 1.0, 0.02);
                assert_eq!((lines.loops.len(), lines.spines.len()), (1, 1), "{i} {width}");
                assert!(
                    (lines.spines[0].length() - 24.0).abs() < 0.2,
                    "{i} {width}: {}",
                    lines.spines[0].length()
                );
                let area = 62.0 * 42.0 - 4.0 + PI;
                assert!(
                    (lines.loops[0].area() - area).abs() < 0.5,
                    "{i} {width}: {}",
                    lines.loops[0].area() - area
                );
                let corners = [(a, 10.0), (a, 30.0), (b, 30.0), (b, 10.0)];
                let island = turned(&corners, 0.4 * f64::from(i));
                let lines = center_lines(&island, 1.0, 0.02);
                assert_eq!((lines.loops.len(), lines.spines.len()), (0, 1), "{i} {width}");
                assert!(
                    (lines.spines[0].length() - 18.0).abs() < 0.1,
                    "{i} {width}: {}",
                    lines.spines[0].length()
                );
            }
        }
    }

    /// A slot as wide as the band whose mouth has a kink, so that the parallels of its sides cross beside their ends.
    #[test]
    fn a_kink_at_the_mouth_of_a_slot_leaves_one_loop() {
        for (aside, along) in [(1e-6, 1e-3), (-1e-6, 1e-3), (1e-4, 0.01), (-1e-4, 0.01), (2e-3, 0.2)] {
            for width in [1.99, 2.0, 2.005, 2.015] {
                let (a, b) = (30.0, 30.0 + width);
                let mouth = [(b + aside, 40.0), (b, 40.0 - along), (b, 15.0), (a, 15.0), (a, 40.0)];
                let points = [&[(0.0, 0.0), (60.0, 0.0), (60.0, 40.0)][..], &mouth, &[(0.0, 40.0)]].concat();
                let points: Vec<Point> = points.iter().map(|(x, y)| Point::new(*x, *y)).collect();
                let lines = center_lines(&Path::polygon(&points), 1.0, 0.02);
                assert_eq!((lines.loops.len(), lines.spines.len()), (1, 1), "{aside} {along} {width}");
                let area = 62.0 * 42.0 - 4.0 + PI;
                assert!((lines.loops[0].area() - area).abs() < 1.0, "{aside} {along} {width}");
            }
        }
    }
}
