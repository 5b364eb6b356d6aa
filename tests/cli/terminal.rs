//! Output on a terminal that a pipe does not get: colours, broken lines, and the progress of long work.
//!
//! The terminal is that of `script`, which is part of every Linux.
#![cfg(target_os = "linux")]

use std::fs;
use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::support::program::{stderr, workshop};

/// The program with `args` on a terminal of `columns`, with these variables.
fn on_terminal(dir: &Path, columns: u16, args: &str, variables: &[(&str, &str)]) -> Child {
    let program = env!("CARGO_BIN_EXE_stargrip-cam");
    let line = format!("stty rows 50 cols {columns}; exec '{program}' {args}");
    let mut command = Command::new("script");
    let _ = command.current_dir(dir).args(["-qefc", &line, "/dev/null"]);
    for name in ["NO_COLOR", "COLUMNS"] {
        let _ = command.env_remove(name);
    }
    let _ = command.env("TERM", "xterm").env("SHELL", "/bin/sh").envs(variables.iter().copied());
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("script")
}

/// The whole output on the terminal.
fn sent(dir: &Path, columns: u16, args: &str, variables: &[(&str, &str)]) -> String {
    let mut child = on_terminal(dir, columns, args, variables);
    let mut text = String::new();
    let _ = child.stdout.take().expect("piped").read_to_string(&mut text).expect("UTF-8");
    let _ = child.wait().expect("it ends");
    text
}

#[test]
fn colours_are_for_terminals_that_have_them() {
    let dir = workshop();
    fs::write(dir.path().join("wrong.toml"), "schema = 1\nname = 3\n").expect("written");
    let seen = sent(dir.path(), 100, "check wrong.toml", &[]);
    assert!(seen.contains('\u{1b}') && seen.contains("error"), "{seen:?}");
    let seen = sent(dir.path(), 100, "check star.toml", &[]);
    assert!(seen.contains("\u{1b}[1;33mbefore you seal\u{1b}[0m"), "{seen:?}");
    for unwanted in [("NO_COLOR", "1"), ("TERM", "dumb")] {
        for spec in ["wrong.toml", "star.toml"] {
            let seen = sent(dir.path(), 100, &format!("check {spec}"), &[unwanted]);
            assert!(!seen.contains('\u{1b}') && seen.len() > 100, "{unwanted:?}: {seen:?}");
        }
    }
    // A pipe gets none, whatever TERM is.
    let piped = Command::new(env!("CARGO_BIN_EXE_stargrip-cam"))
        .current_dir(dir.path())
        .env("TERM", "xterm")
        .args(["check", "wrong.toml"])
        .output()
        .expect("it runs");
    assert!(!stderr(&piped).contains('\u{1b}') && stderr(&piped).contains("error"), "{}", stderr(&piped));
}

#[test]
fn lines_are_as_wide_as_the_terminal() {
    let dir = workshop();
    for columns in [60, 80, 120] {
        let seen = sent(dir.path(), columns, "check star.toml", &[("NO_COLOR", "1")]);
        let widest = seen.lines().map(|line| line.chars().count()).max().expect("a line");
        assert!(widest <= usize::from(columns), "{widest} of {columns}: {seen}");
        assert!(widest + 25 > usize::from(columns), "{widest} of {columns}: {seen}");
    }
    let seen = sent(dir.path(), 120, "check star.toml", &[("NO_COLOR", "1"), ("COLUMNS", "50")]);
    assert!(seen.lines().all(|line| line.chars().count() <= 50), "{seen}");
}

/// Return to the start of the line, and erase it.
const TAKEN_BACK: &str = "\r\u{1b}[2K";

#[test]
fn long_work_is_seen_on_a_terminal_and_leaves_nothing_there() {
    let dir = workshop();
    let seen = sent(dir.path(), 80, SHELL, &[]);
    let line = seen.find("left").unwrap_or_else(|| panic!("{seen:?}"));
    let gone = seen.rfind(TAKEN_BACK).unwrap_or_else(|| panic!("{seen:?}"));
    let answer = seen.rfind("bendability").expect("an answer");
    assert!(line < gone && gone < answer && !seen[answer..].contains('\u{1b}'), "{seen:?}");
    for unseen in [(" --json", "xterm"), ("", "dumb")] {
        let (loudness, term) = unseen;
        let args = format!("{SHELL} --fineness coarse{loudness}");
        let seen = sent(dir.path(), 80, &args, &[("TERM", term)]);
        assert!(!seen.contains("left") && !seen.contains('\u{1b}'), "{unseen:?}: {seen:?}");
        assert!(seen.contains("bendability"), "{unseen:?}: {seen:?}");
    }
}

/// Seconds of work, and minutes if it is fine.
const SHELL: &str = "actuator --tube-width '20 mm' --radius '2 mm' --arm-length '80 mm' --angle '60 deg' \
                     --pressure '14 kPa' --model shell --no-cache";

#[test]
fn ctrl_c_takes_the_line_away_and_ends_the_program() {
    let dir = workshop();
    // One command that catches Ctrl-C, and one that does not.
    for (args, line) in [("trade", "measuring"), (&*format!("{SHELL} --fineness fine"), "left")] {
        let mut child = on_terminal(dir.path(), 80, args, &[]);
        let (mut seen, mut out) = (String::new(), child.stdout.take().expect("piped"));
        let (mut bytes, mut told) = ([0; 4096], None);
        loop {
            let count = out.read(&mut bytes).expect("read");
            if count == 0 {
                break;
            }
            seen.push_str(&String::from_utf8_lossy(&bytes[..count]));
            if told.is_none() && seen.contains(line) {
                child.stdin.as_mut().expect("piped").write_all(b"\x03").expect("written");
                told = Some(Instant::now());
            }
        }
        assert_eq!(child.wait().expect("it ends").code(), Some(130), "{args}: {seen:?}");
        assert!(told.is_some_and(|told| told.elapsed() < Duration::from_secs(60)), "{args}: {seen:?}");
        let (_, after) = seen.rsplit_once(TAKEN_BACK).unwrap_or_else(|| panic!("{args}: {seen:?}"));
        assert_eq!(after.trim(), "stopped; nothing was written", "{args}: {seen:?}");
    }
}
