//! The sparse Cholesky factor of the system: analysed once a mesh, computed again in the same buffers each iteration.
//!
//! Columns are computed from left to right, many at a time: a supernode collects the updates of all those below it in the elimination
//! tree, as dense products. (Ng and Peyton, "Block sparse Cholesky algorithms on advanced uniprocessor computers", 1993.)

mod dense;
mod numeric;
mod symbolic;
#[cfg(test)]
mod tests;
mod tree;

use crate::shell::solver::factor::numeric::Numeric;
use crate::shell::solver::factor::symbolic::Symbolic;
use crate::shell::solver::factor::tree::Lists;

/// The factor of a symmetric matrix given by the lower triangle of its columns.
pub(crate) struct Factor {
    symbolic: Symbolic,
    numeric: Numeric,
    /// Place of each column's diagonal among the matrix' values.
    diagonal: Vec<usize>,
}

impl Factor {
    /// Analyses the pattern, in which the rows of each column rise from its diagonal on; `None` if it is too large for this machine.
    pub(crate) fn new(starts: &[u32], rows: &[u32]) -> Option<Self> {
        let wide = |numbers: &[u32]| numbers.iter().map(|number| *number as usize).collect();
        let lower = Lists { starts: wide(starts), items: wide(rows) };
        let symbolic = Symbolic::new(&lower);
        let numeric = Numeric::new(&symbolic)?;
        let mut diagonal = lower.starts;
        let _ = diagonal.pop();
        Some(Self { symbolic, numeric, diagonal })
    }

    /// Numbers kept of the factor.
    #[cfg(test)]
    pub(crate) fn size(&self) -> usize {
        self.symbolic.size
    }

    /// Factors the matrix with `shift[k]` times `factor` added to its diagonal; false if that is not positive definite.
    pub(crate) fn compute(&mut self, values: &[f64], factor: f64, shift: &[f64]) -> bool {
        self.numeric.load(&self.symbolic, values);
        if factor != 0.0 {
            for (place, shift) in self.diagonal.iter().zip(shift) {
                self.numeric.numbers[self.symbolic.places[*place]] += factor * shift;
            }
        }
        self.numeric.compute(&self.symbolic)
    }

    /// Solves with the factor computed last.
    pub(crate) fn solve(&mut self, rhs: &mut [f64]) {
        self.numeric.solve(&self.symbolic, rhs);
    }
}
