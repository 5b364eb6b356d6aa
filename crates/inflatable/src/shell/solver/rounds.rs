//! Equilibria with contact, in rounds.

use crate::shell::assembly::State;
use crate::shell::contact::ContactError;
use crate::shell::solver::newton::{Aim, NewtonResult, Solver, Stop};

/// k of contact by p/W: at 100 two to four rounds reach the tolerance; at 1e4 Newton's method meets kinks.
const CONTACT: f64 = 100.0;
/// Tolerance of the first rounds of contact, by that of the last; and penetration and change by their limits below which the next round may
/// be the last.
const LOOSE: f64 = 1e3;
const NEAR: f64 = 10.0;
/// Rounds of contact.
const MOST_ROUNDS: u32 = 20;
/// Penetration left, by W.
const PENETRATION: f64 = 1e-4;
/// Change of contact pressures left, by the largest of them.
const CHANGE: f64 = 1e-2;
/// k where rounds converge slowly, by p/W: few points that carry all of a force.
const STIFFEST: f64 = 1e6;

impl Solver {
    /// [`Solver::rest`] again and again, at most `max_rounds` times, while Newton's method goes on: wrinkles come and go.
    ///
    /// # Errors
    /// As of [`Solver::rest`].
    pub fn rest_in_rounds(
        &mut self,
        state: &mut State,
        aim: Aim,
        max_rounds: u32,
    ) -> Result<NewtonResult, Stop> {
        let mut rounds = (0..max_rounds).map(|_| self.rest(state, aim));
        rounds.find(|found| *found != Err(Stop::Iterations)).unwrap_or(Err(Stop::Iterations))
    }

    /// As [`Solver::settle`], with contact: rounds until no point penetrates.
    ///
    /// # Errors
    /// The reason of the stop; `state` is then the last shape.
    pub fn rest(&mut self, state: &mut State, aim: Aim) -> Result<NewtonResult, Stop> {
        let Some(contact) = &mut self.contact else { return self.settle(state, aim) };
        contact.stiffness = contact.floor.max(CONTACT * aim.pressure);
        let mut previous = ContactError { penetration: f64::INFINITY, change: f64::INFINITY, largest: 0.0 };
        let mut is_near = false;
        for _ in 0..MOST_ROUNDS {
            let rest = if is_near {
                self.settle(state, aim)?
            } else {
                self.approach(state, Aim { tolerance: LOOSE * aim.tolerance, ..aim })?
            };
            let Some(contact) = &mut self.contact else { return Ok(rest) };
            let misfit = contact.keep(state);
            if is_near && is_within(&misfit, 1.0) {
                return Ok(rest);
            }
            is_near = is_within(&misfit, NEAR);
            let is_slow = misfit.penetration > PENETRATION.max(previous.penetration / 4.0)
                || misfit.change > (CHANGE * misfit.largest).max(previous.change / 4.0);
            if is_slow && contact.stiffness < STIFFEST * aim.pressure {
                contact.stiffness *= 4.0;
            }
            previous = misfit;
        }
        Err(Stop::Contact)
    }
}

/// Whether `misfit` is at most `factor` times what contact may leave.
fn is_within(misfit: &ContactError, factor: f64) -> bool {
    misfit.penetration <= factor * PENETRATION && misfit.change <= factor * CHANGE * misfit.largest
}
