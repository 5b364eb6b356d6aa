//! Closed paths of lines and arcs, offset exactly.
//!
//! Every segment has a **parallel** at the distance. Where a path is tangent, to the rounding of a file, two parallels end in one point;
//! at a corner that turns away an arc around it joins them; at one that turns in they cross. The offset is what [`OffsetGraph`] finds along
//! them.

use std::f64::consts::{PI, TAU};

use crate::clean::NOTHING;
use crate::offset_graph::{ONE, OffsetGraph, moved};
use crate::polyline::halves;
use crate::spine::Spines;
use geom::{Arc, Line, Path, Point, Segment, SegmentIndex};

/// By how much a point of an offset may be nearer to its path than the distance, mm: joints and nodes are moved by [`ONE`].
const SLACK: f64 = 3e-5;
/// Turns that differ from half a turn by less are half a turn, rad.
const FOLDED: f64 = 1e-9;

/// The closed paths `distance` mm to the right of the closed `path`: lines and arcs, round at corners that turn left, trimmed at those
/// that turn right. None where nothing is left; several where it falls apart.
pub fn offset_right(path: &Path, distance: f64) -> Vec<Path> {
    if distance == 0.0 {
        return vec![path.clone()];
    }
    if distance < 0.0 {
        return offset_right(&path.reversed(), -distance).iter().map(Path::reversed).collect();
    }
    let path_index = SegmentIndex::new(path.segments.clone());
    OffsetGraph::new(&parallels(path, distance), &[], 0.0, |p| !path_index.has_within(p, distance - SLACK))
        .cycles()
}

/// The centre lines of a band along an edge.
pub(super) struct CenterLines {
    /// The closed ones.
    pub loops: Vec<Path>,
    /// Those along slots and islands that are as wide as the band: it seals them once.
    pub spines: Vec<Path>,
}

/// The centre lines of a band `half` mm to the right of the closed `edge`. Fabric that is wider or narrower than the band by at most
/// `join` is as wide as the band.
pub(super) fn center_lines(edge: &Path, half: f64, join: f64) -> CenterLines {
    let edge_index = SegmentIndex::new(edge.segments.clone());
    let parallels = parallels(edge, half);
    let is_nearly_free = |p: Point| !edge_index.has_within(p, half - 1.05 * join);
    let spines = Spines::of(&parallels, half, join, is_nearly_free);
    let graph =
        OffsetGraph::new(&parallels, &spines.shared, join, |p| !edge_index.has_within(p, half - SLACK));
    let mut loops = graph.cycles();
    if !spines.paths.is_empty() {
        // At the round end of a slot that is a little wider than the band a crumb is left.
        loops.retain(|cycle| cycle.area().abs() > join * cycle.length());
    }
    CenterLines { loops, spines: spines.paths }
}

/// The parallels `distance` mm to the right of the segments of a closed path, each that turns away joined to the next by an arc.
fn parallels(path: &Path, distance: f64) -> Vec<Segment> {
    let halves: Vec<Segment> = path.segments.iter().flat_map(halves).collect();
    let count = halves.len();
    let mut ends: Vec<[Point; 2]> = halves.iter().map(|half| parallel_ends(half, distance)).collect();
    let mut rounds: Vec<Option<Segment>> = vec![None; count];
    for i in 0..count {
        let next = (i + 1) % count;
        let (end, start) = (ends[i][1], ends[next][0]);
        if end.distance(start) <= ONE {
            let joint = end.midpoint(start);
            (ends[i][1], ends[next][0]) = (joint, joint);
            continue;
        }
        let (arriving, leaving) = (halves[i].tangent(1.0), halves[next].tangent(0.0));
        let turn = libm::atan2(arriving.cross(leaving), arriving.dot(leaving));
        // Half a turn is the end of a path that leads there and back.
        if !(FOLDED - PI..=0.0).contains(&turn) {
            let corner = halves[i].end();
            rounds[i] = Some(Arc::new(corner, distance, (end - corner).angle(), turn.rem_euclid(TAU)).into());
        }
    }
    let parallel = |(half, [start, end]): (&Segment, &[Point; 2])| {
        let parallel = match half {
            Segment::Line(_) => Some(Line::new(*start, *end).into()),
            Segment::Arc(arc) => {
                let radius = arc.radius + distance * arc.sweep.signum();
                let shape = Arc { radius, ..*arc }.into();
                // One that is rounding alone is a point, but leads from its neighbour to the next.
                let point = (radius.abs() <= ONE).then(|| Line::new(*start, *end).into());
                if radius > ONE { Some(moved(shape, *start, *end)) } else { point }
            }
        };
        parallel.filter(|parallel| parallel.length() > NOTHING)
    };
    let parallels = halves.iter().zip(&ends).map(parallel).zip(rounds);
    parallels.flat_map(|(parallel, round)| [parallel, round]).flatten().collect()
}

