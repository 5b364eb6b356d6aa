//! Diagnostics of wrong or unusual specs, and their places.

use crate::misspelt::refused;
use crate::support;
use crate::support::program::{run, stderr, stdout};
use std::fs;
use std::path::Path;

/// Line and text at the caret of the first diagnostic with `code` that `check` prints for `spec`, and the whole output.
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
pub(super) fn star(points: u32, radius: &str, width: &str, angle: &str, rest: &str) -> String {
    format!(
        "schema = 1\nname = \"x\"\n[star]\npoints = {points}\ninner_radius = \"{radius}\"\ntube_width = \"{width}\"\n\
         tip_angle = \"{angle}\"\n{rest}"
    )
}

/// A bare number up to 1 is a share of one more often than a number of per cent.
#[test]
fn both_meanings_of_a_bare_share_are_offered() {
    let dir = tempfile::tempdir().expect("a directory");
    let spec = star(5, "50 mm", "30 mm", "30 deg", "[accuracy]\nresponse = 0.5\n");
    let (_, said) = pointed_at(dir.path(), &spec, "no-unit", 1);
    assert!(said.contains("\"50 %\"") && said.contains("\"0.5 %\""), "{said}");
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
    assert!(said.contains("the spec does not give `pitch` in [stack], so its default is used"), "{said}");
    // Without the section there is no place to point at, whether or not the last line ends.
    for end in ["", "\n"] {
        let few = star(12, "30 mm", "8 mm", "30 deg", &format!("[inlet]\nnone = true{end}"));
        fs::write(dir.path().join("spec.toml"), few).expect("written");
        let said = stderr(&run(dir.path(), &["check", "spec.toml"]));
        let (_, found) = said.split_once("warning[short-window]").expect("a warning");
        assert!(found.contains("--> spec.toml\n") && !found.contains('^'), "{said}");
    }
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
    let said = stdout(&run(dir.path(), &["check", "spec.toml", "-v"]));
    assert!(said.contains("closed all around") && !said.contains("except the inlet"), "{said}");
}

#[test]
fn a_default_window_that_is_cut_says_so() {
    let dir = tempfile::tempdir().expect("a directory");
    let many = star(
        12,
        "30 mm",
        "8 mm",
        "30 deg",
        "[stack]\npitch = \"14 mm\"\n[inlet]\nnone = true\n[mask]\ncreep = \"0 mm\"\n",
    );
    let (line, said) = pointed_at(dir.path(), &many, "short-window", 0);
    assert_eq!(line, "[mask]", "{said}");
    assert!(said.contains("warning[short-window]") && said.contains("less than the hinge of"), "{said}");
    let built = run(dir.path(), &["build", "spec.toml"]);
    assert_eq!(built.status.code(), Some(0), "{}", stderr(&built));
    assert!(stderr(&built).contains("warning[short-window]"), "{}", stderr(&built));
    // The value in the remedy is accepted without a message.
    let extent =
        said.split("write extent = \"").nth(1).and_then(|rest| rest.split('"').next()).expect("a value");
    let accepted = many + &format!("extent = \"{extent}\"\n");
    fs::write(dir.path().join("spec.toml"), accepted).expect("written");
    let output = run(dir.path(), &["check", "spec.toml"]);
    assert_eq!(output.status.code(), Some(0));
    assert!(!stderr(&output).contains("warning"), "{}", stderr(&output));
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
    // Without a manifest it is not a published directory, and an unrelated machine.toml is not taken for the profile.
    fs::remove_file(target.join("manifest.json")).expect("removed");
    let alone = run(away.path(), &["check", "first/spec.toml"]);
    assert_eq!(alone.status.code(), Some(1));
    assert!(stderr(&alone).contains("unknown-machine"), "{}", stderr(&alone));
}

/// Every file differs from what a changed spec says, so the change is named last, where it is seen.
#[test]
fn a_spec_that_was_changed_after_the_build_is_named_as_the_cause() {
    let dir = tempfile::tempdir().expect("a directory");
    fs::write(dir.path().join("star.toml"), support::PAPER).expect("written");
    assert_eq!(run(dir.path(), &["build", "star.toml", "-q"]).status.code(), Some(0));
    let words = "spec.toml was changed after the build";
    assert!(!stdout(&run(dir.path(), &["verify", "out/star"])).contains(words));
    let spec = dir.path().join("out/star/spec.toml");
    let text = fs::read_to_string(&spec).expect("its copy");
    let changed = text.replace("tube_width = \"30 mm\"", "tube_width = \"31 mm\"");
    assert_ne!(changed, text);
    fs::write(&spec, changed).expect("written");
    let output = run(dir.path(), &["verify", "out/star"]);
    let said = stdout(&output);
    assert_eq!(output.status.code(), Some(1));
    let last: Vec<&str> = said.lines().rev().take(2).collect();
    assert!(last[0].contains("findings") && last[1].starts_with(words), "{last:?}");
}

