//! Newton's iterations of the exact ring: free section, section with cone, onset of the cone, target.
//!
//! Each solves some of the equations `length = 1`, `z(1) = 0`, `u = 0 at the cone`, `V_bar' = 0` for
//! some of the four unknowns and holds the others. The second derivative of the volume follows
//! from the same Jacobian by implicit differentiation.

use crate::mechanics::hinge::ring::section::{
    CONE, Gradient, LAMBDA, PHI_0, RingSection, TENSION, cone_section, free_section,
};
use crate::numerics::newton::solve_dense;
use crate::numerics::{NewtonFault, NewtonReport, newton};
use nalgebra::{Const, DimMin, SMatrix, SVector};
use std::f64::consts::{FRAC_1_PI, FRAC_PI_2};

/// Residuals are sums of some 50 terms of order one: a few 1e-16 can be reached, this always.
const TOLERANCE: f64 = 1e-13;

/// A solved section.
#[derive(Clone, Copy, Debug)]
pub(super) struct Solved {
    pub(super) unknowns: [f64; 4],
    pub(super) section: RingSection,
    /// Derivatives of the unknowns by lambda; its own entry is 1.
    pub(super) tangent: [f64; 4],
    /// d2V_bar/dlambda2 on the branch.
    pub(super) curvature: f64,
    pub(super) residual: f64,
    pub(super) iterations: u32,
}

/// The equations of a section with a cone, in the order in which they are dropped when an unknown is held.
fn equations(section: &RingSection) -> [Gradient; 4] {
    [section.length, section.closing, section.contact, section.slope]
}

/// Solves the first `N` equations for the unknowns `free`, from `start`, holding the others. Adds the second derivative, and the tangent
/// along lambda of the first `BRANCH` unknowns, by `J_y dy/dlambda = -F_lambda`.
fn solve<const N: usize, const BRANCH: usize>(
    build: impl Fn([f64; 4]) -> Option<RingSection>,
    free: [usize; N],
    start: [f64; 4],
    slope_scale: f64,
) -> Result<Solved, NewtonFault>
where
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
    Const<BRANCH>: DimMin<Const<BRANCH>, Output = Const<BRANCH>>,
{
    let NewtonReport { point, residual, iterations } =
        newton(free.map(|index| start[index]), TOLERANCE, |values| {
            let rows = equations(&build(replaced(start, free, values))?);
            let scale = |row: usize| if row == 3 { slope_scale } else { 1.0 };
            let residuals = std::array::from_fn(|row| scale(row) * rows[row].value);
            let jacobian = std::array::from_fn(|row| free.map(|index| scale(row) * rows[row].slope[index]));
            Some((residuals, jacobian))
        })?;
    let unknowns = replaced(start, free, point);
    let section = build(unknowns).ok_or(NewtonFault::Stalled { residual })?;
    let rows = equations(&section);
    let jacobian = SMatrix::<f64, BRANCH, BRANCH>::from_fn(|row, column| rows[row].slope[column]);
    let right = SVector::<f64, BRANCH>::from_fn(|row, _| -rows[row].slope[LAMBDA]);
    let change = solve_dense(jacobian, &right).ok_or(NewtonFault::Singular)?;
    let mut tangent = [0.0; 4];
    tangent[LAMBDA] = 1.0;
    tangent[..BRANCH].copy_from_slice(change.as_slice());
    let curvature = (0..4).map(|i| section.slope.slope[i] * tangent[i]).sum();
    Ok(Solved { unknowns, section, tangent, curvature, residual, iterations })
}

/// The unknowns `start` with `values` at the indices `free`.
fn replaced<const N: usize>(start: [f64; 4], free: [usize; N], values: [f64; N]) -> [f64; 4] {
    let mut unknowns = start;
    for (index, value) in free.into_iter().zip(values) {
        unknowns[index] = value;
    }
    unknowns
}

/// The free section at `lambda`, whether or not it keeps the hoop inequality.
pub(super) fn solve_free(r_star: f64, lambda: f64) -> Result<Solved, NewtonFault> {
    let axis = r_star / lambda;
    // Within 3 % of the solution for every axis distance from 0 to infinity.
    let start = [
        FRAC_PI_2 - 0.8603 / (1.0 + 1.72 * axis),
        axis * FRAC_1_PI + 0.1522 + 0.0334 / (1.0 + 5.0 * axis),
        0.0,
        lambda,
    ];
    solve::<2, 2>(|unknowns| free_section(r_star, unknowns), [PHI_0, TENSION], start, 1.0)
}

/// The section with a cone at `lambda`, from the unknowns `start`.
pub(super) fn solve_cone(r_star: f64, lambda: f64, mut start: [f64; 4]) -> Result<Solved, NewtonFault> {
    start[LAMBDA] = lambda;
    solve::<3, 3>(|unknowns| cone_section(r_star, unknowns), [PHI_0, TENSION, CONE], start, 1.0)
}

/// The start of the cone: `lambda = lambda_c`, L = 0.
pub(super) fn solve_onset(r_star: f64, target: &Solved) -> Result<Solved, NewtonFault> {
    // On the branch with cone L is nearly linear in lambda between onset and target.
    let back = -target.unknowns[CONE] / target.tangent[CONE];
    let mut start: [f64; 4] = std::array::from_fn(|i| target.unknowns[i] + back * target.tangent[i]);
    start[CONE] = 0.0;
    solve::<3, 3>(|unknowns| cone_section(r_star, unknowns), [PHI_0, TENSION, LAMBDA], start, 1.0)
}

/// The largest volume: `lambda = lambda_t`.
pub(super) fn solve_target(r_star: f64) -> Result<Solved, NewtonFault> {
    // Within 2 % of the solution for every R* from 0 to infinity.
    let start = [
        FRAC_PI_2 - 0.5922 / (1.0 + 2.13 * r_star),
        0.0916 + 0.230_65 * r_star + 0.0039 * r_star / (1.0 + r_star),
        0.113 / (1.0 + 1.25 * r_star),
        1.380_05 - 0.1093 / (1.0 + 1.51 * r_star),
    ];
    // V_bar' grows with R* off the target, so its rounding does too.
    let scale = 1.0 / (1.0 + r_star);
    let free = [PHI_0, TENSION, CONE, LAMBDA];
    solve::<4, 3>(|unknowns| cone_section(r_star, unknowns), free, start, scale)
}
