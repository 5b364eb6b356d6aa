//! Dense blocks by columns: products by nalgebra's kernels, the Cholesky factor of a panel by halves.
//!
//! The kernels are chosen for the processor: answers are the same in debug and release, and differ by rounding between processors.

use crate::numerics::Threads;
use nalgebra::{Dyn, MatrixView, MatrixViewMut, RealField};

type View<'a, R> = MatrixView<'a, R, Dyn, Dyn, Dyn, Dyn>;
type ViewMut<'a, R> = MatrixViewMut<'a, R, Dyn, Dyn, Dyn, Dyn>;

/// The kernels take blocks of more than so many rows and columns.
const SMALL: usize = 5;
/// Columns of a panel that are computed one by one.
const COLUMN_BY_COLUMN: usize = 12;
/// Columns of a symmetric product that are computed together; the entries above its diagonal are wasted work.
pub(super) const TOGETHER: usize = 128;

/// Some rows and columns of a matrix that is kept by columns; `numbers` begins with the first of them.
#[derive(Clone, Copy)]
pub(super) struct Block<'a, R> {
    pub(super) numbers: &'a [R],
    /// Rows of the matrix: numbers between neighbours in a row.
    pub(super) stride: usize,
    pub(super) rows: usize,
    pub(super) columns: usize,
}

impl<'a, R: RealField + Copy> Block<'a, R> {
    /// Without the first rows.
    fn without_rows(self, rows: usize) -> Self {
        Self { numbers: &self.numbers[rows..], rows: self.rows - rows, ..self }
    }

    fn view(self) -> View<'a, R> {
        View::from_slice_with_strides(self.numbers, self.rows, self.columns, 1, self.stride)
    }
}

/// Subtracts the first `columns` columns of `factor` times its transpose from `scale` times `result`, on and below the diagonal. Some
/// entries above the diagonal change, too.
pub(super) fn subtract_square<R: RealField + Copy>(
    result: &mut [R],
    stride: usize,
    scale: R,
    factor: Block<'_, R>,
    columns: usize,
    threads: Threads,
) {
    let block = |(k, result): (usize, &mut [R])| {
        let start = k * TOGETHER;
        subtract_product(
            &mut result[start..],
            stride,
            scale,
            factor.without_rows(start),
            TOGETHER.min(columns - start),
        );
    };
    if columns <= TOGETHER {
        block((0, result));
    } else {
        let end = result.len().min(columns * stride);
        threads.run_each(result[..end].chunks_mut(TOGETHER * stride).enumerate().collect(), block);
    }
}

/// Takes `left` times the transpose of its first `columns` rows from `result`, or from zero.
fn subtract_product<R: RealField + Copy>(
    result: &mut [R],
    stride: usize,
    scale: R,
    left: Block<'_, R>,
    columns: usize,
) {
    let is_small = left.rows <= SMALL || left.columns <= SMALL || columns <= SMALL;
    if !is_small {
        let mut result = ViewMut::from_slice_with_strides_mut(result, left.rows, columns, 1, stride);
        let right = View::from_slice_with_strides(left.numbers, left.columns, columns, left.stride, 1);
        result.gemm(-R::one(), &left.view(), &right, scale);
        return;
    }
    for (column, result) in result.chunks_mut(stride).take(columns).enumerate() {
        if scale.is_zero() {
            result[..left.rows].fill(R::zero());
        }
        for numbers in left.numbers.chunks(left.stride).take(left.columns) {
            subtract_times(&mut result[..left.rows], numbers[column], numbers);
        }
    }
}

/// Takes `factor` times the numbers of `numbers` from `result`.
pub(super) fn subtract_times<R: RealField + Copy>(result: &mut [R], factor: R, numbers: &[R]) {
    for (result, &number) in result.iter_mut().zip(numbers) {
        *result -= factor * number;
    }
}

/// Turns the lower triangle of the first `columns` rows of a panel, and the rows below, into the Cholesky factor; false if that is
/// not positive definite.
pub(super) fn factor_panel<R: RealField + Copy>(
    panel: &mut [R],
    stride: usize,
    rows: usize,
    columns: usize,
    threads: Threads,
) -> bool {
    if columns <= COLUMN_BY_COLUMN {
        return factor_columns(panel, stride, rows, columns);
    }
    let half = columns / 2;
    if !factor_panel(panel, stride, rows, half, threads) {
        return false;
    }
    let (left, right) = panel.split_at_mut(half * stride);
    let left = Block { numbers: &left[half..], stride, rows: rows - half, columns: half };
    subtract_square(&mut right[half..], stride, R::one(), left, columns - half, threads);
    factor_panel(&mut right[half..], stride, rows - half, columns - half, threads)
}

fn factor_columns<R: RealField + Copy>(panel: &mut [R], stride: usize, rows: usize, columns: usize) -> bool {
    for column in 0..columns {
        let (factored, rest) = panel.split_at_mut(column * stride);
        let pivot_column = &mut rest[column..rows];
        for earlier in factored.chunks(stride) {
            subtract_times(pivot_column, earlier[column], &earlier[column..]);
        }
        let pivot = pivot_column[0];
        let is_positive = pivot > R::zero(); // not so if it is not a number
        if !is_positive {
            return false;
        }
        let root = pivot.sqrt();
        pivot_column[0] = root;
        let inverse = R::one() / root;
        pivot_column[1..].iter_mut().for_each(|number| *number *= inverse);
    }
    true
}
