//! The continuation from the free section to the penalised one at the required beta.
//!
//! At small beta the penalty is no inequality: it pulls the whole section inwards (its force is of
//! order beta everywhere) and turns it inside out for small R*. So beta does not grow from 0; the offset
//! falls to 0 at a moderate beta, then beta rises. Both ends are the paper's: the free section
//! (its beta = 0), and the penalised one.

use crate::mechanics::hinge::bvp::section::PenalisedSection;
use crate::mechanics::hinge::ring::free_unknowns;
use crate::numerics::collocation::{CollocationFault, Profile, Solution, solve};

/// First beta: the penalty acts over 1/beta = 2 % of the width, which works for any R* in range.
const FIRST_BETA: f64 = 50.0;
/// First offset beyond the free section's largest u: exp(-50 * 0.1) makes the penalty a small correction.
const FIRST_GAP: f64 = 0.1;
/// Residual on the way: the profile only has to be a fair start for the next step.
const ROUGH: f64 = 3e-2;
/// Largest number of intervals: three times the number for 1e-8 at beta = 1e6.
const MOST_INTERVALS: usize = 20_000;

/// The end of the path.
#[derive(Clone, Debug)]
pub(super) struct End {
    pub(super) section: PenalisedSection,
    pub(super) solution: Solution<4>,
    pub(super) iterations: u32,
}

/// The penalised section at `beta`, its residual at most `tolerance`.
pub(super) fn follow(r_star: f64, lambda: f64, beta: f64, tolerance: f64) -> Result<End, CollocationFault> {
    let first = beta.min(FIRST_BETA);
    let start = free_profile(r_star, lambda).ok_or(CollocationFault::Diverged)?;
    let gap = start.values.iter().map(|y| y[2]).fold(0.0, f64::max) + FIRST_GAP;
    let mut section = PenalisedSection { r_star, lambda, beta: first, offset: gap };
    let mut solution_at_t = solve(&section, start, ROUGH, MOST_INTERVALS)?;
    let mut iterations = solution_at_t.iterations;
    // One parameter t: from 0 to 1 the offset falls to 0, beyond beta grows like exp(t - 1).
    let last = 1.0 + libm::log(beta / first);
    let origin = section;
    let (mut t, mut step) = (0.0, 0.25);
    while t < last {
        let next = if t < 1.0 { (t + step).min(1.0) } else { (t + step).min(last) };
        let trial = PenalisedSection {
            offset: gap * (1.0 - next).max(0.0),
            beta: if next >= last { beta } else { first * libm::exp((next - 1.0).max(0.0)) },
            ..origin
        };
        match solve(&trial, solution_at_t.profile.clone(), ROUGH, MOST_INTERVALS) {
            Ok(solution) => {
                iterations += solution.iterations;
                step *= if solution.iterations <= 8 { 1.6 } else { 1.0 };
                (solution_at_t, t, section) = (solution, next, trial);
            }
            Err(fault) => {
                iterations += 10;
                step *= 0.4;
                if step < 1e-4 {
                    return Err(fault);
                }
            }
        }
    }
    section = PenalisedSection { beta, offset: 0.0, ..section };
    let solution = solve(&section, solution_at_t.profile, tolerance, MOST_INTERVALS)?;
    iterations += solution.iterations;
    Ok(End { section, solution, iterations })
}

/// The free section as a profile in (T, phi, u, z), by fourth-order Runge-Kutta steps.
fn free_profile(r_star: f64, lambda: f64) -> Option<Profile<4>> {
    const STEPS: u32 = 48;
    let (phi_0, tension) = free_unknowns(r_star, lambda)?;
    let slope = |y: [f64; 3]| [-(r_star / lambda + y[1]) / tension, libm::cos(y[0]), libm::sin(y[0])];
    let h = 1.0 / f64::from(STEPS);
    let mut y = [phi_0, 0.0, 0.0];
    let mut profile = Profile { mesh: Vec::new(), values: Vec::new() };
    for i in 0..=STEPS {
        let s = f64::from(i) * h;
        profile.mesh.push(s);
        profile.values.push([tension, y[0], lambda * y[1] - s, y[2]]);
        let add = |k: &[f64; 3], factor: f64| std::array::from_fn(|j| y[j] + factor * k[j]);
        let k1 = slope(y);
        let k2 = slope(add(&k1, 0.5 * h));
        let k3 = slope(add(&k2, 0.5 * h));
        let k4 = slope(add(&k3, h));
        y = std::array::from_fn(|j| y[j] + h / 6.0 * (k1[j] + 2.0 * (k2[j] + k3[j]) + k4[j]));
    }
    Some(profile)
}
