//! The fewest nodes that part one set of nodes from another, by König's theorem: as many as a largest matching of the
//! couplings across has pairs.

/// Which nodes are coupled.
pub(super) struct Couplings {
    /// Neighbours of node `i`: `neighbours[starts[i]..starts[i + 1]]`, in order.
    starts: Vec<usize>,
    neighbours: Vec<usize>,
}

impl Couplings {
    /// The couplings of `count` nodes, of which all in one group are coupled.
    pub(super) fn new(count: usize, groups: impl Iterator<Item = Vec<usize>>) -> Self {
        let mut pairs: Vec<(usize, usize)> = Vec::new();
        for group in groups {
            let pairs_with = |&a: &usize| group.iter().map(move |&b| (a, b)).filter(|(a, b)| a != b);
            pairs.extend(group.iter().flat_map(pairs_with));
        }
        pairs.sort_unstable();
        pairs.dedup();
        let starts = (0..=count).map(|node| pairs.partition_point(|pair| pair.0 < node)).collect();
        Self { starts, neighbours: pairs.into_iter().map(|pair| pair.1).collect() }
    }

    fn neighbours(&self, node: usize) -> &[usize] {
        &self.neighbours[self.starts[node]..self.starts[node + 1]]
    }
}

/// Finds separators, one after another, in the same buffers.
pub(super) struct Separators {
    couplings: Couplings,
    /// Whether a node is in the second set; none is between two calls.
    in_second: Vec<bool>,
    /// The node to which a node is matched.
    partner: Vec<Option<usize>>,
    /// The last search that reached a node of the second set, and the node from which it was reached.
    reached: Vec<(usize, usize)>,
    searches: usize,
}

impl Separators {
    pub(super) fn new(couplings: Couplings) -> Self {
        let count = couplings.starts.len() - 1;
        let (in_second, partner, queue) = (vec![false; count], vec![None; count], vec![(0, 0); count]);
        Self { couplings, in_second, partner, reached: queue, searches: 0 }
    }

    /// The fewest nodes without which no node of `first` is coupled to one of `second`, sorted.
    pub(super) fn separator(&mut self, first: &[usize], second: &[usize]) -> Vec<usize> {
        for &node in second {
            self.in_second[node] = true;
        }
        let touches =
            |node: &usize| self.couplings.neighbours(*node).iter().any(|&other| self.in_second[other]);
        let rim: Vec<usize> = first.iter().copied().filter(touches).collect();
        for &node in &rim {
            self.match_up(node);
        }
        let cover = self.cover(&rim);
        for &node in second {
            self.in_second[node] = false;
            self.partner[node] = None;
        }
        for node in rim {
            self.partner[node] = None;
        }
        cover
    }

    /// Finds a partner for `node`, giving others new ones where needed, if that can be done.
    fn match_up(&mut self, node: usize) {
        self.searches += 1;
        let mut open = vec![node];
        let mut index = 0;
        while index < open.len() {
            let from = open[index];
            index += 1;
            for &to in self.couplings.neighbours(from) {
                if !self.in_second[to] || self.reached[to].0 == self.searches {
                    continue;
                }
                self.reached[to] = (self.searches, from);
                let Some(next) = self.partner[to] else {
                    self.flip(to);
                    return;
                };
                open.push(next);
            }
        }
    }

    /// Matches anew along the path by which the last search reached `to`.
    fn flip(&mut self, to: usize) {
        let mut next = Some(to);
        while let Some(to) = next {
            let from = self.reached[to].1;
            self.partner[to] = Some(from);
            next = self.partner[from].replace(to);
        }
    }

    /// The nodes of the first set that no alternating path from an unmatched node reaches, and those of the second that
    /// one reaches.
    fn cover(&mut self, rim: &[usize]) -> Vec<usize> {
        self.searches += 1;
        let mut open: Vec<usize> = rim.iter().copied().filter(|&node| self.partner[node].is_none()).collect();
        let mut first = open.clone();
        let mut cover = Vec::new();
        while let Some(from) = open.pop() {
            for &to in self.couplings.neighbours(from) {
                if self.in_second[to] && self.reached[to].0 != self.searches {
                    self.reached[to].0 = self.searches;
                    cover.push(to);
                    // Another node's partner, so each is met once; none would lengthen the matching.
                    open.extend(self.partner[to]);
                    first.extend(self.partner[to]);
                }
            }
        }
        first.sort_unstable();
        cover.extend(rim.iter().filter(|node| first.binary_search(node).is_err()));
        cover.sort_unstable();
        cover
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_separator_parts_and_is_the_smallest() {
        // Two fans: 0 is coupled to 3, 4, 5 and 1, 2 to 6.
        let groups = [vec![0, 3], vec![0, 4], vec![0, 5], vec![1, 6], vec![2, 6]];
        let mut separators = Separators::new(Couplings::new(7, groups.into_iter()));
        assert_eq!(separators.separator(&[0, 1, 2], &[3, 4, 5, 6]), [0, 6]);
        assert_eq!(separators.separator(&[3, 4, 5, 6], &[2, 1, 0]), [0, 6]);
        assert_eq!(separators.separator(&[0], &[6]), [0; 0]);
    }

    #[test]
    fn a_partner_is_given_up_where_that_helps() {
        // 0 may have 2 or 3, 1 only 2.
        let mut separators =
            Separators::new(Couplings::new(4, [vec![0, 2], vec![0, 3], vec![1, 2]].into_iter()));
        assert_eq!(separators.separator(&[0, 1], &[2, 3]), [0, 1]);
        // With 4 coupled to 2 as well, 2 has to go: 0 keeps 3.
        let groups = [vec![0, 2], vec![0, 3], vec![1, 2], vec![4, 2]];
        let mut separators = Separators::new(Couplings::new(5, groups.into_iter()));
        assert_eq!(separators.separator(&[0, 1, 4], &[2, 3]).len(), 2);
    }
}
