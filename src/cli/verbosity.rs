//! How much a command prints: the answer, all details, nothing, or one JSON object.

use std::io::stdout;

use serde_json::Value;

use crate::cli::failure::{Failure, say};
use crate::cli::terminal::{fitted, width};

/// Arguments of every command that reports.
#[derive(clap::Args, Clone, Copy, Debug, Default)]
pub(super) struct Verbosity {
    /// Print all details.
    #[arg(short, long)]
    pub(super) verbose: bool,
    /// Print only errors and urgent warnings, and a spec or a table that is the result.
    #[arg(short, long, conflicts_with = "verbose")]
    pub(super) quiet: bool,
    /// Print one JSON object and nothing else.
    #[arg(long, conflicts_with_all = ["verbose", "quiet"])]
    pub(super) json: bool,
}

/// Argument of commands whose answer is a document, or rows and files.
#[derive(clap::Args, Clone, Copy, Debug, Default)]
pub(super) struct Quiet {
    /// Print only the result and errors.
    #[arg(short, long)]
    pub(super) quiet: bool,
}

impl Quiet {
    /// The verbosity of a command with `--quiet` alone.
    pub(super) fn verbosity(self) -> Verbosity {
        Verbosity { quiet: self.quiet, ..Verbosity::default() }
    }
}

impl Verbosity {
    /// Prints `text`, or `json` with --json; nothing with --quiet.
    pub(super) fn report(self, text: &str, json: &Value) -> Result<(), Failure> {
        if self.json { say(&pretty(json)) } else { self.remark(text) }
    }

    /// Prints `json` if JSON is requested, else `text` unless quiet.
    ///
    /// # Errors
    /// Standard output cannot be written.
    pub(super) fn show(self, text: &str, json: &str) -> Result<(), Failure> {
        if self.json { say(json) } else { self.remark(text) }
    }

    /// Prints `text` unless --json or --quiet is given, in lines of the terminal's width.
    pub(super) fn remark(self, text: &str) -> Result<(), Failure> {
        if self.is_heard() { say(&fitted(text, width(&stdout()))) } else { Ok(()) }
    }

    /// Whether more than errors and urgent warnings is printed as text.
    pub(super) fn is_heard(self) -> bool {
        !(self.json || self.quiet)
    }
}

/// One JSON object as printed text.
pub(super) fn pretty(json: &Value) -> String {
    format!("{json:#}\n")
}
