//! The sealing programs: of every star the inner loop, then the outer loop.

use crate::design::{Design, PlacedStar};
use crate::geom::{Path, Point};
use crate::plan::pieces::Cuts;
use crate::plan::{Height, Program, Purpose, Ramp, Scope, SeamReport, Step};
use crate::spec::{Machine, ProgramScope, Spec};

/// A sheet, and stars on it in the order of sealing: what one program covers.
pub(super) type Batch<'a> = (usize, Vec<&'a PlacedStar>);

/// What every program covers, by the spec's choice of one a star or one a sheet.
pub(super) fn batches(design: &Design, scope: ProgramScope) -> Vec<Batch<'_>> {
    match scope {
        ProgramScope::Star => design.stars.iter().map(|star| (star.sheet, vec![star])).collect(),
        ProgramScope::Sheet => {
            design.sheets.iter().map(|sheet| (sheet.index, design.nearest_first(sheet.index))).collect()
        }
    }
}

/// All sealing programs of `design`.
pub fn seal_programs(spec: &Spec, machine: &Machine, design: &Design) -> Vec<Program> {
    let batches = batches(design, spec.machine.program);
    batches.into_iter().map(|batch| seal_program(spec, machine, design, &batch)).collect()
}

fn seal_program(spec: &Spec, machine: &Machine, design: &Design, (sheet, stars): &Batch<'_>) -> Program {
    let cuts = Cuts::of_seal(spec, machine);
    let mut plan = Planner { spec, machine, steps: Vec::new(), seams: Vec::new(), cuts };
    plan.steps.push(Step::Height(Height::Park));
    plan.steps.push(Step::Heat(spec.seal.temperature));
    for star in stars {
        plan.star(design, star);
    }
    plan.steps.push(Step::Height(Height::Park));
    plan.steps.push(Step::Travel(Point::ORIGIN));
    let Planner { steps, seams, .. } = plan;
    Program::new(spec, machine, scope(Purpose::Seal, *sheet, stars), steps, seams)
}

/// What the program of a batch covers.
pub(super) fn scope(purpose: Purpose, sheet: usize, stars: &[&PlacedStar]) -> Scope {
    Scope { purpose, sheet, stars: stars.iter().map(|star| star.index).collect() }
}

struct Planner<'a> {
    spec: &'a Spec,
    machine: &'a Machine,
    steps: Vec<Step>,
    seams: Vec<SeamReport>,
    cuts: Cuts,
}

impl Planner<'_> {
    fn star(&mut self, design: &Design, placed: &PlacedStar) {
        let heights = &self.machine.process.heights;
        for seam in &design.part(placed).seams {
            let place = |path: Path| placed.placement.path(&path);
            let run = place(seam.run());
            let length = run.length();
            let (high, low) = (heights.travel.0, heights.contact.0);
            let down = self.ramp(&place(seam.lead_in(self.machine.process.ramp.0)), high, low);
            let up = self.ramp(&place(seam.lead_out(self.machine.process.ramp.0)), low, high);
            let time = (down.length() + length + up.length()) / self.spec.seal.speed.0;
            let Some(start) = down.pieces.first().map(crate::geom::Segment::start) else { continue };
            self.steps.extend([
                Step::Travel(start),
                Step::Height(Height::Travel),
                Step::Seam(self.seams.len()),
                Step::TouchDown(down),
                Step::Seal(self.cuts.pieces(&run)),
                Step::Lift(up),
            ]);
            let (star, side, overlap) = (placed.index, seam.side, seam.overlap);
            self.seams.push(SeamReport { star, side, length, overlap, time });
        }
    }

    /// A ramp along `path`. It is as slow as the seal all the way, so that the seam does not begin colder than it goes on.
    fn ramp(&self, path: &Path, from: f64, to: f64) -> Ramp {
        Ramp { pieces: self.cuts.pieces(path), from, to }
    }
}
