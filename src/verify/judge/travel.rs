//! Travels: where G0 runs at the feed in force, none may crawl at the seal's with a hot iron above the fabric.

use crate::verify::read::gcode::{MoveKind, Program};
use crate::verify::{FindingCode, Findings};

/// Reports every G0 that the controller runs at another feed than that of `speed`, mm/s.
pub(in crate::verify) fn check(speed: f64, program: &Program, findings: &mut Findings) {
    let allowed = speed * 60.0;
    for step in program.moves.iter().filter(|step| step.kind == MoveKind::Rapid) {
        if let Some(feed) = step.feed.filter(|feed| (feed - allowed).abs() > 1e-6 * allowed) {
            let found = format!("a G0 at F{feed}, the feed in force");
            findings.add(FindingCode::TravelFeed, step.line, found, format!("F{allowed}"));
        }
    }
}
