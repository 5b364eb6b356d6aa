//! `optimize` as a user runs it: specs that keep what they promise, refusals, layouts.

use crate::mechanics::{folder, run, text};
use crate::support::inputs::GRIPPER;
use std::fs;

#[test]
fn optimize_ends_in_a_spec_that_keeps_its_promise() {
    let dir = folder();
    let mut args =
        vec!["optimize", "spec.toml", "--payload", "0.3", "--grasp", "24 mm..40 mm", "--points", "4..7"];
    args.extend([
        "--tip-radius",
        "2 mm",
        "--corner-radius",
        "2 mm",
        "--pressure",
        "15 kPa..45 kPa",
        "--count",
        "1..6",
    ]);
    let output = run(dir.path(), &args);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    fs::write(dir.path().join("best.toml"), &output.stdout).expect("written");
    assert_eq!(run(dir.path(), &["check", "best.toml"]).status.code(), Some(0));
    let predicted = run(dir.path(), &["predict", "best.toml", "--json"]);
    let value: serde_json::Value = serde_json::from_slice(&predicted.stdout).expect("JSON");
    // All constraints are met at the bad end of the ranges.
    let payload = value["ranges"]["payload_kg"][0].as_f64();
    assert!(payload >= Some(0.3) && value["ranges"]["final_radius_mm"][1].as_f64() <= Some(24.0), "{value}");
    assert!(value["graspable_radius_mm"][1].as_f64() >= Some(40.0), "{value}");
    assert!(value["burst_margin"].as_f64() >= Some(1.5), "{value}");
    let impossible = run(dir.path(), &["optimize", "spec.toml", "--payload", "1000", "--points", "5"]);
    assert_eq!(impossible.status.code(), Some(1));
    assert!(text(&impossible.stderr).contains("no design meets"));
}

/// Options that go beyond `[load]` are written into it.
#[test]
fn optimize_writes_the_load_that_it_was_asked_for() {
    let dir = folder();
    let spec = format!("{GRIPPER}mass = \"5 kg\"\nlargest_force = \"8 N\"\n");
    fs::write(dir.path().join("spec.toml"), spec).expect("written");
    let args = [
        "optimize",
        "spec.toml",
        "--points",
        "5",
        "--payload",
        "0.2 kg",
        "--largest-force",
        "60 N",
        "--burst-margin",
        "1",
    ];
    let output = run(dir.path(), &args);
    let best = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    for line in ["mass = \"0.2 kg\"  # was 5 kg", "largest_force = \"60 N\"  # was 8 N"] {
        assert!(best.contains(line), "{line}: {best}");
    }
    fs::write(dir.path().join("best.toml"), &best).expect("written");
    assert_eq!(run(dir.path(), &["check", "best.toml"]).status.code(), Some(0));
}

/// A search designs equal stars.
#[test]
fn a_search_around_stars_that_differ_is_refused() {
    let dir = folder();
    let spec = format!("{GRIPPER}[[stack.star]]\nindex = 2\ninner_radius = \"55 mm\"\n");
    fs::write(dir.path().join("spec.toml"), spec).expect("written");
    let output = run(dir.path(), &["optimize", "spec.toml", "--points", "5"]);
    assert_eq!((output.status.code(), text(&output.stdout).as_str()), (Some(1), ""));
    assert!(text(&output.stderr).contains("star 2 has its own `inner_radius`"), "{}", text(&output.stderr));
}

#[test]
fn a_search_tells_which_model_it_takes_in_place_of_a_slow_one() {
    let dir = folder();
    for (model, told) in [("bvp", true), ("shell", true), ("section", false), ("fit", false)] {
        fs::write(dir.path().join("spec.toml"), format!("{GRIPPER}[accuracy]\nmodel = \"{model}\"\n"))
            .expect("written");
        let output = run(dir.path(), &["optimize", "spec.toml", "--points", "5", "--payload", "0.1"]);
        let said = text(&output.stdout) + &text(&output.stderr);
        assert_eq!(said.contains("searches compute with section"), told, "{model}: {said}");
        assert_eq!(said.contains("has no ranges"), model == "fit", "{model}: {said}");
        // A limit has no ranges, and no part of their ends is taken.
        assert_eq!(said.contains("a payload's lower end"), model != "fit", "{model}: {said}");
    }
}

