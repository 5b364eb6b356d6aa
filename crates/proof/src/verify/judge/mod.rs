//! Judges: they compare the files with the design; every difference becomes a finding.

mod beam;
mod blade;
pub(super) mod clamp;
mod comments;
pub(super) mod expected;
mod expected_comments;
pub(super) mod feed_check;
pub(super) mod files;
mod height;
pub(super) mod iron;
mod job;
mod pace;
pub(super) mod path;
mod ready;
pub(super) mod rules;
mod script;
mod seams;
mod stops;
pub(super) mod stroke;
pub(super) mod task;
mod travel_order;

use crate::verify::Findings;
use crate::verify::read::gcode::{BlindMove, Comment, Dialect, Dwell, Event, Line, Move, Pause, each_line};

/// A judge of programs: it is shown one line after the other, and remembers no more of them than it needs. It adds what is wrong
/// with each to its own findings.
pub(super) trait Judge {
    /// The next line, before each of its effects. After the last line of the file comes an empty one, whose effects are what is wrong with
    /// the whole program.
    fn line(&mut self, _line: &Line<'_>, _findings: &mut Findings) {}

    /// A motion from a known position.
    fn step(&mut self, _step: &Move, _findings: &mut Findings) {}

    /// A motion before X, Y and Z are known.
    fn blind(&mut self, _step: &BlindMove, _findings: &mut Findings) {}

    /// A wait for a time.
    fn dwell(&mut self, _dwell: &Dwell, _findings: &mut Findings) {}

    /// A wait for the operator.
    fn pause(&mut self, _pause: &Pause, _findings: &mut Findings) {}

    /// A comment.
    fn comment(&mut self, _comment: &Comment, _findings: &mut Findings) {}

    /// After the last line: adds what could not be judged before.
    fn end(&mut self, _findings: &mut Findings) {}

    /// After [`Judge::end`]: the largest deviation from a path, mm; 0 of a judge that follows none.
    fn deviation(&self) -> f64 {
        0.0
    }

    /// Shows the next line and its effects.
    fn see(&mut self, line: &Line<'_>, findings: &mut Findings) {
        self.line(line, findings);
        for event in line.events {
            match event {
                Event::Move(step) => self.step(step, findings),
                Event::Blind(step) => self.blind(step, findings),
                Event::Dwell(dwell) => self.dwell(dwell, findings),
                Event::Pause(pause) => self.pause(pause, findings),
                Event::Comment(comment) => self.comment(comment, findings),
                _ => {}
            }
        }
    }
}

/// Adds the findings of all `judges` in a program, one after the other, and then those of the reader. Returns the largest
/// deviation, mm.
fn judged<'a>(
    lines: impl IntoIterator<Item = &'a str>,
    dialect: Dialect,
    judges: Vec<Box<dyn Judge + '_>>,
    findings: &mut Findings,
) -> f64 {
    let mut own_findings = Findings::default();
    let mut judges: Vec<_> = judges.into_iter().map(|judge| (judge, Findings::default())).collect();
    each_line(lines, dialect, |line| {
        for (judge, found) in &mut judges {
            judge.see(line, found);
        }
        own_findings.extend(line.events.iter().filter_map(|event| match event {
            Event::Finding(finding) => Some(finding.clone()),
            _ => None,
        }));
    });
    let mut deviation = 0.0_f64;
    for (mut judge, mut found) in judges {
        judge.end(&mut found);
        deviation = deviation.max(judge.deviation());
        findings.absorb(found);
    }
    findings.absorb(own_findings);
    deviation
}

/// Slack on heights, mm; they are written to at least two decimals and read as written.
const HEIGHT: f64 = 1e-6;
