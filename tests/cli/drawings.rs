//! Drawings at the terminal: units, notes, warnings in JSON and in pictures, long lists.

use crate::support::program::{run, stderr, stdout};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// A notch with two sharp corners 8 mm apart in a cushion, whose figures have no unit.
pub(super) const NOTCH: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"160\" height=\"100\" viewBox=\"0 0 160 100\"><g id=\"air\">\
    <path id=\"n\" d=\"M 5 5 H 155 V 95 H 90 V 65 H 82 V 95 H 5 Z\"/></g><g id=\"port\"><path d=\"M 2 50 H 8\"/></g>\
    <g id=\"off\" display=\"none\"><path d=\"M 0 0 H 9\"/></g></svg>";

pub(super) fn folder(drawing: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("d.svg"), drawing).expect("written");
    folder
}

pub(super) fn json(dir: &Path, args: &[&str]) -> Value {
    serde_json::from_str(&stdout(&run(dir, args))).expect("JSON")
}

#[test]
fn new_takes_a_unit() {
    let folder = folder(NOTCH);
    let dir = folder.path();
    let output = run(dir, &["new", "a", "--drawing", "d.svg", "--units", "cm"]);
    let said = stdout(&output);
    assert!(
        said.contains("the figures with a role are 1530 x 900 mm") && !said.contains("assumed"),
        "{said}"
    );
    assert!(said.contains("\"off\" is hidden in the drawing and not read"), "{said}");
    assert!(fs::read_to_string(dir.join("a.toml")).expect("a spec").contains("\nunits = \"cm\"\n"));
    let sized = NOTCH.replace("\"160\"", "\"160mm\"").replace("\"100\"", "\"100mm\"");
    fs::write(dir.join("sized.svg"), sized).expect("written");
    let _ = run(dir, &["new", "d", "--drawing", "sized.svg"]);
    assert!(fs::read_to_string(dir.join("d.toml")).expect("a spec").contains("\n## units = \"mm\" "));
    let output = run(dir, &["new", "b", "--drawing", "d.svg", "--units", "furlong"]);
    assert!(stderr(&output).contains("units are um, mm, cm"), "{}", stderr(&output));
    let output = run(dir, &["new", "c", "--units", "cm"]);
    assert!(stderr(&output).contains("--drawing"), "{}", stderr(&output));
}

/// The channel of a hose is as wide as the hose needs, however long.
#[test]
fn a_long_channel_is_no_narrow_passage() {
    let cushion = NOTCH.replace(" V 95 H 90 V 65 H 82 V 95 H 5", " V 95 H 5");
    let folder = folder(&cushion);
    let dir = folder.path();
    let _ = run(dir, &["new", "a", "--drawing", "d.svg", "--units", "mm"]);
    let spec = fs::read_to_string(dir.join("a.toml")).expect("a spec");
    let wide = spec.replacen("[seal]\n", "[seal]\nallowance = \"100 mm\"\n", 1);
    assert!(wide != spec);
    fs::write(dir.join("a.toml"), wide).expect("written");
    let output = run(dir, &["check", "a.toml"]);
    assert!(output.status.success() && !stderr(&output).contains("narrow-passage"), "{}", stderr(&output));
}

#[test]
fn a_build_without_its_drawing_lacks_that_file() {
    let folder = folder(NOTCH);
    let dir = folder.path();
    assert!(run(dir, &["new", "a", "--drawing", "d.svg", "--units", "mm"]).status.success());
    let built = run(dir, &["build", "a.toml", "-q", "-o", "out", "--only", "seal-svg"]);
    assert!(built.status.success(), "{}", stderr(&built));
    fs::remove_file(dir.join("out/drawing.svg")).expect("removed");
    let said = stdout(&run(dir, &["verify", "out", "-q"]));
    assert_eq!(said.lines().count(), 2, "{said}");
    assert!(said.starts_with("drawing.svg: missing-file: found no such file"), "{said}");
}

/// Nobody writes to the pipe: reading it would wait for ever.
#[cfg(unix)]
#[test]
fn a_pipe_is_no_drawing() {
    let folder = folder(NOTCH);
    let dir = folder.path();
    assert!(run(dir, &["new", "a", "--drawing", "d.svg", "--units", "mm"]).status.success());
    fs::remove_file(dir.join("d.svg")).expect("removed");
    let made = std::process::Command::new("mkfifo").arg(dir.join("d.svg")).status().expect("mkfifo");
    assert!(made.success());
    for args in [&["check", "a.toml"][..], &["new", "b", "--drawing", "d.svg"]] {
        let output = run(dir, args);
        assert_eq!(output.status.code(), Some(1));
        let said = stderr(&output);
        assert!(said.contains("d.svg: it is a pipe, a socket or a device; name a file"), "{said}");
    }
}

/// The drawing's own name is that of the design, in any script; a drawing is not taken for the name of a star.
#[test]
fn new_keeps_the_name_of_the_drawing() {
    let folder = folder(NOTCH);
    let dir = folder.path();
    for name in ["hoseA", "k_2", "\u{56fe}\u{7eb8}", "\u{447}\u{435}\u{440}\u{442}\u{435}\u{436}"] {
        let _ = fs::copy(dir.join("d.svg"), dir.join(format!("{name}.svg"))).expect("copied");
        let output = run(dir, &["new", "--drawing", &format!("{name}.svg")]);
        assert!(stdout(&output).contains(&format!("wrote {name}.toml,")), "{}", stderr(&output));
        let output = run(dir, &["check", "-q", &format!("{name}.toml")]);
        assert!(output.status.success(), "{}", stderr(&output));
    }
    for name in ["hand-rest.svg", "a.DXF"] {
        let output = run(dir, &["new", name]);
        assert_eq!(output.status.code(), Some(1));
        assert!(stderr(&output).contains(&format!("new --drawing {name}")), "{}", stderr(&output));
    }
    assert!(!dir.join("hand-rest.svg.toml").exists());
}

