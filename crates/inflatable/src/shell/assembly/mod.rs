//! The sheet's energy as a sum over its triangles, with gradient and Hessian by its unknowns.
//!
//! U = U_membrane + U_bending - p V. A `Sheet` never changes in a solve, `Supports` constrain its points, a `State` is a shape
//! of it. An `Assembly` owns every large buffer: none is allocated in an iteration. Sums run in the order of triangles; those of the Hessian
//! run over both halves of the triangles at the same time, and are then added, so that results are the same on any number of threads.

mod kinks;
mod local;
mod numbering;
mod prolong;
mod sheet;
mod supports;
#[cfg(test)]
mod tests;
mod unknowns;

pub use sheet::{Compression, Sheet, State};
pub use supports::{Plane, Supports};

use crate::numerics::Threads;
pub use crate::shell::assembly::local::Tangent;
use crate::shell::assembly::local::{Loads, Local};
use crate::shell::assembly::numbering::{LOCAL, NONE, Numbering, Pattern};
use crate::shell::assembly::sheet::{Beyond, Piece};
use crate::shell::element::fold::{Facet, fold, mirror_fold};
use crate::shell::element::vector::{dot, minus};
use crate::shell::element::{LAST, NEXT, volume};
use std::ops::Range;

/// The parts of a shape's energy.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// Energy of stretching.
    pub membrane: f64,
    /// Energy of bending.
    pub bending: f64,
    /// Below the sheet, down to z = 0, each part by its part of the pressure: the pressure's work is p V.
    pub volume: f64,
    /// Energy of contact, in the augmented Lagrangian.
    pub contact: f64,
}

impl Energy {
    /// U_membrane + U_bending - p V + the contribution of contact.
    pub fn total(&self, pressure: f64) -> f64 {
        self.membrane + self.bending - pressure * self.volume + self.contact
    }
}

/// Sums over the triangles of a sheet.
#[derive(Clone, Debug)]
pub struct Assembly {
    /// The sheet.
    pub sheet: Sheet,
    /// Supports of the sheet.
    pub supports: Supports,
    numbering: Numbering,
    pattern: Pattern,
    /// Whether a triangle touches a point whose axes differ from those of space.
    turned: Vec<bool>,
    facets: Vec<Facet>,
    /// B's moments K alpha of each triangle's edges.
    moments: Vec<[f64; 3]>,
    /// Moments on each edge's fold.
    turning: Vec<f64>,
    forces: Vec<[f64; 3]>,
    leaning: Vec<f64>,
    gradient: Vec<f64>,
    /// The lower triangle's values, and a last one that collects the unused entries.
    values: Vec<f64>,
    /// The sums of the second half of the triangles.
    second_values: Vec<f64>,
}

impl Assembly {
    /// Prepares the sums.
    pub fn new(sheet: Sheet, supports: Supports) -> Self {
        let numbering = Numbering::new(&sheet, &supports);
        let pattern = Pattern::new(&sheet, &numbering);
        let is_turned = |piece: &Piece| {
            let neighbours = piece.beyond.iter().filter_map(|beyond| match beyond {
                Beyond::Neighbour { corner, .. } => Some(corner),
                _ => None,
            });
            piece.corners.iter().chain(neighbours).any(|&corner| supports.holds[corner].plane.is_some())
        };
        let (pieces, points) = (sheet.pieces.len(), sheet.points.len());
        Self {
            turned: sheet.pieces.iter().map(is_turned).collect(),
            facets: vec![Facet::default(); pieces],
            moments: vec![[0.0; 3]; pieces],
            turning: vec![0.0; sheet.edge_count],
            forces: vec![[0.0; 3]; points],
            leaning: vec![0.0; sheet.edge_count],
            gradient: vec![0.0; numbering.count],
            values: vec![0.0; pattern.rows.len() + 1],
            second_values: vec![0.0; pattern.rows.len() + 1],
            sheet,
            supports,
            numbering,
            pattern,
        }
    }

