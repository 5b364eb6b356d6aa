//! Messages about wrong use of the commands.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use serde_json::Value;

use crate::support::program::{run, stderr, stdout};

const STAR: &str = "schema = 1\nname = \"star\"\n[star]\npoints = 5\ninner_radius = \"50 mm\"\ntube_width = \"30 mm\"\n\
                    tip_angle = \"30 deg\"\n";

fn command(dir: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_stargrip-cam"));
    let _ = command.current_dir(dir).args(args);
    command
}

/// A folder with a valid spec, a faulty one, and a build.
fn folder() -> tempfile::TempDir {
    let dir = tempfile::tempdir().expect("a folder");
    fs::write(dir.path().join("star.toml"), STAR).expect("written");
    let wrong = STAR.replace("inner_radius = \"50 mm\"", "inner_diameter = \"100 mm\"");
    fs::write(dir.path().join("wrong.toml"), wrong).expect("written");
    assert_eq!(
        run(dir.path(), &["build", "star.toml", "-q", "--only", "seal-svg,outline-svg"]).status.code(),
        Some(0)
    );
    dir
}

fn json(output: &Output) -> Value {
    let said = stdout(output);
    serde_json::from_str(&said).unwrap_or_else(|error| panic!("{error}: {said}: {}", stderr(output)))
}

#[test]
fn a_refusal_is_json_for_whoever_reads_json() {
    let dir = folder();
    for args in [
        &["check", "wrong.toml"][..],
        &["build", "wrong.toml"],
        &["predict", "wrong.toml"],
        &["optimize", "wrong.toml"],
        &["coupon", "wrong.toml"],
        &["feedcheck", "wrong.toml"],
    ] {
        let output = run(dir.path(), &[args, &["--json"]].concat());
        let said = json(&output);
        assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(1), ""), "{args:?}");
        let refused = said["refused"].as_array().expect("a list");
        let unknown = refused.iter().find(|one| one["code"] == "unknown-key").expect("a code");
        assert_eq!((&unknown["key"], &unknown["line"]), (&"star.inner_diameter".into(), &5.into()), "{said}");
        assert_eq!(unknown["remedy"], "write inner_radius = \"50 mm\", half of the diameter");
        assert!(unknown["file"].as_str().is_some_and(|file| file.ends_with("wrong.toml")), "{said}");
    }
    for args in
        [&["check", "nowhere.toml"][..], &["verify", "nowhere"], &["new", "star"], &["explain", "xyzzy"]]
    {
        let output = run(dir.path(), &[args, &["--json"]].concat());
        let said = json(&output);
        assert_eq!(output.status.code(), Some(1), "{args:?}");
        assert!(said["refused"][0]["found"].as_str().is_some_and(|found| !found.is_empty()), "{said}");
        assert!(said["refused"][0]["code"].is_string(), "{said}");
    }
    let both = run(dir.path(), &["check", "star.toml", "wrong.toml", "--json"]);
    let said = json(&both);
    assert_eq!((both.status.code(), said["results"].as_array().map(Vec::len)), (Some(1), Some(1)), "{said}");
    assert!(said["refused"].as_array().is_some_and(|refused| !refused.is_empty()), "{said}");
    assert_eq!(run(dir.path(), &["check", "--json", "--nonsense"]).status.code(), Some(2));
}

#[test]
fn a_directory_in_place_of_a_spec_names_the_spec_in_it() {
    let dir = folder();
    for (place, words) in [
        ("out/star", "out/star is a directory: name the spec in it, out/star/spec.toml"),
        ("out", "out is a directory, and there is no spec.toml in it"),
    ] {
        let output = run(dir.path(), &["check", place]);
        let heard = stderr(&output);
        assert!(output.status.code() == Some(1) && heard.contains(words), "{heard}");
    }
}

#[test]
fn an_unreadable_manifest_is_one_finding() {
    let dir = folder();
    let manifest = dir.path().join("out/star/manifest.json");
    for content in ["{", "", "[]", "\u{0}\u{1}"] {
        fs::write(&manifest, content).expect("written");
        let output = run(dir.path(), &["verify", "out/star", "--json"]);
        let said = json(&output);
        assert_eq!(output.status.code(), Some(1), "{said}");
        let found = said["findings"].as_array().expect("a list");
        assert_eq!((found.len(), &found[0]["code"]), (1, &"manifest".into()), "{said}");
    }
}

#[test]
fn a_table_comes_from_standard_input() {
    let dir = folder();
    let table = "temperature_C,speed_mm_s,height_mm,peel_N\n".to_owned() + &"200,0.1,-0.3,76\n".repeat(3);
    fs::write(dir.path().join("results.csv"), &table).expect("written");
    let args = |from| ["calibrate", from, "--needed", "1 N/mm"];
    let file = run(dir.path(), &args("results.csv"));
    let mut child = command(dir.path(), &args("-"));
    let mut child = child.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("it starts");
    std::io::Write::write_all(&mut child.stdin.take().expect("a pipe"), table.as_bytes()).expect("written");
    let piped = child.wait_with_output().expect("it ends");
    assert_eq!((piped.status.code(), stdout(&piped)), (Some(0), stdout(&file)));
}

