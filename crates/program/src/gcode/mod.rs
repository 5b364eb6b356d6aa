//! G-code in every dialect.
//!
//! End points are rounded first; an arc's centre is then computed from the rounded points and the
//! exact radius, so that start, end and centre of every line of the file agree with each other.
//! Comments of the form `; key: word=value ...` carry the data that a reader of the file alone needs;
//! the last line, after the program's end, counts the lines, so that a file cut short shows.
//!
//! The **writer** writes lines, one at a time; the **header** states facts; a **dialect**'s row lists its
//! differences in spelling; this room goes through a program's steps.

mod dialect;
mod feed_check;
mod header;
mod thumbnail;
mod writer;

use crate::gcode::dialect::Spelling;
use crate::gcode::header::{contact_facts, header, tool_facts};
use crate::gcode::writer::Writer;
use crate::number::{Decimals, number};
use crate::plan::{Clock, Pace, Pacer, PauseReason, Program, Purpose, Step, height_of};
use geom::{Point, Segment};
use spec::units::{Duration, Readable, Temperature};
use spec::{CutTool, Dialect, Heating, Machine, Spec};

pub use feed_check::{FEED_CHECK_TITLE, feed_check};
pub use thumbnail::Thumbnail;
pub use writer::Facts;

/// The program as text, with `thumbnails` in its header.
pub fn gcode(spec: &Spec, machine: &Machine, program: &Program, thumbnails: &[Thumbnail]) -> String {
    let mut job = Job::new(program.pace(), Writer::new(Facts::new(spec, machine)));
    job.whole = Some(Whole { machine, program, clock: Clock::new(machine), percent: 0.0 });
    header(&mut job.writer, machine, program);
    for picture in thumbnails {
        picture.write(&mut job.writer);
    }
    for line in &machine.script.start {
        job.writer.line(line);
    }
    for step in &program.steps {
        job.step(step);
    }
    for line in &machine.script.end {
        job.writer.line(line);
    }
    let estimate = job.writer.spelling.estimate(program.time);
    if let Some(estimate) = estimate.filter(|_| program.purpose != Purpose::Trace) {
        job.writer.comment(&estimate);
    }
    job.writer.finished()
}

/// The text that hosts of the dialect read of a program that takes `seconds`; `None` where they read none.
pub fn estimate(dialect: Dialect, seconds: f64) -> Option<String> {
    Spelling::new(dialect).estimate(seconds)
}

/// `steps` alone at `pace`, with the iron at `start`, as text without header, start, pauses and end.
pub fn steps_text(facts: Facts<'_>, steps: &[Step], pace: Pace, start: Point) -> String {
    let mut writer = Writer::new(facts);
    writer.at = writer.round(start);
    let mut job = Job::new(pace, writer);
    job.beam = facts.controller.laser.zip(facts.seal.power).map(|(laser, power)| laser.word(power.0));
    for step in steps {
        job.step(step);
    }
    job.writer.out
}

/// Difference between the temperature of a heater with a name and the one that the program waits for, in degrees Celsius: a heater that
/// swings about its target would else be waited for too long.
const HEATER_SLACK: f64 = 2.0;

/// The operator's tasks before a laser comes on.
const ARM_BEAM: &str = "goggles on, enclosure closed, fumes drawn off, press start";

/// The operator's tasks before `tool` cuts.
fn tool_tasks(tool: CutTool) -> [String; 2] {
    match tool {
        CutTool::Laser { .. } => {
            ["keep the sheet where it is, nothing that burns under it", ARM_BEAM].map(str::to_owned)
        }
        CutTool::HotTip { .. } | CutTool::DragKnife { .. } => [
            "take the release layer off, keep the sheet where it is".to_owned(),
            format!("the {} in, X Y as before, its tip at Z0, press start", tool.in_words()),
        ],
    }
}

/// The way through a program's steps.
struct Job<'a> {
    writer: Writer<'a>,
    /// The pacer at the start of every contact of the process.
    first: Pacer,
    pacer: Pacer,
    /// The S word of a laser along the contact; `None` of an iron, and of steps without power.
    beam: Option<f64>,
    /// The program that the steps are all of; `None` for a few steps alone.
    whole: Option<Whole<'a>>,
}

