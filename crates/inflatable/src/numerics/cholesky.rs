//! Cholesky factors of a symmetric banded matrix, in buffers that are made once.

/// A symmetric matrix whose entries further than `WIDTH - 1` from the diagonal vanish; only its lower half is kept.
///
/// Column `i` holds the entries of rows `i, i + 1, .., i + WIDTH - 1`, the diagonal first. Behind the last one there are
/// `WIDTH - 1` columns of zeros, so that no column is shorter than others.
#[derive(Clone, Debug, PartialEq)]
pub struct SymmetricBand<const WIDTH: usize> {
    size: usize,
    columns: Vec<[f64; WIDTH]>,
}

impl<const WIDTH: usize> SymmetricBand<WIDTH> {
    /// A zero matrix of `size` rows.
    pub fn zero(size: usize) -> Self {
        Self { size, columns: vec![[0.0; WIDTH]; size + WIDTH - 1] }
    }

    /// Makes every entry zero.
    pub fn clear(&mut self) {
        self.columns.fill([0.0; WIDTH]);
    }

    /// The entry in row `row`, `back` columns left of the diagonal.
    #[inline]
    pub fn entry(&mut self, row: usize, back: usize) -> &mut f64 {
        &mut self.columns[row - back][back]
    }

    /// Makes row and column `index` those of the identity.
    pub fn pin(&mut self, index: usize) {
        for back in 1..WIDTH.min(index + 1) {
            *self.entry(index, back) = 0.0;
        }
        self.columns[index] = [0.0; WIDTH];
        self.columns[index][0] = 1.0;
    }

    /// The matrix times `vector`.
    pub fn times(&self, vector: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; vector.len()];
        for (i, column) in self.columns[..self.size].iter().enumerate() {
            for (below, entry) in column.iter().enumerate().take(self.size - i) {
                product[i + below] += entry * vector[i];
                if below > 0 {
                    product[i] += entry * vector[i + below];
                }
            }
        }
        product
    }

    /// Factors `matrix + shift * diagonal` into `self`, `L L^T`; returns whether it is positive definite.
    ///
    /// If it is not, the contents of `self` are meaningless.
    #[must_use]
    pub fn factor(&mut self, matrix: &Self, shift: f64, diagonal: &[f64]) -> bool {
        self.columns.copy_from_slice(&matrix.columns);
        for (i, weight) in diagonal.iter().enumerate().take(self.size) {
            let (first, right) = self.columns[i..i + WIDTH].split_at_mut(1);
            let pivot_column = &mut first[0];
            let pivot = pivot_column[0] + shift * weight;
            // Also false for NaN.
            if !(pivot > 0.0 && pivot.is_finite()) {
                return false;
            }
            // The diagonal of a factored column is kept as its inverse.
            let inverse = pivot.sqrt().recip();
            for entry in pivot_column.iter_mut() {
                *entry *= inverse;
            }
            pivot_column[0] = inverse;
            for (a, column) in right.iter_mut().enumerate() {
                let factor = pivot_column[a + 1];
                for (entry, other) in column.iter_mut().zip(&pivot_column[a + 1..]) {
                    *entry -= factor * other;
                }
            }
        }
        true
    }

    /// Solves for the right-hand side in place; `self` holds factors.
    pub fn solve(&self, right: &mut [f64]) {
        // Space for the columns of zeros: every step works on as many entries.
        let mut padded = [&*right, &[0.0; WIDTH]].concat();
        let columns = &self.columns[..self.size];
        for (i, column) in columns.iter().enumerate() {
            let Some(window) = padded[i..].first_chunk_mut::<WIDTH>() else { break };
            let value = window[0] * column[0];
            for (entry, below) in window.iter_mut().zip(column) {
                *entry -= below * value;
            }
            window[0] = value;
        }
        for (i, column) in columns.iter().enumerate().rev() {
            let Some(window) = padded[i..].first_chunk_mut::<WIDTH>() else { break };
            let mut sum = window[0];
            for (entry, below) in window.iter().zip(column).skip(1) {
                sum -= entry * below;
            }
            window[0] = sum * column[0];
        }
        right.copy_from_slice(&padded[..self.size]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A diagonally dominant matrix of 17 rows.
    fn matrix(diagonal: f64) -> SymmetricBand<4> {
        let mut matrix = SymmetricBand::zero(17);
        for i in 0..17 {
            *matrix.entry(i, 0) = diagonal;
            for back in 1..4.min(i + 1) {
                let seed = u32::try_from((i * 31 + back * 17) % 19).expect("small");
                *matrix.entry(i, back) = 0.1 * f64::from(seed) - 0.9;
            }
        }
        matrix
    }

    #[test]
    fn solves_what_it_multiplies() {
        let band_matrix = matrix(6.0);
        let solution: Vec<f64> = (0..17).map(|i| f64::from(i % 7) - 2.5).collect();
        let mut right = band_matrix.times(&solution);
        let mut factors = SymmetricBand::zero(17);
        assert!(factors.factor(&band_matrix, 0.0, &[0.0; 17]));
        factors.solve(&mut right);
        for (got, want) in right.iter().zip(&solution) {
            assert!((got - want).abs() < 1e-13, "{got} {want}");
        }
    }

    #[test]
    fn tells_what_is_not_positive_definite() {
        let mut factors = SymmetricBand::zero(17);
        assert!(!factors.factor(&matrix(0.5), 0.0, &[1.0; 17]));
        assert!(!factors.factor(&matrix(f64::NAN), 0.0, &[1.0; 17]));
        assert!(factors.factor(&matrix(0.5), 6.0, &[1.0; 17]));
    }

    #[test]
    fn a_pinned_row_leaves_the_others_alone() {
        let mut band_matrix = matrix(6.0);
        band_matrix.pin(5);
        let mut factors = SymmetricBand::zero(17);
        assert!(factors.factor(&band_matrix, 0.0, &[0.0; 17]));
        let mut right = vec![0.0; 17];
        right[5] = 3.0;
        factors.solve(&mut right);
        assert!(right.iter().enumerate().all(|(i, x)| *x == if i == 5 { 3.0 } else { 0.0 }));
    }
}
