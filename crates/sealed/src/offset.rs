//! Closed paths of lines and arcs, offset exactly.
//!
//! Every segment has a **parallel** at the distance. Where a path is tangent, to the rounding of a file, two parallels end in one point;
//! at a corner that turns away an arc around it joins them; at one that turns in they cross. The offset is what `OffsetGraph` finds along
//! them.

use std::f64::consts::{PI, TAU};

use crate::offset_graph::{ONE, OffsetGraph, moved};
use crate::pieces::NOTHING;
use crate::polyline::halves;
use geom::{Arc, Line, Path, Point, Segment, SegmentIndex};

/// By how much a point of an offset may be nearer to its path than the distance, mm: joints and nodes are moved by [`ONE`].
pub(super) const SLACK: f64 = 3e-5;
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

/// The parallels `distance` mm to the right of the segments of a closed path, each that turns away joined to the next by an arc.
///
/// Ends of neighbours that miss each other by rounding are moved to one joint first. A turn by half is the end of a path that leads there
/// and back, and is joined as one that turns away.
pub(super) fn parallels(path: &Path, distance: f64) -> Vec<Segment> {
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
        if !(FOLDED - PI..=0.0).contains(&turn) {
            let corner = halves[i].end();
            rounds[i] = Some(Arc::new(corner, distance, (end - corner).angle(), turn.rem_euclid(TAU)).into());
        }
    }
    let parallels = halves.iter().zip(&ends).map(|(half, ends)| parallel(half, *ends, distance)).zip(rounds);
    parallels.flat_map(|(parallel, round)| [parallel, round]).flatten().collect()
}

/// The parallel of `half` between `ends`; none where the arc is sharper than the distance. One that is rounding alone is a point, but leads
/// from its neighbour to the next.
fn parallel(half: &Segment, ends: [Point; 2], distance: f64) -> Option<Segment> {
    let [start, end] = ends;
    let parallel = match half {
        Segment::Line(_) => Some(Line::new(start, end).into()),
        Segment::Arc(arc) => {
            let radius = arc.radius + distance * arc.sweep.signum();
            let shape = Arc { radius, ..*arc }.into();
            let point = (radius.abs() <= ONE).then(|| Line::new(start, end).into());
            if radius > ONE { Some(moved(shape, start, end)) } else { point }
        }
    };
    parallel.filter(|parallel| parallel.length() > NOTHING)
}

/// The ends of the parallel `distance` mm to the right of a segment.
fn parallel_ends(segment: &Segment, distance: f64) -> [Point; 2] {
    [0.0, 1.0].map(|t| segment.point(t) - segment.tangent(t).perp() * distance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    /// A number written with so many decimals.
    fn decimal(number: f64, decimals: i32) -> f64 {
        let scale = 10_f64.powi(decimals);
        (number * scale).round() / scale
    }

    /// A rectangle with round corners, written with numbers of `decimals`: lines and arcs no longer touch.
    fn rounded(turn: f64, decimals: i32) -> Path {
        let (sine, cosine) = turn.sin_cos();
        let (w, h, r) = (10.0, 8.0, 3.0);
        let half = [(-w + r, -h), (w - r, -h), (w, -h + r), (w, h - r)];
        let points = half.into_iter().chain(half.map(|(x, y)| (-x, -y))).map(|(x, y)| {
            Point::new(
                decimal(90.0 + cosine * x - sine * y, decimals),
                decimal(70.0 + sine * x + cosine * y, decimals),
            )
        });
        let corners: Vec<Point> = points.collect();
        let bulge = (FRAC_PI_2 / 4.0).tan();
        let sides = (0..8).map(|i| {
            let (a, b) = (corners[i], corners[(i + 1) % 8]);
            let arc = (i % 2 == 1).then(|| Arc::from_bulge(a, b, bulge)).flatten();
            arc.map_or_else(|| Line::new(a, b).into(), Segment::from)
        });
        Path::closed(sides.collect())
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

    /// Around `center`, in arcs of the `turns`, parts of a whole turn, with numbers of `decimals`.
    fn circle_of_arcs(center: Point, radius: f64, turns: &[f64], decimals: i32) -> Path {
        let mut ends = vec![0.0];
        ends.extend(turns.iter().scan(0.0, |sum, turn| {
            *sum += turn;
            Some(*sum)
        }));
        ends[turns.len()] = 0.0;
        let points = ends.iter().map(|turn| center + geom::Vec2::unit(0.7 + TAU * turn) * radius);
        let points: Vec<Point> =
            points.map(|p| Point::new(decimal(p.x, decimals), decimal(p.y, decimals))).collect();
        let arcs = turns.iter().zip(points.windows(2)).map(|(turn, pair)| {
            Segment::from(Arc::from_bulge(pair[0], pair[1], (TAU * turn / 4.0).tan()).expect("an arc"))
        });
        Path::closed(arcs.collect())
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
                        let error = line.area() - PI * (radius + by).powi(2);
                        assert!(
                            error.abs() < 40.0 * (radius + by) * 10_f64.powi(-decimals) + 1e-3,
                            "{decimals} {i} {by}: {error}"
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
}