#[test]
fn numbers_that_no_quantity_has_are_refused_by_what_they_are() {
    let dir = folder();
    for (args, words) in [
        (&["new", "x", "--object", "-75 mm", "--mass", "1 kg"][..], "the length must be at least 0.001 mm"),
        (&["new", "x", "--object", "75 mm", "--mass", "-1 kg"], "the mass must be more than 0"),
        (
            &["new", "x", "--object", "75 mm", "--mass", "1 kg", "--friction", "50%"],
            "not a percentage: write 0.5",
        ),
        (&["new", "x", "--object", "75 mm", "--mass", "1 kg", "--sheet", "A9"], "not A0 to A5"),
        (&["optimize", "star.toml", "--tube-width", "-5 mm..20 mm"], "the length must be at least 0.001 mm"),
        (&["predict", "star.toml", "--radii", "-5 mm..20 mm/3"], "the length must be at least 0.001 mm"),
    ] {
        let output = run(dir.path(), args);
        let heard = stderr(&output);
        assert!(output.status.code() == Some(2) && heard.contains(words), "{args:?}: {heard}");
    }
}

#[test]
fn a_machine_by_its_trade_name_is_told_its_profile() {
    let dir = folder();
    fs::write(dir.path().join("e.toml"), format!("{STAR}[machine]\nprofile = \"ender3\"\n"))
        .expect("written");
    let heard = stderr(&run(dir.path(), &["check", "e.toml"]));
    assert!(heard.contains("it usually has Marlin: write profile = \"ender\""), "{heard}");
}

/// With --quiet only rows and documents are printed.
#[test]
fn every_command_can_be_quiet() {
    let dir = folder();
    for args in [
        &["sweep", "star.toml", "--vary", "star.points=4,5", "-o", "x.csv"][..],
        &["feedcheck", "star.toml"],
        &["coupon", "star.toml"],
    ] {
        let output = run(dir.path(), &[args, &["-q"]].concat());
        let heard = stderr(&output);
        assert_eq!(
            (output.status.code(), heard.as_str(), stdout(&output).as_str()),
            (Some(0), "", ""),
            "{args:?}"
        );
    }
    for args in [&["schema"][..], &["man"], &["completions", "bash"]] {
        let output = run(dir.path(), &[args, &["-q"]].concat());
        assert!(output.status.code() == Some(0) && !output.stdout.is_empty(), "{args:?}");
    }
}

/// The guide's command for a second run works.
#[test]
fn feedcheck_runs_a_second_time_if_it_is_told_to() {
    let dir = folder();
    let go = |more: &[&str]| run(dir.path(), &[&["feedcheck", "star.toml", "-q"], more].concat());
    assert_eq!(go(&[]).status.code(), Some(0));
    let again = go(&[]);
    let heard = stderr(&again);
    assert!(
        again.status.code() == Some(1) && heard.contains("--force replaces it, -o FILE writes another"),
        "{heard}"
    );
    let before = fs::read(dir.path().join("feedcheck.gcode")).expect("there");
    let old = [&before[..], b"; changed\n"].concat();
    fs::write(dir.path().join("feedcheck.gcode"), old).expect("written");
    assert_eq!(go(&["--force"]).status.code(), Some(0));
    assert_eq!(fs::read(dir.path().join("feedcheck.gcode")).expect("there"), before);
}

/// The answer of `check --json` on a star of 2 kPa whose inner loop has a strength of its own; the outer one has 2.5 N/mm.
fn star_with_inner_strength(strength: &str) -> Value {
    let dir = tempfile::tempdir().expect("a folder");
    let star = format!(
        "{STAR}inner_process = \"weak\"\n[process.weak]\nstrength = \"{strength}\"\n[fabric]\nseal_strength = \"2.5 N/mm\"\n\
         [load]\npressure = \"2 kPa\"\n"
    );
    fs::write(dir.path().join("star.toml"), star).expect("written");
    json(&run(dir.path(), &["check", "star.toml", "--json"]))
}

/// A design with a weak seam bursts there first, and `check` says so; a weak seam that is stronger than the others is a warning.
/// The note on weak processes before sealing.
fn note(answer: &Value) -> String {
    let codes = answer["before_you_seal_codes"].as_array().expect("codes");
    let place = codes.iter().position(|code| code == "weak-process").expect("a note");
    answer["before_you_seal"][place].as_str().expect("a text").to_owned()
}

#[test]
fn a_weak_seam_bursts_first_and_a_strong_one_of_that_name_is_a_warning() {
    let [weak, even, strong] = ["0.8 N/mm", "2.5 N/mm", "3.9 N/mm"].map(star_with_inner_strength);
    let bursts = [&weak, &even, &strong]
        .map(|answer| answer["prediction"]["burst_pressure_kPa"].as_f64().expect("a pressure"));
    // With a strong inner loop the outer one is the first to open, at the pull of the corners.
    assert!(bursts[0] < 0.5 * bursts[1] && bursts[2] >= bursts[1], "{bursts:?} kPa");
    assert!(
        weak["before_you_seal_codes"].as_array().expect("codes").iter().all(|code| code != "weak-process")
    );
    for answer in [&even, &strong] {
        assert!(note(answer).contains("its seams are not the first to open"), "{}", note(answer));
    }
}