#[test]
fn numbers_without_sense_are_wrong_usage() {
    let dir = folder();
    let optimize = ["optimize", "spec.toml"];
    for (command, option, values, words) in [
        (&optimize[..], "--payload", &["nan", "inf", "-inf", "0", "-1", "-1 kg"][..], "must be more than 0"),
        (&optimize, "--payload", &["x", "", "1 N"], "write the mass as a number and one of kg"),
        (&optimize, "--payload", &["0,8"], "write \"0.8\""),
        (&optimize, "--burst-margin", &["nan", "inf", "0", "-1"], "must be more than 0"),
        (
            &optimize,
            "--tip-angle",
            &["0 deg..90 deg", "10 deg..180 deg"],
            "the angle must be more than 0 deg",
        ),
        (&optimize, "--tube-width", &["-1 mm..5 mm", "0 mm..5 mm"], "the length must be at least 0.001 mm"),
        (&optimize, "--tip-radius", &["-1 mm..5 mm"], "the length must be at least 0 mm"),
        (
            &optimize,
            "--corner-radius",
            &["nan mm..5 mm", "5..6"],
            "write the length as a number and one of mm",
        ),
        (&optimize, "--grasp", &["5 mm..4 mm"], "the range is descending; write \"4 mm..5 mm\""),
    ] {
        for value in values {
            let output = run(dir.path(), &[command, &[&format!("{option}={value}")]].concat());
            let said = text(&output.stderr);
            assert_eq!(output.status.code(), Some(2), "{option}={value}: {said}");
            assert!(said.contains(option) && said.contains(words), "{option}={value}: {said}");
        }
    }
}

/// `optimize` can write into every layout that `check` accepts; other layouts are refused before the search.
#[test]
fn optimize_writes_into_every_layout() {
    let dir = folder();
    let keys = [
        ("points", "5"),
        ("inner_radius", "\"50 mm\""),
        ("tube_width", "\"30 mm\""),
        ("tip_angle", "\"30 deg\""),
    ];
    let join = |gap: &str, each: &dyn Fn(&str, &str) -> String| {
        keys.iter().map(|(key, value)| each(key, value)).collect::<Vec<_>>().join(gap)
    };
    let layouts = [
        join("\n", &|key, value| format!("star.{key} = {value}")),
        format!("[ star ] # mine\n{}", join("\n", &|key, value| format!("{key} = {value}"))),
        format!("star = {{ {} }}", join(", ", &|key, value| format!("{key} = {value}"))),
        format!("[\"star\"]\n{}", join("\n", &|key, value| format!("\"{key}\" = {value}"))),
    ];
    let args = [
        "optimize",
        "spec.toml",
        "--points",
        "4",
        "--tube-width",
        "25 mm",
        "--tip-angle",
        "40 deg..50 deg",
        "--pressure",
        "20 kPa",
    ];
    for layout in layouts {
        fs::write(dir.path().join("spec.toml"), format!("schema = 1\nname = \"x\"\n{layout}\n"))
            .expect("written");
        let output = run(dir.path(), &args);
        assert_eq!(output.status.code(), Some(0), "{layout}\n{}", text(&output.stderr));
        fs::write(dir.path().join("best.toml"), &output.stdout).expect("written");
        let source = stargrip_cam::spec::Source::new("best.toml", text(&output.stdout));
        let star = stargrip_cam::spec::read(&source).expect("valid").spec.stars[0].clone();
        assert_eq!((star.points, star.tube_width.0), (4, 25.0), "{layout}");
        assert_eq!(run(dir.path(), &["check", "best.toml"]).status.code(), Some(0), "{layout}");
    }
    let own = format!("{GRIPPER}[[stack.star]]\nindex = 1\ntube_width = \"25 mm\"\n");
    fs::write(dir.path().join("spec.toml"), own).expect("written");
    let output = run(dir.path(), &args);
    let said = text(&output.stderr);
    assert_eq!((output.status.code(), text(&output.stdout).as_str()), (Some(1), ""));
    assert!(said.contains("error[own-value]") && said.contains("spec.toml:21:14"), "{said}");
    assert!(!said.contains("designs computed"), "{said}");
}

/// The object of the search must fit into the star when it is inflated, not only when it is flat.
#[test]
fn optimize_opens_as_far_as_it_promises() {
    let dir = folder();
    let args = [
        "optimize",
        "spec.toml",
        "--grasp",
        "35 mm..42 mm",
        "--points",
        "8",
        "--goal",
        "fabric",
        "--burst-margin",
        "0.1",
    ];
    let output = run(dir.path(), &args);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    fs::write(dir.path().join("best.toml"), &output.stdout).expect("written");
    let predicted = run(dir.path(), &["predict", "best.toml", "--json"]);
    let value: serde_json::Value = serde_json::from_slice(&predicted.stdout).expect("JSON");
    let range = &value["graspable_radius_mm"];
    assert!(range[0].as_f64() <= Some(35.0) && range[1].as_f64() >= Some(42.0), "{range}");
}
