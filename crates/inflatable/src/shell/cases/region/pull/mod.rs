//! The pull of a chamber: two rigid bars hold seams of it, and are guided towards each other.
//!
//! With a **stroke** s the bars are s nearer to each other than on the flat sheet. The energy U(s) is that of the sheets between them and the
//! pressure, so the force with which the chamber pulls is F = -dU/ds: the sum of its forces on one bar. A bar neither turns nor moves sideways.

mod bars;
mod shortened;

use crate::shell::assembly::{Sheet, State, Supports};
use crate::shell::cases::actuator::Fineness;
use crate::shell::cases::fault::ShellFault;
use crate::shell::cases::refinement::{Evidence, Family, Indented, Watch};
use crate::shell::cases::region::answer::Wrinkles;
use crate::shell::cases::region::chambers::FlatRegion;
use crate::shell::cases::region::inflate::{load_parts, most_resolved, tube_of};
use crate::shell::cases::region::pressures::PartialPressure;
use crate::shell::cases::region::pull::bars::HeldNodes;
use crate::shell::cases::region::pull::shortened::Shortened;
use crate::shell::cases::region::supports::{SealedNodes, level};
use crate::shell::cases::tube::Tube;
use crate::shell::cases::value::Value;
use crate::shell::mesh::{FlatChamber, Meshed, scaled_line};
use crate::shell::solver::{Equilibrium, Solver, Stop};
use geom::Line;

/// Number of strokes of a curve.
pub const STROKES: usize = 9;
/// The numbers of one mesh: force and energy at each stroke, the stroke without a force, and that under the load.
const NUMBERS: usize = 2 * STROKES + 2;
const FREE: usize = 2 * STROKES;
const LOADED: usize = FREE + 1;

/// Two bars and what hangs on one of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pull {
    /// The bars on the flat sheet, m, along seams.
    pub bars: [Line; 2],
    /// A force that draws them apart, N, if its stroke is wanted.
    pub load: Option<f64>,
}

/// The force at one stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PullAtStroke {
    /// How much nearer to each other the bars are than on the flat sheet, m.
    pub stroke: f64,
    /// The force with which the chamber pulls there, N.
    pub force: Value,
    /// Energy of both sheets less the work of the pressure, J.
    pub energy: Value,
}

/// The pull of a chamber under pressure; both sheets, SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct PulledRegion {
    /// Force against stroke: from the flat distance, where the force is the blocked one, to the free stroke of the coarsest mesh.
    pub curve: Vec<PullAtStroke>,
    /// The stroke without a force, m.
    pub free_stroke: Value,
    /// The stroke under the load, m; `None` without one, and where it is more than the blocked force.
    pub loaded_stroke: Option<Value>,
    /// Treatment of wrinkles.
    pub wrinkles: Wrinkles,
    /// The evidence for these values.
    pub evidence: Evidence,
}

/// Pulls a chamber by two bars, on meshes of about the requested fineness.
///
/// Wrinkles are resolved where those of [`region`](super::region) are. They are averaged elsewhere, and where folds have no equilibrium.
///
/// # Errors
/// If the chamber is out of range, or has no stable equilibrium that keeps z = 0 a plane of symmetry.
pub fn pull(
    case: &FlatRegion,
    request: &Pull,
    fineness: Fineness,
    watch: &Watch,
) -> Result<PulledRegion, ShellFault> {
    let tube = tube_of(case)?;
    let resolved = PulledCase::new(case, request, tube, Wrinkles::Resolved);
    if tube.bendability() <= most_resolved(&case.chamber, tube.width) {
        match resolved.on_meshes(fineness, watch) {
            Err(ShellFault::Stopped { .. }) => {}
            answer => return answer,
        }
    }
    PulledCase { wrinkles: Wrinkles::Averaged, ..resolved }.on_meshes(fineness, watch)
}

/// A chamber between bars, lengths by its width and forces by its width and the stretching stiffness.
struct PulledCase {
    tube: Tube,
    wrinkles: Wrinkles,
    chamber: FlatChamber,
    partial: Vec<PartialPressure>,
    request: Pull,
}

impl PulledCase {
    fn new(case: &FlatRegion, Pull { bars, load }: &Pull, tube: Tube, wrinkles: Wrinkles) -> Self {
        let width = tube.width;
        let bars = bars.map(|bar| scaled_line(bar, 1.0 / width));
        let load = load.map(|force| force / (tube.fabric.stretch * width));
        Self {
            tube,
            wrinkles,
            chamber: case.chamber.in_units(width),
            partial: case.partial.iter().map(|part| part.in_units(width)).collect(),
            request: Pull { bars, load },
        }
    }

