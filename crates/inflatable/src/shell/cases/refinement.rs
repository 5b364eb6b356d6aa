//! One case on a family of meshes: the coarsest pressurised from flat, each finer one begun from the shape before.

use crate::shell::assembly::{Assembly, Sheet, State, Supports};
use crate::shell::cases::fault::ShellFault;
use crate::shell::cases::tube::{MOST_STRETCHED, Tube};
use crate::shell::cases::value::Value;
use crate::shell::contact::{Contact, Obstacle};
use crate::shell::mesh::{Mesh, Meshed};
use crate::shell::solver::{Broken, Effort, Equilibrium, Solver, Stop};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Receives the completed part, 0 to 1, and the current step.
pub type OnProgress<'a> = &'a dyn Fn(f64, &str);

/// Observer of a shell's computation, which may cancel it.
#[derive(Clone, Default)]
pub struct Watch<'a> {
    /// Receives the progress.
    pub progress: Option<OnProgress<'a>>,
    /// Raised by another thread to end at the next Newton step.
    pub cancel: Arc<AtomicBool>,
    /// Whether a large computation is refused. Callers compare its size with their limit before they begin.
    pub is_bounded: bool,
}

impl Watch<'_> {
    /// Runs `work`, a part of this computation that lasts from `start` to `end` of it, 0 to 1, and reports its own progress as 0 to 1.
    pub fn run_part<T>(&self, [start, end]: [f64; 2], work: impl FnOnce(&Watch<'_>) -> T) -> T {
        let report = |part: f64, step: &str| self.tell(start + (end - start) * part, step);
        work(&Watch { progress: self.progress.is_some().then_some(&report), ..self.clone() })
    }

    pub(crate) fn tell(&self, part: f64, step: &str) {
        if let Some(progress) = self.progress {
            progress(part, step);
        }
    }
}

/// Meshes, effort and residuals behind the numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Evidence {
    /// Unknowns of each mesh, coarse to fine.
    pub unknowns: Vec<usize>,
    /// The whole effort on each mesh: pressurising it, measuring its numbers, and starting the finer one. Where several shapes were computed,
    /// those of the first come first.
    pub efforts: Vec<Effort>,
    /// The finest mesh's residual by p W^2.
    pub residual: f64,
}

impl Evidence {
    /// The evidence of two computations on the same meshes, this one after `earlier`.
    pub(crate) fn join(&self, earlier: &Self) -> Self {
        let efforts = earlier.efforts.iter().chain(&self.efforts).copied().collect();
        Self { unknowns: earlier.unknowns.clone(), efforts, residual: self.residual.max(earlier.residual) }
    }
}

/// How the coarsest mesh of a sheet that bears compression reaches its pressure. Pouches have two stable shapes at some pressures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LoadPath {
    /// The pressure rises from the flat sheet.
    FromFlat,
    /// It rises to [`OVERPRESSURE`] times itself and falls back.
    FromAbove,
}

/// A case to be run.
pub(crate) struct Family<'a> {
    pub(crate) tube: Tube,
    pub(crate) coarsest: Meshed,
    /// Number of times that its triangles are cut into four; at least 2.
    pub(crate) cuts: usize,
    /// The supports of a mesh; it may change the sheet's response to compression.
    pub(crate) hold: &'a dyn Fn(&Meshed, &mut Sheet) -> Supports,
    pub(crate) obstacles: &'a [Obstacle],
    pub(crate) approach: LoadPath,
    /// Newton steps on one mesh at most.
    pub(crate) most_steps: u32,
}

/// An equilibrium beside that at the pressure alone: with something pressed into it.
#[derive(Clone, Debug)]
pub(crate) struct Indented {
    pub(crate) state: State,
    pub(crate) contact: Option<Contact>,
}

impl Indented {
    /// A start for the same on the finer mesh.
    fn carried(&self, coarse: &mut Assembly, mesh: &Mesh, finer: &Assembly) -> Self {
        let state = coarse.prolong(&self.state, finer);
        let ends = mesh.edges.iter().map(|edge| edge.ends);
        Self { state, contact: self.contact.as_ref().map(|contact| contact.carried(finer, ends)) }
    }
}

/// The numbers of the last three meshes, coarse to fine, as values. Of fewer meshes the finest counts for those that are missing.
pub(super) fn values<const N: usize>(numbers: &[[f64; N]]) -> [Value; N] {
    std::array::from_fn(|k| Value::new(std::array::from_fn(|mesh| numbers[mesh.min(numbers.len() - 1)][k])))
}

impl<'a> Family<'a> {
    /// A tube that is pressurised from flat, without obstacles and with any number of steps.
    pub(crate) fn new(
        tube: Tube,
        coarsest: Meshed,
        cuts: usize,
        hold: &'a dyn Fn(&Meshed, &mut Sheet) -> Supports,
    ) -> Self {
        Self {
            tube,
            coarsest,
            cuts,
            hold,
            obstacles: &[],
            approach: LoadPath::FromFlat,
            most_steps: u32::MAX,
        }
    }

