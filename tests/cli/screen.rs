//! The overview of `check` and `build`: its content, its streams, its verbosity, and its refusals.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use crate::support::inputs::ACTUATOR;
use crate::support::program::{done_silently, run, stderr, stdout};

const GRIPPER: &str = include_str!("../../designs/paper-gripper.toml");

/// A folder with the paper's gripper, in which some text is replaced.
fn folder(changes: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let spec = changes.iter().fold(GRIPPER.to_owned(), |spec, (old, new)| {
        assert!(spec.contains(old), "{old}: {spec}");
        spec.replace(old, new)
    });
    fs::write(folder.path().join("star.toml"), spec).expect("written");
    folder
}

fn with_zone(dir: &Path, zone: &str, args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_stargrip-cam"));
    command.current_dir(dir).env("TZ", zone).args(args).output().expect("it runs")
}

/// The lines of both streams, as a terminal shows them.
fn screen(output: &Output) -> Vec<String> {
    let both = stdout(output) + &stderr(output);
    both.lines().map(str::to_owned).collect()
}

#[test]
fn the_answer_comes_first_and_fits_a_screen() {
    let folder = folder(&[]);
    for command in ["check", "build"] {
        let output = run(folder.path(), &[command, "star.toml"]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let said = stdout(&output);
        let lines: Vec<&str> = said.lines().collect();
        assert_eq!(lines[0], "paper gripper, three stars");
        assert_eq!(
            lines[1],
            "3 equal stars: 5 points, inner radius 50 mm, tube width 30 mm, tip angle 30 deg"
        );
        // The computed shells were opened to at most 40 mm.
        let (verdict, end) =
            ("holds the object with ", ", 80 mm across, at 37 kPa; with a friction of 0.3 it carries ");
        assert!(lines[2].starts_with(verdict) && lines[2].contains(end), "{said}");
        assert!(screen(&output).len() <= 20, "{command}: {:#?}", screen(&output));
        for symbol in ["rho_0", "phi_i0", " W ", "p W"] {
            assert!(!lines.iter().any(|line| line.contains(symbol)), "{symbol}: {said}");
        }
    }
}

#[test]
fn what_to_look_at_and_what_to_run_is_there() {
    let folder = folder(&[]);
    let said = stdout(&run(folder.path(), &["build", "star.toml"]));
    let beside = |label: &str| {
        said.lines().find_map(|line| line.strip_prefix(label)).map(str::trim).unwrap_or_default()
    };
    let picture = folder.path().join(beside("look at"));
    assert!(picture.is_file(), "{said}");
    let run = beside("run");
    assert!(run.starts_with("star-1-trace.gcode first"), "{said}");
    for name in run.split([' ', ',', ';']).filter(|word| word.rsplit('.').next() == Some("gcode")) {
        assert!(folder.path().join("out/star").join(name).is_file(), "{name}");
    }
}

#[test]
fn nothing_is_said_twice() {
    let folder = folder(&[("[star]", "[fabric]\nseal_strength = \"1 N/mm\"\n[star]"), ("80 mm", "120 mm")]);
    for args in [&["check", "star.toml", "--anyway"][..], &["build", "star.toml", "--anyway"]] {
        let output = run(folder.path(), args);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let lines = screen(&output);
        for (i, line) in lines.iter().enumerate() {
            assert!(!lines[..i].contains(line), "{line}");
        }
        let heard = stderr(&output);
        for words in ["does not enter", "burst", "generic profile"] {
            assert_eq!(heard.matches(words).count(), 1, "{words}: {heard}");
        }
    }
}

#[test]
fn what_to_see_to_goes_to_standard_error_and_the_rest_does_not() {
    let folder = folder(&[]);
    let output = run(folder.path(), &["check", "star.toml"]);
    let (said, heard) = (stdout(&output), stderr(&output));
    assert!(heard.starts_with("before you seal\n  - ") && !said.contains("before you seal"), "{heard}");
    for words in
        ["generic profile: speed, pause and reach are not checked", "the seal must withstand 4.73 N/mm"]
    {
        assert!(heard.contains(words) && !said.contains(words), "{words}: {heard}");
    }
    assert!(!heard.contains('\u{1b}') && !said.contains('\u{1b}'), "no terminal, no colours");
}

#[test]
fn a_quiet_command_says_nothing_and_does_its_work() {
    let folder = folder(&[]);
    for args in [&["check", "star.toml", "-q"][..], &["build", "star.toml", "--quiet"]] {
        let output = run(folder.path(), args);
        assert_eq!((output.status.code(), screen(&output)), (Some(0), vec![]));
    }
    assert!(folder.path().join("out/star/manifest.json").is_file());
    fs::write(folder.path().join("star.toml"), GRIPPER.replace("points = 5", "points = 9")).expect("written");
    let refused = run(folder.path(), &["check", "star.toml", "-q"]);
    assert!(
        refused.status.code() == Some(1) && stderr(&refused).contains("error[no-arm]"),
        "{}",
        stderr(&refused)
    );
}

#[test]
fn the_same_for_programs() {
    let folder = folder(&[]);
    for command in ["check", "build"] {
        let output = run(folder.path(), &[command, "star.toml", "--json"]);
        let json: serde_json::Value = serde_json::from_slice(&output.stdout).expect("one object");
        assert_eq!(stderr(&output), "");
        assert_eq!((&json["verdict"]["holds"], &json["stars"]), (&true.into(), &3.into()));
        assert!(json["sealing_time_s"].as_f64().is_some_and(|seconds| seconds > 3600.0), "{json}");
        let [texts, codes] =
            ["before_you_seal", "before_you_seal_codes"].map(|key| json[key].as_array().expect("a list"));
        assert!(texts.len() > 1 && texts.len() == codes.len(), "{json}");
        assert!(
            codes.iter().all(|code| *code != "unfit") && codes.contains(&"generic-machine".into()),
            "{codes:?}"
        );
        let force = json["prediction"]["object_force_N"].as_f64().expect("a force");
        assert!(force > 20.0 && force < 40.0, "{force}");
        let run: Vec<&str> = json["written"]["run"]
            .as_array()
            .into_iter()
            .flatten()
            .filter_map(|name| name.as_str())
            .collect();
        assert_eq!(run.len(), if command == "build" { 6 } else { 0 });
        assert!(run.iter().all(|name| folder.path().join("out/star").join(name).is_file()));
    }
}

/// Times of day are in the local zone, with the weekday, and in no file.
#[test]
fn the_end_is_told_in_local_time() {
    let folder = folder(&[]);
    for (zone, name) in [("XYZ-5:30", "XYZ"), ("UTC0", "UTC")] {
        let said = stdout(&with_zone(folder.path(), zone, &["build", "star.toml"]));
        let (_, end) = said.split_once("started now, it ends ").unwrap_or_else(|| panic!("{said}"));
        let end = end.split(',').next().expect("a part");
        let days = ["Monday", "Tuesday", "Wednesday", "Thursday", "Friday", "Saturday", "Sunday", "today"];
        assert!(days.iter().any(|day| end.starts_with(day)) && end.ends_with(name), "{end}");
    }
    for entry in fs::read_dir(folder.path().join("out/star")).expect("published") {
        let bytes = fs::read(entry.expect("an entry").path()).expect("a file");
        assert!(!String::from_utf8_lossy(&bytes).contains("day at "));
    }
}

/// A message has found, allowed and remedy, and nothing is written; a gripper accepted with `--anyway` is proven like every other.
#[test]
fn a_gripper_that_cannot_do_what_it_is_for_is_refused() {
    let object = |mm: &str| format!("object_diameter = \"{mm}\"");
    for (old, new, code, words) in [
        (
            "object_diameter = \"80 mm\"",
            object("98 mm"),
            "object-too-wide",
            "at most 94 mm across, or an inner_radius of at least 54.45 mm",
        ),
        ("object_diameter = \"80 mm\"", object("10 mm"), "object-too-thin", "a smaller inner_radius"),
        ("friction = 0.3", "friction = 0.3\nmass = \"20 kg\"".to_owned(), "too-heavy", "a mass of at most"),
        ("friction = 0.3", "largest_force = \"3 N\"".to_owned(), "too-hard", "or less pressure"),
        ("37 kPa", "3700 kPa".to_owned(), "outside-models", "did you mean 37 kPa?"),
        (
            "[star]",
            "[fabric]\nseal_strength = \"3 N/mm\"\n[star]".to_owned(),
            "bursts",
            "kPa, or tip_radius and corner_radius of at least",
        ),
    ] {
        let folder = folder(&[(old, &new)]);
        for command in ["check", "build"] {
            let refused = run(folder.path(), &[command, "star.toml"]);
            let heard = stderr(&refused);
            assert_eq!((refused.status.code(), stdout(&refused).as_str()), (Some(1), ""), "{heard}");
            assert_eq!(heard.matches("error[").count(), 1, "{heard}");
            assert!(
                heard.contains(&format!("error[{code}]"))
                    && heard.contains(words)
                    && heard.contains("--anyway"),
                "{heard}"
            );
        }
        assert!(!folder.path().join("out").exists());
        let built = run(folder.path(), &["build", "star.toml", "--anyway"]);
        assert_eq!(built.status.code(), Some(0), "{}", stderr(&built));
        assert_eq!(run(folder.path(), &["verify", "out/star"]).status.code(), Some(0));
    }
}

#[test]
fn every_shipped_design_does_what_it_is_for() {
    let designs = Path::new(env!("CARGO_MANIFEST_DIR")).join("designs");
    let drawn = fs::read_dir(designs.join("drawings")).expect("designs/drawings/");
    let paths =
        fs::read_dir(designs).expect("designs/").chain(drawn).map(|entry| entry.expect("an entry").path());
    for path in paths.filter(|path| path.extension().is_some_and(|ending| ending == "toml")) {
        let output = run(Path::new("."), &["check", "-q", path.to_str().expect("a path")]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    }
}

/// A folder with the paper's gripper, and a filled-in table of a peel test.
fn bench() -> tempfile::TempDir {
    let folder = folder(&[]);
    let peel = [1, 2, 3].map(|strip| format!("{strip},200,0.1,-0.3,{},\n", 74 + strip)).concat();
    let head = "strip,temperature_C,speed_mm_s,height_mm,peel_N,failure\n";
    fs::write(folder.path().join("results.csv"), head.to_owned() + &peel).expect("written");
    folder
}

/// Runs a command that must succeed with empty standard error; returns its standard output.
#[track_caller]
fn json(folder: &Path, args: &[&str]) -> serde_json::Value {
    let json: serde_json::Value =
        serde_json::from_str(&done_silently(folder, &[args, &["--json"]].concat())).expect("one object");
    assert!(json.is_object(), "{args:?}");
    json
}

#[test]
fn short_answers_are_for_programs_too_or_for_nobody() {
    let folder = bench();
    let here = folder.path();
    assert_eq!(done_silently(here, &["build", "star.toml", "-q"]), "");
    let job = "out/star/star-1-seal.gcode";
    for args in [
        &["verify", "out/star"][..],
        &["resume", job, "--at", "37%", "-o", "again.gcode"],
        &["feedcheck", "star.toml", "-o", "again.gcode"],
        &["coupon", "star.toml", "-o", "again"],
        &["calibrate", "results.csv", "--needed", "1 N/mm"],
        &["predict", "star.toml"],
        &["explain", "no-arm"],
        &["new", "again"],
        &ACTUATOR,
    ] {
        assert_eq!(done_silently(here, &[args, &["-q"]].concat()), "", "{args:?}");
        let _ = fs::remove_file(here.join("again.gcode"));
    }
    let check = json(here, &["feedcheck", "star.toml"]);
    assert_eq!(
        (&check["wrote"], check["line_time_s"].as_f64().map(f64::round)),
        (&"feedcheck.gcode".into(), Some(100.0))
    );
    let resumed = json(here, &["resume", job, "--at", "37%", "-o", "rest.gcode"]);
    assert_eq!((&resumed["wrote"], &resumed["named_in_manifest"]), (&"rest.gcode".into(), &true.into()));
    assert!(json(here, &["verify", "out/star"])["findings"].as_array().is_some_and(Vec::is_empty));
    assert!(json(here, &["predict", "star.toml"])["object_force_N"].as_f64() > Some(10.0));
    assert!(json(here, &ACTUATOR)["angle_deg"].as_f64() < Some(60.0));
    assert_eq!(json(here, &["explain", "no-arm"])["code"], "no-arm");
    assert!(json(here, &["explain"])["codes"].as_array().is_some_and(|codes| codes.len() > 50));
    let new = json(here, &["new", "another"]);
    assert_eq!((&new["wrote"], &new["verdict"]), (&"another.toml".into(), &serde_json::Value::Null));
}

#[test]
fn what_was_measured_and_what_was_written_is_for_programs_too() {
    let folder = bench();
    let here = folder.path();
    let coupons = json(here, &["coupon", "star.toml", "--speeds", "0.5 mm/s", "--repeats", "2"]);
    assert_eq!((&coupons["strips"], &coupons["speeds_mm_s"][0]), (&2.into(), &0.5.into()));
    for list in ["programs", "drawings"] {
        let names = coupons[list].as_array().expect("a list");
        assert!(names.iter().all(|name| here.join("coupons").join(name.as_str().expect("a name")).is_file()));
    }
    let calibration = json(here, &["calibrate", "results.csv", "--needed", "1 N/mm"]);
    // 76 N over 25 mm, less twice 1 N over 25 mm.
    for (key, value) in [("mean_N_mm", 3.04), ("holds_N_mm", 2.96), ("deviation_N_mm", 0.04)] {
        let said = calibration["chosen"][key].as_f64().expect(key);
        assert!((said - value).abs() < 1e-9, "{key}: {said}");
    }
    let asked = run(here, &["calibrate", "results.csv", "--json"]);
    let asked_json: serde_json::Value = serde_json::from_slice(&asked.stdout).expect("one object");
    assert_eq!((asked.status.code(), &asked_json["chosen"]), (Some(1), &serde_json::Value::Null));
    assert_eq!(asked_json["settings"].as_array().map(Vec::len), Some(1));
    let machines = json(here, &["machines"]);
    let machines = machines["machines"].as_array().expect("a list");
    assert!(machines.iter().any(|machine| machine["name"] == "grbl"));
    // The speed of Marlin is the one that `check` refuses.
    let text = format!("{}[machine]\nprofile = \"marlin\"\n", crate::support::PAPER);
    let dir = tempfile::tempdir().expect("a directory");
    fs::write(dir.path().join("marlin.toml"), text).expect("written");
    let refused = stdout(&run(dir.path(), &["check", "marlin.toml", "--json"]));
    let refused: serde_json::Value = serde_json::from_str(&refused).expect("one object");
    let refused = refused["refused"][0]["found"].as_str().expect("text");
    let runs = &refused[refused.find("up to").expect("a speed")..];
    let marlin = machines.iter().find(|machine| machine["name"] == "marlin").expect("built in");
    assert!(marlin["ability"].as_str().is_some_and(|ability| ability.contains(runs)), "{runs}: {marlin}");
    assert_eq!(done_silently(here, &["machines", "-q"]).lines().count(), machines.len());
    assert_eq!(run(here, &["machines", "--json", "show", "grbl"]).status.code(), Some(2));
}

#[test]
fn a_search_is_for_programs_too_and_its_spec_alone_for_the_quiet() {
    let folder = bench();
    let here = folder.path();
    let optimize = ["optimize", "star.toml", "--points", "5", "--tube-width", "25 mm", "--goal", "fabric"];
    let spec = done_silently(here, &[&optimize[..], &["-q"]].concat());
    assert!(!spec.contains("designs computed") && spec.contains("tube_width = \"25 mm\""), "{spec}");
    assert!(done_silently(here, &optimize).contains(&spec));
    let found = json(here, &optimize);
    assert_eq!((&found["spec"], &found["best"][0]["tube_width_mm"]), (&spec.into(), &25.0.into()));
    assert!(found["best"][0]["short"].as_array().is_some_and(Vec::is_empty), "{found}");
    let none = run(here, &[&optimize[..], &["--payload", "1000", "--json"]].concat());
    let found: serde_json::Value = serde_json::from_slice(&none.stdout).expect("one object");
    assert_eq!((none.status.code(), &found["spec"]), (Some(1), &serde_json::Value::Null));
    assert_eq!(stderr(&none), "", "whoever reads JSON reads nothing else");
    let why = found["refused"][0]["found"].as_str().expect("why");
    assert!(why.starts_with("no design meets all constraints"), "{why}");
}
