//! The trace programs: the frame of the part and all paths, at travel height, unheated and fast.

use crate::design::{Design, PlacedStar};
use crate::geom::{Bounds, Line, Path, Point, Segment};
use crate::plan::pieces::Cuts;
use crate::plan::seal::{Batch, batches, scope};
use crate::plan::{Height, Program, Purpose, Step};
use crate::spec::{Machine, Spec};

/// All trace programs of `design`, one for each sealing program.
pub fn trace_programs(spec: &Spec, machine: &Machine, design: &Design) -> Vec<Program> {
    let batches = batches(design, spec.machine.program);
    batches.into_iter().map(|batch| trace_program(spec, machine, design, &batch)).collect()
}

fn trace_program(spec: &Spec, machine: &Machine, design: &Design, (sheet, stars): &Batch<'_>) -> Program {
    let cuts = Cuts::of_trace(spec, machine);
    let mut steps = vec![Step::Height(Height::Park)];
    let mut follow = |path: &Path| {
        let Some(start) = path.start() else { return };
        steps.extend([Step::Travel(start), Step::Height(Height::Travel), Step::Trace(cuts.pieces(path))]);
    };
    follow(&frame(design, stars, machine.process.ramp.0));
    for placed in stars {
        for seam in &design.part(placed).seams {
            follow(&placed.placement.path(&seam.run()));
        }
    }
    steps.push(Step::Height(Height::Park));
    steps.push(Step::Travel(Point::ORIGIN));
    Program::new(spec, machine, scope(Purpose::Trace, *sheet, stars), steps, Vec::new())
}

/// The rectangle around everything that the sealing program does to the fabric.
fn frame(design: &Design, stars: &[&PlacedStar], ramp: f64) -> Path {
    let bounds = stars
        .iter()
        .map(|placed| {
            // A placement is a translation or a turn by whole quarters, so the box of the image is near enough
            // the image of the box; take the image of the paths to be exact.
            let part = design.part(placed);
            let cut = placed.placement.path(&part.outline.outside).bounds();
            part.seams.iter().fold(cut, |bounds, seam| {
                let all = seam.run().then(seam.lead_in(ramp)).then(seam.lead_out(ramp));
                bounds.union(placed.placement.path(&all).bounds().grown(part.band / 2.0))
            })
        })
        .fold(Bounds::EMPTY, Bounds::union);
    let (a, c) = (bounds.min, bounds.max);
    let corners = [a, Point::new(c.x, a.y), c, Point::new(a.x, c.y), a];
    let sides: Vec<Segment> = corners.windows(2).map(|pair| Line::new(pair[0], pair[1]).into()).collect();
    Path::closed(sides)
}
