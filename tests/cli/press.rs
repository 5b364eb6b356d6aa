//! A heat press on the command line: plates that are too small, programs that it does not run, and its coupons.

use std::fs;
use std::path::Path;

use crate::support::program::{done, run, stderr};
use serde_json::Value;
use tempfile::TempDir;

const PRESSED: &str = include_str!("../../designs/press/pressed-star.toml");

/// A directory with the pressed star and `more` lines in [press].
fn workshop(more: &str) -> TempDir {
    let dir = tempfile::tempdir().expect("a directory");
    fs::write(dir.path().join("star.toml"), format!("{PRESSED}{more}")).expect("written");
    dir
}

/// The refusals of a command that fails.
#[track_caller]
fn refused(dir: &Path, args: &[&str]) -> Vec<Value> {
    let output = run(dir, args);
    assert_eq!(output.status.code(), Some(1), "{args:?}\n{}", stderr(&output));
    let answer: Value = serde_json::from_slice(&output.stdout).expect("one object");
    answer["refused"].as_array().cloned().unwrap_or_default()
}

#[test]
fn a_sheet_beyond_the_plates_is_refused_at_the_plates() {
    for (plates, sheet) in [
        ("120 mm x 380 mm", ""),
        ("380 mm x 120 mm", "turn = true\n"),
        ("380 mm x 380 mm", "width = \"600 mm\"\n"),
    ] {
        let dir = workshop(&format!("plates = \"{plates}\"\n"));
        let spec = fs::read_to_string(dir.path().join("star.toml")).expect("written");
        fs::write(dir.path().join("star.toml"), spec.replace("[sheet]\n", &format!("[sheet]\n{sheet}")))
            .expect("written");
        let refusals = refused(dir.path(), &["check", "star.toml", "--json"]);
        let places: Vec<_> = refusals.iter().map(|refusal| (&refusal["code"], &refusal["key"])).collect();
        assert_eq!(
            places,
            [(&"out-of-reach".into(), &"press.plates".into())],
            "{plates}, {sheet}: {refusals:?}"
        );
        // The size that the remedy names is enough.
        let remedy = refusals[0]["allowed"].as_str().expect("a remedy");
        let size = remedy.split("at least ").nth(1).and_then(|rest| rest.split(':').next()).expect("a size");
        let larger = spec.replace(
            &format!("plates = \"{plates}\""),
            &format!("plates = \"{}\"", size.replace(" x", " mm x")),
        );
        fs::write(dir.path().join("star.toml"), larger.replace("[sheet]\n", &format!("[sheet]\n{sheet}")))
            .expect("written");
        let _ = done(dir.path(), &["check", "star.toml", "-q"]);
    }
}

/// The warning about the force has the pressure that a smaller press reaches: force times it is the pressure of the spec.
#[test]
fn the_force_of_the_press_is_told_with_what_a_smaller_one_gives() {
    for (pressure, bar) in [("0.6 bar", 0.6), ("2 bar", 2.0)] {
        let dir = workshop("");
        let spec = fs::read_to_string(dir.path().join("star.toml")).expect("written");
        fs::write(dir.path().join("star.toml"), spec.replace("0.6 bar", pressure)).expect("written");
        let answer: Value =
            serde_json::from_str(&done(dir.path(), &["check", "star.toml", "--json"])).expect("JSON");
        let lines = answer["before_you_seal"].as_array().expect("a list");
        let text =
            lines.iter().filter_map(Value::as_str).find(|line| line.contains("each kN")).expect("a warning");
        let number_before = |unit: &str| {
            let words = text.split_once(unit).map_or("", |(before, _)| before);
            words
                .rsplit(' ')
                .next()
                .and_then(|word| word.parse::<f64>().ok())
                .unwrap_or_else(|| panic!("{unit}: {text}"))
        };
        let product = number_before(" kN (") * number_before(" bar there");
        assert!((product / bar - 1.0).abs() < 0.05, "{product}: {text}");
    }
}

#[test]
fn coupons_of_a_press_are_cards_that_verify_and_calibrate_read() {
    let dir = workshop("");
    let answer =
        done(dir.path(), &["coupon", "star.toml", "--temperatures", "140 C,150 C", "--times", "8 s,12 s"]);
    assert!(answer.contains("4 cards") && answer.contains("--press --spec star.toml"), "{answer}");
    let coupons = dir.path().join("coupons");
    assert_eq!(run(dir.path(), &["verify", "coupons"]).status.code(), Some(0));
    let table = fs::read_to_string(coupons.join("results.csv")).expect("written");
    assert_eq!(table.lines().count(), 13, "{table}");
    // Half a force more a card: the third setting is the first that holds.
    let tested = table.lines().skip(1).zip(0..).map(|(row, strip)| {
        let force = 20 * (1 + strip / 3) + strip % 3;
        row.replace(",,", &format!(",{force},"))
    });
    let rows: Vec<String> =
        std::iter::once(table.lines().next().unwrap_or_default().to_owned()).chain(tested).collect();
    fs::write(coupons.join("results.csv"), rows.join("\n")).expect("written");
    let printed = done(dir.path(), &["calibrate", "coupons/results.csv", "--press", "--needed", "1.5 N/mm"]);
    assert!(printed.contains("[press]\ntemperature = \"150 C\"\ntime = \"8 s\"\n"), "{printed}");
    fs::write(dir.path().join("measured.toml"), printed).expect("written");
    let _ = done(dir.path(), &["build", "star.toml", "-o", "made", "--fabric", "measured.toml", "-q"]);
    let spec = fs::read_to_string(dir.path().join("made/spec.toml")).expect("written");
    assert!(
        spec.contains("time = \"8 s\"") && spec.contains("paper = \"A3\"") && !spec.contains("speed"),
        "{spec}"
    );
    // A wrong drawing is found.
    let drawing = fs::read_to_string(coupons.join("paper.svg")).expect("written");
    fs::write(coupons.join("paper.svg"), format!("{drawing} ")).expect("written");
    assert_eq!(run(dir.path(), &["verify", "coupons"]).status.code(), Some(1));
}

#[test]
fn what_a_press_does_not_have_is_refused() {
    let dir = workshop("");
    for kind in ["seal-gcode", "trace-gcode"] {
        let codes: Vec<Value> = refused(dir.path(), &["build", "star.toml", "--only", kind, "--json"])
            .iter()
            .map(|refusal| refusal["code"].clone())
            .collect();
        assert_eq!(codes, ["no-programs"], "{kind}");
    }
    for (args, code) in [
        (&["--only", "disc"][..], 1),
        (&["--speeds", "1 mm/s"], 2),
        (&["--heights", "0 mm"], 2),
        (&["--times", "8 s,8 s"], 1),
        (&["--times", "1 h"], 2),
        (&["--times", "8 s", "--speeds", "1 mm/s"], 2),
    ] {
        let output = run(dir.path(), &[&["coupon", "star.toml"], args].concat());
        assert_eq!(output.status.code(), Some(code), "{args:?}: {}", stderr(&output));
    }
    fs::write(dir.path().join("iron.toml"), crate::support::PAPER).expect("written");
    let output = run(dir.path(), &["coupon", "iron.toml", "--times", "8 s"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(!dir.path().join("coupons").exists());
}
