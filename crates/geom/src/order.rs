//! Stable sorting in little code: the comparison alone is compiled for each type, where `slice::sort_by` compiles all of its algorithm.

use std::cmp::Ordering;

/// Sorts `items` by `compare`, which must be a total order; equal items keep their order. For lists that no time depends on: it
/// allocates two indices an item.
pub fn sort_by<T>(items: &mut [T], mut compare: impl FnMut(&T, &T) -> Ordering) {
    let mut sources: Vec<usize> = (0..items.len()).collect();
    sort_indices(&mut sources, &mut |a, b| compare(&items[a], &items[b]));
    let mut targets = vec![0; items.len()];
    for (target, source) in sources.into_iter().enumerate() {
        targets[source] = target;
    }
    for i in 0..items.len() {
        while targets[i] != i {
            let target = targets[i];
            items.swap(i, target);
            targets.swap(i, target);
        }
    }
}

/// Sorts `items` by the key that `key` gives for each; equal ones keep their order.
pub fn sort_by_key<T, K: Ord>(items: &mut [T], mut key: impl FnMut(&T) -> K) {
    sort_by(items, |a, b| key(a).cmp(&key(b)));
}

/// Compiled once for all types.
#[inline(never)]
fn sort_indices(indices: &mut [usize], compare: &mut dyn FnMut(usize, usize) -> Ordering) {
    indices.sort_by(|a, b| compare(*a, *b));
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_order_is_that_of_the_standard_library(keys in prop::collection::vec(0..20_u8, 0..200)) {
            let mut items: Vec<(u8, usize)> = keys.into_iter().zip(0..).collect();
            let mut expected = items.clone();
            expected.sort_by_key(|item| item.0);
            sort_by_key(&mut items, |item| item.0);
            prop_assert_eq!(items, expected);
        }
    }
}
