//! One equilibrium: Newton's method on the energy, with the full Hessian.

use super::factor::{self, Factor};
use crate::shell::assembly::{Assembly, Energy, Sheet, State, Supports};
use crate::shell::contact::Contact;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// What is loaded on the sheet, and what is asked of an equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aim {
    /// Pressure below the sheet.
    pub pressure: f64,
    /// Largest norm of the residual.
    pub tolerance: f64,
}

/// Why an equilibrium was not found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stop {
    /// The iterations were used up.
    Iterations,
    /// No fraction of a step brings the energy down.
    Stalled,
    /// No shift makes the Hessian positive definite.
    Shift,
    /// Contact pressures do not come to rest.
    Contact,
    /// It was told to stop.
    Cancelled,
    /// The forces vanish, but the shape is not stable: its Hessian is not positive definite.
    Unstable,
}

/// What it took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Effort {
    /// Newton steps.
    pub iterations: u32,
    /// Cholesky factors computed.
    pub factors: u32,
    /// Shapes whose energy alone was computed.
    pub energies: u32,
}

/// An equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rest {
    /// The parts of its energy.
    pub energy: Energy,
    /// Norm of what remains of the forces.
    pub residual: f64,
}

/// Newton steps allowed for one equilibrium.
const MOST_ITERATIONS: u32 = 80;
/// Halvings of a step.
const MOST_HALVINGS: u32 = 12;
/// Part of the energy's promised fall that must come.
const ARMIJO: f64 = 1e-4;
/// Rounding of a sum of energies, relative to its largest part.
const ROUNDING: f64 = 1e-14;

/// k of contact by p/W: at 100 two to four rounds reach the tolerance; at 1e4 Newton's method meets kinks.
const CONTACT: f64 = 100.0;
/// Rounds of contact.
const MOST_ROUNDS: u32 = 20;
/// Penetration left, by W.
const PENETRATION: f64 = 1e-4;
/// Change of contact pressures left, by p.
const CHANGE: f64 = 1e-2;

/// Finds equilibria of one sheet.
pub struct Solver {
    /// Sums over its triangles.
    pub assembly: Assembly,
    /// What it may touch.
    pub contact: Option<Contact>,
    factor: Factor,
    step: Vec<f64>,
    /// What a shift adds to each unknown's diagonal: a spring a unit of area, none for the directors.
    lumps: Vec<f64>,
    shift: f64,
    trial: State,
    /// What all solves took together.
    pub effort: Effort,
    /// Raised by another thread to stop at the next step.
    pub cancel: Arc<AtomicBool>,
}

impl Solver {
    /// Prepares a sheet; `None` if it is too large for this machine.
    pub fn new(sheet: Sheet, supports: Supports) -> Option<Self> {
        let natural = Assembly::new(sheet.clone(), supports.clone(), None);
        let (starts, rows, _) = natural.hessian();
        let order = factor::order(starts, rows)?;
        let assembly = Assembly::new(sheet, supports, Some(&order));
        let (starts, rows, _) = assembly.hessian();
        let factor = Factor::new(starts, rows)?;
        Some(Self {
            step: vec![0.0; assembly.unknowns()],
            lumps: assembly.lumped_areas(),
            trial: assembly.sheet.flat(),
            shift: 0.0,
            effort: Effort::default(),
            cancel: Arc::default(),
            factor,
            contact: None,
            assembly,
        })
    }

    /// Moves `state` to an equilibrium near by.
    ///
    /// # Errors
    /// Where it stopped, which `state` then is.
    pub fn settle(&mut self, state: &mut State, aim: Aim) -> Result<Rest, Stop> {
        let mut energy = self.linearise(state, aim.pressure);
        for _ in 0..MOST_ITERATIONS {
            if self.cancel.load(Ordering::Relaxed) {
                return Err(Stop::Cancelled);
            }
            let residual = norm(self.assembly.gradient());
            if residual <= aim.tolerance && self.shift == 0.0 {
                let stable = self.compute(0.0);
                return if stable { Ok(Rest { energy, residual }) } else { Err(Stop::Unstable) };
            }
            self.find_step(aim)?;
            energy = self.take_step(state, energy, aim)?;
            self.effort.iterations += 1;
            if std::env::var("SHELL_TRACE").is_ok() {
                eprintln!("   E {:.12e} res {:.3e} shift {:.2e}", energy.total(aim.pressure), norm(self.assembly.gradient()), self.shift);
            }
        }
        Err(Stop::Iterations)
    }

