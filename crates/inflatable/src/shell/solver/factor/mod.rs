//! The sparse Cholesky factor of the system: analysed once a mesh, computed again in the same buffers each iteration.
//!
//! Columns are computed from left to right, many at a time: a supernode collects the updates of all those below it in the elimination
//! tree, as dense products. (Ng and Peyton, "Block sparse Cholesky algorithms on advanced uniprocessor computers", 1993.) Subtrees that do
//! not need each other, and blocks of the columns of wide supernodes, are computed at the same time.
//!
//! The factor is in single precision, which takes half the time, and conjugate gradients bring a solution to double precision (Arioli and
//! Duff, "Using FGMRES to obtain backward stability in mixed precision", 2009). Where single precision finds no factor, double precision
//! can decide whether the matrix is positive definite.

mod dense;
mod matrix;
mod numeric;
mod refine;
mod subtree;
mod supernode;
mod symbolic;
/// `numbers` as indices.
fn wide(numbers: &[u32]) -> Vec<usize> {
    numbers.iter().map(|number| *number as usize).collect()
}

#[cfg(test)]
mod tests;
mod tree;
mod triangular;
mod updates;

use crate::shell::solver::factor::matrix::Matrix;
use crate::shell::solver::factor::numeric::Numeric;
use crate::shell::solver::factor::refine::{Convergence, Refinement};
use crate::shell::solver::factor::symbolic::Symbolic;
use crate::shell::solver::factor::tree::Lists;

/// The accuracy of solutions that enter results, relative.
pub(crate) const EXACT: f64 = 1e-10;
/// Iterations of a solution at most. With the factor of the matrix itself shells take three to five.
const MOST_ITERATIONS: u32 = 100;

/// The factor of a symmetric matrix given by the lower triangle of its columns.
pub(crate) struct Factor {
    symbolic: Symbolic,
    matrix: Matrix,
    /// The factor of the matrix scaled to a diagonal of ones.
    single: Numeric<f32>,
    scale: Vec<f64>,
    /// The factor of the matrix itself, where single precision did not suffice.
    double: Option<Numeric<f64>>,
    is_double: bool,
    /// Whether the factor in single precision is that of a matrix without shift.
    is_plain: bool,
    refinement: Refinement,
}

impl Factor {
    /// Analyses the pattern, in which the rows of each column rise from its diagonal on; `None` if it is too large for this machine.
    pub(crate) fn new(starts: &[u32], rows: &[u32]) -> Option<Self> {
        let lower = Lists { starts: wide(starts), items: wide(rows) };
        let symbolic = Symbolic::new(&lower);
        Some(Self {
            single: Numeric::new(&symbolic)?,
            double: None,
            is_double: false,
            is_plain: false,
            scale: vec![0.0; lower.count()],
            refinement: Refinement::new(lower.count()),
            matrix: Matrix { values: vec![0.0; rows.len()], lower },
            symbolic,
        })
    }

    /// Numbers kept of the factor.
    #[cfg(test)]
    pub(crate) fn size(&self) -> usize {
        self.symbolic.size
    }

    /// Factors the matrix with `shift[k]` times `factor` added to its diagonal, in single precision; false if there is no such factor.
    pub(crate) fn compute(&mut self, values: &[f64], factor: f64, shift: &[f64]) -> bool {
        self.matrix.values.copy_from_slice(values);
        self.is_double = false;
        let Self { matrix: Matrix { lower, values }, scale, .. } = self;
        if factor != 0.0 {
            lower.starts.iter().zip(shift).for_each(|(place, shift)| values[*place] += factor * shift);
        }
        for (scale, &place) in scale.iter_mut().zip(&lower.starts) {
            *scale = 1.0 / values[place].sqrt();
        }
        let scaled = |place: usize, row: usize, column: usize| values[place] * scale[row] * scale[column];
        let is_definite = self.single.compute(&self.symbolic, lower, &scaled);
        self.is_plain = is_definite && factor == 0.0;
        is_definite
    }

    /// Replaces the matrix by one near to it and keeps the factor, with which solutions take more iterations; false if the factor is not of a
    /// kind to be kept.
    pub(crate) fn keep_for(&mut self, values: &[f64]) -> bool {
        let is_kept = self.is_plain && !self.is_double;
        if is_kept {
            self.matrix.values.copy_from_slice(values);
        }
        is_kept
    }

    /// Factors the same matrix in double precision, which decides where single precision found no factor; false if it is not positive
    /// definite.
    pub(crate) fn compute_double(&mut self) -> bool {
        if self.double.is_none() {
            self.double = Numeric::new(&self.symbolic);
        }
        let Some(double) = &mut self.double else { return false };
        let Matrix { lower, values } = &self.matrix;
        self.is_double = double.compute(&self.symbolic, lower, &|place, _, _| values[place]);
        self.is_double
    }

    /// Solves with the factor computed last, up to a part `accuracy` of the solution in the norm of the energy.
    pub(crate) fn solve(&mut self, rhs: &mut [f64], accuracy: f64) {
        let _ = self.refine(rhs, accuracy, MOST_ITERATIONS);
    }

    /// Solves in `max_iterations` iterations; false, and no solution, if they do not suffice or the matrix is not positive definite.
    pub(crate) fn solve_within(&mut self, max_iterations: u32, rhs: &mut [f64], accuracy: f64) -> bool {
        self.refine(rhs, accuracy, max_iterations) == Convergence::Reached
    }

    /// The norm of what the last solution leaves of its right side.
    pub(crate) fn residual(&self) -> f64 {
        if self.is_double { 0.0 } else { self.refinement.residual_norm() }
    }

    /// Whether double precision, too, finds the matrix positive definite: rounding to single precision can hide a direction in which it is
    /// not, and almost any solution follows that direction.
    pub(crate) fn is_confirmed(&mut self) -> bool {
        if self.is_double {
            return true;
        }
        let mut probe: Vec<f64> = (1_u32..).take(self.scale.len()).map(|k| libm::sin(f64::from(k))).collect();
        probe.iter_mut().zip(&self.scale).for_each(|(x, scale)| *x /= scale);
        match self.refine(&mut probe, EXACT, MOST_ITERATIONS) {
            Convergence::Reached => true,
            Convergence::Indefinite => false,
            Convergence::Missed => self.compute_double(),
        }
    }

    fn refine(&mut self, rhs: &mut [f64], accuracy: f64, max_iterations: u32) -> Convergence {
        if let Some(double) = self.double.as_mut().filter(|_| self.is_double) {
            double.solve(&self.symbolic, rhs);
            return Convergence::Reached;
        }
        let Self { symbolic, matrix, single, scale, refinement, .. } = self;
        refinement.solve(matrix, rhs, (accuracy, max_iterations), |vector| {
            vector.iter_mut().zip(&*scale).for_each(|(x, scale)| *x *= scale);
            single.solve(symbolic, vector);
            vector.iter_mut().zip(&*scale).for_each(|(x, scale)| *x *= scale);
        })
    }
}
