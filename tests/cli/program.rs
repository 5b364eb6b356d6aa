//! The program as a user runs it: exit codes, streams, files; and its behaviour on bad input.

use crate::support;
use crate::support::program::{run, stderr, stdout, workshop};
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use std::time::Duration;

/// (name, content) of all files in a directory, sorted.
pub(super) fn files(dir: &Path) -> Vec<(String, Vec<u8>)> {
    let mut files: Vec<_> = fs::read_dir(dir)
        .expect("a directory")
        .map(|entry| entry.expect("an entry"))
        .map(|entry| {
            (entry.file_name().to_string_lossy().into_owned(), fs::read(entry.path()).expect("a file"))
        })
        .collect();
    files.sort();
    files
}

#[track_caller]
pub(super) fn assert_code(output: &Output, code: i32) {
    assert_eq!(output.status.code(), Some(code), "{}\n{}", stdout(output), stderr(output));
    assert!(!stderr(output).contains("panicked"), "{}", stderr(output));
}

#[test]
fn build_then_verify() {
    let dir = workshop();
    let built = run(dir.path(), &["build", "star.toml", "-v"]);
    assert_code(&built, 0);
    assert!(!stderr(&built).contains("warning") && !stderr(&built).contains("error"), "{}", stderr(&built));
    let said = stdout(&built);
    for words in ["arms 69.72 mm", "inner loop: 875.9 mm", "in total 2003.0 mm of seam", "out/star"] {
        assert!(said.contains(words), "{words}: {said}");
    }
    let names: Vec<String> = files(&dir.path().join("out/star")).into_iter().map(|(name, _)| name).collect();
    assert_eq!(
        names,
        [
            "machine.toml",
            "manifest.json",
            "plate-1-frame.dxf",
            "plate-1-frame.svg",
            "sheet-1-outline.dxf",
            "sheet-1-outline.svg",
            "sheet-1-preview.svg",
            "sheet-1-seal.dxf",
            "sheet-1-seal.svg",
            "spec.toml",
            "star-1-mask-a4.pdf",
            "star-1-mask-letter.pdf",
            "star-1-mask.dxf",
            "star-1-mask.pdf",
            "star-1-mask.stl",
            "star-1-mask.svg",
            "star-1-seal.gcode",
            "star-1-trace.gcode",
        ]
    );
    let verified = run(dir.path(), &["verify", "out/star"]);
    assert_code(&verified, 0);
    assert!(stdout(&verified).contains("proven, no findings"));
    let json = run(dir.path(), &["verify", "out/star", "--json"]);
    assert_code(&json, 0);
    let json: serde_json::Value = serde_json::from_slice(&json.stdout).expect("one JSON object");
    assert_eq!(json["findings"], serde_json::json!([]));
    assert!(json["deviation_mm"]["star-1-seal.gcode"].as_f64().expect("a number") < 0.001);
}

#[test]
fn the_same_spec_gives_the_same_bytes_anywhere() {
    let (a, b) = (workshop(), workshop());
    assert_code(&run(a.path(), &["build", "star.toml"]), 0);
    assert_code(&run(a.path(), &["build", "star.toml"]), 0);
    fs::create_dir(b.path().join("deep down")).expect("made");
    fs::rename(b.path().join("star.toml"), b.path().join("deep down/other name.toml")).expect("moved");
    assert_code(&run(b.path(), &["build", "deep down/other name.toml", "-o", "x/y z"]), 0);
    assert_eq!(files(&a.path().join("out/star")), files(&b.path().join("x/y z")));
}

#[test]
fn wrong_usage_is_told_apart_from_refusal() {
    let dir = workshop();
    assert_code(&run(dir.path(), &["build"]), 2);
    assert_code(&run(dir.path(), &["frobnicate"]), 2);
    assert_code(&run(dir.path(), &["build", "star.toml", "--only", "poem"]), 2);
    assert_code(&run(dir.path(), &["predict", "star.toml", "--fineness", "coarse"]), 2);
    assert_code(&run(dir.path(), &["study", "run", "study.toml", "--threads", "20000"]), 2);
    assert_code(&run(dir.path(), &["build", "missing.toml"]), 1);
    assert_code(&run(dir.path(), &["--help"]), 0);
    assert_code(&run(dir.path(), &["machines"]), 0);
    assert_code(&run(dir.path(), &["machines", "show", "generic"]), 0);
    assert_code(&run(dir.path(), &["machines", "show", "generic", "-q"]), 0);
    assert_code(&run(dir.path(), &["machines", "show", "teapot"]), 1);
    let empty = tempfile::tempdir().expect("a directory");
    for name in ["..", "", "-.-", "\u{e4}", ".toml"] {
        assert_code(&run(empty.path(), &["new", "--", name]), 1);
    }
}

