//! The cutting programs: what the drawings for cutting machines have, cut on the machine after the seal, with its zero.

use crate::plan::blade::axis_paths;
use crate::plan::job_size::too_long;
use crate::plan::keep_out::clamps_in_the_way;
use crate::plan::laser::high_focus;
use crate::plan::lowest_feed::lowest_of;
use crate::plan::program::{PauseReason, SeamList, lowest_contact};
use crate::plan::ramps::too_steep;
use crate::plan::reach::refusal_beyond;
use crate::plan::refusals::contradictions;
use crate::plan::seal::{ContactPlanner, scope};
use crate::plan::{Height, Program, Purpose, Step, actual_speed};
use design::{Design, PlacedPart, Refusal, RefusalCode, Refusals, SealContact, SealJob};
use geom::{Arc, Path, Point, Segment};
use sealed::LaidSeam;
use spec::units::{Least, Readable};
use spec::{CutProcess, CutTool, Machine, Spec, key};

/// Smallest radius that a drag knife follows, mm: in a tighter bend the blade tears the fabric instead of turning.
const TIGHTEST: f64 = 0.5;

/// The cutting programs of `design`, one a sheet; none where the spec names no tool for them.
pub fn cut_programs(spec: &Spec, machine: &Machine, design: &Design) -> Vec<Program> {
    let Some(process) = spec.cut.program else { return Vec::new() };
    let cut_spec = spec.cut_by(&process);
    design.sheets.iter().map(|sheet| cut_program(&cut_spec, machine, process, design, sheet.index)).collect()
}

/// The program that cuts sheet number `sheet`; `cut_spec` has the cut in the place of its seal.
fn cut_program(
    cut_spec: &Spec,
    machine: &Machine,
    process: CutProcess,
    design: &Design,
    sheet: usize,
) -> Program {
    let job = SealJob::of_cuts(cut_spec, design, sheet, machine.process.ramp.0);
    let planners = ContactPlanner::of_job(cut_spec, machine, &job);
    let mut steps = vec![Step::Height(Height::Park), Step::Pause(PauseReason::Tool(process.tool))];
    steps.extend(process.tool.temperature().map(Step::Heat));
    let mut list = SeamList { seams: Vec::new(), processes: job.processes.clone() };
    for contact in &job.contacts {
        let led = SealContact { laid: led(&contact.laid, process.tool.blade_offset().0), ..contact.clone() };
        let planner = &planners[contact.process];
        // Length and time are those of the cut: an axis that leads a blade swivels on top.
        let (Some(plan), Some(cut)) = (planner.plan(&led), planner.plan(contact)) else { continue };
        steps.extend([Step::Travel(plan.start), Step::Height(Height::Travel), Step::Seam(list.seams.len())]);
        steps.extend(plan.steps);
        list.seams.push(cut.report);
    }
    steps.extend([Step::Height(Height::Park), Step::Travel(Point::ORIGIN)]);
    let placed: Vec<&PlacedPart> = design.on_sheet(sheet).collect();
    Program::new(cut_spec, machine, scope(Purpose::Cut, sheet, &placed), steps, list).on_sheet_of(design)
}

/// `cut` as the axis of the tool goes, `offset` mm ahead of what cuts.
fn led(cut: &LaidSeam, offset: f64) -> LaidSeam {
    if offset <= 0.0 {
        return cut.clone();
    }
    let [lead_in, run, lead_out] = axis_paths(cut.paths(), offset);
    LaidSeam { lead_in, run, lead_out, ..cut.clone() }
}

