//! Seeded faults: each is found by its code and at its place, for every place and dialect.

use proptest::prelude::*;
use stargrip_cam::verify::Finding;

use crate::{PROFILES, built, findings_with, recounted, star, star_text, text};

const FILE: &str = "star-1-seal.gcode";
/// The operator's heating instruction in programs without a heating command.
const HEAT: &str = "; heat: temperature_C=200";

/// Indices of the lines that cut in contact: feed moves in the plane without a height.
fn contact(lines: &[String]) -> Vec<usize> {
    let is_cut = |line: &str| ["G1 ", "G2 ", "G3 "].iter().any(|code| line.starts_with(code));
    (0..lines.len()).filter(|i| is_cut(&lines[*i]) && !lines[*i].contains('Z')).collect()
}

/// A program with a fault in it, and the expected finding: the code, and the line, from 1.
struct Seeded {
    text: String,
    code: &'static str,
    line: usize,
}

/// Index of an item of `n` at a place from 0 to 1.
fn pick(n: usize, share: f64) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "small"
    )]
    let i = (share * n as f64) as usize;
    i.min(n - 1)
}

/// Inserts one fault at a place from 0 to 1; `None` if this program has no place for it.
fn seeded(kind: usize, share: f64, text: &str) -> Option<Seeded> {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let count = lines.len();
    let cuts = contact(&lines);
    let cut = cuts[pick(cuts.len(), share)];
    let starting = |code: &str| (0..count).filter(|i| lines[*i].starts_with(code)).collect::<Vec<_>>();
    let dwells = starting("G4 P");
    let heat = starting("M109").first().copied().or_else(|| lines.iter().position(|line| line == HEAT))?;
    // The end of the first contact: its last cut, and the move up.
    let up = (cuts[0]..count).find(|i| lines[*i].contains('Z'))?;
    let before_up = |n: usize| cuts.iter().copied().filter(|i| *i < up).rev().nth(n);
    let dialect = text.split("dialect=").nth(1)?.split(' ').next()?;
    let (code, line): (&'static str, usize) = match kind {
        // The feed changed from here on.
        0 => {
            let line = lines[cut].split(" F").next().unwrap_or_default().to_owned();
            lines[cut] = line + " F30";
            ("wrong-feed", cut + 1)
        }
        // An arc reversed.
        1 => {
            let is_arc = |i: &usize| lines[*i].starts_with("G2") || lines[*i].starts_with("G3");
            let arcs: Vec<usize> = cuts.iter().copied().filter(is_arc).collect();
            let arc = *arcs.get(pick(arcs.len().max(1), share))?;
            let turned = if lines[arc].starts_with("G2") { "G3" } else { "G2" };
            lines[arc].replace_range(..2, turned);
            ("deviation", arc + 1)
        }
        // A loop left open: moves before the first lift are missing, so that its last move comes too early.
        2 => {
            let count = 60.min(cuts.len() / 4);
            let (start, last) = (before_up(count)?, before_up(count + 1)?);
            drop(lines.drain(start..up));
            ("open-loop", last + 1)
        }
        // The overlap cut short: the last move in contact of the first seam is missing.
        3 => {
            let (start, last) = (before_up(0)?, before_up(1)?);
            drop(lines.drain(start..up));
            ("missing-overlap", last + 1)
        }
        // The heat removed: every move on the fabric is cold, first the one that goes down to it.
        4 => {
            drop(lines.drain(heat..=heat));
            let down = lines.iter().position(|line| line.starts_with("G1 ") && line.contains("Z-"))?;
            ("cold-seal", down + 1)
        }
        // The dwell's unit wrong: the stroke before it is too fast or too slow.
        5 => {
            let dwell = *dwells.get(pick(dwells.len().max(1), share))?;
            let p: f64 = lines[dwell][4..].parse().ok()?;
            lines[dwell] = format!("G4 P{}", if p > 100.0 { p / 1000.0 } else { p * 1000.0 });
            ("wrong-feed", dwell)
        }
        // A line too long.
        6 => {
            lines[cut].push_str(&[" ;", &"x".repeat(300)].concat());
            ("line-too-long", cut + 1)
        }
        // A comment that closes early.
        7 => {
            lines[cut] += " ; note) G0 Z0";
            ("bad-character", cut + 1)
        }
        // A move outside of the work, and back.
        8 => {
            lines.insert(cut, "G1 X1 Y1".to_owned());
            ("deviation", cut + 1)
        }
        // The iron at rest on the fabric.
        9 => {
            let seconds = dwells.is_empty() && !text.contains("M109");
            lines.insert(cut, if seconds { "G4 P3" } else { "G4 P4000" }.to_owned());
            ("iron-at-rest", cut + 1)
        }
        // A pause on the fabric: Klipper has no such word, and RepRapFirmware ends the job there.
        10 => {
            lines.insert(cut, "M0".to_owned());
            match dialect {
                "klipper" => ("unknown-word", cut + 1),
                "reprapfirmware" => ("after-end", cut + 2),
                _ => ("iron-at-rest", cut + 1),
            }
        }
        // A word that no controller has.
        11 => {
            lines.insert(cut, "M7".to_owned());
            ("unknown-word", cut + 1)
        }
        // Cooled during the job.
        12 => {
            lines.insert(cut, "M104 S0".to_owned());
            (if text.contains("M109") { "stray-heat" } else { "unknown-word" }, cut + 1)
        }
        _ => return None,
    };
    Some(Seeded { text: recounted(&lines), code, line })
}

