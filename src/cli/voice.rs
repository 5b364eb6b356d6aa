//! How much a command says: the answer, all there is to say, nothing, or one JSON object.

use serde_json::Value;

use crate::cli::failure::{Failure, say};

/// Arguments of commands that answer at length.
#[derive(clap::Args, Clone, Copy, Debug, Default)]
pub(super) struct Voice {
    /// Say everything there is to say.
    #[arg(short, long)]
    pub(super) verbose: bool,
    /// Say nothing but what stands in the way.
    #[arg(short, long, conflicts_with = "verbose")]
    pub(super) quiet: bool,
    /// Print one JSON object and nothing else.
    #[arg(long, conflicts_with_all = ["verbose", "quiet"])]
    pub(super) json: bool,
}

/// Arguments of commands whose answer is short.
#[derive(clap::Args, Clone, Copy, Debug, Default)]
pub(super) struct Brief {
    /// Say nothing but what stands in the way.
    #[arg(short, long)]
    pub(super) quiet: bool,
    /// Print one JSON object and nothing else.
    #[arg(long, conflicts_with = "quiet")]
    pub(super) json: bool,
}

impl Brief {
    /// Prints `text` to people, `json` to programs, or nothing.
    pub(super) fn report(self, text: &str, json: &Value) -> Result<(), Failure> {
        match self {
            Self { json: true, .. } => say(&format!("{json:#}\n")),
            Self { quiet: true, .. } => Ok(()),
            Self { .. } => say(text),
        }
    }
}
