//! The sealing programs: piece after piece, seam after seam.

use crate::design::Design;
use crate::plan::pieces::Cuts;
use crate::plan::ramps::without_crumbs;
use crate::plan::{Height, Program, Purpose, Ramp, Scope, SeamReport, Step};
use crate::shape::{LaidSeam, PlacedPiece, laid_seams};
use crate::spec::{Machine, ProgramScope, Spec};
use inflatable::geom::{Path, Point, Segment};

/// A sheet, and pieces on it in the order of sealing: the content of one program.
pub(super) type Batch<'a> = (usize, Vec<PlacedPiece<'a>>);

/// The pieces of every program, by the spec's choice of one a star or one a sheet.
pub(super) fn batches(design: &Design, scope: ProgramScope) -> Vec<Batch<'_>> {
    match scope {
        ProgramScope::Piece => {
            design.placed().iter().map(|placed| (placed.sheet, design.pieces(&[placed]))).collect()
        }
        ProgramScope::Sheet => {
            let pieces = |sheet: usize| design.pieces(&design.nearest_first(sheet));
            design.sheets.iter().map(|sheet| (sheet.index, pieces(sheet.index))).collect()
        }
    }
}

/// All sealing programs of `design`.
pub fn seal_programs(spec: &Spec, machine: &Machine, design: &Design) -> Vec<Program> {
    let program = |(sheet, pieces): Batch<'_>| {
        let seams = laid_seams(&pieces, machine.process.ramp.0);
        seal_program(spec, machine, scope(Purpose::Seal, sheet, &pieces), &seams)
    };
    batches(design, spec.machine.program).into_iter().map(program).collect()
}

/// The scope of a batch's program.
pub(super) fn scope(purpose: Purpose, sheet: usize, pieces: &[PlacedPiece<'_>]) -> Scope {
    Scope { purpose, sheet, pieces: pieces.iter().map(|piece| piece.name.clone()).collect() }
}

/// The program that seals `seams`, in their order.
pub fn seal_program(spec: &Spec, machine: &Machine, scope: Scope, seams: &[LaidSeam]) -> Program {
    let mut plan = Planner {
        spec,
        machine,
        steps: vec![Step::Height(Height::Park), Step::Heat(spec.seal.temperature)],
        seams: Vec::new(),
        cuts: Cuts::of_seal(spec, machine),
    };
    for seam in seams {
        plan.seam(seam);
    }
    plan.steps.push(Step::Height(Height::Park));
    plan.steps.push(Step::Travel(Point::ORIGIN));
    let Planner { steps, seams, .. } = plan;
    Program::new(spec, machine, scope, steps, seams)
}

struct Planner<'a> {
    spec: &'a Spec,
    machine: &'a Machine,
    steps: Vec<Step>,
    seams: Vec<SeamReport>,
    cuts: Cuts,
}

impl Planner<'_> {
    fn seam(&mut self, seam: &LaidSeam) {
        let heights = &self.machine.process.heights;
        let length = seam.run.length();
        let (high, low) = (heights.travel.0, heights.contact.0);
        let down = self.ramp(&seam.lead_in, high, low);
        let up = self.ramp(&seam.lead_out, low, high);
        let time = (down.length() + length + up.length()) / self.spec.seal.speed.0;
        let Some(start) = down.pieces.first().map(Segment::start) else { return };
        self.steps.extend([
            Step::Travel(start),
            Step::Height(Height::Travel),
            Step::Seam(self.seams.len()),
            Step::TouchDown(down),
            Step::Seal(self.cuts.pieces(&seam.run)),
            Step::Lift(up),
        ]);
        self.seams.push(SeamReport { name: seam.name.clone(), length, overlap: seam.overlap, time });
    }

    /// A ramp along `path`. It is as slow as the seal all the way, so that the seam does not begin colder than it goes on.
    fn ramp(&self, path: &Path, from: f64, to: f64) -> Ramp {
        Ramp { pieces: without_crumbs(self.cuts.pieces(path), self.spec), from, to }
    }
}
