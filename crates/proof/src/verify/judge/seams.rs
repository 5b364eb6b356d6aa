//! The seams of a program against those of the design: all there, in order, each from its start to its end.

use crate::verify::judge::Judge;
use crate::verify::judge::path::follow::Follower;
use crate::verify::judge::rules::{ContactCount, IronRules, Phase};
use crate::verify::judge::task::{ProgramTask, ProgramWork};
use crate::verify::judge::travel_order::Leg;
use crate::verify::read::gcode::{Move, MoveKind};
use crate::verify::{FindingCode, Findings};
use design::SealContact;
use geom::Path;
use sealed::LaidSeam;

/// The ways of a program with the stops before them, in order; a trace shows the frame first.
pub(super) fn legs(task: &ProgramTask<'_>) -> Vec<Leg> {
    if task.work == ProgramWork::Trace {
        let starts =
            task.frame.start().into_iter().chain(task.seams.iter().filter_map(|seam| seam.run.start()));
        return starts.map(|start| Leg { start, stop: Vec::new(), cools: false }).collect();
    }
    let leg = |(contact, i): (&SealContact, usize)| {
        let stop = task.job.stop_before(i);
        let (pause, heat) = (stop.pauses.then_some("pause"), stop.heat.map(|_| "heat"));
        let tool = match task.work {
            ProgramWork::Cut(tool) => Some(tool),
            ProgramWork::Seal | ProgramWork::Trace => None,
        };
        let change = tool.filter(|_| i == 0).map(|_| "tool");
        let beam = task.arms_laser().then_some("beam").filter(|_| i == 0);
        let stop = change.into_iter().chain(beam).chain(pause).chain(heat).collect();
        let (first, offset) =
            (contact.laid.lead_in.segments.first()?, tool.map_or(0.0, |tool| tool.blade_offset().0));
        // The axis of a blade is ahead of its tip.
        let start = first.start() + first.tangent(0.0) * offset;
        Some(Leg { start, stop, cools: task.job.cool_after(i).is_some() })
    };
    task.job.contacts.iter().zip(0..).filter_map(leg).collect()
}

fn walk(seam: &LaidSeam) -> SeamWalk {
    SeamWalk::new(&seam.run, seam.name.to_string(), seam.once)
}

/// The way down, the run, the way up.
fn walks(seam: &LaidSeam) -> [SeamWalk; 3] {
    let [way_down, way_up] = [(&seam.lead_in, "way down to"), (&seam.lead_out, "way up from")]
        .map(|(path, title)| SeamWalk::new(path, format!("{title} the {}", seam.name), path.length()));
    [way_down, walk(seam), way_up]
}

/// Every seam is there, in order, from its start to its end, overlap and ramps included.
pub(super) struct Sealed<'a> {
    rules: &'a IronRules<'a>,
    tolerance: f64,
    /// The seams that are still to come.
    expected: std::slice::Iter<'a, SealContact>,
    count: ContactCount,
    now: Option<SeamContact>,
    /// The largest, mm.
    deviation: f64,
}

/// One contact with the fabric.
enum SeamContact {
    /// A contact along a seam: the way down, the run, the way up.
    Seam(Box<[SeamWalk; 3]>),
    /// A contact without a seam; the line in which it begins.
    Extra(Option<usize>),
}

impl<'a> Sealed<'a> {
    pub(super) fn new(task: &'a ProgramTask<'_>, rules: &'a IronRules<'a>) -> Self {
        let tolerance = task.spec.accuracy.path.0;
        let (expected, count) = (task.job.contacts.iter(), ContactCount::default());
        Self { rules, tolerance, expected, count, now: None, deviation: 0.0 }
    }

    /// The end of a contact.
    fn lift(&mut self, findings: &mut Findings) {
        match self.now.take() {
            Some(SeamContact::Seam(walks)) => {
                let [down, run, lift] = *walks;
                for walk in [run, down, lift] {
                    self.deviation = self.deviation.max(walk.end(self.tolerance, findings));
                }
            }
            Some(SeamContact::Extra(line)) => {
                let fault = "a contact that the design does not have";
                findings.add_at(FindingCode::ExtraSeam, line, fault, "only its seams");
            }
            None => {}
        }
    }
}

impl Judge for Sealed<'_> {
    fn step(&mut self, step: &Move, findings: &mut Findings) {
        let (phase, _) = self.rules.follow(&mut self.count, step);
        if phase == Phase::Clear {
            self.lift(findings);
            return;
        }
        let expected = &mut self.expected;
        let current = self.now.get_or_insert_with(|| match expected.next() {
            Some(contact) => SeamContact::Seam(Box::new(walks(&contact.laid))),
            None => SeamContact::Extra(None),
        });
        match current {
            SeamContact::Extra(line) if phase == Phase::Contact => *line = line.or(Some(step.line)),
            SeamContact::Extra(_) => {}
            SeamContact::Seam(walks) => {
                let [down, run, lift] = &mut **walks;
                match phase {
                    Phase::Contact => run.step(step),
                    _ if run.first.is_none() => down.step(step),
                    _ => lift.step(step),
                }
            }
        }
    }

    fn end(&mut self, findings: &mut Findings) {
        self.lift(findings);
        for contact in self.expected.by_ref() {
            let fault = format!("no {}", contact.laid.name);
            findings.add(FindingCode::MissingSeam, fault, "every seam of the design");
        }
    }

    fn deviation(&self) -> f64 {
        self.deviation
    }
}

