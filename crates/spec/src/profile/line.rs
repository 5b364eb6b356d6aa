//! A line of the profile that programs carry as it is: the lines that are allowed, and their effects.
//!
//! This is a list of allowed lines: the modes in which programs are written, the settings whose values can be compared with the
//! seal, a heater that is switched off, the pause and the end. Every other line is refused.

use crate::machine::Limits;
use crate::service::Service;
use crate::units::{Acceleration, Duration, Speed};
use crate::vocabulary::{Command, Vocabulary};

/// A list of lines in `[program]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LinePart {
    /// Before the first move.
    Start,
    /// The line at which the machine waits for the operator.
    Pause,
    /// After the last move.
    End,
}

impl LinePart {
    /// The key that holds it.
    pub(super) fn key(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Pause => "pause",
            Self::End => "end",
        }
    }
}

/// The effect of an allowed line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Effect {
    /// Modes of the controller.
    Modes,
    /// A setting.
    Setting(Limits),
    /// A heater is switched off.
    HeaterOff,
    /// A laser is switched off.
    BeamOff,
    /// The machine is put in order.
    Service(Service),
    /// The machine waits for the operator.
    Pause,
    /// The program is over.
    End,
}

/// Longest number in a line, in characters.
const NUMBER_LENGTH: usize = 12;

/// Parameters of Klipper's SET_VELOCITY_LIMIT beside VELOCITY and ACCEL: of corners and short moves (docs/G-Codes.md).
const OTHER_LIMITS: [&str; 3] = ["ACCEL_TO_DECEL", "MINIMUM_CRUISE_RATIO", "SQUARE_CORNER_VELOCITY"];

/// The effect of `line` on a controller with `vocabulary`; `None` if programs may not carry it.
pub(super) fn effect(line: &str, vocabulary: Vocabulary) -> Option<Effect> {
    if let Some(service) = Service::read(line, vocabulary.dialect) {
        return Some(Effect::Service(service));
    }
    if let Some((word, command)) = whole_word(line, vocabulary) {
        let parameters = line[word.len()..].split_whitespace();
        return match command {
            Command::Pause if line == word => Some(Effect::Pause),
            Command::HeatOnly => turns_off(parameters).then_some(Effect::HeaterOff),
            Command::Setting => named_setting(word, parameters).map(Effect::Setting),
            _ => None,
        };
    }
    let parts = words(line)?;
    let command = |(letter, number): &(u8, f64)| vocabulary.command(*letter, *number);
    match (parts.first().and_then(command)?, &parts[1..]) {
        (Command::Setting, parameters) => setting(parts[0], parameters).map(Effect::Setting),
        (Command::HeatOnly, [(b'S', 0.0)] | [(b'T', _), (b'S', 0.0)]) => Some(Effect::HeaterOff),
        (Command::Pause, []) => Some(Effect::Pause),
        (Command::BeamOff, []) => Some(Effect::BeamOff),
        (Command::End, []) => Some(Effect::End),
        _ => {
            let modes: Vec<Command> = parts.iter().map(command).collect::<Option<_>>()?;
            let groups = |i: usize| modes[..i].iter().any(|other| other.group() == modes[i].group());
            let right = modes.iter().all(|mode| is_mode(*mode)) && !(0..modes.len()).any(groups);
            right.then_some(Effect::Modes)
        }
    }
}

/// The lines of `part` that programs for `vocabulary` may carry, in words.
pub(super) fn allowed(part: LinePart, vocabulary: Vocabulary) -> String {
    let mut names: Vec<String> = Vec::new();
    for (letter, number, command) in vocabulary.codes() {
        let code = format!("{letter}{number}");
        names.extend(match (command, part) {
            (Command::Pause, LinePart::Pause) | (Command::End, LinePart::End) => Some(code),
            (_, LinePart::Pause) => None,
            (Command::HeatOnly, _) => Some(format!("{code} S0")),
            (Command::Setting, _) if code == "M203" => Some("M203 I..".to_owned()),
            (Command::Setting, _) if code == "M205" => Some("M205 S.. T..".to_owned()),
            (Command::Setting | Command::BeamOff, _) => Some(code),
            (mode, _) if is_mode(mode) => Some(code),
            _ => None,
        });
    }
    let words = vocabulary.words.iter().filter(|(_, command)| match part {
        LinePart::Pause => *command == Command::Pause,
        LinePart::Start | LinePart::End => matches!(command, Command::Setting | Command::HeatOnly),
    });
    names.extend(words.map(|(word, command)| match command {
        Command::HeatOnly => format!("{word} HEATER=.. TARGET=0"),
        _ => (*word).to_owned(),
    }));
    if part == LinePart::Start {
        names.extend(Service::lines(vocabulary.dialect));
    }
    names.join(", ")
}

