//! Predictions in prose: a number with its range, "30 N, 18 to 44", must be one that a command of the page prints.

/// The predictions in `text`, as "30 N, 18 to 44".
pub(crate) fn predictions(text: &str) -> Vec<String> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let number = |word: &str| word.parse::<f64>().is_ok();
    let prediction = |five: &[&str]| {
        let &[value, unit, low, separator, high] = five else { return None };
        let is_unit = unit.len() < 6 && unit.ends_with(',') && !number(unit.trim_end_matches(','));
        let (value, high) = (bare(value), bare(high));
        let is_prediction = is_unit && separator == "to" && number(value) && number(low) && number(high);
        is_prediction.then(|| format!("{value} {unit} {low} to {high}"))
    };
    words.windows(5).filter_map(prediction).collect()
}

/// `word` without the punctuation of its sentence.
fn bare(word: &str) -> &str {
    word.trim_matches(['"', '(', ')', ',', ';', ':', '.'])
}

/// The predictions in the prose of the page `text` that are not in `printed`, the output of its commands. Rows of tables are left out.
pub(crate) fn unprinted(text: &str, printed: &str) -> Vec<String> {
    let mut prose = String::new();
    let mut is_code = false;
    for line in text.lines() {
        is_code ^= line.starts_with("```");
        if !is_code && !line.starts_with(['|', '`']) {
            prose.extend([line, "\n"]);
        }
    }
    let printed = predictions(printed);
    predictions(&prose).into_iter().filter(|one| !printed.contains(one)).collect()
}

#[test]
fn a_prediction_that_no_command_prints_is_found() {
    let printed = "bottle: holds the object with 30 N, 18 to 44 (11.8 N are needed)\n";
    assert!(
        unprinted(
            "It is \"30 N, 18\nto 44\", of 5 N.\n| 1 N, 2 to 3 |\n```text\n4 N, 5 to 6\n```\n",
            printed
        )
        .is_empty()
    );
    assert_eq!(unprinted("It holds 31 N, 18 to 44.", printed), ["31 N, 18 to 44"]);
}
