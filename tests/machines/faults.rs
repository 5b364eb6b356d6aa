//! Seeded faults: each is found, wherever it is put, in every dialect.

use proptest::prelude::*;
use stargrip_cam::pipeline::Built;

use crate::{PROFILES, built, findings_with, profile, spec_text, text};

const FILE: &str = "star-1-seal.gcode";

fn build(name: &str) -> Built {
    let chop = ["grbl", "grblhal", "fluidnc", "marlin"].contains(&name);
    let rest = if chop { "[machine]\nfeed_floor = \"chop\"\n" } else { "" };
    built(&spec_text(rest), profile(name))
}

/// The program with its last line counting right again.
fn counted(lines: &[String]) -> String {
    let mut text = String::new();
    for line in &lines[..lines.len() - 1] {
        text.push_str(line);
        text.push('\n');
    }
    text + &format!("; end of program, {} lines\n", lines.len())
}

/// Indices of the lines that cut in contact: feed moves in the plane without a height.
fn contact(lines: &[String]) -> Vec<usize> {
    let is_cut = |line: &str| ["G1 ", "G2 ", "G3 "].iter().any(|code| line.starts_with(code));
    (0..lines.len()).filter(|i| is_cut(&lines[*i]) && !lines[*i].contains('Z')).collect()
}

/// One fault at a place from 0 to 1; `None` if this program has no such thing.
fn seeded(kind: usize, at: f64, text: &str) -> Option<String> {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let pick = |n: usize| {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            clippy::cast_precision_loss,
            reason = "small"
        )]
        let i = (at * n as f64) as usize;
        i.min(n - 1)
    };
    let cuts = contact(&lines);
    let cut = cuts[pick(cuts.len())];
    let dwells: Vec<usize> = (0..lines.len()).filter(|i| lines[*i].starts_with("G4 P")).collect();
    let heat = (0..lines.len())
        .find(|i| lines[*i].starts_with("M109"))
        .or_else(|| (0..lines.len()).find(|i| lines[*i] == "; heat: temperature_C=200"))?;
    match kind {
        // The feed changed from here on.
        0 => {
            let line = lines[cut].split(" F").next().unwrap_or_default().to_owned();
            lines[cut] = line + " F30";
        }
        // An arc reversed.
        1 => {
            let arcs: Vec<usize> = cuts
                .iter()
                .copied()
                .filter(|i| lines[*i].starts_with("G2") || lines[*i].starts_with("G3"))
                .collect();
            let arc = *arcs.get(pick(arcs.len().max(1)))?;
            let turned = if lines[arc].starts_with("G2") { "G3" } else { "G2" };
            lines[arc].replace_range(..2, turned);
        }
        // A loop left open: moves before the first lift are gone.
        2 => {
            let up = (cuts[0]..lines.len()).find(|i| lines[*i].contains('Z'))?;
            let from = cuts.iter().copied().filter(|i| *i < up).rev().nth(60.min(cuts.len() / 4))?;
            drop(lines.drain(from..up));
        }
        // The overlap cut short: the last move in contact of the first seam is gone.
        3 => {
            let up = (cuts[0]..lines.len()).find(|i| lines[*i].contains('Z'))?;
            let last = cuts.iter().copied().rfind(|i| *i < up)?;
            drop(lines.drain(last..up));
        }
        // The heat removed.
        4 => drop(lines.drain(heat..=heat)),
        // The dwell's unit wrong.
        5 => {
            let dwell = *dwells.get(pick(dwells.len().max(1)))?;
            let p: f64 = lines[dwell][4..].parse().ok()?;
            lines[dwell] = format!("G4 P{}", if p > 100.0 { p / 1000.0 } else { p * 1000.0 });
        }
        // A line too long.
        6 => lines[cut].push_str(&[" ;", &"x".repeat(300)].concat()),
        // A comment that closes early.
        7 => lines[cut] += " ; note) G0 Z0",
        // A move to where nothing is, and back.
        8 => lines.insert(cut, "G1 X1 Y1".to_owned()),
        // The iron at rest on the fabric.
        9 => lines.insert(
            cut,
            if dwells.is_empty() && !text.contains("M109") { "G4 P3" } else { "G4 P4000" }.to_owned(),
        ),
        // A pause on the fabric.
        10 => lines.insert(cut, "M0".to_owned()),
        // A word that no controller knows.
        11 => lines.insert(cut, "M7".to_owned()),
        // Cooled on the way.
        12 => lines.insert(cut, "M104 S0".to_owned()),
        _ => return None,
    }
    Some(counted(&lines))
}

#[test]
fn every_kind_of_fault_is_found_in_every_dialect() {
    for name in PROFILES {
        let build = build(name);
        let good = text(&build, FILE);
        assert_eq!(findings_with(&build, FILE, &good), [], "{name}");
        for kind in 0..13 {
            for at in [0.0, 0.3, 0.77] {
                let Some(bad) = seeded(kind, at, &good) else { continue };
                assert!(!findings_with(&build, FILE, &bad).is_empty(), "{name}: fault {kind} at {at}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn a_fault_anywhere_is_found(profile in 0..8_usize, kind in 0..13_usize, at in 0.0..1.0_f64) {
        let build = build(PROFILES[profile]);
        if let Some(bad) = seeded(kind, at, &text(&build, FILE)) {
            prop_assert!(!findings_with(&build, FILE, &bad).is_empty(), "{} {kind} {at}", PROFILES[profile]);
        }
    }

    #[test]
    fn a_file_cut_at_any_byte_is_found(profile in 0..8_usize, at in 0.0..1.0_f64) {
        let build = build(PROFILES[profile]);
        let good = text(&build, FILE);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "small")]
        let end = (at * good.len() as f64) as usize;
        prop_assert!(!findings_with(&build, FILE, &good[..end]).is_empty());
    }

    #[test]
    fn a_name_never_becomes_a_command(profile in 0..8_usize, name in "[ -~\u{e9}\u{661f}]{1,80}|.{0,20}[);(!~?%$;] ?(M104 S300|G0 Z-9|PAUSE|M2).{0,10}") {
        let escaped = name.replace('\\', "\\\\").replace('"', "\\\"");
        let (machine, chop) = (crate::profile(PROFILES[profile]), ["grbl", "grblhal", "fluidnc", "marlin"]);
        let rest = if chop.contains(&PROFILES[profile]) { "[machine]\nfeed_floor = \"chop\"\n" } else { "" };
        let plain = spec_text(rest);
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
