//! The text of a program as a controller reads it: lines of words, each a letter and a number. It shares no code with the writers, nor with
//! the reader of `verify`.

use std::collections::BTreeMap;

/// The command in a line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Command {
    /// G0 to G3.
    Move(Words),
    /// G4, with its unscaled P word.
    Dwell(f64),
    /// A pause, a wait for a heater, or the end: all earlier motion stops first.
    Halt,
    /// M203 I: the lowest feed, mm/min (RepRapFirmware).
    LowestFeed(f64),
}

/// The words of a move.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Words {
    /// 0 to 3.
    pub(crate) code: u8,
    /// X, Y and Z, if present.
    pub(crate) to: [Option<f64>; 3],
    /// I and J.
    pub(crate) center: [f64; 2],
    /// F, mm/min.
    pub(crate) feed: Option<f64>,
}

/// A program: its commands with their lines, and the figures that its comments state.
pub(crate) struct Text {
    pub(crate) commands: Vec<(usize, Command)>,
    /// `total.time_s` for the value in `; total: ... time_s=20302`.
    pub(crate) facts: BTreeMap<String, f64>,
    /// Line, per cent and seconds to go of every `; progress:`.
    pub(crate) progress: Vec<(usize, f64, f64)>,
}

impl Text {
    pub(crate) fn read(code: &str) -> Self {
        let mut text = Self { commands: Vec::new(), facts: BTreeMap::new(), progress: Vec::new() };
        for (line, i) in code.lines().zip(1..) {
            let comment = line.strip_prefix(';').or_else(|| line.strip_prefix('(')?.strip_suffix(')'));
            match comment {
                Some(comment) => {
                    text.figures(comment.trim());
                    text.progress.extend(progress(i, comment.trim()));
                }
                None => text.commands.extend(command(line).map(|command| (i, command))),
            }
        }
        text
    }

    /// A figure in the comments.
    pub(crate) fn fact(&self, name: &str) -> Option<f64> {
        self.facts.get(name).copied()
    }

    fn figures(&mut self, comment: &str) {
        let Some((key, rest)) = comment.split_once(": ") else { return };
        for (name, value) in rest.split(' ').filter_map(|word| word.split_once('=')) {
            if let Ok(value) = value.parse() {
                let _ = self.facts.entry(format!("{key}.{name}")).or_insert(value);
            }
        }
    }
}

fn progress(line: usize, comment: &str) -> Option<(usize, f64, f64)> {
    let (percent, rest) = comment.strip_prefix("progress: percent=")?.split_once(" remaining_s=")?;
    Some((line, percent.parse().ok()?, rest.parse().ok()?))
}

fn command(line: &str) -> Option<Command> {
    // Klipper's own commands are words, not letters.
    match line.split(' ').next()? {
        "PAUSE" => return Some(Command::Halt),
        word if word.contains('_') => return None,
        _ => {}
    }
    let words: BTreeMap<char, f64> = line
        .split(' ')
        .filter_map(|word| Some((word.chars().next()?, word.get(1..)?.parse().ok()?)))
        .collect();
    let first = line.split(' ').next()?;
    let word = |letter| words.get(&letter).copied();
    let center = [word('I').unwrap_or(0.0), word('J').unwrap_or(0.0)];
    match first {
        "G0" | "G1" | "G2" | "G3" => Some(Command::Move(Words {
            code: first.as_bytes()[1] - b'0',
            to: [word('X'), word('Y'), word('Z')],
            center,
            feed: word('F'),
        })),
        "G4" => Some(Command::Dwell(word('P').unwrap_or(0.0))),
        "M203" => word('I').map(Command::LowestFeed),
        // A laser is armed and switched off at rest: GRBL, gcode.c, spindle_sync.
        "M0" | "M2" | "M4" | "M5" | "M109" | "M226" | "M400" => Some(Command::Halt),
        _ => None,
    }
}

#[test]
fn words_and_figures_are_read() {
    let text = Text::read(
        "; total: length_mm=2.5 time_s=7\nG1 X1 Y-2.5 F6\nG4 P0.249\nSET_IDLE_TIMEOUT TIMEOUT=9\nM0\n",
    );
    assert_eq!(text.fact("total.time_s"), Some(7.0));
    let end = [Some(1.0), Some(-2.5), None];
    let cut = Command::Move(Words { code: 1, to: end, center: [0.0; 2], feed: Some(6.0) });
    assert_eq!(text.commands, [(2, cut), (3, Command::Dwell(0.249)), (5, Command::Halt)]);
}
