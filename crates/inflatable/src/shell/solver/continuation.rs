//! From the flat sheet to a pressure, equilibrium by equilibrium.

use crate::shell::assembly::State;
use crate::shell::solver::newton::{Aim, NewtonResult, Solver, Stop};

/// Schedule of rising pressures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Continuation {
    /// The first pressure above the flat sheet: 1/eps = 1, where a plate hardly bends.
    pub first: f64,
    /// The last one.
    pub last: f64,
    /// Least norm of a residual that rounding allows.
    pub floor: f64,
}

/// An equilibrium on the way.
#[derive(Clone, Debug)]
pub struct Equilibrium {
    /// Pressure of the equilibrium.
    pub pressure: f64,
    /// Shape of the sheet.
    pub state: State,
    /// Energy, and the residual of its forces.
    pub rest: NewtonResult,
}

/// A continuation that ended too early.
#[derive(Clone, Debug)]
pub struct Broken {
    /// The pressure at which no equilibrium was found.
    pub pressure: f64,
    /// The reason.
    pub why: Stop,
    /// The last equilibrium.
    pub last: Option<Box<Equilibrium>>,
}

/// log10 of the factor from equilibrium to equilibrium.
const STEP: f64 = 0.25;
/// Halvings of it where an equilibrium is not reached.
const MOST_HALVINGS: i32 = 5;
/// Required residual relative to p W^2.
const RESIDUAL: f64 = 1e-8;
/// The tolerance on the way: flat sheets of small triangles have no residual of 1e-8 at the first pressures, for rounding.
const PASSING: f64 = 1e-6;

impl Continuation {
    /// The conditions of an equilibrium at `pressure`.
    pub fn aim(&self, pressure: f64) -> Aim {
        Aim { pressure, tolerance: (RESIDUAL * pressure).max(self.floor) }
    }

    /// The aim for an equilibrium on the way.
    fn passing(&self, pressure: f64) -> Aim {
        let Aim { tolerance, .. } = self.aim(pressure);
        Aim { pressure, tolerance: tolerance.max(PASSING * pressure) }
    }

    /// Raises the pressure from the flat sheet. `on_equilibrium` receives every equilibrium.
    ///
    /// # Errors
    /// The pressure at which it ended, the reason, and the last equilibrium.
    pub fn run(
        &self,
        solver: &mut Solver,
        on_equilibrium: impl FnMut(&Equilibrium),
    ) -> Result<Equilibrium, Broken> {
        let flat = solver.assembly.sheet.flat();
        self.run_from(solver, flat, self.first, on_equilibrium)
    }

    /// Raises the pressure from `state`, a shape near the equilibrium at the pressure `first`.
    ///
    /// # Errors
    /// The pressure at which it ended, the reason, and the last equilibrium.
    pub fn run_from(
        &self,
        solver: &mut Solver,
        mut state: State,
        first: f64,
        mut on_equilibrium: impl FnMut(&Equilibrium),
    ) -> Result<Equilibrium, Broken> {
        let mut last_rest: Option<Equilibrium> = None;
        let mut touched = solver.contact.clone();
        let mut step = STEP;
        let mut next = first.min(self.last);
        loop {
            let aim = if next < self.last { self.passing(next) } else { self.aim(next) };
            match solver.rest(&mut state, aim) {
                Ok(rest) => {
                    solver.may_snap = false;
                    let equilibrium = Equilibrium { pressure: next, state: state.clone(), rest };
                    on_equilibrium(&equilibrium);
                    if next >= self.last {
                        return Ok(equilibrium);
                    }
                    last_rest = Some(equilibrium);
                    touched.clone_from(&solver.contact);
                    step = (2.0 * step).min(STEP);
                }
                Err(why) => {
                    let may_halve = why != Stop::Cancelled && step > STEP * 0.5_f64.powi(MOST_HALVINGS);
                    // However small the equilibrium: it snaps from one shape to another, which takes long.
                    let is_stuck = !may_halve && last_rest.is_some();
                    let snaps = is_stuck && why == Stop::Iterations && !solver.may_snap;
                    solver.may_snap = snaps;
                    if may_halve {
                        step /= 2.0;
                    }
                    let Some(equilibrium) = last_rest.as_ref().filter(|_| may_halve || snaps) else {
                        return Err(Broken { pressure: next, why, last: last_rest.map(Box::new) });
                    };
                    state.clone_from(&equilibrium.state);
                    // A shape that was not found has left contact pressures that belong to none.
                    solver.contact.clone_from(&touched);
                }
            }
            let last_pressure = last_rest.as_ref().map_or(first, |equilibrium| equilibrium.pressure);
            next = last_pressure * libm::pow(10_f64, step);
            if next > self.last * 0.9999 {
                next = self.last;
            }
        }
    }
}
