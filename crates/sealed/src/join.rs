//! Pieces joined end to end: a **network** of edges between nodes. A node is where more than two edges meet, or where one ends
//! in the open; an edge that meets no node is closed.

use crate::clean::{NOTHING, Piece, with_end, with_start};
use crate::segments::{PathSegment, Segments};
use crate::sets::DisjointSets;
use geom::{Bounds, BoxIndex, Path, Point};

/// Ends nearer than this meet exactly, mm.
const EXACT: f64 = 1e-6;

/// A run of curves from node to node.
#[derive(Clone, Debug)]
pub(super) struct NetworkEdge {
    /// The run.
    pub path: Path,
    /// The nodes at its ends; `None` for a closed one without a node.
    pub nodes: Option<[usize; 2]>,
    /// The numbers of the curves that it is made of.
    pub sources: Vec<usize>,
}

/// Edges and nodes.
#[derive(Clone, Debug, Default)]
pub(super) struct Network {
    pub nodes: Vec<Point>,
    pub edges: Vec<NetworkEdge>,
    /// Ends that were joined over a gap: the curves, the place, the gap in mm.
    pub closed_gaps: Vec<(Vec<usize>, Point, f64)>,
}

impl Network {
    /// The nodes at which a single edge ends: node, edge, and which end.
    pub(super) fn free_ends(&self) -> Vec<(usize, usize, usize)> {
        let ends = ends_at(&self.edges, self.nodes.len());
        let single = ends.iter().enumerate().filter(|(_, ends)| ends.len() == 1);
        single.map(|(node, ends)| (node, ends[0].0, ends[0].1)).collect()
    }
}

/// The ends of `edges` at each of so many `nodes`: the edge, and which of its ends.
fn ends_at(edges: &[NetworkEdge], nodes: usize) -> Vec<Vec<(usize, usize)>> {
    let mut ends = vec![Vec::new(); nodes];
    for (number, edge) in edges.iter().enumerate() {
        for (which, node) in edge.nodes.iter().flatten().enumerate() {
            ends[*node].push((number, which));
        }
    }
    ends
}

/// An end of an open piece.
struct PieceEnd {
    piece: usize,
    last: bool,
    at: Point,
}

/// The pieces, joined where they come within `join` of each other: end to end, or an end to the side of another. Short ones are first
/// joined to those that they meet exactly: their own ends may be nearer to each other than `join`.
pub(super) fn network(pieces: &[Piece], join: f64) -> Network {
    let is_short = |piece: &Piece| !piece.path.closed && piece.path.length() <= 4.0 * join;
    if !pieces.iter().any(is_short) || join <= EXACT {
        return network_within(pieces, join);
    }
    let exact = |edge: NetworkEdge| Piece { path: edge.path, source: edge.sources[0] };
    let chains: Vec<Piece> = network_within(pieces, EXACT).edges.into_iter().map(exact).collect();
    network_within(&chains, join)
}

/// The pieces, joined where they come within `join` of each other.
fn network_within(pieces: &[Piece], join: f64) -> Network {
    let ends: Vec<PieceEnd> = pieces
        .iter()
        .enumerate()
        .filter(|(_, piece)| !piece.path.closed)
        .flat_map(|(number, Piece { path, .. })| {
            let end = |last, at: Option<Point>| at.map(|at| PieceEnd { piece: number, last, at });
            [end(false, path.start()), end(true, path.end())].into_iter().flatten()
        })
        .collect();
    let groups = Groups::of(&ends, join);
    let mut nodes: Vec<Point> = groups.places(&ends);
    let mut closed_gaps = groups.gaps(&ends, &nodes, pieces);
    let sides = sides(pieces, &ends, &groups, join);
    let mut cuts: Vec<Vec<(f64, usize)>> = vec![Vec::new(); pieces.len()];
    for TouchSide { group, piece, s, at, gap, from } in sides {
        if gap > NOTHING {
            closed_gaps.push((vec![pieces[from].source, pieces[piece].source], at, gap));
        }
        nodes[group] = at;
        cuts[piece].push((s, group));
    }
    let mut parts = Vec::new();
    let mut next = 0;
    for (number, piece) in pieces.iter().enumerate() {
        let own = if piece.path.closed {
            None
        } else {
            next += 2;
            Some([groups.of[next - 2], groups.of[next - 1]])
        };
        cuts[number].sort_by(|a, b| a.0.total_cmp(&b.0));
        parts.extend(split(piece, own, &cuts[number], &nodes, join));
    }
    Network { edges: chained(&parts, nodes.len()), nodes, closed_gaps }
}

