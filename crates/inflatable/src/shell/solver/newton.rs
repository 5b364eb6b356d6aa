//! One equilibrium: Newton's method on the energy, with the full Hessian.

use crate::numerics::dot;
use crate::shell::assembly::{Assembly, Energy, Sheet, State, Supports, Tangent};
use crate::shell::contact::Contact;
use crate::shell::solver::displacement_control::{ControlledSolve, DisplacementControl};
use crate::shell::solver::experience::{Experience, least_shift};
use crate::shell::solver::factor::{EXACT, Factor};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The load on the sheet, and the tolerance of an equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aim {
    /// Pressure below the sheet.
    pub pressure: f64,
    /// Largest norm of the residual.
    pub tolerance: f64,
}

/// Reason for a missing equilibrium.
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
    /// The computation was cancelled.
    Cancelled,
    /// The forces vanish, but the shape is not stable: its Hessian is not positive definite.
    Unstable,
}

/// Number of operations of a solve.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Effort {
    /// Newton steps.
    pub iterations: u32,
    /// Cholesky factors computed.
    pub factors: u32,
    /// Number of shapes whose energy alone was computed.
    pub energies: u32,
}

/// An equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewtonResult {
    /// The parts of its energy.
    pub energy: Energy,
    /// Norm of the remaining forces.
    pub residual: f64,
}

/// Newton steps allowed for one equilibrium, and where a sheet snaps from one shape to another.
const MOST_ITERATIONS: u32 = 80;
const MOST_TO_SNAP: u32 = 1000;
/// Halvings of a step.
const MOST_HALVINGS: u32 = 12;
/// Part of the energy's promised fall that must come.
const ARMIJO: f64 = 1e-4;
/// Shift over the least one from which on no shorter step is tried.
const MOST_SHORTENED: f64 = 1e8;
/// Part of the energy that a step of a rough state gains at least, for the next one to be taken alike.
const ROUGH: f64 = 1e-3;
/// Rounding of a sum of energies, relative to its largest part.
const ROUNDING: f64 = 1e-14;
/// Rounding of a strain, which is a difference of squares of order one: sheets that are hardly stretched feel it.
const STRAIN_ROUNDING: f64 = 1e-15;

/// Finds equilibria of one sheet.
pub struct Solver {
    /// Sums over its triangles.
    pub assembly: Assembly,
    /// Contact of the sheet, if there is any.
    pub contact: Option<Contact>,
    /// A constraint besides its supports.
    pub lever: Option<DisplacementControl>,
    pub(super) held: ControlledSolve,
    /// The lever's multiplier at the last equilibrium: forces + multiplier c = 0.
    pub multiplier: f64,
    pub(super) factor: Factor,
    pub(super) step: Vec<f64>,
    /// Contribution of a shift to each unknown's diagonal.
    pub(super) springs: Vec<f64>,
    /// The sheet's flat area.
    area: f64,
    pub(super) experience: Experience,
    trial: State,
    /// Effort of all solves together.
    pub effort: Effort,
    /// Raised by another thread to stop at the next step.
    pub cancel: Arc<AtomicBool>,
    /// Newton steps of all solves together after which none is begun.
    pub most_steps: u32,
    /// Whether the equilibrium of a sheet may be far away.
    pub may_snap: bool,
    /// Whether the state comes from a coarser mesh. Interpolation compresses some of its triangles, and a shift that outweighs them takes many
    /// factors to find and then holds everything; so compression does not enter the Hessian until a step gains little.
    pub is_rough: bool,
}

impl Solver {
    /// Prepares a sheet; `None` if it is too large for this machine.
    pub fn new(sheet: Sheet, supports: Supports) -> Option<Self> {
        let assembly = Assembly::new(sheet, supports);
        let (starts, rows, _) = assembly.hessian();
        let factor = Factor::new(starts, rows)?;
        Some(Self {
            step: vec![0.0; assembly.unknowns()],
            springs: assembly.springs(),
            area: assembly.sheet.areas.iter().sum(),
            trial: assembly.sheet.flat(),
            experience: Experience::NONE,
            effort: Effort::default(),
            cancel: Arc::default(),
            most_steps: u32::MAX,
            may_snap: false,
            is_rough: false,
            factor,
            contact: None,
            lever: None,
            held: ControlledSolve::default(),
            multiplier: 0.0,
            assembly,
        })
    }

    /// Moves `state` to an equilibrium near by.
    ///
    /// # Errors
    /// The reason of the stop; `state` is then the last shape.
    pub fn settle(&mut self, state: &mut State, aim: Aim) -> Result<NewtonResult, Stop> {
        let result = self.approach(state, aim)?;
        if self.is_stable() { Ok(result) } else { Err(Stop::Unstable) }
    }

    /// As [`Solver::settle`], whether the equilibrium is stable or not.
    pub(super) fn approach(&mut self, state: &mut State, aim: Aim) -> Result<NewtonResult, Stop> {
        let result = self.iterate(state, aim);
        self.is_rough = false;
        result
    }

