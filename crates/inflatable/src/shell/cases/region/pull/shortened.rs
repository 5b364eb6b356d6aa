//! One mesh at one stroke after another.

use crate::shell::assembly::State;
use crate::shell::cases::region::pull::bars::HeldNodes;
use crate::shell::solver::{Aim, Solver, Stop};

/// The free stroke is looked for from one stroke to the next by this factor and by this part of the distance of the bars, up to the longest part.
const GROWTH: f64 = 1.3;
const LEAST_STEP: f64 = 2e-3;
const LONGEST: f64 = 0.9;
/// Halvings of the way to a stroke where no equilibrium is reached.
const MOST_HALVINGS: u32 = 6;
/// Accuracy of the stroke under a force, by the distance of the bars, and the most trials for it.
const STROKE_ERROR: f64 = 1e-5;
const MOST_TRIALS: u32 = 12;

/// The equilibrium at one stroke; lengths by the chamber's width, forces by that and the stretching stiffness.
#[derive(Clone)]
pub(super) struct Settled {
    pub(super) stroke: f64,
    pub(super) force: f64,
    /// Of one sheet.
    pub(super) energy: f64,
    pub(super) state: State,
}

/// A mesh between bars, and its equilibria.
pub(super) struct Shortened {
    aim: Aim,
    nodes: HeldNodes,
    /// In the order of strokes; the first has none.
    settled: Vec<Settled>,
}

impl Shortened {
    /// A mesh that is in equilibrium in `blocked`, without a stroke.
    pub(super) fn new(solver: &mut Solver, aim: Aim, nodes: HeldNodes, blocked: State) -> Self {
        let mut shortened = Self { aim, nodes, settled: Vec::new() };
        let _ = shortened.keep(solver, 0.0, blocked);
        shortened
    }

    /// Keeps the equilibrium `state` at a `stroke`.
    fn keep(&mut self, solver: &mut Solver, stroke: f64, state: State) -> Settled {
        let energy = solver.assembly.differentiate(&state, self.aim.pressure).total(self.aim.pressure);
        let settled = Settled { stroke, force: self.nodes.force(solver.assembly.forces()), energy, state };
        let index = self.settled.partition_point(|other| other.stroke < stroke);
        self.settled.insert(index, settled.clone());
        settled
    }

    /// Settles at `stroke` from a coarser mesh's shape there, or from the nearest stroke where that leads to no equilibrium.
    pub(super) fn start(&mut self, solver: &mut Solver, stroke: f64, mut state: State) -> Result<(), Stop> {
        self.nodes.place(&mut state, stroke);
        solver.is_rough = true;
        match solver.rest(&mut state, self.aim) {
            Ok(_) => drop(self.keep(solver, stroke, state)),
            Err(Stop::Cancelled) => return Err(Stop::Cancelled),
            Err(_) => drop(self.settle_at(solver, stroke)?),
        }
        Ok(())
    }

    /// The equilibrium at `stroke`, reached from the nearest known one in as few steps as lead there.
    pub(super) fn settle_at(&mut self, solver: &mut Solver, stroke: f64) -> Result<Settled, Stop> {
        let by_distance = self.settled.iter().map(|settled| ((settled.stroke - stroke).abs(), settled));
        let nearest = by_distance.min_by(|(a, _), (b, _)| a.total_cmp(b));
        let mut last = nearest.ok_or(Stop::Unstable)?.1.clone();
        let mut step = stroke - last.stroke;
        let mut halvings = 0;
        while last.stroke != stroke {
            let is_last = (stroke - last.stroke).abs() <= step.abs();
            let next = if is_last { stroke } else { last.stroke + step };
            let mut state = last.state.clone();
            self.nodes.shorten(&mut state, next - last.stroke);
            self.nodes.place(&mut state, next);
            match solver.rest(&mut state, self.aim) {
                Ok(_) => last = self.keep(solver, next, state),
                Err(stop) if stop == Stop::Cancelled || halvings == MOST_HALVINGS => return Err(stop),
                Err(_) => {
                    step /= 2.0;
                    halvings += 1;
                }
            }
        }
        Ok(last)
    }

    /// The stroke at which the force vanishes.
    pub(super) fn free_stroke(&mut self, solver: &mut Solver) -> Result<f64, Stop> {
        while let Some(last) = self.settled.last().filter(|last| last.force > 0.0) {
            let stroke = GROWTH * last.stroke + LEAST_STEP * self.nodes.distance;
            if stroke > LONGEST * self.nodes.distance {
                return Err(Stop::Unstable);
            }
            let _ = self.settle_at(solver, stroke)?;
        }
        self.stroke_of(solver, 0.0)
    }

    /// The stroke at which the force is `force`, between the known strokes of a larger and a smaller one; not a number where there are none.
    pub(super) fn stroke_of(&mut self, solver: &mut Solver, force: f64) -> Result<f64, Stop> {
        // Secants alone keep one end where the curve bends, so every other trial halves the way.
        let mut stroke = f64::NAN;
        for trial in 0..MOST_TRIALS {
            let index = self.settled.partition_point(|settled| settled.force >= force);
            let [Some(low), Some(high)] =
                [index.checked_sub(1), Some(index)].map(|end| self.settled.get(end?))
            else {
                return Ok(f64::NAN);
            };
            let way = high.stroke - low.stroke;
            stroke = low.stroke + way * (low.force - force) / (low.force - high.force);
            let trial_stroke = if trial % 2 == 0 { stroke } else { low.stroke + 0.5 * way };
            if way <= STROKE_ERROR * self.nodes.distance
                || trial_stroke <= low.stroke
                || trial_stroke >= high.stroke
            {
                break;
            }
            let _ = self.settle_at(solver, trial_stroke)?;
        }
        Ok(stroke)
    }
}
