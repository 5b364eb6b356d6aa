//! The toolpath: a program's moves, with what the iron does in each and how long it takes.

use crate::emit::Decimals;
use crate::plan::Pace;
use crate::resume::ResumeFault;
use crate::resume::record::Record;
use crate::verify::gcode::{Event, Interpreter, Move, MoveKind};

/// Slack on heights, mm.
const HEIGHT: f64 = 1e-6;

/// What the iron is doing, told from its heights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Phase {
    /// Away from the fabric.
    Clear,
    /// On the way down.
    Down,
    /// In contact.
    Contact,
    /// On the way up.
    Up,
}

/// One move.
#[derive(Clone, Debug)]
pub(super) struct TimedMove {
    pub(super) step: Move,
    pub(super) phase: Phase,
    /// Way in contact since the seam's run began, mm, at the start of the move.
    pub(super) along: f64,
    /// Time before it, s.
    pub(super) begins: f64,
    /// Its time, with the dwells after it, s.
    pub(super) seconds: f64,
    /// Index of the line that is the title of its seam.
    title: Option<usize>,
}

/// A program, read.
#[derive(Debug)]
pub(super) struct Toolpath {
    pub(super) steps: Vec<TimedMove>,
    /// Number of lines in the file.
    pub(super) lines: usize,
    /// Number of lines up to and including the heating.
    pub(super) hot: usize,
    texts: Vec<String>,
}

/// One seam's moves: down, and in contact.
#[derive(Clone, Debug)]
pub(super) struct Run<'a> {
    pub(super) down: &'a [TimedMove],
    pub(super) steps: &'a [TimedMove],
    /// The comment that begins it.
    pub(super) title: Option<String>,
}

impl Run<'_> {
    /// Way in contact, mm.
    pub(super) fn length(&self) -> f64 {
        self.steps.iter().map(|step| step.step.length()).sum()
    }
}

impl Toolpath {
    /// Reads a whole program; it must be without fault.
    pub(super) fn read(text: &str, record: &Record) -> Result<Self, ResumeFault> {
        let mut interpreter = Interpreter::new(record.dialect());
        let mut toolpath = Self { steps: Vec::new(), lines: 0, hot: 0, texts: Vec::new() };
        let (mut events, mut title, mut heat) = (Vec::new(), None, false);
        for (i, line) in text.split_inclusive('\n').enumerate() {
            interpreter.feed(line, &mut events);
            toolpath.texts.push(line.trim_end().to_owned());
            let mut is_comment = false;
            for event in events.drain(..) {
                match event {
                    Event::Finding(finding) => return Err(ResumeFault::Damaged(finding)),
                    Event::Comment(comment) => {
                        is_comment = true;
                        match comment.key() {
                            Some("seam") => title = Some(i),
                            Some("heat") => heat = true,
                            _ => {}
                        }
                    }
                    Event::Move(step) => toolpath.add(step, record, title),
                    Event::Dwell(dwell) => {
                        if let Some(last) = toolpath.steps.last_mut() {
                            last.seconds += dwell.seconds;
                        }
                    }
                    _ => {}
                }
            }
            if heat && !is_comment && toolpath.hot == 0 {
                toolpath.hot = i + 1;
            }
        }
        interpreter.finish(&mut events);
        if let Some(Event::Finding(finding)) = events.into_iter().find(|e| matches!(e, Event::Finding(_))) {
            return Err(ResumeFault::Damaged(finding));
        }
        toolpath.lines = interpreter.lines();
        if toolpath.hot == 0 { Err(ResumeFault::NotOurs("heat")) } else { Ok(toolpath) }
    }

