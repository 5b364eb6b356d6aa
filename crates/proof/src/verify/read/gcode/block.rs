//! A line that the dialect understands: its commands and the values of its other words.

use crate::verify::read::gcode::Dialect;
use crate::verify::read::gcode::lexer::Word;
use crate::verify::{Finding, FindingCode};
use spec::Command;

/// Words that exclude each other.
const CONFLICT: FindingCode = FindingCode::ModalConflict;

/// The commands and values of one line.
#[derive(Clone, Debug, Default)]
pub(super) struct Block {
    pub(super) commands: Vec<Command>,
    /// The values of the capital letters.
    values: [Option<f64>; 26],
}

impl Block {
    /// Reads `words` into this block, replacing what it held; the first fault ends it.
    pub(super) fn read(&mut self, words: &[Word], dialect: &Dialect) -> Result<(), Finding> {
        self.commands.clear();
        self.values = [None; 26];
        for (place, word) in words.iter().enumerate() {
            if matches!(word.letter, b'G' | b'M') || (word.letter == b'T' && place == 0) {
                let Some(command) = dialect.vocabulary.command(word.letter, word.number) else {
                    let allowed = format!("codes of {}", dialect.name);
                    return Err(Finding::new(FindingCode::UnknownWord, word.text(), allowed));
                };
                if let Some(other) = self.commands.iter().find(|c| c.group() == command.group()) {
                    let fault = format!("{} ({command:?}) beside {other:?}", word.text());
                    return Err(Finding::new(CONFLICT, fault, "one code of each group on a line"));
                }
                self.commands.push(command);
                continue;
            }
            let parameters = dialect.vocabulary.parameters;
            if !parameters.as_bytes().contains(&word.letter) {
                return Err(Finding::new(
                    FindingCode::UnknownWord,
                    word.text(),
                    format!("words {parameters}"),
                ));
            }
            if self.values[usize::from(word.letter - b'A')].replace(word.number).is_some() {
                return Err(Finding::new(FindingCode::RepeatedWord, word.text(), "each letter once a line"));
            }
        }
        self.check(dialect)
    }

    /// This block is the command alone, whatever words of its own follow it.
    pub(super) fn set(&mut self, command: Command) {
        self.commands.clear();
        self.values = [None; 26];
        self.commands.push(command);
    }

    /// The value of a word.
    pub(super) fn value(&self, letter: u8) -> Option<f64> {
        self.values[usize::from(letter - b'A')]
    }

    /// Whether the line has any of these words.
    pub(super) fn has_any(&self, letters: &[u8]) -> bool {
        letters.iter().any(|letter| self.value(*letter).is_some())
    }

    /// Whether the line has the command.
    pub(super) fn has_command(&self, command: Command) -> bool {
        self.commands.contains(&command)
    }

    /// Words that contradict each other or belong to nothing on the line.
    ///
    /// A dwell and the commands that stand alone exclude others; a letter needs a command that reads it; then values are
    /// checked. The first fault is returned: a line with one fault is not executed.
    fn check(&self, dialect: &Dialect) -> Result<(), Finding> {
        let dwell = self.has_command(Command::Dwell);
        if dwell && self.has_any(b"XYZIJ") {
            return Err(Finding::new(CONFLICT, "a dwell with axis words", "P alone"));
        }
        if let Some(command) = self.commands.iter().find(|command| command.stands_alone()) {
            if self.commands.len() > 1 || self.has_any(b"XYZJF") {
                return Err(Finding::new(CONFLICT, format!("{command:?} beside other words"), "it alone"));
            }
            let heats = matches!(command, Command::HeatAndWait | Command::HeatOnly);
            let by_r = self.value(b'R').filter(|_| *command == Command::HeatAndWait);
            if by_r.is_some() && (!dialect.vocabulary.waits_by_r() || self.value(b'S').is_some()) {
                return Err(Finding::new(FindingCode::UnusedWord, "R with a heater", "S alone"));
            }
            if heats && !self.value(b'S').or(by_r).is_some_and(|celsius| celsius >= 0.0) {
                return Err(Finding::new(FindingCode::BadNumber, "heat without a temperature", "S, >= 0"));
            }
        } else if self.value(b'P').is_some() != dwell {
            return Err(Finding::new(FindingCode::UnusedWord, "P or a dwell, one of them", "both or none"));
        }
        let stray = b"PRST".iter().copied().find(|letter| {
            // The power of a laser may change in any line.
            let is_power = *letter == b'S' && dialect.vocabulary.drives_laser;
            self.value(*letter).is_some() && !self.is_read(*letter) && !is_power
        });
        if let Some(letter) = stray {
            let fault = format!("{} without its command", char::from(letter));
            return Err(Finding::new(FindingCode::UnusedWord, fault, "words that a command uses"));
        }
        if let Some(p) = self.value(b'P').filter(|p| *p < 0.0) {
            return Err(Finding::new(FindingCode::BadNumber, format!("P{p}"), "a time >= 0"));
        }
        if let Some(s) = self.value(b'S').filter(|s| *s < 0.0) {
            return Err(Finding::new(FindingCode::BadNumber, format!("S{s}"), "a power >= 0"));
        }
        if let Some(f) = self.value(b'F').filter(|f| *f <= 0.0) {
            return Err(Finding::new(FindingCode::BadFeed, format!("F{f}"), "a feed > 0"));
        }
        if self.has_any(b"IJ") && !self.has_any(b"XY") && !self.is_read(b'I') {
            let (fault, allowed) = ("a centre without an end point", "X or Y with I, J");
            return Err(Finding::new(FindingCode::BadArc, fault, allowed));
        }
        Ok(())
    }

    /// Whether a command of the line reads `letter`.
    fn is_read(&self, letter: u8) -> bool {
        self.commands.iter().any(|command| command.own_letters().contains(&letter))
    }
}
