//! The profile's own lines: the head is its start, the tail its end, and between them no mode and no setting changes.

use crate::verify::finding::quote;
use crate::verify::judge::Judge;
use crate::verify::read::gcode::{Event, Heat, Heater, Line};
use crate::verify::{FindingCode, Findings};
use spec::units::Temperature;
use spec::{Heating, Machine};

/// Largest difference of temperatures that are the same, in degrees Celsius.
const SAME: f64 = 0.5;

/// Most settings and heatings that are kept until it is known whether they are in the tail: no profile has as many.
const PENDING: usize = 1000;

/// Reports every line that the profile gives and that is not where it should be, and every one that it does not give.
pub(super) struct ScriptJudge<'a> {
    machine: &'a Machine,
    /// Number of pauses still allowed: one where the operator heats.
    pauses: usize,
    /// Whether anything has moved.
    moved: bool,
    head: WantedLine<'a>,
    tail: WantedLine<'a>,
}

impl<'a> ScriptJudge<'a> {
    /// The judge of a program that waits for the operator so often at most.
    pub(super) fn new(machine: &'a Machine, pauses: usize) -> Self {
        let (head, tail) = (WantedLine::new(&machine.script.start), WantedLine::new(&machine.script.end));
        Self { machine, pauses, moved: false, head, tail }
    }

    /// A pause, in the profile's words.
    fn pause(&mut self, line: &Line<'_>, findings: &mut Findings) {
        let text = line.text.trim();
        if self.pauses == 0 || text != self.machine.script.pause {
            let allowed = format!("{} pauses, {}", self.pauses, quote(&self.machine.script.pause));
            findings.add_at(FindingCode::ProfileLine, line.number, quote(text), allowed);
        }
        self.pauses = self.pauses.saturating_sub(1);
    }
}

impl Judge for ScriptJudge<'_> {
    fn line(&mut self, line: &Line<'_>, findings: &mut Findings) {
        if line.is_motion() {
            self.moved = true;
            self.tail.restart(line.number);
        } else if is_code(line.text.trim()) {
            if self.moved {
                self.tail.next(line);
            } else {
                self.head.next(line);
            }
        }
        if line.events.iter().any(|event| matches!(event, Event::Pause(_))) {
            self.pause(line, findings);
        }
    }

    fn end(&mut self, findings: &mut Findings) {
        let pauses = std::mem::take(findings);
        self.head.end(findings);
        self.tail.end(findings);
        findings.absorb(pauses);
    }
}

/// Lines that should follow each other, and the first that does not.
struct WantedLine<'a> {
    lines: Vec<&'a str>,
    /// Number of lines so far.
    come: usize,
    /// The line that was looked at last.
    last: usize,
    /// The number of the first wrong line; its text is below, in a buffer that is used again.
    wrong: Option<usize>,
    text: String,
}

impl<'a> WantedLine<'a> {
    fn new(lines: &'a [String]) -> Self {
        let lines = lines.iter().map(|line| line.trim()).filter(|line| is_code(line)).collect();
        Self { lines, come: 0, last: 1, wrong: None, text: String::new() }
    }

    /// Begins anew after `line`.
    fn restart(&mut self, line: usize) {
        (self.come, self.last, self.wrong) = (0, line, None);
    }

    fn next(&mut self, line: &Line<'_>) {
        if self.wrong.is_some() {
            return;
        }
        self.last = line.number;
        if self.lines.get(self.come) == Some(&line.text.trim()) {
            self.come += 1;
        } else {
            self.wrong = Some(line.number);
            self.text.clear();
            self.text.push_str(line.text.trim_end());
        }
    }

    fn end(&self, findings: &mut Findings) {
        let missing = self.lines.get(self.come).map(|line| format!("{}, as in the profile", quote(line)));
        if let Some(line) = self.wrong {
            let allowed = missing.unwrap_or_else(|| "no further line, as in the profile".to_owned());
            findings.add_at(FindingCode::ProfileLine, line, quote(&self.text), allowed);
        } else if let Some(missing) = missing {
            findings.add_at(FindingCode::ProfileLine, self.last, "nothing more", missing);
        }
    }
}

