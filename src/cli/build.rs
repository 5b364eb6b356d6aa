//! `stargrip-cam build`

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use clap::builder::{PossibleValuesParser, TypedValueParser};

use crate::artifact::{Asked, Kind};
use crate::cli::failure::{Failure, say, tell};
use crate::cli::load::Loaded;
use crate::cli::{clock, publish, summary};

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
    let loaded = Loaded::new(&args.spec)?;
    let asked = Asked { only: args.only.clone(), with: args.with.clone() };
    let built = loaded.forecast()?.build(loaded.sources(), &asked);
    let proven = built.prove().map_err(Failure::Findings)?;
    let target = args.output.clone().unwrap_or_else(|| default_output(&args.spec));
    tell(&publish(&target, &proven)?.to_string());
    let mut said = summary::built(&proven, &target);
    // Without a program there is nothing to wait for.
    let seconds = proven.sealing_time();
    if let Some(end) = seconds.and_then(|seconds| clock::finish(SystemTime::now(), seconds)) {
        let _ = writeln!(said, "{end}, heating and pauses not counted");
    }
    say(&said)
}

/// `out/` and the spec's file name without its ending.
fn default_output(spec: &Path) -> PathBuf {
    Path::new("out").join(spec.file_stem().unwrap_or(std::ffi::OsStr::new("design")))
}