/// Every reason for which `machine` cannot run the cutting programs `cuts` of `design`, whose sealing programs are `seals`.
pub fn cut_refusals(
    spec: &Spec,
    machine: &Machine,
    design: &Design,
    seals: &[Program],
    cuts: &[Program],
) -> Refusals {
    let Some(process) = spec.cut.program else { return Refusals::new() };
    let cut_spec = &spec.cut_by(&process);
    if let Some(refusal) = too_long(cut_spec, cuts) {
        return Refusal { key: key::cut::SPEED, ..refusal }.into();
    }
    let mut refusals: Refusals = shallow(machine, process, seals).into_iter().collect();
    refusals.extend(slow(machine, process, cuts));
    refusals.extend(tight(cut_spec, machine, design, process));
    let high = high_focus(cut_spec, machine, cuts).into_iter();
    refusals.extend(high.map(|refusal| Refusal { key: key::cut::FOCUS, ..refusal }));
    refusals.extend(contradictions(cut_spec, machine, cuts));
    refusals.extend(too_steep(cut_spec, machine, cuts));
    refusals.extend(clamps_in_the_way(cut_spec, machine, cuts, &[]));
    let remedy = "a larger margin in [sheet], or a smaller blade_offset";
    refusals.extend(cuts.iter().find_map(|cut| refusal_beyond(machine, "the cut", &cut.steps, remedy)));
    refusals
}

/// The refusal of a cut that is no deeper than a seal: it would seal where it should cut. A laser goes no deeper.
fn shallow(machine: &Machine, process: CutProcess, seals: &[Program]) -> Option<Refusal> {
    if matches!(process.tool, CutTool::Laser { .. }) {
        return None;
    }
    let lowest = lowest_contact(machine, seals)?;
    (process.height >= lowest).then(|| {
        Refusal::new(
            key::cut::HEIGHT,
            RefusalCode::ShallowCut,
            format!("the tool cuts at {}, and seams are sealed at {lowest}", process.height),
            "must be lower than every seam, through both sheets: the release layer is off by then".to_owned(),
        )
    })
}

/// The refusal of a cut that is slower than the controller can move.
fn slow(machine: &Machine, process: CutProcess, cuts: &[Program]) -> Option<Refusal> {
    let steps = cuts.iter().flat_map(|program| &program.steps);
    let lowest = lowest_of(&machine.motion, steps)?;
    let speed = process.speed.0;
    (lowest > speed * (1.0 + 1e-9)).then(|| {
        let runs = actual_speed(&machine.motion, speed, (lowest, lowest));
        Refusal::new(
            key::cut::SPEED,
            RefusalCode::FeedFloor,
            format!("{} runs the cut {runs}", machine.controller.dialect.title()),
            format!("a speed of at least {} mm/s: a cut is not chopped into strokes", Least(lowest)),
        )
    })
}

/// The refusal of a bend that is too tight for a drag knife.
fn tight(cut_spec: &Spec, machine: &Machine, design: &Design, process: CutProcess) -> Option<Refusal> {
    if process.tool.blade_offset().0 <= 0.0 {
        return None;
    }
    design.sheets.iter().find_map(|sheet| {
        let job = SealJob::of_cuts(cut_spec, design, sheet.index, machine.process.ramp.0);
        let LaidSeam { name, run, .. } =
            job.contacts.into_iter().map(|contact| contact.laid).find(|cut| tight_arc(&cut.run).is_some())?;
        let arc = tight_arc(&run)?;
        let place = Segment::from(arc).point(0.5);
        Some(Refusal::new(
            key::cut::TOOL,
            RefusalCode::TightCut,
            format!(
                "{name} of sheet {} bends with a radius of {} mm at X {:.1} Y {:.1} mm",
                sheet.index,
                Readable(arc.radius),
                place.x,
                place.y
            ),
            format!(
                "a drag knife follows radii of {TIGHTEST} mm and more, and sharp corners: round it further, or take a hot tip"
            ),
        ))
    })
}

/// The first arc of `path` that is too tight for a drag knife.
fn tight_arc(path: &Path) -> Option<Arc> {
    path.segments.iter().find_map(|segment| match segment {
        Segment::Arc(arc) if arc.radius < TIGHTEST - 1e-9 => Some(*arc),
        Segment::Arc(_) | Segment::Line(_) => None,
    })
}