/// Whether programs are written in this mode.
fn is_mode(command: Command) -> bool {
    use Command as C;
    matches!(
        command,
        C::PlaneXy | C::Millimetres | C::Absolute | C::CentersRelative | C::PerMinute | C::ExactPath
    )
}

/// The word of more than a letter with which the line begins.
fn whole_word(line: &str, vocabulary: Vocabulary) -> Option<(&'static str, Command)> {
    let mut words = vocabulary.words.iter();
    let word = words.find(|(word, _)| {
        line.strip_prefix(word).is_some_and(|rest| rest.is_empty() || rest.starts_with(' '))
    });
    word.copied()
}

/// Whether these parameters of SET_HEATER_TEMPERATURE turn a heater off.
fn turns_off<'a>(mut parameters: impl Iterator<Item = &'a str>) -> bool {
    let is_heater = parameters.next().is_some_and(|heater| heater.starts_with("HEATER="));
    is_heater && parameters.next() == Some("TARGET=0") && parameters.next().is_none()
}

/// Each letter of a line with its number; `None` if anything else is in it.
fn words(line: &str) -> Option<Vec<(u8, f64)>> {
    let mut words = Vec::new();
    let mut rest = line.trim_ascii();
    while let Some(letter) = rest.bytes().next() {
        if !letter.is_ascii_uppercase() {
            return None;
        }
        let tail = &rest[1..];
        let end = tail.find(|c: char| !(c.is_ascii_digit() || ".-".contains(c))).unwrap_or(tail.len());
        words.push((letter, number(&tail[..end])?));
        rest = tail[end..].trim_ascii_start();
    }
    Some(words)
}

/// A decimal number without an exponent.
fn number(text: &str) -> Option<f64> {
    let plain = text.len() <= NUMBER_LENGTH && text.bytes().all(|b| b.is_ascii_digit() || b".-".contains(&b));
    text.parse().ok().filter(|_| plain)
}

/// A setting that is a code with parameters.
fn setting(code: (u8, f64), parameters: &[(u8, f64)]) -> Option<Limits> {
    let lowest_speed = match (code, parameters) {
        ((b'T', _), []) => return Some(Limits::default()),
        // RepRapFirmware, docs.duet3d.com, M203: I is the lowest feed, mm/min.
        ((b'M', 203.0), [(b'I', feed)]) if *feed > 0.0 => feed / 60.0,
        // Marlin (planner.cpp, _populate_block): S is the lowest speed of moves that extrude, T of all others, mm/s.
        ((b'M', 205.0), [first, rest @ ..]) if rest.len() < 2 => {
            let is = |(letter, speed): &(u8, f64)| b"ST".contains(letter) && *speed >= 0.0;
            let repeated = rest.iter().any(|(letter, _)| *letter == first.0);
            let right = parameters.iter().all(is) && !repeated;
            if !right {
                return None;
            }
            parameters.iter().map(|(_, speed)| *speed).fold(0.0, f64::max)
        }
        _ => return None,
    };
    Some(Limits { lowest_speed: Some(Speed(lowest_speed)), ..Limits::default() })
}

