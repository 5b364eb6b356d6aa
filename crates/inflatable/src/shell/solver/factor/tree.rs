//! The elimination tree of a symmetric matrix: which column waits for which.
//!
//! Column `j` of the Cholesky factor changes no column before its **parent**, the row of the first number below its diagonal. (Liu, "The
//! role of elimination trees in sparse factorization", 1990.)

/// In place of a column's number: there is none.
pub(super) const NONE: usize = usize::MAX;

/// Lists of numbers, one after the other.
#[derive(Clone, Debug, Default)]
pub(super) struct Lists {
    /// The start of each in `items`, and the end of the last one.
    pub(super) starts: Vec<usize>,
    pub(super) items: Vec<usize>,
}

impl Lists {
    pub(super) fn items(&self, list: usize) -> &[usize] {
        &self.items[self.starts[list]..self.starts[list + 1]]
    }

    pub(super) fn count(&self) -> usize {
        self.starts.len() - 1
    }

    /// For each number below `count` the lists that have it, in rising order.
    pub(super) fn transposed(&self, count: usize) -> Self {
        let mut starts = vec![0; count + 1];
        for &item in &self.items {
            starts[item + 1] += 1;
        }
        for k in 0..count {
            starts[k + 1] += starts[k];
        }
        let (mut next, mut items) = (starts.clone(), vec![0; self.items.len()]);
        for list in 0..self.count() {
            for &item in self.items(list) {
                let place = &mut next[item];
                items[*place] = list;
                *place += 1;
            }
        }
        Self { starts, items }
    }
}

/// The tree, its columns renumbered so that each comes after all its descendants: in postorder.
#[derive(Debug)]
pub(super) struct Tree {
    /// The old number of each column.
    pub(super) order: Vec<usize>,
    /// The new number of each column.
    pub(super) rank: Vec<usize>,
    /// Parent of each column, by new numbers; [`NONE`] at a root.
    pub(super) parents: Vec<usize>,
    /// Numbers in each column of the factor, its diagonal included, by new numbers.
    pub(super) heights: Vec<usize>,
}

impl Tree {
    /// The tree of a matrix given by its lower triangle, by columns.
    pub(super) fn new(lower: &Lists) -> Self {
        let upper = lower.transposed(lower.count());
        let row_parents = parents(&upper);
        let column_heights = heights(&upper, &row_parents);
        let order = postorder(&row_parents, &column_heights);
        let mut rank = vec![0; order.len()];
        for (new, &old) in (0..).zip(&order) {
            rank[old] = new;
        }
        let old_parents = order.iter().map(|&old| row_parents[old]);
        Self {
            parents: old_parents.map(|parent| if parent == NONE { NONE } else { rank[parent] }).collect(),
            heights: order.iter().map(|&old| column_heights[old]).collect(),
            order,
            rank,
        }
    }
}

fn parents(upper: &Lists) -> Vec<usize> {
    let mut parents = vec![NONE; upper.count()];
    // Some column above each, from which searches go on.
    let mut ancestors = parents.clone();
    for row in 0..upper.count() {
        for &column in upper.items(row) {
            let mut column = column;
            while column != NONE && column < row {
                let next = std::mem::replace(&mut ancestors[column], row);
                if next == NONE {
                    parents[column] = row;
                }
                column = next;
            }
        }
    }
    parents
}

/// A row of the factor has a number in every column between one of the matrix' own and the row's, up the tree.
fn heights(upper: &Lists, parents: &[usize]) -> Vec<usize> {
    let mut heights = vec![1; parents.len()];
    let mut marked = vec![NONE; parents.len()];
    for row in 0..parents.len() {
        marked[row] = row;
        for &column in upper.items(row) {
            let mut column = column;
            while marked[column] != row {
                marked[column] = row;
                heights[column] += 1;
                column = parents[column];
            }
        }
    }
    heights
}

/// Children before their parents; the highest last, since it shares most with its parent.
fn postorder(parents: &[usize], heights: &[usize]) -> Vec<usize> {
    let mut children: Vec<usize> = (0..parents.len()).collect();
    children.sort_by_key(|&column| std::cmp::Reverse(heights[column]));
    // The first child of each column, and of each child the next one: sorted from behind, so the lowest comes first.
    let mut first = vec![NONE; parents.len() + 1];
    let mut next = vec![NONE; parents.len()];
    for child in children {
        let parent = (parents[child]).min(parents.len());
        next[child] = std::mem::replace(&mut first[parent], child);
    }
    let mut order = Vec::with_capacity(parents.len());
    let mut open = Vec::new();
    let mut down = first[parents.len()];
    loop {
        while down != NONE {
            open.push(down);
            down = first[down];
        }
        let Some(column) = open.pop() else { return order };
        order.push(column);
        down = next[column];
    }
}
