//! The iron below travel height: hot, in motion, along the fabric and never deeper than contact.

use crate::verify::judge::beam::BeamJudge;
use crate::verify::judge::height::HeightJudge;
use crate::verify::judge::pace::Paced;
use crate::verify::judge::ready::ReadyJudge;
use crate::verify::judge::rules::{ContactCount, ContactRule, IronRules, Phase};
use crate::verify::judge::script::Body;
use crate::verify::judge::{HEIGHT, Judge, judged};
use crate::verify::read::gcode::{BlindMove, Comment, Dialect, Dwell, Move, MoveKind, Pause};
use crate::verify::{Finding, FindingCode, Findings};
use geom::Bounds;
use spec::Controller;
use spec::units::Speed;

/// Largest difference of waits that are as long, beside the step of a dwell, s: a program may state a millisecond less.
const COOL: f64 = 2e-3;

/// Everything in a sealing program for `controller`, given line by line, that breaks the rules, whatever its seams: the iron stays within
/// `area`.
pub fn judge_iron<'a>(
    rules: &IronRules<'_>,
    area: &Bounds,
    controller: &Controller,
    lines: impl IntoIterator<Item = &'a str>,
) -> Vec<Finding> {
    let heats = if controller.heating.is_by_program() { rules.heats() } else { Vec::new() };
    let mut judges: Vec<Box<dyn Judge + '_>> = vec![Box::new(Body::new(heats, &controller.heating))];
    judges.extend(ReadyJudge::for_controller(controller));
    judges.push(Box::new(HeightJudge::new(&rules.process.heights, *area)));
    judges.extend(iron(rules));
    judges.extend(
        controller.laser.map(|laser| -> Box<dyn Judge + '_> { Box::new(BeamJudge::new(laser, rules)) }),
    );
    let mut findings = Findings::default();
    let _ = judged(lines, Dialect::for_controller(controller), judges, &mut findings);
    findings.into_vec()
}

/// The judges of a sealing program's iron.
pub(super) fn iron<'a>(rules: &'a IronRules<'a>) -> [Box<dyn Judge + 'a>; 4] {
    [
        Box::new(TravelFeed(rules.process.travel_speed)),
        Box::new(IronJudge { rules, count: ContactCount::default() }),
        Box::new(Paced::new(rules)),
        Box::new(IronRest::new(rules)),
    ]
}

/// Below travel height the iron is hot, feeds at seal speed, and moves along the fabric.
struct IronJudge<'a> {
    rules: &'a IronRules<'a>,
    count: ContactCount,
}

impl Judge for IronJudge<'_> {
    fn step(&mut self, step: &Move, findings: &mut Findings) {
        let (phase, ContactRule { seal, height: contact, .. }) = self.rules.follow(&mut self.count, step);
        if phase == Phase::Clear {
            return;
        }
        match step.heated {
            Some(t) if (t - seal.temperature.0).abs() <= 0.5 => {}
            // A tool of 0 C is cold.
            None if seal.temperature.0 <= 0.0 => {}
            heated => findings.add_at(
                FindingCode::ColdSeal,
                step.line,
                heated.map_or("an unheated iron".to_owned(), |t| format!("{t} C")),
                seal.temperature.to_string(),
            ),
        }
        if step.kind == MoveKind::Rapid {
            let (fault, allowed) = ("G0 below travel height", "G1, G2 or G3 at seal speed");
            findings.add_at(FindingCode::RapidInContact, step.line, fault, allowed);
        }
        if step.path.is_none() {
            let (fault, allowed) = ("a vertical move below travel height", "a ramp along the path");
            findings.add_at(FindingCode::Plunge, step.line, fault, allowed);
        }
        if step.from.z.min(step.to.z) < contact - HEIGHT {
            let (fault, allowed) = (format!("Z{}", step.to.z), format!("Z{contact} or above"));
            findings.add_at(FindingCode::TooDeep, step.line, fault, allowed);
        }
    }
}

/// On the fabric the iron never waits for long, and away from it only for a seam to cool.
struct IronRest<'a> {
    rules: &'a IronRules<'a>,
    count: ContactCount,
    /// Line of the last move, if that touched the fabric or left it, and the time waited since, s. However many waits it
    /// takes, the iron rests in one place; the last stroke of a seam ends, and has its wait, at travel height.
    here: Option<usize>,
    waited: f64,
    /// Height of the last move's end, mm.
    height: f64,
    /// Line of the comment that announces a wait for a seam to cool.
    cooling: Option<usize>,
}

impl<'a> IronRest<'a> {
    fn new(rules: &'a IronRules<'a>) -> Self {
        Self { rules, count: ContactCount::default(), here: None, waited: 0.0, height: 0.0, cooling: None }
    }

    /// Reports a wait that was announced and is not there.
    fn end_cooling(&mut self, findings: &mut Findings) {
        if let Some(line) = self.cooling.take() {
            let allowed = format!("a wait of {} s at travel height", self.rules.rule(&self.count).cool);
            findings.add_at(FindingCode::MissingWait, line, "no wait for the seam to cool", allowed);
        }
    }
}

