//! Solving with the numbers of the Cholesky factor.

use crate::numerics::Threads;
use crate::shell::solver::factor::dense::subtract_times;
use crate::shell::solver::factor::subtree::Subtree;
use crate::shell::solver::factor::symbolic::Symbolic;
use nalgebra::{RealField, convert, convert_unchecked};

/// A right side that becomes its solution, in the order of the tree, and buffers.
pub(super) struct TriangularSolve<R> {
    vector: Vec<R>,
    beyond: RowsBeyond<R>,
}

/// The buffers of one part.
struct RowsBeyond<R> {
    /// For each row after those of the part: in the first half of a solution what the part adds to it, in the second half its value.
    rows: Vec<R>,
    /// The rows that a supernode reads or changes.
    gathered: Vec<R>,
    parts: Vec<RowsBeyond<R>>,
}

impl<R: RealField + Copy> RowsBeyond<R> {
    fn new(part: &Subtree, unknowns: usize) -> Self {
        Self {
            rows: vec![R::zero(); unknowns - part.columns.end],
            gathered: Vec::new(),
            parts: part.parts.iter().map(|part| Self::new(part, unknowns)).collect(),
        }
    }
}

impl<R: RealField + Copy> TriangularSolve<R> {
    pub(super) fn new(symbolic: &Symbolic) -> Self {
        let unknowns = symbolic.order.len();
        Self { vector: vec![R::zero(); unknowns], beyond: RowsBeyond::new(&symbolic.whole, unknowns) }
    }

    /// Replaces the right side by the solution.
    pub(super) fn solve(&mut self, symbolic: &Symbolic, numbers: &[R], rhs: &mut [f64]) {
        for (number, old) in self.vector.iter_mut().zip(&symbolic.order) {
            *number = convert(rhs[*old]);
        }
        let Self { vector, beyond: rest } = self;
        let (threads, part) = (Threads::available(), &symbolic.whole);
        Section { threads, symbolic, numbers, part, vector, beyond: rest }.solve_forwards();
        Section { threads, symbolic, numbers, part, vector, beyond: rest }.solve_backwards();
        for (number, old) in self.vector.iter().zip(&symbolic.order) {
            rhs[*old] = convert_unchecked(*number);
        }
    }
}

/// The rows of one part.
struct Section<'a, R> {
    threads: Threads,
    symbolic: &'a Symbolic,
    numbers: &'a [R],
    part: &'a Subtree,
    vector: &'a mut [R],
    beyond: &'a mut RowsBeyond<R>,
}

impl<R: RealField + Copy> Section<'_, R> {
    fn solve_forwards(mut self) {
        // The parts are solved side by side, each with rows of its own for what it adds beyond itself. Those rows are
        // added up afterwards, in a fixed order. Then the section's own supernodes follow one by one.
        for (part, beyond) in self.part.parts.iter().zip(&mut self.beyond.parts) {
            for row in rows_beyond(self.symbolic, part) {
                beyond.rows[row - part.columns.end] = R::zero();
            }
        }
        self.threads.run_each(self.parts(), Section::solve_forwards);
        for (k, part) in self.part.parts.iter().enumerate() {
            for &row in rows_beyond(self.symbolic, part) {
                let added = self.beyond.parts[k].rows[row - part.columns.end];
                *self.row(row) += added;
            }
        }
        let first_column = self.part.columns.start;
        for &number in &self.part.own {
            let (node, rows) = (&self.symbolic.supernodes[number], self.symbolic.below.items(number));
            let (width, entries) =
                (node.width(), &mut self.vector[node.first - first_column..node.end - first_column]);
            let gathered = &mut self.beyond.gathered;
            gathered.clear();
            gathered.resize(rows.len(), R::zero());
            for (k, column) in self.numbers[node.start..].chunks(node.height).take(width).enumerate() {
                entries[k] /= column[k];
                let x = entries[k];
                subtract_times(&mut entries[k + 1..], x, &column[k + 1..width]);
                subtract_times(gathered, x, &column[width..]);
            }
            for (k, &row) in rows.iter().enumerate() {
                let added = self.beyond.gathered[k];
                *self.row(row) += added;
            }
        }
    }

    fn solve_backwards(mut self) {
        let first_column = self.part.columns.start;
        for &number in self.part.own.iter().rev() {
            let (node, rows) = (&self.symbolic.supernodes[number], self.symbolic.below.items(number));
            let mut gathered = std::mem::take(&mut self.beyond.gathered);
            gathered.clear();
            gathered.extend(rows.iter().map(|row| *self.row(*row)));
            let (width, entries) =
                (node.width(), &mut self.vector[node.first - first_column..node.end - first_column]);
            for k in (0..width).rev() {
                let column = &self.numbers[node.start + k * node.height..][..node.height];
                let product =
                    dot(&column[k + 1..width], &entries[k + 1..]) + dot(&column[width..], &gathered);
                entries[k] = (entries[k] - product) / column[k];
            }
            self.beyond.gathered = gathered;
        }
        for (k, part) in self.part.parts.iter().enumerate() {
            for &row in rows_beyond(self.symbolic, part) {
                self.beyond.parts[k].rows[row - part.columns.end] = *self.row(row);
            }
        }
        self.threads.run_each(self.parts(), Section::solve_backwards);
    }

    /// The smaller parts, each with its own rows.
    fn parts(&mut self) -> Vec<Section<'_, R>> {
        let Section { threads, symbolic, numbers, part, .. } = *self;
        let (mut vector, mut column) = (&mut *self.vector, part.columns.start);
        let mut sections = Vec::with_capacity(part.parts.len());
        for (part, beyond) in part.parts.iter().zip(&mut self.beyond.parts) {
            let (part_vector, rest) = vector[part.columns.start - column..].split_at_mut(part.columns.len());
            (vector, column) = (rest, part.columns.end);
            sections.push(Section { threads, symbolic, numbers, part, vector: part_vector, beyond });
        }
        sections
    }

    /// A row of the part or after it.
    fn row(&mut self, row: usize) -> &mut R {
        let columns = &self.part.columns;
        if row < columns.end {
            &mut self.vector[row - columns.start]
        } else {
            &mut self.beyond.rows[row - columns.end]
        }
    }
}

/// The rows after those of a part that its supernodes change and read.
fn rows_beyond<'a>(symbolic: &'a Symbolic, part: &Subtree) -> &'a [usize] {
    symbolic.below.items(part.nodes.end - 1)
}

/// In four sums, which a processor adds at once.
fn dot<R: RealField + Copy>(a: &[R], b: &[R]) -> R {
    let (quads, remainder) = (a.chunks_exact(4).zip(b.chunks_exact(4)), a.len() / 4 * 4);
    let mut sums = [R::zero(); 4];
    for (a, b) in quads {
        for k in 0..4 {
            sums[k] += a[k] * b[k];
        }
    }
    let rest = a[remainder..].iter().zip(&b[remainder..]).map(|(&a, &b)| a * b);
    sums.into_iter().chain(rest).fold(R::zero(), |sum, x| sum + x)
}
