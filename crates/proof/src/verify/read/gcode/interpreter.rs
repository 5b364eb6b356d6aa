//! The interpreter: line after line, in constant memory.

use crate::verify::read::gcode::block::Block;
use crate::verify::read::gcode::extended::{self, HeaterLine, PendingHeater};
use crate::verify::read::gcode::lexer::{Alphabet, Word};
use crate::verify::read::gcode::machine::{BlockContext, Machine};
use crate::verify::read::gcode::{Comment, Dialect, Event, Heat, Pause, ServiceCall, lexer};
use crate::verify::{Finding, FindingCode};
use spec::{Command, Comments, Service};

/// The beginning of the last line of every program; the number of lines follows.
const SENTINEL: &str = "end of program, ";

/// A simulated controller that is fed one line at a time.
///
/// A line with a fault is reported and not executed, as on the real one. Until the first rapids have set all
/// three axes, moves set the position and yield no [`Event::Move`].
#[derive(Clone, Debug)]
pub struct Interpreter {
    dialect: Dialect,
    alphabet: Alphabet,
    machine: Machine,
    block: Block,
    words: Vec<Word>,
    line: usize,
    /// Whether the dialect has service lines.
    is_serviced: bool,
    /// The temperature that a comment announced and the next pause puts into force.
    announced: Option<f64>,
    ended: Option<usize>,
    /// The heater that an extended command has set, until the program waits for it.
    pending: PendingHeater,
    /// Whether the last line was the right sentinel, with its line end.
    sentinel: bool,
}

impl Interpreter {
    /// A controller that was just switched on.
    pub fn new(dialect: Dialect) -> Self {
        Self {
            machine: Machine::new(&dialect),
            alphabet: Alphabet::new(&dialect),
            is_serviced: Service::is_read_by(dialect.vocabulary.dialect),
            dialect,
            block: Block::default(),
            words: Vec::new(),
            line: 0,
            announced: None,
            ended: None,
            pending: PendingHeater::default(),
            sentinel: false,
        }
    }

    /// Number of lines so far.
    pub fn lines(&self) -> usize {
        self.line
    }

    /// Reads the next line, with its line end if it has one, and adds its effects to `events`.
    ///
    /// A line that is one whole word of the dialect is executed at once; any other is cut into words, read as a block and
    /// executed if it has no fault. Comments count after it, and the last one may state the number of lines.
    pub fn feed(&mut self, text: &str, events: &mut Vec<Event>) {
        self.line += 1;
        let line = text.strip_suffix('\n').unwrap_or(text);
        let line = line.strip_suffix('\r').unwrap_or(line);
        if line.len() > self.dialect.line_length {
            let allowed = format!("at most {}", self.dialect.line_length);
            self.report(events, FindingCode::LineTooLong, format!("{} characters", line.len()), allowed);
        }
        let mut comment = None;
        if let Some(service) = self.service(line) {
            self.serve(service, events);
        } else if let Some(command) = self.whole_word(line) {
            if extended::is_heating(line) {
                self.heat(line, events);
            } else {
                self.block.set(command);
                self.execute(events);
            }
        } else {
            let (line_comment, fault) = lexer::cut(line, &self.dialect, &self.alphabet, &mut self.words);
            comment = line_comment;
            let fault = fault.or_else(|| self.block.read(&self.words, &self.dialect).err());
            if let Some(fault) = fault {
                events.push(Event::Finding(Finding { line: Some(self.line), ..fault }));
            } else if !self.words.is_empty() {
                self.execute(events);
            }
        }
        let counted_lines = match self.dialect.comments {
            Comments::Semicolon => line.strip_prefix("; "),
            Comments::Parentheses => line.strip_prefix('(').and_then(|line| line.strip_suffix(')')),
        };
        self.sentinel = counted_lines
            .and_then(|text| text.strip_prefix(SENTINEL))
            .is_some_and(|rest| rest == format!("{} lines", self.line) && text.ends_with('\n'));
        if let Some(comment) = comment {
            self.remark(comment.trim(), events);
        }
    }

    /// After the last line: reports a missing end.
    pub fn finish(&mut self, events: &mut Vec<Event>) {
        if self.ended.is_none() {
            self.report(events, FindingCode::Truncated, "no end of the program", "M2 or M30");
        }
        if !self.sentinel {
            let allowed = format!("last line \"; {SENTINEL}{} lines\" and a line end", self.line);
            self.report(events, FindingCode::Truncated, "another last line", allowed);
        }
        if self.announced.take().is_some() {
            let fault = "a heating without a wait for it";
            self.report(events, FindingCode::HeatWithoutPause, fault, "M0 after it");
        }
    }

