//! G-code in every dialect.
//!
//! End points are rounded first; an arc's centre is then computed from the rounded points and the
//! exact radius, so that start, end and centre of every line of the file agree with each other.
//! Comments of the form `; key: word=value ...` carry the data that a reader of the file alone needs;
//! the last line, after the program's end, counts the lines, so that a file cut short shows.
//!
//! The **writer** writes lines into any sink, one at a time; the **header** states facts; a **dialect**'s row lists its
//! differences in spelling; this room goes through a program's steps.

mod dialect;
mod feed_check;
mod header;
mod writer;

use std::fmt;

use crate::emit::gcode::dialect::{Spelling, heat};
use crate::emit::gcode::header::{header, seam_facts};
use crate::emit::gcode::writer::Writer;
use crate::emit::number::number;
use crate::plan::{Clock, Pace, Pacer, Program, Purpose, Step, height_of};
use crate::spec::{Dialect, Heating, Machine, Spec};
use crate::units::Readable;
use inflatable::geom::{Point, Segment};

pub use feed_check::{FEED_CHECK_TITLE, feed_check};
pub use writer::Facts;

/// The program as text.
pub fn gcode(spec: &Spec, machine: &Machine, program: &Program) -> String {
    let mut out = String::new();
    // A String takes everything.
    let _ = write_gcode(&mut out, spec, machine, program);
    out
}

/// Writes the program into `out`, line by line, in constant memory.
///
/// # Errors
/// The errors of `out`.
pub fn write_gcode(
    out: &mut impl fmt::Write,
    spec: &Spec,
    machine: &Machine,
    program: &Program,
) -> fmt::Result {
    let facts = Facts::new(spec, machine);
    let mut job = Job::new(facts, program.pace, Writer::new(out, facts));
    job.whole = Some(Whole { machine, program, clock: Clock::new(machine), percent: 0 });
    header(&mut job.writer, facts, machine, program)?;
    for line in &machine.script.start {
        job.writer.line(line)?;
    }
    for step in &program.steps {
        job.step(step)?;
    }
    for line in &machine.script.end {
        job.writer.line(line)?;
    }
    if let Some(estimate) =
        job.writer.spelling.estimate(program.time).filter(|_| program.purpose == Purpose::Seal)
    {
        job.writer.comment(&estimate)?;
    }
    job.writer.sentinel()
}

/// The text that hosts of the dialect read of a program that takes `seconds`; `None` where they read none.
pub fn estimate(dialect: Dialect, seconds: f64) -> Option<String> {
    Spelling::of(dialect).estimate(seconds)
}

/// Writes `steps` alone at `pace`, with the iron at `from`, without header, start, pauses and end; the lines' number.
///
/// # Errors
/// The errors of `out`.
pub fn write_steps(
    out: &mut impl fmt::Write,
    facts: Facts<'_>,
    steps: &[Step],
    pace: Pace,
    from: Point,
) -> Result<usize, fmt::Error> {
    let mut writer = Writer::new(out, facts);
    writer.at = writer.round(from);
    let mut job = Job::new(facts, pace, writer);
    for step in steps {
        job.step(step)?;
    }
    Ok(job.writer.lines)
}

/// The way through a program's steps.
struct Job<'a, W> {
    facts: Facts<'a>,
    pace: Pace,
    writer: Writer<'a, W>,
    pacer: Pacer,
    /// The program that the steps are all of; `None` for a few steps alone.
    whole: Option<Whole<'a>>,
}

/// The data that only a whole program has: seams with their figures, an operator, progress.
struct Whole<'a> {
    machine: &'a Machine,
    program: &'a Program,
    clock: Clock<'a>,
    /// The last per cent that was written.
    percent: u32,
}

impl<'a, W: fmt::Write> Job<'a, W> {
    /// The beginning of a way through a few steps.
    fn new(facts: Facts<'a>, pace: Pace, writer: Writer<'a, W>) -> Self {
        Self { facts, pace, writer, pacer: Pacer::new(pace, facts.seal.speed.0), whole: None }
    }

