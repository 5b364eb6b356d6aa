//! `stargrip-cam build`

use std::path::{Path, PathBuf};

use clap::builder::{PossibleValuesParser, TypedValueParser};
use jiff::Zoned;

use crate::artifact::{Asked, Kind};
use crate::cli::failure::{Failure, say, tell};
use crate::cli::load::Loaded;
use crate::cli::voice::Voice;
use crate::cli::{glance, publish, summary, watch};

/// Arguments of `build`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The spec to build.
    spec: PathBuf,
    /// Where to put the files; default: out/ and the spec's name without its ending.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Build only these kinds; the spec, the machine profile and the manifest come always.
    #[arg(long, value_name = "KIND,...", value_delimiter = ',', value_parser = kind_parser(Kind::ALL))]
    only: Vec<Kind>,
    /// Build these kinds too, which do not come by default.
    #[arg(long, value_name = "KIND,...", value_delimiter = ',', value_parser = extra_parser())]
    with: Vec<Kind>,
    /// Build it even if it bursts, or does not hold the object of its own `load` section.
    #[arg(long)]
    anyway: bool,
    #[command(flatten)]
    voice: Voice,
}

fn extra_parser() -> impl TypedValueParser<Value = Kind> {
    let extras: Vec<Kind> = Kind::ALL.iter().copied().filter(|kind| kind.is_extra()).collect();
    kind_parser(&extras)
}

fn kind_parser(kinds: &[Kind]) -> impl TypedValueParser<Value = Kind> + use<> {
    PossibleValuesParser::new(kinds.iter().map(|kind| kind.name()))
        .try_map(|name| Kind::from_name(&name).ok_or("no such kind"))
}

/// Builds, proves and publishes.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let voice = args.voice;
    let loaded = Loaded::spoken(&args.spec, voice)?;
    let asked = Asked { only: args.only.clone(), with: args.with.clone() };
    let forecast = loaded.forecast()?;
    loaded.fit(&forecast, args.anyway)?;
    let list = watch::list(&forecast, &args.spec);
    let proven = forecast.build(loaded.sources(), &asked).prove().map_err(Failure::Findings)?;
    let target = args.output.clone().unwrap_or_else(|| default_output(&args.spec));
    // What became of files that were there is told however quiet one is.
    tell(&publish(&target, &proven)?.to_string());
    if voice.quiet {
        return Ok(());
    }
    let forecast = &proven.built().forecast;
    if voice.json {
        let mut said = glance::json(forecast, &list);
        said["written"] = glance::written_json(&proven, &target);
        return say(&format!("{said:#}\n"));
    }
    glance::show(&glance::head(forecast))?;
    glance::warn(&list);
    // Without a program there is nothing to wait for.
    if proven.sealing_time().is_some() {
        glance::show(&glance::work(forecast, &Zoned::now()))?;
    }
    glance::show(&glance::written(&proven, &target))?;
    if voice.verbose { say(&summary::built(&proven)) } else { glance::show(&[("details", "-v".to_owned())]) }
}

/// `out/` and the spec's file name without its ending.
fn default_output(spec: &Path) -> PathBuf {
    Path::new("out").join(spec.file_stem().unwrap_or(std::ffi::OsStr::new("design")))
}