#[test]
fn a_hose_that_is_thicker_than_its_tube_is_warned_of() {
    let dir = tempfile::tempdir().expect("a directory");
    let wide =
        |mm: u32| star(5, "80 mm", "30 mm", "30 deg", &format!("[inlet]\ntube_diameter = \"{mm} mm\"\n"));
    let (line, said) = pointed_at(dir.path(), &wide(20), "thick-hose", 0);
    assert_eq!(line, "tube_diameter = \"20 mm\"", "{said}");
    assert!(said.contains("at most 19.0985 mm"), "{said}");
    fs::write(dir.path().join("spec.toml"), wide(19)).expect("written");
    assert!(!stderr(&run(dir.path(), &["check", "spec.toml"])).contains("thick-hose"));
}

/// Some messages are only for the slow seal of the paper, others only for a much faster one.
#[test]
fn a_fast_seal_is_told_what_matters_to_it() {
    let dir = tempfile::tempdir().expect("a directory");
    let said = |speed: &str| {
        let spec = star(5, "50 mm", "30 mm", "30 deg", &format!("[seal]\nspeed = \"{speed}\"\n"));
        fs::write(dir.path().join("spec.toml"), spec).expect("written");
        stderr(&run(dir.path(), &["check", "spec.toml"]))
    };
    let (slow, fast) = (said("0.1 mm/s"), said("50 mm/s"));
    assert!(slow.contains("speed, pause and reach are not checked") && !slow.contains("peel test"), "{slow}");
    assert!(fast.contains("peel test"), "{fast}");
}

/// Faults of mask, cut, frame, sheet, machine and load are found in one round, and none that follows from another.
#[test]
fn faults_of_all_stages_are_told_at_once() {
    let dir = tempfile::tempdir().expect("a directory");
    let rest = "[sheet]\nwidth = \"20 mm\"\n[machine]\nprofile = \"grbl\"\n[load]\npressure = \"37 kPa\"\n\
                object_diameter = \"110 mm\"\n[frame]\nposts = 64\n[cut]\nkerf = \"7 mm\"\n[mask]\nextent = \"90 mm\"\n";
    let check = |more: &str, anyway: &[&str]| {
        fs::write(dir.path().join("spec.toml"), star(5, "50 mm", "30 mm", "30 deg", more)).expect("written");
        stderr(&run(dir.path(), &[&["check", "spec.toml"], anyway].concat()))
    };
    let codes = |said: &str| {
        let mut codes: Vec<String> = said
            .lines()
            .filter_map(|line| Some(line.strip_prefix("error[")?.split_once(']')?.0.to_owned()))
            .collect();
        codes.sort();
        codes
    };
    let said = check(rest, &[]);
    let all =
        ["feed-floor", "long-extent", "object-too-wide", "post-meets-hose", "sheet-too-small", "wide-kerf"];
    assert_eq!(codes(&said), all, "{said}");
    assert!(said.contains("the margins leave ") && !said.contains("0.00000"), "{said}");
    let accepted = codes(&check(rest, &["--anyway"]));
    assert!(
        !accepted.contains(&"object-too-wide".to_owned()) && accepted.len() + 1 == all.len(),
        "{accepted:?}"
    );
    // Nothing depends on a star that does not exist.
    let without_star = check(&rest.replace("[mask]", "[seal]\nband = \"40 mm\"\n[mask]"), &[]);
    assert_eq!(codes(&without_star), ["band-eats-arm", "short-inlet"], "{without_star}");
    // A machine that is unknown is told beside faults of keys.
    let said = check("[machine]\nprofile = \"loom\"\n[load]\nfriction = 0\nmass = \"0 kg\"\n", &[]);
    assert_eq!(codes(&said), ["out-of-range", "out-of-range", "unknown-machine"], "{said}");
}

#[test]
fn the_hole_and_the_outer_size_of_a_star_are_answered_by_the_keys_that_decide_them() {
    for (key, answer) in [
        ("hole_diameter = \"79 mm\"", "write inner_radius = \"42.5 mm\""),
        ("hole_radius = \"39.5 mm\"", "write inner_radius = \"42.5 mm\""),
        ("outer_diameter = \"200 mm\"", "it follows from inner_radius, points, tube_width and tip_angle"),
        ("inner_diameter = \"80 mm\"", "write inner_radius = \"40 mm\""),
    ] {
        let spec = star(5, "50 mm", "30 mm", "30 deg", "").replace("inner_radius = \"50 mm\"", key);
        let said = refused(&spec);
        assert!(said.contains(answer) && !said.contains("belongs"), "{key}: {said}");
    }
}
