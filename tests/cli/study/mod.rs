//! Studies as a user runs them: study files, their tables, and the state on full disks.

mod faults;
mod page;
mod slow;
mod table;

use std::fs;
use std::path::Path;

use crate::support::inputs::GRIPPER as SPEC;
use crate::support::program::{done, run};
use tempfile::TempDir;

/// A study whose 216 rows include refusals, words, whole numbers and unknown values.
const STUDY: &str = r#"schema = 1
spec = "spec.toml"
[rows]
star.points = [4, 5, 9]
star.tip_angle = ["40 deg", "30 deg", "20 deg"]
[vary]
mask.mirror = [true, false]
star.tube_width = "10 mm..40 mm/12"
load.pressure = ["0.001 kPa", "20 kPa", "37 kPa"]
"#;

fn folder(study: &str) -> TempDir {
    let dir = tempfile::tempdir().expect("a folder");
    fs::write(dir.path().join("spec.toml"), SPEC).expect("written");
    fs::write(dir.path().join("study.toml"), study).expect("written");
    dir
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

/// The standard error of a command that ends with `code`.
#[track_caller]
fn refused(dir: &Path, args: &[&str], code: i32) -> String {
    let output = run(dir, args);
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{args:?}: {said}");
    said
}

fn names(dir: &Path) -> Vec<String> {
    let entries = fs::read_dir(dir).expect("a folder").map(|entry| entry.expect("an entry").file_name());
    let mut names: Vec<String> = entries.map(|name| name.to_string_lossy().into_owned()).collect();
    names.sort();
    names
}