/// Ends that lie together, by number.
struct Groups {
    /// The group of each end.
    of: Vec<usize>,
    members: Vec<Vec<usize>>,
}

impl Groups {
    fn of(ends: &[PieceEnd], join: f64) -> Self {
        let index = BoxIndex::new(ends.iter().map(|end| Bounds::of_points([end.at])));
        let mut near_ends = DisjointSets::new(ends.len());
        for (i, end) in ends.iter().enumerate() {
            for j in index.overlapping(&Bounds::of_points([end.at]).grown(join)) {
                if j < i && ends[j].at.distance(end.at) <= join {
                    near_ends.unite(i, j);
                }
            }
        }
        let mut number = vec![usize::MAX; ends.len()];
        let mut members: Vec<Vec<usize>> = Vec::new();
        let mut of = Vec::with_capacity(ends.len());
        for i in 0..ends.len() {
            let least = near_ends.least(i);
            if number[least] == usize::MAX {
                number[least] = members.len();
                members.push(Vec::new());
            }
            members[number[least]].push(i);
            of.push(number[least]);
        }
        Self { of, members }
    }

    /// The place of each group: the middle of its first two ends.
    fn places(&self, ends: &[PieceEnd]) -> Vec<Point> {
        let place = |group: &Vec<usize>| match group.as_slice() {
            [a, b, ..] if ends[*a].at.distance(ends[*b].at) > NOTHING => ends[*a].at.midpoint(ends[*b].at),
            _ => ends[group[0]].at,
        };
        self.members.iter().map(place).collect()
    }

    fn gaps(&self, ends: &[PieceEnd], nodes: &[Point], pieces: &[Piece]) -> Vec<(Vec<usize>, Point, f64)> {
        let gap = |(group, node): (&Vec<usize>, &Point)| {
            let far = |i: &usize| ends[group[0]].at.distance(ends[*i].at);
            let gap = group.iter().map(far).fold(0.0, f64::max);
            let sources = group.iter().map(|i| pieces[ends[*i].piece].source).collect();
            (gap > NOTHING).then_some((sources, *node, gap))
        };
        self.members.iter().zip(nodes).filter_map(gap).collect()
    }
}

/// A group of ends that lies at the side of a piece.
struct TouchSide {
    group: usize,
    piece: usize,
    s: f64,
    at: Point,
    gap: f64,
    from: usize,
}

fn sides(pieces: &[Piece], ends: &[PieceEnd], groups: &Groups, join: f64) -> Vec<TouchSide> {
    if ends.is_empty() {
        return Vec::new();
    }
    let segments = Segments::of(pieces.iter().map(|piece| &piece.path));
    let lengths: Vec<f64> = pieces.iter().map(|piece| piece.path.length()).collect();
    let mut sides: Vec<TouchSide> = Vec::new();
    for (group, members) in groups.members.iter().enumerate() {
        let PieceEnd { piece: from, at: place, .. } = ends[members[0]];
        let mut best: Vec<TouchSide> = Vec::new();
        for PathSegment { path: piece, before, segment, .. } in
            segments.near(Bounds::of_points([place]).grown(join))
        {
            let (piece, t) = (*piece, segment.nearest_fraction(place));
            let at = segment.point(t);
            let (gap, s) = (at.distance(place), before + t * segment.length());
            // Beside its own end every piece is near.
            let at_own_end = !pieces[piece].path.closed
                && members.iter().any(|end| {
                    let along = if ends[*end].last { lengths[piece] - s } else { s };
                    ends[*end].piece == piece && along <= 4.0 * join
                });
            if gap > join || at_own_end {
                continue;
            }
            let side = TouchSide { group, piece, s, at, gap, from };
            match best.iter_mut().find(|known| known.piece == piece) {
                Some(known) if known.gap <= gap => {}
                Some(known) => *known = side,
                None => best.push(side),
            }
        }
        sides.extend(best);
    }
    sides
}

