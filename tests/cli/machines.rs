//! The commands for the machine as a user runs them: feedcheck, resume, coupon, calibrate.

use std::fs;
use std::path::Path;
use std::process::Output;

use crate::support::program::{done_silently, run, stderr, stdout, workshop};
use serde_json::Value;
use tempfile::TempDir;

use crate::support;

/// A workshop with the paper's star built in out/star.
fn built() -> TempDir {
    let dir = workshop();
    let _ = done_silently(dir.path(), &["build", "star.toml", "-q", "--only", "seal-gcode,trace-gcode"]);
    dir
}

/// A workshop whose machine has a work area of `x` by `y` mm.
fn workshop_of(x: u32, y: u32) -> TempDir {
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

fn read(dir: &Path, name: &str) -> String {
    fs::read_to_string(dir.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Names in a directory, sorted.
fn names(dir: &Path) -> Vec<String> {
    let entries = fs::read_dir(dir).expect("a directory").map(|entry| entry.expect("an entry").file_name());
    let mut names: Vec<String> = entries.map(|name| name.to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

fn json_of(text: &str) -> Value {
    serde_json::from_str(text).expect("one object")
}

/// Runs a command that must fail with `code`, empty standard output and all of `words` on standard error.
#[track_caller]
fn fails(dir: &Path, args: &[&str], code: i32, words: &[&str]) -> Output {
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
fn clamp(width: f64, depth: f64, height: f64) -> String {
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

/// The rest begins with a way that the job does not go.
#[test]
fn resume_keeps_off_the_clamps_of_the_profile() {
    let dir = workshop_of(400, 400);
    let profile = read(dir.path(), "mine.toml") + &clamp(0.5, 300.0, 40.0);
    let clear = profile.replacen("y = \"1 mm\"\nwidth", "y = \"398 mm\"\nwidth", 1);
    assert!(clear != profile);
    fs::write(dir.path().join("mine.toml"), clear).expect("written");
    let _ = done_silently(dir.path(), &["build", "star.toml", "-q", "--only", "seal-gcode"]);
    let (job, rest) = ("out/star/star-1-seal.gcode", "rest.gcode");
    let resume = ["resume", job, "--at", "50%", "-o", rest];
    let answer = done_silently(dir.path(), &resume);
    assert!(answer.contains("the job is unchanged"), "{answer}");
    fs::remove_file(dir.path().join(rest)).expect("there");
    fs::write(dir.path().join("out/star/machine.toml"), &profile).expect("written");
    let words = [
        "error[clamp-in-the-way]",
        "of the program for the rest would be a move at Z30 through the clamp \"vice\"",
    ];
    let _ = fails(dir.path(), &resume, 1, &words);
    assert!(!dir.path().join(rest).exists());
    // As the remedy says.
    let _ = fs::copy(dir.path().join(job), dir.path().join("copy.gcode")).expect("copied");
    let answer = done_silently(dir.path(), &["resume", "copy.gcode", "--at", "50%", "-o", rest]);
    assert!(answer.contains("whether a clamp is in the way, is unknown"), "{answer}");
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

#[test]
fn resume_goes_on_by_line_and_overwrites_nothing() {
    let dir = built();
    let job = "out/star/star-1-seal.gcode";
    let before = read(dir.path(), job);
    let line =
        1 + before.lines().position(|line| line.starts_with("G1") && line.contains("F6")).expect("a seal");
    let line = (line + 20).to_string();
    let answer = done_silently(dir.path(), &["resume", job, "--line", &line]);
    let target = "out/star-star-1-seal-resume.gcode";
    assert!(answer.contains(&format!("wrote {target}")) && answer.contains("same zero"), "{answer}");
    assert!(answer.contains("the job is unchanged: its hash is the one in manifest.json"), "{answer}");
    let resumed = read(dir.path(), target);
    assert!(resumed.contains("resume: from_line=") && resumed.contains("end of program, "), "{resumed}");
    assert_eq!(read(dir.path(), job), before, "the job itself stays as it is");
    let _ = fails(dir.path(), &["verify", job], 1, &["name the directory: out/star"]);
    // Neither the proof nor the next build is disturbed by it.
    let _ = done_silently(dir.path(), &["verify", "out/star"]);

    // Neither the default path nor a given one is overwritten.
    let _ = fails(dir.path(), &["resume", job, "--at", "50%"], 1, &["resume.gcode exists already"]);
    let _ = fails(dir.path(), &["resume", job, "--at", "50%", "-o", job], 1, &["exists already"]);
    assert_eq!(read(dir.path(), target), resumed);
    let inside = ["resume", job, "--at", "50%", "-o", "out/star/rest.gcode"];
    let _ = fails(dir.path(), &inside, 1, &["out/star/rest.gcode is in a published directory", "beside it"]);
    assert!(!dir.path().join("out/star/rest.gcode").exists());
    assert_eq!(read(dir.path(), job), before);
}

#[test]
fn resume_goes_on_by_share_by_time_and_by_place() {
    // Each way to name the place is tried on one program. Then a resumed program is resumed, without a manifest and beside
    // something that is none. A changed job is refused.
    let dir = built();
    let job = "out/star/star-1-seal.gcode";
    let program = read(dir.path(), job);
    let message =
        done_silently(dir.path(), &["resume", job, "--at", "37%", "--overlap", "2 mm", "-o", "at.gcode"]);
    assert!(
        message.contains("37.0 % of the job's time") && message.contains("seals the last 2.0 mm again"),
        "{message}"
    );
    // The same place by the clock.
    let total = program.split("total:").nth(1).and_then(|line| line.split("time_s=").nth(1));
    let total = total.and_then(|rest| rest.split_whitespace().next());
    let minutes = 0.37 / 60.0 * total.and_then(|time| time.parse::<f64>().ok()).expect("a time");
    let time = format!("{} h {:.2} min", (minutes / 60.0).floor(), minutes % 60.0);
    let message = done_silently(dir.path(), &["resume", job, "--at", &time, "-o", "clock.gcode"]);
    let share = message.split("after ").nth(1).and_then(|rest| rest.split_whitespace().next());
    let share: f64 = share.and_then(|share| share.parse().ok()).expect("a percentage");
    assert!((share - 37.0).abs() < 0.5, "{message}");
    let end = program.lines().rev().find(|line| line.starts_with("G1 X")).expect("a move");
    let number = |letter: char| {
        let word = end.split_whitespace().find(|word| word.starts_with(letter));
        word.expect("a coordinate")[1..].to_owned()
    };
    let place = format!("{} mm,{} mm", number('X'), number('Y'));
    let message = done_silently(dir.path(), &["resume", job, "--near", &place, "-o", "near.gcode"]);
    assert!(message.contains("wrote near.gcode"), "{message}");
    // A resumed program can be resumed, although no manifest names it.
    let message = done_silently(dir.path(), &["resume", "at.gcode", "--at", "50%"]);
    assert!(
        dir.path().join("at-resume.gcode").exists() && message.contains("no manifest.json beside"),
        "{message}"
    );
    // A pipe is no manifest, and reading it must not block.
    #[cfg(unix)]
    {
        let made = std::process::Command::new("mkfifo").arg(dir.path().join("manifest.json")).status();
        assert!(made.expect("mkfifo").success());
        let message = done_silently(dir.path(), &["resume", "at.gcode", "--at", "60%", "-o", "piped.gcode"]);
        assert!(message.contains("no manifest.json beside"), "{message}");
    }
    // A job that differs from the manifest beside it is not resumed.
    fs::write(dir.path().join(job), program.replacen("G1 X", "G1  X", 1)).expect("written");
    let _ = fails(
        dir.path(),
        &["resume", job, "--at", "60%"],
        1,
        &["was changed after it was built", "build again"],
    );
}

#[test]
fn resume_tells_wrong_usage_from_places_that_are_not_there() {
    let dir = built();
    let job = "out/star/star-1-seal.gcode";
    let before = names(&dir.path().join("out/star"));
    for (args, words) in [
        (&[][..], "--line"),
        (&["--line", "5", "--at", "5%"], "cannot be used with"),
        (&["--line", "x"], "invalid"),
        (&["--line=-1"], "invalid"),
        (&["--at", "100.1%"], "from 0 to 100"),
        (&["--at", "nan"], "from 0 to 100"),
        (&["--at=-1"], "from 0 to 100"),
        (&["--at", "5"], "such as 37%"),
        (&["--at", "1 h 20"], "or a time"),
        (&["--at", "-1 h"], "or a time"),
        (&["--near", "5,5"], "two lengths"),
        (&["--near", "5"], "two lengths"),
        (&["--near", "5,inf"], "two lengths"),
        (&["--near", "5,6,7"], "two lengths"),
        (&["--near", "5 mm,6 kg"], "two lengths"),
        (&["--at", "5%", "--overlap", "5"], "with its unit"),
        (&["--at", "5%", "--overlap", "2 m"], "up to 1 m"),
        (&["--at", "5%", "--overlap", "0 mm"], "above 0"),
        (&["--at", "-5%"], "from 0 to 100"),
        (&["--line", "-3"], "invalid value '-3'"),
    ] {
        let _ = fails(dir.path(), &[&["resume", job][..], args].concat(), 2, &[words]);
    }
    let _ = fails(dir.path(), &["resume", job, "--line", "0"], 1, &["there is no line 0: the file has 1 to"]);
    let _ = fails(dir.path(), &["resume", job, "--line", "999999999"], 1, &["there is no line 999999999"]);
    let _ = fails(
        dir.path(),
        &["resume", job, "--near=-500 mm,0 mm"],
        1,
        &["no seam passes there", "mm away", "give"],
    );
    let last = read(dir.path(), job).lines().count().to_string();
    let _ = fails(dir.path(), &["resume", job, "--line", &last], 1, &["nothing is left"]);
    let _ = fails(dir.path(), &["resume", job, "--at", "100%"], 1, &["nothing is left"]);
    let refused = run(dir.path(), &["resume", job, "--at", "100%", "--json"]);
    assert!(stdout(&refused).contains("\"refused\""), "one object on standard output");
    assert_eq!(names(&dir.path().join("out/star")), before);
}

#[test]
fn resume_refuses_what_is_not_ours_or_is_damaged() {
    let dir = built();
    let job = read(dir.path(), "out/star/star-1-seal.gcode");
    // Strokes of zero length would never end.
    let strokes = "; chop: feed_mm_min=60 longest_mm=0\n; chop-rest: acceleration_mm_s2=1 step_s=1\n; seal:";
    let forged = job.replacen("; seal:", strokes, 1);
    assert!(forged != job);
    for (name, bytes, word) in [
        ("empty.gcode", &b""[..], "not a sealing program of stargrip-cam"),
        ("other.gcode", b"G28\nG1 X5 F100\n", "build it again"),
        ("binary.gcode", b"\x00\xff\xfe", "UTF-8"),
        ("half.gcode", &job.as_bytes()[..job.len() / 2], "damaged"),
        ("wild.gcode", job.replacen("G1 X", "G1 Q", 1).as_bytes(), "damaged"),
        ("forged.gcode", forged.as_bytes(), "no comment \"chop: ...\""),
    ] {
        fs::write(dir.path().join(name), bytes).expect("written");
        let _ = fails(dir.path(), &["resume", name, "--at", "20%"], 1, &[name, word]);
    }
    let _ = fails(
        dir.path(),
        &["resume", "out/star/star-1-trace.gcode", "--at", "20%"],
        1,
        &["seals nothing", "star-1-seal.gcode"],
    );
    let _ = fails(dir.path(), &["resume", "missing.gcode", "--at", "20%"], 1, &["cannot read missing.gcode"]);
    let _ = fails(dir.path(), &["resume", "out", "--at", "20%"], 1, &["out is a directory: name"]);
    fs::File::create(dir.path().join("huge.gcode")).and_then(|file| file.set_len(300 << 20)).expect("a hole");
    let _ = fails(dir.path(), &["resume", "huge.gcode", "--at", "20%"], 1, &["at most 256 MiB"]);
    let _ = fails(dir.path(), &["calibrate", "huge.gcode", "--needed", "1 N/mm"], 1, &["at most 16 MiB"]);
    assert!(!names(dir.path()).iter().any(|name| name.ends_with("-resume.gcode")));
}

#[test]
fn coupon_writes_programs_numbered_drawings_and_a_table() {
    let dir = workshop();
    let args = ["coupon", "star.toml", "--temperatures", "180 C,200 C", "--speeds", "0.5 mm/s"];
    let answer = done_silently(dir.path(), &args);
    assert_eq!(
        names(&dir.path().join("coupons")),
        [
            "burst.gcode",
            "burst.svg",
            "disc.gcode",
            "disc.svg",
            "machine.toml",
            "manifest.json",
            "results.csv",
            "spec.toml",
            "strips-180C-500um-s.gcode",
            "strips-180C-500um-s.svg",
            "strips-200C-500um-s.gcode",
            "strips-200C-500um-s.svg",
            "strips.svg",
            "v-actuator.gcode",
            "v-actuator.svg",
        ]
    );
    assert!(answer.starts_with("wrote 5 programs and 6 drawings to coupons\n"), "{answer}");
    assert!(
        answer.contains("look at coupons/strips.svg") && answer.contains("calibrate coupons/results.csv"),
        "{answer}"
    );
    let table = read(dir.path(), "coupons/results.csv");
    assert_eq!(table.lines().count(), 1 + 6);
    assert!(
        table.starts_with("strip,temperature_C,speed_mm_s,height_mm,peel_N,failure\n1,180,0.5,"),
        "{table}"
    );
    for (name, seams) in [("strips-180C-500um-s", 3), ("disc", 1), ("burst", 5)] {
        let drawing = read(dir.path(), &format!("coupons/{name}.svg"));
        let document = roxmltree::Document::parse(&drawing).expect("XML");
        let count = |id: &str| {
            let group = document.descendants().find(|node| node.attribute("id") == Some(id));
            group.expect(id).children().filter(roxmltree::Node::is_element).count()
        };
        assert_eq!(count("seal-outer"), seams, "{name}");
        assert!(count("label") >= seams, "{name}");
    }
    // The directory must always be a new one.
    let before = names(&dir.path().join("coupons"));
    let _ = fails(dir.path(), &args, 1, &["coupons exists already; choose another name"]);
    assert_eq!(names(&dir.path().join("coupons")), before);
    let answer = done_silently(dir.path(), &["coupon", "star.toml", "-o", "again", "--repeats", "1", "-v"]);
    for name in names(&dir.path().join("again")) {
        assert!(answer.contains(&format!("again/{name}")), "{name}: {answer}");
    }
    let _ = fails(dir.path(), &["coupon", "star.toml", "-o", "no/where"], 1, &["cannot create no/where"]);
}

#[test]
fn coupons_are_proven_as_builds_are() {
    let dir = workshop();
    let answer = done_silently(
        dir.path(),
        &["coupon", "star.toml", "--only", "disc,strips", "--speeds", "0.5 mm/s", "--json"],
    );
    let json = json_of(&answer);
    assert_eq!(json["programs"], serde_json::json!(["strips-200C-500um-s.gcode", "disc.gcode"]));
    assert_eq!(json["times"][1]["program"], "disc.gcode");
    assert!(json["times"][1]["time_s"].as_f64().is_some_and(|time| time > 3600.0), "{json}");
    let found = names(&dir.path().join("coupons"));
    assert!(!found.iter().any(|name| name.starts_with("burst") || name.starts_with("v-")), "{found:?}");
    let manifest = json_of(&read(dir.path(), "coupons/manifest.json"));
    assert_eq!(manifest["pieces"][1]["name"], "disc");
    assert_eq!(manifest["pieces"][1]["seams"][0]["name"], "disc");
    let verify = |code: i32| {
        let output = run(dir.path(), &["verify", "coupons"]);
        assert_eq!(output.status.code(), Some(code), "{}\n{}", stdout(&output), stderr(&output));
        stdout(&output)
    };
    assert!(verify(0).contains("proven, no findings"));
    // The user may edit the table.
    let table = dir.path().join("coupons/results.csv");
    fs::write(&table, fs::read_to_string(&table).expect("it").replace(",,", ",82,")).expect("written");
    let _ = verify(0);
    // A change of a program is found at its line, and one of a drawing or of the profile's lines in its file.
    for (name, from, to, word) in [
        ("disc.gcode", " F6\n", " F600\n", "wrong-feed"),
        ("disc.gcode", "; set the iron to 200 C", "; set the iron to 400 C", "other-comment"),
        (
            "strips-200C-500um-s.gcode",
            "; seam: seam=2 piece=strip-2",
            "; seam: seam=2 piece=strip-3",
            "other-comment",
        ),
        ("disc.svg", "<path", "<path ", "differs"),
        ("machine.toml", "\"M2\"", "\"M30\"", "differs"),
        ("manifest.json", "\"time_s\": ", "\"time_s\": 1", "differs"),
    ] {
        let path = dir.path().join("coupons").join(name);
        let good = fs::read_to_string(&path).expect("it");
        assert!(good.contains(from), "{name}: {from}");
        fs::write(&path, good.replacen(from, to, 1)).expect("written");
        let answer = verify(1);
        assert!(answer.contains(name) && answer.contains(word), "{name}: {answer}");
        fs::write(&path, good).expect("written");
    }
    let _ = verify(0);
    fs::remove_file(dir.path().join("coupons/disc.svg")).expect("removed");
    assert!(verify(1).contains("missing-file"));
    let _ = fails(
        dir.path(),
        &["coupon", "star.toml", "--only", "discs"],
        2,
        &["strips, disc, v-actuator, burst"],
    );
}

#[test]
fn a_hose_that_fits_no_coupon_is_refused() {
    let dir = workshop();
    let spec = format!("{}\n[inlet]\ntube_diameter = \"25 mm\"\n", support::PAPER);
    fs::write(dir.path().join("star.toml"), spec).expect("written");
    let _ = fails(
        dir.path(),
        &["coupon", "star.toml", "--only", "v-actuator"],
        1,
        &["inlet-meets-arm", "no room on the V-actuator", "tube_diameter", "other coupons only"],
    );
    assert_eq!(names(dir.path()), ["star.toml"]);
}

#[test]
fn coupon_refuses_bad_settings_and_writes_nothing() {
    let dir = workshop();
    for (args, code, words) in [
        (["--temperatures", "300 C"], 2, "the temperature must be more than 40 C and less than 300 C"),
        (["--temperatures", "nan C"], 2, "write the temperature as a number and one of C"),
        (["--temperatures", "200"], 2, "write the temperature as a number and one of C"),
        (
            ["--temperatures", "180 C,180 C"],
            1,
            "cannot be told apart; temperatures must differ by at least 1 C",
        ),
        (["--temperatures", "180.1 C,180.3 C"], 1, "--repeats"),
        (["--speeds", "0 mm/s"], 2, "must be at least 0.001 mm/s and at most 1000 mm/s"),
        (["--speeds", "0.1 mm/s,0.1001 mm/s"], 1, "at least 0.001 mm/s"),
        (["--heights", "0.5 mm"], 2, "must be at least -20 mm and at most 0 mm"),
        (["--heights", "-21 mm"], 2, "must be at least -20 mm"),
        (["--repeats", "0"], 2, "1..=20"),
        (["--repeats", "21"], 2, "1..=20"),
    ] {
        let _ = fails(dir.path(), &[&["coupon", "star.toml"][..], &args].concat(), code, &[words]);
    }
    // Without options the grid is the spec's: strips that `calibrate` would refuse are not sealed.
    let cold = read(dir.path(), "star.toml") + "\n[seal]\ntemperature = \"30 C\"\n";
    fs::write(dir.path().join("cold.toml"), cold).expect("written");
    let words = ["a temperature of 30 C; it must be more than 40 C and less than 300 C"];
    let _ = fails(dir.path(), &["coupon", "cold.toml"], 1, &words);
    fs::remove_file(dir.path().join("cold.toml")).expect("removed");
    // A disc is sealed once.
    let disc = ["coupon", "star.toml", "--only", "disc", "--repeats", "5"];
    let _ = fails(dir.path(), &disc, 2, &["--repeats is for strips"]);
    assert_eq!(names(dir.path()), ["star.toml"]);
}

/// A drawing has no tips: the other kinds are made, and the set is never empty.
#[test]
fn coupons_of_a_drawing_have_no_v_actuator() {
    let dir = workshop();
    let _ = done_silently(dir.path(), &["coupon", "star.toml", "-o", "stars", "--only", "v-actuator", "-q"]);
    let cushion = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"90mm\" height=\"90mm\" viewBox=\"0 0 90 90\">\
                   <g id=\"air\"><path d=\"M 20 20 H 70 V 70 H 20 Z\"/></g><g id=\"port\"><path d=\"M 16 45 H 24\"/></g></svg>";
    fs::write(dir.path().join("d.svg"), cushion).expect("written");
    let _ = done_silently(dir.path(), &["new", "d", "--drawing", "d.svg"]);
    for only in ["v-actuator", "disc,v-actuator"] {
        let _ =
            fails(dir.path(), &["coupon", "d.toml", "--only", only], 1, &["leave v-actuator out of --only"]);
    }
    assert!(!dir.path().join("coupons").exists());
    let _ = done_silently(dir.path(), &["coupon", "d.toml", "--only", "disc", "-q"]);
}

#[test]
fn coupons_do_not_press_a_rigid_tip_into_the_bed() {
    let dir = workshop_of(300, 300);
    let profile = read(dir.path(), "mine.toml")
        .replacen("spring_loaded = true", "spring_loaded = false", 1)
        .replacen("contact = \"-0.3 mm\"", "contact = \"0 mm\"", 1);
    fs::write(dir.path().join("mine.toml"), profile).expect("written");
    let strips = ["coupon", "star.toml", "--only", "strips", "--heights"];
    let low = [&strips[..], &["-0.5 mm"]].concat();
    let words = [
        "a height of -0.5 mm; it must be 0 mm for the profile's tip without a spring",
        "`spring_loaded = true`",
    ];
    let _ = fails(dir.path(), &low, 1, &words);
    let answer = done_silently(dir.path(), &["coupon", "star.toml", "--only", "disc"]);
    assert!(answer.contains("wrote 1 program and 1 drawing to coupons"), "{answer}");
}

#[test]
fn coupons_stay_within_the_work_area() {
    // A bed of 220 mm takes four strips in a row, and all the pouches.
    let small = workshop_of(220, 220);
    let _ = done_silently(small.path(), &["coupon", "star.toml", "--repeats", "2"]);
    for name in names(&small.path().join("coupons")).iter().filter(|name| name.contains(".gcode")) {
        for word in read(small.path(), &format!("coupons/{name}"))
            .lines()
            .filter(|line| line.starts_with('G'))
            .flat_map(str::split_whitespace)
        {
            if word.starts_with(['X', 'Y']) {
                let at: f64 = word[1..].parse().expect("a number");
                assert!((0.0..=220.0).contains(&at), "{name}: {word}");
            }
        }
    }
    let words = [
        "the coupon strips-200C-",
        "the machine reaches 0 to 220.0 mm, 0 to 220.0 mm",
        "repeats",
        "[work_area]",
    ];
    let _ = fails(small.path(), &["coupon", "star.toml", "-o", "more", "--repeats", "10"], 1, &words);
    assert!(!small.path().join("more").exists());
    let tiny = workshop_of(100, 100);
    let _ = fails(
        tiny.path(),
        &["coupon", "star.toml", "--speeds", "1 mm/s", "--repeats", "1"],
        1,
        &["coupon disc needs X"],
    );
    assert!(!tiny.path().join("coupons").exists());
}

const HEAD: &str = "strip,temperature_C,speed_mm_s,height_mm,peel_N,failure\n";

/// A table in which each setting (speed) has these peel forces.
fn table(settings: &[(f64, &[f64])]) -> String {
    let rows = settings.iter().flat_map(|(speed, peels)| peels.iter().map(move |peel| (speed, peel)));
    let rows = rows.zip(1..).map(|((speed, peel), i)| format!("{i},200,{speed},-0.3,{peel},\n"));
    HEAD.to_owned() + &rows.collect::<String>()
}

fn calibration(text: &str) -> TempDir {
    let dir = tempfile::tempdir().expect("a directory");
    fs::write(dir.path().join("results.csv"), text).expect("written");
    dir
}

#[test]
fn calibrate_chooses_the_fastest_that_holds() {
    let dir = calibration(&table(&[(0.1, &[74.0, 75.0, 76.0]), (0.5, &[50.0, 51.0, 49.0])]));
    let answer = done_silently(dir.path(), &["calibrate", "results.csv", "--needed", "1 N/mm"]);
    for words in
        ["[fabric]\nseal_strength = \"1.920 N/mm\"", "speed = \"0.5 mm/s\"", "temperature = \"200 C\""]
    {
        assert!(answer.contains(words), "{words}: {answer}");
    }
    let answer = done_silently(dir.path(), &["calibrate", "results.csv", "--needed", "1.8 N/mm"]);
    assert!(answer.contains("speed = \"0.1 mm/s\""), "{answer}");
    let answer =
        done_silently(dir.path(), &["calibrate", "results.csv", "--needed", "1.8 N/mm", "--margin", "1"]);
    assert!(answer.contains("speed = \"0.5 mm/s\""), "{answer}");
    // A table as spreadsheets save it.
    let dir = calibration(&format!("\u{feff}{}", table(&[(0.1, &[74.0, 75.0, 76.0])]).replace('\n', "\r\n")));
    let answer = done_silently(dir.path(), &["calibrate", "results.csv", "--needed", "1 N/mm"]);
    assert!(answer.contains("speed = \"0.1 mm/s\""), "{answer}");
}

/// Without a required strength even the weakest seal would pass, so nothing is chosen without one.
#[test]
fn calibrate_takes_the_need_from_the_spec_or_asks() {
    let dir = calibration(&table(&[(0.1, &[149.0, 150.0, 151.0]), (0.5, &[50.0, 51.0, 49.0])]));
    let asked = run(dir.path(), &["calibrate", "results.csv"]);
    assert_eq!(asked.status.code(), Some(1));
    let answer = stdout(&asked);
    let holds: Vec<_> = answer.lines().filter_map(|line| line.split_whitespace().last()).collect();
    assert_eq!(holds, ["holds/(N/mm)", "1.920", "5.920"], "{answer}");
    assert!(answer.lines().all(|line| line.starts_with("# ")), "{answer}");
    assert!(stderr(&asked).contains("give the required strength by --needed FORCE, or by --spec SPEC"));
    // At 30 kPa the corners of the paper's star pull with k p W = 3.8 * 0.03 * 30 = 3.4 N/mm; 1 kPa is held by every seal.
    for (pressure, speed) in [("30 kPa", "0.1 mm/s"), ("1 kPa", "0.5 mm/s")] {
        let spec = format!("{}[load]\npressure = \"{pressure}\"\n", support::PAPER);
        fs::write(dir.path().join("star.toml"), spec).expect("written");
        let answer = done_silently(
            dir.path(),
            &["calibrate", "results.csv", "--spec", "star.toml", "--margin", "1.2"],
        );
        assert!(answer.contains(&format!("speed = \"{speed}\"")), "{answer}");
        assert!(answer.starts_with(&format!("# at {pressure} the seal has to hold ")), "{answer}");
    }
    fs::write(dir.path().join("star.toml"), support::PAPER).expect("written");
    let args = ["calibrate", "results.csv", "--spec", "star.toml"];
    let _ = fails(dir.path(), &args, 1, &["star.toml: [load] has no pressure; write one, or give --needed"]);
    let both = [&args[..], &["--needed", "1 N/mm"]].concat();
    let _ = fails(dir.path(), &both, 2, &["cannot be used with"]);
}

/// The pull of sharp hinges has no printed range. The strength that is chosen holds for sure, and one that may not is not chosen.
#[test]
fn calibrate_covers_the_pull_of_sharp_hinges() {
    let spec = format!(
        "{}[fabric]\nthickness = \"0.6 mm\"\n[load]\npressure = \"15 kPa\"\nobject_diameter = \"120 mm\"\n",
        support::PAPER.replace("50 mm", "120 mm").replace("30 mm", "60 mm")
    );
    let holds = |newtons: f64| {
        let peels = [newtons - 1.0, newtons, newtons + 1.0];
        let dir = calibration(&table(&[(0.1, &peels)]));
        fs::write(dir.path().join("star.toml"), &spec).expect("written");
        let found = run(dir.path(), &["calibrate", "results.csv", "--spec", "star.toml"]);
        let answer = if found.status.success() { stdout(&found) } else { stderr(&found) };
        let strength = answer.lines().find(|line| line.starts_with("seal_strength")).map(ToOwned::to_owned);
        let Some(strength) = strength else {
            assert!(
                answer.contains("the strongest setting holds") && answer.contains("a larger tip_radius"),
                "{answer}"
            );
            return None;
        };
        let strong = spec.replace("[load]", &format!("{strength}\n[load]"));
        fs::write(dir.path().join("strong.toml"), strong).expect("written");
        let args = ["check", "strong.toml", "--json"];
        assert_eq!(json_of(&done_silently(dir.path(), &args))["verdict"]["holds"], true, "{answer}");
        assert!(answer.contains("so the margin is "), "{answer}");
        Some(strength)
    };
    // 14.4 N/mm are 1.5 times the predicted pull.
    assert_eq!(holds(361.0), None);
    let [mut weak, mut strong] = [361.0, 1500.0];
    assert!(holds(strong).is_some());
    for _ in 0..6 {
        let middle = f64::midpoint(weak, strong);
        if holds(middle).is_some() { strong = middle } else { weak = middle }
    }
}

/// The pull of a drawing is that of its shell. The command that `coupon` prints works as soon as the table is filled in.
#[test]
fn calibrate_takes_the_need_of_a_drawing_from_its_shell() {
    let dir = tempfile::tempdir().expect("a directory");
    let designs = Path::new(env!("CARGO_MANIFEST_DIR")).join("designs/drawings");
    let spec = fs::read_to_string(designs.join("pillow.toml")).expect("a spec");
    let _ = fs::copy(designs.join("pillow.dxf"), dir.path().join("pillow.dxf")).expect("a drawing");
    let load = "\n[load]\npressure = \"10 kPa\"\n";
    for (name, more, asked) in [("soft.toml", "", true), ("hard.toml", load, false)] {
        fs::write(dir.path().join(name), format!("{spec}{more}")).expect("written");
        let answer = done_silently(dir.path(), &["coupon", name, "-o", "c", "--only", "strips"]);
        assert_eq!(answer.contains(&format!("write `pressure` into [load] of {name}")), asked, "{answer}");
        let command =
            answer.lines().find_map(|line| line.split_once("then: stargrip-cam ")).expect("a command").1;
        let filled = table(&[(0.1, &[149.0, 150.0, 151.0]), (0.5, &[5.0, 5.1, 4.9])]);
        fs::write(dir.path().join("c/results.csv"), filled).expect("written");
        fs::write(dir.path().join(name), format!("{spec}{load}")).expect("written");
        let args: Vec<&str> = command.split(' ').chain(["--json"]).collect();
        let found = json_of(&done_silently(dir.path(), &args));
        let predicted = json_of(&done_silently(dir.path(), &["predict", name, "--json"]));
        // Its wrinkles are too fine to resolve: folds may pull as hard as the upper end of the range.
        let pull = &predicted["chambers"][0]["ranges"]["seal_pull_N_per_mm"][1];
        assert_eq!(&found["needed_N_mm"], pull);
        assert!(pull.as_f64().is_some_and(|pull| pull > 0.1), "{pull}");
        assert_eq!(found["chosen"]["speed_mm_s"], 0.1);
        fs::remove_dir_all(dir.path().join("c")).expect("removed");
    }
}

#[test]
fn calibrate_reads_many_settings() {
    let settings: Vec<(f64, &[f64])> =
        (1..=40_000).map(|i| (f64::from(i) / 50.0, &[50.0, 50.0, 50.0][..])).collect();
    let dir = calibration(&table(&settings));
    let answer = done_silently(dir.path(), &["calibrate", "results.csv", "--needed", "1 N/mm"]);
    assert!(answer.contains("speed = \"800 mm/s\""), "{answer}");
}

#[test]
fn calibrate_says_what_data_do_not_support() {
    for (text, words) in [
        (HEAD.to_owned(), "no row has a `peel_N`: write the force"),
        (table(&[(0.1, &[74.0, 75.0]), (0.5, &[50.0])]), "no setting has 3 specimens; tested settings: 2"),
        (table(&[(0.1, &[20.0, 75.0, 130.0])]), "every setting's standard deviation is above 25 %"),
        (
            table(&[(0.1, &[74.0, 75.0, 76.0])]),
            "the strongest setting holds 2.920 N/mm, but 75.000 N/mm are needed",
        ),
        (table(&[(0.1, &[0.0, 0.0, 0.0])]), "the strongest setting holds 0.000 N/mm"),
    ] {
        let dir = calibration(&text);
        let args = ["calibrate", "results.csv", "--needed", "50 N/mm"];
        let _ = fails(dir.path(), &args, 1, &["results.csv: the data do not support a choice", words]);
    }
    // A seal without strength is refused, whatever strength is required.
    let dir = calibration(&table(&[(0.1, &[0.0, 0.0, 0.0])]));
    let args = ["calibrate", "results.csv", "--needed", "0.0001 N/mm"];
    let _ = fails(dir.path(), &args, 1, &["the strongest setting holds 0.000 N/mm"]);
}

#[test]
fn calibrate_names_the_line_it_cannot_read() {
    let good = table(&[(0.1, &[74.0, 75.0, 76.0])]);
    for (text, words) in [
        (String::new(), &["error[no-header]: an empty table", "results.csv"][..]),
        (
            "a,b\n1,2\n".to_owned(),
            &["error[no-header]", "results.csv:1:1", "must have the columns `temperature_C`, `speed_mm_s`"],
        ),
        (
            good.replacen("speed_mm_s", "speed", 1),
            &["error[unit]", "results.csv:1:21", "must be `speed_mm_s`"],
        ),
        (
            good.replace(',', ";").replace("0.1", "0,1"),
            &[
                "error[decimal-comma]: `speed_mm_s` is `0,1`",
                "results.csv:2:7",
                "results.csv:4:7",
                "write 0.1",
            ],
        ),
        (
            good.replace("0.1", "0,1"),
            &[
                "error[cell-count]: 7 cells",
                "results.csv:2:1",
                "must be 6, as the header has",
                "with a point: 10.5",
            ],
        ),
        (good.replace(",75,\n", ",75,\n\n\n7,200\n"), &["error[cell-count]: 2 cells", "results.csv:6:1"]),
        (
            good.replace(",75,", ",75 N,"),
            &["error[cell]: `peel_N` is `75 N`", "results.csv:3:16", "a number is needed"],
        ),
        (good.replace(",75,", ",-75,"), &["`peel_N` is `-75`", "must be at least 0"]),
        (good.replace(",75,", ",inf,").replace(",76,", ",nan,"), &["`inf`", "`nan`", "2 errors"]),
        (good.replacen("200,", "hot,", 1), &["`temperature_C` is `hot`", "results.csv:2:3"]),
        (
            good.replacen(",74,", ",74,\"peel", 1),
            &["error[open-quote]", "results.csv:2:1", "check for a quote that is not closed"],
        ),
    ] {
        let dir = calibration(&text);
        let _ = fails(dir.path(), &["calibrate", "results.csv", "--needed", "1 N/mm"], 1, words);
    }
    let dir = calibration(&good);
    fs::write(dir.path().join("bytes.csv"), b"\xff\xfe").expect("written");
    let _ = fails(dir.path(), &["calibrate", "bytes.csv"], 1, &["bytes.csv", "UTF-8"]);
    let _ = fails(dir.path(), &["calibrate", "missing.csv"], 1, &["cannot read missing.csv"]);
    for (args, words) in [
        (&["--needed", "1"][..], "write the force per length as a number and one of N/mm"),
        (&["--needed=-1 N/mm"], "must be more than 0 N/mm"),
        (&["--needed", "0 N/mm"], "must be more than 0 N/mm"),
        (&["--needed", "nan N/mm"], "write the force per length"),
        (&["--needed", "1,2 N/mm"], "write \"1.2 N/mm\""),
        (&["--margin", "nan"], "must be at least 1 and at most 100"),
        (&["--margin", "0"], "must be at least 1 and at most 100"),
        (&["--flat-angle", "30"], "--inflated-angle"),
    ] {
        let _ = fails(dir.path(), &[&["calibrate", "results.csv"][..], args].concat(), 2, &[words]);
    }
}

/// Tips of W 30 mm, as sharp as the band allows (R 1 mm) and rounder: `calibrate` recovers the fabric from the predictions of `actuator`.
#[test]
fn calibrate_finds_the_fabric_that_the_bench_shows() {
    for (tip_radius, radius) in [("0 mm", "1mm"), ("3 mm", "3mm")] {
        finds_the_fabric(tip_radius, radius);
    }
}

fn finds_the_fabric(tip_radius: &str, radius: &str) {
    let dir = calibration(&table(&[(0.1, &[74.0, 75.0, 76.0])]));
    let star = format!("[star]\ntip_radius = \"{tip_radius}\"\n");
    let spec = support::PAPER.replacen("[star]\n", &star, 1) + "[load]\npressure = \"5 kPa\"\n";
    fs::write(dir.path().join("spec.toml"), spec).expect("written");
    let asked = format!(
        "actuator --model section --json --tube-width 30mm --radius {radius} --angle 60deg --arm-length 120mm --pressure 12kPa"
    );
    let predicted = json_of(&done_silently(dir.path(), &asked.split(' ').collect::<Vec<_>>()));
    let angle = predicted["angle_deg"].as_f64().expect("a number").to_string();
    let bench = ["--flat-angle", "60", "--inflated-angle", &angle, "--angle-pressure", "12 kPa"];
    let call = [&["calibrate", "results.csv", "--spec", "spec.toml"][..], &bench].concat();
    let answer = done_silently(dir.path(), &call);
    // B of 0.3 mm at 128 MPa is 0.340 N mm.
    assert!(answer.contains("[fabric]\n# of the V-actuator at 12 kPa; a degree less or more"), "{answer}");
    assert!(
        answer.contains("\nbending_stiffness = \"0.340 N mm\"\n") && answer.contains("seal_strength"),
        "{answer}"
    );
    assert_eq!(answer.matches("[fabric]").count(), 1, "{answer}");
    // At its pressure lambda is that of `section`, for the unchanged fabric.
    assert!(
        answer.contains("# lambda predicted (section): ") && answer.contains("; measured is +0.0 %\n"),
        "{answer}"
    );
    let alone = [&["calibrate", "--spec", "spec.toml"][..], &bench].concat();
    let told = done_silently(dir.path(), &alone);
    assert!(
        told.contains("[fabric]\n") && told.contains("= \"0.340 N mm\"\n") && !told.contains("seal"),
        "{told}"
    );
    let told = json_of(&done_silently(dir.path(), &[&alone[..], &["--json"]].concat()));
    assert!(told["chosen"].is_null() && told["coiling"]["model"] == "section", "{told}");
    let disc = ["--disc-width", "77.2 mm", "--disc-pressure", "10 kPa", "--json"];
    let both = json_of(&done_silently(dir.path(), &[&call[..], &disc].concat()));
    let stretch = both["fabric"]["stretch_stiffness_N_mm"].as_f64().expect("a number");
    assert!((5.0..100.0).contains(&stretch), "{both}");
    // The bench results do not depend on the strips.
    fs::write(dir.path().join("results.csv"), HEAD).expect("written");
    let thin = run(dir.path(), &call);
    assert_eq!(thin.status.code(), Some(1));
    assert!(stdout(&thin).contains("\nbending_stiffness = \"0.340 N mm\"\n"), "{}", stdout(&thin));
}

#[test]
fn calibrate_reads_the_spec_once_and_warns_once() {
    let dir = calibration(&table(&[(0.1, &[74.0, 75.0, 76.0])]));
    let spec = support::PAPER.to_owned() + "[load]\npressure = \"5 kPa\"\n[seal]\ntemperature = \"270 C\"\n";
    fs::write(dir.path().join("spec.toml"), spec).expect("written");
    let call =
        "calibrate results.csv --spec spec.toml --flat-angle 60 --inflated-angle 40 --angle-pressure 12kPa";
    let output = run(dir.path(), &call.split(' ').collect::<Vec<_>>());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(stderr(&output).matches("warning[ptfe]").count(), 1, "{}", stderr(&output));
}

#[test]
fn calibrate_refuses_what_no_bench_shows() {
    let dir = calibration(&table(&[(0.1, &[74.0, 75.0, 76.0])]));
    let spec = support::PAPER.to_owned() + "[load]\npressure = \"20 kPa\"\n";
    fs::write(dir.path().join("spec.toml"), spec).expect("written");
    let refused = |args: &[&str], code: i32, words: &[&str]| {
        let call = [&["calibrate", "results.csv", "--spec", "spec.toml"][..], args].concat();
        let _ = fails(dir.path(), &call, code, words);
    };
    refused(&["--flat-angle", "30", "--inflated-angle", "31"], 1, &["at most the flat one, 30 deg"]);
    let crossed = ["--flat-angle", "58.7 deg", "--inflated-angle", "-100 deg"];
    refused(&crossed, 1, &["is -100 deg", "at least -6.6 deg", "check the sign", "between the arms"]);
    let wide = ["--flat-angle", "60", "--inflated-angle", "59", "--angle-pressure", "20 kPa"];
    refused(&wide, 1, &["--inflated-angle", "no stiffness of the fabric explains", "closes to between"]);
    refused(&["--angle-pressure", "20 kPa"], 2, &["--inflated-angle"]);
    let _ = fails(dir.path(), &["calibrate"], 2, &["<RESULTS>"]);
    let needless = ["calibrate", "--flat-angle", "30", "--inflated-angle", "9", "--needed", "1 N/mm"];
    let _ = fails(dir.path(), &needless, 2, &["RESULTS"]);
    refused(&["--disc-width", "78 mm"], 2, &["--disc-pressure"]);
    refused(&["--disc-width", "60 mm", "--disc-pressure", "10 kPa"], 1, &["0.600 of the flat one"]);
    refused(&["--disc-width", "100 mm", "--disc-pressure", "10 kPa"], 2, &["less than 100 mm"]);
}

#[test]
fn calibrate_compares_lambda_with_the_prediction() {
    let dir = calibration(&table(&[(0.1, &[74.0, 75.0, 76.0])]));
    let needed = ["--needed", "1 N/mm"];
    let angles =
        [&["calibrate", "results.csv", "--flat-angle", "30", "--inflated-angle", "-12"][..], &needed]
            .concat();
    let answer = done_silently(dir.path(), &angles);
    assert!(answer.starts_with("# lambda measured: 1.280\n# lambda predicted (ring): 1.2"), "{answer}");
    assert!(answer.contains("seal_strength"), "{answer}");
    // The results of the V-actuator do not depend on the strips.
    fs::write(dir.path().join("results.csv"), HEAD).expect("written");
    let thin = run(dir.path(), &angles);
    assert_eq!(thin.status.code(), Some(1));
    assert!(stdout(&thin).contains("# lambda measured: 1.280") && stderr(&thin).contains("no row has"));
    for (flat, inflated) in
        [("0", "60"), ("180", "60"), ("nan", "60"), ("30", "180"), ("30", "-180"), ("30", "inf")]
    {
        let args = ["calibrate", "results.csv", "--flat-angle", flat, "--inflated-angle", inflated];
        let _ = fails(dir.path(), &args, 2, &["and less than 180"]);
    }
    for ratio in ["nan", "0", "-1", "1e300"] {
        let ratio = format!("--radius-ratio={ratio}");
        let _ = fails(
            dir.path(),
            &[&angles[..], &[&ratio]].concat(),
            2,
            &["--radius-ratio", "must be more than 0"],
        );
    }
}