/// A setting of Klipper: a word with `NAME=number` parameters.
fn named_setting<'a>(word: &str, parameters: impl Iterator<Item = &'a str>) -> Option<Limits> {
    // The parameters are read first: each once, with a number. Then the word decides which of them it may have; any other
    // makes the line one that is not understood.
    let mut settings: Vec<(&str, f64)> = Vec::new();
    for parameter in parameters {
        let (name, value) = parameter.split_once('=')?;
        let value =
            number(value).filter(|value| *value > 0.0 || OTHER_LIMITS.contains(&name) && *value >= 0.0)?;
        if settings.iter().any(|(other, _)| *other == name) {
            return None;
        }
        settings.push((name, value));
    }
    match (word, settings.as_slice()) {
        ("SET_IDLE_TIMEOUT", [("TIMEOUT", seconds)]) => {
            Some(Limits { idle_timeout: Some(Duration(*seconds)), ..Limits::default() })
        }
        ("SET_VELOCITY_LIMIT", [_, ..]) => {
            let [velocity, acceleration] = ["VELOCITY", "ACCEL"]
                .map(|name| settings.iter().find(|(other, _)| *other == name).map(|(_, value)| *value));
            let limits = Limits {
                top_speed: velocity.map(Speed),
                acceleration: acceleration.map(Acceleration),
                ..Limits::default()
            };
            let mut names = settings.iter().map(|(name, _)| name);
            names
                .all(|name| ["VELOCITY", "ACCEL"].contains(name) || OTHER_LIMITS.contains(name))
                .then_some(limits)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dialect::Dialect;

    fn effect_of(dialect: Dialect, line: &str) -> Option<Effect> {
        effect(line, Vocabulary::for_dialect(dialect))
    }

    #[test]
    fn modes_settings_and_switching_off_are_allowed() {
        for (dialect, line) in [
            (Dialect::Generic, "G21"),
            (Dialect::Grbl, "G17 G90 G94"),
            (Dialect::Grbl, "G21G90"),
            (Dialect::Grbl, "G91.1"),
            (Dialect::LinuxCnc, "G61"),
        ] {
            assert_eq!(effect_of(dialect, line), Some(Effect::Modes), "{line}");
        }
        let setting = |dialect, line| match effect_of(dialect, line) {
            Some(Effect::Setting(set)) => set,
            other => panic!("{line}: {other:?}"),
        };
        let no_limits = Limits::default();
        assert_eq!(setting(Dialect::RepRapFirmware, "T0"), no_limits);
        for (dialect, line, speed) in
            [(Dialect::RepRapFirmware, "M203 I6", 0.1), (Dialect::Marlin, "M205 S0 T2", 2.0)]
        {
            assert_eq!(setting(dialect, line), Limits { lowest_speed: Some(Speed(speed)), ..no_limits });
        }
        assert_eq!(
            setting(Dialect::Klipper, "SET_IDLE_TIMEOUT TIMEOUT=86400"),
            Limits { idle_timeout: Some(Duration(86400.0)), ..no_limits }
        );
        assert_eq!(
            setting(Dialect::Klipper, "SET_VELOCITY_LIMIT ACCEL=500 VELOCITY=50"),
            Limits { top_speed: Some(Speed(50.0)), acceleration: Some(Acceleration(500.0)), ..no_limits }
        );
        assert_eq!(effect_of(Dialect::Marlin, "M104 S0"), Some(Effect::HeaterOff));
        assert_eq!(effect_of(Dialect::Marlin, "M84"), Some(Effect::End));
        assert_eq!(effect_of(Dialect::Klipper, "PAUSE"), Some(Effect::Pause));
        assert_eq!(effect_of(Dialect::RepRapFirmware, "M226"), Some(Effect::Pause));
    }

    #[test]
    fn everything_else_is_not() {
        for (_, dialect) in Dialect::ALL {
            for line in [
                "",
                "G0 Z-50",
                "g21",
                "G20",
                "G91",
                "G92 Z0",
                "G28 E",
                "M112",
                "M3",
                "M104 S1",
                "M104",
                "M109 S0",
                "G21 G21",
                "G21 X5",
                "M203",
                "M203 S1",
                "M205",
                "M205 X5",
                "M205 S0 S0",
                "SET_IDLE_TIMEOUT",
                "SET_IDLE_TIMEOUT TIMEOUT=0",
                "SET_VELOCITY_LIMIT",
                "SET_VELOCITY_LIMIT VELOCITY=0",
                "SET_VELOCITY_LIMIT VELOCITY=5 VELOCITY=6",
                "PAUSE X=1",
                "RUN_SHELL_COMMAND CMD=x",
                "G21 ; mm",
                "G21 (mm)",
                "; G21",
                "%",
                "/G21",
                "N5 G21",
                "T1",
                "M0 M2",
                "G21 M0",
                "G1e1",
                "G",
                "G--5",
            ] {
                assert_eq!(effect_of(dialect, line), None, "{dialect:?}: {line}");
            }
        }
    }

    #[test]
    fn the_allowed_lines_are_named() {
        let vocabulary = Vocabulary::for_dialect(Dialect::Klipper);
        assert_eq!(
            allowed(LinePart::Start, vocabulary),
            "G21, G90, M104 S0, SET_IDLE_TIMEOUT, SET_VELOCITY_LIMIT, SET_HEATER_TEMPERATURE HEATER=.. TARGET=0, \
             G28, M140 S.., M190 S.., M107, M220 S100, BED_MESH_CALIBRATE, BED_MESH_PROFILE LOAD=.."
        );
        assert_eq!(allowed(LinePart::Pause, vocabulary), "PAUSE");
        assert_eq!(
            allowed(LinePart::End, Vocabulary::for_dialect(Dialect::Grbl)),
            "G17, G21, G61, G90, G91.1, G94, M2, M30"
        );
    }
}
