//! The trace programs: the frame of the pieces and all seams, at travel height, unheated and fast.

use crate::plan::marks::mark_steps;
use crate::plan::moves::Cuts;
use crate::plan::seal::{Batch, batches, scope};
use crate::plan::{Height, Program, Purpose, SeamList, Step};
use design::Design;
use geom::Point;
use sealed::{frame, laid_seams};
use spec::{Machine, Spec};

/// All trace programs of `design`, one for each sealing program.
pub fn trace_programs(spec: &Spec, machine: &Machine, design: &Design) -> Vec<Program> {
    let programs = batches(design, spec.machine.program);
    programs.iter().map(|batch| trace_program(spec, machine, design, batch)).collect()
}

fn trace_program(spec: &Spec, machine: &Machine, design: &Design, (sheet, placed): &Batch<'_>) -> Program {
    let pieces = &design.pieces(placed);
    let cuts = Cuts::of_trace(spec, machine);
    let mut steps = vec![Step::Height(Height::Park)];
    steps.extend(mark_steps(&design.stops(spec, *sheet)));
    let seams = laid_seams(pieces, machine.process.ramp.0);
    let sheet_frame = frame(pieces, &seams);
    for path in [&sheet_frame].into_iter().chain(seams.iter().map(|seam| &seam.run)) {
        let Some(start) = path.start() else { continue };
        steps.extend([Step::Travel(start), Step::Height(Height::Travel), Step::Trace(cuts.moves(path))]);
    }
    steps.extend([Step::Height(Height::Park), Step::Travel(Point::ORIGIN)]);
    let trace_scope = scope(Purpose::Trace, *sheet, placed);
    Program::new(spec, machine, trace_scope, steps, SeamList::default()).on_sheet_of(design)
}
