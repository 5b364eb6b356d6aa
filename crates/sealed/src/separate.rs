//! **Separate pieces** of a sketch: what is cut out by itself is a sketch of its own.
//!
//! With drawn cuts a piece is everything within an outermost cut. Without, it is all that lies within two bands of each other, or inside one
//! another: fabric that narrow is a wall, or a fault.

use std::collections::BTreeMap;

use crate::graph::{DisjointSets, GraphEdge, walk_path, walks};
use crate::mended::{MendedCurves, Mending, mended_curves};
use crate::network::{Network, NetworkEdge};
use crate::regions::depth;
use crate::segments::Segments;
use crate::sketch::{DrawnCurve, Rules, Sketch};
use geom::{Enclosures, Line, Path, Point, segment_distance};

/// The pieces of `sketch`, in the order in which they are drawn; the sketch itself where it is one piece, or a cut has no air inside.
pub fn separate(sketch: &Sketch, rules: &Rules) -> Vec<Sketch> {
    let pieces = if sketch.cuts.is_empty() { by_air(sketch, rules) } else { by_cuts(sketch, rules) };
    let have_bands = pieces.iter().all(|piece| !piece.air.is_empty() || !piece.seams.is_empty());
    if pieces.len() > 1 && have_bands { pieces } else { vec![sketch.clone()] }
}

/// A piece by the curves that bound it.
struct PieceOutline {
    /// Around it.
    rings: Enclosures,
    curves: Segments,
}

impl PieceOutline {
    fn new(rings: &[Path], curves: &[&Path]) -> Self {
        Self { rings: Enclosures::new(rings), curves: Segments::new(curves.iter().copied()) }
    }

    /// Distance of `p` from the piece, mm; 0 inside.
    fn distance(&self, p: Point) -> f64 {
        if !self.rings.enclosing(p).is_empty() {
            return 0.0;
        }
        self.curves.index.least_distance(p, |number| self.curves.list[number].segment.distance(p))
    }
}

/// The list of curves of one role in a sketch.
type CurveList = fn(&mut Sketch) -> &mut Vec<DrawnCurve>;

/// The parts of `sketch`, each figure at the nearest of the `outlines`; none without an outline.
fn shared_out(sketch: &Sketch, outlines: &[PieceOutline]) -> Vec<Sketch> {
    if outlines.is_empty() {
        return Vec::new();
    }
    let mut pieces = vec![Sketch::default(); outlines.len()];
    let roles: [(&[DrawnCurve], CurveList); 5] = [
        (&sketch.air, |piece| &mut piece.air),
        (&sketch.seams, |piece| &mut piece.seams),
        (&sketch.cuts, |piece| &mut piece.cuts),
        (&sketch.holes, |piece| &mut piece.holes),
        (&sketch.valves, |piece| &mut piece.valves),
    ];
    for (curves, list) in roles {
        for curve in curves {
            list(&mut pieces[nearest_outline(outlines, middle(&curve.path))]).push(curve.clone());
        }
    }
    for port in &sketch.ports {
        pieces[nearest_outline(outlines, port.place.middle())].ports.push(port.clone());
    }
    pieces
}

/// The number of the outline that is nearest to `p`.
fn nearest_outline(outlines: &[PieceOutline], p: Point) -> usize {
    let distances = outlines.iter().map(|outline| outline.distance(p)).enumerate();
    distances.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(number, _)| number)
}

/// A point of a path.
fn middle(path: &Path) -> Point {
    path.segments.get(path.segments.len() / 2).map_or(Point::ORIGIN, |segment| segment.point(0.5))
}

/// The parts within the outermost drawn cuts.
fn by_cuts(sketch: &Sketch, rules: &Rules) -> Vec<Sketch> {
    let (MendedCurves { network, .. }, _) = mended_curves(&sketch.cuts, Mending::Edges, rules.join);
    let closed = network.edges.iter().filter(|edge| edge.nodes.is_none()).map(|edge| &edge.path);
    let closed: Vec<&Path> = closed.collect();
    let enclosures = Enclosures::new(closed.iter().copied());
    let outermost = closed.into_iter().filter(|path| depth(&enclosures, path) == 0);
    let outlines = outermost.map(|path| PieceOutline::new(std::slice::from_ref(path), &[path]));
    shared_out(sketch, &outlines.collect::<Vec<_>>())
}

