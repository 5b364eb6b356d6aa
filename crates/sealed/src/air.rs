//! The region of the air: edges with air on one side are **boundaries**, those with air on both sides **walls**.
//!
//! A closed curve parts air from fabric: air lies where an odd number of them lies around. Where curves meet in nodes, the drawn closed
//! curves count; where there are none, all faces between the meeting curves are chambers.

use std::collections::BTreeSet;

use crate::faces::{walk_path, walks};
use crate::fault::{ShapeCode, ShapeFault, quoted};
use crate::join::{Network, NetworkEdge};
use crate::sets::DisjointSets;
use geom::{Enclosures, Path, Point, Segment};

/// A closed edge of the air.
#[derive(Clone, Debug)]
pub(super) struct Boundary {
    /// The edge, the air on its left.
    pub path: Path,
    /// The numbers of its curves.
    pub sources: Vec<usize>,
    /// Whether the air is inside.
    pub outer: bool,
}

/// An edge with air on both sides.
#[derive(Clone, Debug)]
pub(super) struct Wall {
    /// The edge.
    pub path: Path,
    /// The numbers of its curves.
    pub sources: Vec<usize>,
    /// Whether its start and its end lie on a boundary.
    pub on_boundary: [bool; 2],
}

/// Boundaries and walls.
#[derive(Clone, Debug, Default)]
pub(super) struct Air {
    pub boundaries: Vec<Boundary>,
    pub walls: Vec<Wall>,
}

/// A closed curve that counts.
enum AirCurve {
    Alone,
    /// The outer edge of a connected part.
    Around(usize),
    /// A drawn closed curve of a connected part.
    Within(usize),
}

/// Counts the closed curves around a point.
struct Depth {
    curves: Vec<AirCurve>,
    enclosures: Enclosures,
}

impl Depth {
    fn at(&self, p: Point) -> usize {
        let around = self.enclosures.around(p);
        let mut depth = 0;
        for number in &around {
            depth += match self.curves[*number] {
                AirCurve::Alone => 1,
                AirCurve::Within(_) => 0,
                AirCurve::Around(part) => {
                    let own =
                        |n: &&usize| matches!(self.curves[**n], AirCurve::Within(other) if other == part);
                    around.iter().filter(own).count().max(1)
                }
            };
        }
        depth
    }
}

/// Boundaries and walls of `network`, whose curves are the closed paths `drawn` and open ones, with `names`. `join` is the distance within
/// which curves are one.
pub(super) fn air(
    network: &Network,
    drawn: &[(usize, &Path)],
    names: &[String],
    join: f64,
    faults: &mut Vec<ShapeFault>,
) -> Air {
    let part = parts(network);
    let depth = depths(network, drawn, &part);
    let mut air = Air::default();
    let mut joined: Vec<(usize, bool)> = Vec::new();
    let mut wall_nodes = Vec::new();
    for (number, edge) in network.edges.iter().enumerate() {
        let own: Vec<String> = edge.sources.iter().filter_map(|source| names.get(*source).cloned()).collect();
        let slack = if edge.nodes.is_some() { 3.0 * join } else { 1e-6 };
        let (place, [left, right]) = beside(&edge.path, slack);
        let (left, right) = (depth.at(left), depth.at(right));
        if left.min(right) > 1 {
            let what = format!("{} lies in an island, which has no air,", quoted(&own));
            faults.push(misplaced(ShapeCode::NestedIsland, &own, place, what));
            continue;
        }
        match (left % 2 == 1, right % 2 == 1, edge.nodes) {
            (true, false, None) | (false, true, None) => {
                let path = if left % 2 == 1 { edge.path.clone() } else { edge.path.reversed() };
                let outer = path.area() > 0.0;
                air.boundaries.push(Boundary { path, sources: edge.sources.clone(), outer });
            }
            (true, false, Some(_)) => joined.push((number, true)),
            (false, true, Some(_)) => joined.push((number, false)),
            (true, true, nodes) => {
                let (path, sources) = (edge.path.clone(), edge.sources.clone());
                air.walls.push(Wall { path, sources, on_boundary: [false; 2] });
                wall_nodes.push(nodes);
            }
            (false, false, _) => {
                let what = format!("{} is not the border of any chamber", quoted(&own));
                faults.push(misplaced(ShapeCode::WallOutside, &own, place, what));
            }
        }
    }
    chain(network, &joined, &mut air);
    let mut on_boundary = vec![false; network.nodes.len()];
    for node in joined.iter().filter_map(|(number, _)| network.edges[*number].nodes).flatten() {
        on_boundary[node] = true;
    }
    for (wall, nodes) in air.walls.iter_mut().zip(wall_nodes) {
        wall.on_boundary = nodes.map_or([false; 2], |nodes| nodes.map(|node| on_boundary[node]));
    }
    air
}