    /// As [`Solver::settle`], with what the sheet touches: rounds of contact until nothing penetrates.
    ///
    /// # Errors
    /// Where it stopped, which `state` then is.
    pub fn rest(&mut self, state: &mut State, aim: Aim) -> Result<Rest, Stop> {
        let Some(contact) = &mut self.contact else { return self.settle(state, aim) };
        contact.stiffness = CONTACT * aim.pressure;
        for _ in 0..MOST_ROUNDS {
            let rest = self.settle(state, aim)?;
            let misfit = self.contact.as_mut().map(|contact| contact.keep(state)).unwrap_or_default();
            if misfit.penetration <= PENETRATION && misfit.change <= CHANGE * aim.pressure {
                return Ok(rest);
            }
        }
        Err(Stop::Contact)
    }

    fn linearise(&mut self, state: &State, pressure: f64) -> Energy {
        let mut energy = self.assembly.linearise(state, pressure);
        if let Some(contact) = &self.contact {
            contact.add(state, &mut self.assembly);
            energy.contact = contact.energy(state);
        }
        energy
    }

    fn linearise_trial(&mut self, pressure: f64) -> Energy {
        let trial = std::mem::take(&mut self.trial);
        let energy = self.linearise(&trial, pressure);
        self.trial = trial;
        energy
    }

    fn energy_of_trial(&mut self) -> Energy {
        self.effort.energies += 1;
        let mut energy = self.assembly.energy(&self.trial);
        energy.contact = self.contact.as_ref().map_or(0.0, |contact| contact.energy(&self.trial));
        energy
    }

    fn compute(&mut self, shift: f64) -> bool {
        self.effort.factors += 1;
        self.factor.compute(self.assembly.hessian(), shift, &self.lumps)
    }

    /// Leaves a direction of descent in `step`, and in `shift` what it took.
    fn find_step(&mut self, aim: Aim) -> Result<(), Stop> {
        let least = 0.01 * aim.pressure;
        self.shift /= 6.0;
        if self.shift < least {
            self.shift = 0.0;
        }
        while !self.compute(self.shift) {
            self.shift = (4.0 * self.shift).max(least);
            if self.shift > 1e9 * least {
                return Err(Stop::Shift);
            }
        }
        for (step, slope) in self.step.iter_mut().zip(self.assembly.gradient()) {
            *step = -slope;
        }
        self.factor.solve(&mut self.step);
        Ok(())
    }

    /// Goes as far along `step` as the energy falls.
    fn take_step(&mut self, state: &mut State, before: Energy, aim: Aim) -> Result<Energy, Stop> {
        let slope: f64 = self.step.iter().zip(self.assembly.gradient()).map(|(s, g)| s * g).sum();
        let noise = ROUNDING * (before.membrane + before.bending + (aim.pressure * before.volume).abs());
        let start = before.total(aim.pressure);
        let mut fraction = 1.0;
        for halving in 0..MOST_HALVINGS {
            self.trial.clone_from(state);
            self.assembly.advance(&mut self.trial, &self.step, fraction);
            let mut energy = if halving == 0 {
                self.linearise_trial(aim.pressure)
            } else {
                self.energy_of_trial()
            };
            if energy.total(aim.pressure) <= start + ARMIJO * fraction * slope + noise {
                if halving > 0 {
                    energy = self.linearise_trial(aim.pressure);
                }
                std::mem::swap(state, &mut self.trial);
                return Ok(energy);
            }
            fraction /= 2.0;
        }
        Err(Stop::Stalled)
    }

    /// Solves with the unshifted Hessian of the last equilibrium.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        self.factor.solve(rhs);
    }

    /// Triangles of its mesh.
    pub fn triangles(&self) -> usize {
        self.assembly.sheet.pieces.len()
    }

    /// Numbers that the Cholesky factor keeps.
    pub fn factor_size(&self) -> usize {
        self.factor.size()
    }
}

fn norm(vector: &[f64]) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}
