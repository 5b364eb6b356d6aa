//! Which numbers the Cholesky factor has, and where they lie.

use crate::shell::solver::factor::subtree::Subtree;
use crate::shell::solver::factor::supernode::{Supernode, supernodes};
use crate::shell::solver::factor::tree::{Lists, NONE, Tree};

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
    pub(super) whole: Subtree,
}

impl Symbolic {
    /// Analyses the lower triangle of a matrix.
    pub(super) fn new(lower: &Lists) -> Self {
        let tree = Tree::new(lower);
        let nodes = supernodes(&tree);
        let size = nodes.iter().map(|node| node.width() * node.height).sum();
        let mut owners = vec![0; tree.order.len()];
        for (number, node) in (0..).zip(&nodes) {
            owners[node.first..node.end].fill(number);
        }
        let mut symbolic = Self {
            supernodes: nodes,
            owners,
            below: Lists::default(),
            places: vec![0; lower.items.len()],
            size,
            order: Vec::new(),
            whole: Subtree::default(),
        };
        symbolic.fill(lower, &tree);
        symbolic.order = tree.order;
        let parent = |number| symbolic.below.items(number).first().map_or(NONE, |row| symbolic.owners[*row]);
        let parents: Vec<usize> = (0..symbolic.supernodes.len()).map(parent).collect();
        symbolic.whole = Subtree::whole_tree(&symbolic.supernodes, &parents);
        symbolic
    }

    /// Finds the rows of each supernode, and the places of the matrix in its panel.
    fn fill(&mut self, lower: &Lists, tree: &Tree) {
        self.below.starts.push(0);
        let count = self.supernodes.len();
        // The first child of each supernode, and of each child the next one.
        let (mut first, mut next) = (vec![NONE; count], vec![NONE; count]);
        // In which supernode a row was met last, and where it lies in that one's panel.
        let (mut marked, mut local) = (vec![NONE; tree.order.len()], vec![0; tree.order.len()]);
        for number in 0..count {
            let node = self.supernodes[number];
            let begin = self.below.items.len();
            let mut add = |rows: &mut Vec<usize>, row: usize| {
                if row >= node.end && std::mem::replace(&mut marked[row], number) != number {
                    rows.push(row);
                }
            };
            for &old in &tree.order[node.first..node.end] {
                lower.items(old).iter().for_each(|&row| add(&mut self.below.items, tree.rank[row]));
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
            for (place, &row) in places.iter_mut().zip(lower.items(old)) {
                *place = start + local[tree.rank[row]];
            }
        }
    }
}