/// The parts that lie more than two bands from each other, and not within each other.
///
/// Curves near each other are one cluster. A cluster inside the rings of another belongs to it. A cluster without a ring is no piece: its
/// curves go to the nearest.
fn by_air(sketch: &Sketch, rules: &Rules) -> Vec<Sketch> {
    let drawn_curves: Vec<&DrawnCurve> = sketch.air.iter().chain(&sketch.seams).collect();
    let mut clusters = near_curves(&drawn_curves, 2.0 * rules.band);
    if clusters.least_members().iter().all(|least| *least == 0) {
        return Vec::new();
    }
    let curves: Vec<DrawnCurve> = drawn_curves.iter().map(|curve| (*curve).clone()).collect();
    let (MendedCurves { network, .. }, _) = mended_curves(&curves, Mending::Edges, rules.join);
    let mut rings = outer_rings(&network);
    rings.extend(open_outlines(&network, sketch.air.len()));
    let enclosures = Enclosures::new(rings.iter().map(|ring| &ring.path));
    for (number, curve) in drawn_curves.iter().enumerate() {
        for ring in enclosures.enclosing(middle(&curve.path)) {
            clusters.unite(number, rings[ring].source);
        }
    }
    let cluster_of = clusters.least_members();
    let mut of_cluster: BTreeMap<usize, (Vec<Path>, Vec<&Path>)> = BTreeMap::new();
    for OuterRing { path, source } in rings {
        of_cluster.entry(cluster_of[source]).or_default().0.push(path);
    }
    for (curve, cluster) in drawn_curves.iter().zip(&cluster_of) {
        if let Some((_, curves)) = of_cluster.get_mut(cluster) {
            curves.push(&curve.path);
        }
    }
    let outlines = of_cluster.values().map(|(rings, curves)| PieceOutline::new(rings, curves));
    shared_out(sketch, &outlines.collect::<Vec<_>>())
}

/// The curves in clusters, by their numbers: those nearer to each other than `reach` mm.
fn near_curves(curves: &[&DrawnCurve], reach: f64) -> DisjointSets {
    let segments = Segments::new(curves.iter().map(|curve| &curve.path));
    let mut clusters = DisjointSets::new(curves.len());
    for part in &segments.list {
        segments.index.visit(&part.bounds.outset(reach), |other| {
            let other = &segments.list[other];
            let is_apart = !clusters.are_united(part.path, other.path);
            if is_apart && segment_distance(&part.segment, &other.segment) < reach {
                clusters.unite(part.path, other.path);
            }
        });
    }
    clusters
}

/// A closed path with the number of one of its curves.
struct OuterRing {
    path: Path,
    source: usize,
}

/// The closed curves of a network and the outer edges of its connected parts.
fn outer_rings(network: &Network) -> Vec<OuterRing> {
    let mut rings = Vec::new();
    let mut edges: Vec<GraphEdge<'_>> = Vec::new();
    let mut sources = Vec::new();
    for edge in &network.edges {
        match edge.nodes {
            None => rings.push(OuterRing { path: edge.path.clone(), source: edge.sources[0] }),
            Some(nodes) => {
                edges.push(GraphEdge { path: &edge.path, nodes });
                sources.push(edge.sources[0]);
            }
        }
    }
    for walk in walks(&edges) {
        let path = walk_path(&edges, &walk);
        // Clockwise around a connected part; free ends alone enclose nothing.
        if path.area() < -1e-6 {
            rings.push(OuterRing { path, source: sources[walk[0].edge] });
        }
    }
    rings
}

/// The open edges of the air that meet no other, closed by a straight line: a port may lie in their gap. The first `air` curves are air.
fn open_outlines(network: &Network, air: usize) -> Vec<OuterRing> {
    let free: Vec<usize> = network.free_ends().into_iter().map(|end| end.node).collect();
    let outline = |edge: &NetworkEdge| {
        let source = *edge.sources.first().filter(|source| **source < air)?;
        let _ = edge.nodes.as_ref().filter(|nodes| nodes.iter().all(|node| free.contains(node)))?;
        let chord = Line::new(edge.path.end()?, edge.path.start()?).into();
        let segments = edge.path.segments.iter().copied().chain([chord]).collect();
        Some(OuterRing { path: Path::closed(segments), source })
    };
    network.edges.iter().filter_map(outline).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Open lines far from each other, as seams and as cuts: no piece has an outline.
    #[test]
    fn lines_without_an_outline_are_one_piece() {
        let line = |x: f64| DrawnCurve {
            name: "line".to_owned(),
            path: Path::polyline(&[Point::new(x, 0.0), Point::new(x, 50.0)]),
        };
        let lines = || vec![line(0.0), line(100.0), line(200.0)];
        for sketch in [
            Sketch { seams: lines(), ..Sketch::default() },
            Sketch { cuts: lines(), seams: lines(), ..Sketch::default() },
            Sketch { cuts: lines(), ..Sketch::default() },
        ] {
            assert_eq!(separate(&sketch, &Rules::SAMPLE).len(), 1);
        }
    }
}
