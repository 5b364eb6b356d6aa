//! The iron below travel height: hot, in motion, along the fabric and never deeper than contact.

use crate::geom::Bounds;
use crate::verify::judge::rules::{IronRules, Phase};
use crate::verify::judge::{HEIGHT, height, pace, script, travel};
use crate::verify::read::gcode::{MoveKind, Program};
use crate::verify::{Finding, FindingCode, Findings};

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
