//! `stargrip-cam study`: its rows, its parts, and their files.

mod checkpoint;
pub(super) mod compute;
mod join;
mod part;
mod rows;
mod run;

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
    /// Join the parts in a directory to one file, or print which are missing, damaged or of another study.
    #[command(after_help = "Example: stargrip-cam study join parts -o study.csv")]
    Join {
        /// The directory that `study run STUDY --part k/N -o DIR` or `--parts N -o DIR` has filled.
        dir: PathBuf,
        /// The file; it appears when it is complete.
        #[arg(short, long, value_name = "FILE")]
        output: PathBuf,
        #[command(flatten)]
        quiet: Quiet,
    },
}

/// Shows a study, or joins its parts.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    match &args.what {
        StudyCommand::Run(args) => compute::run(args),
        StudyCommand::Show { study, quiet } => say(&shown(&loaded(study, quiet.verbosity())?)),
        StudyCommand::Join { dir, output, quiet } => join::run(dir, output, quiet.verbosity()),
    }
}

fn shown(study: &Study) -> String {
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
