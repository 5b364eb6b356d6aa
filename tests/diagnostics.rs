//! What the program says about a spec that is wrong or remarkable, and where it points.

mod support;

use std::fs;
use std::path::Path;

use support::program::{run, stderr, stdout};

/// Line and text at the caret of the first diagnostic with `code` that `check` prints for `spec`, and all it says.
#[track_caller]
fn pointed_at(dir: &Path, spec: &str, code: &str, exit: i32) -> (String, String) {
    fs::write(dir.join("spec.toml"), spec).expect("written");
    let output = run(dir, &["check", "spec.toml"]);
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(exit), "{said}");
    let at = said.find(&format!("[{code}]")).unwrap_or_else(|| panic!("no {code}: {said}"));
    let arrow =
        said[at..].lines().find_map(|line| line.trim().strip_prefix("--> spec.toml:")).expect("a place");
    let line: usize = arrow.split(':').next().and_then(|n| n.parse().ok()).expect("a line");
    (spec.lines().nth(line - 1).unwrap_or_default().to_owned(), said)
}

/// A spec with these values in `[star]` and more behind them.
fn star(points: u32, radius: &str, width: &str, angle: &str, rest: &str) -> String {
    format!(
        "schema = 1\nname = \"x\"\n[star]\npoints = {points}\ninner_radius = \"{radius}\"\ntube_width = \"{width}\"\n\
         tip_angle = \"{angle}\"\n{rest}"
    )
}

#[test]
fn a_refusal_points_at_the_value_that_is_out_of_line() {
    let dir = tempfile::tempdir().expect("a directory");
    let cases = [
        (star(5, "50 mm", "300 mm", "30 deg", ""), "no-arm", "tube_width = \"300 mm\""),
        (star(9, "50 mm", "30 mm", "30 deg", ""), "no-arm", "points = 9"),
        (star(5, "5 mm", "30 mm", "30 deg", ""), "no-arm", "inner_radius = \"5 mm\""),
        (star(5, "50 mm", "0.03 mm", "30 deg", ""), "inlet-meets-arm", "tube_width = \"0.03 mm\""),
        (
            star(5, "50 mm", "30 mm", "30 deg", "[inlet]\ntube_diameter = \"45 mm\"\n"),
            "inlet-meets-arm",
            "tube_diameter = \"45 mm\"",
        ),
        (
            star(5, "50 mm", "30 mm", "30 deg", "[seal]\nband = \"49 mm\"\n"),
            "hole-closed",
            "band = \"49 mm\"",
        ),
        (
            star(
                5,
                "50 mm",
                "30 mm",
                "30 deg",
                "[stack]\ncount = 2\n[[stack.star]]\nindex = 2\npitch = \"20 mm\"\n",
            ),
            "tube-between-plates",
            "pitch = \"20 mm\"",
        ),
    ];
    for (spec, code, line) in cases {
        let (found, said) = pointed_at(dir.path(), &spec, code, 1);
        assert_eq!(found, line, "{said}");
    }
}

#[test]
fn a_default_that_is_refused_is_called_a_default() {
    let dir = tempfile::tempdir().expect("a directory");
    let wide = star(5, "50 mm", "120 mm", "80 deg", "[stack]\ncount = 2\n");
    let (line, said) = pointed_at(dir.path(), &wide, "tube-between-plates", 1);
    assert_eq!(line, "[stack]", "{said}");
    assert!(said.contains("`pitch` in [stack] is not written: this is about its default"), "{said}");
    // Without the section it points at the end, where the section would be added, not at the first line.
    let few = star(12, "30 mm", "8 mm", "30 deg", "[inlet]\nnone = true");
    let (line, said) = pointed_at(dir.path(), &few, "short-window", 0);
    assert_eq!(line, "none = true", "{said}");
}

#[test]
fn a_leak_has_a_place_as_every_refusal() {
    let dir = tempfile::tempdir().expect("a directory");
    let bare = star(5, "50 mm", "30 mm", "30 deg", "[seal]\noverlap = \"0 mm\"\n");
    let (line, said) = pointed_at(dir.path(), &bare, "no-overlap", 1);
    assert_eq!(line, "overlap = \"0 mm\"", "{said}");
    let built = run(dir.path(), &["build", "spec.toml"]);
    assert_eq!(built.status.code(), Some(1));
    assert!(stderr(&built).contains("error[no-overlap]") && !dir.path().join("out").exists());
}

