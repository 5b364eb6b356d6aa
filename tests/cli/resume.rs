//! `resume` as a user runs it: places, wrong usage, damaged programs.

use crate::machines::{built, clamp, fails, names, read, workshop_of};
use crate::support::program::{done_silently, run, stdout};
use std::fs;

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
