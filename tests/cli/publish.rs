//! Publishing as a user runs it: kept files, refusals, and the state after a kill. docs/reliability.md has the figures.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::Duration;

use crate::support::program::{run, stderr, stdout, workshop};
use tempfile::TempDir;

use crate::support;

#[track_caller]
fn assert_code(output: &Output, code: i32) {
    assert_eq!(output.status.code(), Some(code), "{}\n{}", stdout(output), stderr(output));
}

/// Builds with few files: the programs and the files that are always made.
#[track_caller]
fn build(dir: &Path, spec: &str, target: &str) -> Output {
    let output = run(dir, &["build", spec, "-o", target, "-q", "--only", "seal-gcode,trace-gcode"]);
    assert_code(&output, 0);
    output
}

/// A workshop with two specs, star.toml and other.toml, and the first one built to out/star.
fn built() -> (TempDir, PathBuf) {
    let dir = workshop();
    let other = support::PAPER.replace("\"50 mm\"", "\"55 mm\"").replace("paper star", "wider star");
    fs::write(dir.path().join("other.toml"), other).expect("written");
    assert_eq!(stderr(&build(dir.path(), "star.toml", "out/star")), "");
    let target = dir.path().join("out/star");
    (dir, target)
}

/// The names in a directory, sorted.
fn names(dir: &Path) -> Vec<String> {
    let entries = fs::read_dir(dir).expect("a directory").map(|entry| entry.expect("an entry").file_name());
    let mut names: Vec<_> = entries.map(|name| name.to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

const FILES: [&str; 5] =
    ["machine.toml", "manifest.json", "spec.toml", "star-1-seal.gcode", "star-1-trace.gcode"];

#[test]
fn a_file_edited_by_hand_is_kept_and_named() {
    let (dir, target) = built();
    let program = fs::read(target.join("star-1-seal.gcode")).expect("a program");
    for number in 1..=2 {
        let mine = format!("mine, {number}");
        fs::write(target.join("star-1-seal.gcode"), &mine).expect("written");
        let again = build(dir.path(), "star.toml", "out/star");
        let kept = format!("out/star.kept-{number}/star-1-seal.gcode");
        assert!(stderr(&again).contains(&kept), "{}", stderr(&again));
        assert_eq!(fs::read_to_string(dir.path().join(kept)).expect("kept"), mine);
        assert_eq!(fs::read(target.join("star-1-seal.gcode")).expect("a program"), program);
    }
    assert_eq!(names(&dir.path().join("out")), ["star", "star.kept-1", "star.kept-2"]);
    assert_eq!(names(&dir.path().join("out/star.kept-1")), ["star-1-seal.gcode"], "only what was edited");
}

#[test]
fn a_spec_edited_in_its_output_is_built_into_it() {
    let (dir, target) = built();
    let _ = fs::copy(dir.path().join("other.toml"), target.join("spec.toml")).expect("edited");
    let again = build(dir.path(), "out/star/spec.toml", "out/star");
    assert!(!stderr(&again).contains("kept"), "what is in the new build is not lost: {}", stderr(&again));
    assert_eq!(names(&dir.path().join("out")), ["star"]);
}

#[test]
fn a_replaced_build_of_another_design_is_named() {
    let (dir, _) = built();
    let other = build(dir.path(), "other.toml", "out/star");
    assert_eq!(stderr(&other), "note: this replaces the build of another design, paper star, 5 points\n");
    assert_eq!(stderr(&build(dir.path(), "other.toml", "out/star")), "");
}

/// A build replaces its directory as a whole, which would take the current directory from under the shell.
#[test]
fn the_current_directory_is_refused_with_a_remedy() {
    let (dir, target) = built();
    let before = fs::read(target.join("manifest.json")).expect("a manifest");
    fs::create_dir(target.join("below")).expect("made");
    for (from, spec, to) in
        [(&target, "../../star.toml", "."), (&target.join("below"), "../../../star.toml", "..")]
    {
        let refused = run(from, &["build", spec, "-o", to]);
        assert_code(&refused, 1);
        let said = stderr(&refused);
        assert!(
            said.contains("is the current directory or holds it") && said.contains("such as -o out"),
            "{said}"
        );
    }
    fs::remove_dir(target.join("below")).expect("empty");
    assert_eq!(names(&target), FILES);
    assert_eq!(fs::read(target.join("manifest.json")).expect("a manifest"), before);
    assert_eq!(names(&dir.path().join("out")), ["star"]);
}

#[cfg(unix)]
#[test]
fn modes_are_carried_over_and_read_only_is_respected() {
    use std::os::unix::fs::PermissionsExt;
    let (dir, target) = built();
    let mode = |path: &Path| fs::metadata(path).expect("there").permissions().mode() & 0o7777;
    let set = |path: &Path, mode| fs::set_permissions(path, fs::Permissions::from_mode(mode)).expect("set");
    let program = target.join("star-1-seal.gcode");
    set(&target, 0o2700);
    set(&program, 0o640);
    let _ = build(dir.path(), "other.toml", "out/star");
    assert_eq!((mode(&target), mode(&program)), (0o2700, 0o640));

    for (path, closed, open) in [(&target, 0o555, 0o755), (&program, 0o444, 0o644)] {
        set(path, closed);
        let before = fs::read(&program).expect("a program");
        let refused = run(dir.path(), &["build", "star.toml", "-o", "out/star"]);
        assert_code(&refused, 1);
        assert!(stderr(&refused).contains("is read-only"), "{}", stderr(&refused));
        assert_eq!(fs::read(&program).expect("a program"), before);
        set(path, open);
    }
    assert_eq!(names(&dir.path().join("out")), ["star"]);
}

/// The next build of any name removes the rest of killed builds; a directory that is not provably a build's becomes visible.
#[test]
fn leftovers_of_any_build_are_swept() {
    let (dir, target) = built();
    let out = dir.path().join("out");
    fs::create_dir(out.join(".gone.stargrip-new")).expect("made");
    fs::write(out.join(".gone.stargrip-new/star-1-seal.gcode"), "half a prog").expect("written");
    fs::rename(&target, out.join(".moved.stargrip-ready")).expect("renamed");
    fs::write(out.join(".moved.stargrip-ready/notes.txt"), "mine").expect("written");
    let said = build(dir.path(), "star.toml", "out/new");
    assert_eq!(names(&out), ["moved.kept-1", "new"]);
    assert_eq!(names(&out.join("moved.kept-1")), ["notes.txt"]);
    assert!(stderr(&said).contains("moved.kept-1/notes.txt"), "{}", stderr(&said));
}

#[test]
fn a_refused_build_leaves_nothing_it_made() {
    let (dir, _) = built();
    let before = names(dir.path());
    let long = format!("a/b/{}", "x".repeat(240));
    let refused = run(dir.path(), &["build", "star.toml", "-o", &long]);
    assert_code(&refused, 1);
    assert!(stderr(&refused).contains("240 bytes, at most 235"), "{}", stderr(&refused));
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("nowhere", dir.path().join("link")).expect("a link");
        assert_code(&run(dir.path(), &["build", "star.toml", "-o", "link"]), 1);
        fs::remove_file(dir.path().join("link")).expect("removed");
        let _ = build(dir.path(), "star.toml", "missing/../x");
        fs::remove_dir_all(dir.path().join("x")).expect("built");
    }
    assert_eq!(names(dir.path()), before);
}

#[cfg(unix)]
#[test]
fn a_file_of_a_build_that_is_a_link_is_called_one() {
    let (dir, target) = built();
    let (file, moved) = (target.join("star-1-seal.gcode"), dir.path().join("moved.gcode"));
    fs::rename(&file, &moved).expect("moved");
    std::os::unix::fs::symlink("../../moved.gcode", &file).expect("a link");
    let refused = run(dir.path(), &["build", "star.toml", "-o", "out/star"]);
    assert_code(&refused, 1);
    let said = stderr(&refused);
    assert!(said.contains("out/star/star-1-seal.gcode is a link, so its directory is not changed"), "{said}");
    let verified = run(dir.path(), &["verify", "out/star"]);
    assert_code(&verified, 1);
    let said = stdout(&verified);
    assert!(said.contains("star-1-seal.gcode: not-a-file: found a link, allowed the seal-gcode"), "{said}");
    assert!(said.ends_with("out/star: 1 finding\n"), "{said}");
}

#[cfg(unix)]
#[test]
fn a_manifest_that_is_a_pipe_is_not_waited_for() {
    let (dir, _) = built();
    let pipe = dir.path().join("piped");
    fs::create_dir(&pipe).expect("made");
    let made = Command::new("mkfifo").arg(pipe.join("manifest.json")).status().expect("mkfifo");
    assert!(made.success());
    let refused = run(dir.path(), &["build", "star.toml", "-o", "piped"]);
    assert_code(&refused, 1);
    assert!(stderr(&refused).contains("piped/manifest.json is not named"), "{}", stderr(&refused));
}

/// A directory in memory, mounted in its own name space, which some systems do not allow.
#[cfg(target_os = "linux")]
#[test]
fn a_mount_point_is_refused_with_a_remedy() {
    let (dir, _) = built();
    let program = env!("CARGO_BIN_EXE_stargrip-cam");
    let script = format!(
        "mkdir m && mount -t tmpfs none m || exit 77
         {program} build star.toml -o m && exit 1; {program} build star.toml -o m/star && {program} verify m/star && ls -A m"
    );
    let shell = Command::new("unshare").args(["-rm", "sh", "-c", &script]).current_dir(dir.path()).output();
    let Ok(output) = shell else { return };
    if output.status.code() == Some(77) || stderr(&output).contains("unshare") {
        eprintln!("no mount here: {}", stderr(&output));
        return;
    }
    assert_code(&output, 0);
    assert!(
        stderr(&output).contains("m is a mount point")
            && stderr(&output).contains("choose a directory in it")
    );
    let said = stdout(&output);
    assert!(said.contains("proven, no findings") && said.ends_with("\nstar\n"), "{said}");
}

/// Kills builds at random moments. `ROUNDS` gives the number of rounds.
#[test]
fn a_build_killed_at_any_moment_can_be_taken_up() {
    let rounds = std::env::var("ROUNDS").ok().and_then(|text| text.parse().ok()).unwrap_or(40_u64);
    let (dir, target) = built();
    let content = |dir: &Path| -> Vec<_> {
        names(dir).into_iter().filter_map(|name| Some((fs::read(dir.join(&name)).ok()?, name))).collect()
    };
    let first = content(&target);
    let _ = build(dir.path(), "other.toml", "out/star");
    let second = content(&target);
    // The duration of an undisturbed build, so that most kills happen during the work.
    let lasts = (0..5).map(|_| {
        let began = std::time::Instant::now();
        let _ = build(dir.path(), "star.toml", "out/star");
        u64::try_from(began.elapsed().as_micros()).expect("short")
    });
    let lasts = lasts.min().expect("five builds");
    let (mut killed, mut left) = (0, 0);
    for round in 0..rounds {
        let spec = ["star.toml", "other.toml"][usize::from(round.is_multiple_of(2))];
        let mut child = Command::new(env!("CARGO_BIN_EXE_stargrip-cam"))
            .current_dir(dir.path())
            .args(["build", spec, "-o", "out/star", "--only", "seal-gcode,trace-gcode"])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("it starts");
        std::thread::sleep(Duration::from_micros(round * 7919 % lasts));
        let _ = child.kill();
        killed += usize::from(!child.wait().expect("it ends").success());
        let now = content(&target);
        left += usize::from(names(&dir.path().join("out")).len() > 1 || names(&target) != FILES);
        assert!(now == first || now == second, "round {round}: {:?}", names(&target));
        if round.is_multiple_of(8) {
            let next = build(dir.path(), spec, "out/star");
            assert!(!stderr(&next).contains("kept"), "round {round}: {}", stderr(&next));
            assert_eq!(content(&target), if spec == "star.toml" { &*first } else { &*second });
            assert_eq!(names(&dir.path().join("out")), ["star"], "round {round}");
        }
    }
    println!("{rounds} rounds: {killed} killed, {left} left something behind");
    let _ = build(dir.path(), "star.toml", "out/star");
    assert_eq!((names(&target), content(&target)), (FILES.map(str::to_owned).to_vec(), first));
    assert_eq!(names(&dir.path().join("out")), ["star"]);
}

#[test]
fn foreign_text_is_harmless_on_a_terminal() {
    let (dir, target) = built();
    let hostile = "e\u{1b}]0;pwn\u{7}\u{1b}[2J\u{202e}x\nproven, no findings";
    fs::write(target.join(hostile), "").expect("written");
    let manifest = fs::read_to_string(target.join("manifest.json")).expect("text");
    let kind = manifest.replace("\"kind\": \"seal-gcode\"", "\"kind\": \"\\u001b[2J\\u202e\\u009b\"");
    assert_ne!(kind, manifest);
    fs::write(target.join("manifest.json"), kind).expect("written");
    let plain = |text: &str| !text.contains(|c: char| stargrip_cam::spec::misleads(c) && c != '\n');
    for args in [
        &["verify", "out/star"][..],
        &["verify", "out/star", "--json"],
        &["build", "star.toml", "-o", "out/star"],
        &["build", hostile],
        &["calibrate", hostile],
        &["build", "star.toml", hostile],
        &["machines", "show", hostile],
    ] {
        let output = run(dir.path(), args);
        assert_ne!(output.status.code(), Some(0), "{args:?}");
        let said = format!("{}{}", stdout(&output), stderr(&output));
        assert!(plain(&said), "{args:?}: {said:?}");
        assert!(!said.contains("\nproven"), "{args:?}: {said:?}");
        assert!(!args.contains(&hostile) || said.contains("e\\u001b]0;pwn"), "{args:?}: {said:?}");
        if args.contains(&"--json") {
            let json: serde_json::Value = serde_json::from_str(&stdout(&output)).expect("JSON");
            let findings = json["findings"].as_array().expect("findings");
            assert!(findings.iter().any(|finding| finding["file"] == hostile), "{json}");
        }
    }
}

/// Opening a pipe waits for its other end, and a device has none: each is refused before that, and before a lock is taken.
#[cfg(unix)]
#[test]
fn no_command_writes_to_a_pipe_or_a_device() {
    let dir = workshop();
    let job = "out/star/star-1-seal.gcode";
    let _ = build(dir.path(), "star.toml", "out/star");
    for pipe in ["pipe", "feed.gcode", "feed.gcode.manifest.json"] {
        assert!(Command::new("mkfifo").arg(dir.path().join(pipe)).status().expect("it starts").success());
    }
    std::os::unix::fs::symlink("pipe", dir.path().join("link.csv")).expect("a link");
    let vary = "star.points=4,5";
    for (args, code) in [
        (&["build", "star.toml", "-o", "pipe"][..], 1),
        (&["build", "star.toml", "-o", "pipe/below"], 1),
        (&["build", "star.toml", "-o", "/dev/null"], 1),
        (&["coupon", "star.toml", "-o", "pipe"], 1),
        (&["study", "run", "star.toml", "--vary", vary, "-o", "pipe"], 1),
        (&["study", "run", "star.toml", "--vary", vary, "-o", "link.csv"], 1),
        (&["study", "run", "star.toml", "--vary", vary, "-o", "/dev/full"], 1),
        (&["trade", "--csv", "pipe"], 1),
        (&["trade", "--svg", "pipe"], 1),
        (&["feedcheck", "star.toml", "-o", "pipe"], 1),
        (&["feedcheck", "star.toml", "--force", "-o", "feed.gcode"], 1),
        (&["resume", job, "--at", "50%", "-o", "pipe"], 1),
        (&["predict", "star.toml", "--model", "shell", "--vtu", "pipe"], 1),
        (&["man", "--dir", "pipe"], 1),
    ] {
        let output = run(dir.path(), args);
        assert_eq!(output.status.code(), Some(code), "{args:?}: {}", stderr(&output));
        assert!(!stderr(&output).is_empty(), "{args:?}");
    }
    for pipe in ["pipe", "feed.gcode"] {
        let kind = dir.path().join(pipe).metadata().expect("there").file_type();
        assert!(!kind.is_file() && !kind.is_dir(), "{pipe} was replaced");
    }
}

/// A limit of the file size (`ulimit -f`) is a failed write like a full disk, not the end of the program by a signal.
#[cfg(unix)]
#[test]
fn a_limit_of_the_file_size_ends_with_a_message_and_leaves_nothing() {
    let dir = workshop();
    let program = env!("CARGO_BIN_EXE_stargrip-cam");
    for command in ["build star.toml -q -o star", "feedcheck star.toml -q -o feed.gcode"] {
        let limited = format!("ulimit -f 2; exec {program} {command}");
        let output =
            Command::new("sh").current_dir(dir.path()).args(["-c", &limited]).output().expect("it starts");
        assert_code(&output, 1);
        assert!(stderr(&output).contains("File too large"), "{command}: {}", stderr(&output));
        let entries = fs::read_dir(dir.path()).expect("a folder").map(|entry| entry.expect("an entry"));
        let names: Vec<String> =
            entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
        assert!(
            !names.iter().any(|name| name.contains(".stargrip-new") || name.contains(".partial")),
            "{names:?}"
        );
        assert!(!names.contains(&"feed.gcode".to_owned()), "{names:?}");
    }
}
