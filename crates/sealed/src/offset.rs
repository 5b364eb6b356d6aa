//! Closed paths of lines and arcs, offset exactly.
//!
//! Every segment has a **parallel** at the distance. Where a path is tangent, to the rounding of a file, two parallels end in one point;
//! at a corner that turns away an arc around it joins them; at one that turns in they cross. Parallels are cut where they meet, stretches
//! nearer to the path than the distance are left out, and what remains is walked from **node** to node.

use std::f64::consts::{PI, TAU};

use cavalier_contours::polyline::{PlineSource, PlineSourceMut, Polyline};

use crate::clean::{with_end, with_start};
use crate::sets::DisjointSets;
use crate::spine::{SharedStretch, Spines};
use geom::{Arc, Bounds, BoxIndex, Line, Path, Point, Segment, SegmentIndex, intersections};

/// Points nearer than this are one, mm: a hundredth of the finest `path`. A joint is tangent whose parallels miss each other by less.
const ONE: f64 = 1e-5;
/// By how much a point of an offset may be nearer to its path than the distance, mm: joints and nodes are moved by [`ONE`].
const SLACK: f64 = 3e-5;
/// Turns that differ from half a turn by less are half a turn, rad.
const FOLDED: f64 = 1e-9;
/// A shared stretch that begins within this of the end of a parallel begins there, mm.
const CRUMB: f64 = 1e-3;
/// Segments shorter than this have no length, mm.
const SAME: f64 = 1e-9;
/// Neighbours that differ by less from one line or circle are one segment, mm: below the largest gap of a seam.
const ALIKE: f64 = 1e-10;

/// The closed paths at `by` mm to the right of the closed `path`: lines and arcs, round at corners that turn left, trimmed at those
/// that turn right. None where nothing is left; several where it falls apart.
pub fn offset_right(path: &Path, by: f64) -> Vec<Path> {
    if by == 0.0 {
        return vec![path.clone()];
    }
    if by < 0.0 {
        return offset_right(&path.reversed(), -by).iter().map(Path::reversed).collect();
    }
    let path_index = SegmentIndex::new(path.segments.clone());
    OffsetGraph::of(&parallels(path, by), &[], |p| !path_index.has_within(p, by - SLACK)).cycles()
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
    let graph = OffsetGraph::of(&parallels, &spines.shared, |p| !edge_index.has_within(p, half - SLACK));
    let mut loops = graph.cycles();
    if !spines.paths.is_empty() {
        // At the round end of a slot that is a little wider than the band a crumb is left.
        loops.retain(|cycle| cycle.area().abs() > join * cycle.length());
    }
    CenterLines { loops, spines: spines.paths }
}

/// The parallels `by` mm to the right of the segments of a closed path, each that turns away joined to the next by an arc.
fn parallels(path: &Path, by: f64) -> Vec<Segment> {
    let halves: Vec<Segment> = path.segments.iter().flat_map(halves).collect();
    let beside = |segment: &Segment, t: f64| segment.point(t) - segment.tangent(t).perp() * by;
    let count = halves.len();
    let mut ends: Vec<[Point; 2]> = halves.iter().map(|s| [beside(s, 0.0), beside(s, 1.0)]).collect();
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
            rounds[i] = Some(Arc::new(corner, by, (end - corner).angle(), turn.rem_euclid(TAU)).into());
        }
    }
    let parallel = |(half, [start, end]): (&Segment, &[Point; 2])| {
        let parallel = match half {
            Segment::Line(_) => Some(Line::new(*start, *end).into()),
            Segment::Arc(arc) => {
                let radius = arc.radius + by * arc.sweep.signum();
                let shape = Arc { radius, ..*arc }.into();
                // One that is rounding alone is a point, but leads from its neighbour to the next.
                let point = (radius.abs() <= ONE).then(|| Line::new(*start, *end).into());
                if radius > ONE { Some(moved(shape, *start, *end)) } else { point }
            }
        };
        parallel.filter(|parallel| parallel.length() > SAME)
    };
    let parallels = halves.iter().zip(&ends).map(parallel).zip(rounds);
    parallels.flat_map(|(parallel, round)| [parallel, round]).flatten().collect()
}

/// A segment in parts that turn by half a circle at most.
fn halves(segment: &Segment) -> impl Iterator<Item = Segment> {
    let count = match segment {
        Segment::Arc(arc) if arc.sweep.abs() > 3.0 => 2,
        _ => 1,
    };
    (0..count)
        .map(move |i| segment.part(f64::from(i) / f64::from(count), f64::from(i + 1) / f64::from(count)))
}

