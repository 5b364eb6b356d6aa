//! The program as tests run it.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use tempfile::TempDir;

/// Runs the program in `dir`.
pub fn run(dir: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_stargrip-cam")).current_dir(dir).args(args).output().expect("it starts")
}

/// Runs the program in `dir` with the user's settings in its folder `settings`.
pub fn run_with_settings(dir: &Path, args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_stargrip-cam"));
    let settings = dir.join("settings");
    command.current_dir(dir).env("XDG_CONFIG_HOME", settings).args(args).output().expect("it starts")
}

/// The standard output of a command that must succeed.
#[track_caller]
pub fn stdout_of_success(args: &[&str], output: &Output) -> String {
    assert_eq!(output.status.code(), Some(0), "{args:?}\n{}\n{}", stdout(output), stderr(output));
    stdout(output)
}

/// Runs a command that must succeed in `dir`; returns its standard output.
#[track_caller]
pub fn done(dir: &Path, args: &[&str]) -> String {
    stdout_of_success(args, &run(dir, args))
}

/// Runs a command that must succeed and write nothing to standard error; returns its standard output.
#[track_caller]
pub fn done_silently(dir: &Path, args: &[&str]) -> String {
    let output = run(dir, args);
    assert_eq!(stderr(&output), "", "{args:?}");
    stdout_of_success(args, &output)
}

pub fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).expect("UTF-8")
}

pub fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("UTF-8")
}

/// A directory with the paper's spec in it.
pub fn workshop() -> TempDir {
    let dir = tempfile::tempdir().expect("a directory");
    fs::write(dir.path().join("star.toml"), super::PAPER).expect("written");
    dir
}
