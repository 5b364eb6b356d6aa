//! The meanings of message codes, read from the page of codes.

use serde::Serialize;

/// The page with every code and its meaning.
const PAGE: &str = include_str!("../../docs/codes.md");

/// One code of the page.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct CodeMeaning {
    /// The heading above the code.
    pub about: &'static str,
    /// The code, as in a message: no-arm.
    pub code: &'static str,
    /// Meaning and remedy.
    pub meaning: &'static str,
    /// A message with this code.
    pub example: String,
}

/// All codes, in the order of the page.
pub fn meanings() -> Vec<CodeMeaning> {
    let mut heading_in_force = "";
    let mut rows = Vec::new();
    for line in PAGE.lines() {
        if let Some(heading) = line.strip_prefix("## ") {
            heading_in_force = heading;
        }
        let row = line
            .strip_prefix("| `")
            .and_then(|line| line.strip_suffix(" |"))
            .and_then(|line| line.split_once("` | "))
            .and_then(|(code, line)| Some((code, line.split_once(" | ")?)));
        rows.extend(row.map(|(code, (meaning, example))| {
            // The cells of a table escape them.
            let example = example.replace("&lt;", "<").replace("\\|", "|");
            CodeMeaning { about: heading_in_force, code, meaning, example }
        }));
    }
    rows
}

/// The code in a text copied from a message, which may include its brackets.
pub fn word_of(text: &str) -> &str {
    text.trim_start_matches("error").trim_start_matches("warning").trim_matches(['[', ']', ':'])
}