#[test]
fn only_some_kinds() {
    let dir = workshop();
    assert_code(&run(dir.path(), &["build", "star.toml", "--only", "seal-dxf,preview-svg"]), 0);
    let names: Vec<String> = files(&dir.path().join("out/star")).into_iter().map(|(name, _)| name).collect();
    assert_eq!(
        names,
        ["machine.toml", "manifest.json", "sheet-1-preview.svg", "sheet-1-seal.dxf", "spec.toml"]
    );
    assert_code(&run(dir.path(), &["verify", "out/star"]), 0);
    // An undivided mask has no pieces.
    let without = run(dir.path(), &["build", "star.toml", "-q", "--only", "seal-dxf,pieces-svg"]);
    assert_code(&without, 0);
    assert_eq!(stderr(&without), "note: this design has no pieces-svg\n");
}

#[test]
fn files_too_large_for_their_paper_are_named() {
    let dir = workshop();
    let large = |file: &str, inner_radius: &str, tube_width: &str| {
        let spec = format!(
            "schema = 1\nname = \"large\"\n[star]\npoints = 5\ninner_radius = \"{inner_radius}\"\n\
             tube_width = \"{tube_width}\"\ntip_angle = \"30 deg\"\n[seal]\nspeed = \"5 mm/s\"\n"
        );
        fs::write(dir.path().join(file), spec).expect("written");
    };
    large("huge.toml", "2500 mm", "800 mm");
    large("big.toml", "900 mm", "300 mm");
    let huge = run(dir.path(), &["build", "huge.toml", "-q", "--only", "mask-pdf,outline-pdf,pieces-svg"]);
    assert_code(&huge, 0);
    let said = stderr(&huge);
    assert!(said.starts_with("note: this design has no pieces-svg\n"), "{said}");
    let page = "note: sheet-1-outline.pdf, star-1-mask.pdf are left out: each needs a page of more than 10 m";
    let pages = "note: sheet-1-outline-a4.pdf, sheet-1-outline-letter.pdf, star-1-mask-a4.pdf, star-1-mask-letter.pdf are \
                 left out: each needs more than 100 pages; SVG and DXF have no limit\n";
    assert!(said.contains(page) && said.contains(pages), "{said}");
    assert_code(&run(dir.path(), &["verify", "out/huge"]), 0);
    // Masks are on paper by default.
    let big = stderr(&run(dir.path(), &["check", "big.toml", "-q"]));
    assert!(big.contains("note: star-1-mask-a4.pdf, star-1-mask-letter.pdf are left out: "), "{big}");
    assert!(!big.contains("star-1-mask.pdf") && !big.contains("outline"), "{big}");
}

#[test]
fn new_writes_a_spec_that_builds_and_never_overwrites() {
    let dir = tempfile::tempdir().expect("a directory");
    assert_code(&run(dir.path(), &["new", "My \"first\" Star; ../x"]), 0);
    assert_code(&run(dir.path(), &["build", "my-first-star-x.toml"]), 0);
    let again = run(dir.path(), &["new", "My \"first\" Star; ../x"]);
    assert_code(&again, 1);
    assert!(stderr(&again).contains("exists already"));
}

#[test]
fn a_profile_of_ones_own_is_found_beside_the_spec() {
    let dir = workshop();
    let profile = support::generic().replace("\"5 mm\"", "\"7 mm\"");
    fs::create_dir(dir.path().join("specs")).expect("made");
    fs::write(dir.path().join("specs/mine.toml"), profile).expect("written");
    let spec = format!("{}[machine]\nprofile = \"mine.toml\"\n", support::PAPER);
    fs::write(dir.path().join("specs/star.toml"), spec).expect("written");
    assert_code(&run(dir.path(), &["build", "specs/star.toml"]), 0);
    let program = fs::read_to_string(dir.path().join("out/star/star-1-seal.gcode")).expect("a program");
    assert!(program.contains("G0 Z7 F"));
    let spec = support::PAPER.to_owned() + "[machine]\nprofile = \"missing.toml\"\n";
    fs::write(dir.path().join("star.toml"), spec).expect("written");
    let refused = run(dir.path(), &["build", "star.toml"]);
    assert_code(&refused, 1);
    assert!(
        stderr(&refused).contains("generic") && stderr(&refused).contains("profile ="),
        "{}",
        stderr(&refused)
    );
}