    /// The number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.numbering.count
    }

    /// The energy of `state`.
    pub fn energy(&mut self, state: &State) -> Energy {
        for (piece, facet) in self.sheet.pieces.iter().zip(&mut self.facets) {
            *facet = Facet::new(piece.corners.map(|corner| state.points[corner]));
        }
        self.fold(state);
        let mut energy = Energy::default();
        for (piece, moments) in self.sheet.pieces.iter().zip(&mut self.moments) {
            let x = piece.corners.map(|corner| state.points[corner]);
            let alpha: [f64; 3] = std::array::from_fn(|i| {
                let part = part_of_fold(piece.beyond[i]);
                part * self.turning[piece.edges[i]] + piece.lean[i] * state.leans[piece.edges[i]]
            });
            let k = &piece.stiffness;
            *moments = std::array::from_fn(|i| k[i][0] * alpha[0] + k[i][1] * alpha[1] + k[i][2] * alpha[2]);
            energy.membrane += self.sheet.membrane(piece, x).energy(&piece.flat);
            energy.bending += dot(alpha, *moments) / 2.0;
            energy.volume += piece.load * volume::volume(x);
        }
        energy.bending += self.sheet.kinks.iter().map(|kink| kink.energy(&state.points)).sum::<f64>();
        energy
    }

    /// Leaves the fold of each edge in `turning`.
    fn fold(&mut self, state: &State) {
        for (t, piece) in self.sheet.pieces.iter().enumerate() {
            for i in 0..3 {
                let side =
                    || minus(state.points[piece.corners[LAST[i]]], state.points[piece.corners[NEXT[i]]]);
                let normal = self.facets[t].normal;
                match piece.beyond[i] {
                    Beyond::Neighbour { triangle, .. } if triangle > t => {
                        self.turning[piece.edges[i]] = fold(normal, self.facets[triangle].normal, side());
                    }
                    Beyond::Image(plane) => {
                        let mirror = self.supports.planes[plane].upright();
                        self.turning[piece.edges[i]] = mirror_fold(normal, side(), mirror);
                    }
                    Beyond::Neighbour { .. } | Beyond::Nothing => {}
                }
            }
        }
    }

    /// The energy of `state` under `pressure`, and its gradient, which [`Assembly::gradient`] then gives.
    pub fn differentiate(&mut self, state: &State, pressure: f64) -> Energy {
        // First the moments of all pieces are summed by edges, because a fold turns both of its triangles. Then each
        // triangle adds its membrane, its pressure and its folds to the forces on its corners. The forces are gathered
        // into unknowns at the end.
        let energy = self.energy(state);
        self.turning.fill(0.0);
        self.leaning.fill(0.0);
        for (piece, moments) in self.sheet.pieces.iter().zip(&self.moments) {
            for (i, moment) in moments.iter().enumerate() {
                self.turning[piece.edges[i]] += part_of_fold(piece.beyond[i]) * moment;
                self.leaning[piece.edges[i]] += piece.lean[i] * moment;
            }
        }
        self.forces.fill([0.0; 3]);
        for (piece, facet) in self.sheet.pieces.iter().zip(&self.facets) {
            let x = piece.corners.map(|corner| state.points[corner]);
            let mut gradient = [0.0; 9];
            self.sheet.membrane(piece, x).add_gradient(&piece.flat, &mut gradient);
            volume::add_gradient(x, -piece.load * pressure, &mut gradient);
            for i in (0..3).filter(|_| piece.bends) {
                let weights = facet.weights(i);
                for k in 0..3 {
                    let force = self.turning[piece.edges[i]] * facet.lift[i] * weights[k];
                    for c in 0..3 {
                        gradient[3 * k + c] += force * facet.normal[c];
                    }
                }
            }
            for (k, corner) in piece.corners.into_iter().enumerate() {
                for c in 0..3 {
                    self.forces[corner][c] += gradient[3 * k + c];
                }
            }
        }
        self.sheet.kinks.iter().for_each(|kink| kink.add_forces(&state.points, &mut self.forces));
        self.gather();
        energy
    }

    /// The energy's derivatives by each point, as [`Assembly::differentiate`] left them: also by the coordinates that supports
    /// hold.
    pub fn forces(&self) -> &[[f64; 3]] {
        &self.forces
    }

    /// The forces on points and edges as the gradient by the unknowns.
    fn gather(&mut self) {
        for (point, numbers) in self.numbering.points.iter().enumerate() {
            let axes = &self.supports.holds[point].axes;
            for (number, axis) in numbers.iter().zip(axes).filter(|(number, _)| **number != NONE) {
                self.gradient[*number as usize] = dot(*axis, self.forces[point]);
            }
        }
        for (edge, number) in self.numbering.edges.iter().enumerate().filter(|(_, number)| **number != NONE) {
            self.gradient[*number as usize] = self.leaning[edge];
        }
    }

    /// The energy of `state` under `pressure`, its gradient and its Hessian.
    pub fn linearise(&mut self, state: &State, pressure: f64, tangent: Tangent) -> Energy {
        let energy = self.differentiate(state, pressure);
        let half = self.sheet.pieces.len() / 2;
        let (mut values, mut second) =
            (std::mem::take(&mut self.values), std::mem::take(&mut self.second_values));
        let halves = vec![(0..half, &mut values), (half..self.sheet.pieces.len(), &mut second)];
        Threads::available().run_each(halves, |(triangles, values)| {
            self.add_hessians(triangles, state, pressure, tangent, values);
        });
        values.iter_mut().zip(&second).for_each(|(value, second)| *value += second);
        (self.values, self.second_values) = (values, second);
        self.add_kinks();
        energy
    }

    /// Writes the Hessians of some triangles to `values`.
    fn add_hessians(
        &self,
        triangles: Range<usize>,
        state: &State,
        pressure: f64,
        tangent: Tangent,
        values: &mut [f64],
    ) {
        values.fill(0.0);
        let mut local: Local = [[0.0; LOCAL]; LOCAL];
        for t in triangles {
            let piece = &self.sheet.pieces[t];
            let turning = piece.edges.map(|edge| self.turning[edge]);
            let loads = Loads { pressure: piece.load * pressure, turning, turned: self.turned[t], tangent };
            let facets = (&self.facets[t], &self.facets[..]);
            local::fill((&self.sheet, &self.supports), piece, &state.points, facets, loads, &mut local);
            let mut places = self.pattern.places[t].iter();
            for (i, row) in local.iter().enumerate() {
                for (value, place) in row[..=i].iter().zip(&mut places) {
                    values[*place as usize] += value;
                }
            }
        }
    }

    /// The gradient of the last shape differentiated.
    pub fn gradient(&self) -> &[f64] {
        &self.gradient
    }

    /// The lower triangle of the last Hessian, by columns: where each begins, rows, values.
    pub fn hessian(&self) -> (&[u32], &[u32], &[f64]) {
        (&self.pattern.starts, &self.pattern.rows, &self.values[..self.pattern.rows.len()])
    }
}

/// Which part of an edge's fold is alpha.
fn part_of_fold(side: Beyond) -> f64 {
    match side {
        Beyond::Neighbour { .. } => 0.5,
        Beyond::Image(_) => 1.0, // the fold kept there is half of that between the triangle and its image
        Beyond::Nothing => 0.0,
    }
}
