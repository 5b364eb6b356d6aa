//! Cholesky factors of a symmetric banded matrix, in buffers that are made once.

/// A symmetric matrix whose entries further than `WIDTH - 1` from the diagonal vanish; only its lower half is kept.
///
/// Row `i` holds the entries of columns `i, i - 1, .., i - WIDTH + 1`, the diagonal first.
#[derive(Clone, Debug, PartialEq)]
pub struct SymmetricBand<const WIDTH: usize> {
    rows: Vec<[f64; WIDTH]>,
}

impl<const WIDTH: usize> SymmetricBand<WIDTH> {
    /// A zero matrix of `size` rows.
    pub fn zero(size: usize) -> Self {
        Self { rows: vec![[0.0; WIDTH]; size] }
    }

    /// Makes every entry zero.
    pub fn clear(&mut self) {
        self.rows.fill([0.0; WIDTH]);
    }

    /// The entry in row `row`, `back` columns left of the diagonal.
    #[inline]
    pub fn entry(&mut self, row: usize, back: usize) -> &mut f64 {
        &mut self.rows[row][back]
    }

    /// Makes row and column `index` those of the identity.
    pub fn pin(&mut self, index: usize) {
        self.rows[index] = [0.0; WIDTH];
        self.rows[index][0] = 1.0;
        for (back, row) in self.rows[index + 1..].iter_mut().take(WIDTH - 1).enumerate() {
            row[back + 1] = 0.0;
        }
    }

    /// The matrix times `vector`.
    pub fn times(&self, vector: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; vector.len()];
        for (i, row) in self.rows.iter().enumerate() {
            for (back, entry) in row.iter().enumerate().take(i + 1) {
                product[i] += entry * vector[i - back];
                if back > 0 {
                    product[i - back] += entry * vector[i];
                }
            }
        }
        product
    }

    /// Factors `matrix + shift * diagonal` into `self`, `L L^T`; whether it is positive definite.
    ///
    /// If it is not, what `self` holds afterwards is of no use.
    #[must_use]
    pub fn factor(&mut self, matrix: &Self, shift: f64, diagonal: &[f64]) -> bool {
        self.rows.copy_from_slice(&matrix.rows);
        for i in 0..self.rows.len() {
            let (above, below) = self.rows.split_at_mut(i);
            let row = &mut below[0];
            row[0] += shift * diagonal[i];
            for back in (1..WIDTH.min(i + 1)).rev() {
                let other = &above[i - back];
                let mut sum = row[back];
                for k in 1..WIDTH - back {
                    sum -= row[back + k] * other[k];
                }
                // The diagonal of a factored row is kept as its inverse.
                row[back] = sum * other[0];
            }
            let sum = row[1..].iter().fold(row[0], |sum, entry| sum - entry * entry);
            // Also false for what is not a number.
            if !(sum > 0.0 && sum.is_finite()) {
                return false;
            }
            row[0] = sum.sqrt().recip();
        }
        true
    }

    /// Solves for the right-hand side in place; `self` holds factors.
    pub fn solve(&self, right: &mut [f64]) {
        let size = self.rows.len();
        for i in 0..size {
            let row = &self.rows[i];
            let mut sum = right[i];
            for back in 1..WIDTH.min(i + 1) {
                sum -= row[back] * right[i - back];
            }
            right[i] = sum * row[0];
        }
        for i in (0..size).rev() {
            let row = &self.rows[i];
            let value = right[i] * row[0];
            right[i] = value;
            for back in 1..WIDTH.min(i + 1) {
                right[i - back] -= row[back] * value;
            }
        }
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
        let matrix = matrix(6.0);
        let solution: Vec<f64> = (0..17).map(|i| f64::from(i % 7) - 2.5).collect();
        let mut right = matrix.times(&solution);
        let mut factors = SymmetricBand::zero(17);
        assert!(factors.factor(&matrix, 0.0, &[0.0; 17]));
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
        let mut matrix = matrix(6.0);
        matrix.pin(5);
        let mut factors = SymmetricBand::zero(17);
        assert!(factors.factor(&matrix, 0.0, &[0.0; 17]));
        let mut right = vec![0.0; 17];
        right[5] = 3.0;
        factors.solve(&mut right);
        assert!(right.iter().enumerate().all(|(i, x)| *x == if i == 5 { 3.0 } else { 0.0 }));
    }
}
