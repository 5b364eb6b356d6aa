//! A program, line by line with the effects of each, or as the list of all events of a file.

use crate::verify::read::gcode::{BlindMove, Comment, Dialect, Dwell, Event, Heat, Interpreter, Move, Pause};
use crate::verify::{Finding, Findings};

/// All events of a file, by kind; line numbers tell their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// Motions.
    pub moves: Vec<Move>,
    /// Motions before X, Y and Z are known.
    pub blind: Vec<BlindMove>,
    /// Commands to heaters.
    pub heats: Vec<Heat>,
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

/// A line, and its effects.
#[derive(Clone, Copy, Debug)]
pub struct Line<'a> {
    /// From 1.
    pub number: usize,
    /// The text of the file, with its line end.
    pub text: &'a str,
    /// In order; of motions one at the most.
    pub events: &'a [Event],
}

impl Line<'_> {
    /// Whether anything moves.
    pub fn is_motion(&self) -> bool {
        self.events.iter().any(|event| matches!(event, Event::Move(_) | Event::Blind(_)))
    }
}

/// Passes every one of `lines`, each with its line end, to `see` with its effects. A last empty line, with the number of the last
/// real one, has the faults of the whole program.
pub fn each_line<'a>(
    lines: impl IntoIterator<Item = &'a str>,
    dialect: Dialect,
    mut see: impl FnMut(&Line<'_>),
) {
    let mut interpreter = Interpreter::new(dialect);
    let mut events = Vec::new();
    for text in lines {
        interpreter.feed(text, &mut events);
        see(&Line { number: interpreter.lines(), text, events: &events });
        events.clear();
    }
    interpreter.finish(&mut events);
    see(&Line { number: interpreter.lines(), text: "", events: &events });
}

/// Reads a whole file into memory.
pub fn read_program(text: &str, dialect: Dialect) -> Program {
    let (mut program, mut findings) = (Program::default(), Findings::default());
    each_line(text.split_inclusive('\n'), dialect, |line| {
        program.lines = line.number;
        line.events.iter().for_each(|event| program.take(event.clone(), &mut findings));
    });
    program.findings = findings.into_vec();
    program
}

impl Program {
    fn take(&mut self, event: Event, findings: &mut Findings) {
        match event {
            Event::Move(x) => self.moves.push(x),
            Event::Blind(x) => self.blind.push(x),
            Event::Setting | Event::Service(_) | Event::Beam(_) => {}
            Event::Heat(x) => self.heats.push(x),
            Event::Dwell(x) => self.dwells.push(x),
            Event::Pause(x) => self.pauses.push(x),
            Event::Comment(x) => self.comments.push(x),
            Event::End(line) => self.end = Some(line),
            Event::Finding(x) => findings.push(x),
        }
    }
}
