//! Comments and travels of a program: each word in its place, in every dialect, steady and chopped.

use crate::{PROFILES, built, findings_with, is_printer, profile, spec_text, text};

const FILE: &str = "star-1-seal.gcode";

/// The findings of reading after `change` of the lines of a sealing program: codes and lines, without those of the last line.
fn codes_after(name: &str, change: impl Fn(&mut Vec<String>)) -> Vec<(&'static str, Option<usize>)> {
    let chop = crate::has_floor(name);
    let rest = if chop { "[machine]\nfeed_floor = \"chop\"\n" } else { "" };
    let build = built(&spec_text(rest), profile(name));
    let mut lines: Vec<String> = text(&build, FILE).lines().map(str::to_owned).collect();
    change(&mut lines);
    let (last, count) = (lines.len() - 1, lines.len());
    let close = if lines[last].ends_with(')') { ")" } else { "" };
    let mark = lines[last].find("end of program").expect("a last line");
    lines[last] = format!("{}end of program, {count} lines{close}", &lines[last][..mark]);
    let findings = findings_with(&build, FILE, &(lines.join("\n") + "\n"));
    assert!(
        findings.iter().all(|finding| finding.file.starts_with(FILE.trim_end_matches("gcode"))),
        "{findings:#?}"
    );
    findings.iter().map(|finding| (finding.code, finding.line)).collect()
}

/// Index of the `n`-th line that contains `needle`.
fn nth(lines: &[String], needle: &str, n: usize) -> usize {
    (0..lines.len()).filter(|i| lines[*i].contains(needle)).nth(n).expect(needle)
}

#[test]
fn a_comment_in_another_place_is_found() {
    for name in PROFILES {
        // The title of a seam among its moves, and before the travel to it.
        for way in [4_isize, -3] {
            let codes = codes_after(name, |lines| {
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
    for name in PROFILES {
        let feed = if is_printer(name) { " F1200" } else { "" };
        // The return to the start by a detour, and no return at all.
        let index = std::cell::Cell::new(0);
        let detour = codes_after(name, |lines| {
            index.set(nth(lines, "G0 X0 Y0", 0));
            lines.insert(index.get(), format!("G0 X9 Y9{feed}"));
        });
        assert!(detour.contains(&("stray-travel", Some(index.get() + 1))), "{name}: {detour:?}");
        let astray = codes_after(name, |lines| {
            index.set(nth(lines, "G0 X0 Y0", 0));
            lines[index.get()] = format!("G0 X0 Y9{feed}");
        });
        assert!(astray.contains(&("stray-travel", Some(index.get() + 1))), "{name}: {astray:?}");
        let low = codes_after(name, |lines| {
            let lift = nth(lines, "G0 Z30", 1);
            let _ = lines.remove(lift);
        });
        assert!(low.iter().any(|(code, _)| *code == "stray-travel"), "{name}: {low:?}");
    }
}
