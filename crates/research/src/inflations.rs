//! A V-actuator at many pressures: one continuation gives them all.
//!
//! The coarsest mesh is pressurised from flat and keeps its shape at each pressure; every finer mesh begins at each pressure from the
//! shape of the mesh before, or, where that leads nowhere, from its own shape at the pressure below.

use inflatable::shell::assembly::State;
use inflatable::shell::cases::{Fineness, ShellFault, VActuator, Value, Watch};
use inflatable::shell::mesh::Sizes;
use inflatable::shell::solver::{Continuation, Equilibrium, NewtonResult, Solver, Stop};

use crate::around::scaled_solver;

/// A V-actuator at one pressure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inflation {
    /// Angle phi at rest, rad.
    pub angle: Value,
    /// Volume of the whole actuator, m^3.
    pub volume: Value,
    /// d2U/dphi2 at rest, N m per rad, whole tube.
    pub stiffness: Value,
}

/// Parts into which the way between two pressures is cut where it cannot be gone at once.
const MOST_PARTS: u32 = 4;
/// Number of times that Newton's method may continue after its iterations are used up: thin sheets wrinkle, and wrinkles settle slowly.
const MOST_ROUNDS: u32 = 6;
/// Number of meshes used.
const MESHES: usize = 3;

/// Inflates a V-actuator from flat to each of `pressures` (Pa, rising), whatever the pressure in `case` is. `None` from the
/// first pressure on at which it has no equilibrium on one of its meshes.
///
/// The caller limits pressures, t/W and p W/Y: tables end a little beyond the limits of [`Tube`](inflatable::shell::cases::Tube).
///
/// # Errors
/// If it has no mesh, or is cancelled.
pub fn inflations(
    case: &VActuator,
    pressures: &[f64],
    fineness: Fineness,
    watch: &Watch,
) -> Result<Vec<Option<Inflation>>, ShellFault> {
    let modelled = case.modelled()?;
    let mut meshed = modelled.meshed(&Sizes::across(1.0, fineness.cells))?;
    let mut found: Vec<Vec<[f64; 3]>> = Vec::new();
    let mut below: Option<(Solver, Vec<State>)> = None;
    let units = case.tube.fabric.stretch / case.tube.width;
    let pressures: Vec<f64> = pressures.iter().map(|pressure| pressure / units).collect();
    for cut in 0..=fineness.cuts {
        if cut > 0 {
            meshed = meshed.refined()?;
        }
        let solver = scaled_solver(&case.tube, &meshed.mesh, modelled.supports(&meshed.mesh), watch)?;
        let mut run = Pressurised { solver, continuation: case.tube.continuation(), last: None };
        let mut states = Vec::new();
        let mut numbers = Vec::new();
        for (k, pressure) in pressures.iter().enumerate() {
            let start = match &mut below {
                Some((solver, states)) => match states.get(k) {
                    Some(state) => Some(solver.assembly.prolong(state, &run.solver.assembly)),
                    None => break,
                },
                None => None,
            };
            let reached = match run.to(*pressure, start) {
                Ok(equilibrium) => equilibrium,
                Err(Stop::Cancelled) => return Err(ShellFault::Cancelled),
                Err(_) => break,
            };
            numbers.push(modelled.measure(&mut run.solver, &meshed.mesh, &reached));
            states.push(reached.state);
            let count = |k: usize| f64::from(u32::try_from(k).unwrap_or(u32::MAX));
            let done = count(k + 1) / count(pressures.len());
            if let Some(progress) = watch.progress {
                let mesh = format!("mesh {} of {}", cut + 1, fineness.cuts + 1);
                progress(part(fineness.cuts - cut, done), &mesh);
            }
        }
        found.push(numbers);
        below = Some((run.solver, states));
    }
    let last: Vec<&Vec<[f64; 3]>> = found.iter().rev().take(MESHES).rev().collect();
    let energy = case.tube.energy();
    let at = |k: usize| {
        let meshes: Option<Vec<[f64; 3]>> = last.iter().map(|numbers| numbers.get(k).copied()).collect();
        let meshes = meshes.filter(|meshes| meshes.len() == MESHES)?;
        let value = |i: usize| Value::new([0, 1, 2].map(|mesh: usize| meshes[mesh][i]));
        Some(Inflation {
            angle: value(0),
            volume: value(1).scaled(case.tube.width.powi(3)),
            stiffness: value(2).scaled(energy),
        })
    };
    Ok((0..pressures.len()).map(at).collect())
}

/// One mesh on its way up.
struct Pressurised {
    solver: Solver,
    continuation: Continuation,
    last: Option<Equilibrium>,
}

impl Pressurised {
    /// Goes to `pressure`: from `start`, else from the last pressure, or the first time from flat.
    fn to(&mut self, pressure: f64, start: Option<State>) -> Result<Equilibrium, Stop> {
        if let Some(mut state) = start {
            match self.settle(&mut state, pressure) {
                Ok(rest) => return Ok(self.keep(pressure, state, rest)),
                Err(Stop::Cancelled) => return Err(Stop::Cancelled),
                Err(_) => {}
            }
        }
        let Some(last) = self.last.clone() else {
            let continuation = Continuation { last: pressure, ..self.continuation };
            let equilibrium = continuation.run(&mut self.solver, |_| {}).map_err(|broken| broken.why)?;
            self.last = Some(equilibrium.clone());
            return Ok(equilibrium);
        };
        match self.by_parts(&last, pressure, 1) {
            Ok(equilibrium) => Ok(equilibrium),
            Err(Stop::Cancelled) => Err(Stop::Cancelled),
            Err(_) => self.by_parts(&last, pressure, MOST_PARTS),
        }
    }

    /// From an equilibrium to `pressure` in equal ratios.
    fn by_parts(&mut self, from: &Equilibrium, pressure: f64, parts: u32) -> Result<Equilibrium, Stop> {
        let mut state = from.state.clone();
        let ratio = libm::pow(pressure / from.pressure, f64::from(parts).recip());
        let mut at = from.pressure;
        for _ in 1..parts {
            at *= ratio;
            let _ = self.settle(&mut state, at)?;
        }
        let rest = self.settle(&mut state, pressure)?;
        Ok(self.keep(pressure, state, rest))
    }

    fn settle(&mut self, state: &mut State, pressure: f64) -> Result<NewtonResult, Stop> {
        self.solver.rest_in_rounds(state, self.continuation.aim(pressure), MOST_ROUNDS)
    }

    fn keep(&mut self, pressure: f64, state: State, rest: NewtonResult) -> Equilibrium {
        let equilibrium = Equilibrium { pressure, state, rest };
        self.last = Some(equilibrium.clone());
        equilibrium
    }
}

/// The part of the work that is done when `left` finer meshes are left and this one is `done`.
fn part(left: usize, done: f64) -> f64 {
    (0.25 + 0.75 * done) * (0..left).fold(1.0, |part, _| part / 4.0)
}
