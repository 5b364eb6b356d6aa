//! A V-actuator at many pressures: one continuation gives them all.
//!
//! The coarsest mesh is pressurised from flat and keeps its shape at each pressure; every finer mesh begins at each pressure from the
//! shape of the mesh before, or, where that leads nowhere, from its own shape at the pressure below.

use inflatable::shell::assembly::State;
use inflatable::shell::cases::{Fineness, ShellFault, Tube, VActuator, Value, Watch};
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
/// The caller limits pressures, t/W and p W/Y: tables end a little beyond the limits of [`Tube`].
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
    let mut meshed = modelled.meshed(&Sizes::for_tube(1.0, fineness.cells))?;
    let mut levels: Vec<Vec<[f64; 3]>> = Vec::new();
    let mut coarser: Option<(Solver, Vec<State>)> = None;
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
            let start = match &mut coarser {
                Some((solver, states)) => match states.get(k) {
                    Some(state) => Some(solver.assembly.prolong(state, &run.solver.assembly)),
                    None => break,
                },
                None => None,
            };
            let equilibrium = match run.pressurise(*pressure, start) {
                Ok(equilibrium) => equilibrium,
                Err(Stop::Cancelled) => return Err(ShellFault::Cancelled),
                Err(_) => break,
            };
            numbers.push(modelled.measure(&mut run.solver, &meshed.mesh, &equilibrium));
            states.push(equilibrium.state);
            #[expect(clippy::cast_precision_loss, reason = "a few dozen pressures")]
            let progress_here = (k + 1) as f64 / pressures.len() as f64;
            if let Some(progress) = watch.progress {
                let mesh = format!("mesh {} of {}", cut + 1, fineness.cuts + 1);
                progress(work_part(fineness.cuts - cut, progress_here), &mesh);
            }
        }
        levels.push(numbers);
        coarser = Some((run.solver, states));
    }
    Ok((0..pressures.len()).map(|k| inflation(&case.tube, &levels, k)).collect())
}

/// The inflation at pressure `k`, by the last meshes of `levels`; `None` where one of them has no equilibrium.
fn inflation(tube: &Tube, levels: &[Vec<[f64; 3]>], k: usize) -> Option<Inflation> {
    let last = levels.get(levels.len().checked_sub(MESHES)?..)?;
    let meshes: Vec<[f64; 3]> = last.iter().map(|numbers| numbers.get(k).copied()).collect::<Option<_>>()?;
    let [angle, volume, stiffness] =
        [0, 1, 2].map(|number: usize| Value::new([0, 1, 2].map(|mesh: usize| meshes[mesh][number])));
    Some(Inflation {
        angle,
        volume: volume.scaled(tube.width.powi(3)),
        stiffness: stiffness.scaled(tube.energy()),
    })
}

/// One mesh on its way up.
struct Pressurised {
    solver: Solver,
    continuation: Continuation,
    last: Option<Equilibrium>,
}

impl Pressurised {
    /// Goes to `pressure`: from `start`, else from the last pressure, or the first time from flat.
    fn pressurise(&mut self, pressure: f64, start: Option<State>) -> Result<Equilibrium, Stop> {
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
    fn by_parts(&mut self, start: &Equilibrium, pressure: f64, parts: u32) -> Result<Equilibrium, Stop> {
        let mut state = start.state.clone();
        let ratio = libm::pow(pressure / start.pressure, f64::from(parts).recip());
        let mut step = start.pressure;
        for _ in 1..parts {
            step *= ratio;
            let _ = self.settle(&mut state, step)?;
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

/// The part of the work that is done when `finer_meshes` are left and this one is done up to `progress`.
fn work_part(finer_meshes: usize, progress: f64) -> f64 {
    (0.25 + 0.75 * progress) * (0..finer_meshes).fold(1.0, |part, _| part / 4.0)
}
