//! Misspelt words, unknown sections, and files that are absent or of another kind.

use crate::diagnostics::star;
use crate::support;
use crate::support::program::{run, stderr, stdout};
use std::fs;

/// The output of the program for `spec`, which it refuses.
#[track_caller]
pub(super) fn refused(spec: &str) -> String {
    let dir = tempfile::tempdir().expect("a directory");
    fs::write(dir.path().join("spec.toml"), spec).expect("written");
    let output = run(dir.path(), &["check", "spec.toml"]);
    assert_eq!(output.status.code(), Some(1), "{}", stdout(&output));
    stderr(&output)
}

#[test]
fn a_word_that_is_nearly_right_is_told_what_it_should_be() {
    let plain = star(5, "50 mm", "30 mm", "30 deg", "");
    let with = |old: &str, new: &str| plain.replace(old, new);
    for (spec, words) in [
        (with("\"50 mm\"", "\"50,5 mm\""), "write inner_radius = \"50.5 mm\""),
        (with("\"50 mm\"", "\"\u{2212}50 mm\""), "U+2212, a typographic minus sign"),
        (with("\"50 mm\"", "\u{201c}50 mm\u{201d}"), "error[syntax]: string values must be quoted"),
        (with("\"50 mm\"", "'2\"'"), "did you mean \"2 in\"?"),
        (with("\"50 mm\"", "\"2 inches\""), "did you mean \"2 in\"?"),
        (with("\"50 mm\"", "nan"), "write for instance: inner_radius = \"5 mm\""),
        (with("\"30 deg\"", "\"30\u{b0}\""), "did you mean \"30 deg\"?"),
        (plain.clone() + "[seal]\ntemperature = \"390 F\"\n", "did you mean \"199 C\"?"),
        (plain.clone() + "[load]\nfriction = 0,5\n", "error[syntax]"),
        (plain.clone() + "[machine]\nprofile = \"GRBL\"\n", "did you mean \"grbl\"?"),
        (plain.clone() + "points = 6\n", "error[syntax]: duplicate key"),
        (
            with("\"50 mm\"", "\"1,000 mm\""),
            "\"1000 mm\" if the comma separates thousands, else \"1.000 mm\"",
        ),
        (with("\"50 mm\"", "\"1,000.5 mm\""), "write inner_radius = \"1000.5 mm\""),
        (plain.clone() + "[mask]\nbed = \"220x220\"\n", "bed = \"220 mm x 220 mm\""),
        (plain.clone() + "[mask]\nbed = \"8 in x 10\"\n", "bed = \"8 in x 10 mm\""),
        (with("points = 5", "points = "), "error[syntax]"),
        (with("points = 5", "points: 5"), "error[syntax]: invalid unquoted key"),
        (with("[star]", "[[star]]"), "must be a section, [star]"),
        (with("[star]", "[star"), "expected `]`"),
        (plain.clone() + "[star]\n", "error[syntax]: duplicate key"),
        (plain.clone() + "[stak]\ncount = 2\n", "did you mean [stack]?"),
        (plain.clone() + "[[stack.star]]\nindex = 2\npitch = \"40 mm\"\n", "write count = 2 in [stack]"),
        (plain.clone() + "[machine]\nprofile = \".\"\n", "is a directory"),
    ] {
        let said = refused(&spec);
        assert!(said.contains(words), "{words}: {said}");
        assert_eq!(said.matches("error[").count(), 1, "{said}");
    }
}

