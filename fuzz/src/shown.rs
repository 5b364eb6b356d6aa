//! Checks of texts that are shown to a person.

use stargrip_cam::spec::{Faults, misleads};
use stargrip_cam::verify::Finding;

/// Longest text of all faults together, bytes: thirty with a line of each, and some room.
const LONGEST: usize = 1 << 16;

/// Faults go to a terminal as they are, with colour or without: nothing in them may move its cursor.
pub(super) fn faults(faults: &Faults) {
    let plain = faults.to_string();
    harmless(&plain);
    assert!(plain.len() <= LONGEST, "{} bytes of faults", plain.len());
    // Colours are the only control sequences allowed.
    let mut rest = faults.for_terminal(None, true);
    while let Some(at) = rest.find('\u{1b}') {
        let colour = rest[at + 1..].strip_prefix('[').and_then(|code| code.split_once('m'));
        let (code, after) = colour.expect("a colour");
        assert!(code.chars().all(|c| c.is_ascii_digit() || c == ';'), "{code:?}");
        rest = rest[..at].to_owned() + after;
    }
    harmless(&rest);
}

/// Checks the findings of a reader: few, and each on one line.
pub(super) fn findings(findings: &[Finding]) {
    assert!(findings.len() <= 101, "{} findings", findings.len());
    for finding in findings {
        line(&finding.found);
        line(&finding.allowed);
    }
}

/// A text on one line.
pub(super) fn line(text: &str) {
    assert!(!text.contains(misleads), "{text:?}");
    assert!(text.len() < 4096, "{} bytes: {text}", text.len());
}

fn harmless(text: &str) {
    assert!(!text.contains(|c: char| misleads(c) && !matches!(c, '\n' | '\t')), "{text:?}");
}
