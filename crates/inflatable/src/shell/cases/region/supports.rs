//! Supports of a chamber: with z = 0 as its plane of symmetry, and where it leaves that plane.

use crate::shell::assembly::{Sheet, Supports};
use crate::shell::cases::region::pressures::{PartialPressure, parts_of_pressure};
use crate::shell::mesh::{Border, FlatChamber, Meshed};
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
    let mut supports = level(sealed, sheet);
    if let Some(HeldPoints { start, other, axis_across, .. }) = HeldPoints::new(meshed) {
        for (point, axis) in [(start, 0), (start, 1), (other, axis_across)] {
            supports.fix(point, axis);
        }
    }
    supports
}

/// Prevents rigid motions in space of a chamber whose sheets have `count` points together, and nothing else.
pub(super) fn in_space(meshed: &Meshed, count: usize) -> Supports {
    let mut supports = Supports::free(count);
    if let Some(HeldPoints { start, other, third, axis_across }) = HeldPoints::new(meshed) {
        for (point, axis) in
            [(start, 0), (start, 1), (start, 2), (other, axis_across), (other, 2), (third, 2)]
        {
            supports.fix(point, axis);
        }
    }
    supports
}

/// Points of the rims that hold a chamber: two far from each other, and one far from the line through both.
struct HeldPoints {
    start: usize,
    other: usize,
    third: usize,
    /// The axis that lies most across the line. The second point may come nearer along the other one.
    axis_across: usize,
}

impl HeldPoints {
    fn new(meshed: &Meshed) -> Option<Self> {
        let mesh = &meshed.mesh;
        let on_rim = |edge: &&crate::shell::mesh::Edge| matches!(edge.border, Some(Border::Rim(_)));
        let rim: Vec<usize> = mesh.edges.iter().filter(on_rim).flat_map(|edge| edge.ends).collect();
        let place = |point: usize| Point::new(mesh.points[point][0], mesh.points[point][1]);
        let &first = rim.first()?;
        let farthest = |distance: &dyn Fn(usize) -> f64| {
            rim.iter().copied().max_by(|a, b| distance(*a).total_cmp(&distance(*b))).unwrap_or(first)
        };
        let start = farthest(&|point| place(point).distance(place(first)));
        let other = farthest(&|point| place(point).distance(place(start)));
        let chord = place(other) - place(start);
        let third = farthest(&|point| chord.cross(place(point) - place(start)).abs());
        Some(Self { start, other, third, axis_across: usize::from(chord.x.abs() > chord.y.abs()) })
    }
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
