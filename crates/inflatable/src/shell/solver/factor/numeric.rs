//! The numbers of the Cholesky factor.

use crate::numerics::Threads;
use crate::shell::solver::factor::dense::factor_panel;
use crate::shell::solver::factor::subtree::Subtree;
use crate::shell::solver::factor::symbolic::Symbolic;
use crate::shell::solver::factor::tree::{Lists, NONE};
use crate::shell::solver::factor::triangular::TriangularSolve;
use crate::shell::solver::factor::updates::{Scratch, Updates};
use nalgebra::{RealField, convert};

/// The factor's numbers, panel by panel, each by columns, and the buffers to compute them.
pub(super) struct Numeric<R> {
    numbers: Vec<R>,
    waiting: Vec<Waiting>,
    work: Work<R>,
    solution: TriangularSolve<R>,
}

/// A supernode on its way through those that take from it.
#[derive(Clone, Copy)]
struct Waiting {
    /// The first supernode that this one has yet to take from.
    first: usize,
    /// The next one of the same taker.
    next: usize,
    /// The first row that the next taker needs.
    from: usize,
}

/// The buffers of one part.
struct Work<R> {
    scratch: Scratch<R>,
    /// The index of each row in the current panel, from the part's first column on.
    local: Vec<u32>,
    givers: Vec<(usize, usize)>,
    /// Supernodes that a later one outside of the part takes from.
    left: Vec<usize>,
    parts: Vec<Work<R>>,
}

impl<R> Work<R> {
    fn new(part: &Subtree, unknowns: usize) -> Self {
        Self {
            scratch: Scratch::default(),
            local: vec![0; unknowns - part.columns.start],
            givers: Vec::new(),
            left: Vec::new(),
            parts: part.parts.iter().map(|part| Self::new(part, unknowns)).collect(),
        }
    }
}

impl<R: RealField + Copy> Numeric<R> {
    /// Buffers for a factor; `None` if it is too large for this machine.
    pub(super) fn new(symbolic: &Symbolic) -> Option<Self> {
        let unknowns = symbolic.order.len();
        let mut numbers = Vec::new();
        numbers.try_reserve_exact(symbolic.size).ok()?;
        Some(Self {
            numbers,
            waiting: vec![Waiting { first: NONE, next: NONE, from: 0 }; symbolic.supernodes.len()],
            work: Work::new(&symbolic.whole, unknowns),
            solution: TriangularSolve::new(symbolic),
        })
    }

    /// Computes the factor of the matrix with the entries `value(place, row, column)` in the columns of `lower`; false if it is not positive
    /// definite.
    pub(super) fn compute(
        &mut self,
        symbolic: &Symbolic,
        lower: &Lists,
        value: &(impl Fn(usize, usize, usize) -> f64 + Sync),
    ) -> bool {
        self.numbers.resize(symbolic.size, R::zero());
        self.waiting.iter_mut().for_each(|waiting| waiting.first = NONE);
        let part = &symbolic.whole;
        let Self { numbers, waiting, work, .. } = self;
        Computation { threads: Threads::available(), symbolic, lower, value, part, numbers, waiting, work }
            .run()
    }

    /// Solves with the factor.
    pub(super) fn solve(&mut self, symbolic: &Symbolic, rhs: &mut [f64]) {
        self.solution.solve(symbolic, &self.numbers, rhs);
    }
}

/// The computation of one part.
struct Computation<'a, R, V> {
    threads: Threads,
    symbolic: &'a Symbolic,
    lower: &'a Lists,
    value: &'a V,
    part: &'a Subtree,
    /// The part's numbers.
    numbers: &'a mut [R],
    /// For each of its supernodes.
    waiting: &'a mut [Waiting],
    work: &'a mut Work<R>,
}

