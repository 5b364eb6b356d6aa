//! One equilibrium: Newton's method on the energy, with the full Hessian.

use crate::numerics::dot;
use crate::shell::assembly::{Assembly, Compression, Energy, Sheet, State, Supports, Tangent};
use crate::shell::contact::{Contact, ContactError};
use crate::shell::solver::displacement_control::{ControlledSolve, DisplacementControl};
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
/// Accuracy of a step, relative: near an equilibrium each leaves about a thousandth of the residual.
const STEP_ACCURACY: f64 = 1e-6;
/// Halvings of a step.
const MOST_HALVINGS: u32 = 12;
/// Part of the energy's promised fall that must come.
const ARMIJO: f64 = 1e-4;
/// Largest shift over the least one: the smallest triangles at a sharp rim have a millionth of W^2, and are as stiff as any.
const MOST_SHIFT: f64 = 1e14;
/// Shift over the least one from which on no shorter step is tried.
const MOST_SHORTENED: f64 = 1e8;
/// Part of the energy that a step of a rough state gains at least, for the next one to be taken alike.
const ROUGH: f64 = 1e-3;
/// Rounding of a sum of energies, relative to its largest part.
const ROUNDING: f64 = 1e-14;
/// Rounding of a strain, which is a difference of squares of order one: sheets that are hardly stretched feel it.
const STRAIN_ROUNDING: f64 = 1e-15;

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

