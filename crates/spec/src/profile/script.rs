//! The profile's own lines: start, pause, end, and the tasks of the operator.

use std::ops::Range;

use crate::FaultCode;
use crate::fault::{Fault, quoted};
use crate::machine::{Controller, Heating, Limits, Machine, Script};
use crate::profile::line::{Effect, LinePart, allowed, effect};
use crate::profile::modes::check_modes;
use crate::profile::order::{ServiceLine, check_services, is_last};
use crate::section::{Reader, Section};
use crate::vocabulary::{Command, Vocabulary};

/// Slack of speeds that are equal except for the conversion of mm/min, as a fraction.
const SLACK: f64 = 1e-9;

/// Reads `[program]`, whose lines must agree with `stated`, the profile without them.
pub(super) fn read_script(reader: &mut Reader<'_>, stated: &Machine) -> Script {
    let mut program = reader.section("program");
    program.require(&[("start", "[\"G21\", \"G90\"]"), ("pause", "\"M0\""), ("end", "[\"M2\"]")]);
    let (mut limits, mut services) = (Limits::default(), Vec::new());
    let start = read_commands(&mut program, LinePart::Start, stated, &mut limits, &mut services);
    check_modes(&mut program, &start, &stated.controller);
    let pause = program.text("pause");
    let pause = pause
        .map(|(line, span)| read_command(&mut program, LinePart::Pause, line, span, &stated.controller).0);
    let mut last_services = Vec::new();
    let end = read_commands(&mut program, LinePart::End, stated, &mut Limits::default(), &mut last_services);
    check_services(&mut program, &services, &last_services);
    check_heater_off(&mut program, &end, &stated.controller.heating);
    if stated.controller.laser.is_some() {
        check_beam_off(&mut program, LinePart::Start, &start);
        check_beam_off(&mut program, LinePart::End, &end);
    }
    let services = services.into_iter().map(|line| line.service).collect();
    // Each becomes a comment that begins with "; requires: ".
    let length = stated.controller.line_length - 12;
    let requires = program.texts("requires").unwrap_or_default().into_iter();
    let requires =
        requires.map(|(line, span)| read_line(&mut program, "requires", line, span, length)).collect();
    Script { start, pause: pause.unwrap_or_default(), end, requires, limits, services }
}

/// Reports an `end` that leaves a heater on that has a number or a name: `M104 S0` is for the tool in use.
fn check_heater_off(program: &mut Section<'_, '_>, end: &[String], heating: &Heating) {
    let heater_off = match heating {
        Heating::Operator | Heating::Hotend(None) => return,
        Heating::Hotend(Some(number)) => format!("M104 T{number} S0"),
        Heating::Heater(name) => format!("SET_HEATER_TEMPERATURE HEATER={name} TARGET=0"),
    };
    if program.contains("end") && !end.contains(&heater_off) {
        let problem = format!("`end` does not turn off the heater of `heating`, \"{}\"", heating.name());
        program.refuse(FaultCode::ProgramLine, "end", problem, format!("must hold \"{heater_off}\""));
    }
}

/// The word that switches a laser off.
const BEAM_OFF: &str = "M5";

/// Reports a part of a laser's program that does not switch the beam off: a program before may have left it on, and none leaves it on.
fn check_beam_off(program: &mut Section<'_, '_>, part: LinePart, lines: &[String]) {
    let key = part.key();
    if program.contains(key) && !lines.iter().any(|line| line.trim() == BEAM_OFF) {
        let problem = format!("`{key}` does not switch the laser off");
        program.refuse(FaultCode::ProgramLine, key, problem, format!("must hold \"{BEAM_OFF}\""));
    }
}

/// Reads a list of lines; the limits that they set go into `limits`, and their services into `services`.
fn read_commands(
    s: &mut Section<'_, '_>,
    part: LinePart,
    stated: &Machine,
    limits: &mut Limits,
    services: &mut Vec<ServiceLine>,
) -> Vec<String> {
    let key = part.key();
    let lines = s.texts(key).unwrap_or_default();
    let last = lines.len().checked_sub(1);
    let is_written = s.contains(key);
    let mut read = Vec::with_capacity(lines.len());
    let mut ends = false;
    for (i, (line, span)) in lines.into_iter().enumerate() {
        let (line, effect) = read_command(s, part, line, span.clone(), &stated.controller);
        match effect {
            Some(Effect::Setting(set)) => {
                if let Some(fault) = contradiction(key, &line, span, set, stated) {
                    s.report(fault);
                }
                *limits = limits.replaced_by(set);
            }
            Some(Effect::Service(service)) => {
                services.push(ServiceLine { service, text: line.clone(), span });
            }
            Some(Effect::End) if Some(i) != last => {
                let message = format!("a line of `{key}` is {}", quoted(&line));
                let label = "must be the last line: it ends the program";
                s.report(Fault::error(FaultCode::ProgramLine, span, message).label(label));
            }
            // A faulty line has been reported: it may be the one that ends the program.
            Some(Effect::End) | None => ends = true,
            _ => {}
        }
        read.push(line);
    }
    if part == LinePart::End && !ends && is_written {
        let vocabulary = Vocabulary::for_controller(&stated.controller);
        let ends = vocabulary.codes().filter(|(.., command)| *command == Command::End);
        let ends: Vec<String> = ends.map(|(letter, number, _)| format!("{letter}{number}")).collect();
        let allowed = format!("must have the last line {}", ends.join(" or "));
        s.refuse(FaultCode::ProgramLine, key, "`end` does not end the program", allowed);
    }
    read
}

