//! **Disjoint sets** of numbers that are united pair by pair.

/// Sets of the numbers from 0 on, each named by its least member.
pub(super) struct DisjointSets {
    /// A member of the same set that is no larger; the least member of a set is its own.
    parent: Vec<usize>,
}

impl DisjointSets {
    /// `count` numbers, each a set of its own.
    pub(super) fn new(count: usize) -> Self {
        Self { parent: (0..count).collect() }
    }

    /// The least member of the set of `number`.
    pub(super) fn least(&mut self, mut number: usize) -> usize {
        while self.parent[number] != number {
            self.parent[number] = self.parent[self.parent[number]];
            number = self.parent[number];
        }
        number
    }

    /// Makes one set of those of `a` and `b`.
    pub(super) fn unite(&mut self, a: usize, b: usize) {
        let (a, b) = (self.least(a), self.least(b));
        self.parent[a.max(b)] = a.min(b);
    }

    /// Whether `a` and `b` are in one set.
    pub(super) fn are_united(&mut self, a: usize, b: usize) -> bool {
        self.least(a) == self.least(b)
    }

    /// The least member of the set of each number.
    pub(super) fn all(&mut self) -> Vec<usize> {
        (0..self.parent.len()).map(|number| self.least(number)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_is_named_by_its_least_member() {
        let mut sets = DisjointSets::new(6);
        for (a, b) in [(4, 2), (5, 4), (1, 3)] {
            sets.unite(a, b);
        }
        assert_eq!(sets.all(), [0, 1, 2, 1, 2, 2]);
        assert!(sets.are_united(5, 2) && !sets.are_united(0, 1));
    }
}
