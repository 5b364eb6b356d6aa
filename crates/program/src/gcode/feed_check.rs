//! The feed check as text: each line between two pauses, so that it can be timed.

use crate::gcode::writer::Writer;
use crate::gcode::{Facts, Job};
use crate::number::number;
use crate::plan::{CHECK_LENGTH, Program, feed_check_seconds};
use spec::{Dialect, Machine, Spec};

/// The first comment of every feed check.
pub const FEED_CHECK_TITLE: &str = "stargrip-cam feedcheck program";

/// The feed check: every program of `checks` between two pauses, so that it can be timed. Nothing is heated.
pub fn feed_check(spec: &Spec, machine: &Machine, checks: &[(&'static str, Program)]) -> String {
    // Start and end are the profile's. Before each line the program goes to its start and pauses, so that a watch can be
    // started; the pause after it stops the watch.
    let (facts, script) = (Facts::new(spec, machine), &machine.script);
    let mut writer = Writer::new(facts);
    writer.comment(FEED_CHECK_TITLE);
    writer.comment("cold, at travel height: time each line with a watch");
    writer.comment("each pause must stop the machine where the comment before it says");
    if machine.controller.dialect == Dialect::Bambu {
        // A package states the time of its program.
        let seconds = feed_check_seconds(spec, machine, checks);
        writer.comment(&format!("total: time_s={seconds:.0}"));
    }
    for line in &script.requires {
        writer.requirement(&format!("requires: {line}"));
    }
    for line in &script.start {
        writer.line(line);
    }
    writer.height(machine.process.heights.park.0);
    for (name, program) in checks {
        let (seconds, speed) = (CHECK_LENGTH / spec.seal.speed.0, number(spec.seal.speed.0));
        writer.comment(&format!("next: {CHECK_LENGTH} mm {name}, must take {seconds:.1} s at {speed} mm/s"));
        let mut job = Job::new(program.pace(), writer);
        for (i, step) in program.steps.iter().enumerate() {
            if i + 1 == program.steps.len() {
                pause(&mut job.writer, machine);
            }
            job.step(step);
        }
        pause(&mut job.writer, machine);
        writer = job.writer;
    }
    writer.height(machine.process.heights.park.0);
    for line in &script.end {
        writer.line(line);
    }
    writer.finished()
}

/// A pause, with the position that the display must show: a machine that took a position for a displacement is elsewhere.
fn pause(writer: &mut Writer<'_>, machine: &Machine) {
    let height = writer.height_of(machine.process.heights.travel.0);
    let [x, y, z] = [writer.at.x, writer.at.y, height].map(number);
    writer.comment(&format!("must stop here, at X{x} Y{y} Z{z}"));
    writer.line(&machine.script.pause);
}
