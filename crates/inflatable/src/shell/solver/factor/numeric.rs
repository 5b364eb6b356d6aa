//! The numbers of the Cholesky factor.

use crate::shell::solver::factor::dense::{Block, TOGETHER, factor_panel, subtract_square};
use crate::shell::solver::factor::parts::Part;
use crate::shell::solver::factor::solution::Solution;
use crate::shell::solver::factor::symbolic::{Supernode, Symbolic};
use crate::shell::solver::factor::tree::{Lists, NONE};
use nalgebra::{RealField, convert};
use rayon::prelude::*;

/// The factor's numbers, panel by panel, each by columns, and the buffers to compute them.
pub(super) struct Numeric<R> {
    pub(super) numbers: Vec<R>,
    waiting: Vec<Waiting>,
    work: Work<R>,
    pub(super) solution: Solution<R>,
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

struct Scratch<R> {
    /// The update of one supernode by another, by columns.
    update: Vec<R>,
    /// Rows that follow each other in both: where they begin in the update and in the panel, and how many they are.
    runs: Vec<[usize; 3]>,
}

impl<R> Default for Scratch<R> {
    fn default() -> Self {
        Self { update: Vec::new(), runs: Vec::new() }
    }
}

impl<R> Work<R> {
    fn new(part: &Part, unknowns: usize) -> Self {
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
            solution: Solution::new(symbolic),
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
        Computation { symbolic, lower, value, part, numbers, waiting, work }.run()
    }

    /// Solves with the factor.
    pub(super) fn solve(&mut self, symbolic: &Symbolic, rhs: &mut [f64]) {
        self.solution.solve(symbolic, &self.numbers, rhs);
    }
}

/// The computation of one part.
struct Computation<'a, R, V> {
    symbolic: &'a Symbolic,
    lower: &'a Lists,
    value: &'a V,
    part: &'a Part,
    /// The part's numbers.
    numbers: &'a mut [R],
    /// For each of its supernodes.
    waiting: &'a mut [Waiting],
    work: &'a mut Work<R>,
}

impl<R: RealField + Copy, V: Fn(usize, usize, usize) -> f64 + Sync> Computation<'_, R, V> {
    /// False if the matrix is not positive definite.
    fn run(mut self) -> bool {
        if !self.parts().into_par_iter().all(Computation::run) {
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
        let node = &self.symbolic.supernodes[number];
        let first_column = self.part.columns.start;
        for (row, place) in self.symbolic.below.of(number).iter().zip((0_u32..).skip(node.width())) {
            self.work.local[*row - first_column] = place;
        }
        let mut givers = std::mem::take(&mut self.work.givers);
        givers.clear();
        let mut other = self.waiting(number).first;
        while other != NONE {
            let Waiting { next, from, .. } = *self.waiting(other);
            let below = &self.symbolic.below.of(other)[from..];
            givers.push((other, from));
            self.wait(other, from + below.iter().take_while(|row| **row < node.end).count());
            other = next;
        }
        let (done, rest) = self.numbers.split_at_mut(node.start - self.part.places.start);
        let panel = &mut rest[..node.width() * node.height];
        let from_givers = FromGivers {
            symbolic: self.symbolic,
            part: self.part,
            done,
            node,
            givers: &givers,
            local: &self.work.local,
        };
        from_givers.subtract(panel, &mut self.work.scratch);
        let is_definite = factor_panel(panel, node.height, node.height, node.width());
        self.work.givers = givers;
        self.wait(number, 0);
        is_definite
    }

    /// The smaller parts, each with its own numbers.
    fn parts(&mut self) -> Vec<Computation<'_, R, V>> {
        let Computation { symbolic, lower, value, part, .. } = *self;
        let (mut numbers, mut place) = (&mut *self.numbers, part.places.start);
        let (mut waiting, mut node) = (&mut *self.waiting, part.nodes.start);
        let mut parts = Vec::with_capacity(part.parts.len());
        for (part, work) in part.parts.iter().zip(&mut self.work.parts) {
            let (own, rest) = numbers[part.places.start - place..].split_at_mut(part.places.len());
            (numbers, place) = (rest, part.places.end);
            let (waiting_own, rest) = waiting[part.nodes.start - node..].split_at_mut(part.nodes.len());
            (waiting, node) = (rest, part.nodes.end);
            parts.push(Computation {
                symbolic,
                lower,
                value,
                part,
                numbers: own,
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
                let from = self.waiting(number).from;
                self.wait(number, from);
            }
        }
    }

    fn waiting(&mut self, number: usize) -> &mut Waiting {
        &mut self.waiting[number - self.part.nodes.start]
    }

    /// Hands a supernode to the owner of its row `from`.
    fn wait(&mut self, number: usize, from: usize) {
        self.waiting(number).from = from;
        let Some(row) = self.symbolic.below.of(number).get(from) else { return };
        let owner = self.symbolic.owners[*row];
        if owner < self.part.nodes.end {
            self.waiting(number).next = std::mem::replace(&mut self.waiting(owner).first, number);
        } else {
            self.work.left.push(number);
        }
    }
}

