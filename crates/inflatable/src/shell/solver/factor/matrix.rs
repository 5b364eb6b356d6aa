//! A sparse symmetric matrix.

use crate::shell::solver::factor::tree::Lists;

/// The lower triangle of a symmetric matrix by columns, whose rows rise from the diagonal on.
pub(super) struct Matrix {
    pub(super) lower: Lists,
    pub(super) values: Vec<f64>,
}

impl Matrix {
    /// Writes its product with `x` to `result`.
    pub(super) fn times(&self, x: &[f64], result: &mut [f64]) {
        result.fill(0.0);
        for (column, ends) in self.lower.starts.windows(2).enumerate() {
            let mut sum = self.values[ends[0]] * x[column];
            for place in ends[0] + 1..ends[1] {
                let (row, value) = (self.lower.items[place], self.values[place]);
                sum += value * x[row];
                result[row] += value * x[column];
            }
            result[column] += sum;
        }
    }
}