/// A trace shows the frame, and then every seam.
pub(super) struct Traced {
    tolerance: f64,
    paths: std::vec::IntoIter<SeamWalk>,
    /// The expected number of seams, and the number of paths found.
    wanted: usize,
    found: usize,
    /// Whether the last move was along a path, and the expected path that it followed.
    inside: bool,
    now: Option<SeamWalk>,
    /// The largest, mm.
    deviation: f64,
}

impl Traced {
    pub(super) fn new(task: &ProgramTask<'_>) -> Self {
        let frame = SeamWalk::new(&task.frame, "frame".to_owned(), task.frame.length());
        let paths: Vec<SeamWalk> = std::iter::once(frame).chain(task.seams.iter().map(walk)).collect();
        let (tolerance, seam_count) = (task.spec.accuracy.path.0, task.seams.len());
        Self {
            tolerance,
            paths: paths.into_iter(),
            wanted: seam_count,
            found: 0,
            inside: false,
            now: None,
            deviation: 0.0,
        }
    }

    /// The end of a path.
    fn leave(&mut self, findings: &mut Findings) {
        self.inside = false;
        if let Some(walk) = self.now.take() {
            self.deviation = self.deviation.max(walk.end(self.tolerance, findings));
        }
    }
}

impl Judge for Traced {
    fn step(&mut self, step: &Move, findings: &mut Findings) {
        if step.kind == MoveKind::Rapid {
            self.leave(findings);
            return;
        }
        if !std::mem::replace(&mut self.inside, true) {
            self.found += 1;
            self.now = self.paths.next();
        }
        if let Some(walk) = &mut self.now {
            walk.step(step);
        }
    }

    fn end(&mut self, findings: &mut Findings) {
        self.leave(findings);
        let count = self.found.saturating_sub(1);
        if self.found == 0 {
            self.now = self.paths.next();
            self.leave(findings);
        }
        if count != self.wanted {
            let (fault, allowed) = (format!("{count} paths"), format!("{} paths", self.wanted));
            findings.add(FindingCode::MissingSeam, fault, allowed);
        }
    }

    fn deviation(&self) -> f64 {
        self.deviation
    }
}

/// One chain of moves, on its way along the path that it should follow.
struct SeamWalk {
    follower: Follower,
    name: String,
    /// Length of the part of the path that closes the loop.
    once: f64,
    /// Lines of its first and of its last move.
    first: Option<usize>,
    last: Option<usize>,
}

impl SeamWalk {
    fn new(path: &Path, name: String, circumference: f64) -> Self {
        Self { follower: Follower::new(path), name, once: circumference, first: None, last: None }
    }

    fn step(&mut self, step: &Move) {
        self.first = self.first.or(Some(step.line));
        self.last = Some(step.line);
        if let Some(path) = &step.path {
            self.follower.step(path, step.line);
        }
    }

    /// Reports how it left its path; the largest deviation, mm.
    fn end(self, tolerance: f64, findings: &mut Findings) -> f64 {
        let Self { name, once: circumference, first, last, .. } = self;
        let walked = self.follower.finish();
        let (length, deviation) = (walked.exact_length, walked.largest());
        if deviation.is_nan() || deviation > tolerance {
            let line = first.map(|first| walked.step.max(first));
            let fault = if deviation.is_finite() {
                format!("{deviation:.6} mm off the {name}")
            } else {
                format!("no move along the {name}")
            };
            findings.add_at(FindingCode::Deviation, line, fault, format!("{tolerance} mm"));
        }
        // Along the path, rounding at both ends may add up.
        let slack = 2.0 * tolerance;
        if walked.start > slack {
            let fault = format!("the {name} begins {:.3} mm late", walked.start);
            findings.add_at(FindingCode::LateStart, first, fault, "its start");
        }
        if walked.end < circumference - slack {
            let fault = format!("the {name} ends {:.3} mm before it is closed", circumference - walked.end);
            findings.add_at(FindingCode::OpenLoop, last, fault, format!("{circumference:.3} mm"));
        } else if walked.end < length - slack {
            let fault = format!("{:.3} mm of overlap on the {name}", walked.end - circumference);
            findings.add_at(
                FindingCode::MissingOverlap,
                last,
                fault,
                format!("{:.3} mm", length - circumference),
            );
        }
        if let Some((back, line)) = walked.backwards.filter(|(back, _)| *back > slack) {
            let fault = format!("{back:.3} mm back along the {name}");
            findings.add_at(FindingCode::Backwards, line, fault, "forwards only");
        }
        if let Some((gap, line)) = walked.jump.filter(|(gap, _)| *gap > tolerance) {
            let fault = format!("a gap of {gap:.3} mm in the {name}");
            findings.add_at(FindingCode::Jump, line, fault, "an unbroken path");
        }
        deviation
    }
}