    fn iterate(&mut self, state: &mut State, aim: Aim) -> Result<NewtonResult, Stop> {
        // Each round linearises, finds a step, and takes as much of it as lowers the energy. Far from the equilibrium
        // a rougher tangent converges more surely; it is left once the energy hardly falls. An equilibrium counts only
        // if its Hessian needed no shift: it is then stable.
        self.experience.begin();
        let mut energy = self.linearise(state, aim.pressure);
        let max_iterations = if self.may_snap { MOST_TO_SNAP } else { MOST_ITERATIONS };
        for _ in 0..max_iterations {
            if self.cancel.load(Ordering::Relaxed) {
                return Err(Stop::Cancelled);
            }
            let residual = self.residual();
            self.experience.see(residual);
            if residual <= aim.tolerance && self.experience.shift == 0.0 && !self.is_rough {
                return Ok(NewtonResult { energy, residual });
            }
            if self.effort.iterations >= self.most_steps {
                return Err(Stop::Iterations);
            }
            self.find_step(aim)?;
            let was_rough = self.is_rough;
            match self.take_step(state, energy, aim) {
                Ok(next) => {
                    let gain = energy.total(aim.pressure) - next.total(aim.pressure);
                    self.is_rough &= gain > ROUGH * next.total(aim.pressure).abs();
                    energy = next;
                }
                Err(_) if was_rough => self.is_rough = false,
                Err(why) => energy = self.shorten_step(state, aim).ok_or(why)?,
            }
            if was_rough && !self.is_rough {
                energy = self.linearise(state, aim.pressure);
            }
            self.effort.iterations += 1;
        }
        Err(Stop::Iterations)
    }

    pub(super) fn linearise(&mut self, state: &State, pressure: f64) -> Energy {
        let tangent = if self.is_rough { Tangent::Tensile } else { Tangent::Exact };
        let mut energy = self.assembly.linearise(state, pressure, tangent);
        if let Some(contact) = &self.contact {
            contact.add(state, &mut self.assembly);
            energy.contact = contact.energy(state);
        }
        if let Some(lever) = &self.lever {
            lever.add(&mut self.assembly);
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

    /// The norm of the forces without the constraint's part, whose multiplier it keeps.
    fn residual(&mut self) -> f64 {
        let gradient = self.assembly.gradient();
        let Some(lever) = &self.lever else { return dot(gradient, gradient).sqrt() };
        self.multiplier = -dot(&lever.row, gradient) / dot(&lever.row, &lever.row);
        let residual = lever.row.iter().zip(gradient).map(|(c, g)| g + self.multiplier * c);
        residual.map(|x| x * x).sum::<f64>().sqrt()
    }

    /// Moves an equilibrium to where the lever's function is larger by `change`, along the sheet's compliance.
    pub fn pull(&mut self, state: &mut State, aim: Aim, change: f64) -> bool {
        let _ = self.linearise(state, aim.pressure);
        let is_stable = self.compute(0.0, true);
        if is_stable && self.lever.is_some() {
            self.assembly.advance(state, &self.held.answer, change / self.held.gives);
        }
        is_stable
    }

    /// Goes as far along `step` as the energy falls.
    fn take_step(&mut self, state: &mut State, former: Energy, aim: Aim) -> Result<Energy, Stop> {
        let slope = dot(&self.step, self.assembly.gradient());
        let noise = ROUNDING * (former.membrane + former.bending + (aim.pressure * former.volume).abs())
            + STRAIN_ROUNDING * (former.membrane * self.area).sqrt();
        let start = former.total(aim.pressure);
        let mut fraction = 1.0;
        for halving in 0..MOST_HALVINGS {
            self.trial.clone_from(state);
            self.assembly.advance(&mut self.trial, &self.step, fraction);
            let mut energy =
                if halving == 0 { self.linearise_trial(aim.pressure) } else { self.energy_of_trial() };
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

    /// Restarts at `state` with a larger shift, which shortens the next step. Only where wrinkles come and go: there the Hessian is a poor
    /// model one step ahead; elsewhere a larger shift does not help.
    fn shorten_step(&mut self, state: &State, aim: Aim) -> Option<Energy> {
        let (smallest_shift, shift) = (least_shift(aim.pressure), self.experience.shift);
        if !self.assembly.sheet.is_wrinkled() || shift > MOST_SHORTENED * smallest_shift {
            return None;
        }
        self.experience.shift = (60.0 * shift).max(6.0 * smallest_shift);
        Some(self.linearise(state, aim.pressure))
    }

    /// Displacement of the last equilibrium under a unit load on the sum of products of points with `parts`: g.H^-1 g,
    /// along the same sum.
    pub fn compliance(&mut self, parts: &[(usize, [f64; 3])]) -> f64 {
        let load = self.assembly.project(parts);
        let mut answer = load.clone();
        self.factor.solve(&mut answer, EXACT);
        dot(&load, &answer)
    }

    /// Triangles of its mesh.
    pub fn triangles(&self) -> usize {
        self.assembly.sheet.pieces.len()
    }

    /// Numbers that the Cholesky factor keeps.
    #[cfg(test)]
    pub(crate) fn factor_size(&self) -> usize {
        self.factor.size()
    }
}
