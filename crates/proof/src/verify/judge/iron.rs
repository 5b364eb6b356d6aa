//! The iron below travel height: hot, in motion, along the fabric and never deeper than contact.

use crate::verify::judge::height::HeightJudge;
use crate::verify::judge::pace::Paced;
use crate::verify::judge::rules::{IronRules, Phase};
use crate::verify::judge::script::Body;
use crate::verify::judge::{HEIGHT, Judge, judged};
use crate::verify::read::gcode::{BlindMove, Dialect, Dwell, Move, MoveKind, Pause};
use crate::verify::{Finding, FindingCode, Findings};
use geom::Bounds;
use spec::units::Speed;

/// Everything in a sealing program, given line by line, that breaks the rules, whatever its seams: the iron stays within
/// `area`, `hotend` tells whether the program heats it.
pub fn judge_iron<'a>(
    rules: &IronRules<'_>,
    area: &Bounds,
    hotend: bool,
    lines: impl IntoIterator<Item = &'a str>,
    dialect: Dialect,
) -> Vec<Finding> {
    let mut judges: Vec<Box<dyn Judge + '_>> = vec![
        Box::new(Body::new(hotend.then_some(rules.seal.temperature))),
        Box::new(HeightJudge::new(&rules.process.heights, *area)),
    ];
    judges.extend(iron(rules));
    let mut findings = Findings::default();
    let _ = judged(lines, dialect, judges, &mut findings);
    findings.into_vec()
}

/// The judges of a sealing program's iron.
pub(super) fn iron<'a>(rules: &'a IronRules<'a>) -> [Box<dyn Judge + 'a>; 4] {
    [
        Box::new(TravelFeed(rules.process.travel_speed)),
        Box::new(IronJudge(rules)),
        Box::new(Paced::new(rules)),
        Box::new(IronRest { rules, here: None, waited: 0.0 }),
    ]
}

/// Below travel height the iron is hot, feeds at seal speed, and moves along the fabric.
struct IronJudge<'a>(&'a IronRules<'a>);

impl Judge for IronJudge<'_> {
    fn step(&mut self, step: &Move, findings: &mut Findings) {
        if self.0.phase(step) == Phase::Clear {
            return;
        }
        let (seal, contact) = (self.0.seal, self.0.process.heights.contact.0);
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
            let (fault, allowed) = ("G0 below travel height", "G1, G2 or G3 at seal speed");
            blame(FindingCode::RapidInContact, fault.to_owned(), allowed.to_owned());
        }
        if step.path.is_none() {
            let (fault, allowed) = ("a vertical move below travel height", "a ramp along the path");
            blame(FindingCode::Plunge, fault.to_owned(), allowed.to_owned());
        }
        if step.from.z.min(step.to.z) < contact - HEIGHT {
            blame(FindingCode::TooDeep, format!("Z{}", step.to.z), format!("Z{contact} or above"));
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

impl Judge for IronRest<'_> {
    fn step(&mut self, step: &Move, _: &mut Findings) {
        let low = self.rules.phase(step) != Phase::Clear;
        (self.here, self.waited) = (low.then_some(step.line), 0.0);
    }

    fn dwell(&mut self, dwell: &Dwell, findings: &mut Findings) {
        self.waited += dwell.seconds;
        let (waited, longest) = (self.waited, self.rules.longest_rest());
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
}

/// Reports everything in a trace program that breaks the rules: it stays at travel height, and runs cold and through.
pub(super) struct Cold<'a>(pub(super) &'a IronRules<'a>);

impl Judge for Cold<'_> {
    fn step(&mut self, step: &Move, findings: &mut Findings) {
        if self.0.phase(step) != Phase::Clear {
            let fault = format!("Z{}", step.to.z);
            findings.add_at(FindingCode::LowTrace, step.line, fault, "travel height or above");
        }
        let speed = self.0.process.trace_speed.0 * 60.0;
        let right = step.feed.is_some_and(|feed| (feed - speed).abs() <= 1e-3 * speed);
        if step.kind == MoveKind::Feed && !right {
            let fault = step.feed.map_or("no feed".to_owned(), |feed| format!("F{feed}"));
            findings.add_at(FindingCode::WrongFeed, step.line, fault, format!("F{speed}"));
        }
    }

    fn pause(&mut self, pause: &Pause, findings: &mut Findings) {
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
