//! The iron below travel height: hot, in motion, along the fabric and never deeper than contact.

use crate::verify::judge::height::HeightJudge;
use crate::verify::judge::pace::Paced;
use crate::verify::judge::rules::{IronRules, Phase};
use crate::verify::judge::script::Body;
use crate::verify::judge::{HEIGHT, Judge, judged};
use crate::verify::read::gcode::{Dialect, Dwell, Event, Line, Move, MoveKind};
use crate::verify::{Finding, FindingCode, Findings};
use inflatable::geom::Bounds;

/// Everything in a sealing program, given line by line, that breaks the rules, whatever its seams: the iron stays within
/// `area`, `hotend` tells whether the program heats it.
pub fn judge_iron<'a>(
    rules: &IronRules<'_>,
    area: &Bounds,
    hotend: bool,
    lines: impl IntoIterator<Item = &'a str>,
    dialect: Dialect,
) -> Vec<Finding> {
    let mut body = Body::new(Some(rules.seal.temperature).filter(|_| hotend));
    let mut height = HeightJudge::new(&rules.process.heights, *area);
    let [mut travel, mut contact, mut pace, mut rest] = iron(rules);
    let judges: &mut [&mut dyn Judge] =
        &mut [&mut body, &mut height, &mut *travel, &mut *contact, &mut *pace, &mut *rest];
    judged(lines, dialect, judges).into_vec()
}

/// The judges of a sealing program's iron.
pub(in crate::verify) fn iron<'a>(rules: &'a IronRules<'a>) -> [Box<dyn Judge + 'a>; 4] {
    [
        Box::new(TravelFeed::new(rules.process.travel_speed.0)),
        Box::new(IronJudge { rules }),
        Box::new(Paced::new(rules)),
        Box::new(IronRest { rules, here: None, waited: 0.0 }),
    ]
}

/// Below travel height the iron is hot, feeds at seal speed, and moves along the fabric.
struct IronJudge<'a> {
    rules: &'a IronRules<'a>,
}

impl IronJudge<'_> {
    fn step(&self, step: &Move, findings: &mut Findings) {
        let (seal, contact) = (self.rules.seal, self.rules.process.heights.contact.0);
        let mut blame = |code: FindingCode, found: String, allowed: String| {
            findings.add_at(code, step.line, found, allowed);
        };
        match step.heated {
            Some(t) if (t - seal.temperature.0).abs() <= 0.5 => {}
            found => blame(
                FindingCode::ColdSeal,
                found.map_or("an unheated iron".to_owned(), |t| format!("{t} C")),
                seal.temperature.to_string(),
            ),
        }
        if step.kind == MoveKind::Rapid {
            let (found, allowed) = ("G0 below travel height", "G1, G2 or G3 at seal speed");
            blame(FindingCode::RapidInContact, found.to_owned(), allowed.to_owned());
        }
        if step.path.is_none() {
            let (found, allowed) = ("a vertical move below travel height", "a ramp along the path");
            blame(FindingCode::Plunge, found.to_owned(), allowed.to_owned());
        }
        if step.from.z.min(step.to.z) < contact - HEIGHT {
            blame(FindingCode::TooDeep, format!("Z{}", step.to.z), format!("Z{contact} or above"));
        }
    }
}

impl Judge for IronJudge<'_> {
    fn see(&mut self, line: &Line<'_>, findings: &mut Findings) {
        for event in line.events {
            if let Event::Move(step) = event
                && self.rules.phase(step) != Phase::Clear
            {
                self.step(step, findings);
            }
        }
    }
}

/// On the fabric the iron never waits for long, and away from it never at all.
struct IronRest<'a> {
    rules: &'a IronRules<'a>,
    /// Line of the last move, if that touched the fabric or left it, and the time waited since, s. However many waits it
    /// takes, the iron rests in one place; the last stroke of a seam ends, and has its wait, at travel height.
    here: Option<usize>,
    waited: f64,
}

