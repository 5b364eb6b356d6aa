//! Chambers of a region at pressures of their own: what walls divide bears a part of the pressure each.

use crate::shell::cases::region::probes::triangle_at;
use crate::shell::mesh::Mesh;

/// A chamber of a region by a place in it, with its part of the region's pressure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartialPressure {
    /// A place in it on the flat sheet, m.
    pub at: [f64; 2],
    /// The pressure in it by that of the region, 0 to 1.
    pub part: f64,
}

impl PartialPressure {
    /// The chamber with its place in units of `unit`.
    pub(super) fn in_units(self, unit: f64) -> Self {
        Self { at: self.at.map(|x| x / unit), ..self }
    }
}

/// The part of the pressure on each triangle of `mesh`, whose `sealed_edges` part the chambers.
pub(super) fn parts_of_pressure(
    partial: &[PartialPressure],
    mesh: &Mesh,
    sealed_edges: &[usize],
) -> Vec<f64> {
    let mut parts = vec![1.0; mesh.triangles.len()];
    for PartialPressure { at, part } in partial {
        let Some(first) = triangle_at(mesh, *at) else { continue };
        for triangle in connected(first, mesh, sealed_edges) {
            parts[triangle] = *part;
        }
    }
    parts
}

/// The triangles that can be reached from triangle `first` without crossing a sealed edge.
fn connected(first: usize, mesh: &Mesh, sealed_edges: &[usize]) -> Vec<usize> {
    let mut is_closed = vec![false; mesh.edges.len()];
    for edge in sealed_edges {
        is_closed[*edge] = true;
    }
    let mut is_reached = vec![false; mesh.triangles.len()];
    is_reached[first] = true;
    let mut triangles = vec![first];
    let mut next = 0;
    while let Some(triangle) = triangles.get(next).copied() {
        next += 1;
        for edge in mesh.triangle_edges[triangle].into_iter().filter(|edge| !is_closed[*edge]) {
            for side in mesh.edges[edge].sides.into_iter().flatten() {
                if !std::mem::replace(&mut is_reached[side], true) {
                    triangles.push(side);
                }
            }
        }
    }
    triangles
}
