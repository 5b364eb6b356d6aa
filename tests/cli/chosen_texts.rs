//! The words of a chosen gripper: units, assumptions, warnings, comments.

use crate::choosing::{folder, run, text};
use serde_json::Value;
use std::fs;

/// Units are those of the request, in the spec and in what is offered.
#[test]
fn units_are_kept() {
    let dir = folder();
    let wish =
        ["new", "wish", "--object", "3 in", "--mass", "6 oz", "--pressure", "7 psi", "--fragile", "9000 mN"];
    let output = run(dir.path(), &[&wish[..], &["--friction", "0.6"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("; 7 psi; "), "{}", text(&output.stdout));
    let spec = fs::read_to_string(dir.path().join("wish.toml")).expect("written");
    for value in ["\"3 in\"", "\"6 oz\"", "\"7 psi\"", "\"9000 mN\""] {
        assert!(spec.contains(value), "{value}: {spec}");
    }
    let verdict = text(&run(dir.path(), &["check", "wish.toml"]).stdout);
    assert!(verdict.contains(" at 48.3 kPa"), "{verdict}");
    let heavy = ["new", "heavy", "--object", "3 in", "--mass", "600 oz", "--pressure", "7 psi"];
    let said = text(&run(dir.path(), &heavy).stderr);
    assert!(said.contains(" oz of the 600 oz") && said.contains(" oz\" --pressure \"7 psi\""), "{said}");
}

/// `--fabric` takes what `calibrate` prints.
#[test]
fn a_fabric_alone_is_a_fabric() {
    let dir = folder();
    let fabric = "[fabric]\nthickness = \"0.25 mm\"\nseal_strength = \"3 N/mm\"\n";
    let with = |more: &str| {
        fs::write(dir.path().join("fabric.toml"), format!("{fabric}{more}")).expect("written");
        run(dir.path(), &["new", "wish", "--object", "70 mm", "--mass", "300 g", "--fabric", "fabric.toml"])
    };
    let output = with("[seal]\ntemperature = \"190 C\"\n");
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let spec = fs::read_to_string(dir.path().join("wish.toml")).expect("written");
    assert!(
        spec.contains("thickness = \"0.25 mm\"") && spec.contains("seal_strength = \"3 N/mm\""),
        "{spec}"
    );
    let wrong = text(&with("thicknes = \"1 mm\"\n").stderr);
    assert!(wrong.contains("unknown-key") && !wrong.contains("schema"), "{wrong}");
}

/// A default friction is named as an assumption; `check` accepts the spec without warnings; the schema is named.
#[test]
fn the_answer_says_what_was_chosen_and_what_was_assumed() {
    let dir = folder();
    let wish = ["new", "f0.2", "--object", "75 mm", "--mass", "300 g", "--sheet", "A3"];
    let output = run(dir.path(), &wish);
    let said = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let chosen = said.lines().find(|line| line.starts_with("1 star of ")).expect("a line of the star");
    for words in [
        " points, tube ",
        " mm wide, ",
        " mm of fabric; ",
        " kPa; ",
        " min of sealing; ",
        "friction 0.3 assumed: change `friction` in [load]",
    ] {
        assert!(chosen.contains(words), "{words}: {said}");
    }
    assert!(said.contains("wrote f0.2.toml, and beside it stargrip-cam.schema.json for editors"), "{said}");
    let spec = fs::read_to_string(dir.path().join("f0.2.toml")).expect("written");
    assert!(spec.contains("friction_least = 0.2 ") && spec.contains("friction_most = 0.42 "), "{spec}");
    assert!(spec.contains("friction = 0.3 ") && spec.contains("width = \"420 mm\""), "{spec}");
    // The same friction, if it is given, has no range.
    let given =
        run(dir.path(), &["new", "given", "--object", "75 mm", "--mass", "300 g", "--friction", "0.3"]);
    assert_eq!(given.status.code(), Some(0), "{}", text(&given.stderr));
    assert!(!fs::read_to_string(dir.path().join("given.toml")).expect("written").contains("friction_least"));
    let check = run(dir.path(), &["check", "f0.2.toml"]);
    let answer_text = text(&check.stderr);
    assert!(check.status.code() == Some(0) && !answer_text.contains("warning["), "{answer_text}");
    assert!(!answer_text.contains("may be off by"), "{answer_text}");

    let again = folder();
    let output = run(again.path(), &[&wish[..], &["--friction", "0.5", "--json"]].concat());
    let json: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(
        (&json["chosen"]["friction"], &json["chosen"]["friction_assumed"]),
        (&0.5.into(), &false.into())
    );
    assert!(json["chosen"]["sealing_time_s"].as_f64() > Some(600.0), "{json}");
    assert!(fs::read_to_string(again.path().join("f0.2.toml")).is_ok_and(|spec| !spec.contains("measured")));
}

/// Coating windows that are shorter than the default are accepted by the spec itself.
#[test]
fn a_spec_that_is_new_is_not_warned_of() {
    for wish in [
        ["--object", "75 mm", "--mass", "1.2 kg", "--friction", "0.5"],
        ["--object", "30 mm", "--mass", "20 g", "--machine", "marlin"],
        ["--object", "16 mm", "--mass", "30 g", "--machine", "grbl"],
    ] {
        let dir = folder();
        let output = run(dir.path(), &[&["new", "wish"], &wish[..]].concat());
        assert_eq!(output.status.code(), Some(0), "{wish:?}: {}", text(&output.stderr));
        let answer_text = text(&run(dir.path(), &["check", "wish.toml"]).stderr);
        assert!(!answer_text.contains("warning["), "{wish:?}: {answer_text}");
    }
}

#[test]
fn what_has_another_unit_in_mind_is_asked() {
    for size in ["0.1 mm", "75 m"] {
        let dir = folder();
        let output = run(dir.path(), &["new", "wish", "--object", size, "--mass", "1 kg"]);
        let answer_text = text(&output.stderr);
        assert!(
            output.status.code() == Some(1) && answer_text.contains("is the unit right"),
            "{size}: {answer_text}"
        );
        // The pressure was free, so it is not the cause.
        assert!(!answer_text.contains("another pressure"), "{size}: {answer_text}");
    }
}

/// A search keeps the user's comments; comments with computed values are renewed or removed.
#[test]
fn no_comment_is_about_values_that_were_replaced() {
    let dir = folder();
    let wish = ["new", "wish", "--object", "75 mm", "--mass", "300 g"];
    assert_eq!(run(dir.path(), &wish).status.code(), Some(0));
    let path = dir.path().join("wish.toml");
    let spec = fs::read_to_string(&path).expect("written");
    let points = spec.lines().find(|line| line.starts_with("points = ")).expect("points");
    let number: u32 = points.split(' ').nth(2).and_then(|word| word.parse().ok()).expect("a number");
    let commented = |line: &str| match line.split_once(" = ") {
        Some(("tip_angle", _)) => line.split('#').next().unwrap_or_default().to_owned() + "# steep",
        Some(("tube_width", _)) => line.split('#').next().unwrap_or_default().trim_end().to_owned(),
        _ => line.to_owned(),
    };
    let own =
        spec.lines().map(commented).collect::<Vec<_>>().join("\n") + "\n[seal]\nband = \"2 mm\"  # mine\n";
    fs::write(&path, own).expect("written");
    let other = if number == 5 { "6" } else { "5" };
    let output = run(dir.path(), &["optimize", "wish.toml", "--points", other, "-q"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let found = text(&output.stdout);
    assert!(found.contains(&format!("# was {number}\n")) && found.contains("# mine"), "{found}");
    // A comment of the user stays before the old value; without one the old value is written, too.
    assert!(found.contains("# steep; was ") && found.contains(" mm\"  # was "), "{found}");
    for stale in
        ["least fabric (", "closes to", "presses with", "safe payload", "Designed for", "opens to", "t/W is"]
    {
        assert!(spec.contains(stale) && !found.contains(stale), "{stale}: {found}");
    }
}
