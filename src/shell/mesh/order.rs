//! In which order to eliminate: nested dissection by the nodes' places.
//!
//! A **node** is a point or an edge: point `i` is node `i`, edge `e` node `points + e`. Two nodes are coupled if one
//! triangle's bending knows both: its points, its edges, and the points of its neighbours that lie opposite.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use crate::shell::mesh::Mesh;

/// Fewer nodes than this are not divided further: a separator of some 10 nodes would be a large part of them.
const LEAF: usize = 40;

impl Mesh {
    /// All nodes in an order of elimination: first one half, then the other, then the nodes that divide them, and each half
    /// in the same way. The order is decided by the triangles and places alone.
    pub fn elimination_order(&self) -> Vec<usize> {
        let graph = Graph::new(self);
        let mut order = Vec::with_capacity(graph.places.len());
        let mut in_second = vec![false; graph.places.len()];
        graph.dissect((0..graph.places.len()).collect(), &mut in_second, &mut order);
        order
    }

    /// The nodes that the bending of a triangle couples: its 3 points, the up to 3 points opposite, its 3 edges.
    pub fn coupled(&self, triangle: usize) -> Vec<usize> {
        let edges = self.triangle_edges[triangle];
        let mut nodes = self.triangles[triangle].to_vec();
        nodes.extend(edges.iter().filter_map(|&edge| self.opposite(triangle, edge)));
        nodes.extend(edges.map(|edge| self.points.len() + edge));
        nodes
    }

    /// The point of the neighbour of `triangle` beyond `edge` that does not lie on `edge`; none at the border.
    pub fn opposite(&self, triangle: usize, edge: usize) -> Option<usize> {
        let neighbour = self.edges[edge].sides.into_iter().flatten().find(|&side| side != triangle)?;
        self.triangles[neighbour].into_iter().find(|point| !self.edges[edge].ends.contains(point))
    }
}

struct Graph {
    places: Vec<[f64; 2]>,
    /// Neighbours of node `i`: `neighbours[starts[i]..starts[i + 1]]`.
    starts: Vec<usize>,
    neighbours: Vec<usize>,
}

impl Graph {
    fn new(mesh: &Mesh) -> Self {
        let mut places = mesh.points.clone();
        places.extend(mesh.edges.iter().map(|edge| {
            let [a, b] = edge.ends.map(|end| mesh.points[end]);
            [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]
        }));
        let mut pairs: Vec<(usize, usize)> = Vec::new();
        for triangle in 0..mesh.triangles.len() {
            let nodes = mesh.coupled(triangle);
            pairs.extend(
                nodes.iter().flat_map(|&a| nodes.iter().map(move |&b| (a, b))).filter(|(a, b)| a != b),
            );
        }
        pairs.sort_unstable();
        pairs.dedup();
        let starts = (0..=places.len()).map(|node| pairs.partition_point(|pair| pair.0 < node)).collect();
        Self { places, starts, neighbours: pairs.into_iter().map(|pair| pair.1).collect() }
    }

    fn neighbours(&self, node: usize) -> &[usize] {
        &self.neighbours[self.starts[node]..self.starts[node + 1]]
    }

    /// `in_second` is false for every node, before and after.
    fn dissect(&self, mut nodes: Vec<usize>, in_second: &mut [bool], order: &mut Vec<usize>) {
        self.sort_along(&mut nodes);
        if nodes.len() <= LEAF {
            order.extend(nodes);
            return;
        }
        let half = nodes.len() / 2;
        let (first, second) = nodes.split_at(half);
        for &node in second {
            in_second[node] = true;
        }
        let mut between = self.separator(first, in_second);
        for &node in second {
            in_second[node] = false;
        }
        for half in [first, second] {
            let rest = half.iter().copied().filter(|node| between.binary_search(node).is_err()).collect();
            self.dissect(rest, in_second, order);
        }
        self.sort_along(&mut between);
        order.extend(between);
    }

    /// Sorts nodes along the direction in which they reach furthest.
    fn sort_along(&self, nodes: &mut [usize]) {
        let [x, y] = self.direction(nodes);
        let at = |node: usize| self.places[node][0] * x + self.places[node][1] * y;
        nodes.sort_by(|&a, &b| at(a).total_cmp(&at(b)).then(a.cmp(&b)));
    }

    /// Direction of the largest second moment of the nodes' places.
    fn direction(&self, nodes: &[usize]) -> [f64; 2] {
        let count = nodes.iter().map(|_| 1.0).sum::<f64>().max(1.0);
        let mean = [0, 1].map(|k| nodes.iter().map(|&node| self.places[node][k]).sum::<f64>() / count);
        let moment = |k: usize, l: usize| {
            nodes.iter().map(|&n| (self.places[n][k] - mean[k]) * (self.places[n][l] - mean[l])).sum::<f64>()
        };
        let (sin, cos) = (0.5 * (2.0 * moment(0, 1)).atan2(moment(0, 0) - moment(1, 1))).sin_cos();
        [cos, sin]
    }

    /// The fewest nodes whose removal parts the first half from the second, sorted: by König's theorem from a largest
    /// matching of the couplings across.
    fn separator(&self, first: &[usize], in_second: &[bool]) -> Vec<usize> {
        let across = |node: usize| self.neighbours(node).iter().copied().filter(|&other| in_second[other]);
        let rim: Vec<usize> = first.iter().copied().filter(|&node| across(node).next().is_some()).collect();
        let mut matching = Matching::default();
        for &node in &rim {
            let _ = matching.augment(node, &across);
        }
        matching.cover(&rim, &across)
    }
}

/// A matching of nodes of the first half with nodes of the second.
#[derive(Default)]
struct Matching {
    of_first: BTreeMap<usize, usize>,
    of_second: BTreeMap<usize, usize>,
}

impl Matching {
    /// Finds a partner for `node`, giving others new ones where needed (breadth first).
    fn augment<I: Iterator<Item = usize>>(&mut self, node: usize, across: &impl Fn(usize) -> I) -> bool {
        let mut reached_from = BTreeMap::new();
        let mut open = VecDeque::from([node]);
        while let Some(from) = open.pop_front() {
            for to in across(from) {
                if reached_from.contains_key(&to) {
                    continue;
                }
                let _ = reached_from.insert(to, from);
                let Some(&next) = self.of_second.get(&to) else {
                    self.flip(to, &reached_from);
                    return true;
                };
                open.push_back(next);
            }
        }
        false
    }

    /// Matches along the path that ends at `to`.
    fn flip(&mut self, to: usize, reached_from: &BTreeMap<usize, usize>) {
        let mut next = Some(to);
        while let Some(to) = next {
            let from = reached_from[&to];
            let _ = self.of_second.insert(to, from);
            next = self.of_first.insert(from, to);
        }
    }

    /// The least cover: what no alternating path from an unmatched node reaches in the first half, and what one reaches in
    /// the second.
    fn cover<I: Iterator<Item = usize>>(&self, rim: &[usize], across: &impl Fn(usize) -> I) -> Vec<usize> {
        let mut open: Vec<usize> =
            rim.iter().copied().filter(|node| !self.of_first.contains_key(node)).collect();
        let mut first: BTreeSet<usize> = open.iter().copied().collect();
        let mut second = BTreeSet::new();
        while let Some(from) = open.pop() {
            for to in across(from).filter(|&to| second.insert(to)) {
                open.extend(self.of_second.get(&to).copied().filter(|&next| first.insert(next)));
            }
        }
        let mut cover: Vec<usize> =
            rim.iter().copied().filter(|node| !first.contains(node)).chain(second).collect();
        cover.sort_unstable();
        cover
    }
}