impl Judge for IronRest<'_> {
    fn step(&mut self, step: &Move, findings: &mut Findings) {
        self.end_cooling(findings);
        let (phase, _) = self.rules.follow(&mut self.count, step);
        (self.here, self.waited) = ((phase != Phase::Clear).then_some(step.line), 0.0);
        self.height = step.to.z;
    }

    fn comment(&mut self, comment: &Comment, _: &mut Findings) {
        if comment.key() == Some("cool") {
            self.cooling = Some(comment.line);
        }
    }

    fn dwell(&mut self, dwell: &Dwell, findings: &mut Findings) {
        let rule = self.rules.rule(&self.count);
        if self.cooling.take().is_some() {
            let is_high = self.height >= self.rules.process.heights.travel.0 - HEIGHT;
            if !is_high || (dwell.seconds - rule.cool).abs() > self.rules.dwell_step + COOL {
                let allowed = format!("a wait of {} s at travel height", rule.cool);
                let fault = format!("a wait of {} s at Z{}", dwell.seconds, self.height);
                findings.add_at(FindingCode::MissingWait, dwell.line, fault, allowed);
            }
            return;
        }
        self.waited += dwell.seconds;
        let (waited, longest) = (self.waited, rule.longest_rest(self.rules.motion));
        let Some(line_of_rest) = self.here else {
            let fault = format!("{} s away from the fabric", dwell.seconds);
            findings.add_at(FindingCode::IronAtRest, dwell.line, fault, "waits between strokes only");
            return;
        };
        if waited > longest {
            let fault = if waited > dwell.seconds {
                format!("{waited} s since line {line_of_rest}")
            } else {
                format!("{waited} s")
            };
            let allowed = format!("at most {longest:.2} s");
            findings.add_at(FindingCode::IronAtRest, dwell.line, fault, allowed);
        }
    }

    fn pause(&mut self, pause: &Pause, findings: &mut Findings) {
        if pause.at.is_some_and(|at| at.z < self.rules.process.heights.travel.0 - HEIGHT) {
            let (fault, allowed) = ("a pause on the fabric", "pauses above travel height only");
            findings.add_at(FindingCode::IronAtRest, pause.line, fault, allowed);
        }
    }

    fn end(&mut self, findings: &mut Findings) {
        self.end_cooling(findings);
    }
}

/// Reports everything in a trace program that breaks the rules: it stays at travel height, and runs cold and through, but for the stops
/// above marks.
pub(super) struct Cold<'a> {
    pub(super) rules: &'a IronRules<'a>,
    /// Number of stops above marks that are still to come.
    pub(super) marks: usize,
}

impl Judge for Cold<'_> {
    fn step(&mut self, step: &Move, findings: &mut Findings) {
        if !self.rules.is_clear(step) {
            let fault = format!("Z{}", step.to.z);
            findings.add_at(FindingCode::LowTrace, step.line, fault, "travel height or above");
        }
        let speed = self.rules.process.trace_speed.0 * 60.0;
        let right = step.feed.is_some_and(|feed| (feed - speed).abs() <= 1e-3 * speed);
        if step.kind == MoveKind::Feed && !right {
            let fault = step.feed.map_or("no feed".to_owned(), |feed| format!("F{feed}"));
            findings.add_at(FindingCode::WrongFeed, step.line, fault, format!("F{speed}"));
        }
    }

    fn pause(&mut self, pause: &Pause, findings: &mut Findings) {
        if self.marks > 0 {
            self.marks -= 1;
            return;
        }
        let (fault, allowed) = ("a pause as for heating", "a trace without heating and pauses");
        findings.add_at(FindingCode::HotTrace, pause.line, fault, allowed);
    }

    fn dwell(&mut self, dwell: &Dwell, findings: &mut Findings) {
        let fault = format!("{} s", dwell.seconds);
        findings.add_at(FindingCode::IronAtRest, dwell.line, fault, "no wait in a trace");
    }
}

/// Reports every G0 that the controller runs at another feed than that of this speed.
pub(super) struct TravelFeed(pub(super) Speed);

impl TravelFeed {
    fn travel(&self, kind: MoveKind, feed: Option<f64>, line: usize, findings: &mut Findings) {
        let allowed = self.0.0 * 60.0;
        let other = feed.filter(|feed| (feed - allowed).abs() > 1e-6 * allowed);
        if let Some(feed) = other.filter(|_| kind == MoveKind::Rapid) {
            let fault = format!("a G0 at F{feed}, the feed in force");
            findings.add_at(FindingCode::TravelFeed, line, fault, format!("F{allowed}"));
        }
    }
}

impl Judge for TravelFeed {
    fn step(&mut self, step: &Move, findings: &mut Findings) {
        self.travel(step.kind, step.feed, step.line, findings);
    }

    fn blind(&mut self, step: &BlindMove, findings: &mut Findings) {
        self.travel(step.kind, step.feed, step.line, findings);
    }
}
