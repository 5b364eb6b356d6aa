//! Output for editors and shells: the schema, explanations, completions, manual pages; specs from a pipe, several at once, rebuilt when
//! saved; and the user's defaults in a new spec.

use crate::support;
use crate::support::program::{done, run, run_with_settings, stderr, stdout, workshop};
use stargrip_cam::design::RefusalCode;
use stargrip_cam::pipeline::{CommandCode, PrecautionCode};
use stargrip_cam::spec::{Code, FaultCode};
use stargrip_cam::verify::FindingCode;
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

/// Runs the program with `text` on its standard input, and the environment's directory for settings at `config`.
fn fed(dir: &Path, text: &str, args: &[&str]) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_stargrip-cam"))
        .current_dir(dir)
        .args(args)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    child.stdin.take().expect("a pipe").write_all(text.as_bytes()).expect("it is read");
    child.wait_with_output().expect("it ends")
}

#[test]
fn a_new_spec_names_the_schema_that_lies_beside_it() {
    let dir = tempfile::tempdir().expect("a directory");
    let _ = done(dir.path(), &["new", "wine-bottle.toml"]);
    let spec = fs::read_to_string(dir.path().join("wine-bottle.toml")).expect("written");
    let named = spec.lines().next().and_then(|line| line.strip_prefix("#:schema ")).expect("a directive");
    let schema = fs::read_to_string(dir.path().join(named)).expect("beside it");
    assert_eq!(schema, done(dir.path(), &["schema"]));
    assert!(spec.contains("name = \"wine-bottle\""), "{spec}");
    // An existing schema is kept.
    fs::write(dir.path().join(named), "{}").expect("written");
    let _ = done(dir.path(), &["new", "egg"]);
    assert_eq!(fs::read_to_string(dir.path().join(named)).expect("kept"), "{}");
}

#[test]
fn every_code_is_explained_and_a_misspelt_one_is_found() {
    let dir = tempfile::tempdir().expect("a directory");
    let all = done(dir.path(), &["explain"]);
    let lines = |code: &str| all.lines().filter(|line| line.split(' ').next() == Some(code)).count();
    let mut number = 0;
    let mut there = |code: &str, meaning: &str| {
        number += 1;
        assert!(lines(code) >= 1 && all.contains(meaning), "{code}");
    };
    for code in FaultCode::ALL {
        there(code.as_str(), code.meaning());
    }
    for code in RefusalCode::ALL {
        there(code.as_str(), code.meaning());
    }
    for code in FindingCode::ALL {
        there(code.as_str(), code.meaning());
    }
    for code in PrecautionCode::ALL {
        there(code.as_str(), code.meaning());
    }
    for code in CommandCode::ALL {
        there(code.as_str(), code.meaning());
    }
    assert_eq!(all.lines().count(), number, "none else");
    for word in ["no-arm", "error[no-arm]"] {
        let said = done(dir.path(), &["explain", word]);
        assert!(said.contains(RefusalCode::NoArm.meaning()) && said.starts_with("no-arm ("), "{said}");
    }
    let refused = run(dir.path(), &["explain", "no-amr"]);
    assert_eq!(refused.status.code(), Some(1));
    assert!(stderr(&refused).contains("did you mean no-arm?"), "{}", stderr(&refused));
}

