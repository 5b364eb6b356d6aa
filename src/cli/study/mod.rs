//! `stargrip-cam study`: many designs, a row each.

pub(super) mod compute;
mod rows;

use std::fmt::Write;
use std::path::PathBuf;

use crate::cli::failure::{Failure, say};
use crate::cli::study::compute::loaded;
use crate::cli::verbosity::Quiet;
use forecast::study::{ColumnKind, Study};

/// Arguments of `study`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    #[command(subcommand)]
    what: StudyCommand,
}

#[derive(clap::Subcommand, Debug)]
enum StudyCommand {
    /// Compute the rows of a study file, or of every combination of the values of --vary.
    Run(compute::Args),
    /// Print the rows of a study file, and every column with its unit and meaning.
    Show {
        /// The study file.
        study: PathBuf,
        #[command(flatten)]
        quiet: Quiet,
    },
}

/// Computes or shows a study.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    match &args.what {
        StudyCommand::Run(args) => compute::run(args),
        StudyCommand::Show { study, quiet } => say(&study_text(&loaded(study, quiet.verbosity())?)),
    }
}

fn study_text(study: &Study) -> String {
    let mut text = format!("{} rows\nfingerprint {}\n\n", study.rows(), study.fingerprint());
    for column in study.columns() {
        let kind = match (column.kind, column.unit) {
            (_, Some(unit)) => unit,
            (ColumnKind::Real, None) => "number",
            (ColumnKind::Whole, None) => "whole",
            (ColumnKind::Text, None) => "text",
        };
        // Writing to a String does not fail.
        let _ = writeln!(text, "{:32} {:8} {}", column.name, kind, column.about);
    }
    text
}
