//! STL: a drawing's closed paths extruded, the outermost as the edge, the others as holes through it.
//!
//! Binary, in millimetres, the lower face at Z 0. All faces come from one triangulation in which every edge of the drawing is an
//! edge (by `spade`, with exact predicates): a triangle is void or solid by the edges between it and the outside, and a wall
//! is made wherever two neighbours differ. So the solid is closed.

use std::collections::BTreeSet;

use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use crate::emit::chords::chords;
use design::Drawing;
use geom::{Path, Point};
use program::number::{Decimals, single};
use program::text::inert;

/// Largest distance of a chord from its arc, mm: a fifth of the resolution of a fine printer.
const CHORD: f64 = 0.02;

/// Decimals of a coordinate; single precision resolves them up to several metres.
const DECIMALS: u32 = 3;

/// Length of the head, which names the solid.
const HEAD: usize = 80;
/// Length of a facet: a normal and three corners, and two bytes without meaning.
const FACET: usize = 50;

type StlTriangles = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// The undirected edges at which the plate ends.
type PlateEdges = BTreeSet<[usize; 2]>;

/// The plate of `drawing`, `thickness` high; `name` is in its head.
pub fn stl(name: &str, drawing: &Drawing, thickness: f64) -> Vec<u8> {
    let mut triangles = StlTriangles::new();
    let mut plate_edges = PlateEdges::new();
    for (_, shapes) in &drawing.layers {
        for path in shapes.iter().flat_map(|shape| shape.paths().into_owned()) {
            insert(&path, &mut triangles, &mut plate_edges);
        }
    }
    let solid = solid_faces(&triangles, &plate_edges);
    let mut bytes = inert(name, HEAD).into_bytes();
    bytes.resize(HEAD, b' ');
    // Room for the number of facets.
    bytes.extend([0; 4]);
    for face in triangles.inner_faces() {
        if !solid[face.fix().index()] {
            continue;
        }
        let [a, b, c] = face.positions().map(|p| [p.x, p.y]);
        facet(&mut bytes, [(a, thickness), (b, thickness), (c, thickness)], [0.0, 0.0, 1.0]);
        facet(&mut bytes, [(a, 0.0), (c, 0.0), (b, 0.0)], [0.0, 0.0, -1.0]);
    }
    for edge in triangles.directed_edges().filter(|edge| edge.is_constraint_edge()) {
        let [left, right] = [edge.face(), edge.rev().face()].map(|face| solid[face.fix().index()]);
        if left && !right {
            wall(&mut bytes, edge.positions().map(|p| [p.x, p.y]), thickness);
        }
    }
    let count = u32::try_from((bytes.len() - HEAD - 4) / FACET).unwrap_or(u32::MAX);
    bytes[HEAD..HEAD + 4].copy_from_slice(&count.to_le_bytes());
    bytes
}

/// Puts the corners of a closed path and the edges between them into the triangulation.
fn insert(path: &Path, triangles: &mut StlTriangles, plate_edges: &mut PlateEdges) {
    let path_corners = corners(path);
    let vertices: Vec<FixedVertexHandle> =
        path_corners.iter().filter_map(|[x, y]| triangles.insert(Point2::new(*x, *y)).ok()).collect();
    for (a, b) in vertices.iter().zip(vertices.iter().cycle().skip(1)) {
        // Paths of a design never meet. If two did, an edge would be missing and the verifier would report it.
        if a != b && triangles.can_add_constraint(*a, *b) {
            let _ = triangles.add_constraint(*a, *b);
            let ends = [a.index().min(b.index()), a.index().max(b.index())];
            // An edge that is passed twice is none.
            if !plate_edges.insert(ends) {
                let _ = plate_edges.remove(&ends);
            }
        }
    }
}

/// Whether each face, by its index, is plate. The outer one is not, and faces beside each other differ where the plate ends.
fn solid_faces(triangles: &StlTriangles, plate_edges: &PlateEdges) -> Vec<bool> {
    let mut states: Vec<Option<bool>> = vec![None; triangles.num_all_faces()];
    let outer = triangles.outer_face().fix().index();
    states[outer] = Some(false);
    let hull = triangles.convex_hull().flat_map(|edge| [edge, edge.rev()]);
    let mut open: Vec<_> = hull.filter(|edge| edge.face().fix().index() == outer).collect();
    while let Some(edge) = open.pop() {
        let (face, neighbour) = (edge.face().fix().index(), edge.rev().face());
        let (Some(is_plate), None) = (states[face], states[neighbour.fix().index()]) else { continue };
        let [a, b] = edge.vertices().map(|vertex| vertex.fix().index());
        let ends = plate_edges.contains(&[a.min(b), a.max(b)]);
        states[neighbour.fix().index()] = Some(is_plate != ends);
        if let Some(face) = neighbour.as_inner() {
            open.extend(face.adjacent_edges());
        }
    }
    states.into_iter().map(|state| state == Some(true)).collect()
}

/// The corners of a closed path as a polygon, rounded; no two neighbours are the same.
fn corners(path: &Path) -> Vec<[f64; 2]> {
    let rounded = |p: Point| [p.x, p.y].map(|x| Decimals::exactly(DECIMALS).round(x));
    let mut points: Vec<[f64; 2]> = chords(path, CHORD).into_iter().map(rounded).collect();
    points.dedup();
    if points.len() > 1 && points.first() == points.last() {
        let _ = points.pop();
    }
    points
}

/// Two triangles below the edge from the first to the second of `ends`, whose left side is solid, from Z 0 to `top`.
fn wall(bytes: &mut Vec<u8>, ends: [[f64; 2]; 2], top: f64) {
    let [a, b] = ends;
    let ([x1, y1], [x2, y2]) = (a, b);
    let length = libm::hypot(x2 - x1, y2 - y1);
    let normal = [(y2 - y1) / length, (x1 - x2) / length, 0.0];
    facet(bytes, [(a, top), (a, 0.0), (b, 0.0)], normal);
    facet(bytes, [(a, top), (b, 0.0), (b, top)], normal);
}

fn facet(bytes: &mut Vec<u8>, corners: [([f64; 2], f64); 3], normal: [f64; 3]) {
    let numbers = normal.into_iter().chain(corners.into_iter().flat_map(|([x, y], z)| [x, y, z]));
    bytes.extend(numbers.flat_map(|x| single(x).to_le_bytes()));
    bytes.extend([0, 0]);
}