/// Whether one of the findings names the fault by its code and its line.
fn is_named(fault: &Seeded, findings: &[Finding]) -> bool {
    findings.iter().any(|finding| {
        finding.file.starts_with("star-1-seal.")
            && finding.code == fault.code
            && finding.line == Some(fault.line)
    })
}

/// The code and the line of each finding, so that a failure can be read.
fn codes_and_lines(findings: &[Finding]) -> Vec<(&str, Option<usize>)> {
    findings.iter().take(8).map(|finding| (finding.code, finding.line)).collect()
}

#[test]
fn every_kind_of_fault_is_named_with_its_line_in_every_dialect() {
    let mut missed = Vec::new();
    for name in PROFILES {
        let machine_build = star(name);
        let good = text(&machine_build, FILE);
        assert_eq!(findings_with(&machine_build, FILE, &good), [], "{name}");
        for kind in 0..13 {
            for at in [0.0, 0.3, 0.77] {
                let Some(bad) = seeded(kind, at, &good) else { continue };
                let findings = findings_with(&machine_build, FILE, &bad.text);
                if !is_named(&bad, &findings) {
                    let summary = codes_and_lines(&findings);
                    missed
                        .push(format!("{name}: fault {kind}, no {} in {}: {summary:?}", bad.code, bad.line));
                }
            }
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn a_fault_anywhere_is_found(profile in 0..PROFILES.len(), kind in 0..13_usize, share in 0.0..1.0_f64) {
        let machine_build = star(PROFILES[profile]);
        if let Some(bad) = seeded(kind, share, &text(&machine_build, FILE)) {
            let findings = findings_with(&machine_build, FILE, &bad.text);
            prop_assert!(is_named(&bad, &findings), "{} {kind} {share}: {:?}", PROFILES[profile], codes_and_lines(&findings));
        }
    }

    #[test]
    fn a_file_cut_at_any_byte_is_found(profile in 0..PROFILES.len(), share in 0.0..1.0_f64) {
        let machine_build = star(PROFILES[profile]);
        let good = text(&machine_build, FILE);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "small")]
        let end = (share * good.len() as f64) as usize;
        let findings = findings_with(&machine_build, FILE, &good[..end]);
        prop_assert!(findings.iter().any(|f| f.code == "truncated" && f.file.starts_with("star-1-seal.")), "cut at {end}: {:?}", codes_and_lines(&findings));
    }

    #[test]
    fn a_name_never_becomes_a_command(profile in 0..PROFILES.len(), name in "[ -~\u{e9}\u{661f}]{1,80}|.{0,20}[);(!~?%$;] ?(M104 S300|G0 Z-9|PAUSE|M2).{0,10}") {
        let escaped = name.replace('\\', "\\\\").replace('"', "\\\"");
        let machine = crate::profile(PROFILES[profile]);
        let plain = star_text(PROFILES[profile]);
        let named = plain.replace("name = \"small\"", &format!("name = \"{escaped}\""));
        prop_assume!(stargrip_cam::spec::check_name(&name).is_ok());
        let commands = |spec: &str| {
            let code = text(&built(spec, machine), FILE);
            code.lines().filter(|line| !line.starts_with(';')).map(str::to_owned).collect::<Vec<_>>()
        };
        prop_assert_eq!(commands(&named), commands(&plain));
        prop_assert_eq!(findings_with(&built(&named, machine), FILE, &text(&built(&named, machine), FILE)), []);
    }
}
