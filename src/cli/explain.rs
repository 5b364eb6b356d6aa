//! `stargrip-cam explain`

use std::io::stdout;

use serde_json::json;

use crate::answer::codes::{CodeMeaning, meanings, word_of};
use crate::cli::escape::escaped_line;
use crate::cli::failure::Failure;
use crate::cli::terminal::{width, wrapped};
use crate::cli::verbosity::Verbosity;

/// Arguments of `explain`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The code in a message, such as no-arm, or a word: all codes in whose row it is. Without it, all codes are listed.
    code: Option<String>,
    #[command(flatten)]
    verbosity: Verbosity,
}

/// Prints the meaning of a code and its remedy.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let rows = meanings();
    let Some(code) = &args.code else { return list(args, &rows) };
    let word = word_of(code);
    if let Some(row) = rows.iter().find(|row| row.code == word) {
        let CodeMeaning { about: section, code, meaning, example } = row;
        let example = if example.is_empty() { String::new() } else { format!("Example: {example}\n") };
        return args.verbosity.report(&format!("{code} ({section})\n{meaning}\n{example}"), &json!(row));
    }
    let has_word = |row: &&CodeMeaning| {
        let mut texts = [row.code, row.about, row.meaning].into_iter();
        word.len() > 3 && texts.any(|text| text.to_lowercase().contains(&word.to_lowercase()))
    };
    let matches: Vec<CodeMeaning> = rows.iter().filter(has_word).cloned().collect();
    if !matches.is_empty() {
        return list(args, &matches);
    }
    let codes = rows.iter().map(|row| row.code);
    let nearest_code = spec::nearest(&word.replace('-', "_"), codes);
    let hint = nearest_code.map_or_else(String::new, |nearest_code| format!("did you mean {nearest_code}? "));
    let text = format!("no code is called {}; {hint}`stargrip-cam explain` lists all", escaped_line(word));
    Err(Failure::Message(text))
}

/// Prints `rows`, a line each.
fn list(args: &Args, rows: &[CodeMeaning]) -> Result<(), Failure> {
    let line = |row: &CodeMeaning| wrapped(&format!("{:24} {}", row.code, row.meaning), 25, width(&stdout()));
    let lines: Vec<String> = rows.iter().map(line).collect();
    args.verbosity.report(&(lines.join("\n") + "\n"), &json!({ "codes": rows }))
}