/// The data that only a whole program has: seams with their figures, an operator, progress.
struct Whole<'a> {
    machine: &'a Machine,
    program: &'a Program,
    clock: Clock<'a>,
    /// The last per cent that was written.
    percent: f64,
}

impl<'a> Job<'a> {
    /// The beginning of a way through a few steps.
    fn new(pace: Pace, writer: Writer<'a>) -> Self {
        let pacer = Pacer::new(pace, writer.facts.seal.speed.0);
        Self { first: pacer, pacer, beam: None, writer, whole: None }
    }

    fn step(&mut self, step: &Step) {
        // The clock of a whole program follows every step, for its progress. A contact begins with a pacer of its own: its
        // strokes are counted from the touch-down on.
        let Facts { process, .. } = self.writer.facts;
        match step {
            Step::Height(level) => {
                if let Some(run) = &mut self.whole {
                    run.clock.height(*level);
                }
                self.writer.height(height_of(process, *level));
            }
            Step::Heat(temperature) => self.heat(*temperature),
            Step::Pause(reason) => self.pause(*reason),
            Step::Cool(wait) => self.cool(*wait),
            Step::Travel(to) => {
                if let Some(run) = &mut self.whole {
                    run.clock.travel(*to);
                }
                self.writer.travel(*to);
            }
            Step::Seam(i) => {
                // Every seam states its feed, so that a job can go on there.
                self.writer.feed = None;
                if let Some(program) = self.whole.as_ref().map(|whole| whole.program) {
                    let contact = program.seams.get(*i);
                    self.first = program.pacer(contact.map_or(0, |contact| contact.process));
                    let beam = contact.and_then(|contact| {
                        self.writer.full_beam(&program.processes[contact.process].process)
                    });
                    if let Some(contact) = contact {
                        let key = if program.purpose == Purpose::Cut { "cut" } else { "seam" };
                        self.writer.comment(&contact_facts(program.purpose, key, i + 1, contact));
                    }
                    self.beam = beam;
                    if beam.is_some() {
                        self.writer.beam_ready();
                    }
                }
            }
            Step::TouchDown(ramp) | Step::Lift(ramp) => {
                if matches!(step, Step::TouchDown(_)) {
                    self.pacer = self.first;
                }
                if self.whole.is_none() && self.beam.is_some() {
                    self.writer.beam_ready();
                }
                self.writer.set_beam(self.beam.map(|_| 0.0));
                for (piece, from, to) in ramp.with_heights() {
                    self.seal(piece, Some((from, to)));
                }
                if matches!(step, Step::Lift(_)) && self.beam.take().is_some() {
                    self.writer.beam_off();
                }
            }
            Step::Seal(pieces) => self.seal_run(pieces),
            Step::Trace(pieces) => {
                for piece in pieces {
                    self.writer.cut(piece, None, process.trace_speed.0);
                }
            }
        }
    }

    fn heat(&mut self, temperature: Temperature) {
        let Facts { controller, .. } = self.writer.facts;
        let t = number(temperature.0);
        self.writer.comment(&format!("heat: temperature_C={t}"));
        // The heater may be hotter, from another process or from the program before.
        let changes = self.whole.as_ref().is_some_and(|whole| whole.program.changes_temperature());
        match &controller.heating {
            Heating::Operator => {
                // As many digits as a line has room for.
                let t = Readable(temperature.0);
                let request = format!("set the iron to {t} C, standby off, wait until hot, press start");
                self.writer.comment(&request);
                if let Some(run) = &self.whole {
                    self.writer.line(&run.machine.script.pause);
                }
            }
            Heating::Hotend(number) => {
                let t = Decimals::exactly(1).text(temperature.0);
                let letter = if changes { self.writer.spelling.exact_heat } else { 'S' };
                let tool = number.map_or(String::new(), |number| format!("T{number} "));
                self.writer.line(&format!("M109 {tool}{letter}{t}"));
            }
            Heating::Heater(name) => self.heat_named(name, temperature, changes),
        }
    }

