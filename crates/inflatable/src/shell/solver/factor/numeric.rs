//! The numbers of the Cholesky factor, and solving with them.

use crate::shell::solver::factor::dense::{Block, factor_panel, subtract_square, subtract_times};
use crate::shell::solver::factor::symbolic::{Supernode, Symbolic};
use crate::shell::solver::factor::tree::NONE;
use nalgebra::{RealField, convert, convert_unchecked};

/// The factor's numbers, panel by panel, each by columns, and the buffers to compute them.
pub(super) struct Numeric<R> {
    numbers: Vec<R>,
    /// The update of one supernode by another, by columns.
    update: Vec<R>,
    /// The index of each row in the current panel.
    local: Vec<usize>,
    /// Rows that follow each other in both: where they begin in the update and in the panel, and how many they are.
    runs: Vec<[usize; 3]>,
    /// For each supernode the first that has yet to take from it, of each the next one, and from which of its rows on.
    first: Vec<usize>,
    next: Vec<usize>,
    from: Vec<usize>,
    /// A right side in the order of the tree, and the rows of it that a supernode reads.
    vector: Vec<R>,
    gathered: Vec<R>,
}

impl<R: RealField + Copy> Numeric<R> {
    /// Buffers for a factor; `None` if it is too large for this machine.
    pub(super) fn new(symbolic: &Symbolic) -> Option<Self> {
        let (unknowns, supernodes) = (symbolic.order.len(), symbolic.supernodes.len());
        let mut numbers = Vec::new();
        numbers.try_reserve_exact(symbolic.size).ok()?;
        Some(Self {
            numbers,
            runs: Vec::new(),
            update: Vec::new(),
            local: vec![0; unknowns],
            first: vec![NONE; supernodes],
            next: vec![NONE; supernodes],
            from: vec![0; supernodes],
            vector: vec![R::zero(); unknowns],
            gathered: Vec::new(),
        })
    }

    /// Puts the matrix in the factor's place: its values by columns.
    pub(super) fn load(&mut self, symbolic: &Symbolic, values: impl Iterator<Item = f64>) {
        self.numbers.clear();
        self.numbers.resize(symbolic.size, R::zero());
        for (value, place) in values.zip(&symbolic.places) {
            self.numbers[*place] = convert(value);
        }
    }

    /// Turns the matrix into its factor; false if it is not positive definite.
    pub(super) fn compute(&mut self, symbolic: &Symbolic) -> bool {
        self.first.fill(NONE);
        for (number, node) in symbolic.supernodes.iter().enumerate() {
            for (row, place) in symbolic.below.of(number).iter().zip(node.width()..) {
                self.local[*row] = place;
            }
            let mut other = self.first[number];
            while other != NONE {
                let next = self.next[other];
                let from = self.subtract(symbolic, node, other);
                self.wait(symbolic, other, from);
                other = next;
            }
            let panel = &mut self.numbers[node.start..node.start + node.width() * node.height];
            if !factor_panel(panel, node.height, node.height, node.width()) {
                return false;
            }
            self.wait(symbolic, number, 0);
        }
        true
    }

    /// Hands a supernode to the owner of its row `from`.
    fn wait(&mut self, symbolic: &Symbolic, number: usize, from: usize) {
        self.from[number] = from;
        if let Some(row) = symbolic.below.of(number).get(from) {
            let owner = symbolic.owners[*row];
            self.next[number] = std::mem::replace(&mut self.first[owner], number);
        }
    }

    /// Subtracts the update of supernode `other` from the panel of `node`; returns up to which of its rows.
    fn subtract(&mut self, symbolic: &Symbolic, node: &Supernode, other: usize) -> usize {
        let from = self.from[other];
        let below = &symbolic.below.of(other)[from..];
        let columns = below.iter().take_while(|row| **row < node.end).count();
        let (done, rest) = self.numbers.split_at_mut(node.start);
        let giver = &symbolic.supernodes[other];
        let numbers = &done[giver.start + giver.width() + from..giver.start + giver.width() * giver.height];
        let block = Block { numbers, stride: giver.height, rows: below.len(), columns: giver.width() };
        if self.update.len() < below.len() * columns {
            self.update.resize(below.len() * columns, R::zero());
        }
        subtract_square(&mut self.update, below.len(), R::zero(), block, columns);
        self.runs.clear();
        for (k, &row) in below.iter().enumerate() {
            let place = if row < node.end { row - node.first } else { self.local[row] };
            match self.runs.last_mut() {
                Some([_, start, count]) if *start + *count == place => *count += 1,
                _ => self.runs.push([k, place, 1]),
            }
        }
        for (update, column) in self.update.chunks(below.len()).zip(&below[..columns]) {
            let panel = &mut rest[(column - node.first) * node.height..][..node.height];
            // Entries above the diagonal are updated too; they are never read.
            for &[from, to, count] in &self.runs {
                for (number, &update) in panel[to..to + count].iter_mut().zip(&update[from..from + count]) {
                    *number += update;
                }
            }
        }
        from + columns
    }

    /// Solves with the factor.
    pub(super) fn solve(&mut self, symbolic: &Symbolic, rhs: &mut [f64]) {
        for (number, old) in self.vector.iter_mut().zip(&symbolic.order) {
            *number = convert(rhs[*old]);
        }
        self.solve_forwards(symbolic);
        self.solve_backwards(symbolic);
        for (number, old) in self.vector.iter().zip(&symbolic.order) {
            rhs[*old] = convert_unchecked(*number);
        }
    }

    fn solve_forwards(&mut self, symbolic: &Symbolic) {
        let Self { numbers, vector, gathered, .. } = self;
        for (number, node) in symbolic.supernodes.iter().enumerate() {
            let below = symbolic.below.of(number);
            let (width, own) = (node.width(), &mut vector[node.first..node.end]);
            gathered.clear();
            gathered.resize(below.len(), R::zero());
            for (k, column) in numbers[node.start..].chunks(node.height).take(width).enumerate() {
                own[k] /= column[k];
                let x = own[k];
                subtract_times(&mut own[k + 1..], x, &column[k + 1..width]);
                subtract_times(gathered, x, &column[width..]);
            }
            for (row, &number) in below.iter().zip(&*gathered) {
                vector[*row] += number;
            }
        }
    }

    fn solve_backwards(&mut self, symbolic: &Symbolic) {
        let Self { numbers, vector, gathered, .. } = self;
        for (number, node) in symbolic.supernodes.iter().enumerate().rev() {
            gathered.clear();
            gathered.extend(symbolic.below.of(number).iter().map(|row| vector[*row]));
            let (width, own) = (node.width(), &mut vector[node.first..node.end]);
            for k in (0..width).rev() {
                let column = &numbers[node.start + k * node.height..][..node.height];
                let others = dot(&column[k + 1..width], &own[k + 1..]) + dot(&column[width..], gathered);
                own[k] = (own[k] - others) / column[k];
            }
        }
    }
}

/// In four sums, which a processor adds at once.
fn dot<R: RealField + Copy>(a: &[R], b: &[R]) -> R {
    let (quads, others) = (a.chunks_exact(4).zip(b.chunks_exact(4)), a.len() / 4 * 4);
    let mut sums = [R::zero(); 4];
    for (a, b) in quads {
        for k in 0..4 {
            sums[k] += a[k] * b[k];
        }
    }
    let rest = a[others..].iter().zip(&b[others..]).map(|(&a, &b)| a * b);
    sums.into_iter().chain(rest).fold(R::zero(), |sum, x| sum + x)
}
