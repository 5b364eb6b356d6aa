//! First and second derivative of the penalised volume by lambda.

use crate::mechanics::hinge::bvp::section::PenalisedSection;
use crate::numerics::Dual;
use crate::numerics::collocation::{Problem, Solution};

/// Value and derivative by lambda of the first derivative: Simpson's rule on the density and its change with the
/// solution, the change in the middle of an interval from the same cubic as the solution.
pub(super) fn slopes(section: &PenalisedSection, solution: &Solution<4>) -> Dual<1> {
    let profile = &solution.profile;
    let changes = solution.sensitivity(section, |s, y| section.by_lambda(s, y));
    let slope_and_change = |j: usize| {
        let (s, y) = (profile.mesh[j], &profile.values[j]);
        let (jacobian, by_lambda) = (section.jacobian(s, y), section.by_lambda(s, y));
        let change: [f64; 4] = std::array::from_fn(|k| {
            by_lambda[k] + (0..4).map(|m| jacobian[k][m] * changes[j][m]).sum::<f64>()
        });
        (section.slope(s, y), change)
    };
    let mut total = Dual::constant(0.0);
    let mut before = slope_and_change(0);
    for i in 0..profile.mesh.len() - 1 {
        let (a, b) = (profile.mesh[i], profile.mesh[i + 1]);
        let after = slope_and_change(i + 1);
        let middle = |values: &[[f64; 4]], before: &[f64; 4], after: &[f64; 4]| -> [f64; 4] {
            let bend = 0.125 * (b - a);
            std::array::from_fn(|k| 0.5 * (values[i][k] + values[i + 1][k]) - bend * (after[k] - before[k]))
        };
        let y = middle(&profile.values, &before.0, &after.0);
        let change = middle(&changes, &before.1, &after.1);
        let ends = section.slope_density(a, &profile.values[i], &changes[i])
            + section.slope_density(b, &profile.values[i + 1], &changes[i + 1]);
        total = total + (ends + section.slope_density(0.5 * (a + b), &y, &change) * 4.0) * ((b - a) / 6.0);
        before = after;
    }
    total
}