    /// Sets the heater called `name` of Klipper and waits for it; `changes`: it may be hotter than `temperature`.
    fn heat_named(&mut self, name: &str, temperature: Temperature, changes: bool) {
        let text = |celsius: f64| Decimals::exactly(1).text(celsius);
        let [t, minimum, maximum] =
            [temperature.0, temperature.0 - HEATER_SLACK, temperature.0 + HEATER_SLACK].map(text);
        self.writer.line(&format!("SET_HEATER_TEMPERATURE HEATER={name} TARGET={t}"));
        let maximum = if changes { format!(" MAXIMUM={maximum}") } else { String::new() };
        self.writer
            .line(&format!("TEMPERATURE_WAIT SENSOR=\"heater_generic {name}\" MINIMUM={minimum}{maximum}"));
    }

    /// A pause for the operator.
    fn pause(&mut self, reason: PauseReason) {
        match reason {
            PauseReason::Look(next) => {
                self.writer.comment(&format!("pause: before={}", next + 1));
                self.writer.comment("look at the last seam, press start");
            }
            PauseReason::Beam => {
                self.writer.comment("beam: armed_by=operator");
                self.writer.comment(ARM_BEAM);
            }
            PauseReason::Mark { number: index, place } => {
                let [x, y] = [place.x, place.y].map(number);
                self.writer.comment(&format!("mark: number={index} x_mm={x} y_mm={y}"));
                self.writer
                    .comment(&format!("the tip is above mark {index}: mark the sheet or look, press start"));
            }
            PauseReason::Tool(tool) => {
                self.writer.comment(&format!("tool: {}", tool_facts(tool)));
                for task in tool_tasks(tool) {
                    self.writer.comment(&task);
                }
            }
        }
        if let Some(run) = &self.whole {
            self.writer.line(&run.machine.script.pause);
        }
    }

    /// A wait for a seam to cool.
    fn cool(&mut self, wait: Duration) {
        if let Some(run) = &mut self.whole {
            run.clock.wait(wait.0);
        }
        self.writer.comment(&format!("cool: time_s={}", number(wait.0)));
        let unit = self.writer.facts.controller.dwell.unit;
        self.writer.line(&self.writer.spelling.dwell(unit, wait.0));
    }

    /// A seam between its ways down and up: of a laser with power.
    fn seal_run(&mut self, pieces: &[Segment]) {
        self.writer.set_beam(self.beam);
        for piece in pieces {
            self.seal(piece, None);
        }
    }

    /// One piece in contact, or on the way down or up, in as many strokes as the pace makes of it.
    fn seal(&mut self, piece: &Segment, heights: Option<(f64, f64)>) {
        self.progress();
        let Self { writer, whole: run, pacer, .. } = self;
        let unit = writer.facts.controller.dwell.unit;
        if let Some(run) = run {
            run.clock.bend(piece, heights, pacer.speed());
        }
        pacer.strokes(piece, heights, |stroke| {
            if let Some(run) = run {
                run.clock.add(stroke.piece.end(), stroke.height, stroke.seconds);
            }
            writer.cut(&stroke.piece, stroke.height, stroke.speed);
            if stroke.dwell > 0.0 {
                writer.line(&writer.spelling.dwell(unit, stroke.dwell));
            }
        });
    }

    /// Writes the progress of the job, at every whole per cent of its time.
    fn progress(&mut self) {
        let Some(run) = &mut self.whole else { return };
        let (total, elapsed) = (run.program.time, run.clock.elapsed);
        let percent = (100.0 * elapsed / total).floor().clamp(0.0, 100.0);
        if percent > run.percent {
            run.percent = percent;
            let remaining = (total - elapsed).max(0.0);
            self.writer.comment(&format!("progress: percent={percent} remaining_s={remaining:.0}"));
            if let Some(line) = self.writer.spelling.progress(percent, (remaining / 60.0).ceil()) {
                self.writer.line(&line);
            }
        }
    }
}
