//! Dangers on every machine with an iron: each is found where it is, whatever the dialect.

use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::pipeline::Built;

use crate::danger::missed;
use crate::{all_profiles, findings_after, profile, spec_text, text, try_built_with};

const SEAL: &str = "star-1-seal.gcode";

/// A line among the moves in contact, and the codes of which one must be found at it or at the next.
const IN_CONTACT: &[(&str, &[&str])] = &[
    // The zero, and scales.
    ("G92", &["unknown-word"]),
    ("G92 Z0", &["unknown-word"]),
    ("G92 X0 Y0", &["unknown-word"]),
    ("M206 Z-5", &["unknown-word"]),
    ("M92 X40", &["unknown-word"]),
    // An extruder.
    ("G1 E5 F300", &["unknown-word"]),
    ("G1 X50 Y50 E5", &["unknown-word"]),
    ("M302", &["unknown-word"]),
    ("M302 S0", &["unknown-word"]),
    // Another factor, and other heaters.
    ("M220 S50", &["unknown-word", "feed-override"]),
    ("M140 S120", &["unknown-word", "hot-bed"]),
    ("M190 S120", &["unknown-word", "hot-bed"]),
    ("M104 S250", &["unknown-word", "stray-heat"]),
    ("M109 S250", &["unknown-word", "stray-heat"]),
    // A spindle or a beam.
    ("M3", &["unknown-word"]),
    ("M3 S1000", &["unknown-word"]),
    ("M4 S80", &["unknown-word"]),
    ("M106 S255", &["unknown-word"]),
    // Homing on the fabric, and other units.
    ("G28", &["unknown-word", "unhomed-axis"]),
    ("G28 Z", &["bad-number", "unhomed-axis"]),
    ("G20", &["unknown-word", "profile-line"]),
    ("G91", &["unknown-word", "profile-line"]),
    ("M112", &["unknown-word"]),
];

/// A small seal that every machine runs without strokes.
fn sealing_program(name: &str) -> Built {
    let request = KindRequest::exactly(&[Kind::SealGcode]);
    try_built_with(&spec_text("[seal]\nspeed = \"10 mm/s\"\n"), profile(name), &request)
        .unwrap_or_else(|refusals| panic!("{name}: {refusals:?}"))
}

#[test]
fn no_danger_in_contact_is_proven_on_any_machine() {
    let mut unproven = Vec::new();
    for name in all_profiles() {
        let build = sealing_program(name);
        let good = text(&build, SEAL);
        let lines: Vec<&str> = good.lines().collect();
        let index = lines.iter().rposition(|line| line.starts_with("G1 ") && !line.contains(['Z', 'F']));
        let index = index.expect("a move in contact");
        for (danger, codes) in IN_CONTACT {
            let misses: Option<Vec<String>> =
                codes.iter().map(|code| missed(&build, SEAL, &lines, index, danger, code, 1)).collect();
            unproven.extend(misses.map(|misses| format!("{name}: {misses:?}")));
        }
    }
    assert!(unproven.is_empty(), "{unproven:#?}");
}

/// Every program heats before its first contact, and one that homes does so before its first move.
#[test]
fn contact_before_heat_and_moves_before_homing_are_found_on_every_machine() {
    for name in all_profiles() {
        let build = sealing_program(name);
        let good = text(&build, SEAL);
        let findings = findings_after(&build, SEAL, |lines| {
            let heats = ["M109", "TEMPERATURE_WAIT", "; heat:"];
            lines.retain(|line| heats.iter().all(|start| !line.starts_with(start)));
        });
        assert!(findings.iter().any(|finding| finding.code == "cold-seal"), "{name}: {findings:?}");
        let lines: Vec<&str> = good.lines().collect();
        let Some(homing) = lines.iter().position(|line| *line == "G28") else { continue };
        for danger in ["G0 X50 Y50 F1200", "G0 Z-5 F1200", "G1 Z5 F600"] {
            let findings = findings_after(&build, SEAL, |lines| lines.insert(homing, danger.to_owned()));
            // Among the lines that the profile gives, any other is a finding by itself.
            let codes = ["unhomed-axis", "profile-line"];
            assert!(findings.iter().any(|finding| codes.contains(&finding.code)), "{name}: {findings:?}");
        }
        let findings = findings_after(&build, SEAL, |lines| lines.retain(|line| line != "G28"));
        assert!(!findings.is_empty(), "{name} without homing");
    }
}
