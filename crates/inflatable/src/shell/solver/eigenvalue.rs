//! The lowest eigenvalue of a shape's Hessian: whether it is stable, and how far it is from not being so.

use crate::shell::assembly::{Sheet, State};
use crate::shell::element::vector::dot;
use crate::shell::solver::factor::EXACT;
use crate::shell::solver::newton::Solver;

/// A field of vectors on the points.
pub(crate) type NodeField = Vec<[f64; 3]>;

/// The first shift, by the pressure: little beside any eigenvalue that matters, and much beside rounding.
const LEAST_SHIFT: f64 = 1e-4;
/// Factor from shift to shift, and how many there are.
const GROWTH: f64 = 4.0;
const MOST_SHIFTS: i32 = 30;
/// Inverse iterations at most, and the relative change of the eigenvalue at which they end.
const MOST_ITERATIONS: u32 = 60;
const CHANGE: f64 = 1e-5;

impl Solver {
    /// The lowest eigenvalue of the Hessian of `state`: of twice the energy over the square of the displacement, summed over the flat area.
    /// `motions` take no energy and are left out. `None` if no shift makes the Hessian positive definite.
    ///
    /// By inverse iteration from a field without any symmetry, with the least shift by areas that allows a Cholesky factor.
    pub(crate) fn lowest_eigenvalue(
        &mut self,
        state: &State,
        pressure: f64,
        motions: &[NodeField],
    ) -> Option<f64> {
        let _ = self.linearise(state, pressure);
        let masses = self.assembly.masses();
        let mut shifts = (0..MOST_SHIFTS).map(|k| LEAST_SHIFT * pressure * GROWTH.powi(k));
        let shift = shifts.find(|shift| self.factor.compute(self.assembly.hessian().2, *shift, &masses))?;
        let points = self.assembly.sheet.points.len();
        let mut field: NodeField = (0_u32..)
            .take(points)
            .map(|k| [0.7, 1.3, 2.1].map(|c| libm::sin(c * f64::from(k) + c)))
            .collect();
        let mut value = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            let sheet = &self.assembly.sheet;
            normalise(sheet, motions, &mut field);
            let loads: Vec<(usize, [f64; 3])> = (0..)
                .zip(field.iter().zip(&sheet.areas))
                .map(|(k, (x, area))| (k, x.map(|x| area * x)))
                .collect();
            let mut answer = self.assembly.project(&loads);
            self.factor.solve(&mut answer, EXACT);
            let leans = vec![0.0; self.assembly.sheet.edge_count];
            let mut moved = State { points: vec![[0.0; 3]; points], leans };
            self.assembly.advance(&mut moved, &answer, 1.0);
            let sheet = &self.assembly.sheet;
            take_off(sheet, motions, &mut moved.points);
            let previous = value;
            value = 1.0 / product(sheet, &field, &moved.points) - shift;
            field = moved.points;
            if (value - previous).abs() <= CHANGE * value.abs().max(pressure * CHANGE) {
                break;
            }
        }
        Some(value)
    }
}

/// Sum of products, each point weighted by its area.
fn product(sheet: &Sheet, a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let terms = sheet.areas.iter().zip(a.iter().zip(b));
    terms.map(|(area, (a, b))| area * dot(*a, *b)).sum()
}

/// The motions `kinds` of a shape as a whole, orthonormal: 0 to 2 along the axes, 3 to 5 around them.
pub(crate) fn rigid_motions(sheet: &Sheet, points: &[[f64; 3]], kinds: &[usize]) -> Vec<NodeField> {
    let mut motions: Vec<NodeField> = Vec::new();
    for k in kinds {
        let mut field: NodeField = points.iter().map(|x| rigid_motion(*k, *x)).collect();
        normalise(sheet, &motions, &mut field);
        motions.push(field);
    }
    motions
}

/// Motion `k` of [`rigid_motions`] at a point, not yet of unit length.
fn rigid_motion(k: usize, [x, y, z]: [f64; 3]) -> [f64; 3] {
    match k {
        0 => [1.0, 0.0, 0.0],
        1 => [0.0, 1.0, 0.0],
        2 => [0.0, 0.0, 1.0],
        3 => [0.0, -z, y],
        4 => [z, 0.0, -x],
        _ => [-y, x, 0.0],
    }
}

/// Makes `field` of unit size, without `motions`.
fn normalise(sheet: &Sheet, motions: &[NodeField], field: &mut NodeField) {
    take_off(sheet, motions, field);
    let size = product(sheet, field, field).sqrt();
    field.iter_mut().flatten().for_each(|x| *x /= size);
}

fn take_off(sheet: &Sheet, motions: &[NodeField], field: &mut NodeField) {
    for motion in motions {
        let part = product(sheet, motion, field);
        for (x, r) in field.iter_mut().zip(motion) {
            (0..3).for_each(|c| x[c] -= part * r[c]);
        }
    }
}
