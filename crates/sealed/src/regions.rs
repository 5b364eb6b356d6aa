//! The second pass, from mended curves to the **regions** of the air: edges with air on one side are **boundaries**, those with air on both
//! sides **walls**.
//!
//! A closed curve parts air from fabric: air lies where an odd number of them lies around. Where curves meet in nodes, the drawn closed
//! curves count; where there are none, all faces between the meeting curves are chambers.

use std::collections::BTreeSet;

use crate::fault::{Noted, Quoted, SealingNotes, ShapeCode, ShapeFault, named};
use crate::graph::{DisjointSets, EdgeTravel, GraphEdge, walk_path, walks};
use crate::network::Network;
use geom::{Enclosures, Path, Point, Segment};

/// A closed edge of the air.
#[derive(Clone, Debug)]
pub(crate) struct Boundary {
    /// The edge, the air on its left.
    pub path: Path,
    /// The numbers of its curves.
    pub sources: Vec<usize>,
    /// Whether the air is inside.
    pub outer: bool,
}

/// An edge with air on both sides.
#[derive(Clone, Debug)]
pub(crate) struct Wall {
    /// The edge.
    pub path: Path,
    /// The numbers of its curves.
    pub sources: Vec<usize>,
    /// Whether its start and its end lie on a boundary.
    pub on_boundary: [bool; 2],
}

/// Boundaries and walls.
#[derive(Clone, Debug, Default)]
pub(crate) struct Regions {
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
    /// Number of the curves around `p`. Around a connected part lie as many as its drawn closed curves there, at least one.
    fn count(&self, p: Point) -> usize {
        let numbers = self.enclosures.enclosing(p);
        let mut depth = 0;
        for number in &numbers {
            depth += match self.curves[*number] {
                AirCurve::Alone => 1,
                AirCurve::Within(_) => 0,
                AirCurve::Around(part) => {
                    let is_within =
                        |n: &&usize| matches!(self.curves[**n], AirCurve::Within(other) if other == part);
                    numbers.iter().filter(is_within).count().max(1)
                }
            };
        }
        depth
    }
}

/// Boundaries and walls of `network`, whose curves are the closed paths `rings`, each with its number, and open ones, with `names`. `join`
/// is the distance within which curves are one.
///
/// Each edge is looked at on both sides: the parity of the closed curves around a point tells whether air is there. Boundaries between nodes
/// are then chained to closed ones.
pub(crate) fn regions(
    network: &Network,
    rings: &[(usize, Path)],
    names: &[String],
    join: f64,
) -> Noted<Regions> {
    let depth = depths(network, rings, &parts(network));
    let mut notes = SealingNotes::default();
    let mut regions = Regions::default();
    let mut travels: Vec<EdgeTravel> = Vec::new();
    let mut wall_nodes = Vec::new();
    for (number, edge) in network.edges.iter().enumerate() {
        let slack = if edge.nodes.is_some() { 3.0 * join } else { 1e-6 };
        let (place, sides) = side_points(&edge.path, slack);
        let [left, right] = sides.map(|side| depth.count(side));
        if left.min(right) > 1 {
            let names = named(&edge.sources, names);
            let finding = format!("{} lies in an island, which has no air,", Quoted(&names));
            notes.faults.push(misplaced(ShapeCode::NestedIsland, names, place, finding));
            continue;
        }
        match (left % 2 == 1, right % 2 == 1, edge.nodes) {
            (true, false, None) | (false, true, None) => {
                let path = if left % 2 == 1 { edge.path.clone() } else { edge.path.reversed() };
                let outer = path.area() > 0.0;
                regions.boundaries.push(Boundary { path, sources: edge.sources.clone(), outer });
            }
            (true, false, Some(_)) => travels.push(EdgeTravel { edge: number, is_forward: true }),
            (false, true, Some(_)) => travels.push(EdgeTravel { edge: number, is_forward: false }),
            (true, true, nodes) => {
                let (path, sources) = (edge.path.clone(), edge.sources.clone());
                regions.walls.push(Wall { path, sources, on_boundary: [false; 2] });
                wall_nodes.push(nodes);
            }
            (false, false, _) => {
                let names = named(&edge.sources, names);
                let finding = format!("{} is not the border of any chamber", Quoted(&names));
                notes.faults.push(misplaced(ShapeCode::WallOutside, names, place, finding));
            }
        }
    }
    regions.boundaries.extend(chained(network, &travels));
    let mut on_boundary = vec![false; network.nodes.len()];
    for node in travels.iter().filter_map(|travel| network.edges[travel.edge].nodes).flatten() {
        on_boundary[node] = true;
    }
    for (wall, nodes) in regions.walls.iter_mut().zip(wall_nodes) {
        wall.on_boundary = nodes.map_or([false; 2], |nodes| nodes.map(|node| on_boundary[node]));
    }
    (regions, notes)
}

