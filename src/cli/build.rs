//! `stargrip-cam build`

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use clap::builder::{PossibleValuesParser, TypedValueParser};

use crate::airtight;
use crate::artifact::Kind;
use crate::cli::failure::{Failure, say};
use crate::cli::load::Loaded;
use crate::cli::{clock, publish, summary};
use crate::pipeline;
use crate::verify;

/// Arguments of `build`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The spec to build.
    spec: PathBuf,
    /// Where to put the files; default: out/ and the spec's name without its ending.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Build only these kinds; the spec, the machine profile and the manifest come always.
    #[arg(long, value_name = "KIND,...", value_delimiter = ',', value_parser = kind_parser())]
    only: Vec<Kind>,
}

fn kind_parser() -> impl TypedValueParser<Value = Kind> {
    PossibleValuesParser::new(Kind::ALL.map(Kind::name))
        .try_map(|name| Kind::from_name(&name).ok_or("no such kind"))
}

/// Builds, proves and publishes.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let loaded = Loaded::new(&args.spec)?;
    let spec = &loaded.reading.spec;
    let build = pipeline::build(spec, &loaded.machine, loaded.sources(), &args.only)
        .map_err(|refusals| loaded.refused(refusals))?;
    loaded.warn(&build.design.warnings);
    let leaks = airtight::leaks(spec, &loaded.machine, &build.design);
    leaks.or(()).map_err(|leaks| loaded.refused(leaks))?;
    let proof = verify::prove(&build.design, spec, &loaded.machine, &build.output_files());
    if !proof.findings.is_empty() {
        return Err(Failure::Findings(proof.findings));
    }
    let target = args.output.clone().unwrap_or_else(|| default_output(&args.spec));
    publish(&target, build.files())?;
    let mut said = summary::built(spec, &loaded.machine, &build, &proof, &target);
    let seconds = build.programs.iter().map(|program| program.time).sum();
    if let Some(end) = clock::finish(SystemTime::now(), seconds) {
        let _ = writeln!(said, "{end}, heating and pauses not counted");
    }
    say(&said)
}

/// `out/` and the spec's file name without its ending.
fn default_output(spec: &Path) -> PathBuf {
    Path::new("out").join(spec.file_stem().unwrap_or(std::ffi::OsStr::new("design")))
}
