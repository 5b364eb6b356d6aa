//! The pipeline as a user runs it: `check` and `build` refuse the same specs, in the same words, before any file is made.

use crate::support::program::{run, stderr, stdout};
use std::fs;

const PAPER: &str = include_str!("../../designs/paper-five-points.toml");

/// A folder with the paper's star on a machine with this work area.
fn folder(area: (f64, f64), more: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let generic = stargrip_cam::spec::builtin_machine("generic").expect("built in");
    let (x, y) = area;
    let profile =
        generic.replace("x = \"unknown\"\ny = \"unknown\"", &format!("x = \"{x} mm\"\ny = \"{y} mm\""));
    assert_ne!(profile, generic);
    fs::write(folder.path().join("mine.toml"), profile).expect("written");
    let spec = format!("{PAPER}\n[machine]\nprofile = \"mine.toml\"\n{more}");
    fs::write(folder.path().join("star.toml"), spec).expect("written");
    folder
}

#[test]
fn a_star_beyond_the_machines_reach_is_one_refusal_with_sizes_and_remedy() {
    let folder = folder((200.0, 400.0), "");
    for command in ["check", "build"] {
        let output = run(folder.path(), &[command, "star.toml"]);
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert_eq!(said.matches("error[").count(), 1, "{said}");
        assert!(said.contains("error[out-of-reach]: a part with its ramps needs 313.1 x 316.5 mm"), "{said}");
        assert!(said.contains("reaches 180 x 380 mm") && said.contains("mm are missing"), "{said}");
    }
}

/// A sheet may be larger than the work area: the parts then stay within the area.
#[test]
fn parts_stay_within_reach_on_a_larger_sheet() {
    let stack = "[stack]\ncount = 3\n[sheet]\nwidth = \"900 mm\"\nheight = \"900 mm\"\n";
    let folder = folder((340.0, 700.0), stack);
    for command in ["check", "build"] {
        let output = run(folder.path(), &[command, "star.toml"]);
        assert!(output.status.success(), "{}", stderr(&output));
    }
}

#[test]
fn a_sheet_without_a_size_is_no_larger_than_the_machine() {
    let folder = folder((340.0, 700.0), "[stack]\ncount = 3\n");
    let output = run(folder.path(), &["check", "star.toml"]);
    let said = stdout(&output);
    assert!(
        said.contains("sheets     2 of ") && said.contains("; the machine reaches 340 x 700 mm"),
        "{said}{}",
        stderr(&output)
    );
}

/// A kind that is not made by default is made on request, is proven with the others, and is reported when it is missing.
#[test]
fn an_extra_kind_is_built_recorded_and_demanded() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("star.toml"), PAPER).expect("written");
    let refused = run(folder.path(), &["build", "star.toml", "--with", "mask-stl"]);
    assert_eq!(refused.status.code(), Some(2), "it comes anyway");
    let output = run(folder.path(), &["build", "star.toml", "--only", "seal-svg", "--with", "preview-png"]);
    assert!(output.status.success(), "{}", stderr(&output));
    let picture = folder.path().join("out/star/sheet-1-preview.png");
    assert!(fs::read(&picture).expect("a file").starts_with(b"\x89PNG"));
    let manifest = fs::read(folder.path().join("out/star/manifest.json")).expect("a manifest");
    let manifest: serde_json::Value = serde_json::from_slice(&manifest).expect("JSON");
    assert_eq!((&manifest["only"][0], &manifest["with"][0]), (&"seal-svg".into(), &"preview-png".into()));
    let proven = |code: i32, said: &str| {
        let output = run(folder.path(), &["verify", "out/star"]);
        assert_eq!(output.status.code(), Some(code), "{}", stdout(&output));
        assert!(stdout(&output).contains(said), "{}", stdout(&output));
    };
    proven(0, "sheet-1-preview.png          equal to a new build, byte for byte");
    fs::write(&picture, b"P6").expect("written");
    proven(1, "sheet-1-preview.png: differs");
    fs::remove_file(&picture).expect("removed");
    proven(1, "sheet-1-preview.png: missing-file");
}

#[test]
fn a_partial_build_says_what_was_compared_and_ends_at_no_time() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("star.toml"), PAPER).expect("written");
    let output = run(folder.path(), &["build", "star.toml", "--only", "preview-svg"]);
    let said = stdout(&output);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(said.contains("proven     none of 3 files has geometry that is compared"), "{said}");
    assert!(!said.contains("within") && !said.contains("it ends"), "{said}");
    let verified = run(folder.path(), &["verify", "out/star", "--json"]);
    let json: serde_json::Value = serde_json::from_slice(&verified.stdout).expect("JSON");
    assert_eq!(json["findings"], serde_json::json!([]));
    assert_eq!(json["deviation_mm"]["sheet-1-preview.svg"], serde_json::Value::Null);
    let whole = run(folder.path(), &["build", "star.toml"]);
    let said = stdout(&whole);
    assert!(
        said.contains("proven     11 of 17 files compared with the exact geometry: lines and arcs within 0."),
        "{said}"
    );
    assert!(said.contains("started now, it ends "), "{said}");
    let verified = run(folder.path(), &["verify", "out/star", "--json"]);
    let json: serde_json::Value = serde_json::from_slice(&verified.stdout).expect("JSON");
    let proven = json["proven"].as_array().expect("a list");
    assert!(
        proven.contains(&serde_json::json!({ "path": "star-1-seal.gcode", "by": "bytes" })),
        "{proven:?}"
    );
    assert!(proven.contains(&serde_json::json!({ "path": "spec.toml", "by": "hash" })), "{proven:?}");
}

/// A build makes the kinds that its spec names, and those of the build that it replaces; removed kinds are reported.
#[test]
fn kinds_that_were_asked_for_once_come_again() {
    let folder = folder((600.0, 600.0), "");
    let there = |name: &str| folder.path().join("out/star").join(name).exists();
    let build = |args: &[&str]| {
        let output = run(folder.path(), &[&["build", "star.toml"], args].concat());
        assert!(output.status.success(), "{}", stderr(&output));
        stderr(&output)
    };
    let _ = build(&["--only", "report"]);
    let said = build(&[]);
    assert!(there("report.html") && said.contains("has `report`, which is built again"), "{said}");
    assert!(!build(&["--with", "preview-png"]).contains("preview-png"));
    assert!(there("sheet-1-preview.png"));
    let said = build(&[]);
    assert!(
        there("sheet-1-preview.png") && said.contains("has `preview-png`, which is built again"),
        "{said}"
    );
    let said = build(&["--with", "scene-glb"]);
    assert!(!there("sheet-1-preview.png") && there("scene.glb"));
    assert!(said.contains("out/star has `preview-png`, which is not built again"), "{said}");
    let text = fs::read_to_string(folder.path().join("star.toml")).expect("a spec");
    fs::write(folder.path().join("star.toml"), text + "\n[build]\nwith = [\"report\"]\n").expect("written");
    let said = build(&["-q"]);
    assert!(there("report.html") && there("scene.glb") && said.is_empty(), "{said}");
    let said = build(&["--only", "seal-gcode", "-q"]);
    assert!(
        !there("report.html")
            && said.contains("is not built again; to build it, add --with scene-glb,report"),
        "{said}"
    );
    assert!(run(folder.path(), &["verify", "out/star"]).status.success());
}
