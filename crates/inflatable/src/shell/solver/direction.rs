//! The direction of a Newton step, from a factor of the Hessian.
//!
//! Where the Hessian is not positive definite, a shift is added to its diagonal. Where it hardly changes, the factor of an earlier one is kept.

use crate::shell::solver::experience::{Experience, STEP_ACCURACY, least_shift};
use crate::shell::solver::newton::{Aim, Solver, Stop};

/// Fall of the residual in the last step below which the factor is kept, and iterations of a solution with it: fewer than cost as much as a
/// new factor.
const KEPT: f64 = 0.1;
const MOST_KEPT: u32 = 10;
/// The largest shift over the least one: the smallest triangles at a sharp rim have a millionth of W^2, and are as stiff as any.
const MOST_SHIFT: f64 = 1e14;
/// Factor from shift to shift in a search, and the largest shift over the least one at which a search begins.
const GROWTH: f64 = 4.0;
const MOST_FIRST: f64 = 1e5;
/// The shift before by that after a step; and where the residual fell below a part [`WELL`].
const DECAY: f64 = 6.0;
const DECAY_WELL: f64 = 1000.0;
const WELL: f64 = 0.3;

impl Solver {
    /// Writes a direction of descent to `step`.
    pub(super) fn find_step(&mut self, aim: Aim) -> Result<(), Stop> {
        if !self.finds_step_with_kept_factor() {
            self.shift(least_shift(aim.pressure))?;
            self.load_forces();
            let accuracy = if self.lever.is_some() { STEP_ACCURACY } else { self.experience.accuracy };
            self.factor.solve(&mut self.step, accuracy);
            if let Some(lever) = &self.lever {
                lever.constrain(&self.assembly, &self.held, &mut self.step);
            }
        }
        self.experience.linear = self.factor.residual();
        Ok(())
    }

    fn finds_step_with_kept_factor(&mut self) -> bool {
        if !self.keeps_factor() {
            return false;
        }
        self.load_forces();
        self.factor.solve_within(MOST_KEPT, &mut self.step, self.experience.accuracy)
    }

    /// Whether the present Hessian is positive definite.
    pub(super) fn is_stable(&mut self) -> bool {
        self.keeps_factor() && self.factor.is_confirmed()
            || self.compute(0.0, true) && self.factor.is_confirmed()
    }

    /// Factors the present Hessian; false if it is not positive definite where the lever holds, which double precision decides if asked.
    pub(super) fn compute(&mut self, shift: f64, asks_double: bool) -> bool {
        self.effort.factors += 1;
        let is_single = self.factor.compute(self.assembly.hessian().2, shift, &self.springs);
        let is_definite = is_single || asks_double && self.factor.compute_double();
        if !is_definite {
            return false;
        }
        let Some(lever) = &self.lever else { return true };
        match lever.hold(&self.assembly, &mut self.factor) {
            Some(held) => self.held = held,
            None => return false,
        }
        true
    }

    /// Whether the factor of the Hessian one step ago serves for the present one.
    fn keeps_factor(&mut self) -> bool {
        let Experience { shift, fall, .. } = self.experience;
        fall < KEPT && shift == 0.0 && self.lever.is_none() && self.factor.keep_for(self.assembly.hessian().2)
    }

    /// Factors the present Hessian with a shift for which it is positive definite.
    fn shift(&mut self, least_shift: f64) -> Result<(), Stop> {
        let Experience { shift, found: last_shift, fall, .. } = self.experience;
        let mut shift = shift / if fall < WELL { DECAY_WELL } else { DECAY };
        if shift < least_shift {
            shift = 0.0;
        }
        // A shift may be larger than needed, so that far from an equilibrium double precision is not worth its time.
        let is_near = fall < WELL || least_shift == 0.0;
        let mut is_searched = false;
        while !self.compute(shift, shift == 0.0 && is_near) {
            shift = (GROWTH * shift).max(least_shift);
            if !is_searched {
                shift = shift.max((last_shift / GROWTH).min(MOST_FIRST * least_shift));
                is_searched = true;
            }
            if shift >= MOST_SHIFT * least_shift {
                self.experience.shift = 0.0;
                return Err(Stop::Shift);
            }
        }
        self.experience.shift = shift;
        if is_searched {
            self.experience.found = shift;
        }
        Ok(())
    }

    fn load_forces(&mut self) {
        for (step, slope) in self.step.iter_mut().zip(self.assembly.gradient()) {
            *step = -slope;
        }
    }
}
