//! Pieces joined end to end: a **network** of edges between nodes. A node is where more than two edges meet, or where one ends
//! in the open; an edge that meets no node is closed.

use crate::graph::DisjointSets;
use crate::pieces::{NOTHING, Piece, with_end, with_start};
use crate::segments::{PathSegment, Segments};
use geom::order::sort_by;
use geom::{Bounds, BoxIndex, Path, Point};

/// Ends nearer than this meet exactly, mm.
const EXACT: f64 = 1e-6;

/// A run of curves from node to node.
#[derive(Clone, Debug)]
pub(crate) struct NetworkEdge {
    /// The run.
    pub path: Path,
    /// The nodes at its ends; `None` for a closed one without a node.
    pub nodes: Option<[usize; 2]>,
    /// The numbers of the curves that it is made of.
    pub sources: Vec<usize>,
}

/// Edges and nodes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Network {
    pub nodes: Vec<Point>,
    pub edges: Vec<NetworkEdge>,
    /// Ends that were joined over a gap.
    pub closed_gaps: Vec<ClosedGap>,
}

/// A gap between ends that were joined.
#[derive(Clone, Debug)]
pub(crate) struct ClosedGap {
    /// The numbers of the curves.
    pub sources: Vec<usize>,
    pub place: Point,
    /// Width of the gap, mm.
    pub width: f64,
}

/// An end of an edge that no other edge meets.
pub(crate) struct NetworkEnd {
    pub node: usize,
    pub edge: usize,
    /// Whether it is the last end of the edge, not the first.
    pub is_last: bool,
}

impl Network {
    /// The nodes at which a single edge ends.
    pub(crate) fn free_ends(&self) -> Vec<NetworkEnd> {
        let ends = ends_at(&self.edges, self.nodes.len());
        let single = ends.iter().enumerate().filter(|(_, ends)| ends.len() == 1);
        single.map(|(node, ends)| NetworkEnd { node, edge: ends[0].edge, is_last: ends[0].is_last }).collect()
    }
}

/// An end of an edge.
#[derive(Clone, Copy, PartialEq)]
struct EdgeEnd {
    edge: usize,
    is_last: bool,
}

impl EdgeEnd {
    /// The end across the edge.
    fn opposite(self) -> Self {
        Self { is_last: !self.is_last, ..self }
    }
}

/// The ends of `edges` at each of so many `nodes`.
fn ends_at(edges: &[NetworkEdge], nodes: usize) -> Vec<Vec<EdgeEnd>> {
    let mut ends = vec![Vec::new(); nodes];
    for (number, edge) in edges.iter().enumerate() {
        for (node, is_last) in edge.nodes.iter().flatten().zip([false, true]) {
            ends[*node].push(EdgeEnd { edge: number, is_last });
        }
    }
    ends
}

/// An end of an open piece.
struct PieceEnd {
    piece: usize,
    is_last: bool,
    place: Point,
}

/// The pieces, joined where they come within `join` of each other: end to end, or an end to the side of another. Short ones are first
/// joined to those that they meet exactly: their own ends may be nearer to each other than `join`.
pub(crate) fn network(pieces: &[Piece], join: f64) -> Network {
    let is_short = |piece: &Piece| !piece.path.closed && piece.path.length() <= 4.0 * join;
    if !pieces.iter().any(is_short) || join <= EXACT {
        return network_within(pieces, join);
    }
    let exact = |edge: NetworkEdge| Piece { path: edge.path, source: edge.sources[0] };
    let chains: Vec<Piece> = network_within(pieces, EXACT).edges.into_iter().map(exact).collect();
    network_within(&chains, join)
}

/// The pieces, joined where they come within `join` of each other.
///
/// Ends that lie together are one group, and that a node. A group at the side of a piece cuts the piece there. The parts between nodes
/// are then run together where just two of them meet.
fn network_within(pieces: &[Piece], join: f64) -> Network {
    let ends: Vec<PieceEnd> =
        pieces.iter().enumerate().flat_map(|(number, piece)| piece_ends(number, &piece.path)).collect();
    let groups = Groups::new(&ends, join);
    let mut nodes: Vec<Point> = groups.places(&ends);
    let mut closed_gaps = groups.gaps(&ends, &nodes, pieces);
    let mut cuts: Vec<Vec<CutStop>> = vec![Vec::new(); pieces.len()];
    for touch in touches(pieces, &ends, &groups, join) {
        if touch.gap > NOTHING {
            let sources = vec![pieces[touch.toucher].source, pieces[touch.piece].source];
            closed_gaps.push(ClosedGap { sources, place: touch.place, width: touch.gap });
        }
        nodes[touch.group] = touch.place;
        cuts[touch.piece].push(CutStop { station: touch.station, node: touch.group });
    }
    let mut parts = Vec::new();
    let mut next = 0;
    for (piece, cuts) in pieces.iter().zip(&mut cuts) {
        let end_nodes = (!piece.path.closed).then(|| {
            next += 2;
            [groups.group_of[next - 2], groups.group_of[next - 1]]
        });
        sort_by(cuts, |a, b| a.station.total_cmp(&b.station));
        parts.extend(split(piece, end_nodes, cuts, &nodes, join));
    }
    Network { edges: chained(&parts, nodes.len()), nodes, closed_gaps }
}

