//! Conjugate gradients with the factor in single precision as the preconditioner.

use crate::numerics::dot;
use crate::shell::solver::factor::matrix::Matrix;

/// Iterations at most. Shells take three to five.
const MOST_ITERATIONS: u32 = 100;

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

    /// Turns the right side into the solution, up to a part `accuracy` of it in the norm of the energy. False, and a direction of descent, if
    /// the matrix is not positive definite in some direction that the iteration takes: rounding had hidden that from the factor.
    pub(super) fn solve(
        &mut self,
        matrix: &Matrix,
        vector: &mut [f64],
        accuracy: f64,
        mut precondition: impl FnMut(&mut [f64]),
    ) -> bool {
        let Self { residual, conditioned, direction, product } = self;
        residual.copy_from_slice(vector);
        conditioned.copy_from_slice(vector);
        vector.fill(0.0);
        precondition(conditioned);
        direction.copy_from_slice(conditioned);
        let first = dot(residual, conditioned);
        let mut square = first;
        for iteration in 0..MOST_ITERATIONS {
            matrix.times(direction, product);
            let curvature = dot(direction, product);
            let bends_up = curvature > 0.0;
            if !bends_up {
                if iteration == 0 {
                    vector.copy_from_slice(direction);
                }
                return square == 0.0;
            }
            let length = square / curvature;
            for ((x, r), (d, p)) in vector.iter_mut().zip(&mut *residual).zip(direction.iter().zip(&*product))
            {
                *x += length * d;
                *r -= length * p;
            }
            conditioned.copy_from_slice(residual);
            precondition(conditioned);
            let left = dot(residual, conditioned);
            if left <= accuracy * accuracy * first {
                break;
            }
            let kept = left / square;
            square = left;
            direction.iter_mut().zip(&*conditioned).for_each(|(d, z)| *d = z + kept * *d);
        }
        true
    }
}