    /// Runs the case; `measure` takes its numbers from each mesh's equilibrium, and leaves those beside it, which the next mesh is given as
    /// starts.
    pub(crate) fn run<const N: usize>(
        self,
        watch: &Watch,
        mut measure: impl FnMut(
            &mut Solver,
            &Meshed,
            &Equilibrium,
            &mut Vec<Indented>,
        ) -> Result<[f64; N], ShellFault>,
    ) -> Result<([Value; N], Evidence), ShellFault> {
        let continuation = self.tube.continuation();
        let mut evidence = Evidence::default();
        let (mut measured, mut indented) = (Vec::new(), Vec::<Indented>::new());
        let mut meshed = self.coarsest.clone();
        let mut solver = self.solver(&meshed, watch)?;
        let mut equilibrium = self.pressurise(&mut solver, watch)?;
        for cut in 0..=self.cuts {
            if cut > 0 {
                let refined = meshed.refined()?;
                let mut finer = self.solver(&refined, watch)?;
                equilibrium = self.carry(&mut solver, &mut finer, &equilibrium, watch)?;
                for one in &mut indented {
                    *one = one.carried(&mut solver.assembly, &meshed.mesh, &finer.assembly);
                }
                evidence.efforts.push(solver.effort);
                (meshed, solver) = (refined, finer);
            }
            evidence.unknowns.push(solver.assembly.unknowns());
            evidence.residual = equilibrium.rest.residual / continuation.last;
            if cut + 3 > self.cuts {
                measured.push(measure(&mut solver, &meshed, &equilibrium, &mut indented)?);
            }
            watch.tell(part(self.cuts - cut), &format!("mesh {} of {}", cut + 1, self.cuts + 1));
        }
        evidence.efforts.push(solver.effort);
        Ok((values(&measured), evidence))
    }

    pub(super) fn solver(&self, meshed: &Meshed, watch: &Watch) -> Result<Solver, ShellFault> {
        let mesh = &meshed.mesh;
        let mut sheet = Sheet::new(mesh, self.tube.scaled());
        let supports = (self.hold)(meshed, &mut sheet);
        let mut solver =
            Solver::new(sheet, supports).ok_or(ShellFault::TooLarge { triangles: mesh.triangles.len() })?;
        if !self.obstacles.is_empty() {
            solver.contact = Some(Contact::new(&solver.assembly, self.obstacles.to_vec()));
        }
        solver.cancel = Arc::clone(&watch.cancel);
        solver.most_steps = self.most_steps;
        Ok(solver)
    }

    /// From flat to the pressure of the case, by its approach.
    pub(super) fn pressurise(&self, solver: &mut Solver, watch: &Watch) -> Result<Equilibrium, ShellFault> {
        if solver.assembly.sheet.is_wrinkled() {
            let flat = solver.assembly.sheet.flat();
            return self.let_down(solver, flat, WELL_STRETCHED);
        }
        let mut continuation = self.tube.continuation();
        let highest = (OVERPRESSURE * continuation.last).min(MOST_STRETCHED);
        if self.approach == LoadPath::FromAbove {
            continuation.last = highest;
        }
        let log_range = libm::log(continuation.last / continuation.first).max(1e-9);
        let report = |equilibrium: &Equilibrium| {
            watch.tell(
                part(self.cuts) * libm::log(equilibrium.pressure / continuation.first) / log_range,
                "from flat",
            );
        };
        let equilibrium =
            continuation.run(solver, report).map_err(|broken| self.fault(broken, solver.triangles()))?;
        match self.approach {
            LoadPath::FromFlat => Ok(equilibrium),
            LoadPath::FromAbove => self.let_down(solver, equilibrium.state, highest),
        }
    }

    /// From `state` to the equilibrium at the pressure `highest` or that of the case, if that is higher, and down to that of the case.
    fn let_down(
        &self,
        solver: &mut Solver,
        mut state: State,
        highest: f64,
    ) -> Result<Equilibrium, ShellFault> {
        // Each step lowers the pressure by a ratio. A step that fails is tried again from the last equilibrium with a ratio nearer
        // to 1, and the next ones grow again.
        let continuation = self.tube.continuation();
        let mut pressure = continuation.last.max(highest);
        let (mut last_rest, mut ratio) = (None::<Equilibrium>, DOWN);
        loop {
            match solver.rest_in_rounds(&mut state, continuation.aim(pressure), MOST_ROUNDS) {
                Ok(rest) => {
                    if pressure <= continuation.last {
                        return Ok(Equilibrium { pressure, state, rest });
                    }
                    last_rest = Some(Equilibrium { pressure, state: state.clone(), rest });
                    ratio = (ratio * ratio).max(DOWN);
                }
                Err(why) => {
                    ratio = ratio.sqrt();
                    let Some(last) =
                        last_rest.as_ref().filter(|_| why != Stop::Cancelled && ratio < LEAST_DOWN)
                    else {
                        let last = last_rest.map(Box::new);
                        return Err(self.fault(Broken { pressure, why, last }, solver.triangles()));
                    };
                    state.clone_from(&last.state);
                }
            }
            let start_pressure = last_rest.as_ref().map_or(pressure, |last_rest| last_rest.pressure);
            pressure = (start_pressure * ratio).max(continuation.last);
        }
    }

