//! Travels: where G0 runs at the feed in force, none may crawl at the seal's with a hot iron above the fabric.

use crate::verify::judge::Judge;
use crate::verify::read::gcode::{Event, Line, MoveKind};
use crate::verify::{FindingCode, Findings};

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