/// What a supernode takes from those before it.
struct FromGivers<'a, R> {
    symbolic: &'a Symbolic,
    part: &'a Part,
    /// The part's numbers before the supernode's own.
    done: &'a [R],
    node: &'a Supernode,
    /// Each that it takes from, and the first row that it needs.
    givers: &'a [(usize, usize)],
    /// The index of each row in the panel, from the part's first column on.
    local: &'a [u32],
}

impl<R: RealField + Copy> FromGivers<'_, R> {
    /// Subtracts all updates from the panel, blocks of columns at the same time.
    fn subtract(&self, panel: &mut [R], scratch: &mut Scratch<R>) {
        let height = self.node.height;
        if self.node.width() <= TOGETHER {
            self.subtract_columns(self.node.first, panel, scratch);
            return;
        }
        let blocks = panel.par_chunks_mut(TOGETHER * height).enumerate();
        blocks.for_each_init(Scratch::default, |scratch, (k, block)| {
            self.subtract_columns(self.node.first + k * TOGETHER, block, scratch);
        });
    }

    /// Subtracts all updates from the columns from `first` on that `block` has.
    fn subtract_columns(&self, first: usize, block: &mut [R], Scratch { update, runs }: &mut Scratch<R>) {
        let Self { symbolic, part, done, node, local, .. } = *self;
        let end = first + block.len() / node.height;
        for &(other, from) in self.givers {
            let all = symbolic.below.of(other);
            let from = from + all[from..].iter().take_while(|row| **row < first).count();
            let below = &all[from..];
            let columns = below.iter().take_while(|row| **row < end).count();
            if columns == 0 {
                continue;
            }
            let giver = &symbolic.supernodes[other];
            let panel = &done[giver.start - part.places.start..][..giver.width() * giver.height];
            let numbers = &panel[giver.width() + from..];
            let product = Block { numbers, stride: giver.height, rows: below.len(), columns: giver.width() };
            if update.len() < below.len() * columns {
                update.resize(below.len() * columns, R::zero());
            }
            subtract_square(update, below.len(), R::zero(), product, columns);
            runs.clear();
            for (k, &row) in below.iter().enumerate() {
                let place =
                    if row < node.end { row - node.first } else { local[row - part.columns.start] as usize };
                match runs.last_mut() {
                    Some([_, start, count]) if *start + *count == place => *count += 1,
                    _ => runs.push([k, place, 1]),
                }
            }
            for (update, column) in update.chunks(below.len()).zip(&below[..columns]) {
                let panel = &mut block[(column - first) * node.height..][..node.height];
                // Entries above the diagonal are updated too; they are never read.
                for &[from, to, count] in &*runs {
                    for (number, &update) in panel[to..to + count].iter_mut().zip(&update[from..from + count])
                    {
                        *number += update;
                    }
                }
            }
        }
    }
}
