//! `stargrip-cam check`

use std::path::PathBuf;

use jiff::Zoned;

use crate::cli::failure::{Failure, say};
use crate::cli::load::Loaded;
use crate::cli::voice::Voice;
use crate::cli::{glance, summary, watch};

/// Arguments of `check`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The spec to check.
    spec: PathBuf,
    /// Accept it even if it bursts, or does not hold the object of its own `load` section.
    #[arg(long)]
    anyway: bool,
    #[command(flatten)]
    voice: Voice,
}

/// Goes as far as a build that writes nothing, and says what came out.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let voice = args.voice;
    let loaded = Loaded::spoken(&args.spec, voice)?;
    let forecast = loaded.forecast()?;
    loaded.fit(&forecast, args.anyway)?;
    if voice.quiet {
        return Ok(());
    }
    let list = watch::list(&forecast, &args.spec);
    if voice.json {
        return say(&format!("{:#}\n", glance::json(&forecast, &list)));
    }
    glance::show(&glance::head(&forecast))?;
    glance::warn(&list);
    glance::show(&glance::work(&forecast, &Zoned::now()))?;
    if voice.verbose {
        say(&summary::checked(&forecast))
    } else {
        glance::show(&[("details", "-v".to_owned())])
    }
}
