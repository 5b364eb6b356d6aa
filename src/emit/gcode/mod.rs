//! G-code in every dialect.
//!
//! End points are rounded first; an arc's centre is then computed from the rounded points and the
//! exact radius, so that start, end and centre of every line of the file agree with each other.
//! Comments of the form `; key: word=value ...` carry what a reader of the file alone needs to know;
//! the last line, after the program's end, counts the lines, so that a file cut short shows.
//!
//! The **writer** spells lines into any sink, one at a time; the **header** states facts; a **speech** spells what
//! dialects say differently; this room goes through a program's steps.

mod fluidnc;
mod generic;
mod grbl;
mod grblhal;
mod header;
mod klipper;
mod linuxcnc;
mod marlin;
mod reprapfirmware;
mod speech;
mod writer;

use std::fmt;

use crate::emit::gcode::header::{header, seam_facts};
use crate::emit::gcode::writer::Writer;
use crate::geom::{Point, Segment};
use crate::plan::{CHECK_LENGTH, Clock, Pacer, Program, Step, height_of};
use crate::spec::{Heating, Machine, Seal, Spec};
use crate::units::Length;

/// What the writing of a program needs to know beside the program.
#[derive(Clone, Copy, Debug)]
pub struct Facts<'a> {
    /// What the user calls the design; any text.
    pub name: &'a str,
    /// Temperature, speed, band and overlap.
    pub seal: &'a Seal,
    /// Largest deviation from the exact geometry.
    pub path: Length,
    /// The machine.
    pub machine: &'a Machine,
}

/// The program as text.
pub fn gcode(spec: &Spec, machine: &Machine, program: &Program) -> String {
    let facts = Facts { name: &spec.name, seal: &spec.seal, path: spec.accuracy.path, machine };
    let mut out = String::new();
    // A String takes everything.
    let _ = write_gcode(&mut out, facts, program);
    out
}

/// Writes the program into `out`, line by line, in constant memory.
///
/// # Errors
/// Those of `out`.
pub fn write_gcode(out: &mut impl fmt::Write, facts: Facts<'_>, program: &Program) -> fmt::Result {
    let mut job = Job::new(facts, program, Writer::new(out, facts), 0);
    header(&mut job.writer, facts, program)?;
    for line in &facts.machine.start {
        job.writer.line(line)?;
    }
    for step in &program.steps {
        job.step(step)?;
    }
    for line in &facts.machine.end {
        job.writer.line(line)?;
    }
    job.writer.sentinel()
}

/// Writes `steps` alone, with the iron at `from`, without header, start and end; the lines' number.
///
/// # Errors
/// Those of `out`.
pub fn write_steps(
    out: &mut impl fmt::Write,
    facts: Facts<'_>,
    program: &Program,
    from: Point,
) -> Result<usize, fmt::Error> {
    let mut writer = Writer::new(out, facts);
    writer.at = writer.round(from);
    // No progress here: it is that of the whole job.
    let mut job = Job::new(facts, program, writer, 100);
    for step in &program.steps {
        job.step(step)?;
    }
    Ok(job.writer.lines)
}

