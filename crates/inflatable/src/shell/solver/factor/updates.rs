//! What a supernode takes from those before it: dense products, blocks of columns at the same time.

use crate::numerics::Threads;
use crate::shell::solver::factor::dense::{Block, TOGETHER, subtract_square};
use crate::shell::solver::factor::subtree::Subtree;
use crate::shell::solver::factor::supernode::Supernode;
use crate::shell::solver::factor::symbolic::Symbolic;
use nalgebra::RealField;

/// Buffers for updates: the update of one supernode by another, by columns; and rows that follow each other in both, where they begin in the
/// update and in the panel, and how many they are.
pub(super) type Scratch<R> = (Vec<R>, Vec<[usize; 3]>);

/// What a supernode takes from those before it.
pub(super) struct Updates<'a, R> {
    pub(super) symbolic: &'a Symbolic,
    pub(super) part: &'a Subtree,
    /// The part's numbers before the supernode's own.
    pub(super) done: &'a [R],
    pub(super) node: &'a Supernode,
    /// Each that it takes from, and the first row that it needs.
    pub(super) givers: &'a [(usize, usize)],
    /// The index of each row in the panel, from the part's first column on.
    pub(super) local: &'a [u32],
}

impl<R: RealField + Copy> Updates<'_, R> {
    /// Subtracts all updates from the panel, blocks of columns at the same time.
    pub(super) fn subtract(&self, panel: &mut [R], scratch: &mut Scratch<R>, threads: Threads) {
        let height = self.node.height;
        if self.node.width() <= TOGETHER {
            self.subtract_columns(self.node.first, panel, scratch);
            return;
        }
        threads.run_each(panel.chunks_mut(TOGETHER * height).enumerate().collect(), |(k, block)| {
            self.subtract_columns(self.node.first + k * TOGETHER, block, &mut Scratch::default());
        });
    }

    /// Subtracts all updates from the columns from `first` on that `block` has.
    fn subtract_columns(&self, first: usize, block: &mut [R], (update, runs): &mut Scratch<R>) {
        let Self { symbolic, part, done: finished, node, local, .. } = *self;
        let end = first + block.len() / node.height;
        for &(other, from) in self.givers {
            let rows = symbolic.below.items(other);
            let from = from + rows[from..].iter().take_while(|row| **row < first).count();
            let rows_below = &rows[from..];
            let columns = rows_below.iter().take_while(|row| **row < end).count();
            if columns == 0 {
                continue;
            }
            let giver = &symbolic.supernodes[other];
            let panel = &finished[giver.start - part.places.start..][..giver.width() * giver.height];
            let numbers = &panel[giver.width() + from..];
            let product =
                Block { numbers, stride: giver.height, rows: rows_below.len(), columns: giver.width() };
            if update.len() < rows_below.len() * columns {
                update.resize(rows_below.len() * columns, R::zero());
            }
            subtract_square(update, rows_below.len(), R::zero(), product, columns, Threads::One);
            runs.clear();
            for (k, &row) in rows_below.iter().enumerate() {
                let place =
                    if row < node.end { row - node.first } else { local[row - part.columns.start] as usize };
                match runs.last_mut() {
                    Some([_, start, count]) if *start + *count == place => *count += 1,
                    _ => runs.push([k, place, 1]),
                }
            }
            for (update, column) in update.chunks(rows_below.len()).zip(&rows_below[..columns]) {
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
