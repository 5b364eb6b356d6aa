//! A program: the list of all events of a file.

use crate::verify::read::gcode::{BlindMove, Comment, Dialect, Dwell, Event, Heat, Interpreter, Move, Pause};
use crate::verify::{Finding, Findings};

/// All events of a file, by kind; line numbers tell their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// Motions.
    pub moves: Vec<Move>,
    /// Motions before X, Y and Z are known.
    pub blind: Vec<BlindMove>,
    /// Lines that put modes or settings into force.
    pub settings: Vec<usize>,
    /// What heaters are told.
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
    /// Lines of the first and of the last motion; `None` if nothing moves.
    pub fn motion(&self) -> Option<(usize, usize)> {
        let lines = || self.blind.iter().map(|step| step.line).chain(self.moves.iter().map(|step| step.line));
        Some((lines().min()?, lines().max()?))
    }

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
                Event::Blind(x) => self.blind.push(x),
                Event::Setting(line) => self.settings.push(line),
                Event::Heat(x) => self.heats.push(x),
                Event::Dwell(x) => self.dwells.push(x),
                Event::Pause(x) => self.pauses.push(x),
                Event::Comment(x) => self.comments.push(x),
                Event::End(line) => self.end = Some(line),
                Event::Finding(x) => findings.push(x),
            }
        }
    }
}
