//! The sealing programs: piece after piece, seam after seam.

use crate::plan::moves::Cuts;
use crate::plan::ramps::without_crumbs;
use crate::plan::{Height, Program, Purpose, Ramp, Scope, SeamReport, Step};
use design::Design;
use geom::{Path, Point, Segment};
use sealed::{LaidSeam, PlacedPiece, laid_seams};
use spec::{Machine, ProgramScope, Spec};

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

/// The program that seals `seams_laid`, in their order.
pub fn seal_program(spec: &Spec, machine: &Machine, scope: Scope, seams_laid: &[LaidSeam]) -> Program {
    let cuts = Cuts::of_seal(spec, machine);
    let (high, low) = (machine.process.heights.travel.0, machine.process.heights.contact.0);
    // A ramp is as slow as the seal all the way, so that the seam does not begin colder than it goes on.
    let ramp = |path: &Path, from: f64, to: f64| {
        let pieces = without_crumbs(cuts.moves(path), spec);
        Ramp { pieces, from, to }
    };
    let mut steps = vec![Step::Height(Height::Park), Step::Heat(spec.seal.temperature)];
    let mut seams = Vec::new();
    for seam in seams_laid {
        let (down, up) = (ramp(&seam.lead_in, high, low), ramp(&seam.lead_out, low, high));
        let Some(start) = down.pieces.first().map(Segment::start) else { continue };
        let length = seam.run.length();
        let time = (down.length() + length + up.length()) / spec.seal.speed.0;
        steps.extend([
            Step::Travel(start),
            Step::Height(Height::Travel),
            Step::Seam(seams.len()),
            Step::TouchDown(down),
            Step::Seal(cuts.moves(&seam.run)),
            Step::Lift(up),
        ]);
        seams.push(SeamReport { name: seam.name.clone(), length, overlap: seam.overlap, time });
    }
    steps.extend([Step::Height(Height::Park), Step::Travel(Point::ORIGIN)]);
    Program::new(spec, machine, scope, steps, seams)
}
