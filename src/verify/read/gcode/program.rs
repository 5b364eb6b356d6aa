//! What a program does: events, and the list of all of them.

use crate::geom::{Point, Segment};
use crate::verify::read::gcode::{Comment, Dialect, Interpreter};
use crate::verify::{Finding, Findings};

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
    /// Where it starts.
    pub from: Point3,
    /// Where it ends.
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
        self.path.map_or(0.0, |path| path.length()).hypot(self.to.z - self.from.z)
    }

    /// Time at the feed, s; `None` for a rapid that has none.
    pub fn seconds(&self) -> Option<f64> {
        self.feed.map(|feed| self.length() / feed * 60.0)
    }
}

/// A wait for a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dwell {
    /// Line, from 1.
    pub line: usize,
    /// How long, s.
    pub seconds: f64,
    /// Where the iron is; `None` while that is not known.
    pub at: Option<Point3>,
}

/// A wait for the operator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pause {
    /// Line, from 1.
    pub line: usize,
    /// Where the iron is; `None` while that is not known.
    pub at: Option<Point3>,
    /// The temperature that is in force from here on, if this pause sets one, in degrees Celsius.
    pub heat: Option<f64>,
}

/// What a line does.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// A motion.
    Move(Move),
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

/// All events of a file, by kind; line numbers tell their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// Motions.
    pub moves: Vec<Move>,
    /// Waits for a time.
    pub dwells: Vec<Dwell>,
    /// Waits for the operator.
    pub pauses: Vec<Pause>,
    /// Comments.
    pub comments: Vec<Comment>,
    /// Line of the program's end.
    pub end: Option<usize>,
    /// Number of lines in the file.
    pub lines: usize,
    /// Faults.
    pub findings: Vec<Finding>,
}

impl Program {
    /// The first structured comment with this key.
    pub fn comment(&self, key: &str) -> Option<&Comment> {
        self.comments.iter().find(|comment| comment.key() == Some(key))
    }
}

/// Reads a whole file.
pub fn read_program(text: &str, dialect: Dialect) -> Program {
    let mut interpreter = Interpreter::new(dialect);
    let (mut program, mut findings) = (Program::default(), Findings::default());
    let mut events = Vec::new();
    for line in text.split_inclusive('\n') {
        interpreter.feed(line, &mut events);
        program.take(&mut events, &mut findings);
    }
    interpreter.finish(&mut events);
    program.take(&mut events, &mut findings);
    program.lines = interpreter.lines();
    program.findings = findings.into_vec();
    program
}

impl Program {
    fn take(&mut self, events: &mut Vec<Event>, findings: &mut Findings) {
        for event in events.drain(..) {
            match event {
                Event::Move(x) => self.moves.push(x),
                Event::Dwell(x) => self.dwells.push(x),
                Event::Pause(x) => self.pauses.push(x),
                Event::Comment(x) => self.comments.push(x),
                Event::End(line) => self.end = Some(line),
                Event::Finding(x) => findings.push(x),
            }
        }
    }
}