    fn step(&mut self, step: &Step) -> fmt::Result {
        match step {
            Step::Height(level) => {
                if let Some(whole) = &mut self.whole {
                    whole.clock.height(*level);
                }
                self.writer.height(height_of(self.facts.process, *level))
            }
            Step::Heat(_) => self.heat(),
            Step::Travel(to) => {
                if let Some(whole) = &mut self.whole {
                    whole.clock.travel(*to);
                }
                self.writer.travel(*to)
            }
            Step::Seam(i) => {
                // Every seam states its feed, so that a job can go on there.
                self.writer.feed = None;
                let seam = self.whole.as_ref().and_then(|whole| whole.program.seams.get(*i));
                seam.map_or(Ok(()), |seam| self.writer.comment(&seam_facts("seam", i + 1, seam)))
            }
            Step::TouchDown(ramp) => {
                self.pacer = Pacer::new(self.pace, self.facts.seal.speed.0);
                ramp.with_heights().try_for_each(|(piece, from, to)| self.seal(piece, Some((from, to))))
            }
            Step::Lift(ramp) => {
                ramp.with_heights().try_for_each(|(piece, from, to)| self.seal(piece, Some((from, to))))
            }
            Step::Seal(pieces) => pieces.iter().try_for_each(|piece| self.seal(piece, None)),
            Step::Trace(pieces) => {
                let speed = self.facts.process.trace_speed.0;
                pieces.iter().try_for_each(|piece| self.writer.cut(piece, piece.end(), None, speed))
            }
        }
    }

    fn heat(&mut self) -> fmt::Result {
        let temperature = self.facts.seal.temperature;
        let t = number(temperature.0);
        self.writer.comment(&format!("heat: temperature_C={t}"))?;
        match self.facts.controller.heating {
            Heating::Operator => {
                // As many digits as a line has room for.
                let t = Readable(temperature.0);
                let told = format!("set the iron to {t} C, standby off, wait until hot, press start");
                self.writer.comment(&told)?;
                let pause = self.whole.as_ref().map(|whole| &whole.machine.script.pause);
                pause.map_or(Ok(()), |pause| self.writer.line(pause))
            }
            Heating::Hotend => self.writer.line(&heat(temperature)),
        }
    }

    /// One piece in contact, or on the way down or up, in as many strokes as the pace makes of it.
    fn seal(&mut self, piece: &Segment, heights: Option<(f64, f64)>) -> fmt::Result {
        self.progress()?;
        let Self { writer, whole, pacer, facts, .. } = self;
        let unit = facts.controller.dwell.unit;
        let mut written = Ok(());
        pacer.strokes(piece, heights, |stroke| {
            let end = stroke.piece.end();
            if let Some(whole) = whole {
                whole.clock.add(end, stroke.height, stroke.seconds);
            }
            if written.is_ok() {
                written = writer.cut(&stroke.piece, end, stroke.height, stroke.speed);
            }
            if written.is_ok() && stroke.dwell > 0.0 {
                written = writer.line(&writer.spelling.dwell(unit, stroke.dwell));
            }
        });
        written
    }

    /// Writes the progress of the job, at every whole per cent of its time.
    fn progress(&mut self) -> fmt::Result {
        let Some(whole) = &mut self.whole else { return Ok(()) };
        let Some((percent, left)) = whole.next_percent() else { return Ok(()) };
        self.writer.comment(&format!("progress: percent={percent} remaining_s={left:.0}"))?;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a job takes days at most"
        )]
        let minutes = (left / 60.0).ceil() as u32;
        match self.writer.spelling.progress(percent, minutes) {
            Some(line) => self.writer.line(&line),
            None => Ok(()),
        }
    }
}

impl Whole<'_> {
    /// The whole per cent of the time that is done, with the seconds to go; `None` if it was written before.
    fn next_percent(&mut self) -> Option<(u32, f64)> {
        let total = self.program.time;
        let (mut percent, done) = (self.percent, 100.0 * self.clock.elapsed / total);
        while percent < 100 && f64::from(percent) + 1.0 <= done {
            percent += 1;
        }
        if percent == self.percent {
            return None;
        }
        self.percent = percent;
        Some((percent, (total - self.clock.elapsed).max(0.0)))
    }
}
