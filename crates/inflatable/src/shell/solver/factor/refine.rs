//! Conjugate gradients with a factor in single precision as the preconditioner: of the matrix itself, or of one that is near to it.

use crate::numerics::dot;
use crate::shell::solver::factor::matrix::Matrix;

/// How an iteration ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Convergence {
    /// The vector is the solution.
    Reached,
    /// It is not yet.
    Missed,
    /// The matrix is not positive definite in a direction that the iteration took: rounding had hidden that from the factor. The vector is a
    /// direction of descent.
    Indefinite,
}

/// The vectors of an iteration.
pub(super) struct Refinement {
    residual: Vec<f64>,
    conditioned: Vec<f64>,
    direction: Vec<f64>,
    product: Vec<f64>,
}

impl Refinement {
    pub(super) fn new(unknowns: usize) -> Self {
        let zeros = vec![0.0; unknowns];
        Self { residual: zeros.clone(), conditioned: zeros.clone(), direction: zeros.clone(), product: zeros }
    }

    /// The norm of what the last solution leaves of its right side.
    pub(super) fn residual_norm(&self) -> f64 {
        dot(&self.residual, &self.residual).sqrt()
    }

    /// Turns the right side into the solution, up to a part `accuracy` of it in the norm of the energy, in `max_iterations` iterations.
    pub(super) fn solve(
        &mut self,
        matrix: &Matrix,
        vector: &mut [f64],
        (accuracy, max_iterations): (f64, u32),
        mut precondition: impl FnMut(&mut [f64]),
    ) -> Convergence {
        // Conjugate gradients, preconditioned by a factor in single precision or of a matrix near by. A direction of
        // negative curvature proves that the matrix is indefinite.
        let Self { residual, conditioned, direction, product } = self;
        residual.copy_from_slice(vector);
        conditioned.copy_from_slice(vector);
        vector.fill(0.0);
        precondition(conditioned);
        direction.copy_from_slice(conditioned);
        let first = dot(residual, conditioned);
        let mut square = first;
        for iteration in 0..max_iterations {
            matrix.times(direction, product);
            let curvature = dot(direction, product);
            let bends_up = curvature > 0.0;
            if !bends_up {
                if iteration == 0 {
                    vector.copy_from_slice(direction);
                }
                return if square == 0.0 { Convergence::Reached } else { Convergence::Indefinite };
            }
            let length = square / curvature;
            for ((x, r), (d, p)) in vector.iter_mut().zip(&mut *residual).zip(direction.iter().zip(&*product))
            {
                *x += length * d;
                *r -= length * p;
            }
            conditioned.copy_from_slice(residual);
            precondition(conditioned);
            let square_now = dot(residual, conditioned);
            if square_now <= accuracy * accuracy * first {
                return Convergence::Reached;
            }
            let share = square_now / square;
            square = square_now;
            direction.iter_mut().zip(&*conditioned).for_each(|(d, z)| *d = z + share * *d);
        }
        Convergence::Missed
    }
}
