//! `stargrip-cam check`

use std::path::{Path, PathBuf};

use jiff::Zoned;
use serde_json::Value;

use crate::cli::escape::shown;
use crate::cli::failure::Failure;
use crate::cli::kinds::Kinds;
use crate::cli::load::Loaded;
use crate::cli::verbosity::Verbosity;
use crate::cli::{batch, details, overview};

/// Arguments of `check`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The specs to check; - for standard input.
    #[arg(required = true, value_name = "SPEC")]
    specs: Vec<PathBuf>,
    #[command(flatten)]
    kinds: Kinds,
    /// Accept it even if it bursts, or does not hold the object of its own `load` section.
    #[arg(long)]
    anyway: bool,
    #[command(flatten)]
    verbosity: Verbosity,
}

/// Makes and proves the files as `build` does, in memory, and says what came out.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    batch::run(&args.specs, args.verbosity, |spec| one(args, spec))
}

fn one(args: &Args, spec: &Path) -> Result<Option<Value>, Failure> {
    let verbosity = args.verbosity;
    let loaded = Loaded::spoken(spec, verbosity)?;
    let forecast = loaded.forecast()?;
    loaded.fit(&forecast, args.anyway)?;
    let list = forecast.precautions(&shown(spec));
    let asked = args.kinds.asked().of_spec(&forecast.spec);
    let proven = loaded.proven(forecast, &asked)?;
    let forecast = &proven.built().forecast;
    if verbosity.json {
        let mut said = overview::json(forecast, &list);
        said["proven"] = overview::proven_json(&proven);
        return Ok(Some(said));
    }
    if verbosity.quiet {
        overview::warn(forecast.doubt().as_slice());
        return Ok(None);
    }
    overview::show(&overview::head(forecast))?;
    overview::warn(&list);
    overview::show(&overview::work(forecast, &Zoned::now()))?;
    overview::show(&overview::proven(&proven))?;
    if verbosity.verbose {
        verbosity.remark(&details::checked(forecast))?;
    } else {
        overview::show(&[("details", "-v".to_owned())])?;
    }
    Ok(None)
}
