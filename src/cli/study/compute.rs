//! `stargrip-cam study run`, and `sweep`, its old name.

use std::path::PathBuf;

use crate::cli::failure::Failure;
use crate::cli::study::load::{loaded, varied};
use crate::cli::study::run::Destination;

/// Arguments of `study run`.
#[derive(clap::Args, Debug)]
#[command(
    after_help = "Examples: stargrip-cam study run spec.toml --vary star.points=3,4,5 --vary \"star.tube_width=10 mm..40 mm/31\"\n\
                        stargrip-cam study run study.toml -o study.csv\n\
                        stargrip-cam study run study.toml --part 3/16 -o parts; stargrip-cam study join parts -o study.csv"
)]
pub(in crate::cli) struct Args {
    /// A study file; or, with --vary, the spec around which values are varied.
    #[arg(value_name = "STUDY")]
    spec: PathBuf,
    /// Values to vary: KEY=A,B,C or KEY=FROM..TO/COUNT; may be given several times, the last runs fastest.
    #[arg(long, value_name = "KEY=VALUES")]
    vary: Vec<String>,
    #[command(flatten)]
    rows: Destination,
}

/// Computes the rows and writes them in order.
pub(in crate::cli) fn run(args: &Args) -> Result<(), Failure> {
    let verbosity = args.rows.quiet.verbosity();
    let study = match &args.vary[..] {
        [] => loaded(&args.spec, verbosity)?,
        vary => varied(&args.spec, vary, verbosity)?,
    };
    args.rows.run(&study)
}