/// The two ends of the open piece number `piece` along `path`.
fn piece_ends(piece: usize, path: &Path) -> impl Iterator<Item = PieceEnd> {
    let places = if path.closed { [None, None] } else { [path.start(), path.end()] };
    let ends = places.into_iter().zip([false, true]);
    ends.filter_map(move |(place, is_last)| Some(PieceEnd { piece, is_last, place: place? }))
}

/// Ends that lie together, by number.
struct Groups {
    /// The group of each end.
    group_of: Vec<usize>,
    members: Vec<Vec<usize>>,
}

impl Groups {
    /// The groups of ends within `join` mm of each other, in the order of their first ends.
    fn new(ends: &[PieceEnd], join: f64) -> Self {
        let index = BoxIndex::new(ends.iter().map(|end| Bounds::of_points([end.place])));
        let mut near_ends = DisjointSets::new(ends.len());
        for (i, end) in ends.iter().enumerate() {
            for j in index.overlapping(&Bounds::of_points([end.place]).outset(join)) {
                if j < i && ends[j].place.distance(end.place) <= join {
                    near_ends.unite(i, j);
                }
            }
        }
        let mut number = vec![usize::MAX; ends.len()];
        let mut members: Vec<Vec<usize>> = Vec::new();
        let mut group_of = Vec::with_capacity(ends.len());
        for i in 0..ends.len() {
            let first_end = near_ends.least_member(i);
            if number[first_end] == usize::MAX {
                number[first_end] = members.len();
                members.push(Vec::new());
            }
            members[number[first_end]].push(i);
            group_of.push(number[first_end]);
        }
        Self { group_of, members }
    }

    /// The place of each group: the middle of its first two ends.
    fn places(&self, ends: &[PieceEnd]) -> Vec<Point> {
        let place = |group: &Vec<usize>| match group.as_slice() {
            [a, b, ..] if ends[*a].place.distance(ends[*b].place) > NOTHING => {
                ends[*a].place.midpoint(ends[*b].place)
            }
            _ => ends[group[0]].place,
        };
        self.members.iter().map(place).collect()
    }

    /// The gaps within groups, each at its node.
    fn gaps(&self, ends: &[PieceEnd], nodes: &[Point], pieces: &[Piece]) -> Vec<ClosedGap> {
        let gap = |(group, node): (&Vec<usize>, &Point)| {
            let distances = group.iter().map(|i| ends[group[0]].place.distance(ends[*i].place));
            let width = distances.fold(0.0, f64::max);
            let sources = group.iter().map(|i| pieces[ends[*i].piece].source).collect();
            (width > NOTHING).then_some(ClosedGap { sources, place: *node, width })
        };
        self.members.iter().zip(nodes).filter_map(gap).collect()
    }
}

/// A group of ends that lies at the side of a piece.
struct Touch {
    group: usize,
    piece: usize,
    /// Length of the piece before the place, mm.
    station: f64,
    place: Point,
    gap: f64,
    /// The piece of the group's first end.
    toucher: usize,
}

/// The nearest touch of each group with each piece within `join` mm.
///
/// The place of a group is that of its first end. Of all segments of a piece that come near to it the nearest counts. Beside its own end
/// every piece is near: there no touch is looked for.
fn touches(pieces: &[Piece], ends: &[PieceEnd], groups: &Groups, join: f64) -> Vec<Touch> {
    if ends.is_empty() {
        return Vec::new();
    }
    let segments = Segments::new(pieces.iter().map(|piece| &piece.path));
    let lengths: Vec<f64> = pieces.iter().map(|piece| piece.path.length()).collect();
    let mut touches: Vec<Touch> = Vec::new();
    for (group, members) in groups.members.iter().enumerate() {
        let PieceEnd { piece: toucher, place: end_place, .. } = ends[members[0]];
        let mut nearest: Vec<Touch> = Vec::new();
        for PathSegment { path: piece, before: length_before, segment, .. } in
            segments.overlapping(Bounds::of_points([end_place]).outset(join))
        {
            let (piece, t) = (*piece, segment.nearest_fraction(end_place));
            let place = segment.point(t);
            let (gap, station) = (place.distance(end_place), length_before + t * segment.length());
            let is_at_own_end = !pieces[piece].path.closed
                && members.iter().any(|end| {
                    let distance = if ends[*end].is_last { lengths[piece] - station } else { station };
                    ends[*end].piece == piece && distance <= 4.0 * join
                });
            if gap > join || is_at_own_end {
                continue;
            }
            let touch = Touch { group, piece, station, place, gap, toucher };
            match nearest.iter_mut().find(|earlier| earlier.piece == piece) {
                Some(earlier) if earlier.gap <= gap => {}
                Some(earlier) => *earlier = touch,
                None => nearest.push(touch),
            }
        }
        touches.extend(nearest);
    }
    touches
}

