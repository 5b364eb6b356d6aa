//! `stargrip-cam check`

use std::path::{Path, PathBuf};

use jiff::Zoned;
use serde_json::Value;

use crate::cli::failure::Failure;
use crate::cli::harmless::shown;
use crate::cli::kinds::Kinds;
use crate::cli::load::Loaded;
use crate::cli::voice::Voice;
use crate::cli::{each, glance, summary};

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
    voice: Voice,
}

/// Makes and proves the files as `build` does, in memory, and says what came out.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    each::each(&args.specs, args.voice, |spec| one(args, spec))
}

fn one(args: &Args, spec: &Path) -> Result<Option<Value>, Failure> {
    let voice = args.voice;
    let loaded = Loaded::spoken(spec, voice)?;
    let forecast = loaded.forecast()?;
    loaded.fit(&forecast, args.anyway)?;
    let list = forecast.precautions(&shown(spec));
    let asked = args.kinds.asked().of_spec(&forecast.spec);
    let proven = loaded.proven(forecast, &asked)?;
    let forecast = &proven.built().forecast;
    if voice.json {
        let mut said = glance::json(forecast, &list);
        said["proven"] = glance::proven_json(&proven);
        return Ok(Some(said));
    }
    if voice.quiet {
        glance::warn(forecast.doubt().as_slice());
        return Ok(None);
    }
    glance::show(&glance::head(forecast))?;
    glance::warn(&list);
    glance::show(&glance::work(forecast, &Zoned::now()))?;
    glance::show(&glance::proven(&proven))?;
    if voice.verbose {
        voice.remark(&summary::checked(forecast))?;
    } else {
        glance::show(&[("details", "-v".to_owned())])?;
    }
    Ok(None)
}