/// Between the first motion and the last, no mode and no setting changes; and a hotend is heated there as planned, and off
/// before and after. Without one, nothing heats.
pub(super) struct Body {
    /// The temperatures of the heater, in order; empty without one.
    heats: Vec<Temperature>,
    /// The heater; `None` where any hotend may be turned off.
    heater: Option<Heater>,
    /// Number of heatings so far.
    heated: usize,
    moved: bool,
    /// Lines since the last motion: they belong to the body if another motion follows.
    pending: Vec<PendingLine>,
}

/// A line that is right or wrong by its place.
struct PendingLine {
    line: usize,
    text: String,
    /// The heater's command; `None` for a setting.
    heat: Option<Heat>,
}

impl Body {
    /// The judge of a program that heats by `heating` to `heats`, one after the other.
    pub(super) fn new(heats: Vec<Temperature>, heating: &Heating) -> Self {
        let heater = match heating {
            Heating::Operator => None,
            Heating::Hotend(number) => Some(Heater::Hotend(*number)),
            Heating::Heater(name) => Some(Heater::Named(name.clone())),
        };
        Self { heats, heater, heated: 0, moved: false, pending: Vec::new() }
    }

    fn judge(&mut self, pending: &PendingLine, is_within: bool, findings: &mut Findings) {
        // Within the program each heating waits for the next of the temperatures, in their order. Before and after it the lines of
        // the profile may only switch off.
        let right = match (&pending.heat, is_within) {
            (None, is_within) => !is_within,
            (Some(heat), false) => heat.celsius == 0.0 && !heat.waits,
            (Some(heat), true) => {
                let temperature = self.heats.get(self.heated);
                self.heated += 1;
                heat.waits
                    && self.heater.as_ref() == Some(&heat.heater)
                    && temperature.is_some_and(|temperature| (temperature.0 - heat.celsius).abs() <= SAME)
            }
        };
        if right {
            return;
        }
        let heats: Vec<String> = self.heats.iter().map(ToString::to_string).collect();
        let (code, allowed) = match (&pending.heat, heats.as_slice()) {
            (None, _) => {
                (FindingCode::ProfileLine, "modes and settings before the first motion only".to_owned())
            }
            (_, []) => (FindingCode::StrayHeat, "no heating".to_owned()),
            (_, [heat]) => {
                (FindingCode::StrayHeat, format!("one heating to {heat}, and off in the profile's lines"))
            }
            (_, heats) => {
                let heats = heats.join(", ");
                (
                    FindingCode::StrayHeat,
                    format!("heating to {heats} in this order, and off in the profile's lines"),
                )
            }
        };
        findings.add_at(code, pending.line, pending.text.clone(), allowed);
    }

    fn judge_pending(&mut self, is_within: bool, findings: &mut Findings) {
        for told in std::mem::take(&mut self.pending) {
            self.judge(&told, is_within, findings);
        }
    }
}

impl Judge for Body {
    fn line(&mut self, line: &Line<'_>, findings: &mut Findings) {
        let heats = line.events.iter().filter_map(|event| match event {
            Event::Heat(heat) => Some(Some(heat.clone())),
            Event::Setting | Event::Service(_) => Some(None),
            _ => None,
        });
        if line.is_motion() {
            // What stood before the first motion is the head.
            self.judge_pending(self.moved, findings);
            self.moved = true;
        }
        for heat in heats {
            let pending = PendingLine { line: line.number, text: quote(line.text.trim_end()), heat };
            if line.is_motion() || self.pending.len() >= PENDING {
                self.judge(&pending, true, findings);
            } else {
                self.pending.push(pending);
            }
        }
    }

    fn end(&mut self, findings: &mut Findings) {
        self.judge_pending(false, findings);
    }
}

/// Whether a line is more than a comment.
pub(super) fn is_code(line: &str) -> bool {
    !line.is_empty() && !line.starts_with([';', '('])
}