#[test]
fn shells_and_manuals_know_every_command() {
    let dir = tempfile::tempdir().expect("a directory");
    let help = done(dir.path(), &["--help"]);
    let (_, groups) = help.split_once("Design:\n").expect("groups");
    let (groups, _) = groups.split_once("Options:\n").expect("options");
    let commands: Vec<&str> = groups
        .lines()
        .filter_map(|line| line.strip_prefix("  "))
        .filter_map(|line| line.split(' ').next())
        .collect();
    assert!(!commands.contains(&"sweep"), "an old word");
    assert!(commands.len() > 15, "{commands:?}");
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = done(dir.path(), &["completions", shell]);
        for command in &commands {
            assert!(script.contains(command), "{shell}: {command}");
        }
    }
    assert!(done(dir.path(), &["man"]).starts_with(".ie"));
    assert!(done(dir.path(), &["man", "build"]).contains("\\-\\-anyway"));
    assert_eq!(run(dir.path(), &["man", "brew"]).status.code(), Some(1));
    let _ = done(dir.path(), &["man", "--dir", "man1"]);
    for command in commands.iter().filter(|command| **command != "help") {
        assert!(dir.path().join(format!("man1/stargrip-cam-{command}.1")).is_file(), "{command}");
    }
    assert!(dir.path().join("man1/stargrip-cam.1").is_file());
}

#[test]
fn a_spec_comes_from_a_pipe() {
    let dir = tempfile::tempdir().expect("a directory");
    let checked = fed(dir.path(), support::PAPER, &["check", "-"]);
    assert_eq!(checked.status.code(), Some(0), "{}", stderr(&checked));
    let refused = fed(dir.path(), &support::PAPER.replace("points = 5", "points = 9"), &["check", "-"]);
    assert!(stderr(&refused).contains("--> standard input:6:"), "{}", stderr(&refused));
    let built = fed(dir.path(), support::PAPER, &["build", "-", "-q", "--only", "seal-svg"]);
    assert_eq!(built.status.code(), Some(0), "{}", stderr(&built));
    let copy = fs::read_to_string(dir.path().join("out/paper-star-5-points/spec.toml")).expect("by its name");
    assert_eq!(copy, support::PAPER);
    // Commands that follow name that copy.
    let said = fed(dir.path(), support::PAPER, &["build", "-", "-o", "made", "--only", "seal-svg"]);
    let told = stdout(&said) + &stderr(&said);
    assert!(told.contains("feedcheck made/spec.toml") && !told.contains("feedcheck -`"), "{told}");
    let said = stdout(&fed(dir.path(), support::PAPER, &["coupon", "-", "-o", "cc", "--only", "strips"]));
    assert!(said.contains("into [load] of cc/spec.toml, then: "), "{said}");
    assert!(said.contains("calibrate cc/results.csv --spec cc/spec.toml\n"), "{said}");
}

#[test]
fn a_design_without_a_latin_name_is_put_where_o_says() {
    let dir = tempfile::tempdir().expect("a directory");
    for name in ["\u{6f22}\u{5b57}", "\u{304b}\u{306a}"] {
        let spec = support::PAPER.replace("paper star, 5 points", name);
        assert!(spec.contains(name));
        let refused = fed(dir.path(), &spec, &["build", "-", "--only", "seal-svg"]);
        let said = stderr(&refused);
        assert_eq!(refused.status.code(), Some(1), "{said}");
        let words =
            format!("the name `{name}` has no letter from a to z and no digit for the name of a directory");
        assert!(said.contains(&words) && said.contains("name one with -o"), "{said}");
        assert!(!dir.path().join("out").exists());
        let built = fed(dir.path(), &spec, &["build", "-", "-q", "--only", "seal-svg", "-o", name]);
        assert_eq!(built.status.code(), Some(0), "{}", stderr(&built));
    }
}

#[test]
fn standard_input_is_read_once() {
    let dir = workshop();
    for args in [
        &["check", "-", "-"][..],
        &["build", "-", "star.toml", "-"],
        &["calibrate", "-", "--spec", "-"],
        &["calibrate", "-", "--bias-strip", "-", "--bias-length", "200 mm", "--spec", "star.toml"],
    ] {
        let refused = run(dir.path(), args);
        let said = stderr(&refused);
        assert_eq!(refused.status.code(), Some(2), "{args:?}: {said}");
        assert!(said.contains("standard input is named 2 times, and can be read once"), "{args:?}: {said}");
    }
}

