//! A feed check: cold, above the fabric, line after line between two pauses, each with its duration at the seal's speed.

use crate::verify::judge::beam::NoBeam;
use crate::verify::judge::clamp::ClampJudge;
use crate::verify::judge::height::HeightJudge;
use crate::verify::judge::ready::ReadyJudge;
use crate::verify::judge::rules::IronRules;
use crate::verify::judge::script::{Body, ScriptJudge};
use crate::verify::judge::seams::Traced;
use crate::verify::judge::stroke::stroke_seconds;
use crate::verify::judge::task::{ProgramTask, ProgramWork};
use crate::verify::judge::{Judge, judged};
use crate::verify::read::gcode::{Dialect, Dwell, Move, MoveKind, Pause};
use crate::verify::{FindingCode, Findings};
use design::SealJob;
use geom::{Bounds, Isometry, Path, Point};
use sealed::{LaidSeam, PieceName, Seam};
use spec::{Machine, Spec};

/// Largest error of a line's time, as a fraction: the wait after its last stroke is rounded.
const TIME: f64 = 0.01;

/// The task of a feed check.
#[derive(Clone, Debug)]
pub struct FeedCheckTask<'a> {
    /// The seal's speed and the tolerance.
    pub spec: &'a Spec,
    /// The machine that runs it.
    pub machine: &'a Machine,
    /// The lines, in order.
    pub lines: Vec<Path>,
}

impl FeedCheckTask<'_> {
    /// Reads the program and reports everything that it does otherwise; its largest deviation, mm.
    pub fn check(&self, text: &str, findings: &mut Findings) -> f64 {
        // The lines are judged as a trace: the first as its frame, the others as its seams. The times of the lines and the height
        // above the fabric have a judge of their own.
        let Self { spec, machine, ref lines } = *self;
        let (rules, tolerance) = (IronRules::new(spec, machine, &SealJob::default()), spec.accuracy.path.0);
        let (name, origin) = (PieceName::Named("line".to_owned()), Isometry::IDENTITY);
        let seam = |line: &Path| LaidSeam::new(&name, &Seam::weld(line.clone()), origin, 0.0);
        let seams = lines.iter().skip(1).map(seam);
        let reach = lines.iter().map(Path::bounds).fold(Bounds::EMPTY, Bounds::union);
        let bed = machine.bench.work_area.map_or(reach.max, |(x, y)| Point::new(x.0, y.0));
        let max = Point::new(reach.max.x.min(bed.x), reach.max.y.min(bed.y));
        let area = Bounds { min: Point::ORIGIN, max }.outset(tolerance);
        let task = ProgramTask {
            spec,
            machine,
            work: ProgramWork::Trace,
            scope: String::new(),
            seams: seams.collect(),
            job: SealJob::default(),
            frame: lines.first().cloned().unwrap_or_default(),
            area,
            marks: Vec::new(),
            motion: None,
        };
        let times = lines.iter().map(|line| line.length() / spec.seal.speed.0).collect();
        let mut judges: Vec<Box<dyn Judge + '_>> = vec![
            Box::new(ScriptJudge::new(machine, 2 * lines.len())),
            Box::new(Body::new(Vec::new(), &machine.controller.heating)),
        ];
        judges.extend(ReadyJudge::for_controller(&machine.controller));
        judges.push(Box::new(HeightJudge::new(&machine.process.heights, area)));
        judges.push(Box::new(Timed::new(&rules, area, times)));
        judges.push(Box::new(ClampJudge::new(&machine.bench.keep_out, 0.0)));
        judges.push(Box::new(Traced::new(&task)));
        judges.push(Box::new(NoBeam));
        judged(text.split_inclusive('\n'), Dialect::for_controller(&machine.controller), judges, findings)
    }
}

/// Every line begins and ends with a pause, takes its time, and stays above the fabric.
struct Timed<'a> {
    rules: &'a IronRules<'a>,
    area: Bounds,
    /// The durations of the lines, s, and the number of those drawn so far.
    wanted: Vec<f64>,
    drawn: usize,
    /// Time since the last pause, s, and whether there was one before the line that is drawn now.
    seconds: f64,
    waited: bool,
    moving: bool,
}

impl<'a> Timed<'a> {
    fn new(rules: &'a IronRules<'a>, area: Bounds, durations: Vec<f64>) -> Self {
        Self { rules, area, wanted: durations, drawn: 0, seconds: 0.0, waited: false, moving: false }
    }

    /// The end of a line, which a pause should be.
    fn end_of_line(&mut self, line: usize, paused: bool, findings: &mut Findings) {
        if !std::mem::take(&mut self.moving) {
            return;
        }
        let (seconds, expected) = (self.seconds, self.wanted.get(self.drawn).copied().unwrap_or(0.0));
        if (seconds - expected).abs() > TIME * expected || !paused {
            let place = if paused { "before a pause" } else { "without a pause after it" };
            let fault = format!("a line of {seconds:.3} s {place}");
            findings.add_at(FindingCode::WrongFeed, line, fault, format!("{expected:.3} s, and a pause"));
        }
        self.drawn += 1;
    }
}

impl Judge for Timed<'_> {
    fn step(&mut self, step: &Move, findings: &mut Findings) {
        let waited = std::mem::take(&mut self.waited);
        if !self.rules.is_clear(step) {
            let fault = format!("Z{}", step.to.z);
            findings.add_at(FindingCode::LowTrace, step.line, fault, "travel height or above");
        }
        if !(self.area.contains(step.from.xy()) && self.area.contains(step.to.xy())) {
            let fault = format!("a move to ({:.3}, {:.3})", step.to.x, step.to.y);
            findings.add_at(FindingCode::OutsideWorkArea, step.line, fault, "the lines of the check");
        }
        if step.kind == MoveKind::Rapid {
            self.end_of_line(step.line, false, findings);
            return;
        }
        if !std::mem::replace(&mut self.moving, true) && !waited {
            let (fault, allowed) = ("a line without a pause before it", "a pause before and after each line");
            findings.add_at(FindingCode::ProfileLine, step.line, fault, allowed);
        }
        let [from, to] = [step.from, step.to].map(|at| [at.x, at.y, at.z]);
        let chopped = self.rules.chops && self.rules.motion.acceleration.is_some();
        self.seconds += match step.feed {
            Some(feed) if chopped && feed > 60.0 * self.rules.default.seal.speed.0 * (1.0 + TIME) => {
                stroke_seconds(self.rules.motion, from, to, feed / 60.0)
            }
            Some(feed) => 60.0 * step.length() / feed,
            None => 0.0,
        };
    }

    fn dwell(&mut self, dwell: &Dwell, _: &mut Findings) {
        if self.moving {
            self.seconds += dwell.seconds;
        }
    }

    fn pause(&mut self, pause: &Pause, findings: &mut Findings) {
        self.end_of_line(pause.line, true, findings);
        (self.waited, self.seconds) = (true, 0.0);
    }

    fn end(&mut self, findings: &mut Findings) {
        if self.drawn != self.wanted.len() {
            let (fault, allowed) = (format!("{} lines", self.drawn), format!("{} lines", self.wanted.len()));
            findings.add(FindingCode::MissingSeam, fault, allowed);
        }
    }
}