impl<R: RealField + Copy, V: Fn(usize, usize, usize) -> f64 + Sync> Computation<'_, R, V> {
    /// False if the matrix is not positive definite.
    fn run(mut self) -> bool {
        if !self.threads.run_while_true(self.parts(), Computation::run) {
            return false;
        }
        self.collect();
        for &number in &self.part.own {
            self.load(number);
            if !self.factor(number) {
                return false;
            }
        }
        true
    }

    /// Puts a supernode's columns of the matrix in its panel.
    fn load(&mut self, number: usize) {
        let Self { symbolic, lower, value, part, numbers, .. } = self;
        let node = &symbolic.supernodes[number];
        let panel = &mut numbers[node.start - part.places.start..][..node.width() * node.height];
        panel.fill(R::zero());
        for &column in &symbolic.order[node.first..node.end] {
            for place in lower.starts[column]..lower.starts[column + 1] {
                let number = value(place, lower.items[place], column);
                panel[symbolic.places[place] - node.start] = convert(number);
            }
        }
    }

    /// Subtracts from a panel what the supernodes before it add, and factors it.
    fn factor(&mut self, number: usize) -> bool {
        // Supernodes that still have rows in this panel wait for it in a linked list. Each is collected, and then
        // waits for the panel of its next row. Their products are subtracted, and the panel is factored alone.
        let node = &self.symbolic.supernodes[number];
        let first_column = self.part.columns.start;
        for (row, place) in self.symbolic.below.items(number).iter().zip((0_u32..).skip(node.width())) {
            self.work.local[*row - first_column] = place;
        }
        let mut givers = std::mem::take(&mut self.work.givers);
        givers.clear();
        let mut other = self.waiting(number).first;
        while other != NONE {
            let Waiting { next, from: first_row, .. } = *self.waiting(other);
            let rows = &self.symbolic.below.items(other)[first_row..];
            givers.push((other, first_row));
            self.wait(other, first_row + rows.iter().take_while(|row| **row < node.end).count());
            other = next;
        }
        let (finished, rest) = self.numbers.split_at_mut(node.start - self.part.places.start);
        let panel = &mut rest[..node.width() * node.height];
        let updates = Updates {
            symbolic: self.symbolic,
            part: self.part,
            done: finished,
            node,
            givers: &givers,
            local: &self.work.local,
        };
        updates.subtract(panel, &mut self.work.scratch, self.threads);
        let is_definite = factor_panel(panel, node.height, node.height, node.width(), self.threads);
        self.work.givers = givers;
        self.wait(number, 0);
        is_definite
    }

    /// The smaller parts, each with its own numbers.
    fn parts(&mut self) -> Vec<Computation<'_, R, V>> {
        let Computation { threads, symbolic, lower, value, part, .. } = *self;
        let (mut numbers, mut place) = (&mut *self.numbers, part.places.start);
        let (mut waiting, mut node) = (&mut *self.waiting, part.nodes.start);
        let mut parts = Vec::with_capacity(part.parts.len());
        for (part, work) in part.parts.iter().zip(&mut self.work.parts) {
            let (part_numbers, rest) = numbers[part.places.start - place..].split_at_mut(part.places.len());
            (numbers, place) = (rest, part.places.end);
            let (waiting_own, rest) = waiting[part.nodes.start - node..].split_at_mut(part.nodes.len());
            (waiting, node) = (rest, part.nodes.end);
            parts.push(Computation {
                threads,
                symbolic,
                lower,
                value,
                part,
                numbers: part_numbers,
                waiting: waiting_own,
                work,
            });
        }
        parts
    }

    /// Hands on the supernodes that the smaller parts left.
    fn collect(&mut self) {
        self.work.left.clear();
        for k in 0..self.work.parts.len() {
            for number in std::mem::take(&mut self.work.parts[k].left) {
                let first_row = self.waiting(number).from;
                self.wait(number, first_row);
            }
        }
    }

    fn waiting(&mut self, number: usize) -> &mut Waiting {
        &mut self.waiting[number - self.part.nodes.start]
    }

    /// Hands a supernode to the owner of its row `first_row`.
    fn wait(&mut self, number: usize, first_row: usize) {
        self.waiting(number).from = first_row;
        let Some(row) = self.symbolic.below.items(number).get(first_row) else { return };
        let owner = self.symbolic.owners[*row];
        if owner < self.part.nodes.end {
            self.waiting(number).next = std::mem::replace(&mut self.waiting(owner).first, number);
        } else {
            self.work.left.push(number);
        }
    }
}