fn misplaced(code: ShapeCode, names: &[String], place: Point, what: String) -> ShapeFault {
    ShapeFault::new(code, names, place, (what, "remove it, or put it on another layer"), [f64::NAN; 2])
}

/// The connected part of each edge that meets a node, by the number of its first edge.
fn parts(network: &Network) -> Vec<usize> {
    let mut first: Vec<usize> = vec![usize::MAX; network.nodes.len()];
    let mut parts = DisjointSets::new(network.edges.len());
    for (number, edge) in network.edges.iter().enumerate() {
        for node in edge.nodes.into_iter().flatten() {
            if first[node] == usize::MAX {
                first[node] = number;
            }
            parts.unite(number, first[node]);
        }
    }
    parts.all()
}

fn depths(network: &Network, drawn: &[(usize, &Path)], part: &[usize]) -> Depth {
    let mut curves = Vec::new();
    let mut paths: Vec<Path> = Vec::new();
    let mut of_source: BTreeSet<(usize, usize)> = BTreeSet::new();
    let mut meeting = Vec::new();
    for (number, edge) in network.edges.iter().enumerate() {
        match edge.nodes {
            None => {
                curves.push(AirCurve::Alone);
                paths.push(edge.path.clone());
            }
            Some(nodes) => {
                meeting.push((number, &edge.path, nodes));
                of_source.extend(edge.sources.iter().map(|source| (*source, part[number])));
            }
        }
    }
    for (source, path) in drawn {
        if let Some((_, part)) = of_source.range((*source, 0)..(*source + 1, 0)).next() {
            curves.push(AirCurve::Within(*part));
            paths.push((*path).clone());
        }
    }
    let edges: Vec<(&Path, [usize; 2])> = meeting.iter().map(|(_, path, nodes)| (*path, *nodes)).collect();
    for walk in walks(&edges) {
        let path = walk_path(&edges, &walk);
        if path.area() < 0.0 {
            curves.push(AirCurve::Around(part[meeting[walk[0].0].0]));
            paths.push(path);
        }
    }
    let enclosures = Enclosures::new(&paths);
    Depth { curves, enclosures }
}

/// A place on the longest segment of a path, and the points `slack` to its left and right.
pub(super) fn beside(path: &Path, slack: f64) -> (Point, [Point; 2]) {
    let longest = path.segments.iter().reduce(|a, b| if b.length() > a.length() { b } else { a });
    let Some(longest): Option<&Segment> = longest else { return (Point::ORIGIN, [Point::ORIGIN; 2]) };
    // No round fraction: a level ray from it meets no corner of a drawing on a grid.
    let (place, across) = (longest.point(0.414_213_6), longest.tangent(0.414_213_6).perp());
    (place, [place + across * slack, place - across * slack])
}

/// Number of the closed paths in `enclosures`, other than itself, around the closed `path`.
pub(super) fn depth(enclosures: &Enclosures, path: &Path) -> usize {
    enclosing(enclosures, path).len()
}

/// The numbers of the closed paths in `enclosures`, other than itself, around the closed `path`.
pub(super) fn enclosing(enclosures: &Enclosures, path: &Path) -> Vec<usize> {
    let (_, sides) = beside(path, 1e-6);
    let [left, right] = sides.map(|side| enclosures.around(side));
    if left.len() <= right.len() { left } else { right }
}

/// Boundaries of several edges, the air on the left.
fn chain(network: &Network, joined: &[(usize, bool)], air: &mut Air) {
    let ends = |(number, forward): (usize, bool)| {
        let NetworkEdge { nodes, .. } = &network.edges[number];
        nodes.map_or([0, 0], |[a, b]| if forward { [a, b] } else { [b, a] })
    };
    let mut leaving: Vec<Vec<usize>> = vec![Vec::new(); network.nodes.len()];
    for (at, travel) in joined.iter().enumerate() {
        leaving[ends(*travel)[0]].push(at);
    }
    let mut used = vec![false; joined.len()];
    for begin in 0..joined.len() {
        let (mut at, mut segments, mut sources) = (begin, Vec::new(), Vec::new());
        while !used[at] {
            used[at] = true;
            let edge = &network.edges[joined[at].0];
            let path = if joined[at].1 { edge.path.clone() } else { edge.path.reversed() };
            segments.extend(path.segments);
            sources.extend(edge.sources.iter().copied());
            let onward = leaving[ends(joined[at])[1]].iter().find(|next| !used[**next]);
            at = onward.copied().unwrap_or(begin);
        }
        if !segments.is_empty() {
            sources.sort_unstable();
            sources.dedup();
            let path = Path::closed(segments);
            air.boundaries.push(Boundary { outer: path.area() > 0.0, path, sources });
        }
    }
}
