//! The commands for the machine as a user runs them: feedcheck, resume, coupon, calibrate.

use crate::support;
use crate::support::program::{done_silently, run, stderr, stdout, workshop};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Output;
use tempfile::TempDir;

/// A workshop with the paper's star built in out/star.
pub(super) fn built() -> TempDir {
    let dir = workshop();
    let _ = done_silently(dir.path(), &["build", "star.toml", "-q", "--only", "seal-gcode,trace-gcode"]);
    dir
}

/// A workshop whose machine has a work area of `x` by `y` mm.
pub(super) fn workshop_of(x: u32, y: u32) -> TempDir {
    let dir = workshop();
    let profile = support::generic().replacen("x = \"unknown\"", &format!("x = \"{x} mm\""), 1).replacen(
        "y = \"unknown\"",
        &format!("y = \"{y} mm\""),
        1,
    );
    fs::write(dir.path().join("mine.toml"), profile).expect("written");
    let spec = format!("{}[machine]\nprofile = \"mine.toml\"\n", support::PAPER);
    fs::write(dir.path().join("star.toml"), spec).expect("written");
    dir
}

pub(super) fn read(dir: &Path, name: &str) -> String {
    fs::read_to_string(dir.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Names in a directory, sorted.
pub(super) fn names(dir: &Path) -> Vec<String> {
    let entries = fs::read_dir(dir).expect("a directory").map(|entry| entry.expect("an entry").file_name());
    let mut names: Vec<String> = entries.map(|name| name.to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

pub(super) fn json_of(text: &str) -> Value {
    serde_json::from_str(text).expect("one object")
}

/// Runs a command that must fail with `code`, empty standard output and all of `words` on standard error.
#[track_caller]
pub(super) fn fails(dir: &Path, args: &[&str], code: i32, words: &[&str]) -> Output {
    let output = run(dir, args);
    let answer = stderr(&output);
    assert_eq!(output.status.code(), Some(code), "{args:?}\n{}\n{answer}", stdout(&output));
    assert_eq!(stdout(&output), "", "{args:?}");
    assert!(!answer.contains("panicked"), "{args:?}: {answer}");
    let flat = answer.split_whitespace().collect::<Vec<_>>().join(" ");
    for word in words {
        assert!(flat.contains(word), "{args:?}: no {word:?} in {answer}");
    }
    output
}

/// No command writes a program with a dangerous line of the profile.
#[test]
fn every_command_refuses_a_dangerous_line_of_the_profile() {
    for (from, to) in [
        ("start = [\"G21\"", "start = [\"M112\", \"G21\""),
        ("start = [\"G21\"", "start = [\"; set the iron to 400 C\", \"G21\""),
        ("pause = \"M0\"", "pause = \"M0 (print,x)\""),
        ("end = [", "end = [\"M500\", "),
    ] {
        let dir = workshop_of(300, 300);
        let profile = read(dir.path(), "mine.toml");
        assert!(profile.contains(from), "{from}");
        fs::write(dir.path().join("mine.toml"), profile.replacen(from, to, 1)).expect("written");
        for command in [
            ["check"].as_slice(),
            &["build"],
            &["feedcheck"],
            &["coupon"],
            &["build", "--only", "trace-gcode"],
        ] {
            let args: Vec<&str> =
                command[..1].iter().chain(&["star.toml"]).chain(&command[1..]).copied().collect();
            let _ = fails(dir.path(), &args, 1, &["program-line", "mine.toml:", "must be one of"]);
        }
        assert_eq!(names(dir.path()), ["mine.toml", "star.toml"], "{to}");
    }
}

#[test]
fn feedcheck_writes_a_cold_program_and_never_over_a_file() {
    let dir = workshop();
    let answer = done_silently(dir.path(), &["feedcheck", "star.toml"]);
    assert!(
        answer.contains("wrote feedcheck.gcode") && answer.contains("must take 100 s; if one took 96 s"),
        "{answer}"
    );
    assert!(answer.contains("at each M0 it must stop and wait, at the X, Y and Z"), "{answer}");
    let program = read(dir.path(), "feedcheck.gcode");
    assert!(
        program.contains("; requires: M0 must stop the machine") && !program.contains("G91"),
        "{program}"
    );
    assert!(program.contains("\n; must stop here, at X10 Y0 Z5\nM0\n"), "{program}");
    assert!(program.contains("F6") && !program.contains("M104") && !program.contains("G1 Z"), "{program}");
    let existing = ["feedcheck.gcode exists already", "--force replaces it, -o FILE writes another"];
    let _ = fails(dir.path(), &["feedcheck", "star.toml"], 1, &existing);
    assert_eq!(read(dir.path(), "feedcheck.gcode"), program);
    // A file of another kind is not replaced in any case.
    let spec = read(dir.path(), "star.toml");
    for force in [&["--force"][..], &[]] {
        let over = [&["feedcheck", "star.toml", "-o", "star.toml"], force].concat();
        let _ = fails(dir.path(), &over, 1, &["star.toml exists and is not the program of a feed check"]);
        assert_eq!(read(dir.path(), "star.toml"), spec);
    }
    assert!(
        done_silently(dir.path(), &["feedcheck", "star.toml", "-o", "a b.gcode"]).contains("wrote a b.gcode")
    );
    assert_eq!(read(dir.path(), "a b.gcode"), program);
    let _ =
        fails(dir.path(), &["feedcheck", "star.toml", "-o", "no/x.gcode"], 1, &["cannot write no/x.gcode"]);
    let _ = fails(dir.path(), &["feedcheck", "missing.toml"], 1, &["cannot read missing.toml"]);
    let _ = fails(dir.path(), &["feedcheck"], 2, &["Usage"]);
}

/// A profile alone is read with all of its faults at once, and says what is not checked.
#[test]
fn a_profile_is_checked_without_a_spec() {
    let dir = workshop();
    let profile = support::generic();
    fs::write(dir.path().join("mine.toml"), profile).expect("written");
    let answer = done_silently(dir.path(), &["machines", "check", "mine.toml"]);
    assert!(answer.contains("generic: sound") && answer.contains("[work_area] x, y"), "{answer}");
    let answer = json_of(&done_silently(dir.path(), &["machines", "check", "mine.toml", "--json"]));
    assert_eq!((&answer["dialect"], &answer["heated"]), (&"generic".into(), &"by hand".into()));
    assert_eq!(done_silently(dir.path(), &["machines", "check", "press", "-q"]), "");
    let faulty = profile
        .replacen("contact = \"-0.3 mm\"", "contact = \"5 mm\"", 1)
        .replacen("comments = \"semicolon\"", "comments = \"semi\"", 1)
        .replacen("ramp = ", "rmap = ", 1);
    fs::write(dir.path().join("faulty.toml"), faulty).expect("written");
    let words = ["contact", "semi", "did you mean", "rmap"];
    let _ = fails(dir.path(), &["machines", "check", "faulty.toml"], 1, &words);
    let output = run(dir.path(), &["machines", "check", "faulty.toml", "--json"]);
    assert_eq!(json_of(&stdout(&output))["refused"].as_array().map(Vec::len), Some(3));
    let _ =
        fails(dir.path(), &["machines", "check", "star.toml"], 1, &["this is a spec, not a machine profile"]);
    let _ = fails(dir.path(), &["machines", "check", "no.toml"], 1, &["cannot read no.toml"]);
    let _ = fails(dir.path(), &["machines", "show", "mine.toml"], 1, &["machines check mine.toml"]);
    let _ = fails(dir.path(), &["machines", "show", "Mach3"], 1, &["profile \"generic\""]);
}

/// A measured line of the feed check names the key to change, and with it the next feed check takes its time.
#[test]
fn a_feedcheck_that_took_another_time_names_the_key() {
    let dir = workshop();
    for (profile, chop, took, key) in [
        ("marlin", true, "96 s", Value::from("motion.start_delay")),
        ("grbl", true, "104 s", "motion.acceleration".into()),
        ("grbl", true, "96 s", "seal.speed".into()),
        ("grbl", true, "26 s", "dwell.unit".into()),
        ("generic", false, "26 s", Value::Null),
        ("grbl", true, "100.4 s", Value::Null),
    ] {
        let chop = if chop { "feed_floor = \"chop\"\n" } else { "" };
        let spec = format!("{}[machine]\nprofile = \"{profile}\"\n{chop}", support::PAPER);
        fs::write(dir.path().join("timed.toml"), spec).expect("written");
        let answer = done_silently(dir.path(), &["feedcheck", "timed.toml", "--took", took, "--json"]);
        assert_eq!(json_of(&answer)["key"], key, "{profile}, {took}: {answer}");
    }
    assert!(!dir.path().join("feedcheck.gcode").exists());
    let _ = fails(dir.path(), &["feedcheck", "star.toml", "--took", "96"], 2, &["--took"]);
    let _ = fails(dir.path(), &["feedcheck", "star.toml", "--took", "96 s", "--force"], 2, &["--force"]);
}

/// A heater that is switched off before the end of the job, in either program.
#[test]
fn every_command_refuses_an_idle_timeout_below_its_program() {
    let dir = workshop();
    let klipper = stargrip_cam::spec::builtin_machine("klipper").expect("built in");
    fs::write(dir.path().join("mine.toml"), klipper.replacen("TIMEOUT=86400", "TIMEOUT=1", 1))
        .expect("written");
    let spec = format!("{}[machine]\nprofile = \"mine.toml\"\n", support::PAPER);
    fs::write(dir.path().join("star.toml"), spec).expect("written");
    for command in ["check", "build", "feedcheck", "coupon"] {
        let _ = fails(dir.path(), &[command, "star.toml"], 1, &["profile-limit", "TIMEOUT must be at least"]);
    }
    assert_eq!(names(dir.path()), ["mine.toml", "star.toml"]);
}

/// A clamp of the generic profile with its lower left corner at X1 Y1.
pub(super) fn clamp(width: f64, depth: f64, height: f64) -> String {
    format!(
        "\n[[keep_out]]\nname = \"vice\"\nx = \"1 mm\"\ny = \"1 mm\"\nwidth = \"{width} mm\"\ndepth = \"{depth} mm\"\n\
         height = \"{height} mm\"\n"
    )
}

#[test]
fn a_feed_check_keeps_off_clamps_and_within_the_work_area() {
    let dir = workshop_of(400, 400);
    let mine = read(dir.path(), "mine.toml");
    let profile = |text: String| fs::write(dir.path().join("mine.toml"), text).expect("written");
    let _ = done_silently(dir.path(), &["feedcheck", "star.toml"]);
    profile(mine.clone() + &clamp(5.0, 5.0, 20.0));
    let words = ["clamp-in-the-way", "of the feed check meets the clamp", "above 20 mm"];
    let output = fails(dir.path(), &["feedcheck", "star.toml", "--force"], 1, &words);
    assert!(!stderr(&output).contains("[sheet]"), "the lines do not depend on it");
    // The program of an older version is not proven, either.
    let manifest = dir.path().join("feedcheck.gcode.manifest.json");
    let mut old = json_of(&fs::read_to_string(&manifest).expect("written"));
    let clamped = old["machine"].as_str().expect("a profile").to_owned() + &clamp(5.0, 5.0, 20.0);
    old["machine"] = clamped.into();
    fs::write(&manifest, old.to_string()).expect("written");
    let answer = stdout(&run(dir.path(), &["verify", "feedcheck.gcode"]));
    assert!(answer.contains("clamp-in-the-way: found a move at Z5"), "{answer}");
    // Below travel height it is in nothing's way.
    profile(mine.clone() + &clamp(5.0, 5.0, 4.0));
    let _ = done_silently(dir.path(), &["feedcheck", "star.toml", "--force"]);
    profile(mine.replace("400 mm", "9 mm"));
    let words = ["out-of-reach", "the feed check needs X 0.0 to 10.0 mm"];
    let _ = fails(dir.path(), &["feedcheck", "star.toml", "--force"], 1, &words);
}

#[test]
fn a_feed_check_is_proven_as_builds_are() {
    let dir = workshop();
    for (profile, floor) in
        [("generic", "refuse"), ("grbl", "chop"), ("marlin", "chop"), ("klipper", "refuse")]
    {
        let spec =
            format!("{}[machine]\nprofile = \"{profile}\"\nfeed_floor = \"{floor}\"\n", support::PAPER);
        fs::write(dir.path().join("star.toml"), spec).expect("written");
        let name = format!("{profile}.gcode");
        let _ = done_silently(dir.path(), &["feedcheck", "star.toml", "-o", &name]);
        assert!(done_silently(dir.path(), &["verify", &name]).contains("proven, no findings"), "{profile}");
        let path = dir.path().join(&name);
        let good = fs::read_to_string(&path).expect("it");
        let pause = if profile == "klipper" { "PAUSE\n" } else { "M0\n" };
        for (from, to) in [(pause, "M112\n"), (pause, ""), ("G0 Z5", "G0 Z-5"), ("X10 ", "X11 ")] {
            assert!(good.contains(from), "{profile}: {from}");
            fs::write(&path, good.replacen(from, to, 1)).expect("written");
            let output = run(dir.path(), &["verify", &name, "--json"]);
            assert_eq!(output.status.code(), Some(1), "{profile} {from}: {}", stdout(&output));
            let findings = json_of(&stdout(&output))["findings"].as_array().expect("a list").len();
            // Reading finds the change as well, not only bytes and hash.
            assert!(findings > 2, "{profile} {from}: {}", stdout(&output));
        }
    }
    fs::write(dir.path().join("other.gcode"), "G0 Z5\n").expect("written");
    let _ = fails(dir.path(), &["verify", "other.gcode"], 1, &["is not the program of a feed check"]);
}
