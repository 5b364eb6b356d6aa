//! The speed in a file against the spec's: rounding may change it by at most a thousandth.

use crate::{built, findings_with, profile, spec_text, text};

const SEAL: &str = "star-1-seal.gcode";

/// The lines that are found too fast or too slow if the first touch-down has `feed` instead of F60.
fn wrong(feed: &str) -> Vec<usize> {
    let build = built(&spec_text("[seal]\nspeed = \"1 mm/s\"\n"), profile("generic"));
    let program = text(&build, SEAL).replacen(" F60\n", &format!(" {feed}\n"), 1);
    assert!(program.contains(feed));
    let findings = findings_with(&build, SEAL, &program);
    findings
        .iter()
        .filter(|finding| finding.code == "wrong-feed")
        .filter_map(|finding| finding.line)
        .collect()
}

#[test]
fn a_feed_is_as_told_to_a_thousandth() {
    let build = built(&spec_text("[seal]\nspeed = \"1 mm/s\"\n"), profile("generic"));
    let touch_down = text(&build, SEAL).lines().position(|line| line.ends_with(" F60")).expect("a line") + 1;
    for feed in ["F60", "F60.05", "F59.95"] {
        assert!(wrong(feed).is_empty(), "{feed}");
    }
    for feed in ["F60.07", "F59.93", "F6", "F600"] {
        // The feed stays in force: the touch-down is the first of many.
        assert_eq!(wrong(feed).first(), Some(&touch_down), "{feed}");
    }
}
