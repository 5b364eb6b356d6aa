//! The trade-off between contraction, stiffness and fabric.

use crate::optimize::{Evaluation, Goal};
use geom::order::sort_by;

/// The values to minimise.
fn goals(candidate: &Evaluation) -> [f64; 3] {
    [Goal::Contraction, Goal::Stiffness, Goal::Fabric].map(|goal| candidate.cost(goal))
}

/// The candidates that no other beats in all three goals at once.
pub(super) fn front(mut candidates: Vec<Evaluation>) -> Vec<Evaluation> {
    sort_by(&mut candidates, |a, b| {
        let (a, b) = (goals(a), goals(b));
        a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2]))
    });
    let mut front: Vec<Evaluation> = Vec::new();
    for candidate in candidates {
        let values = goals(&candidate);
        // Sorted by contraction: only candidates already kept can beat or equal this one.
        let beaten = front.iter().map(goals).any(|other| (0..3).all(|k| other[k] <= values[k]));
        if !beaten {
            front.push(candidate);
        }
    }
    front
}

/// Every `of`-th of `candidates`, ends included: a front has hundreds, a table a dozen.
pub fn thinned(candidates: &[Evaluation], max_count: usize) -> Vec<Evaluation> {
    let count = candidates.len();
    if count <= max_count || max_count < 2 {
        return candidates.iter().take(max_count.max(1)).cloned().collect();
    }
    (0..max_count).map(|i| candidates[i * (count - 1) / (max_count - 1)].clone()).collect()
}
