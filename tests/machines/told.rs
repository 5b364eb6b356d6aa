//! Comments and travels of a program: each word in its place, in every dialect, steady and chopped.

use stargrip_cam::pipeline::Built;

use crate::{PROFILES, findings_after, is_printer, profiles_of_dialects, star};

const FILE: &str = "star-1-seal.gcode";

/// The codes of the findings after `change` of the lines of a sealing program, and their lines.
fn codes_after(build: &Built, change: impl FnOnce(&mut Vec<String>)) -> Vec<(&'static str, Option<usize>)> {
    let findings = findings_after(build, FILE, change);
    findings.iter().map(|finding| (finding.code, finding.line)).collect()
}

/// Index of the `n`-th line that contains `needle`.
fn nth(lines: &[String], needle: &str, n: usize) -> usize {
    (0..lines.len()).filter(|i| lines[*i].contains(needle)).nth(n).expect(needle)
}

#[test]
fn a_comment_in_another_place_is_found() {
    for name in profiles_of_dialects() {
        let build = star(name);
        // The title of a seam among its moves, and before the travel to it.
        for way in [4_isize, -3] {
            let codes = codes_after(&build, |lines| {
                let index = nth(lines, "seam: seam=2", 0);
                let title = lines.remove(index);
                lines.insert(index.saturating_add_signed(way), title);
            });
            assert!(
                codes.iter().any(|(code, line)| *code == "other-comment" && line.is_some()),
                "{name}: {codes:?}"
            );
        }
    }
}

#[test]
fn a_travel_to_another_place_is_found() {
    for name in profiles_of_dialects() {
        let build = star(name);
        let feed = if is_printer(name) { " F1200" } else { "" };
        // A printer's corner of the sheet lies at X20 Y20.
        let home = if PROFILES.contains(&name) { "G0 X0 Y0" } else { "G0 X20 Y20" };
        // The return to the start by a detour, and no return at all.
        let index = std::cell::Cell::new(0);
        let detour = codes_after(&build, |lines| {
            index.set(nth(lines, home, 0));
            lines.insert(index.get(), format!("G0 X9 Y9{feed}"));
        });
        assert!(detour.contains(&("stray-travel", Some(index.get() + 1))), "{name}: {detour:?}");
        let astray = codes_after(&build, |lines| {
            index.set(nth(lines, home, 0));
            lines[index.get()] = format!("G0 X0 Y9{feed}");
        });
        assert!(astray.contains(&("stray-travel", Some(index.get() + 1))), "{name}: {astray:?}");
        let low = codes_after(&build, |lines| {
            let lift = nth(lines, "G0 Z30", 1);
            let _ = lines.remove(lift);
        });
        assert!(low.iter().any(|(code, _)| *code == "stray-travel"), "{name}: {low:?}");
    }
}
