//! The exact membrane limit: a ring of inextensible fabric that may wrinkle but not stretch.
//!
//! The meridian has length 1 (in units of W) and encloses, between the radii `R*/lambda` and
//! `R*/lambda + r(1)`, the largest volume that the hoop inequality `lambda r <= s` allows. The
//! largest volume has one of two shapes:
//!
//! - up to `lambda_c`: one **free arc**, without hoop tension except in the inner rim;
//! - beyond: free arc, **cone** of slope `-arccos(1/lambda)` on which the hoop inequality is an equality, free arc.
//!
//! Both are a few quadratures (`arc`) and a system of two or three equations (`solve`). V_bar' is
//! continuous at `lambda_c`, V_bar'' jumps. As stated, r(0) = 0 is imposed: the inner rim keeps its
//! length. Far beyond the target the rim would then have to push ([`Edges::rim_force`] < 0); a real rim
//! wrinkles, so there the model is too stiff.

mod arc;
mod limit;
#[cfg(test)]
mod maximise;
#[cfg(test)]
mod reference;
mod section;
mod solve;
mod table;

pub use limit::{RingLimit, limit};
pub use table::RingTable;

#[cfg(test)]
use self::section::CONE;
use self::section::{LAMBDA, PHI_0, TENSION};
use self::solve::{Solved, solve_cone, solve_free, solve_onset, solve_target};
use crate::mechanics::fault::HingeFault;
use crate::mechanics::hinge::{
    Edges, HingeEffort, HingeModel, HingeState, Level, check_lambda, check_r_star,
};
use crate::numerics::NewtonFault;

/// Largest R*: beyond, [`limit()`] is exact to 1e-6.
pub const MOST_R_STAR: f64 = 1e6;
/// Least lambda: the free section is smooth down to 0, where its axis goes to infinity.
pub const LEAST_LAMBDA: f64 = 0.01;
/// Largest lambda: at 3 the tension has fallen to a few per cent and the rim pushes for every R*.
pub const MOST_LAMBDA: f64 = 3.0;
/// Relative error of V_bar and V_bar' of a converged section, from the comparison with 30 digits in the tests.
const ERROR: f64 = 1e-12;

/// The exact ring.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ring;

impl HingeModel for Ring {
    fn level(&self) -> Level {
        Level::Ring
    }

    fn state(&self, r_star: f64, lambda: f64) -> Result<HingeState, HingeFault> {
        check_r_star(r_star, MOST_R_STAR)?;
        check_lambda(lambda, LEAST_LAMBDA, MOST_LAMBDA)?;
        solve(r_star, lambda).map(|solved| state(&solved)).map_err(|fault| unsolved(r_star, lambda, fault))
    }

    fn target(&self, r_star: f64) -> Result<HingeState, HingeFault> {
        check_r_star(r_star, MOST_R_STAR)?;
        solve_target(r_star).map(|solved| state(&solved)).map_err(|fault| unsolved(r_star, 1.3, fault))
    }

    fn onset(&self, r_star: f64) -> Result<Option<f64>, HingeFault> {
        check_r_star(r_star, MOST_R_STAR)?;
        target_and_onset(r_star).map(|[_, onset]| Some(onset.unknowns[LAMBDA]))
    }
}

/// The section at `lambda`: free below the onset of the cone, else with it.
fn solve(r_star: f64, lambda: f64) -> Result<Solved, NewtonFault> {
    // The cone exists for no R* below lambda = 1.12.
    if lambda < 1.1 {
        return solve_free(r_star, lambda);
    }
    let target = solve_target(r_star)?;
    if lambda < solve_onset(r_star, &target)?.unknowns[LAMBDA] {
        return solve_free(r_star, lambda);
    }
    follow(r_star, &target, lambda)
}

/// The sections at the target and at the onset of the cone.
fn target_and_onset(r_star: f64) -> Result<[Solved; 2], HingeFault> {
    let target = solve_target(r_star);
    let pair = target.and_then(|target| Ok([target, solve_onset(r_star, &target)?]));
    pair.map_err(|fault| unsolved(r_star, 1.3, fault))
}

/// Follows the branch with cone from `start_point` to `lambda`, in steps that Newton's iteration can take.
fn follow(r_star: f64, start_point: &Solved, lambda: f64) -> Result<Solved, NewtonFault> {
    let mut current = *start_point;
    let mut step = lambda - current.unknowns[LAMBDA];
    loop {
        let rest = lambda - current.unknowns[LAMBDA];
        if rest == 0.0 {
            return Ok(current);
        }
        let last = rest.abs() <= step.abs() * (1.0 + 1e-9);
        let (goal, increment) = if last { (lambda, rest) } else { (current.unknowns[LAMBDA] + step, step) };
        let start = std::array::from_fn(|i| current.unknowns[i] + increment * current.tangent[i]);
        match solve_cone(r_star, goal, start) {
            Ok(next) if last => return Ok(next),
            Ok(next) => current = next,
            // A thousandth of the range of lambda: if even that fails, there is no section.
            Err(fault) if step.abs() < 2e-3 => return Err(fault),
            Err(_) => step *= 0.5,
        }
    }
}

fn state(solved: &Solved) -> HingeState {
    let [phi_0, tension, _, lambda] = solved.unknowns;
    HingeState {
        lambda,
        volume: Some(solved.section.volume.value),
        slope: solved.section.slope.value,
        curvature: solved.curvature,
        edges: Some(Edges {
            tension,
            angle: phi_0,
            width: solved.section.width.value,
            rim_force: 2.0 * tension * libm::cos(phi_0),
        }),
        effort: HingeEffort { residual: solved.residual, iterations: solved.iterations, error: ERROR },
    }
}

/// Length of the cone at the target, in units of W; for the tests of the limits.
#[cfg(test)]
fn cone_at_target(r_star: f64) -> f64 {
    solve_target(r_star).map_or(f64::NAN, |solved| solved.unknowns[CONE])
}

fn unsolved(r_star: f64, lambda: f64, fault: NewtonFault) -> HingeFault {
    let residual = match fault {
        NewtonFault::Singular => f64::MAX,
        NewtonFault::Stalled { residual } | NewtonFault::Exhausted { residual } => residual,
    };
    HingeFault::Unsolved { r_star, lambda, residual }
}

/// Slope angle (rad) and tension at the inner edge of the free section; `None` if it cannot be solved.
pub(super) fn free_unknowns(r_star: f64, lambda: f64) -> Option<(f64, f64)> {
    let solved = solve_free(r_star, lambda).ok()?;
    Some((solved.unknowns[PHI_0], solved.unknowns[TENSION]))
}
