//! LU factors of a banded matrix with partial pivoting.

/// A square matrix with `below` diagonals below the main one and `above` above, row by row.
///
/// Each row holds `2 below + above + 1` entries, because row exchanges widen the upper band by `below`.
#[derive(Clone, Debug)]
pub struct Banded {
    size: usize,
    below: usize,
    width: usize,
    entries: Vec<f64>,
    pivots: Vec<usize>,
}

impl Banded {
    /// A zero matrix.
    pub fn zero(size: usize, below: usize, above: usize) -> Self {
        let width = 2 * below + above + 1;
        Self { size, below, width, entries: vec![0.0; size * width], pivots: Vec::new() }
    }

    #[inline]
    fn place(&self, row: usize, column: usize) -> usize {
        row * self.width + column + self.below - row
    }

    /// Sets an entry that lies within the band.
    #[inline]
    pub fn set(&mut self, row: usize, column: usize, value: f64) {
        let place = self.place(row, column);
        self.entries[place] = value;
    }

    /// Factors in place; `None` if the matrix is singular or not finite.
    pub fn factor(mut self) -> Option<Factors> {
        // Gaussian elimination with partial pivoting. A row below the pivot reaches at most `below` rows down, and an
        // exchange widens a row by as many entries: so the band has room for both. The factors take the place of the
        // entries that they eliminate.
        self.pivots = Vec::with_capacity(self.size);
        for column in 0..self.size {
            let last = (column + self.below).min(self.size - 1);
            let reach = (column + self.width - self.below).min(self.size);
            let (mut pivot, mut largest) = (column, 0.0);
            for row in column..=last {
                let size = self.entries[self.place(row, column)].abs();
                if size > largest {
                    (pivot, largest) = (row, size);
                }
            }
            if largest <= 0.0 || !largest.is_finite() {
                return None;
            }
            self.pivots.push(pivot);
            if pivot != column {
                for k in column..reach {
                    let (a, b) = (self.place(column, k), self.place(pivot, k));
                    self.entries.swap(a, b);
                }
            }
            let diagonal = self.entries[self.place(column, column)];
            for row in column + 1..=last {
                let place = self.place(row, column);
                let factor = self.entries[place] / diagonal;
                self.entries[place] = factor;
                if factor != 0.0 {
                    let (top, pivot_row) = (self.place(column, column), place);
                    let (head, tail) = self.entries.split_at_mut(pivot_row);
                    let source = &head[top + 1..top + reach - column];
                    for (entry, above) in tail[1..].iter_mut().zip(source) {
                        *entry -= factor * above;
                    }
                }
            }
        }
        Some(Factors(self))
    }
}

/// The factors of a [`Banded`] matrix.
#[derive(Clone, Debug)]
pub struct Factors(Banded);

impl Factors {
    /// Solves for the right-hand side in place.
    pub fn solve(&self, right: &mut [f64]) {
        let lu = &self.0;
        for column in 0..lu.size {
            right.swap(column, lu.pivots[column]);
            for row in column + 1..=(column + lu.below).min(lu.size - 1) {
                right[row] -= lu.entries[lu.place(row, column)] * right[column];
            }
        }
        for row in (0..lu.size).rev() {
            let reach = (row + lu.width - lu.below).min(lu.size);
            for column in row + 1..reach {
                right[row] -= lu.entries[lu.place(row, column)] * right[column];
            }
            right[row] /= lu.entries[lu.place(row, row)];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_what_it_multiplies() {
        let (size, below, above) = (23, 3, 2);
        let entry = |i: usize, j: usize| {
            let seed = u32::try_from((i * 31 + j * 17) % 19).expect("small");
            // A weak diagonal, so that rows must be exchanged.
            if i == j { 0.01 } else { f64::from(seed) - 9.0 }
        };
        let is_in_band = |i: usize, j: usize| j + below >= i && j <= i + above;
        let mut matrix = Banded::zero(size, below, above);
        let solution: Vec<f64> = (0..23).map(|i| f64::from(i % 7) - 2.5).collect();
        let mut right = vec![0.0; size];
        for (i, sum) in right.iter_mut().enumerate() {
            for j in (0..size).filter(|&j| is_in_band(i, j)) {
                matrix.set(i, j, entry(i, j));
                *sum += entry(i, j) * solution[j];
            }
        }
        matrix.factor().expect("regular").solve(&mut right);
        for (got, want) in right.iter().zip(&solution) {
            assert!((got - want).abs() < 1e-10, "{got} {want}");
        }
    }

    #[test]
    fn refuses_a_singular_matrix() {
        let mut matrix = Banded::zero(3, 1, 1);
        matrix.set(0, 0, 1.0);
        assert!(matrix.factor().is_none());
    }
}
