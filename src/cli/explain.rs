//! `stargrip-cam explain`

use std::io::stdout;

use serde_json::{Value, json};

use crate::cli::escape::shown;
use crate::cli::failure::Failure;
use crate::cli::terminal::{width, wrapped};
use crate::cli::verbosity::Verbosity;
use crate::spec;

/// Where every code stands with its meaning.
const PAGE: &str = include_str!("../../docs/codes.md");

/// Arguments of `explain`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The code, as it stands in a message: no-arm. Without it, all codes are listed.
    code: Option<String>,
    #[command(flatten)]
    verbosity: Verbosity,
}

/// One code of the page.
struct CodeRow {
    /// The heading above it.
    about: &'static str,
    code: &'static str,
    meaning: &'static str,
    /// A message with this code.
    example: &'static str,
}

impl CodeRow {
    fn json(&self) -> Value {
        json!({ "code": self.code, "about": self.about, "meaning": self.meaning, "example": self.example })
    }
}

/// Prints what a code means and what to do about it.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let rows = rows();
    let Some(code) = &args.code else {
        let line = |row: &CodeRow| wrapped(&format!("{:24} {}", row.code, row.meaning), 25, width(&stdout()));
        let lines: Vec<String> = rows.iter().map(line).collect();
        let all = json!({ "codes": rows.iter().map(CodeRow::json).collect::<Vec<_>>() });
        return args.verbosity.report(&(lines.join("\n") + "\n"), &all);
    };
    // Who copies it from a message may copy its brackets.
    let word = code.trim_start_matches("error").trim_start_matches("warning").trim_matches(['[', ']', ':']);
    if let Some(row) = rows.iter().find(|row| row.code == word) {
        let CodeRow { about, code, meaning, example } = row;
        let example = example.replace("&lt;", "<").replace("\\|", "|");
        let example = if example.is_empty() { example } else { format!("Example: {example}\n") };
        return args.verbosity.report(&format!("{code} ({about})\n{meaning}\n{example}"), &row.json());
    }
    let codes = || rows.iter().map(|row| row.code);
    let near = spec::nearest(&word.replace('-', "_"), codes());
    let near = near.or_else(|| codes().find(|code| code.contains(word) && word.len() > 3));
    let hint = near.map_or_else(String::new, |near| format!("did you mean {near}? "));
    let text = format!("no code is called {}; {hint}`stargrip-cam explain` lists all", shown(word));
    Err(Failure::Message(text))
}

/// The rows of the page's tables.
fn rows() -> Vec<CodeRow> {
    let mut about = "";
    let mut rows = Vec::new();
    for line in PAGE.lines() {
        if let Some(heading) = line.strip_prefix("## ") {
            about = heading;
        }
        let row = line
            .strip_prefix("| `")
            .and_then(|line| line.strip_suffix(" |"))
            .and_then(|line| line.split_once("` | "))
            .and_then(|(code, line)| Some((code, line.split_once(" | ")?)));
        rows.extend(row.map(|(code, (meaning, example))| CodeRow { about, code, meaning, example }));
    }
    rows
}
