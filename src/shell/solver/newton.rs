//! One equilibrium: Newton's method on the energy, with the full Hessian.

use super::factor::{self, Factor};
use crate::shell::assembly::{Assembly, Energy, Sheet, State, Supports};

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

/// Finds equilibria of one sheet.
pub struct Solver {
    /// Sums over its triangles.
    pub assembly: Assembly,
    factor: Factor,
    step: Vec<f64>,
    /// What a shift adds to each unknown's diagonal: a spring a unit of area, none for the directors.
    lumps: Vec<f64>,
    shift: f64,
    trial: State,
    /// What all solves took together.
    pub effort: Effort,
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
            factor,
            assembly,
        })
    }

    /// Moves `state` to an equilibrium near by.
    ///
    /// # Errors
    /// Where it stopped, which `state` then is.
    pub fn settle(&mut self, state: &mut State, aim: Aim) -> Result<Rest, Stop> {
        let mut energy = self.assembly.linearise(state, aim.pressure);
        for _ in 0..MOST_ITERATIONS {
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
                self.assembly.linearise(&self.trial, aim.pressure)
            } else {
                self.effort.energies += 1;
                self.assembly.energy(&self.trial)
            };
            if energy.total(aim.pressure) <= start + ARMIJO * fraction * slope + noise {
                if halving > 0 {
                    energy = self.assembly.linearise(&self.trial, aim.pressure);
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

    /// Numbers that the Cholesky factor keeps.
    pub fn factor_size(&self) -> usize {
        self.factor.size()
    }
}

fn norm(vector: &[f64]) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}