/// Finds equilibria of one sheet.
pub struct Solver {
    /// Sums over its triangles.
    pub assembly: Assembly,
    /// Its contact, if there is any.
    pub contact: Option<Contact>,
    /// A constraint besides its supports.
    pub lever: Option<DisplacementControl>,
    held: ControlledSolve,
    /// The lever's multiplier at the last equilibrium: forces + multiplier c = 0.
    pub multiplier: f64,
    pub(super) factor: Factor,
    step: Vec<f64>,
    /// Contribution of a shift to each unknown's diagonal.
    springs: Vec<f64>,
    /// The sheet's flat area.
    area: f64,
    shift: f64,
    trial: State,
    /// Effort of all solves together.
    pub effort: Effort,
    /// Raised by another thread to stop at the next step.
    pub cancel: Arc<AtomicBool>,
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
            shift: 0.0,
            effort: Effort::default(),
            cancel: Arc::default(),
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
        let found = self.approach(state, aim)?;
        if self.compute(0.0) && self.factor.is_confirmed() { Ok(found) } else { Err(Stop::Unstable) }
    }

    /// As [`Solver::settle`], whether the equilibrium is stable or not.
    fn approach(&mut self, state: &mut State, aim: Aim) -> Result<NewtonResult, Stop> {
        let found = self.iterate(state, aim);
        self.is_rough = false;
        found
    }

    fn iterate(&mut self, state: &mut State, aim: Aim) -> Result<NewtonResult, Stop> {
        let mut energy = self.linearise(state, aim.pressure);
        let most = if self.may_snap { MOST_TO_SNAP } else { MOST_ITERATIONS };
        for _ in 0..most {
            if self.cancel.load(Ordering::Relaxed) {
                return Err(Stop::Cancelled);
            }
            let residual = self.residual();
            if residual <= aim.tolerance && self.shift == 0.0 && !self.is_rough {
                return Ok(NewtonResult { energy, residual });
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

    /// As [`Solver::settle`], with contact: rounds until no point penetrates.
    ///
    /// # Errors
    /// The reason of the stop; `state` is then the last shape.
    pub fn rest(&mut self, state: &mut State, aim: Aim) -> Result<NewtonResult, Stop> {
        let Some(contact) = &mut self.contact else { return self.settle(state, aim) };
        contact.stiffness = contact.floor.max(CONTACT * aim.pressure);
        let mut before = ContactError { penetration: f64::INFINITY, change: f64::INFINITY, largest: 0.0 };
        let mut is_near = false;
        for _ in 0..MOST_ROUNDS {
            let rest = if is_near {
                self.settle(state, aim)?
            } else {
                self.approach(state, Aim { tolerance: LOOSE * aim.tolerance, ..aim })?
            };
            let Some(contact) = &mut self.contact else { return Ok(rest) };
            let misfit = contact.keep(state);
            let fits = |factor: f64| {
                misfit.penetration <= factor * PENETRATION
                    && misfit.change <= factor * CHANGE * misfit.largest
            };
            if is_near && fits(1.0) {
                return Ok(rest);
            }
            is_near = fits(NEAR);
            let is_slow = misfit.penetration > PENETRATION.max(before.penetration / 4.0)
                || misfit.change > (CHANGE * misfit.largest).max(before.change / 4.0);
            if is_slow && contact.stiffness < STIFFEST * aim.pressure {
                contact.stiffness *= 4.0;
            }
            before = misfit;
        }
        Err(Stop::Contact)
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

    /// Factors the Hessian; false if it is not positive definite where the lever holds.
    fn compute(&mut self, shift: f64) -> bool {
        self.effort.factors += 1;
        if !self.factor.compute(self.assembly.hessian().2, shift, &self.springs) {
            return false;
        }
        let Some(lever) = &self.lever else { return true };
        match lever.hold(&self.assembly, &mut self.factor) {
            Some(held) => self.held = held,
            None => return false,
        }
        true
    }

    /// The norm of the forces without the constraint's part, whose multiplier it keeps.
    fn residual(&mut self) -> f64 {
        let gradient = self.assembly.gradient();
        let Some(lever) = &self.lever else { return dot(gradient, gradient).sqrt() };
        self.multiplier = -dot(&lever.row, gradient) / dot(&lever.row, &lever.row);
        let left = lever.row.iter().zip(gradient).map(|(c, g)| g + self.multiplier * c);
        left.map(|x| x * x).sum::<f64>().sqrt()
    }

    /// Moves an equilibrium to where the lever's function is larger by `by`, along the sheet's compliance.
    pub fn pull(&mut self, state: &mut State, aim: Aim, by: f64) -> bool {
        let _ = self.linearise(state, aim.pressure);
        let is_stable = self.compute(0.0);
        if is_stable && self.lever.is_some() {
            self.assembly.advance(state, &self.held.answer, by / self.held.gives);
        }
        is_stable
    }

    /// Writes a direction of descent to `step`, and its shift to `shift`.
    fn find_step(&mut self, aim: Aim) -> Result<(), Stop> {
        let least = 0.01 * aim.pressure;
        self.shift /= 6.0;
        if self.shift < least {
            self.shift = 0.0;
        }
        while !self.compute(self.shift) {
            self.shift = (4.0 * self.shift).max(least);
            if self.shift > MOST_SHIFT * least {
                self.shift = 0.0;
                return Err(Stop::Shift);
            }
        }
        for (step, slope) in self.step.iter_mut().zip(self.assembly.gradient()) {
            *step = -slope;
        }
        self.factor.solve(&mut self.step, STEP_ACCURACY);
        if let Some(lever) = &self.lever {
            let _ = lever.constrain(&self.assembly, &self.held, &mut self.step);
        }
        Ok(())
    }

    /// Goes as far along `step` as the energy falls.
    fn take_step(&mut self, state: &mut State, before: Energy, aim: Aim) -> Result<Energy, Stop> {
        let slope = dot(&self.step, self.assembly.gradient());
        let noise = ROUNDING * (before.membrane + before.bending + (aim.pressure * before.volume).abs())
            + STRAIN_ROUNDING * (before.membrane * self.area).sqrt();
        let start = before.total(aim.pressure);
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
        let least = 0.01 * aim.pressure;
        let comes_and_goes = matches!(self.assembly.sheet.compression, Compression::Wrinkled(_));
        if !comes_and_goes || self.shift > MOST_SHORTENED * least {
            return None;
        }
        self.shift = (60.0 * self.shift).max(6.0 * least);
        Some(self.linearise(state, aim.pressure))
    }

    /// Solves with the unshifted Hessian of the last equilibrium.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        self.factor.solve(rhs, EXACT);
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