    fn on_meshes(&self, fineness: Fineness, watch: &Watch) -> Result<PulledRegion, ShellFault> {
        let (coarsest, _) = self.chamber.mesh(fineness.cells)?;
        let hold = |meshed: &Meshed, sheet: &mut Sheet| self.supports(meshed, sheet);
        let family = Family::new(self.tube, coarsest, fineness.cuts, &hold);
        let mut strokes: Option<[f64; STROKES]> = None;
        let (values, evidence) = family.run(watch, |solver, meshed, equilibrium, starts| {
            let blocked = self.blocked(solver, meshed, equilibrium);
            self.numbers(solver, blocked, &mut strokes, starts)
                .map_err(|stop| self.tube.stopped(stop, solver.triangles()))
        })?;
        Ok(self.answer(&values, evidence, &strokes.unwrap_or_default()))
    }

    /// Prepares a sheet, and holds its seams in the plane and the bars where they are.
    fn supports(&self, meshed: &Meshed, sheet: &mut Sheet) -> Supports {
        let sealed = SealedNodes::new(&self.chamber, &self.partial, meshed);
        let mut supports = level(&sealed, sheet);
        HeldNodes::new(&meshed.mesh, &sealed, self.request.bars).hold(&mut supports);
        self.wrinkles.prepare(sheet, &self.tube);
        load_parts(&sealed, sheet, &self.tube);
        supports
    }

    /// A mesh whose `equilibrium` without a stroke is known.
    fn blocked(&self, solver: &mut Solver, meshed: &Meshed, equilibrium: &Equilibrium) -> Shortened {
        let sealed = SealedNodes::new(&self.chamber, &self.partial, meshed);
        let nodes = HeldNodes::new(&meshed.mesh, &sealed, self.request.bars);
        let aim = self.tube.continuation().aim(equilibrium.pressure);
        Shortened::new(solver, aim, nodes, equilibrium.state.clone())
    }

    /// The numbers of one mesh, of which only the shape without a stroke is known. `starts` are the shapes of the coarser mesh at each of the
    /// `strokes`, and then those of this one. The coarsest mesh, which has none, chooses the strokes.
    fn numbers(
        &self,
        solver: &mut Solver,
        mut shortened: Shortened,
        strokes: &mut Option<[f64; STROKES]>,
        starts: &mut Vec<Indented>,
    ) -> Result<[f64; NUMBERS], Stop> {
        let strokes = if let Some(strokes) = strokes {
            *strokes
        } else {
            let free = shortened.free_stroke(solver)?;
            *strokes.insert(PARTS.map(|part| part * free))
        };
        let coarse: Vec<State> = starts.drain(..).map(|start| start.state).collect();
        for (stroke, state) in strokes.iter().zip(coarse).skip(1) {
            shortened.start(solver, *stroke, state)?;
        }
        let mut numbers = [f64::NAN; NUMBERS];
        for (k, stroke) in strokes.iter().enumerate() {
            let settled = shortened.settle_at(solver, *stroke)?;
            (numbers[k], numbers[STROKES + k]) = (settled.force, settled.energy);
            starts.push(Indented { state: settled.state, contact: None });
        }
        numbers[FREE] = shortened.free_stroke(solver)?;
        if let Some(load) = self.request.load {
            numbers[LOADED] = shortened.stroke_of(solver, load)?;
        }
        Ok(numbers)
    }

    fn answer(
        &self,
        values: &[Value; NUMBERS],
        evidence: Evidence,
        strokes: &[f64; STROKES],
    ) -> PulledRegion {
        let Tube { width, fabric, .. } = self.tube;
        let curve = strokes.iter().enumerate().map(|(k, stroke)| PullAtStroke {
            stroke: stroke * width,
            force: values[k].scaled(fabric.stretch * width),
            energy: values[STROKES + k].scaled(2.0 * self.tube.energy()),
        });
        let loaded = values[LOADED].scaled(width);
        PulledRegion {
            curve: curve.collect(),
            free_stroke: values[FREE].scaled(width),
            loaded_stroke: loaded.meshes.iter().all(|mesh| mesh.is_finite()).then_some(loaded),
            wrinkles: self.wrinkles,
            evidence,
        }
    }
}

/// Strokes by the free one, quadratic: at the flat distance the force falls fast.
const PARTS: [f64; STROKES] =
    [0.0, 1.0 / 64.0, 4.0 / 64.0, 9.0 / 64.0, 16.0 / 64.0, 25.0 / 64.0, 36.0 / 64.0, 49.0 / 64.0, 1.0];

#[cfg(test)]
mod tests;
