//! Events: the effects of a program's line.

use crate::verify::Finding;
use geom::{Point, Segment};
use spec::Service;

/// A position of the iron's tip, mm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point3 {
    /// Abscissa.
    pub x: f64,
    /// Ordinate.
    pub y: f64,
    /// Height.
    pub z: f64,
}

impl Point3 {
    /// The position (x, y, z).
    pub const fn new(x: f64, y: f64, z: f64) -> Self {
        Self { x, y, z }
    }

    /// The position seen from above.
    pub const fn xy(self) -> Point {
        Point::new(self.x, self.y)
    }
}

/// Whether a move travels or works.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MoveKind {
    /// G0: as fast as the machine can, or where the dialect has it so, at the feed in force.
    Rapid,
    /// At the feed.
    Feed,
}

/// One motion from a known position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    /// Line, from 1.
    pub line: usize,
    /// Rapid or at the feed.
    pub kind: MoveKind,
    /// Start of the move.
    pub from: Point3,
    /// End of the move.
    pub to: Point3,
    /// Path of the move seen from above; `None` if it is vertical or goes nowhere.
    pub path: Option<Segment>,
    /// Feed in force, mm/min; `None` for a rapid that is as fast as the machine can, or if the program never gave one.
    pub feed: Option<f64>,
    /// Temperature of the iron in force, in degrees Celsius; `None` before the first heating.
    pub heated: Option<f64>,
}

impl Move {
    /// Length of the way in space, mm (an arc with a change of height is a helix).
    pub fn length(&self) -> f64 {
        libm::hypot(self.path.map_or(0.0, |path| path.length()), self.to.z - self.from.z)
    }

    /// Time at the feed, s; `None` for a rapid that has none.
    pub fn seconds(&self) -> Option<f64> {
        self.feed.map(|feed| self.length() / feed * 60.0)
    }
}

/// A motion from or to an unknown place: the program has not set all three axes before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlindMove {
    /// Line, from 1.
    pub line: usize,
    /// Rapid or at the feed.
    pub kind: MoveKind,
    /// Whether the line names the axes X, Y, Z.
    pub named: [bool; 3],
    /// End of the move, mm; coordinates that are unknown are `None`.
    pub to: [Option<f64>; 3],
    /// Feed in force, mm/min; `None` for a rapid that is as fast as the machine can, or if the program never gave one.
    pub feed: Option<f64>,
}

/// A command to a heater.
#[derive(Clone, Debug, PartialEq)]
pub struct Heat {
    /// Line, from 1.
    pub line: usize,
    /// Temperature, in degrees Celsius; 0 turns it off.
    pub celsius: f64,
    /// Whether the program waits until it is hot.
    pub waits: bool,
    /// Which heater it is.
    pub heater: Heater,
}

/// A heater of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Heater {
    /// The hotend of the tool in use, or of this number.
    Hotend(Option<u32>),
    /// The heater of this name (Klipper).
    Named(String),
}

/// A laser as the program has set it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Beam {
    /// Whether it is armed, and how its power follows the motion.
    pub mode: BeamMode,
    /// The S word in force, which stays while the laser is off.
    pub word: f64,
}

/// Whether a laser is armed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BeamMode {
    /// M5: it is off.
    #[default]
    Off,
    /// M4: its power follows the speed, and is 0 at rest.
    ByMotion,
    /// M3: its power is constant, at rest as well.
    Constant,
}

impl Beam {
    /// The S word with which it shines along a move at the feed; 0 if it is off.
    pub fn shines(self) -> f64 {
        if self.mode == BeamMode::Off { 0.0 } else { self.word }
    }
}

/// A line that puts the machine in order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ServiceCall {
    /// Line, from 1.
    pub line: usize,
    /// The effect.
    pub service: Service,
}

/// A wait for a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dwell {
    /// Line, from 1.
    pub line: usize,
    /// Duration, s.
    pub seconds: f64,
}

/// A wait for the operator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pause {
    /// Line, from 1.
    pub line: usize,
    /// The place of the iron; `None` while that is unknown.
    pub at: Option<Point3>,
    /// The temperature that is in force from here on, if this pause sets one, in degrees Celsius.
    pub heat: Option<f64>,
}

/// The effect of a line.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// A motion.
    Move(Move),
    /// A motion before X, Y and Z are known.
    Blind(BlindMove),
    /// A mode or a setting of the controller comes into force.
    Setting,
    /// A heater.
    Heat(Heat),
    /// The machine is put in order.
    Service(ServiceCall),
    /// A laser is armed, gets another power, or is switched off.
    Beam(Beam),
    /// A wait for a time.
    Dwell(Dwell),
    /// A wait for the operator.
    Pause(Pause),
    /// A comment.
    Comment(Comment),
    /// The end of the program, with its line.
    End(usize),
    /// A fault.
    Finding(Finding),
}

/// A comment of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Comment {
    /// Line, from 1.
    pub line: usize,
    /// The text behind the semicolon, trimmed.
    pub text: String,
    /// Length of its key: every judge asks for it.
    key_length: Option<usize>,
}

impl Comment {
    /// The comment `text` of line `line`.
    pub fn new(line: usize, text: String) -> Self {
        let key_length = text.split_once(':').and_then(|(key, rest)| {
            let mut words = rest.split_whitespace().peekable();
            let is_structured = words.peek().is_some() && words.all(|word| word.contains('='));
            (is_structured && !key.is_empty()).then_some(key.len())
        });
        Self { line, text, key_length }
    }

    /// The key, if the comment is structured: the text before the first colon, when each word after it is `word=value`.
    pub fn key(&self) -> Option<&str> {
        self.text.get(..self.key_length?).map(str::trim)
    }

    /// The value of `word` in a structured comment.
    pub fn word(&self, word: &str) -> Option<&str> {
        let _ = self.key()?;
        let (_, rest) = self.text.split_once(':')?;
        rest.split_whitespace().filter_map(|w| w.split_once('=')).find(|(k, _)| *k == word).map(|(_, v)| v)
    }

    /// The value of `word` as a finite number.
    pub fn number(&self, word: &str) -> Option<f64> {
        self.word(word).and_then(crate::verify::read::number::value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn comment(text: &str) -> Comment {
        Comment::new(1, text.to_owned())
    }

    #[test]
    fn key_and_words() {
        let heat = comment("heat: temperature_C=200 by=operator");
        assert_eq!(heat.key(), Some("heat"));
        assert_eq!(heat.number("temperature_C"), Some(200.0));
        assert_eq!(heat.word("by"), Some("operator"));
        assert_eq!(heat.word("speed"), None);
    }

    #[test]
    fn prose_has_no_key() {
        for text in
            ["", "set the station to 200 C: then press start", "name:", ": a=1", "end of program, 7 lines"]
        {
            assert_eq!(comment(text).key(), None, "{text}");
            assert_eq!(comment(text).word("a"), None);
        }
    }

    #[test]
    fn a_value_that_is_no_number() {
        for value in ["nan", "inf", "1e99", "", "hot"] {
            assert_eq!(comment(&format!("heat: temperature_C={value}")).number("temperature_C"), None);
        }
    }
}