/// A piece between the nodes at its ends and at its side.
fn split(
    piece: &Piece,
    own: Option<[usize; 2]>,
    cuts: &[(f64, usize)],
    nodes: &[Point],
    join: f64,
) -> Vec<NetworkEdge> {
    let sources = vec![piece.source];
    let length = piece.path.length();
    let stops: Vec<(f64, usize)> = match (own, cuts) {
        (None, []) => return vec![NetworkEdge { path: piece.path.clone(), nodes: None, sources }],
        (None, [first, ..]) => cuts.iter().copied().chain([(first.0 + length, first.1)]).collect(),
        (Some([start, end]), _) => [&[(0.0, start)], cuts, &[(length, end)]].concat(),
    };
    let mut edges = Vec::new();
    for stop in stops.windows(2) {
        let [(from, a), (to, b)] = [stop[0], stop[1]];
        let mut path = if cuts.is_empty() { piece.path.clone() } else { piece.path.part(from, to) };
        // A crumb between two ends that were joined.
        if a == b && path.length() <= 2.0 * join {
            continue;
        }
        if let Some(first) = path.segments.first_mut() {
            *first = with_start(first, nodes[a]);
        }
        if let Some(last) = path.segments.last_mut() {
            *last = with_end(last, nodes[b]);
            edges.push(NetworkEdge { path, nodes: Some([a, b]), sources: sources.clone() });
        }
    }
    edges
}

/// The edges, run together where just two of them meet.
fn chained(parts: &[NetworkEdge], nodes: usize) -> Vec<NetworkEdge> {
    let ends = ends_at(parts, nodes);
    let is_node = |node: usize| ends[node].len() != 2;
    let mut used = vec![false; parts.len()];
    let mut edges = Vec::new();
    // Runs from nodes first, so that the remaining ones are closed.
    let begins =
        |which: usize| (0..parts.len()).filter(move |_| which < 2).map(move |number| (number, which));
    let open = begins(0)
        .chain(begins(1))
        .filter(|(number, which)| parts[*number].nodes.is_some_and(|nodes| is_node(nodes[*which])));
    let closed = (0..parts.len()).map(|number| (number, 0));
    for (number, which) in open.chain(closed) {
        if !used[number] {
            edges.push(run(parts, &ends, &mut used, (number, which)));
        }
    }
    edges
}

/// The run that begins at end `which` of part `number`.
fn run(
    parts: &[NetworkEdge],
    ends: &[Vec<(usize, usize)>],
    used: &mut [bool],
    begin: (usize, usize),
) -> NetworkEdge {
    let (mut number, mut which) = begin;
    let Some(first) = parts[number].nodes.map(|nodes| nodes[which]) else {
        used[number] = true;
        return parts[number].clone();
    };
    let (mut segments, mut sources) = (Vec::new(), Vec::new());
    loop {
        used[number] = true;
        let part = &parts[number];
        let path = if which == 0 { part.path.clone() } else { part.path.reversed() };
        segments.extend(path.segments);
        sources.extend(part.sources.iter().copied());
        let last = part.nodes.map_or(first, |nodes| nodes[1 - which]);
        let onward =
            ends[last].iter().find(|(other, end)| !used[*other] && (*other, *end) != (number, 1 - which));
        match onward {
            Some((other, end)) if ends[last].len() == 2 => (number, which) = (*other, *end),
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
