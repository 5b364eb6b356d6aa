//! A line that the dialect understands: its commands and the values of its other words.

use crate::spec::Command;
use crate::verify::FindingCode;
use crate::verify::read::gcode::Dialect;
use crate::verify::read::gcode::lexer::{Word, WordFault};

/// The commands and values of one line.
#[derive(Clone, Debug, Default)]
pub(super) struct Block {
    pub(super) commands: Vec<Command>,
    /// The letters that have a value, a bit each, and the values of those.
    given: u32,
    values: [f64; 26],
}

/// The bit of a letter; 0 for other characters than capitals.
const fn bit(letter: u8) -> u32 {
    if letter.is_ascii_uppercase() { 1 << (letter - b'A') } else { 0 }
}

impl Block {
    /// Reads `words` into this block, replacing what it held; the first fault ends it.
    pub(super) fn read(&mut self, words: &[Word], dialect: &Dialect) -> Result<(), WordFault> {
        self.commands.clear();
        self.given = 0;
        for (place, word) in words.iter().enumerate() {
            let name = || format!("{}{}", char::from(word.letter), word.number);
            if matches!(word.letter, b'G' | b'M') || (word.letter == b'T' && place == 0) {
                let Some(command) = dialect.vocabulary.command(word.letter, word.number) else {
                    return Err((FindingCode::UnknownWord, name(), format!("codes of {}", dialect.name)));
                };
                if let Some(other) = self.commands.iter().find(|c| c.group() == command.group()) {
                    let found = format!("{} ({command:?}) beside {other:?}", name());
                    return Err((
                        FindingCode::ModalConflict,
                        found,
                        "one code of each group on a line".to_owned(),
                    ));
                }
                self.commands.push(command);
                continue;
            }
            if !dialect.vocabulary.parameters.as_bytes().contains(&word.letter) || bit(word.letter) == 0 {
                return Err((
                    FindingCode::UnknownWord,
                    name(),
                    format!("words {}", dialect.vocabulary.parameters),
                ));
            }
            if self.given & bit(word.letter) != 0 {
                return Err((FindingCode::RepeatedWord, name(), "each letter once a line".to_owned()));
            }
            self.given |= bit(word.letter);
            self.values[usize::from(word.letter - b'A')] = word.number;
        }
        self.check()
    }

    /// This block is the command alone, whatever words of its own follow it.
    pub(super) fn set(&mut self, command: Command) {
        self.commands.clear();
        self.given = 0;
        self.commands.push(command);
    }

    /// The value of a word.
    pub(super) fn value(&self, letter: u8) -> Option<f64> {
        (self.given & bit(letter) != 0).then(|| self.values[usize::from(letter - b'A')])
    }

    /// Whether the line has any of these words.
    pub(super) fn has_any(&self, letters: &[u8]) -> bool {
        letters.iter().any(|letter| self.given & bit(*letter) != 0)
    }

    /// Whether the line has the command.
    pub(super) fn has(&self, command: Command) -> bool {
        self.commands.contains(&command)
    }

    /// Words that contradict each other or belong to nothing on the line.
    fn check(&self) -> Result<(), WordFault> {
        let dwell = self.has(Command::Dwell);
        if dwell && self.has_any(b"XYZIJ") {
            return Err((
                FindingCode::ModalConflict,
                "a dwell with axis words".to_owned(),
                "P alone".to_owned(),
            ));
        }
        if let Some(command) = self.commands.iter().find(|command| command.stands_alone()) {
            if self.commands.len() > 1 || self.has_any(b"XYZJF") {
                let found = format!("{command:?} beside other words");
                return Err((FindingCode::ModalConflict, found, "it alone".to_owned()));
            }
            let heats = matches!(command, Command::HeatAndWait | Command::HeatOnly);
            if heats && !self.value(b'S').is_some_and(|s| s >= 0.0) {
                return Err((
                    FindingCode::BadNumber,
                    "heat without a temperature".to_owned(),
                    "S, >= 0".to_owned(),
                ));
            }
        } else if self.value(b'P').is_some() != dwell {
            return Err((
                FindingCode::UnusedWord,
                "P or a dwell, one of them".to_owned(),
                "both or none".to_owned(),
            ));
        }
        let own = |letter: u8| self.commands.iter().any(|command| command.own_letters().contains(&letter));
        if let Some(letter) =
            [b'P', b'R', b'S', b'T'].into_iter().find(|l| self.value(*l).is_some() && !own(*l))
        {
            let found = format!("{} without its command", char::from(letter));
            return Err((FindingCode::UnusedWord, found, "words that a command uses".to_owned()));
        }
        if let Some(p) = self.value(b'P').filter(|p| *p < 0.0) {
            return Err((FindingCode::BadNumber, format!("P{p}"), "a time >= 0".to_owned()));
        }
        if let Some(f) = self.value(b'F').filter(|f| *f <= 0.0) {
            return Err((FindingCode::BadFeed, format!("F{f}"), "a feed > 0".to_owned()));
        }
        if self.has_any(b"IJ") && !self.has_any(b"XY") && !own(b'I') {
            return Err((
                FindingCode::BadArc,
                "a centre without an end point".to_owned(),
                "X or Y with I, J".to_owned(),
            ));
        }
        Ok(())
    }
}
