//! Tables and pictures of docs/ against the output of the examples; the command; predictions and tables against shells. The crate has no
//! unit tests: `make test` would compile the large crate once more for them.

mod around;
mod command;
mod cone;
#[allow(dead_code, unreachable_pub, reason = "an example is a program of its own")]
#[path = "../../examples/extremes.rs"]
mod extremes;
mod ladders;
#[allow(dead_code, unreachable_pub, reason = "an example is a program of its own")]
#[path = "../../examples/paper/main.rs"]
mod paper;
#[allow(dead_code, unreachable_pub, reason = "an example is a program of its own")]
#[path = "../../examples/ranges.rs"]
mod ranges;
mod regression;
mod stars;
mod validation;

use std::path::Path;

/// The tables of `text`, each as its lines: header, rule, rows.
fn tables_in(text: &str) -> Vec<Vec<&str>> {
    let lines: Vec<&str> = text.lines().collect();
    let parts = lines.split(|line| !line.starts_with('|'));
    parts.filter(|part| part.len() > 2).map(<[&str]>::to_vec).collect()
}

/// Asserts that `page` shows each of the `printed` tables, in order. It may leave out rows; the rows on the page are
/// printed ones.
fn shows(page: &str, printed: &str) {
    let mut shown = tables_in(page).into_iter();
    for table in tables_in(printed) {
        let header = table[0];
        let rows = shown.by_ref().find(|other| other[0] == header);
        let rows = rows.unwrap_or_else(|| panic!("not on the page, or not in this order: {header}"));
        let mut left = table.iter();
        for row in rows {
            assert!(
                left.any(|other| *other == row),
                "below {header}\nnot printed, or not in this order: {row}"
            );
        }
    }
}

#[test]
fn a_row_that_is_not_printed_is_found() {
    let printed = "| a |\n|---|\n| 1 |\n| 2 |\n\n| b |\n|---|\n| 3 |\n";
    let differs = |page: &str| std::panic::catch_unwind(|| shows(page, printed)).is_err();
    assert!(!differs(printed) && !differs(&printed.replace("| 1 |\n", "")));
    assert!(differs(&printed.replace("| 1 |", "| 4 |")) && differs(&printed.replace("| b |", "| c |")));
    assert!(differs("| b |\n|---|\n| 3 |\n\n| a |\n|---|\n| 1 |\n"));
}

#[test]
fn the_papers_numbers_are_ours() {
    shows(include_str!("../../../../docs/paper.md"), &paper::tables());
}

#[test]
fn the_papers_pictures_are_ours() {
    let page = include_str!("../../../../docs/paper.md");
    for (name, drawn) in paper::pictures() {
        assert!(page.contains(&format!("({name})")), "{name} is not shown");
        let file =
            std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs").join(name))
                .expect("a picture");
        assert!(file == drawn, "{name} is another picture than the example draws");
    }
}

#[test]
fn the_map_of_extremes_is_true() {
    shows(include_str!("../../../../docs/stability.md"), &extremes::tables());
}

#[test]
fn the_ranges_are_those_of_the_stars() {
    shows(include_str!("../../../../docs/ranges.md"), &ranges::tables());
}
