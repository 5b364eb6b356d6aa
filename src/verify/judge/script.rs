//! The profile's own lines: the head is its start, the tail its end, and between them no mode and no setting changes.

use std::cell::OnceCell;

use crate::spec::{Heating, Machine};
use crate::units::Temperature;
use crate::verify::finding::quote;
use crate::verify::read::gcode::Program;
use crate::verify::{FindingCode, Findings};

/// Largest difference of temperatures that are the same, in degrees Celsius.
const SAME: f64 = 0.5;

/// A program beside the profile that it was made for.
pub(in crate::verify) struct Script<'a> {
    pub(in crate::verify) machine: &'a Machine,
    /// The seal's temperature; `None` for a program that must stay cold.
    pub(in crate::verify) heat: Option<Temperature>,
    pub(in crate::verify) text: &'a str,
    pub(in crate::verify) program: &'a Program,
}

impl Script<'_> {
    /// Reports every line that the profile gives and that is not where it should be, and every one that it does not give.
    pub(in crate::verify) fn check(&self, findings: &mut Findings) {
        let (first, last) = self.program.motion().unwrap_or((usize::MAX, usize::MAX));
        let Machine { script, controller, .. } = self.machine;
        self.compare(&script.start, 1..first, findings);
        self.compare(&script.end, last.saturating_add(1)..usize::MAX, findings);
        self.pauses(findings);
        let hotend = self.heat.filter(|_| controller.heating == Heating::Hotend);
        check_body(hotend, self.text, self.program, findings);
    }

    /// The lines of code within `range` against those of the profile: the first difference.
    fn compare(&self, wanted: &[String], range: std::ops::Range<usize>, findings: &mut Findings) {
        let mut wanted = wanted.iter().map(|line| line.trim()).filter(|line| is_code(line));
        let mut last = range.start;
        for (line, number) in self.text.lines().zip(1..).filter(|(line, _)| is_code(line.trim())) {
            if !range.contains(&number) {
                continue;
            }
            last = number;
            let wanted = wanted.next();
            if wanted != Some(line.trim()) {
                let allowed = wanted.map_or("no further line".to_owned(), quote);
                findings.add(
                    FindingCode::ProfileLine,
                    number,
                    quote(line),
                    format!("{allowed}, as the profile says"),
                );
                return;
            }
        }
        if let Some(wanted) = wanted.next() {
            let allowed = format!("{}, as the profile says", quote(wanted));
            findings.add(FindingCode::ProfileLine, last, "nothing more", allowed);
        }
    }

    /// Where the operator heats, there is one pause, in the profile's words; else there is none.
    fn pauses(&self, findings: &mut Findings) {
        let operator = self.machine.controller.heating == Heating::Operator;
        let wanted = usize::from(self.heat.is_some() && operator);
        // One too many is enough to be told.
        for (pause, i) in self.program.pauses.iter().zip(0..).take(wanted + 1) {
            let line = self.text.lines().nth(pause.line - 1).unwrap_or_default().trim();
            if i >= wanted || line != self.machine.script.pause {
                let allowed = format!("{wanted} pauses, {}", quote(&self.machine.script.pause));
                findings.add(FindingCode::ProfileLine, pause.line, quote(line), allowed);
            }
        }
    }
}

/// Between the first motion and the last, no mode and no setting changes; and a hotend is heated to `heat` there, once,
/// and off before and after. Without one, nothing heats.
pub(in crate::verify) fn check_body(
    heat: Option<Temperature>,
    text: &str,
    program: &Program,
    findings: &mut Findings,
) {
    let (first, last) = program.motion().unwrap_or((usize::MAX, usize::MAX));
    let lines = OnceCell::new();
    let quoted = |line: usize| {
        // Only a program with faults is cut into its lines, and only once.
        let lines: &Vec<&str> = lines.get_or_init(|| text.lines().collect());
        quote(lines.get(line - 1).copied().unwrap_or_default())
    };
    for line in program.settings.iter().filter(|line| (first..=last).contains(line)) {
        let allowed = "modes and settings before the first motion only";
        findings.add(FindingCode::ProfileLine, *line, quoted(*line), allowed);
    }
    let mut wanted = heat;
    for told in &program.heats {
        let right = if (first..=last).contains(&told.line) {
            let wanted = wanted.take();
            told.waits && wanted.is_some_and(|wanted| (wanted.0 - told.celsius).abs() <= SAME)
        } else {
            told.celsius == 0.0 && !told.waits
        };
        if !right {
            let allowed = match heat {
                Some(heat) => format!("one heating to {heat}, and off in the profile's lines"),
                None => "no heating".to_owned(),
            };
            findings.add(FindingCode::StrayHeat, told.line, quoted(told.line), allowed);
        }
    }
}

/// Whether a line is more than a comment.
fn is_code(line: &str) -> bool {
    !line.is_empty() && !line.starts_with([';', '('])
}
