//! The division of the elimination tree into subtrees that are computed at the same time.
//!
//! The division depends on the matrix alone, so results are the same on any number of threads.

use crate::shell::solver::factor::supernode::Supernode;
use crate::shell::solver::factor::tree::NONE;
use std::ops::Range;

/// Operations of a subtree from which on it is divided, and as a divisor of those of the whole tree.
const LEAST: u64 = 4_000_000;
const LEAST_PART: u64 = 16;
/// A subtree is computed beside others if it takes this part of the operations of the one to which it belongs.
const WORTH: u64 = 10;

/// A subtree: supernodes that no other subtree needs until all of them are computed.
#[derive(Debug, Default)]
pub(super) struct Subtree {
    /// Supernodes of the subtree.
    pub(super) nodes: Range<usize>,
    /// Their columns.
    pub(super) columns: Range<usize>,
    /// Their places among the numbers of the factor.
    pub(super) places: Range<usize>,
    /// Smaller subtrees of it, none within another, in rising order.
    pub(super) parts: Vec<Subtree>,
    /// The supernodes that are in none of those.
    pub(super) own: Vec<usize>,
}

/// Number of operations and of supernodes of each supernode's subtree, and its children.
struct TreeWork {
    work: Vec<u64>,
    sizes: Vec<usize>,
    children: Vec<Vec<usize>>,
}

impl Subtree {
    /// The whole tree.
    pub(super) fn whole_tree(supernodes: &[Supernode], parents: &[usize]) -> Self {
        let tree = TreeWork::new(supernodes, parents);
        let count = supernodes.len();
        let total_work: u64 = tree.children[count].iter().map(|root| tree.work[*root]).sum();
        tree.divide(supernodes, 0..count, tree.children[count].clone(), total_work)
    }
}

impl TreeWork {
    fn new(supernodes: &[Supernode], parents: &[usize]) -> Self {
        let count = supernodes.len();
        let mut tree = Self {
            work: Vec::with_capacity(count),
            sizes: vec![1; count],
            children: vec![Vec::new(); count + 1],
        };
        for (number, (node, &parent)) in supernodes.iter().zip(parents).enumerate() {
            let (width, height) = (node.width() as u64, node.height as u64);
            let work_below: u64 = tree.children[number].iter().map(|child| tree.work[*child]).sum();
            tree.work.push(work_below + width * height * height);
            tree.sizes[number] += tree.children[number].iter().map(|child| tree.sizes[*child]).sum::<usize>();
            tree.children[if parent == NONE { count } else { parent }].push(number);
        }
        tree
    }

    /// The part of the supernodes `nodes`, those at the top of which are `tops`.
    fn divide(
        &self,
        supernodes: &[Supernode],
        nodes: Range<usize>,
        mut tops: Vec<usize>,
        total_work: u64,
    ) -> Subtree {
        // Work above a part of the whole is divided between the subtrees of its tops. A top that does nearly all of
        // the work alone is replaced by its children. What belongs to no part is the section's own work, after its
        // parts.
        let work: u64 = tops.iter().map(|top| self.work[*top]).sum();
        let mut parts = Vec::new();
        if work > LEAST.max(total_work / LEAST_PART) {
            loop {
                tops.retain(|top| self.work[*top] > work / WORTH);
                match tops[..] {
                    [only] => tops.clone_from(&self.children[only]),
                    _ => break,
                }
            }
            let part = |&top: &usize| {
                let nodes = top + 1 - self.sizes[top]..top + 1;
                self.divide(supernodes, nodes, self.children[top].clone(), total_work)
            };
            parts = tops.iter().map(part).collect();
        }
        let rest = nodes.clone().filter(|node| !parts.iter().any(|part: &Subtree| part.nodes.contains(node)));
        let rest = rest.collect();
        let Some((first, last)) = supernodes[nodes.clone()].first().zip(supernodes[nodes.clone()].last())
        else {
            return Subtree::default();
        };
        Subtree {
            columns: first.first..last.end,
            places: first.start..last.panel_end(),
            own: rest,
            nodes,
            parts,
        }
    }
}
