//! The **offset graph**: parallels of a path, cut into stretches between nodes, and the closed paths along them.
//!
//! Parallels are cut where they meet. Stretches nearer to the path than the distance are left out, and what remains is walked from **node**
//! to node.

use crate::graph::DisjointSets;
use crate::pieces::{NOTHING, with_end, with_start};
use geom::order::sort_by;
use geom::{Arc, Bounds, BoxIndex, Line, Path, Point, Segment, intersections};

/// Points nearer than this are one, mm: a hundredth of the finest `path`. A joint is tangent whose parallels miss each other by less.
pub(super) const ONE: f64 = 1e-5;

/// A stretch that two parallels share, which run in opposite directions.
pub(super) struct SharedStretch {
    /// The numbers of the parallels.
    pub lines: [usize; 2],
    /// Where the stretch begins and ends on each, in the direction of the first.
    pub fractions: [[f64; 2]; 2],
    /// Where it begins and ends.
    pub ends: [Point; 2],
}

/// A stretch of a parallel between two nodes.
struct OffsetEdge {
    segment: Segment,
    nodes: [usize; 2],
}

/// The stretches of parallels that belong to an offset, in the order of its path.
pub(super) struct OffsetGraph {
    nodes: usize,
    edges: Vec<OffsetEdge>,
}

/// Where parallels are cut.
struct ParallelCuts {
    /// Fraction and place of each cut of each parallel: its start, its end, then those inner.
    places: Vec<Vec<(f64, Point)>>,
    /// Pairs of cuts that are one although they may lie apart, each by the number of its parallel and its own.
    alike: Vec<[[usize; 2]; 2]>,
    /// The stretches of each parallel that are left out, by fractions.
    removed: Vec<Vec<[f64; 2]>>,
}

impl ParallelCuts {
    /// The cuts of `parallels` at their ends, where they meet or one ends on another, and at the ends of what is shared.
    fn new(parallels: &[Segment], shared: &[SharedStretch], reach: f64) -> Self {
        let ends = |line: &Segment| vec![(0.0, line.start()), (1.0, line.end())];
        let mut cuts = Self {
            places: parallels.iter().map(ends).collect(),
            alike: Vec::new(),
            removed: vec![Vec::new(); parallels.len()],
        };
        let numbers: Vec<[[usize; 2]; 2]> = shared.iter().map(|stretch| cuts.add_shared(stretch)).collect();
        let boxes: Vec<Bounds> = parallels.iter().map(Segment::bounds).collect();
        let index = BoxIndex::new(boxes.iter().copied());
        for (i, line) in parallels.iter().enumerate() {
            index.visit(&boxes[i], |j| {
                let crossings = if j < i { intersections(line, &parallels[j]) } else { Vec::new() };
                for p in crossings {
                    cuts.places[i].push((line.nearest_fraction(p), p));
                    cuts.places[j].push((parallels[j].nearest_fraction(p), p));
                }
            });
            // An end that misses another parallel by rounding lies on it.
            for end in [line.start(), line.end()] {
                index.visit(&Bounds::of_points([end]).outset(ONE), |j| {
                    let fraction = parallels[j].nearest_fraction(end);
                    if i != j && parallels[j].point(fraction).distance(end) <= ONE {
                        cuts.places[j].push((fraction, end));
                    }
                });
            }
        }
        for (stretch, numbers) in shared.iter().zip(numbers) {
            cuts.unite_ends(stretch, numbers, &index, reach);
        }
        cuts
    }

    /// Adds the ends of a shared stretch, and returns the numbers of the cuts on each of its two parallels.
    fn add_shared(&mut self, SharedStretch { lines, fractions, ends }: &SharedStretch) -> [[usize; 2]; 2] {
        let mut numbers = [[0; 2]; 2];
        for ((line, fractions), numbers) in lines.iter().zip(fractions).zip(&mut numbers) {
            for ((fraction, place), number) in fractions.iter().zip(ends).zip(numbers) {
                *number = self.places[*line].len();
                self.places[*line].push((*fraction, *place));
            }
            self.removed[*line].push([fractions[0].min(fractions[1]), fractions[0].max(fractions[1])]);
        }
        numbers
    }

    /// Notes that the cuts within `reach` mm of the ends of a shared stretch are one with them.
    fn unite_ends(
        &mut self,
        stretch: &SharedStretch,
        numbers: [[usize; 2]; 2],
        index: &BoxIndex,
        reach: f64,
    ) {
        for (end, place) in stretch.ends.iter().enumerate() {
            let (line, number) = (stretch.lines[0], numbers[0][end]);
            self.alike.push([[line, number], [stretch.lines[1], numbers[1][end]]]);
            index.visit(&Bounds::of_points([*place]).outset(reach), |parallel| {
                for (cut, (_, other)) in self.places[parallel].iter().enumerate() {
                    if other.distance(*place) <= reach {
                        self.alike.push([[parallel, cut], [line, number]]);
                    }
                }
            });
        }
    }
}