#[test]
fn all_faults_are_told_at_once_with_their_lines() {
    let dir = workshop();
    let spec = support::PAPER.replace("tube_width", "tube_widht").replace("\"50 mm\"", "50");
    fs::write(dir.path().join("star.toml"), spec).expect("written");
    let refused = run(dir.path(), &["build", "star.toml"]);
    assert_code(&refused, 1);
    assert_eq!(stdout(&refused), "");
    let said = stderr(&refused);
    for words in ["star.toml:7", "star.toml:8", "did you mean `tube_width`?", "mm, cm, m"] {
        assert!(said.contains(words), "{words}: {said}");
    }
    assert!(!dir.path().join("out").exists());
}

#[test]
fn a_design_that_cannot_be_made_points_at_its_key() {
    let dir = workshop();
    fs::write(dir.path().join("star.toml"), support::PAPER.replace("points = 5", "points = 9"))
        .expect("written");
    let refused = run(dir.path(), &["check", "star.toml"]);
    assert_code(&refused, 1);
    let said = stderr(&refused);
    for words in ["the arms would be -6.2 mm long", "points at most 8", "star.toml:6"] {
        assert!(said.contains(words), "{words}: {said}");
    }
}

#[test]
fn what_we_did_not_write_is_not_touched() {
    let dir = workshop();
    let target = dir.path().join("out/star");
    assert_code(&run(dir.path(), &["build", "star.toml"]), 0);
    fs::write(target.join("notes.txt"), "mine").expect("written");
    let before = files(&target);
    let refused = run(dir.path(), &["build", "star.toml"]);
    assert_code(&refused, 1);
    assert!(stderr(&refused).contains("notes.txt"), "{}", stderr(&refused));
    assert_eq!(files(&target), before);

    fs::create_dir(dir.path().join("photos")).expect("made");
    fs::write(dir.path().join("photos/cat.jpg"), "cat").expect("written");
    assert_code(&run(dir.path(), &["build", "star.toml", "-o", "photos"]), 1);
    assert_eq!(files(&dir.path().join("photos")).len(), 1);
    assert_code(&run(dir.path(), &["build", "star.toml", "-o", "star.toml"]), 1);
    assert_eq!(fs::read_to_string(dir.path().join("star.toml")).expect("text"), support::PAPER);
    assert_code(&run(dir.path(), &["build", "star.toml", "-o", "/"]), 1);
}

#[test]
fn an_output_that_shrinks_leaves_nothing_behind() {
    let dir = workshop();
    assert_code(&run(dir.path(), &["build", "star.toml"]), 0);
    assert_code(&run(dir.path(), &["build", "star.toml", "--only", "seal-svg"]), 0);
    assert_eq!(files(&dir.path().join("out/star")).len(), 4);
    assert_eq!(fs::read_dir(dir.path().join("out")).expect("out/").count(), 1, "a hidden directory is left");
}

/// The state after a kill between two renames, on systems that cannot exchange names.
#[test]
fn an_output_set_aside_is_put_back() {
    let dir = workshop();
    assert_code(&run(dir.path(), &["build", "star.toml"]), 0);
    let (target, aside) = (dir.path().join("out/star"), dir.path().join("out/.star.stargrip-old"));
    fs::rename(&target, &aside).expect("renamed");
    fs::write(aside.join("notes.txt"), "mine").expect("written");
    // The output is restored before it is checked; with a foreign file in it, it is then left unchanged.
    assert_code(&run(dir.path(), &["build", "star.toml"]), 1);
    assert!(target.join("notes.txt").exists() && !aside.exists());
}

#[test]
fn a_build_killed_at_any_moment_leaves_a_whole_output() {
    let dir = workshop();
    assert_code(&run(dir.path(), &["build", "star.toml"]), 0);
    let (first, target) = (files(&dir.path().join("out/star")), dir.path().join("out/star"));
    let other = support::PAPER.replace("\"50 mm\"", "\"55 mm\"");
    fs::write(dir.path().join("other.toml"), other).expect("written");
    assert_code(&run(dir.path(), &["build", "other.toml"]), 0);
    let second = files(&dir.path().join("out/other"));
    for i in 0..60_u64 {
        let spec = if i % 2 == 0 { "other.toml" } else { "star.toml" };
        let mut child = Command::new(env!("CARGO_BIN_EXE_stargrip-cam"))
            .current_dir(dir.path())
            .args(["build", spec, "-o", "out/star"])
            .stdout(std::process::Stdio::null())
            .spawn()
            .expect("it starts");
        std::thread::sleep(Duration::from_micros(i * 700));
        let _ = child.kill();
        let _ = child.wait().expect("it ends");
        let now = files(&target);
        assert!(
            now == first || now == second,
            "after {i}: {:?}",
            now.iter().map(|f| &f.0).collect::<Vec<_>>()
        );
    }
    assert_code(&run(dir.path(), &["build", "star.toml"]), 0);
    assert_eq!(files(&target), first);
}
