//! Judges: they compare the files with the design; every difference becomes a finding.

pub(in crate::verify) mod clamp;
mod comments;
pub(in crate::verify) mod expected;
mod expected_comments;
pub(in crate::verify) mod feed_check;
pub(in crate::verify) mod files;
mod height;
pub(in crate::verify) mod iron;
mod job;
mod pace;
pub(in crate::verify) mod path;
pub(in crate::verify) mod rules;
mod script;
mod seams;
pub(in crate::verify) mod stroke;
pub(in crate::verify) mod task;
mod travel_order;

use crate::verify::Findings;
use crate::verify::read::gcode::{Dialect, Event, Line, each_line};

/// A judge of programs: it is shown one line after the other, and remembers no more of them than it needs.
pub(in crate::verify) trait Judge {
    /// The next line, and what it does; adds what is wrong with it to this judge's `findings`.
    fn see(&mut self, line: &Line<'_>, findings: &mut Findings);

    /// After the last line: adds what could not be judged before.
    fn end(&mut self, findings: &mut Findings) {
        let _ = findings;
    }
}

/// The findings of all `judges` in a program, one after the other, and then those of the reader.
fn judged<'a>(
    lines: impl IntoIterator<Item = &'a str>,
    dialect: Dialect,
    judges: &mut [&mut dyn Judge],
) -> Findings {
    let mut own = Findings::default();
    let mut each: Vec<Findings> = judges.iter().map(|_| Findings::default()).collect();
    let _ = each_line(lines, dialect, |line| {
        for (judge, findings) in judges.iter_mut().zip(&mut each) {
            judge.see(line, findings);
        }
        own.extend(line.events.iter().filter_map(|event| match event {
            Event::Finding(finding) => Some(finding.clone()),
            _ => None,
        }));
    });
    let mut all = Findings::default();
    for (judge, mut findings) in judges.iter_mut().zip(each) {
        judge.end(&mut findings);
        all.absorb(findings);
    }
    all.absorb(own);
    all
}

/// Slack on heights, mm; they are written to at least two decimals and read as written.
const HEIGHT: f64 = 1e-6;
