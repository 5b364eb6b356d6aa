//! Builds that are repeated when a spec is saved, and the page that they open.

use crate::support;
use crate::support::program::{run, workshop};
use std::fs;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

#[test]
fn a_watched_spec_is_built_again_when_it_is_saved() {
    let dir = workshop();
    let mut child = Command::new(env!("CARGO_BIN_EXE_stargrip-cam"))
        .current_dir(dir.path())
        .args(["build", "star.toml", "--watch", "-q", "--only", "seal-svg"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("it starts");
    let copy = dir.path().join("out/star/spec.toml");
    let wait_for = |words: &str| {
        let begin = Instant::now();
        while !fs::read_to_string(&copy).is_ok_and(|text| text.contains(words)) {
            assert!(begin.elapsed() < Duration::from_secs(120), "not built: {words}");
            std::thread::sleep(Duration::from_millis(20));
        }
    };
    wait_for("\"50 mm\"");
    // After a faulty save the build is kept, and the watch continues.
    fs::write(dir.path().join("star.toml"), "points =").expect("saved");
    std::thread::sleep(Duration::from_millis(600));
    fs::write(dir.path().join("star.toml"), support::PAPER.replace("\"50 mm\"", "\"55.5 mm\""))
        .expect("saved");
    wait_for("\"55.5 mm\"");
    assert!(child.try_wait().expect("asked").is_none(), "it goes on");
    child.kill().expect("ended");
    let _ = child.wait().expect("it ends");
    assert_eq!(run(dir.path(), &["build", "-", "--watch"]).status.code(), Some(2));
}

/// The first build prints the whole overview; each later one prints one line of changes.
#[test]
fn a_rebuild_says_what_changed_in_one_line() {
    let dir = workshop();
    let (spec, log) = (dir.path().join("star.toml"), dir.path().join("log"));
    let text = format!("{}\n[load]\npressure = \"37 kPa\"\nobject_radius = \"40 mm\"\n", support::PAPER);
    fs::write(&spec, &text).expect("saved");
    let mut child = Command::new(env!("CARGO_BIN_EXE_stargrip-cam"))
        .current_dir(dir.path())
        .args(["build", "star.toml", "--watch", "--only", "seal-svg"])
        .stdout(fs::File::create(&log).expect("a log"))
        .stderr(Stdio::null())
        .spawn()
        .expect("it starts");
    let wait_for = |words: &str| {
        let begin = Instant::now();
        loop {
            let said = fs::read_to_string(&log).unwrap_or_default();
            if said.contains(words) {
                return said;
            }
            assert!(begin.elapsed() < Duration::from_secs(120), "not said: {words}: {said}");
            std::thread::sleep(Duration::from_millis(20));
        }
    };
    let first = wait_for("details");
    std::thread::sleep(Duration::from_millis(600));
    fs::write(&spec, text.replace("\"50 mm\"", "\"51 mm\"")).expect("saved");
    let both = wait_for("rebuilt");
    child.kill().expect("ended");
    let _ = child.wait().expect("it ends");
    let line = both.strip_prefix(&first).expect("what was said stays").trim_end();
    assert!(!line.contains('\n') && line.contains(" star.toml rebuilt in "), "{line}");
    assert!(
        line.contains(" s: inner_radius 50 mm -> 51 mm: ") && line.contains("opens to 94 -> 96 mm"),
        "{line}"
    );
}

/// Faults of a later save begin with its time, and a note about kept kinds is printed once.
#[test]
fn a_save_has_its_time_and_no_note_twice() {
    let dir = workshop();
    let (spec, log) = (dir.path().join("star.toml"), dir.path().join("log"));
    let only = ["build", "star.toml", "-q", "--only", "seal-svg", "--with", "preview-png"];
    assert_eq!(run(dir.path(), &only).status.code(), Some(0));
    let mut child = Command::new(env!("CARGO_BIN_EXE_stargrip-cam"))
        .current_dir(dir.path())
        .args(["build", "star.toml", "--watch"])
        .stdout(Stdio::null())
        .stderr(fs::File::create(&log).expect("a log"))
        .spawn()
        .expect("it starts");
    let wait_for = |file: &std::path::Path, words: &str| {
        let begin = Instant::now();
        while !fs::read_to_string(file).is_ok_and(|text| text.contains(words)) {
            assert!(begin.elapsed() < Duration::from_secs(120), "not there: {words}");
            std::thread::sleep(Duration::from_millis(20));
        }
    };
    wait_for(&log, "waiting for the next save");
    std::thread::sleep(Duration::from_millis(600));
    fs::write(&spec, support::PAPER.replace("\"50 mm\"", "\"51 mm\"")).expect("saved");
    wait_for(&dir.path().join("out/star/spec.toml"), "\"51 mm\"");
    std::thread::sleep(Duration::from_millis(600));
    fs::write(&spec, "points =").expect("saved");
    wait_for(&log, "star.toml was not rebuilt:");
    wait_for(&log, "error[");
    child.kill().expect("ended");
    let _ = child.wait().expect("it ends");
    let heard = fs::read_to_string(&log).expect("a log");
    assert_eq!(heard.matches("has `preview-png`, which is built again").count(), 1, "{heard}");
    let line = heard.lines().find(|line| line.ends_with("was not rebuilt:")).expect("a line");
    assert!(line.as_bytes()[2] == b':' && line.as_bytes()[5] == b':', "{line}");
}

/// The most detailed page is opened; a failure to open it is no failure of the build.
#[cfg(all(unix, not(target_os = "macos")))]
#[test]
fn a_build_opens_its_page() {
    use std::os::unix::fs::PermissionsExt;
    let dir = workshop();
    let opener = dir.path().join("xdg-open");
    fs::write(&opener, "#!/bin/sh\necho \"$1\" > opened\n").expect("written");
    fs::set_permissions(&opener, fs::Permissions::from_mode(0o755)).expect("allowed");
    let build = |path: &str| {
        Command::new(env!("CARGO_BIN_EXE_stargrip-cam"))
            .current_dir(dir.path())
            .args(["build", "star.toml", "--open", "--only", "preview-svg"])
            .env("PATH", path)
            .output()
            .expect("it runs")
    };
    let path = format!("{}:/usr/bin:/bin", dir.path().display());
    assert_eq!(build(&path).status.code(), Some(0));
    let opened = fs::read_to_string(dir.path().join("opened")).expect("opened");
    assert_eq!(opened.trim(), "out/star/sheet-1-preview.svg");
    let closed = build("/nowhere");
    let heard = String::from_utf8_lossy(&closed.stderr).into_owned();
    assert!(closed.status.code() == Some(0) && heard.contains("was not opened: xdg-open"), "{heard}");
}