impl OffsetGraph {
    /// The stretches of `parallels` whose middle `is_free`, without those that are `shared`. Cuts at one place are one node, and the
    /// stretches are moved to it.
    ///
    /// Cuts within `reach` mm of an end of a shared stretch are one with it: what leads there goes on along the other of its parallels.
    pub(super) fn new(
        parallels: &[Segment],
        shared: &[SharedStretch],
        reach: f64,
        is_free: impl Fn(Point) -> bool,
    ) -> Self {
        let cuts = ParallelCuts::new(parallels, shared, reach);
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
            let mut inner = stops.split_off(2);
            inner.retain(|(_, node)| *node != start.1 && *node != end.1);
            sort_by(&mut inner, |a, b| a.0.total_cmp(&b.0));
            let stops = [&[start][..], &inner, &[end]].concat();
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
    pub(super) fn cycles(&self) -> Vec<Path> {
        let mut leaving: Vec<Vec<usize>> = vec![Vec::new(); self.nodes];
        for (number, edge) in self.edges.iter().enumerate().rev() {
            leaving[edge.nodes[0]].push(number);
        }
        let mut cycles = Vec::new();
        // The number of edges of the present walk before it first came to each node.
        let mut visits: Vec<Option<usize>> = vec![None; self.nodes];
        for start in 0..self.edges.len() {
            let first_node = self.edges[start].nodes[0];
            let (mut walk, mut node): (Vec<usize>, usize) = (Vec::new(), first_node);
            visits[node] = Some(0);
            loop {
                let next = walk.last().map_or(start, |last| (last + 1) % self.edges.len());
                let onward = leaving[node].iter().position(|edge| *edge == next);
                if node == first_node && !walk.is_empty() && onward.is_none() {
                    cycles.push(self.path(&walk));
                    break;
                }
                let Some(place) = onward.or_else(|| leaving[node].len().checked_sub(1)) else {
                    // A dead end: the walk closed here, or what led here is left out.
                    let first = visits[node].filter(|first| *first < walk.len());
                    let cycle = walk.split_off(first.unwrap_or(walk.len().saturating_sub(1)));
                    self.forget(&cycle, walk.len(), &mut visits);
                    if first.is_some() {
                        cycles.push(self.path(&cycle));
                        continue;
                    }
                    visits[node] = None;
                    let Some(last) = cycle.first() else { break };
                    node = self.edges[*last].nodes[0];
                    continue;
                };
                let number = leaving[node].remove(place);
                walk.push(number);
                node = self.edges[number].nodes[1];
                match visits[node] {
                    Some(first) if first > 0 && is_flat(&self.path(&walk[first..])) => {
                        self.forget(&walk[first..], first, &mut visits);
                        walk.truncate(first);
                    }
                    Some(_) => {}
                    None => visits[node] = Some(walk.len()),
                }
            }
            for edge in walk {
                self.edges[edge].nodes.iter().for_each(|node| visits[*node] = None);
            }
        }
        cycles.iter().filter(|cycle| !is_flat(cycle)).map(merged).collect()
    }

    /// Removes the visits later than after `length` edges from the nodes of a `stretch` that is no longer part of the walk.
    fn forget(&self, stretch: &[usize], length: usize, visits: &mut [Option<usize>]) {
        for edge in stretch {
            let visit = &mut visits[self.edges[*edge].nodes[0]];
            *visit = visit.filter(|number| *number <= length);
        }
    }

    /// The closed path along a walk.
    fn path(&self, walk: &[usize]) -> Path {
        Path::closed(walk.iter().map(|edge| self.edges[*edge].segment).collect())
    }
}

/// Whether a closed path encloses nothing.
fn is_flat(cycle: &Path) -> bool {
    cycle.area().abs() <= 10.0 * ONE * cycle.length()
}

/// A stretch between other ends; a line where it is no longer than they are apart.
pub(super) fn moved(stretch: Segment, start: Point, end: Point) -> Segment {
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
        index.visit(&Bounds::of_points([*place]).outset(ONE), |j| {
            if j < i && places[j].distance(*place) <= ONE {
                nodes.unite(i, j);
            }
        });
    }
    nodes.least_members()
}

/// Neighbours that differ by less from one line or circle are one segment, mm: below the largest gap of a seam.
const ALIKE: f64 = 1e-10;

/// The path with neighbours on one line or one circle as one segment, and without segments of no length.
pub(crate) fn merged(path: &Path) -> Path {
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
