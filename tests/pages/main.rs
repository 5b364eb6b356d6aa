//! What README and docs/ say: tables are what the examples print, commands run and say what stands below them, pictures are what the
//! commands draw, references are what the reader takes, and no link leads astray.
//!
//! `INSTA_UPDATE=always cargo test --test pages` writes references and pictures anew.

#[allow(dead_code, unreachable_pub, reason = "an example is a program of its own")]
#[path = "../../examples/extremes.rs"]
mod extremes;
#[allow(dead_code, unreachable_pub, reason = "an example is a program of its own")]
#[path = "../../examples/paper/main.rs"]
mod paper;
#[allow(dead_code, unreachable_pub, reason = "an example is a program of its own")]
#[path = "../../examples/ranges.rs"]
mod ranges;

mod book;
#[cfg(unix)]
mod commands;
mod page;
mod reference;
#[cfg(unix)]
mod said;
mod trade;

use std::path::{Path, PathBuf};

/// Where the sources are.
fn home() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}

/// Whether what is generated is to be written anew.
fn renews() -> bool {
    std::env::var("INSTA_UPDATE").is_ok_and(|word| word == "always")
}

fn stands_on(page: &str, tables: &str) {
    let mut lines = page.lines();
    for line in tables.lines().filter(|line| !line.is_empty()) {
        assert!(lines.any(|other| other == line), "not on the page, or not in this order: {line}");
    }
}

#[test]
fn the_papers_numbers_are_ours() {
    stands_on(include_str!("../../docs/paper.md"), &paper::tables());
}

#[test]
fn the_papers_pictures_are_ours() {
    let page = include_str!("../../docs/paper.md");
    for (name, drawn) in paper::pictures() {
        assert!(page.contains(&format!("({name})")), "{name} is not shown");
        let file = std::fs::read_to_string(home().join("docs").join(name)).expect("a picture");
        assert!(file == drawn, "{name} is another picture than the example draws");
    }
}

#[test]
fn the_map_of_extremes_is_true() {
    stands_on(include_str!("../../docs/stability.md"), &extremes::tables());
}

#[test]
fn the_ranges_are_those_of_the_stars() {
    stands_on(include_str!("../../docs/ranges.md"), &ranges::tables());
}
