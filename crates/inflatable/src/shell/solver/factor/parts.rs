//! The division of the elimination tree into subtrees that are computed at the same time.
//!
//! The division depends on the matrix alone, so results are the same on any number of threads.

use crate::shell::solver::factor::symbolic::Symbolic;
use crate::shell::solver::factor::tree::NONE;
use std::ops::Range;

/// Operations of a subtree from which on it is divided, and as a divisor of those of the whole tree.
const LEAST: u64 = 4_000_000;
const LEAST_PART: u64 = 16;
/// A subtree is computed beside others if it takes this part of the operations of the one to which it belongs.
const WORTH: u64 = 10;

/// A subtree: supernodes that no other subtree needs until all of them are computed.
#[derive(Debug, Default)]
pub(super) struct Part {
    /// Its supernodes.
    pub(super) nodes: Range<usize>,
    /// Their columns.
    pub(super) columns: Range<usize>,
    /// Their places among the numbers of the factor.
    pub(super) places: Range<usize>,
    /// Smaller subtrees of it, none within another, in rising order.
    pub(super) parts: Vec<Part>,
    /// The supernodes that are in none of those.
    pub(super) own: Vec<usize>,
}

/// Number of operations and of supernodes of each supernode's subtree, and its children.
struct Subtrees {
    work: Vec<u64>,
    sizes: Vec<usize>,
    children: Vec<Vec<usize>>,
}

impl Part {
    /// The whole tree.
    pub(super) fn whole(symbolic: &Symbolic) -> Self {
        let subtrees = Subtrees::new(symbolic);
        let count = symbolic.supernodes.len();
        let all: u64 = subtrees.children[count].iter().map(|root| subtrees.work[*root]).sum();
        subtrees.divide(symbolic, 0..count, subtrees.children[count].clone(), all)
    }
}

impl Subtrees {
    fn new(symbolic: &Symbolic) -> Self {
        let count = symbolic.supernodes.len();
        let mut subtrees = Self {
            work: Vec::with_capacity(count),
            sizes: vec![1; count],
            children: vec![Vec::new(); count + 1],
        };
        for (number, node) in symbolic.supernodes.iter().enumerate() {
            let (width, height) = (node.width() as u64, node.height as u64);
            let below: u64 = subtrees.children[number].iter().map(|child| subtrees.work[*child]).sum();
            subtrees.work.push(below + width * height * height);
            subtrees.sizes[number] +=
                subtrees.children[number].iter().map(|child| subtrees.sizes[*child]).sum::<usize>();
            let parent = symbolic.parent(number);
            subtrees.children[if parent == NONE { count } else { parent }].push(number);
        }
        subtrees
    }

    /// The part of the supernodes `nodes`, those at the top of which are `tops`.
    fn divide(&self, symbolic: &Symbolic, nodes: Range<usize>, mut tops: Vec<usize>, all: u64) -> Part {
        let work: u64 = tops.iter().map(|top| self.work[*top]).sum();
        let mut parts = Vec::new();
        if work > LEAST.max(all / LEAST_PART) {
            loop {
                tops.retain(|top| self.work[*top] > work / WORTH);
                match tops[..] {
                    [only] => tops.clone_from(&self.children[only]),
                    _ => break,
                }
            }
            let part = |&top: &usize| {
                let nodes = top + 1 - self.sizes[top]..top + 1;
                self.divide(symbolic, nodes, self.children[top].clone(), all)
            };
            parts = tops.iter().map(part).collect();
        }
        let own = nodes.clone().filter(|node| !parts.iter().any(|part: &Part| part.nodes.contains(node)));
        let (columns, places) = symbolic.extent(&nodes);
        Part { own: own.collect(), columns, places, nodes, parts }
    }
}