#[test]
fn of_several_specs_each_has_its_answer() {
    let dir = workshop();
    fs::write(dir.path().join("bad.toml"), support::PAPER.replace("points = 5", "points = 9"))
        .expect("written");
    fs::write(dir.path().join("other.toml"), support::PAPER.replace("\"50 mm\"", "\"55 mm\""))
        .expect("written");
    let output =
        run(dir.path(), &["build", "star.toml", "bad.toml", "other.toml", "--only", "seal-svg", "--json"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(stderr(&output), "", "whoever reads JSON reads nothing else");
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).expect("one object");
    assert_eq!(json["results"].as_array().map(Vec::len), Some(2));
    assert_eq!(
        (&json["refused"][0]["code"], &json["refused"][0]["key"]),
        (&"no-arm".into(), &"star.points".into())
    );
    assert!(dir.path().join("out/star").is_dir() && dir.path().join("out/other").is_dir());
    let both = done(dir.path(), &["check", "star.toml", "other.toml"]);
    assert_eq!(both.matches("sealing ").count(), 2, "{both}");
    fs::create_dir(dir.path().join("b")).expect("made");
    let _ = fs::copy(dir.path().join("other.toml"), dir.path().join("b/star.toml")).expect("copied");
    for args in [
        &["build", "star.toml", "b/star.toml"][..],
        &["build", "star.toml", "other.toml", "-o", "x"],
        &["build"],
    ] {
        assert_eq!(run(dir.path(), args).status.code(), Some(2), "{args:?}");
    }
}

#[test]
fn defaults_of_ones_own_are_in_a_new_spec_and_nowhere_else() {
    let dir = workshop();
    let config = dir.path().join("settings/stargrip-cam");
    fs::create_dir_all(&config).expect("made");
    let sound = "[machine]\nprofile = \"grbl\"\nfeed_floor = \"chop\"\n[sheet]\nwidth = \"400 mm\"\nheight = \"400 mm\"\n";
    fs::write(config.join("config.toml"), sound).expect("written");
    assert_eq!(run_with_settings(dir.path(), &["new", "mine"]).status.code(), Some(0));
    let spec = fs::read_to_string(dir.path().join("mine.toml")).expect("written");
    assert!(spec.contains("\nprofile = \"grbl\" ") && spec.contains("\nwidth = \"400 mm\" "), "{spec}");
    // Without the defaults it has the same meaning.
    let json: serde_json::Value =
        serde_json::from_str(&done(dir.path(), &["check", "mine.toml", "--json"])).expect("JSON");
    assert_eq!(
        (&json["machine"], &json["sheets_mm"][0]),
        (&"grbl".into(), &serde_json::json!([400.0, 400.0]))
    );
    let other: serde_json::Value =
        serde_json::from_slice(&run_with_settings(dir.path(), &["check", "star.toml", "--json"]).stdout)
            .expect("JSON");
    assert_eq!(other["machine"], "generic");
    // A gripper for an object has the profile of the option, and its need of short moves.
    for (machine, is_chopped) in [("grbl", true), ("klipper", false), ("generic", false)] {
        let wish = ["new", machine, "--object", "75 mm", "--mass", "300 g", "--machine", machine];
        let made = run_with_settings(dir.path(), &wish);
        assert_eq!(made.status.code(), Some(0), "{machine}: {}", stderr(&made));
        let spec = fs::read_to_string(dir.path().join(format!("{machine}.toml"))).expect("written");
        assert_eq!(spec.contains("feed_floor"), is_chopped, "{spec}");
    }
    let drawing = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"90mm\" height=\"90mm\" viewBox=\"0 0 90 90\">\
                   <g id=\"air\"><circle cx=\"45\" cy=\"45\" r=\"30\"/></g></svg>";
    fs::write(dir.path().join("pillow.svg"), drawing).expect("written");
    assert_eq!(run_with_settings(dir.path(), &["new", "--drawing", "pillow.svg"]).status.code(), Some(0));
    let spec = fs::read_to_string(dir.path().join("pillow.toml")).expect("written");
    assert!(spec.contains("\nprofile = \"grbl\" ") && spec.contains("\nwidth = \"400 mm\""), "{spec}");
    fs::remove_file(dir.path().join("star.toml")).expect("removed");
    assert_eq!(
        run_with_settings(dir.path(), &["new", "star", "--drawing", "pillow.svg"]).status.code(),
        Some(0)
    );
    assert!(fs::read_to_string(dir.path().join("star.toml")).is_ok_and(|spec| spec.contains("pillow.svg")));
    fs::write(config.join("config.toml"), "[machine]\nprofile = \"grbll\"\n").expect("written");
    for args in [&["new", "other"][..], &["new", "other", "--drawing", "pillow.svg"]] {
        let refused = run_with_settings(dir.path(), args);
        assert!(stderr(&refused).contains("your defaults: \"grbll\" is not a machine profile"), "{args:?}");
        assert!(refused.status.code() == Some(1) && !dir.path().join("other.toml").exists(), "{args:?}");
    }
    fs::write(config.join("config.toml"), "[machin]\n").expect("written");
    let refused = run_with_settings(dir.path(), &["new", "other"]);
    assert_eq!(refused.status.code(), Some(1));
    assert!(
        stderr(&refused).contains("did you mean [machine]?") && !dir.path().join("other.toml").exists(),
        "{}",
        stderr(&refused)
    );
}

/// The files of `make install` and `make dist`: the program writes all of them except itself.
#[cfg(unix)]
#[test]
fn an_installation_is_whole() {
    let dir = tempfile::tempdir().expect("a directory");
    let home = Path::new(env!("CARGO_MANIFEST_DIR"));
    let laid = Command::new(home.join("packaging/lay-out"))
        .current_dir(home)
        .args([env!("CARGO_BIN_EXE_stargrip-cam").as_ref(), dir.path()])
        .output()
        .expect("it runs");
    assert_eq!(laid.status.code(), Some(0), "{}", stderr(&laid));
    for file in [
        "bin/stargrip-cam",
        "share/bash-completion/completions/stargrip-cam",
        "share/zsh/site-functions/_stargrip-cam",
        "share/fish/vendor_completions.d/stargrip-cam.fish",
        "share/man/man1/stargrip-cam-build.1",
        "share/stargrip-cam/stargrip-cam.schema.json",
        "share/doc/stargrip-cam/examples/paper-gripper.toml",
        "share/doc/stargrip-cam/LICENSE-MIT",
    ] {
        assert!(dir.path().join(file).metadata().is_ok_and(|file| file.len() > 100), "{file}");
    }
    let installed = |args: &[&str]| {
        let output = Command::new(dir.path().join("bin/stargrip-cam")).args(args).output().expect("it runs");
        assert_eq!(output.status.code(), Some(0), "{args:?}: {}", stderr(&output));
        stdout(&output)
    };
    assert!(installed(&["--version"]).starts_with("stargrip-cam "));
    let examples = dir.path().join("share/doc/stargrip-cam/examples");
    let folders = [examples.join("drawings"), examples];
    let files = folders.iter().flat_map(|folder| fs::read_dir(folder).expect("examples"));
    let paths = files.map(|file| file.expect("a file").path());
    for spec in paths.filter(|path| path.extension().is_some_and(|ending| ending == "toml")) {
        let _ = installed(&["check", "-q", spec.to_str().expect("a path")]);
    }
    // A shell accepts the completions.
    let script = dir.path().join("share/bash-completion/completions/stargrip-cam");
    let shell = Command::new("bash")
        .args(["-c", "source \"$0\" && complete -p stargrip-cam"])
        .arg(script)
        .output()
        .expect("bash");
    assert!(stdout(&shell).contains("-F"), "{}", stderr(&shell));
}