/// The fault of an edge that parts no air from fabric, and no two chambers.
fn misplaced(code: ShapeCode, names: Vec<String>, place: Point, finding: String) -> ShapeFault {
    ShapeFault { names, ..ShapeFault::new(code, place, finding, "remove it, or put it on another layer") }
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
    parts.least_members()
}

/// The closed curves of `network` that count, with the drawn ones among `rings`; `part` is the connected part of each edge.
///
/// A closed edge counts by itself. Of edges that meet in nodes, the walks clockwise around the connected parts count, and the rings that
/// they are made of.
fn depths(network: &Network, rings: &[(usize, Path)], part: &[usize]) -> Depth {
    let mut curves = Vec::new();
    let mut paths: Vec<Path> = Vec::new();
    let mut of_source: BTreeSet<(usize, usize)> = BTreeSet::new();
    let (mut edges, mut numbers) = (Vec::new(), Vec::new());
    for (number, edge) in network.edges.iter().enumerate() {
        match edge.nodes {
            None => {
                curves.push(AirCurve::Alone);
                paths.push(edge.path.clone());
            }
            Some(nodes) => {
                edges.push(GraphEdge { path: &edge.path, nodes });
                numbers.push(number);
                of_source.extend(edge.sources.iter().map(|source| (*source, part[number])));
            }
        }
    }
    for (source, path) in rings {
        if let Some((_, part)) = of_source.range((*source, 0)..(*source + 1, 0)).next() {
            curves.push(AirCurve::Within(*part));
            paths.push(path.clone());
        }
    }
    for walk in walks(&edges) {
        let path = walk_path(&edges, &walk);
        if path.area() < 0.0 {
            curves.push(AirCurve::Around(part[numbers[walk[0].edge]]));
            paths.push(path);
        }
    }
    let enclosures = Enclosures::new(&paths);
    Depth { curves, enclosures }
}

/// The part of a segment at which points are taken. It is not round: a level ray from there meets no corner of a drawing on a grid.
pub(crate) const ALONG: f64 = 0.414_213_6;

/// A place on the longest segment of a path, and the points `slack` to its left and right.
pub(crate) fn side_points(path: &Path, slack: f64) -> (Point, [Point; 2]) {
    let longest = path.segments.iter().reduce(|a, b| if b.length() > a.length() { b } else { a });
    let Some(longest): Option<&Segment> = longest else { return (Point::ORIGIN, [Point::ORIGIN; 2]) };
    let (place, normal) = (longest.point(ALONG), longest.tangent(ALONG).perp());
    (place, [place + normal * slack, place - normal * slack])
}

/// Number of the closed paths in `enclosures`, other than itself, around the closed `path`.
pub(crate) fn depth(enclosures: &Enclosures, path: &Path) -> usize {
    enclosing(enclosures, path).len()
}

/// The numbers of the closed paths in `enclosures`, other than itself, around the closed `path`.
pub(crate) fn enclosing(enclosures: &Enclosures, path: &Path) -> Vec<usize> {
    let (_, sides) = side_points(path, 1e-6);
    let [left, right] = sides.map(|side| enclosures.enclosing(side));
    if left.len() <= right.len() { left } else { right }
}

/// Boundaries along several edges of `network`, with the air on the left of `travels`.
fn chained(network: &Network, travels: &[EdgeTravel]) -> Vec<Boundary> {
    let mut leaving: Vec<Vec<usize>> = vec![Vec::new(); network.nodes.len()];
    for (number, travel) in travels.iter().enumerate() {
        leaving[travel_ends(network, *travel)[0]].push(number);
    }
    let mut boundaries = Vec::new();
    let mut is_travelled = vec![false; travels.len()];
    for begin in 0..travels.len() {
        let (mut number, mut segments, mut sources) = (begin, Vec::new(), Vec::new());
        while !is_travelled[number] {
            is_travelled[number] = true;
            let travel = travels[number];
            let edge = &network.edges[travel.edge];
            let path = if travel.is_forward { edge.path.clone() } else { edge.path.reversed() };
            segments.extend(path.segments);
            sources.extend(edge.sources.iter().copied());
            let onward = leaving[travel_ends(network, travel)[1]].iter().find(|next| !is_travelled[**next]);
            number = onward.copied().unwrap_or(begin);
        }
        if !segments.is_empty() {
            sources.sort_unstable();
            sources.dedup();
            let path = Path::closed(segments);
            boundaries.push(Boundary { outer: path.area() > 0.0, path, sources });
        }
    }
    boundaries
}

/// The nodes where a travel begins and ends.
fn travel_ends(network: &Network, travel: EdgeTravel) -> [usize; 2] {
    let nodes = network.edges[travel.edge].nodes;
    nodes.map_or([0, 0], |[a, b]| if travel.is_forward { [a, b] } else { [b, a] })
}
