//! The iron below travel height: hot, in motion, along the fabric and never deeper than contact.

use crate::geom::Bounds;
use crate::spec::{FeedFloor, Machine, Motion, Process, Seal, Spec};
use crate::verify::judge::{HEIGHT, height, pace, script, travel};
use crate::verify::read::gcode::{Move, MoveKind, Program};
use crate::verify::{Finding, FindingCode, Findings};

/// How the iron is to be led, whatever its path.
#[derive(Clone, Copy, Debug)]
pub struct IronRules<'a> {
    /// Temperature, speed and band.
    pub seal: &'a Seal,
    /// Heights and travels.
    pub process: &'a Process,
    /// What is known of the motors.
    pub motion: &'a Motion,
    /// The step to which the controller rounds dwells up, s.
    pub dwell_step: f64,
    /// Whether the speed may be made of strokes and dwells.
    pub chops: bool,
    /// Whether all is known that strokes are timed by.
    pub timed: bool,
}

/// What the iron is doing, told from its heights.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(in crate::verify) enum Phase {
    /// Away from the fabric.
    Clear,
    /// On the way down or up.
    Ramp,
    /// In contact.
    Contact,
}

impl<'a> IronRules<'a> {
    /// The rules for programs of `spec` on `machine`.
    pub fn new(spec: &'a Spec, machine: &'a Machine) -> Self {
        Self {
            seal: &spec.seal,
            process: &machine.process,
            motion: &machine.motion,
            dwell_step: machine.controller.dwell.step.0,
            chops: spec.machine.feed_floor == FeedFloor::Chop,
            timed: true,
        }
    }

    /// What the iron does in a move.
    pub(in crate::verify) fn phase(&self, step: &Move) -> Phase {
        let heights = &self.process.heights;
        let (low, high) = (step.from.z.min(step.to.z), step.from.z.max(step.to.z));
        if low >= heights.travel.0 - HEIGHT {
            Phase::Clear
        } else if high <= heights.contact.0 + HEIGHT {
            Phase::Contact
        } else {
            Phase::Ramp
        }
    }

    /// The longest time at rest, s: what a tenth of the band takes; longer leaves a scar.
    fn longest_rest(&self) -> f64 {
        self.seal.band.0 / 10.0 / self.seal.speed.0
    }

    /// Whether a height is below that of travels.
    fn is_low(&self, z: f64) -> bool {
        z < self.process.heights.travel.0 - HEIGHT
    }
}

/// Everything in a sealing program that breaks the rules, whatever its seams: the iron stays within `area`, `hotend`
/// tells whether the program heats it.
pub fn judge_iron(
    rules: &IronRules<'_>,
    area: &Bounds,
    hotend: bool,
    text: &str,
    program: &Program,
) -> Vec<Finding> {
    let mut findings = Findings::default();
    script::check_body(Some(rules.seal.temperature).filter(|_| hotend), text, program, &mut findings);
    height::check(&rules.process.heights, area, program, &mut findings);
    check(rules, program, &mut findings);
    findings.into_vec()
}

/// Reports everything in a sealing program that breaks the rules.
pub(in crate::verify) fn check(rules: &IronRules<'_>, program: &Program, findings: &mut Findings) {
    travel::check(rules.process.travel_speed.0, program, findings);
    contact(rules, program, findings);
    pace::check(rules, program, findings);
    rest(rules, program, findings);
}

/// Reports everything in a trace program that breaks the rules: it stays at travel height, and runs cold and through.
pub(in crate::verify) fn check_cold(rules: &IronRules<'_>, program: &Program, findings: &mut Findings) {
    travel::check(rules.process.travel_speed.0, program, findings);
    for step in program.moves.iter().filter(|step| rules.phase(step) != Phase::Clear) {
        findings.add(FindingCode::LowTrace, step.line, format!("Z{}", step.to.z), "travel height or above");
    }
    if let Some(pause) = program.pauses.first() {
        let found = "a pause as for heating";
        findings.add(FindingCode::HotTrace, pause.line, found, "a trace runs unheated and through");
    }
    let speed = rules.process.trace_speed.0 * 60.0;
    for step in program.moves.iter().filter(|step| step.kind == MoveKind::Feed) {
        if step.feed.is_none_or(|feed| (feed - speed).abs() > 1e-3 * speed) {
            let found = step.feed.map_or("no feed".to_owned(), |feed| format!("F{feed}"));
            findings.add(FindingCode::WrongFeed, step.line, found, format!("F{speed}"));
        }
    }
    for dwell in &program.dwells {
        findings.add(
            FindingCode::IronAtRest,
            dwell.line,
            format!("{} s", dwell.seconds),
            "no wait in a trace",
        );
    }
}

/// Below travel height the iron is hot, feeds at seal speed, and moves along the fabric.
fn contact(rules: &IronRules<'_>, program: &Program, findings: &mut Findings) {
    let (seal, contact) = (rules.seal, rules.process.heights.contact.0);
    for step in program.moves.iter().filter(|step| rules.phase(step) != Phase::Clear) {
        match step.heated {
            Some(t) if (t - seal.temperature.0).abs() <= 0.5 => {}
            found => findings.add(
                FindingCode::ColdSeal,
                step.line,
                found.map_or("an iron that nobody heated".to_owned(), |t| format!("{t} C")),
                seal.temperature.to_string(),
            ),
        }
        if step.kind == MoveKind::Rapid {
            findings.add(
                FindingCode::RapidInContact,
                step.line,
                "G0 below travel height",
                "G1, G2 or G3 at seal speed",
            );
        }
        if step.path.is_none() {
            findings.add(
                FindingCode::Plunge,
                step.line,
                "a vertical move below travel height",
                "a ramp along the path",
            );
        }
        if step.from.z.min(step.to.z) < contact - HEIGHT {
            findings.add(
                FindingCode::TooDeep,
                step.line,
                format!("Z{}", step.to.z),
                format!("Z{contact} or above"),
            );
        }
    }
}

/// On the fabric the iron never waits for long, and away from it never at all.
fn rest(rules: &IronRules<'_>, program: &Program, findings: &mut Findings) {
    let longest = rules.longest_rest();
    let mut moves = program.moves.iter().peekable();
    // Between two moves the iron stands in one place, however many waits it takes; the last stroke of a seam ends, and
    // has its wait, at travel height.
    let (mut here, mut waited) = (None, 0.0);
    for dwell in &program.dwells {
        while let Some(step) = moves.next_if(|step| step.line <= dwell.line) {
            (here, waited) = (Some(step), 0.0);
        }
        waited += dwell.seconds;
        let Some(here) = here.filter(|step| rules.phase(step) != Phase::Clear) else {
            let found = format!("{} s away from the fabric", dwell.seconds);
            findings.add(FindingCode::IronAtRest, dwell.line, found, "waits between strokes only");
            continue;
        };
        if waited > longest {
            let found = if waited > dwell.seconds {
                format!("{waited} s since line {}", here.line)
            } else {
                format!("{waited} s")
            };
            findings.add(FindingCode::IronAtRest, dwell.line, found, format!("at most {longest:.2} s"));
        }
    }
    for pause in program.pauses.iter().filter(|pause| pause.at.is_some_and(|at| rules.is_low(at.z))) {
        findings.add(
            FindingCode::IronAtRest,
            pause.line,
            "a pause on the fabric",
            "pauses above travel height only",
        );
    }
}