    fn add(&mut self, step: Move, record: &Record, title: Option<usize>) {
        let heights = &record.process.heights;
        let (low, high) = (step.from.z.min(step.to.z), step.from.z.max(step.to.z));
        let before = self.steps.last();
        let phase = if low >= heights.travel.0 - HEIGHT {
            Phase::Clear
        } else if high <= heights.contact.0 + HEIGHT {
            Phase::Contact
        } else if step.to.z < step.from.z {
            Phase::Down
        } else {
            Phase::Up
        };
        let along = before
            .filter(|b| matches!(b.phase, Phase::Contact | Phase::Up) && phase != Phase::Down)
            .map_or(0.0, |b| b.along + if b.phase == Phase::Contact { b.step.length() } else { 0.0 });
        let begins = before.map_or(0.0, |b| b.begins + b.seconds);
        let seconds = match (record.pace, step.feed) {
            (Pace::Chopped(chop), _) if phase != Phase::Clear => {
                let [from, to] = [step.from, step.to].map(|at| [at.x, at.y, at.z]);
                chop.seconds(from, to, step.length())
            }
            (_, Some(feed)) => step.length() / feed * 60.0,
            (_, None) => step.length() / record.process.travel_speed.0,
        };
        let along = if phase == Phase::Clear { 0.0 } else { along };
        self.steps.push(TimedMove { step, phase, along, begins, seconds, title });
    }

    /// Time for all of it, s.
    pub(super) fn seconds(&self) -> f64 {
        self.steps.last().map_or(0.0, |last| last.begins + last.seconds)
    }

    /// The seam that step `i` is in contact with, or has just left; `None` if it is away from the fabric or on its way down.
    pub(super) fn run_at(&self, i: usize) -> Option<Run<'_>> {
        let phase = |k: usize| self.steps.get(k).map(|step| step.phase);
        if !matches!(phase(i), Some(Phase::Contact | Phase::Up)) {
            return None;
        }
        let back = |from: usize, wanted: Phase| {
            (0..from).rev().find(|k| phase(*k) != Some(wanted)).map_or(0, |k| k + 1)
        };
        let end =
            (i..self.steps.len()).find(|k| phase(*k) != Some(Phase::Contact)).unwrap_or(self.steps.len());
        let end = if phase(i) == Some(Phase::Up) { back(i, Phase::Up) } else { end };
        let start = back(end, Phase::Contact);
        let down = back(start, Phase::Down);
        let title = self.steps[i].title.and_then(|line| self.texts.get(line).cloned());
        Some(Run { down: &self.steps[down..start], steps: &self.steps[start..end], title })
    }

    /// Index of the line of the travel to the first seam that begins at step `i` or later.
    pub(super) fn next_travel(&self, i: usize) -> Option<usize> {
        // On the way down the seam is this one.
        let first = (i..self.steps.len()).find(|k| self.steps[*k].phase == Phase::Down)?;
        let is_travel = |step: &TimedMove| step.step.kind == MoveKind::Rapid && step.step.path.is_some();
        let before =
            (0..first).rev().find(|k| self.steps[*k].phase == Phase::Clear && is_travel(&self.steps[*k]));
        let line = before.map_or(self.hot, |k| self.steps[k].step.line - 1);
        Some(line.max(self.hot))
    }

    /// The first feed move at or after the line of index `from`, with the feed that is in force there: its index and text;
    /// `None` if it states its own.
    pub(super) fn with_feed(&self, from: usize) -> Option<(usize, String)> {
        let is_next = |step: &&TimedMove| step.step.line > from && step.step.kind == MoveKind::Feed;
        let step = self.steps.iter().find(is_next)?.step;
        let text = self.texts.get(step.line - 1).filter(|text| !text.contains(['F', ';', '(']))?;
        Some((step.line - 1, format!("{text} F{}", Decimals::exactly(9).text(step.feed?))))
    }

    /// Index of the first line after `line` (from 1) that is no dwell.
    pub(super) fn after(&self, line: usize) -> usize {
        (line..self.texts.len()).find(|i| !self.texts[*i].starts_with("G4")).unwrap_or(self.texts.len())
    }
}