/// A stretch of a parallel between two nodes.
struct OffsetEdge {
    segment: Segment,
    nodes: [usize; 2],
}

/// The stretches of parallels that belong to an offset, in the order of its path.
struct OffsetGraph {
    nodes: usize,
    edges: Vec<OffsetEdge>,
}

/// Where parallels are cut.
struct ParallelCuts {
    /// Fraction and place of each cut of each parallel: its start, its end, then those between.
    places: Vec<Vec<(f64, Point)>>,
    /// Pairs of cuts that are one although they may lie apart, each by the number of its parallel and its own.
    alike: Vec<[[usize; 2]; 2]>,
    /// The stretches of each parallel that are left out, by fractions.
    removed: Vec<Vec<[f64; 2]>>,
}

impl ParallelCuts {
    /// The cuts of `parallels` at their ends, where they meet or one ends on another, and at the ends of what is shared.
    fn of(parallels: &[Segment], shared: &[SharedStretch]) -> Self {
        let ends = |line: &Segment| vec![(0.0, line.start()), (1.0, line.end())];
        let mut cuts = Self {
            places: parallels.iter().map(ends).collect(),
            alike: Vec::new(),
            removed: vec![Vec::new(); parallels.len()],
        };
        for stretch in shared {
            cuts.add_shared(stretch, parallels);
        }
        let boxes: Vec<Bounds> = parallels.iter().map(Segment::bounds).collect();
        let index = BoxIndex::new(boxes.iter().copied());
        for (i, line) in parallels.iter().enumerate() {
            index.visit(&boxes[i], |j| {
                let met = if j < i { intersections(line, &parallels[j]) } else { Vec::new() };
                for p in met {
                    cuts.places[i].push((line.nearest_fraction(p), p));
                    cuts.places[j].push((parallels[j].nearest_fraction(p), p));
                }
            });
            // An end that misses another parallel by rounding lies on it.
            for end in [line.start(), line.end()] {
                index.visit(&Bounds::of_points([end]).grown(ONE), |j| {
                    let fraction = parallels[j].nearest_fraction(end);
                    if i != j && parallels[j].point(fraction).distance(end) <= ONE {
                        cuts.places[j].push((fraction, end));
                    }
                });
            }
        }
        cuts
    }

    /// Adds the ends of a shared stretch. Where both parallels begin or end there, what leads to one goes on from the other.
    fn add_shared(
        &mut self,
        SharedStretch { lines, fractions, ends }: &SharedStretch,
        parallels: &[Segment],
    ) {
        for (line, fractions) in lines.iter().zip(fractions) {
            for (fraction, place) in fractions.iter().zip(ends) {
                let number = self.places[*line].len();
                self.places[*line].push((*fraction, *place));
                let end = usize::from(*fraction > 0.5);
                if fraction.min(1.0 - fraction) * parallels[*line].length() < CRUMB {
                    self.alike.push([[*line, end], [*line, number]]);
                }
            }
            self.removed[*line].push([fractions[0].min(fractions[1]), fractions[0].max(fractions[1])]);
        }
    }
}

impl OffsetGraph {
    /// The stretches of `parallels` whose middle `is_free`, without those that are `shared`. Cuts at one place are one node, and the
    /// stretches are moved to it.
    fn of(parallels: &[Segment], shared: &[SharedStretch], is_free: impl Fn(Point) -> bool) -> Self {
        let cuts = ParallelCuts::of(parallels, shared);
        let places: Vec<Point> = cuts.places.iter().flatten().map(|(_, place)| *place).collect();
        let firsts: Vec<usize> = cuts
            .places
            .iter()
            .scan(0, |next, cuts| Some(std::mem::replace(next, *next + cuts.len())))
            .collect();
        let alike: Vec<[usize; 2]> =
            cuts.alike.iter().map(|pair| pair.map(|[line, number]| firsts[line] + number)).collect();
        let nodes = clusters(&places, &alike);
        let mut edges = Vec::new();
        for (number, line) in parallels.iter().enumerate() {
            let own_nodes = &nodes[firsts[number]..];
            let stop = |(cut, node): (&(f64, Point), &usize)| (cut.0, *node);
            let mut stops: Vec<(f64, usize)> = cuts.places[number].iter().zip(own_nodes).map(stop).collect();
            // Of cuts at an end of the parallel the end itself is the outermost, and those in its node add nothing.
            let [start, end] = [stops[0], stops[1]];
            let mut between = stops.split_off(2);
            between.retain(|(_, node)| *node != start.1 && *node != end.1);
            between.sort_by(|a, b| a.0.total_cmp(&b.0));
            let stops = [&[start][..], &between, &[end]].concat();
            for pair in stops.windows(2) {
                let [(from, a), (to, b)] = [pair[0], pair[1]];
                let middle = f64::midpoint(from, to);
                let is_removed =
                    cuts.removed[number].iter().any(|[low, high]| *low < middle && middle < *high);
                if a != b && !is_removed && is_free(line.point(middle)) {
                    edges.push(OffsetEdge {
                        segment: moved(line.part(from, to), places[a], places[b]),
                        nodes: [a, b],
                    });
                }
            }
        }
        Self { nodes: places.len(), edges }
    }

