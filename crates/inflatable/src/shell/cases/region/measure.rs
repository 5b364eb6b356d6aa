//! Measurements of each mesh of a chamber.

use crate::shell::assembly::{Sheet, State};
use crate::shell::cases::region::plates;
use crate::shell::cases::region::stability;
use crate::shell::cases::region::supports::SealedNodes;
use crate::shell::element::volume::volume;
use crate::shell::mesh::Meshed;
use crate::shell::solver::Solver;

/// Volume, height, extents, stretch, tension, both eigenvalues, force and contact area of a plate, energy, and the largest pull on a seam.
pub(super) const NUMBERS: usize = 12;

/// One mesh's numbers, of both sheets, and the flat places of the largest.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Measured {
    /// The last two are for the energy and the pull.
    pub(super) numbers: [f64; NUMBERS],
    pub(super) height_at: [f64; 2],
    pub(super) stretch_at: [f64; 2],
    pub(super) tension_at: [f64; 2],
}

pub(super) fn measure(
    solver: &mut Solver,
    meshed: &Meshed,
    (state, pressure): (&State, f64),
    sealed: &SealedNodes,
) -> Measured {
    // Volume, height and extents are those of one sheet and its mirror image. The largest stretch and tension are
    // looked for triangle by triangle, each with its place. The last two are filled in by the caller, who knows the
    // energy and the seams.
    let mesh = &meshed.mesh;
    let volumes = mesh.triangles.iter().map(|corners| volume(corners.map(|corner| state.points[corner])));
    let volume = 2.0 * volumes.sum::<f64>();
    let top = (0..mesh.points.len()).max_by(|a, b| state.points[*a][2].total_cmp(&state.points[*b][2]));
    let top = top.unwrap_or_default();
    let mut measured = Measured { height_at: mesh.points[top], ..Measured::default() };
    let (mut stretch, mut tension) = (0.0, 0.0);
    for (triangle, corners) in mesh.triangles.iter().enumerate() {
        let stretched = solver.assembly.sheet.stretched(triangle, corners.map(|corner| state.points[corner]));
        let [[first_principal, _], [longest, _]] = stretched.principal();
        let middle = mesh.middle(triangle);
        if longest > stretch {
            (stretch, measured.stretch_at) = (longest, middle);
        }
        if first_principal > tension {
            (tension, measured.tension_at) = (first_principal, middle);
        }
    }
    let height = 2.0 * state.points[top][2];
    let (x, y) = (extent(state, 0), extent(state, 1));
    let [force, contact_area] = plates::force_and_area(solver, mesh, state, pressure);
    let [symmetric, antisymmetric] = stability::lowest(solver, (state, pressure), sealed);
    measured.numbers =
        [volume, height, x, y, stretch, tension, symmetric, antisymmetric, force, contact_area, 0.0, 0.0];
    measured
}

/// The extent of `state` along x or y, `axis` 0 or 1.
fn extent(state: &State, axis: usize) -> f64 {
    let coordinates = state.points.iter().map(|x| x[axis]);
    coordinates.clone().fold(f64::NEG_INFINITY, f64::max) - coordinates.fold(f64::INFINITY, f64::min)
}

/// The mean of x and y of `points`, weighted by the areas around them.
fn mean(points: &[[f64; 3]], areas: &[f64]) -> [f64; 2] {
    let total_area: f64 = areas.iter().sum();
    [0, 1].map(|c| points.iter().zip(areas).map(|(x, area)| area * x[c]).sum::<f64>() / total_area)
}

/// The shape where it lies best on the flat sheet, by the mean of squares over the area.
pub(super) fn aligned(sheet: &Sheet, state: &State) -> State {
    let flat = sheet.flat();
    let (from, to) = (mean(&state.points, &sheet.areas), mean(&flat.points, &sheet.areas));
    let (mut sine, mut cosine) = (0.0, 0.0);
    for ((x, at), area) in state.points.iter().zip(&flat.points).zip(&sheet.areas) {
        let ([x, y], [u, v]) = ([0, 1].map(|c| x[c] - from[c]), [0, 1].map(|c| at[c] - to[c]));
        cosine += area * (x * u + y * v);
        sine += area * (x * v - y * u);
    }
    let (sine, cosine) = libm::sincos(libm::atan2(sine, cosine));
    let place = |x: &[f64; 3]| {
        let [u, v] = [0, 1].map(|c| x[c] - from[c]);
        [cosine * u - sine * v + to[0], sine * u + cosine * v + to[1], x[2]]
    };
    State { points: state.points.iter().map(place).collect(), leans: state.leans.clone() }
}