/// The feed check: every program of `checks` between two pauses, so that it can be timed. Nothing is heated.
pub fn feed_check(spec: &Spec, machine: &Machine, checks: &[(&'static str, Program)]) -> String {
    let facts = Facts { name: &spec.name, seal: &spec.seal, path: spec.accuracy.path, machine };
    let mut out = String::new();
    // A String takes everything.
    let _ = write_feed_check(&mut out, facts, checks);
    out
}

fn write_feed_check(
    out: &mut impl fmt::Write,
    facts: Facts<'_>,
    checks: &[(&'static str, Program)],
) -> fmt::Result {
    let mut writer = Writer::new(out, facts);
    writer.comment("stargrip-cam feedcheck program")?;
    writer.comment("cold, at travel height: time each line with a watch")?;
    for line in &facts.machine.requires {
        writer.requirement(&format!("requires: {line}"))?;
    }
    for line in &facts.machine.start {
        writer.line(line)?;
    }
    writer.height(facts.machine.heights.park.0)?;
    for (name, program) in checks {
        let seconds = CHECK_LENGTH / facts.seal.speed.0;
        let speed = header::number(facts.seal.speed.0);
        writer
            .comment(&format!("next: {CHECK_LENGTH} mm {name}, must take {seconds:.1} s at {speed} mm/s"))?;
        let mut job = Job::new(facts, program, writer, 100);
        for (i, step) in program.steps.iter().enumerate() {
            if i + 1 == program.steps.len() {
                job.writer.line(&facts.machine.pause)?;
            }
            job.step(step)?;
        }
        job.writer.line(&facts.machine.pause)?;
        writer = job.writer;
    }
    writer.height(facts.machine.heights.park.0)?;
    for line in &facts.machine.end {
        writer.line(line)?;
    }
    writer.sentinel()
}

struct Job<'a, W> {
    facts: Facts<'a>,
    program: &'a Program,
    writer: Writer<'a, W>,
    clock: Clock<'a>,
    pacer: Pacer,
    /// The last per cent that was said.
    percent: u32,
}

impl<'a, W: fmt::Write> Job<'a, W> {
    /// A job at its beginning; `percent` 100 to say no progress.
    fn new(facts: Facts<'a>, program: &'a Program, writer: Writer<'a, W>, percent: u32) -> Self {
        let (clock, pacer) = (Clock::new(facts.machine), Pacer::new(program.pace, facts.seal.speed.0));
        Self { facts, program, writer, clock, pacer, percent }
    }

    fn step(&mut self, step: &Step) -> fmt::Result {
        let machine = self.facts.machine;
        match step {
            Step::Height(level) => {
                self.clock.height(*level);
                self.writer.height(height_of(machine, *level))
            }
            Step::Heat(_) => self.heat(),
            Step::Travel(to) => {
                self.clock.travel(*to);
                self.writer.travel(*to)
            }
            Step::Seam(i) => {
                // Every seam states its feed, so that a job can go on there.
                self.writer.feed = None;
                let facts = seam_facts("seam", i + 1, &self.program.seams[*i]);
                self.writer.comment(&facts)
            }
            Step::TouchDown(ramp) => {
                self.pacer = Pacer::new(self.program.pace, self.facts.seal.speed.0);
                ramp.with_heights().try_for_each(|(piece, from, to)| self.seal(piece, Some((from, to))))
            }
            Step::Lift(ramp) => {
                ramp.with_heights().try_for_each(|(piece, from, to)| self.seal(piece, Some((from, to))))
            }
            Step::Seal(pieces) => pieces.iter().try_for_each(|piece| self.seal(piece, None)),
            Step::Trace(pieces) => {
                let speed = machine.trace_speed.0;
                pieces.iter().try_for_each(|piece| self.writer.cut(piece, None, speed))
            }
        }
    }

    fn heat(&mut self) -> fmt::Result {
        let (machine, temperature) = (self.facts.machine, self.facts.seal.temperature);
        let t = header::number(temperature.0);
        self.writer.comment(&format!("heat: temperature_C={t}"))?;
        match machine.heating {
            Heating::Operator => {
                let told = format!("set the iron to {t} C, standby off, wait until hot, press start");
                self.writer.comment(&told)?;
                self.writer.line(&machine.pause)
            }
            Heating::Hotend => self.writer.line(&self.writer.speech.heat(temperature)),
        }
    }

    /// One piece in contact, or on the way down or up, in as many strokes as the pace makes of it.
    fn seal(&mut self, piece: &Segment, heights: Option<(f64, f64)>) -> fmt::Result {
        self.progress()?;
        let Self { writer, clock, pacer, facts, .. } = self;
        let unit = facts.machine.dwell.unit;
        let mut written = Ok(());
        pacer.strokes(piece, heights, |stroke| {
            clock.add(stroke.piece.end(), stroke.height, stroke.seconds);
            if written.is_ok() {
                written = writer.cut(&stroke.piece, stroke.height, stroke.speed);
            }
            if written.is_ok() && stroke.dwell > 0.0 {
                written = writer.line(&writer.speech.dwell(unit, stroke.dwell));
            }
        });
        written
    }

    /// Says how far the job is, at every whole per cent of its time.
    fn progress(&mut self) -> fmt::Result {
        let total = self.program.time;
        let (mut percent, done) = (self.percent, 100.0 * self.clock.elapsed / total);
        while percent < 100 && f64::from(percent) + 1.0 <= done {
            percent += 1;
        }
        if percent == self.percent {
            return Ok(());
        }
        self.percent = percent;
        let left = (total - self.clock.elapsed).max(0.0);
        self.writer.comment(&format!("progress: percent={percent} remaining_s={left:.0}"))?;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a job takes days at most"
        )]
        let minutes = (left / 60.0).ceil() as u32;
        match self.writer.speech.progress(percent, minutes) {
            Some(line) => self.writer.line(&line),
            None => Ok(()),
        }
    }
}
