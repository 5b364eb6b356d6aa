//! Which numbers the Cholesky factor has: columns with the same rows below them are kept together, as **supernodes**.

use crate::shell::solver::factor::parts::Part;
use crate::shell::solver::factor::tree::{Lists, NONE, Tree};
use std::ops::Range;

/// Consecutive columns with the same rows below.
#[derive(Clone, Copy, Debug)]
pub(super) struct Supernode {
    /// Its first column.
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

    /// Numbers on and below the diagonal.
    fn numbers(&self) -> usize {
        let width = self.width();
        width * self.height - width * (width - 1) / 2
    }

    /// This one and the one before it as one; `None` if too many zeros come with that.
    fn with(&self, before: &Self) -> Option<Self> {
        let mut both = Self { first: before.first, height: before.width() + self.height, ..*self };
        let filled = before.numbers() - before.zeros + self.numbers() - self.zeros;
        both.zeros = both.numbers() - filled;
        let (_, most) = *ZEROS.iter().find(|(width, _)| both.width() <= *width)?;
        (100 * both.zeros <= most * both.numbers()).then_some(both)
    }
}

/// The supernodes of a tree.
fn supernodes(tree: &Tree) -> Vec<Supernode> {
    let mut found: Vec<Supernode> = Vec::new();
    let mut first = 0;
    for end in 1..=tree.order.len() {
        let last = end - 1;
        let goes_on = tree.parents[last] == end && tree.heights[last] == tree.heights[end] + 1;
        if goes_on {
            continue;
        }
        let height = tree.heights[first];
        let mut node = Supernode { first, end, height, zeros: 0, start: 0 };
        while let Some(before) = found.last().filter(|before| (tree.parents[before.end - 1]) < end) {
            let Some(both) = node.with(before) else { break };
            let _ = found.pop();
            node = both;
        }
        found.push(node);
        first = end;
    }
    let mut start = 0;
    for node in &mut found {
        node.start = start;
        start += node.width() * node.height;
    }
    found
}

/// All about the factor of a matrix but its numbers.
#[derive(Debug)]
pub(super) struct Symbolic {
    /// The old number of each column.
    pub(super) order: Vec<usize>,
    pub(super) supernodes: Vec<Supernode>,
    /// The supernode of each column.
    pub(super) owners: Vec<usize>,
    /// The rows below each supernode's own.
    pub(super) below: Lists,
    /// The place of each number of the matrix among those of the factor.
    pub(super) places: Vec<usize>,
    /// Numbers kept of the factor.
    pub(super) size: usize,
    /// All supernodes, divided into what is computed at the same time.
    pub(super) whole: Part,
}

impl Symbolic {
    /// Analyses the lower triangle of a matrix.
    pub(super) fn new(lower: &Lists) -> Self {
        let tree = Tree::new(lower);
        let supernodes = supernodes(&tree);
        let size = supernodes.iter().map(|node| node.width() * node.height).sum();
        let mut owners = vec![0; tree.order.len()];
        for (number, node) in (0..).zip(&supernodes) {
            owners[node.first..node.end].fill(number);
        }
        let mut symbolic = Self {
            supernodes,
            owners,
            below: Lists::default(),
            places: vec![0; lower.items.len()],
            size,
            order: Vec::new(),
            whole: Part::default(),
        };
        symbolic.fill(lower, &tree);
        symbolic.order = tree.order;
        symbolic.whole = Part::whole(&symbolic);
        symbolic
    }

    /// The supernode that waits for supernode `number` first; [`NONE`] at a root.
    pub(super) fn parent(&self, number: usize) -> usize {
        self.below.of(number).first().map_or(NONE, |row| self.owners[*row])
    }

    /// The columns of consecutive supernodes, and their places among the numbers of the factor.
    pub(super) fn extent(&self, nodes: &Range<usize>) -> (Range<usize>, Range<usize>) {
        let begin = |number: usize| {
            let node = self.supernodes.get(number);
            node.map_or((self.owners.len(), self.size), |node| (node.first, node.start))
        };
        let (from, to) = (begin(nodes.start), begin(nodes.end));
        (from.0..to.0, from.1..to.1)
    }

    /// Finds the rows of each supernode, and the places of the matrix in its panel.
    fn fill(&mut self, lower: &Lists, tree: &Tree) {
        self.below.starts.push(0);
        let count = self.supernodes.len();
        // The first child of each supernode, and of each child the next one.
        let (mut first, mut next) = (vec![NONE; count], vec![NONE; count]);
        // In which supernode a row was met last, and where it lies in that one's panel.
        let (mut met, mut local) = (vec![NONE; tree.order.len()], vec![0; tree.order.len()]);
        for number in 0..count {
            let node = self.supernodes[number];
            let begin = self.below.items.len();
            let mut add = |rows: &mut Vec<usize>, row: usize| {
                if row >= node.end && std::mem::replace(&mut met[row], number) != number {
                    rows.push(row);
                }
            };
            for &old in &tree.order[node.first..node.end] {
                lower.of(old).iter().for_each(|&row| add(&mut self.below.items, tree.rank[row]));
            }
            let mut child = first[number];
            while child != NONE {
                for k in self.below.starts[child]..self.below.starts[child + 1] {
                    let row = self.below.items[k];
                    add(&mut self.below.items, row);
                }
                child = next[child];
            }
            let rows = &mut self.below.items[begin..];
            rows.sort_unstable();
            for (row, place) in (node.first..node.end).chain(rows.iter().copied()).zip(0..) {
                local[row] = place;
            }
            if let Some(&row) = rows.first() {
                next[number] = std::mem::replace(&mut first[self.owners[row]], number);
            }
            self.below.starts.push(self.below.items.len());
            self.place(&node, lower, tree, &local);
        }
    }

    /// Finds the places of a supernode's columns of the matrix, where `local` gives the row of its panel for each row.
    fn place(&mut self, node: &Supernode, lower: &Lists, tree: &Tree, local: &[usize]) {
        for (column, &old) in tree.order[node.first..node.end].iter().enumerate() {
            let start = node.start + column * node.height;
            let places = &mut self.places[lower.starts[old]..lower.starts[old + 1]];
            for (place, &row) in places.iter_mut().zip(lower.of(old)) {
                *place = start + local[tree.rank[row]];
            }
        }
    }
}