/// Equal stars have one message, and remedies exist.
#[test]
fn a_refusal_of_several_stars_is_one_and_its_remedy_can_be_had() {
    let plain = star(5, "50 mm", "30 mm", "30 deg", "");
    let stack = |rest: &str| format!("{plain}[stack]\ncount = 3\n{rest}");
    let load = "[load]\nobject_diameter = \"60 mm\"\npressure = ";
    for (spec, words) in [
        (stack("[[stack.star]]\nindex = 2\ninlet_tip = 2\n[mask]\nbed = \"120 x 120 mm\"\n"), "small-bed"),
        (stack(&format!("{load}\"5 MPa\"\n")), "stars 1, 2, 3: no model covers this star"),
        (
            format!("{plain}{load}\"37 kPa\"\nfriction = 0.1\nfriction_most = 0.15\nmass = \"0.6 kg\"\n"),
            ", friction_most too",
        ),
    ] {
        let said = refused(&spec);
        assert!(said.contains(words) && said.matches("error[").count() == 1, "{words}: {said}");
    }
    let own = stack("[[stack.star]]\nindex = 2\ninner_radius = \"60 mm\"\n[load]\npressure = \"37 kPa\"\n");
    let dir = tempfile::tempdir().expect("a directory");
    fs::write(dir.path().join("spec.toml"), own).expect("written");
    let said = stdout(&run(dir.path(), &["check", "spec.toml"]));
    assert!(said.contains("stars 1, 3: to") && said.contains("; star 2: to"), "{said}");
    // With the radius that would hold, the star has no arms.
    let said = refused(&format!("{plain}[fabric]\nseal_strength = \"1 N/mm\"\n{load}\"37 kPa\"\n"));
    assert!(said.contains("[bursts]") && !said.contains("tip_radius"), "{said}");
}

#[test]
fn unknown_sections_are_listed_in_order_and_all_counted() {
    let sections: Vec<String> = (0..300).map(|i| format!("[x{i}]\n")).collect();
    let said = refused(&star(5, "50 mm", "30 mm", "30 deg", &sections.concat()));
    let at = |line: usize| said.find(&format!("spec.toml:{line}:"));
    assert!(at(8).is_some() && at(37).is_some() && at(38).is_none(), "{said}");
    assert!(said.contains("300 errors, the first 30 shown"), "{said}");
}

#[test]
fn a_file_that_is_not_there_is_named() {
    let dir = tempfile::tempdir().expect("a directory");
    let json = stdout(&run(dir.path(), &["check", "nope.toml", "--json"]));
    assert!(json.contains("\"file\": \"nope.toml\""), "{json}");
    let study = "schema = 1\nspec = \"nope.toml\"\n[vary]\nstar.points = [4, 5]\n";
    fs::write(dir.path().join("study.toml"), study).expect("written");
    let said = stderr(&run(dir.path(), &["study", "run", "study.toml"]));
    assert!(said.contains("`spec` in study.toml names nope.toml"), "{said}");
    fs::write(dir.path().join("empty.svg"), "").expect("written");
    let said = stderr(&run(dir.path(), &["new", "--drawing", "empty.svg"]));
    assert!(said.contains("is empty") && !said.contains("drawing.file"), "{said}");
}

#[test]
fn a_typo_is_told_once() {
    let plain = star(5, "50 mm", "30 mm", "30 deg", "");
    for (old, new) in [("tube_width", "tube_widht"), ("[star]", "[sta]"), ("name =", "nmae =")] {
        let said = refused(&plain.replace(old, new));
        assert_eq!(said.matches("error[").count(), 1, "{said}");
        assert!(said.contains("did you mean"), "{said}");
    }
    // Missing keys are reported as well.
    let two = plain.replace("tube_width", "tube_widht").replace("points = 5\n", "");
    let said = refused(&two);
    assert!(said.matches("error[").count() == 2 && said.contains("has no `points`\n"), "{said}");
}

#[test]
fn a_file_of_another_kind_is_named_in_one_message() {
    let dir = tempfile::tempdir().expect("a directory");
    fs::write(dir.path().join("star.toml"), support::PAPER).expect("written");
    assert_eq!(run(dir.path(), &["build", "star.toml", "-q"]).status.code(), Some(0));
    for (file, kind) in [
        ("star-1-seal.gcode", "G-code"),
        ("manifest.json", "JSON"),
        ("sheet-1-seal.svg", "SVG"),
        ("sheet-1-seal.dxf", "DXF"),
    ] {
        let output = run(dir.path(), &["check", &format!("out/star/{file}")]);
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(1));
        assert!(
            ["error[not-a-spec]", kind, "`stargrip-cam new"].iter().all(|words| said.contains(words))
                && said.lines().count() < 10,
            "{said}"
        );
    }
    let said = refused(&support::PAPER.replace('\n', "\r"));
    assert!(said.contains("error[line-end]") && said.matches("error[").count() == 1, "{said}");
    // For the directory above a build the message names the build.
    let above = run(dir.path(), &["verify", "out"]);
    assert!(
        stderr(&above).contains("stargrip-cam verify out/star\n") && stdout(&above).is_empty(),
        "{}",
        stderr(&above)
    );
}
