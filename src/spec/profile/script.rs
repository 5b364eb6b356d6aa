//! The profile's own lines: start, pause, end, and what the operator has to see to.

use std::ops::Range;

use crate::spec::FaultCode;
use crate::spec::fault::{Fault, quoted};
use crate::spec::machine::{Controller, Script};
use crate::spec::profile::modes::check_modes;
use crate::spec::section::{Reader, Section};

/// Reads `[program]` for `controller`.
pub(super) fn read_script(reader: &mut Reader<'_>, controller: &Controller) -> Script {
    let length = controller.line_length;
    let mut program = reader.section("program");
    program.require(&[("start", "[\"G21\", \"G90\"]"), ("pause", "\"M0\""), ("end", "[\"M2\"]")]);
    let start = read_commands(&mut program, "start", length);
    check_modes(&mut program, &start, controller);
    let pause =
        program.text("pause").map(|(line, span)| read_command(&mut program, "pause", line, span, length));
    let end = read_commands(&mut program, "end", length);
    // Each becomes a comment that begins with "; requires: ".
    let requires = read_lines(&mut program, "requires", length - 12);
    Script { start, pause: pause.unwrap_or_default(), end, requires }
}

fn read_lines(s: &mut Section<'_, '_>, key: &'static str, length: usize) -> Vec<String> {
    let lines = s.texts(key).unwrap_or_default();
    lines.into_iter().map(|(line, span)| read_line(s, key, line, span, length)).collect()
}

fn read_commands(s: &mut Section<'_, '_>, key: &'static str, length: usize) -> Vec<String> {
    let lines = s.texts(key).unwrap_or_default();
    lines.into_iter().map(|(line, span)| read_command(s, key, line, span, length)).collect()
}

/// One line that the controller runs: it puts modes and settings into force, and neither moves nor heats.
fn read_command(s: &mut Section<'_, '_>, key: &str, line: &str, span: Range<usize>, length: usize) -> String {
    if let Some(danger) = danger(line).filter(|_| is_plain(line)) {
        let message = format!("a line of `{key}` is {}", quoted(line));
        let fault = Fault::error(FaultCode::ProgramLine, span.clone(), message);
        s.report(fault.label(format!("must not {danger}: a program is proven from its first word on")));
    }
    read_line(s, key, line, span, length)
}

fn is_plain(line: &str) -> bool {
    line.bytes().all(|byte| (b' '..=b'~').contains(&byte))
}

/// What a line would do that only a program's own steps may; `None` for modes, settings and comments.
fn danger(line: &str) -> Option<&'static str> {
    let code = line.split([';', '(']).next().unwrap_or_default();
    let words = words(code);
    let is = |letter: char, numbers: &[f64]| {
        words.iter().any(|(l, x)| *l == letter && x.is_some_and(|x| numbers.contains(&x.floor())))
    };
    // Klipper's longer words have no axes: `SET_VELOCITY_LIMIT VELOCITY=5` is cut at each letter.
    let plain = words.iter().all(|(_, number)| number.is_some());
    let off =
        words.iter().all(|(l, x)| *l != 'S' || *x == Some(0.0)) && !words.iter().any(|(l, _)| *l == 'R');
    if is('G', &[0.0, 1.0, 2.0, 3.0, 5.0, 28.0, 29.0, 30.0, 38.0]) {
        Some("move an axis")
    } else if is('G', &[10.0, 43.0, 51.0, 52.0, 53.0, 54.0, 55.0, 56.0, 57.0, 58.0, 59.0, 68.0, 92.0]) {
        Some("shift, scale or turn coordinates")
    } else if plain && words.iter().any(|(letter, _)| "XYZABCUVW".contains(*letter)) {
        Some("name an axis")
    } else if is('M', &[3.0, 4.0, 6.0, 7.0, 8.0, 62.0, 64.0, 98.0]) {
        Some("start a spindle, a coolant, a tool or another program")
    } else if is('M', &[104.0, 109.0]) && !off {
        Some("heat: the program heats once, to the seal's temperature")
    } else {
        None
    }
}

/// Each letter of a line of code with the number after it, if there is one.
fn words(code: &str) -> Vec<(char, Option<f64>)> {
    let code: String = code.chars().filter(|c| !c.is_whitespace()).map(|c| c.to_ascii_uppercase()).collect();
    let is_digit = |c: char| c.is_ascii_digit() || ".-+".contains(c);
    let starts = code.char_indices().filter(|(_, c)| c.is_ascii_alphabetic());
    starts
        .map(|(at, letter)| {
            let rest = &code[at + 1..];
            let end = rest.find(|c| !is_digit(c)).unwrap_or(rest.len());
            (letter, rest[..end].parse().ok())
        })
        .collect()
}

/// One line: printable ASCII, not longer than it can read.
fn read_line(s: &mut Section<'_, '_>, key: &str, line: &str, span: Range<usize>, length: usize) -> String {
    let label = if !is_plain(line) {
        "must be one line of printable ASCII".to_owned()
    } else if line.len() > length {
        format!("must be at most {length} characters, as `line_length` says; this line has {}", line.len())
    } else if line.trim().is_empty() {
        "must not be empty".to_owned()
    } else {
        return line.to_owned();
    };
    s.report(
        Fault::error(FaultCode::ProgramLine, span, format!("a line of `{key}` is {}", quoted(line)))
            .label(label),
    );
    String::new()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modes_settings_and_switching_off_are_no_danger() {
        for line in [
            "G21",
            "G17 G90 G94",
            "G91.1",
            "M203 I5",
            "T0",
            "M205 S0 T0",
            "M104 S0",
            "M84",
            "M2",
            "M226",
            "PAUSE",
            "SET_IDLE_TIMEOUT TIMEOUT=86400",
            "SET_VELOCITY_LIMIT VELOCITY=0.05 ACCEL=1",
            "M5",
            "M9",
            "; G0 Z-50",
            "G61",
            "M2 ;xxx",
            "M0",
        ] {
            assert_eq!(danger(line), None, "{line}");
        }
    }

    #[test]
    fn what_moves_shifts_switches_on_or_heats_is_one() {
        for (line, what) in [
            ("G0 Z-50", "move"),
            ("g0z-50", "move"),
            ("G 00 Z5", "move"),
            ("G28", "move"),
            ("G38.2 Z-5", "move"),
            ("Z-50", "name an axis"),
            ("G90 X5", "name an axis"),
            ("M203 Z5", "name an axis"),
            ("G92 Z0", "shift"),
            ("G10 L2 P1 Z5", "shift"),
            ("G54", "shift"),
            ("M3 S1000", "spindle"),
            ("M98 P1", "program"),
            ("M109 S200", "heat"),
            ("M104 S450", "heat"),
            ("M109 R300", "heat"),
            ("M104S5", "heat"),
        ] {
            assert!(danger(line).is_some_and(|found| found.contains(what)), "{line}: {:?}", danger(line));
        }
    }
}