/// The effect of one line that the controller runs; `None` if it was refused.
fn read_command(
    s: &mut Section<'_, '_>,
    part: LinePart,
    line: &str,
    span: Range<usize>,
    controller: &Controller,
) -> (String, Option<Effect>) {
    let (key, vocabulary) = (part.key(), Vocabulary::for_controller(controller));
    let line_effect = effect(line, vocabulary).filter(|effect| match effect {
        Effect::Modes | Effect::Setting(_) | Effect::HeaterOff | Effect::BeamOff => part != LinePart::Pause,
        Effect::Service(service) => part == LinePart::Start || part == LinePart::End && is_last(*service),
        Effect::Pause => part == LinePart::Pause,
        Effect::End => part == LinePart::End,
    });
    if is_plain(line) && !line.trim().is_empty() && line_effect.is_none() {
        let message = format!("a line of `{key}` is {}", quoted(line));
        let may = format!(
            "must be one of {}: every line of a program is proven, which needs to know what it does",
            allowed(part, vocabulary)
        );
        let remedy = if line.contains([';', '(']) {
            "programs contain no comments of a profile: write them after # here, or for the operator in `requires`"
        } else {
            "set anything else on the controller itself, before the program runs"
        };
        s.report(Fault::error(FaultCode::ProgramLine, span.clone(), message).label(may).help(remedy));
    }
    (read_line(s, key, line, span, controller.line_length), line_effect)
}

/// Limits that a line of a program sets for the moves that follow; `None` if it sets none, or is not allowed in a profile.
pub fn limits_set_by(line: &str, controller: &Controller) -> Option<Limits> {
    match effect(line.trim(), Vocabulary::for_controller(controller))? {
        Effect::Setting(set) => Some(set),
        _ => None,
    }
}

/// The reason why a line contradicts another setting of the profile.
fn contradiction(key: &str, line: &str, span: Range<usize>, set: Limits, stated: &Machine) -> Option<Fault> {
    let Machine { process, motion, .. } = stated;
    let (message, label) = match set {
        Limits { lowest_speed: Some(speed), .. } if speed.0 > motion.min_feed.0 * (1.0 + SLACK) => (
            format!("lets no move be slower than {speed}"),
            format!("must be at most {}, the `min_feed` of [motion]: change one of them", motion.min_feed),
        ),
        Limits { top_speed: Some(speed), .. }
            if speed.0 < process.travel_speed.0.max(process.trace_speed.0) * (1.0 - SLACK) =>
        {
            (
                format!("lets no move be faster than {speed}"),
                "must be at least `travel` and `trace` of [speeds]: change one of them".to_owned(),
            )
        }
        Limits { acceleration: Some(found), .. }
            if motion.acceleration.is_none_or(|a| (a.0 - found.0).abs() > SLACK * a.0) =>
        {
            (
                format!("sets an acceleration of {} mm/s^2", found.0),
                "must be the `acceleration` of [motion], by which travels are timed: write it there, too"
                    .to_owned(),
            )
        }
        _ => return None,
    };
    let message = format!("a line of `{key}`, {}, {message}", quoted(line));
    Some(Fault::error(FaultCode::Conflict, span, message).label(label))
}

fn is_plain(line: &str) -> bool {
    line.bytes().all(|byte| (b' '..=b'~').contains(&byte))
}

/// One line: printable ASCII, not longer than it can read.
fn read_line(s: &mut Section<'_, '_>, key: &str, line: &str, span: Range<usize>, length: usize) -> String {
    let label = if !is_plain(line) {
        "must be one line of printable ASCII".to_owned()
    } else if line.len() > length {
        format!("must be at most {length} characters (`line_length`); this line has {}", line.len())
    } else if line.trim().is_empty() {
        "must not be empty".to_owned()
    } else {
        return line.to_owned();
    };
    let message = format!("a line of `{key}` is {}", quoted(line));
    s.report(Fault::error(FaultCode::ProgramLine, span, message).label(label));
    String::new()
}
