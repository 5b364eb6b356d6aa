//! Columns with the same rows below them, which are kept together as **supernodes**.

use crate::shell::solver::factor::tree::Tree;

/// Consecutive columns with the same rows below.
#[derive(Clone, Copy, Debug)]
pub(super) struct Supernode {
    /// First column of the supernode.
    pub(super) first: usize,
    /// The column after its last.
    pub(super) end: usize,
    /// Rows of its panel: its own and those below.
    pub(super) height: usize,
    /// Numbers of its panel that are always zero.
    zeros: usize,
    /// The start of its panel among the numbers of the factor.
    pub(super) start: usize,
}

/// Up to so many columns two supernodes become one if at most so many percent of its numbers are always zero: few large panels are
/// computed faster than many small ones.
const ZEROS: [(usize, usize); 4] = [(4, 100), (16, 80), (48, 10), (usize::MAX, 5)];

impl Supernode {
    pub(super) fn width(&self) -> usize {
        self.end - self.first
    }

    /// The place after its panel.
    pub(super) fn panel_end(&self) -> usize {
        self.start + self.width() * self.height
    }

    /// Numbers on and below the diagonal.
    fn numbers(&self) -> usize {
        let width = self.width();
        width * self.height - width * (width - 1) / 2
    }

    /// This one and the one before it as one; `None` if too many zeros come with that.
    fn joined(&self, previous: &Self) -> Option<Self> {
        let mut joined = Self { first: previous.first, height: previous.width() + self.height, ..*self };
        let filled = previous.numbers() - previous.zeros + self.numbers() - self.zeros;
        joined.zeros = joined.numbers() - filled;
        let (_, allowed_zeros) = *ZEROS.iter().find(|(width, _)| joined.width() <= *width)?;
        (100 * joined.zeros <= allowed_zeros * joined.numbers()).then_some(joined)
    }
}

/// The supernodes of a tree.
pub(super) fn supernodes(tree: &Tree) -> Vec<Supernode> {
    let mut supernodes: Vec<Supernode> = Vec::new();
    let mut first = 0;
    for end in 1..=tree.order.len() {
        let last = end - 1;
        let goes_on = tree.parents[last] == end && tree.heights[last] == tree.heights[end] + 1;
        if goes_on {
            continue;
        }
        let height = tree.heights[first];
        let mut node = Supernode { first, end, height, zeros: 0, start: 0 };
        while let Some(previous) = supernodes.last().filter(|before| (tree.parents[before.end - 1]) < end) {
            let Some(merged) = node.joined(previous) else { break };
            let _ = supernodes.pop();
            node = merged;
        }
        supernodes.push(node);
        first = end;
    }
    let mut start = 0;
    for node in &mut supernodes {
        node.start = start;
        start += node.width() * node.height;
    }
    supernodes
}