#[test]
fn a_star_without_an_inlet_has_no_way_for_air_at_all() {
    let dir = tempfile::tempdir().expect("a directory");
    let shut = star(5, "50 mm", "30 mm", "30 deg", "[inlet]\nnone = true\n");
    fs::write(dir.path().join("spec.toml"), shut).expect("written");
    let said = stdout(&run(dir.path(), &["check", "spec.toml"]));
    assert!(said.contains("closed all around") && !said.contains("but the inlet"), "{said}");
}

#[test]
fn a_default_window_that_is_cut_says_so() {
    let dir = tempfile::tempdir().expect("a directory");
    let many = star(12, "30 mm", "8 mm", "30 deg", "[inlet]\nnone = true\n[mask]\ncreep = \"0 mm\"\n");
    let (line, said) = pointed_at(dir.path(), &many, "short-window", 0);
    assert_eq!(line, "[mask]", "{said}");
    assert!(said.contains("warning[short-window]") && said.contains("less than the hinge of"), "{said}");
    let built = run(dir.path(), &["build", "spec.toml"]);
    assert_eq!(built.status.code(), Some(0), "{}", stderr(&built));
    assert!(stderr(&built).contains("warning[short-window]"), "{}", stderr(&built));
    // What the remedy names is accepted, without a word.
    let extent =
        said.split("write extent = \"").nth(1).and_then(|rest| rest.split('"').next()).expect("a value");
    let accepted = many + &format!("extent = \"{extent}\"\n");
    fs::write(dir.path().join("spec.toml"), accepted).expect("written");
    let output = run(dir.path(), &["check", "spec.toml"]);
    assert_eq!((output.status.code(), stderr(&output)), (Some(0), String::new()));
}

#[test]
fn what_does_not_exist_is_neither_offered_nor_accepted() {
    let dir = tempfile::tempdir().expect("a directory");
    let solid = star(5, "50 mm", "30 mm", "30 deg", "[accuracy]\nmodel = \"solid\"\n");
    let (line, said) = pointed_at(dir.path(), &solid, "unknown-choice", 1);
    assert_eq!(line, "model = \"solid\"");
    assert!(said.contains("\"fit\", \"ring\", \"bvp\", \"section\", \"shell\", \"auto\""), "{said}");
    assert_eq!(run(dir.path(), &["predict", "spec.toml", "--model", "solid"]).status.code(), Some(2));
}

#[test]
fn a_published_directory_is_built_again_with_its_own_profile() {
    let (home, away) = (tempfile::tempdir().expect("a directory"), tempfile::tempdir().expect("a directory"));
    let profile = support::generic().replace("\"5 mm\"", "\"7 mm\"");
    fs::write(home.path().join("mine.toml"), profile).expect("written");
    let spec = star(5, "50 mm", "30 mm", "30 deg", "[machine]\nprofile = \"mine.toml\"\n");
    fs::write(home.path().join("star.toml"), spec).expect("written");
    let target = away.path().join("first");
    let to = target.to_str().expect("a path");
    assert_eq!(run(home.path(), &["build", "star.toml", "-o", to]).status.code(), Some(0));
    let again = run(away.path(), &["build", "first/spec.toml", "-o", "second"]);
    assert_eq!(again.status.code(), Some(0), "{}", stderr(&again));
    assert!(stderr(&again).contains("machine.toml is used, as published"), "{}", stderr(&again));
    for entry in fs::read_dir(&target).expect("published") {
        let name = entry.expect("an entry").file_name();
        let [first, second] =
            ["first", "second"].map(|dir| fs::read(away.path().join(dir).join(&name)).expect("a file"));
        assert!(first == second, "{name:?}");
    }
    // Without a manifest it is no published directory, and some machine.toml is not taken for the profile.
    fs::remove_file(target.join("manifest.json")).expect("removed");
    let alone = run(away.path(), &["check", "first/spec.toml"]);
    assert_eq!(alone.status.code(), Some(1));
    assert!(stderr(&alone).contains("unknown-machine"), "{}", stderr(&alone));
}