    /// The effect of a service line.
    fn service(&self, line: &str) -> Option<Service> {
        if self.is_serviced { Service::read(line, self.dialect.vocabulary.dialect) } else { None }
    }

    /// The command of a line that is one of the dialect's longer words, with words of its own or without.
    fn whole_word(&self, line: &str) -> Option<Command> {
        let plain = |c: char| c.is_ascii_alphanumeric() || "_=. -\"".contains(c);
        let mut words = self.dialect.vocabulary.words.iter();
        let word = words.find(|(word, _)| {
            let rest = line.strip_prefix(word);
            rest.is_some_and(|rest| (rest.is_empty() || rest.starts_with(' ')) && rest.chars().all(plain))
        });
        word.map(|(_, command)| *command)
    }

    /// Whether the program has ended, and nothing more is executed.
    fn is_over(&self, events: &mut Vec<Event>) -> bool {
        if let Some(end) = self.ended {
            let fault = format!("words after the program's end in line {end}");
            self.report(events, FindingCode::AfterEnd, fault, "comments only");
        }
        self.ended.is_some()
    }

    /// Follows a line that puts the machine in order.
    fn serve(&mut self, service: Service, events: &mut Vec<Event>) {
        if !self.is_over(events) {
            self.machine.serve(ServiceCall { line: self.line, service }, events);
        }
    }

    /// Follows an extended command to a heater: it is set by one line, and the next one waits for it.
    fn heat(&mut self, line: &str, events: &mut Vec<Event>) {
        if self.is_over(events) {
            return;
        }
        match self.pending.read(line) {
            Some(HeaterLine::Set) => self.announced = None,
            Some(HeaterLine::Off(heater)) => {
                let heat = Heat { line: self.line, celsius: 0.0, waits: false, heater };
                self.machine.heat(heat, false, events);
            }
            Some(HeaterLine::Hot { heater, celsius, waits_for_cooler }) => {
                let heat = Heat { line: self.line, celsius, waits: true, heater };
                self.machine.heat(heat, waits_for_cooler, events);
            }
            None => {
                let allowed = "SET_HEATER_TEMPERATURE HEATER=name TARGET=.., then TEMPERATURE_WAIT for it";
                self.report(events, FindingCode::StrayHeat, line, allowed);
            }
        }
    }

    fn execute(&mut self, events: &mut Vec<Event>) {
        if self.is_over(events) {
            return;
        }
        if self.pending.take() {
            let fault = "words between a heater's temperature and the wait for it";
            self.report(events, FindingCode::HeatWithoutPause, fault, "TEMPERATURE_WAIT first");
        }
        let pause = self.block.has_command(Command::Pause);
        if self.block.has_command(Command::HeatAndWait) {
            // The operator need not wait: the controller waits itself.
            self.announced = None;
        }
        if !pause && self.announced.take().is_some() {
            let fault = "words between heating and pause";
            self.report(events, FindingCode::HeatWithoutPause, fault, "M0 first");
        }
        let (block, line, dialect) = (&self.block, self.line, &self.dialect);
        self.machine.execute(&mut BlockContext { block, line, dialect, out: events });
        if pause {
            let heat = self.announced.take();
            self.machine.waited_for_celsius = heat.or(self.machine.waited_for_celsius);
            events.push(Event::Pause(Pause { line: self.line, at: self.machine.position(), heat }));
        }
        if self.block.has_command(Command::End) {
            self.ended = Some(self.line);
            events.push(Event::End(self.line));
        }
    }

    fn report(
        &self,
        events: &mut Vec<Event>,
        code: FindingCode,
        fault: impl Into<String>,
        allowed: impl Into<String>,
    ) {
        events.push(Event::Finding(Finding::in_line(code, self.line, fault, allowed)));
    }

    fn remark(&mut self, text: &str, events: &mut Vec<Event>) {
        let comment = Comment::new(self.line, text.to_owned());
        if comment.key() == Some("heat") {
            self.announced = comment.number("temperature_C");
            if self.announced.is_none() {
                let fault = "heat without a temperature";
                self.report(events, FindingCode::BadComment, fault, "temperature_C=number");
            }
        }
        events.push(Event::Comment(comment));
    }
}

#[cfg(test)]
mod tests;
