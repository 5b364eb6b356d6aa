//! The sealing programs: contact after contact of a job.

use crate::plan::marks::mark_steps;
use crate::plan::moves::Cuts;
use crate::plan::program::{PauseReason, SeamList};
use crate::plan::ramps::without_crumbs;
use crate::plan::{Height, Program, Purpose, Ramp, Scope, SeamReport, Step};
use design::{Design, PlacedPart, SealContact, SealJob};
use geom::{Path, Point, Segment};
use spec::{Machine, ProgramScope, Spec};

/// A sheet, and pieces on it in the order of sealing: the content of one program.
pub(super) type Batch<'a> = (usize, Vec<&'a PlacedPart>);

/// The pieces of every program, by the spec's choice of one a star or one a sheet.
pub(super) fn batches(design: &Design, scope: ProgramScope) -> Vec<Batch<'_>> {
    match scope {
        ProgramScope::Piece => design.placed().iter().map(|placed| (placed.sheet, vec![placed])).collect(),
        ProgramScope::Sheet => {
            design.sheets.iter().map(|sheet| (sheet.index, design.nearest_first(sheet.index))).collect()
        }
    }
}

/// All sealing programs of `design`.
pub fn seal_programs(spec: &Spec, machine: &Machine, design: &Design) -> Vec<Program> {
    let program = |(sheet, placed): Batch<'_>| {
        let job = SealJob::new(spec, design, &placed, machine.process.ramp.0);
        let marks = design.stops(spec, sheet);
        seal_program(spec, machine, scope(Purpose::Seal, sheet, &placed), &job, &marks).on_sheet_of(design)
    };
    batches(design, spec.machine.program).into_iter().map(program).collect()
}

/// The scope of a batch's program.
pub(super) fn scope(purpose: Purpose, sheet: usize, placed: &[&PlacedPart]) -> Scope {
    Scope { purpose, sheet, pieces: placed.iter().map(|placed| placed.name()).collect() }
}

/// The program that stops above `marks`, and makes the contacts of `job`, in their order.
///
/// Before a contact of another temperature, or after which its seam asks for a pause, the iron goes up and home. A seam that cools does
/// so with the iron at travel height above its end. A laser waits for the operator before its first contact.
pub fn seal_program(spec: &Spec, machine: &Machine, scope: Scope, job: &SealJob, marks: &[Point]) -> Program {
    let mut steps = vec![Step::Height(Height::Park)];
    steps.extend(mark_steps(marks));
    if machine.controller.laser.is_some() {
        steps.push(Step::Pause(PauseReason::Beam));
    }
    let mut list = SeamList { seams: Vec::new(), processes: job.processes.clone() };
    let planner = ContactPlanner::of_job(spec, machine, job);
    for (contact, i) in job.contacts.iter().zip(0..) {
        let Some(contact_plan) = planner[contact.process].plan(contact) else { continue };
        let stop = job.stop_before(i);
        if i > 0 && (stop.pauses || stop.heat.is_some()) {
            steps.extend([Step::Height(Height::Park), Step::Travel(Point::ORIGIN)]);
        }
        if stop.pauses {
            steps.push(Step::Pause(PauseReason::Look(list.seams.len())));
        }
        steps.extend(stop.heat.map(Step::Heat));
        steps.extend([
            Step::Travel(contact_plan.start),
            Step::Height(Height::Travel),
            Step::Seam(list.seams.len()),
        ]);
        steps.extend(contact_plan.steps);
        steps.extend(job.cool_after(i).map(Step::Cool));
        list.seams.push(contact_plan.report);
    }
    if list.seams.is_empty() && machine.controller.laser.is_none() {
        steps.push(Step::Heat(spec.seal.temperature));
    }
    steps.extend([Step::Height(Height::Park), Step::Travel(Point::ORIGIN)]);
    Program::new(spec, machine, scope, steps, list)
}

/// The steps of one contact.
pub(super) struct ContactPlan {
    /// The place above which the tool goes down.
    pub(super) start: Point,
    /// Down, along, up.
    pub(super) steps: [Step; 3],
    /// Length and time of the contact.
    pub(super) report: SeamReport,
}

/// Makes steps of the contacts of one process.
pub(super) struct ContactPlanner<'a> {
    spec: &'a Spec,
    cuts: Cuts,
    speed: f64,
    /// Heights of travel and of contact.
    heights: [f64; 2],
}

impl<'a> ContactPlanner<'a> {
    /// One planner for each process of `job`.
    pub(super) fn of_job(spec: &'a Spec, machine: &Machine, job: &SealJob) -> Vec<Self> {
        let planner = |process: &spec::SealProcess| Self {
            spec,
            cuts: Cuts::of_seal(&spec.sealed_by(process), machine),
            speed: process.seal.speed.0,
            heights: [machine.process.heights.travel.0, process.seal.contact(&machine.process).0],
        };
        job.processes.iter().map(planner).collect()
    }

    /// The steps of `contact`; `None` if it has no way down.
    pub(super) fn plan(&self, contact: &SealContact) -> Option<ContactPlan> {
        let SealContact { laid: laid_seam, process, line, pass } = contact;
        let [high, low] = self.heights;
        let (down, up) =
            (self.ramp(&laid_seam.lead_in, high, low), self.ramp(&laid_seam.lead_out, low, high));
        let start = down.pieces.first().map(Segment::start)?;
        let length = laid_seam.run.length();
        let time = (down.length() + length + up.length()) / self.speed;
        let (name, overlap) = (laid_seam.name.clone(), laid_seam.overlap);
        let report = SeamReport { name, length, overlap, time, process: *process, line: *line, pass: *pass };
        let steps = [Step::TouchDown(down), Step::Seal(self.cuts.moves(&laid_seam.run)), Step::Lift(up)];
        Some(ContactPlan { start, steps, report })
    }

    /// A ramp is as slow as the seal all the way, so that the seam does not begin colder than it goes on.
    fn ramp(&self, path: &Path, from: f64, to: f64) -> Ramp {
        let pieces = without_crumbs(self.cuts.moves(path), self.spec);
        Ramp { pieces, from, to }
    }
}
