//! `stargrip-cam check`

use std::path::PathBuf;

use crate::airtight;
use crate::cli::failure::{Failure, say};
use crate::cli::load::Loaded;
use crate::cli::summary;

/// Arguments of `check`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The spec to check.
    spec: PathBuf,
}

/// Goes as far as a build that writes nothing, and says what came out.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let loaded = Loaded::new(&args.spec)?;
    let forecast = loaded.forecast()?;
    say(&summary::design(&forecast))?;
    say(&summary::conditions(&forecast))?;
    say(&summary::predicted(&forecast))?;
    say(&airtight::report(&forecast.spec, &forecast.machine, &forecast.design).to_string())
}