    fn fault(&self, Broken { pressure, why: reason, last }: Broken, triangles: usize) -> ShellFault {
        if reason == Stop::Cancelled {
            return ShellFault::Cancelled;
        }
        let first = self.tube.continuation().first;
        let last = last.map_or(0.0, |equilibrium| equilibrium.pressure / first);
        ShellFault::Stopped { why: reason, at: pressure / first, last, triangles }
    }

    /// The equilibrium of `fine` that begins from that of `coarse`. Where the coarse shape at full pressure is too rough a start,
    /// `coarse` is let down step by step until its shape does, and `fine` is pressurised from there; from flat at last.
    fn carry(
        &self,
        coarse: &mut Solver,
        fine: &mut Solver,
        equilibrium: &Equilibrium,
        watch: &Watch,
    ) -> Result<Equilibrium, ShellFault> {
        let continuation = self.tube.continuation();
        if fine.assembly.sheet.is_wrinkled() {
            let state = coarse.assembly.prolong(&equilibrium.state, &fine.assembly);
            return match self.let_down(fine, state, WELL_STRETCHED) {
                Err(ShellFault::Stopped { .. }) => self.pressurise(fine, watch),
                found => found,
            };
        }
        let (mut lower, mut pressure) = (equilibrium.state.clone(), continuation.last);
        for _ in 0..MOST_LET_DOWN {
            let state = coarse.assembly.prolong(&lower, &fine.assembly);
            fine.is_rough = true;
            match continuation.run_from(fine, state, pressure, |_| {}) {
                Ok(equilibrium) => return Ok(equilibrium),
                // Not even the first equilibrium was found: a smaller first pressure may help.
                Err(Broken { last: None, why, .. }) if why != Stop::Cancelled => {}
                Err(broken) => return Err(self.fault(broken, fine.triangles())),
            }
            pressure /= LET_DOWN;
            if coarse.rest(&mut lower, continuation.aim(pressure)).is_err() {
                break;
            }
        }
        self.pressurise(fine, watch)
    }
}

/// p W/Y from which a sheet that bears no compression is let down: from flat and from a coarser mesh it comes to rest there within some ten
/// steps, and at a hundredth of it hardly at all.
const WELL_STRETCHED: f64 = 0.02;
/// Pressure from which a sheet that bears compression is let down, by that of the case; at most that of [`MOST_STRETCHED`].
const OVERPRESSURE: f64 = 4.0;
/// Factor of pressure from one equilibrium to the next on the way down, and the one nearest to 1.
const DOWN: f64 = 0.4;
const LEAST_DOWN: f64 = 0.95;
/// Rounds of Newton's method for one of them.
const MOST_ROUNDS: u32 = 4;

/// Number of times that the pressure of a coarse sheet is lowered to start a finer one, and the factor of pressure each time.
const MOST_LET_DOWN: usize = 4;
const LET_DOWN: f64 = 2.0;

/// The part of the work that is done when `finer_meshes` finer meshes are left: each costs about four times the one before.
pub(crate) fn part(finer_meshes: usize) -> f64 {
    (0..finer_meshes).fold(1.0, |part, _| part / 4.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::RefCell;

    #[test]
    fn the_progress_of_nested_parts_rises_from_0_to_1() {
        let parts = RefCell::new(Vec::new());
        let record = |part: f64, _: &str| parts.borrow_mut().push(part);
        let watch = Watch { progress: Some(&record), ..Watch::default() };
        let report_ends = |watch: &Watch| [0.0, 1.0].iter().for_each(|part| watch.tell(*part, "step"));
        watch.run_part([0.0, 0.5], |watch| {
            watch.run_part([0.0, 0.5], report_ends);
            watch.run_part([0.5, 1.0], report_ends);
        });
        watch.run_part([0.5, 1.0], report_ends);
        assert_eq!(*parts.borrow(), [0.0, 0.25, 0.25, 0.5, 0.5, 1.0]);
        assert!(Watch::default().run_part([0.0, 0.5], |watch| watch.progress.is_none()));
    }
}
