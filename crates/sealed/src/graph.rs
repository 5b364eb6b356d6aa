//! Plane graphs: the walks around the faces between edges, and **disjoint sets** of numbers that are united pair by pair.

use geom::order::sort_by;
use geom::{Path, Point};

/// An edge of a plane graph.
#[derive(Clone, Copy)]
pub(crate) struct GraphEdge<'a> {
    pub path: &'a Path,
    /// The nodes at its start and its end.
    pub nodes: [usize; 2],
}

/// A travel along an edge.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct EdgeTravel {
    /// The number of the edge.
    pub edge: usize,
    /// Whether it leads from the first node of the edge to its last.
    pub is_forward: bool,
}

impl EdgeTravel {
    /// The number of the travel among all travels.
    fn number(self) -> usize {
        2 * self.edge + usize::from(self.is_forward)
    }

    /// The travel along the edge the other way.
    fn reversed(self) -> Self {
        Self { is_forward: !self.is_forward, ..self }
    }

    /// The direction in which the travel along one of `edges` leads after the first `length` mm.
    fn angle(self, edges: &[GraphEdge<'_>], length: f64) -> f64 {
        let path = edges[self.edge].path;
        let path_length = path.length();
        let stations = if self.is_forward { [0.0, length] } else { [path_length, path_length - length] };
        let [start, end] = stations.map(|s| path.point_at(s).unwrap_or(Point::ORIGIN));
        (end - start).angle()
    }
}

/// The walks around every face of a graph of `edges`, the face on the left: counterclockwise around a bounded face, clockwise around a
/// connected part. Every edge is travelled once either way.
///
/// The travels that leave a node are sorted by their direction. Clockwise of the way back lies the next edge of the face on the left.
pub(crate) fn walks(edges: &[GraphEdge<'_>]) -> Vec<Vec<EdgeTravel>> {
    let nodes = edges.iter().flat_map(|edge| edge.nodes).max().map_or(0, |last| last + 1);
    let mut leaving: Vec<Vec<EdgeTravel>> = vec![Vec::new(); nodes];
    for (number, GraphEdge { nodes: [start, end], .. }) in edges.iter().enumerate() {
        leaving[*start].push(EdgeTravel { edge: number, is_forward: true });
        leaving[*end].push(EdgeTravel { edge: number, is_forward: false });
    }
    let mut position = vec![0; 2 * edges.len()];
    for travels in &mut leaving {
        sort_by_direction(edges, travels);
        for (place, travel) in travels.iter().enumerate() {
            position[travel.number()] = place;
        }
    }
    let mut is_travelled = vec![false; 2 * edges.len()];
    let mut walks = Vec::new();
    for begin in
        (0..edges.len()).flat_map(|edge| [true, false].map(|is_forward| EdgeTravel { edge, is_forward }))
    {
        let (mut walk, mut travel) = (Vec::new(), begin);
        while !is_travelled[travel.number()] {
            is_travelled[travel.number()] = true;
            walk.push(travel);
            let travels = &leaving[edges[travel.edge].nodes[usize::from(travel.is_forward)]];
            let back = position[travel.reversed().number()];
            travel = travels[(back + travels.len() - 1) % travels.len()];
        }
        if !walk.is_empty() {
            walks.push(walk);
        }
    }
    walks
}

/// The walk as one closed path.
pub(crate) fn walk_path(edges: &[GraphEdge<'_>], walk: &[EdgeTravel]) -> Path {
    let travelled = walk.iter().map(|EdgeTravel { edge, is_forward }| {
        let path = edges[*edge].path;
        if *is_forward { path.clone() } else { path.reversed() }
    });
    Path::closed(travelled.flat_map(|path| path.segments).collect())
}

/// Counterclockwise by where the edges lead a little way off: bands part along a tangent, too.
fn sort_by_direction(edges: &[GraphEdge<'_>], travels: &mut Vec<EdgeTravel>) {
    if travels.len() < 2 {
        return;
    }
    let lengths = travels.iter().map(|travel| edges[travel.edge].path.length());
    let length = lengths.fold(1.0, f64::min) / 3.0;
    let mut by_angle: Vec<(f64, EdgeTravel)> =
        travels.iter().map(|travel| (travel.angle(edges, length), *travel)).collect();
    sort_by(&mut by_angle, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    *travels = by_angle.into_iter().map(|(_, travel)| travel).collect();
}

/// Sets of the numbers from 0 on, each named by its least member.
pub(crate) struct DisjointSets {
    /// A member of the same set that is no larger; the least member of a set is its own parent.
    parent: Vec<usize>,
}

impl DisjointSets {
    /// `count` numbers, each a set by itself.
    pub(crate) fn new(count: usize) -> Self {
        Self { parent: (0..count).collect() }
    }

    /// The least member of the set of `number`.
    pub(crate) fn least_member(&mut self, mut number: usize) -> usize {
        while self.parent[number] != number {
            self.parent[number] = self.parent[self.parent[number]];
            number = self.parent[number];
        }
        number
    }

    /// Makes one set of those of `a` and `b`.
    pub(crate) fn unite(&mut self, a: usize, b: usize) {
        let (a, b) = (self.least_member(a), self.least_member(b));
        self.parent[a.max(b)] = a.min(b);
    }

    /// Whether `a` and `b` are in one set.
    pub(crate) fn are_united(&mut self, a: usize, b: usize) -> bool {
        self.least_member(a) == self.least_member(b)
    }

    /// The least member of the set of each number.
    pub(crate) fn least_members(&mut self) -> Vec<usize> {
        (0..self.parent.len()).map(|number| self.least_member(number)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_is_named_by_its_least_member() {
        let mut sets = DisjointSets::new(6);
        for (a, b) in [(4, 2), (5, 4), (1, 3)] {
            sets.unite(a, b);
        }
        assert_eq!(sets.least_members(), [0, 1, 2, 1, 2, 2]);
        assert!(sets.are_united(5, 2) && !sets.are_united(0, 1));
    }
}
