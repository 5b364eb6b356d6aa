//! The most loaded places of a sheet.

use crate::shell::assembly::{Sheet, State};
use crate::shell::cases::value::Value;
use crate::shell::mesh::{Border, Mesh, Meshed, distance};
use std::collections::BTreeMap;

/// The hardest loaded places of a sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremes {
    /// The fabric's largest tension at a rim, both across the seam's plane and within it, N a metre of flat rim. A rim that turns on a
    /// point has no largest tension, and then the mesh error is as large as the value.
    pub seal_tension: Value,
    /// Position on the flat sheet, m.
    pub seal_at: [f64; 2],
    /// Largest force across the seam's plane, of stretching, bending and pressure, N a metre of flat rim: the
    /// mean over a piece of rim as long as the seal's band is wide.
    pub seal_pull: Value,
    /// The middle of that piece on the flat sheet, m.
    pub pull_at: [f64; 2],
    /// Largest principal stretch.
    pub stretch: Value,
    /// Position on the flat sheet, m.
    pub stretch_at: [f64; 2],
}

/// A number and its position on the flat sheet.
pub(crate) type LoadedPlace = (f64, [f64; 2]);

/// The largest tension at a rim and the largest stretch of `state`, each taken in the middle of a triangle of the tube.
pub(crate) fn extremes(sheet: &Sheet, Meshed { mesh, tube, .. }: &Meshed, state: &State) -> [LoadedPlace; 2] {
    let [mut tension, mut longest] = [LoadedPlace::default(); 2];
    for (triangle, corners) in mesh.triangles[..*tube].iter().enumerate() {
        let flat = sheet.flat_triangle(triangle);
        let membrane = sheet.stretched(triangle, corners.map(|corner| state.points[corner]));
        let middle = mesh.middle(triangle);
        let stretch = membrane.principal()[1][0];
        if stretch > longest.0 {
            longest = (stretch, middle);
        }
        for (i, edge) in mesh.triangle_edges[triangle].iter().enumerate() {
            if matches!(mesh.edges[*edge].border, Some(Border::Rim(_))) {
                let [x, y] = flat.slopes[i];
                let length = libm::hypot(x, y);
                let pull = membrane.traction([-x / length, -y / length]);
                if pull > tension.0 {
                    tension = (pull, middle);
                }
            }
        }
    }
    [tension, longest]
}

/// The largest mean of `forces` (N) down across the plane of the seam over a piece of rim as long as `band`,
/// and the piece's middle; `forces` are the energy's slopes by each point.
pub(crate) fn pull(mesh: &Mesh, forces: &[[f64; 3]], band: f64) -> LoadedPlace {
    let mut rim: BTreeMap<usize, f64> = BTreeMap::new();
    let rims = (0..mesh.edges.len()).filter(|edge| matches!(mesh.edges[*edge].border, Some(Border::Rim(_))));
    for edge in rims {
        for end in mesh.edges[edge].ends {
            *rim.entry(end).or_default() += mesh.length(edge) / 2.0;
        }
    }
    let mean = |middle: usize| {
        let rim_near =
            rim.iter().filter(|(point, _)| distance(mesh.points[middle], mesh.points[**point]) <= band / 2.0);
        let [force, length] = rim_near.fold([0.0; 2], |[force, length_sum], (point, length)| {
            [force - forces[*point][2], length_sum + length]
        });
        (force / length, mesh.points[middle])
    };
    rim.keys().map(|point| mean(*point)).max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default()
}