impl IronRest<'_> {
    fn wait(&mut self, dwell: &Dwell, findings: &mut Findings) {
        self.waited += dwell.seconds;
        let (waited, longest) = (self.waited, self.rules.longest_rest());
        let Some(here) = self.here else {
            let found = format!("{} s away from the fabric", dwell.seconds);
            findings.add_at(FindingCode::IronAtRest, dwell.line, found, "waits between strokes only");
            return;
        };
        if waited > longest {
            let found = if waited > dwell.seconds {
                format!("{waited} s since line {here}")
            } else {
                format!("{waited} s")
            };
            let allowed = format!("at most {longest:.2} s");
            findings.add_at(FindingCode::IronAtRest, dwell.line, found, allowed);
        }
    }
}

impl Judge for IronRest<'_> {
    fn see(&mut self, line: &Line<'_>, findings: &mut Findings) {
        for event in line.events {
            match event {
                Event::Move(step) => {
                    let low = self.rules.phase(step) != Phase::Clear;
                    (self.here, self.waited) = (low.then_some(step.line), 0.0);
                }
                Event::Dwell(dwell) => self.wait(dwell, findings),
                Event::Pause(pause) if pause.at.is_some_and(|at| self.rules.is_low(at.z)) => {
                    let (found, allowed) = ("a pause on the fabric", "pauses above travel height only");
                    findings.add_at(FindingCode::IronAtRest, pause.line, found, allowed);
                }
                _ => {}
            }
        }
    }
}

/// Reports everything in a trace program that breaks the rules: it stays at travel height, and runs cold and through.
pub(in crate::verify) struct Cold<'a> {
    rules: &'a IronRules<'a>,
}

impl<'a> Cold<'a> {
    pub(in crate::verify) fn new(rules: &'a IronRules<'a>) -> Self {
        Self { rules }
    }

    fn step(&self, step: &Move, findings: &mut Findings) {
        if self.rules.phase(step) != Phase::Clear {
            let found = format!("Z{}", step.to.z);
            findings.add_at(FindingCode::LowTrace, step.line, found, "travel height or above");
        }
        let speed = self.rules.process.trace_speed.0 * 60.0;
        let right = step.feed.is_some_and(|feed| (feed - speed).abs() <= 1e-3 * speed);
        if step.kind == MoveKind::Feed && !right {
            let found = step.feed.map_or("no feed".to_owned(), |feed| format!("F{feed}"));
            findings.add_at(FindingCode::WrongFeed, step.line, found, format!("F{speed}"));
        }
    }
}

impl Judge for Cold<'_> {
    fn see(&mut self, line: &Line<'_>, findings: &mut Findings) {
        for event in line.events {
            match event {
                Event::Move(step) => self.step(step, findings),
                Event::Pause(pause) => {
                    let (found, allowed) = ("a pause as for heating", "a trace without heating and pauses");
                    findings.add_at(FindingCode::HotTrace, pause.line, found, allowed);
                }
                Event::Dwell(dwell) => {
                    let found = format!("{} s", dwell.seconds);
                    findings.add_at(FindingCode::IronAtRest, dwell.line, found, "no wait in a trace");
                }
                _ => {}
            }
        }
    }
}

/// Reports every G0 that the controller runs at another feed than that of `speed`, mm/s.
pub(in crate::verify) struct TravelFeed {
    allowed: f64,
}

impl TravelFeed {
    pub(in crate::verify) fn new(speed: f64) -> Self {
        Self { allowed: speed * 60.0 }
    }
}

impl Judge for TravelFeed {
    fn see(&mut self, line: &Line<'_>, findings: &mut Findings) {
        let allowed = self.allowed;
        for event in line.events {
            let (kind, feed, line) = match event {
                Event::Move(step) => (step.kind, step.feed, step.line),
                Event::Blind(step) => (step.kind, step.feed, step.line),
                _ => continue,
            };
            let other = feed.filter(|feed| (feed - allowed).abs() > 1e-6 * allowed);
            if let Some(feed) = other.filter(|_| kind == MoveKind::Rapid) {
                let found = format!("a G0 at F{feed}, the feed in force");
                findings.add_at(FindingCode::TravelFeed, line, found, format!("F{allowed}"));
            }
        }
    }
}