    /// The closed paths along the edges, without those that enclose nothing.
    ///
    /// A walk goes on along a path as long as it can, so that a path that touches itself stays one. What leads to a dead end, or there
    /// and back, is left out.
    fn cycles(&self) -> Vec<Path> {
        let mut leaving: Vec<Vec<usize>> = vec![Vec::new(); self.nodes];
        for (number, edge) in self.edges.iter().enumerate().rev() {
            leaving[edge.nodes[0]].push(number);
        }
        let path = |walk: &[usize]| Path::closed(walk.iter().map(|edge| self.edges[*edge].segment).collect());
        let is_flat = |cycle: &Path| cycle.area().abs() <= 10.0 * ONE * cycle.length();
        let mut cycles = Vec::new();
        // The number of edges of the present walk before it first came to each node.
        let mut before: Vec<Option<usize>> = vec![None; self.nodes];
        for start in 0..self.edges.len() {
            let first_node = self.edges[start].nodes[0];
            let (mut walk, mut node): (Vec<usize>, usize) = (Vec::new(), first_node);
            before[node] = Some(0);
            loop {
                let next = walk.last().map_or(start, |last| (last + 1) % self.edges.len());
                let onward = leaving[node].iter().position(|edge| *edge == next);
                if node == first_node && !walk.is_empty() && onward.is_none() {
                    cycles.push(path(&walk));
                    break;
                }
                let Some(place) = onward.or_else(|| leaving[node].len().checked_sub(1)) else {
                    // A dead end: the walk closed here, or what led here is left out.
                    let first = before[node].filter(|first| *first < walk.len());
                    let cycle = walk.split_off(first.unwrap_or(walk.len().saturating_sub(1)));
                    for edge in cycle.iter().skip(1) {
                        before[self.edges[*edge].nodes[0]] = None;
                    }
                    if first.is_some() {
                        cycles.push(path(&cycle));
                        continue;
                    }
                    before[node] = None;
                    let Some(last) = cycle.first() else { break };
                    node = self.edges[*last].nodes[0];
                    continue;
                };
                let number = leaving[node].remove(place);
                walk.push(number);
                node = self.edges[number].nodes[1];
                match before[node] {
                    Some(first) if first > 0 && is_flat(&path(&walk[first..])) => walk.truncate(first),
                    Some(_) => {}
                    None => before[node] = Some(walk.len()),
                }
            }
            for edge in walk {
                self.edges[edge].nodes.iter().for_each(|node| before[*node] = None);
            }
        }
        cycles.iter().filter(|cycle| !is_flat(cycle)).map(merged).collect()
    }
}

/// A stretch between other ends; a line where it is no longer than they are apart.
fn moved(stretch: Segment, start: Point, end: Point) -> Segment {
    if stretch.length() <= ONE {
        return Line::new(start, end).into();
    }
    with_end(&with_start(&stretch, start), end)
}

/// The number of the first place of those that lie together with each of `places`, or are `alike`.
fn clusters(places: &[Point], alike: &[[usize; 2]]) -> Vec<usize> {
    let index = BoxIndex::new(places.iter().map(|place| Bounds::of_points([*place])));
    let mut nodes = DisjointSets::new(places.len());
    for [i, j] in alike {
        nodes.unite(*i, *j);
    }
    for (i, place) in places.iter().enumerate() {
        index.visit(&Bounds::of_points([*place]).grown(ONE), |j| {
            if j < i && places[j].distance(*place) <= ONE {
                nodes.unite(i, j);
            }
        });
    }
    nodes.all()
}

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

    /// Around `center`, in arcs of the `turns` of a whole turn, with numbers of `decimals`.
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
                let whole = 62.0 * 42.0 - 4.0 + PI;
                assert!(
                    (lines.loops[0].area() - whole).abs() < 0.5,
                    "{i} {width}: {}",
                    lines.loops[0].area() - whole
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
}
