//! Supports of a chamber: with z = 0 as its plane of symmetry, and where it leaves that plane.

use crate::shell::assembly::{Sheet, Supports};
use crate::shell::cases::region::pressures::{PartialPressure, parts_of_pressure};
use crate::shell::mesh::{Border, FlatChamber, Mesh, Meshed};
use geom::Point;

/// The nodes at which both sheets are joined.
pub(super) struct SealedNodes {
    /// Points at z = 0.
    pub(super) points: Vec<bool>,
    /// Edges of islands, and on welds.
    pub(super) welds: Vec<usize>,
    /// The part of the pressure on each triangle.
    pub(super) parts: Vec<f64>,
}

impl SealedNodes {
    /// The sealed nodes of a mesh of `chamber` with parts of the pressure. Without pressure the sheets lie on each other.
    pub(super) fn new(chamber: &FlatChamber, partial: &[PartialPressure], meshed: &Meshed) -> Self {
        let mesh = &meshed.mesh;
        let mut points = vec![false; mesh.points.len()];
        for (edge, _) in mesh.edges.iter().zip(&meshed.piece_of).filter(|(_, piece)| piece.is_some()) {
            edge.ends.into_iter().for_each(|end| points[end] = true);
        }
        for (triangle, corners) in mesh.triangles.iter().enumerate() {
            let [x, y] = mesh.middle(triangle);
            if chamber.is_welded(Point::new(x, y)) {
                for corner in corners {
                    points[*corner] = true;
                }
            }
        }
        let is_weld = |edge: &usize| meshed.piece_of[*edge].is_some() && mesh.edges[*edge].border.is_none();
        let welds: Vec<usize> = (0..mesh.edges.len()).filter(is_weld).collect();
        let parts = parts_of_pressure(partial, mesh, &welds);
        for (corners, _) in mesh.triangles.iter().zip(&parts).filter(|(_, part)| **part == 0.0) {
            for corner in corners {
                points[*corner] = true;
            }
        }
        Self { points, welds, parts }
    }
}

/// Holds the sealed nodes at z = 0; `sheet` turns freely along welds.
pub(super) fn level(sealed: &SealedNodes, sheet: &mut Sheet) -> Supports {
    sealed.welds.iter().for_each(|edge| sheet.release(*edge));
    let mut supports = Supports::free(sealed.points.len());
    let sealed_points = (0..sealed.points.len()).filter(|point| sealed.points[*point]);
    sealed_points.for_each(|point| supports.fix(point, 2));
    supports
}

/// Holds the sealed nodes at z = 0 and prevents rigid motions in that plane; `sheet` turns freely along welds.
pub(super) fn symmetric(meshed: &Meshed, sealed: &SealedNodes, sheet: &mut Sheet) -> Supports {
    let mesh = &meshed.mesh;
    let mut supports = level(sealed, sheet);
    let on_rim = |edge: &&crate::shell::mesh::Edge| matches!(edge.border, Some(Border::Rim(_)));
    let rim: Vec<usize> = mesh.edges.iter().filter(on_rim).flat_map(|edge| edge.ends).collect();
    let Some(&first) = rim.first() else { return supports };
    let farthest = |from: usize| {
        let distance = |point: &&usize| place(mesh, **point).distance(place(mesh, from));
        rim.iter().max_by(|a, b| distance(a).total_cmp(&distance(b))).copied().unwrap_or(from)
    };
    let start = farthest(first);
    let other = farthest(start);
    let chord = place(mesh, other) - place(mesh, start);
    // The farthest point may come nearer along the axis that lies most along the line between both.
    let axis_across = usize::from(chord.x.abs() > chord.y.abs());
    for (point, axis) in [(start, 0), (start, 1), (other, axis_across)] {
        supports.fix(point, axis);
    }
    supports
}

/// Lets the sealed nodes move along z only: the remaining symmetry of sheets that move to the same side.
pub(super) fn antisymmetric(sealed: &SealedNodes) -> Supports {
    let mut supports = Supports::free(sealed.points.len());
    for (point, _) in sealed.points.iter().enumerate().filter(|(_, is_sealed)| **is_sealed) {
        supports.fix(point, 0);
        supports.fix(point, 1);
    }
    supports
}

fn place(mesh: &Mesh, point: usize) -> Point {
    Point::new(mesh.points[point][0], mesh.points[point][1])
}