/// The size is that of figures with a role, and a question follows where it is unusual.
#[test]
fn new_tells_the_size_of_what_is_sealed() {
    let body = "<rect fill=\"#ffffff\" width=\"450\" height=\"450\"/><rect fill=\"#d9d9d9\" x=\"50\" y=\"50\" width=\"300\" height=\"225\"/>\
        <path stroke=\"#f00\" fill=\"none\" d=\"M40 150H60\"/></svg>";
    let folder = folder(&format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"500\" height=\"500\" viewBox=\"0 0 500 500\">{body}"
    ));
    let dir = folder.path();
    let sized =
        |name: &str, unit: &str| stdout(&run(dir, &["new", name, "--drawing", "d.svg", "--units", unit]));
    let usual = sized("a", "mm");
    assert!(
        usual.contains("the figures with a role are 310 x 225 mm") && !usual.contains("right"),
        "{usual}"
    );
    assert!(sized("b", "m").contains("310 x 225 m: is the unit right"));
    assert!(sized("c", "um").contains("0.31 x 0.225 mm: is the unit right"));
    let notes = json(dir, &["check", "b.toml", "--json"])["drawing_notes"].to_string();
    assert!(notes.contains("is the unit right") || notes == "null", "{notes}");
    let guessed = stdout(&run(dir, &["new", "e", "--drawing", "d.svg"]));
    assert!(guessed.contains("the unit mm is assumed"), "{guessed}");
}

/// A pressure outside of the range of shells is refused with those that work, and the key that is missing has no default.
#[test]
fn a_pressure_without_a_shell_is_refused_with_those_that_have_one() {
    let folder = folder(NOTCH);
    let dir = folder.path();
    let spec = |load: &str| {
        let text = format!(
            "schema = 1\nname = \"a\"\n[drawing]\nfile = \"d.svg\"\nunits = \"mm\"\n[drawing.layers]\nair = [\"air\"]\n\
             port = [\"port\"]\n[inlet]\ntube_diameter = \"4 mm\"\n{load}"
        );
        fs::write(dir.join("a.toml"), text).expect("written");
    };
    spec("");
    let refused = json(dir, &["predict", "a.toml", "--json"])["refused"][0].clone();
    assert_eq!(refused["remedy"], Value::Null, "{refused}");
    assert!(refused["allowed"].as_str().is_some_and(|text| text.contains("`pressure`")), "{refused}");
    let output = run(dir, &["predict", "a.toml", "--model", "section"]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    for wrong in ["900 kPa", "0.000001 kPa", "0.001 Pa"] {
        spec(&format!("[load]\npressure = \"{wrong}\"\n"));
        let refused = json(dir, &["predict", "a.toml", "--json"])["refused"][0].clone();
        if refused["code"] == "out-of-range" {
            continue;
        }
        assert_eq!(refused["key"], "load.pressure", "{refused}");
        let allowed = refused["allowed"].as_str().expect("a remedy");
        let ends: Vec<&str> = allowed.split(' ').filter(|word| word.parse::<f64>().is_ok()).collect();
        assert_eq!(ends.len(), 2, "{allowed}");
        spec(&format!("[load]\npressure = \"{} kPa\"\n", ends[1]));
        let found = json(dir, &["predict", "a.toml", "--json"]);
        assert!(
            found["refused"][0]["found"].as_str().is_none_or(|text| !text.contains("covers no tube")),
            "{found}"
        );
    }
}

/// Every text about a seam of a shipped drawing calls it by the name that the manifest has.
#[test]
fn a_seam_has_one_name_in_all_texts() {
    let drawings = Path::new(env!("CARGO_MANIFEST_DIR")).join("designs/drawings");
    for name in ["hand-rest", "bending-finger", "letters", "pillow"] {
        let folder = tempfile::tempdir().expect("a folder");
        let dir = folder.path();
        let spec = drawings.join(format!("{name}.toml"));
        let spec = spec.to_str().expect("a path of this repository");
        let built = run(dir, &["build", spec, "-q", "-o", "out", "--with", "report"]);
        assert!(built.status.success(), "{}", stderr(&built));
        let [manifest, preview, report] = ["manifest.json", "sheet-1-preview.svg", "report.html"]
            .map(|name| fs::read_to_string(dir.join("out").join(name)).expect("a file of the build"));
        let manifest: Value = serde_json::from_str(&manifest).expect("JSON");
        let details = stdout(&run(dir, &["check", spec, "-v"]));
        for seam in manifest["pieces"][0]["seams"].as_array().expect("seams") {
            let seam = seam["name"].as_str().expect("a name");
            assert_eq!(details.matches(&format!("\n  {seam}: ")).count(), 1, "{seam} in {details}");
            assert_eq!(details.matches(&format!("\n    {seam}: ")).count(), 1, "{seam} in {details}");
            assert!(preview.contains(&format!(": {seam} of piece 1<")), "{name}: {seam}");
            assert!(report.contains(&format!("\"loop\":\"{seam}\"")), "{name}: {seam}");
        }
    }
}
