//! The command `research`: missing or damaged files are named, and existing ones are not computed again.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn run(dir: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_research")).current_dir(dir).args(args).output().expect("it runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

#[test]
fn a_table_is_joined_only_of_all_its_ladders() {
    let dir = tempfile::tempdir().expect("a directory");
    let none = run(dir.path(), &["ladders", "ladders", "--join"]);
    assert!(none.status.code() == Some(1) && text(&none.stderr).contains("ladder 1 is missing"), "{none:?}");
    assert_eq!(run(dir.path(), &["ladders", "ladders", "--part", "3/2"]).status.code(), Some(2));
    fs::create_dir(dir.path().join("ladders")).expect("made");
    fs::write(dir.path().join("ladders/ladder-01.txt"), "ladder 1 tau 0.003162\n").expect("written");
    let torn = run(dir.path(), &["ladders", "ladders", "--join"]);
    assert!(torn.status.code() == Some(1) && text(&torn.stderr).contains("ladder 1 is missing"), "{torn:?}");
}

/// Stars without a file are joined as they are shipped.
#[test]
fn without_files_the_shipped_stars_are_joined() {
    let dir = tempfile::tempdir().expect("a directory");
    let joined = run(dir.path(), &["stars", "stars", "--join"]);
    assert_eq!(text(&joined.stdout), include_str!("../../src/stars/stars.txt"));
}
