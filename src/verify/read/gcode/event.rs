//! Events: the effects of a program's line.

use crate::verify::Finding;
use crate::verify::read::gcode::comment::Comment;
use inflatable::geom::{Point, Segment};

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
    /// Its start.
    pub from: Point3,
    /// Its end.
    pub to: Point3,
    /// Its path seen from above; `None` if it is vertical or goes nowhere.
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
    /// Its end, mm; coordinates that are unknown are `None`.
    pub to: [Option<f64>; 3],
    /// Feed in force, mm/min; `None` for a rapid that is as fast as the machine can, or if the program never gave one.
    pub feed: Option<f64>,
}

/// A command to a heater.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heat {
    /// Line, from 1.
    pub line: usize,
    /// Temperature, in degrees Celsius; 0 turns it off.
    pub celsius: f64,
    /// Whether the program waits until it is hot.
    pub waits: bool,
}

/// A wait for a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dwell {
    /// Line, from 1.
    pub line: usize,
    /// Duration, s.
    pub seconds: f64,
    /// The place of the iron; `None` while that is unknown.
    pub at: Option<Point3>,
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
    /// A line, by its number, that puts a mode or a setting of the controller into force.
    Setting(usize),
    /// A heater.
    Heat(Heat),
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
