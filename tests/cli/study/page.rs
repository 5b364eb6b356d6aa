//! The example in docs/studies.md equals the program's output.

use std::fs;
use std::path::Path;

use super::{done, folder};

const PAGE: &str = include_str!("../../../docs/studies.md");

/// The text of the first block of `language`.
fn block(language: &str) -> &str {
    let (_, rest) = PAGE.split_once(&format!("```{language}\n")).expect(language);
    rest.split_once("```").expect("its end").0
}

#[test]
fn the_pages_example_is_what_the_program_makes_of_it() {
    let dir = folder(block("toml"));
    let design = Path::new(env!("CARGO_MANIFEST_DIR")).join("designs/paper-gripper.toml");
    let _ = fs::copy(design, dir.path().join("paper-gripper.toml")).expect("copied");
    let made = done(dir.path(), &["sweep", "study.toml", "--units"]);
    assert!(made == block("csv").replace("\r\n", "\n"), "docs/studies.md must say:\n{made}");
}
