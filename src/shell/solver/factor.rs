//! The sparse Cholesky factor of the system: analysed once a mesh, computed again in the same buffers each iteration.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par, Side};

/// The factor of a symmetric matrix given by the lower triangle of its columns.
pub(crate) struct Factor {
    symbolic: SymbolicCholesky<u32>,
    /// The matrix' lower triangle.
    pattern: SymbolicSparseColMat<u32>,
    values: Vec<f64>,
    memory: MemBuffer,
    /// Place of each column's diagonal among the matrix' values.
    pub(crate) diagonal: Vec<usize>,
    shifted: Vec<f64>,
}

impl Factor {
    /// Analyses the pattern; `None` if it is too large for this machine.
    pub(crate) fn new(starts: &[u32], rows: &[u32]) -> Option<Self> {
        let count = starts.len() - 1;
        // With the order kept, the analysis reads the upper triangle whatever side it is told.
        let upper = upper(starts, rows);
        // Always by supernodes: column by column is 20 times slower at 30,000 unknowns.
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..CholeskySymbolicParams::default()
        };
        let symbolic =
            factorize_symbolic_cholesky(upper.as_ref(), Side::Upper, SymmetricOrdering::Identity, params)
                .ok()?;
        let numeric = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, faer::Spec::default());
        let memory = numeric.or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        Some(Self {
            values: vec![0.0; symbolic.len_val()],
            memory: MemBuffer::try_new(memory).ok()?,
            symbolic,
            pattern: SymbolicSparseColMat::new_checked(count, count, starts.to_vec(), None, rows.to_vec()),
            diagonal: starts[..starts.len() - 1].iter().map(|start| *start as usize).collect(),
            shifted: vec![0.0; rows.len()],
        })
    }

    /// Numbers kept of the factor.
    pub(crate) fn size(&self) -> usize {
        self.values.len()
    }

    /// Factors the matrix with `shift[k]` times `factor` added to its diagonal; false if that is not positive definite.
    pub(crate) fn compute(&mut self, values: &[f64], factor: f64, shift: &[f64]) -> bool {
        let values = if factor == 0.0 {
            values
        } else {
            self.shifted.copy_from_slice(values);
            for (place, shift) in self.diagonal.iter().zip(shift) {
                self.shifted[*place] += factor * shift;
            }
            &self.shifted
        };
        let matrix = SparseColMatRef::new(self.pattern.as_ref(), values);
        self.symbolic
            .factorize_numeric_llt(
                &mut self.values,
                matrix,
                Side::Lower,
                LltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut self.memory),
                faer::Spec::default(),
            )
            .is_ok()
    }

    /// Solves with the factor computed last.
    pub(crate) fn solve(&mut self, rhs: &mut [f64]) {
        let count = rhs.len();
        LltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(rhs, count, 1),
            Par::Seq,
            MemStack::new(&mut self.memory),
        );
    }

    /// Whether the factor is computed by supernodes.
    #[cfg(test)]
    pub(crate) fn is_supernodal(&self) -> bool {
        matches!(self.symbolic.raw(), faer::sparse::linalg::cholesky::SymbolicCholeskyRaw::Supernodal(_))
    }
}

/// The transpose of the lower triangle's pattern.
fn upper(starts: &[u32], rows: &[u32]) -> SymbolicSparseColMat<u32> {
    let count = starts.len() - 1;
    let mut begins = vec![0_u32; count + 1];
    for row in rows {
        begins[*row as usize + 1] += 1;
    }
    for k in 0..count {
        begins[k + 1] += begins[k];
    }
    let mut next = begins.clone();
    let mut columns = vec![0_u32; rows.len()];
    for (column, ends) in (0_u32..).zip(starts.windows(2)) {
        for row in &rows[ends[0] as usize..ends[1] as usize] {
            let place = &mut next[*row as usize];
            columns[*place as usize] = column;
            *place += 1;
        }
    }
    SymbolicSparseColMat::new_checked(count, count, begins, None, columns)
}