/// The ends of the parallel `distance` mm to the right of a segment.
fn parallel_ends(segment: &Segment, distance: f64) -> [Point; 2] {
    [0.0, 1.0].map(|t| segment.point(t) - segment.tangent(t).perp() * distance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    /// A rectangle with round corners, written with numbers of `decimals`: lines and arcs no longer touch.
    fn rounded(turn: f64, decimals: i32) -> Path {
        let scale = 10_f64.powi(decimals);
        let at = |x: f64, y: f64| {
            let (sine, cosine) = turn.sin_cos();
            let p = Point::new(90.0 + cosine * x - sine * y, 70.0 + sine * x + cosine * y);
            Point::new((p.x * scale).round() / scale, (p.y * scale).round() / scale)
        };
        let (w, h, r) = (10.0, 8.0, 3.0);
        let corners =
            [(-w + r, -h), (w - r, -h), (w, -h + r), (w, h - r)].map(|(x, y)| (at(x, y), at(-x, -y)));
        let corners: Vec<Point> = corners.iter().map(|c| c.0).chain(corners.iter().map(|c| c.1)).collect();
        let bulge = (FRAC_PI_2 / 4.0).tan();
        let side = |i: usize| {
            let (a, b) = (corners[i], corners[(i + 1) % 8]);
            let arc = (i % 2 == 1).then(|| Arc::from_bulge(a, b, bulge)).flatten();
            arc.map_or_else(|| Line::new(a, b).into(), Segment::from)
        };
        Path::closed((0..8).map(side).collect())
    }

    /// Steiner's formula. Files have six decimals, or nine and a scale: their lines miss the tangents of their arcs by that.
    #[test]
    fn lines_and_arcs_that_touch_to_a_files_decimals_are_offset() {
        for decimals in 3..13 {
            for i in 0..20 {
                let path = rounded(0.3 * f64::from(i), decimals);
                for by in [1.0, -1.0] {
                    let loops = offset_right(&path, by);
                    let want = path.area() + by * path.length() + PI;
                    let [line] = loops.as_slice() else {
                        panic!("{decimals} {i} {by}: {} loops", loops.len())
                    };
                    assert!((line.area() - want).abs() < 0.05, "{decimals} {i} {by}: {}", line.area() - want);
                }
            }
        }
    }

    /// Around `center`, in arcs of the `turns` of a area turn, with numbers of `decimals`.
    fn circle_of_arcs(center: Point, radius: f64, turns: &[f64], decimals: i32) -> Path {
        let scale = 10_f64.powi(decimals);
        let at = |turn: f64| {
            let p = center + geom::Vec2::unit(0.7 + TAU * turn) * radius;
            Point::new((p.x * scale).round() / scale, (p.y * scale).round() / scale)
        };
        let arc = |(i, turn): (usize, &f64)| {
            let before: f64 = turns[..i].iter().sum();
            let end = if i + 1 == turns.len() { 0.0 } else { before + turn };
            Segment::from(Arc::from_bulge(at(before), at(end), (TAU * turn / 4.0).tan()).expect("an arc"))
        };
        Path::closed(turns.iter().enumerate().map(arc).collect())
    }

    #[test]
    fn circles_of_rounded_arcs_have_one_offset() {
        let center = Point::new(97.3, 131.9);
        for decimals in 2..10 {
            for i in 0..40 {
                let share = 0.2 + 0.01 * f64::from(i);
                for turns in [vec![share, 0.35, 0.65 - share], vec![0.25, share, 0.1, 0.65 - share]] {
                    let radius = 1.0 + 0.2 * f64::from(i);
                    let path = circle_of_arcs(center, radius, &turns, decimals);
                    for by in [1.0, 10.0, -0.5] {
                        let loops = offset_right(&path, by);
                        let [line] = loops.as_slice() else {
                            panic!("{decimals} {i} {by}: {} loops", loops.len())
                        };
                        let off = line.area() - PI * (radius + by).powi(2);
                        assert!(
                            off.abs() < 40.0 * (radius + by) * 10_f64.powi(-decimals) + 1e-3,
                            "{decimals} {i} {by}: {off}"
                        );
                    }
                }
            }
        }
    }

    /// Into an island whose corners have the radius of the offset, by numbers of few decimals.
    #[test]
    fn corners_as_round_as_the_offset_become_points() {
        for decimals in 2..10 {
            for i in 0..60 {
                let path = rounded(0.1 * f64::from(i), decimals);
                let loops = offset_right(&path, -3.0);
                let [line] = loops.as_slice() else { panic!("{decimals} {i}: {} loops", loops.len()) };
                assert!((line.area() - 14.0 * 10.0).abs() < 0.5, "{decimals} {i}: {}", line.area());
            }
        }
    }

    /// A slot and an island as wide as the band have a spine, whatever the turn and the end.
    #[test]
    fn fabric_as_wide_as_the_band_has_a_spine() {
        for i in 0..16 {
            let turned = |points: &[(f64, f64)]| {
                let (sine, cosine) = libm::sincos(0.4 * f64::from(i));
                let points: Vec<Point> = points
                    .iter()
                    .map(|(x, y)| Point::new(cosine * x - sine * y, sine * x + cosine * y))
                    .collect();
                Path::polygon(&points)
            };
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
                let lines = center_lines(&turned(&slot), 1.0, 0.02);
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
                let island = turned(&[(a, 10.0), (a, 30.0), (b, 30.0), (b, 10.0)]);
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
