//! The tables of the pages in docs/ are what the examples print.

#[allow(dead_code, unreachable_pub, reason = "an example is a program of its own")]
#[path = "../examples/extremes.rs"]
mod extremes;
#[allow(dead_code, unreachable_pub, reason = "an example is a program of its own")]
#[path = "../examples/paper.rs"]
mod paper;

#[allow(dead_code, unreachable_pub, reason = "an example is a program of its own")]
#[path = "../examples/ranges.rs"]
mod ranges;

mod support;

fn stands_on(page: &str, tables: &str) {
    let mut lines = page.lines();
    for line in tables.lines().filter(|line| !line.is_empty()) {
        assert!(lines.any(|other| other == line), "not on the page, or not in this order: {line}");
    }
}

#[test]
fn the_papers_numbers_are_ours() {
    stands_on(include_str!("../docs/paper.md"), &paper::tables());
}

#[test]
fn the_map_of_extremes_is_true() {
    stands_on(include_str!("../docs/stability.md"), &extremes::tables());
}

#[test]
fn the_ranges_are_those_of_the_stars() {
    stands_on(include_str!("../docs/ranges.md"), &ranges::tables());
}

/// `stargrip-cam build designs/paper-gripper.toml --only preview-svg`, and the picture is copied.
#[test]
fn the_picture_of_the_readme_is_what_build_draws() {
    let build = support::build(include_str!("../designs/paper-gripper.toml")).expect("a design");
    let preview = build.artifacts.iter().find(|file| file.name == "sheet-1-preview.svg").expect("a preview");
    assert!(
        preview.bytes == include_bytes!("../docs/paper-gripper.svg"),
        "docs/paper-gripper.svg is another picture"
    );
}