/// A place at which a piece is cut by a node.
#[derive(Clone, Copy)]
struct CutStop {
    /// Length of the piece before it, mm.
    station: f64,
    node: usize,
}

/// The parts of a piece between the nodes at its ends, `None` for a closed one, and the `cuts` at its side. A crumb between two ends that
/// were joined is left out.
fn split(
    piece: &Piece,
    end_nodes: Option<[usize; 2]>,
    cuts: &[CutStop],
    nodes: &[Point],
    join: f64,
) -> Vec<NetworkEdge> {
    let sources = vec![piece.source];
    let length = piece.path.length();
    let stops: Vec<CutStop> = match (end_nodes, cuts) {
        (None, []) => return vec![NetworkEdge { path: piece.path.clone(), nodes: None, sources }],
        (None, [first, ..]) => {
            [cuts, &[CutStop { station: first.station + length, node: first.node }]].concat()
        }
        (Some([start, end]), _) => {
            let ends = [CutStop { station: 0.0, node: start }, CutStop { station: length, node: end }];
            [&ends[..1], cuts, &ends[1..]].concat()
        }
    };
    let mut edges = Vec::new();
    for stop in stops.windows(2) {
        let [a, b] = [stop[0], stop[1]];
        let mut path =
            if cuts.is_empty() { piece.path.clone() } else { piece.path.part(a.station, b.station) };
        if a.node == b.node && path.length() <= 2.0 * join {
            continue;
        }
        if let Some(first) = path.segments.first_mut() {
            *first = with_start(first, nodes[a.node]);
        }
        if let Some(last) = path.segments.last_mut() {
            *last = with_end(last, nodes[b.node]);
            edges.push(NetworkEdge { path, nodes: Some([a.node, b.node]), sources: sources.clone() });
        }
    }
    edges
}

/// The edges, run together where just two of them meet. Runs from nodes come first, so that the remaining ones are closed.
fn chained(parts: &[NetworkEdge], nodes: usize) -> Vec<NetworkEdge> {
    let ends = ends_at(parts, nodes);
    let mut is_used = vec![false; parts.len()];
    let mut edges = Vec::new();
    for is_last in [false, true] {
        for (edge, part) in parts.iter().enumerate() {
            let begins = part.nodes.is_some_and(|nodes| ends[nodes[usize::from(is_last)]].len() != 2);
            if begins && !is_used[edge] {
                edges.push(run(parts, &ends, &mut is_used, EdgeEnd { edge, is_last }));
            }
        }
    }
    for edge in 0..parts.len() {
        if !is_used[edge] {
            edges.push(run(parts, &ends, &mut is_used, EdgeEnd { edge, is_last: false }));
        }
    }
    edges
}

/// The run that begins at the end `begin`, as far as no other part meets it.
///
/// It goes on from part to part where just two ends meet, and is closed where it comes back to its start. A part without nodes is a run by
/// itself.
fn run(
    parts: &[NetworkEdge],
    ends: &[Vec<EdgeEnd>],
    is_used: &mut [bool],
    mut begin: EdgeEnd,
) -> NetworkEdge {
    let Some(first) = parts[begin.edge].nodes.map(|nodes| nodes[usize::from(begin.is_last)]) else {
        is_used[begin.edge] = true;
        return parts[begin.edge].clone();
    };
    let (mut segments, mut sources) = (Vec::new(), Vec::new());
    loop {
        is_used[begin.edge] = true;
        let part = &parts[begin.edge];
        let path = if begin.is_last { part.path.reversed() } else { part.path.clone() };
        segments.extend(path.segments);
        sources.extend(part.sources.iter().copied());
        let last = part.nodes.map_or(first, |nodes| nodes[usize::from(!begin.is_last)]);
        let onward = ends[last].iter().find(|end| !is_used[end.edge] && **end != begin.opposite());
        match onward {
            Some(end) if ends[last].len() == 2 => begin = *end,
            _ => {
                sources.sort_unstable();
                sources.dedup();
                let closed = last == first && ends[last].len() == 2;
                let nodes = (!closed).then_some([first, last]);
                return NetworkEdge { path: Path { segments, closed }, nodes, sources };
            }
        }
    }
}
