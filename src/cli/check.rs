//! `stargrip-cam check`

use std::path::{Path, PathBuf};

use jiff::Zoned;
use serde_json::Value;

use crate::cli::escape::shown;
use crate::cli::failure::{Failure, tell};
use crate::cli::kinds::Kinds;
use crate::cli::load::Loaded;
use crate::cli::text_file::replace;
use crate::cli::verbosity::Verbosity;
use crate::cli::{batch, details, overview};
use crate::design::figures;
use crate::emit;
use crate::emit::FaultMark;
use inflatable::geom::Point;

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
    /// Draw the faults of a drawing over it, into this SVG.
    #[arg(long, value_name = "FILE")]
    picture: Option<PathBuf>,
    #[command(flatten)]
    verbosity: Verbosity,
}

/// Makes and proves the files as `build` does, in memory, and prints the result.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    if args.picture.is_some() && args.specs.len() > 1 {
        return Err(Failure::Usage("--picture is for one spec: check them one by one".to_owned()));
    }
    batch::run(&args.specs, args.verbosity, |spec| one(args, spec))
}

/// Draws the faults of a drawing, with --picture.
fn pictured(args: &Args, loaded: &Loaded, failure: &Failure) -> Result<(), Failure> {
    let (Some(path), Failure::Faults(found)) = (&args.picture, failure) else { return Ok(()) };
    let spec = &loaded.reading.spec;
    let marks: Vec<FaultMark> = found
        .list()
        .iter()
        .map(|fault| FaultMark {
            at: fault.drawn.as_ref().and_then(|drawn| drawn.at).map(|[x, y]| Point::new(x, y)),
            text: format!("{}: {}", fault.message, fault.label),
        })
        .collect();
    replace(path, &emit::faults(&spec.name, &figures(spec), &marks))?;
    tell(&format!("note: {} shows the faults", shown(path)));
    Ok(())
}

fn one(args: &Args, spec: &Path) -> Result<Option<Value>, Failure> {
    let verbosity = args.verbosity;
    let loaded = Loaded::spoken(spec, verbosity)?;
    let forecast = loaded.forecast().or_else(|failure| {
        pictured(args, &loaded, &failure)?;
        Err(failure)
    })?;
    loaded.fit(&forecast, args.anyway)?;
    let list = forecast.precautions(&shown(spec));
    let request = args.kinds.request().of_spec(&forecast.spec);
    let proven = loaded.proven(forecast, &request)?;
    args.kinds.tell_missing(&proven.built().manifest.files);
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
