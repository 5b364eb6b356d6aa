//! `stargrip-cam study run`, and `sweep`, its old name; the study that it computes.

use std::path::{Path, PathBuf};

use crate::cli::escape::escaped_line;
use crate::cli::failure::Failure;
use crate::cli::load::Loaded;
use crate::cli::source_file::read_source;
use crate::cli::study::rows::Destination;
use crate::cli::verbosity::Verbosity;
use forecast::study::Study;
use spec::study::{Axis, read_study};

/// Arguments of `study run`.
#[derive(clap::Args, Debug)]
#[command(
    after_help = "Examples: stargrip-cam study run spec.toml --vary star.points=3,4,5 --vary \"star.tube_width=10 mm..40 mm/31\"\n\
                        stargrip-cam study run study.toml -o study.csv"
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

/// The study in the file `path`, around the spec that it names.
pub(in crate::cli) fn loaded(path: &Path, verbosity: Verbosity) -> Result<Study, Failure> {
    let source = read_source(path)?;
    if spec::read(&source).is_ok() {
        let text =
            "this is a spec and varies no key: name a study file, or use `study run` with --vary KEY=VALUES";
        return Err(Failure::Usage(text.to_owned()));
    }
    let file = read_study(&source)?;
    let spec = path.parent().unwrap_or(Path::new("")).join(&file.spec);
    if !spec.exists() {
        let text = format!(
            "`spec` in {} names {}, and there is no such file",
            escaped_line(path),
            escaped_line(&spec)
        );
        return Err(Failure::File(path.display().to_string(), text));
    }
    let loaded_spec = Loaded::read_spec(&spec, verbosity)?.with_stars("study")?;
    Ok(Study::new(&file, &loaded_spec.source)?)
}

/// The spec at `path` with the values of `vary`, "KEY=VALUES" each.
pub(in crate::cli) fn varied(path: &Path, vary: &[String], verbosity: Verbosity) -> Result<Study, Failure> {
    let loaded_spec = Loaded::read_spec(path, verbosity)?.with_stars("study")?;
    let axes = vary.iter().map(|text| Axis::parse(text)).collect::<Result<Vec<_>, _>>();
    Study::vary(&loaded_spec.source, axes.map_err(Failure::Message)?)?.map_err(Failure::Message)
}
