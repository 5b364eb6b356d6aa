//! `stargrip-cam check`

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::cli::escape::{argument, escaped_line};
use crate::cli::failure::{Failure, tell};
use crate::cli::kinds::Kinds;
use crate::cli::load::{Loaded, refuse_two_stdin};
use crate::cli::material::FabricArg;
use crate::cli::text_file::{refuse_foreign, replace};
use crate::cli::verbosity::Verbosity;
use crate::cli::{batch, overview};
use crate::emit;
use crate::emit::FaultMark;
use crate::pipeline::Interface;
use design::figures;
use geom::Point;
use spec::{DrawnPlace, ProductKind};

/// Arguments of `check`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The specs to check; - for standard input.
    #[arg(required = true, value_name = "SPEC")]
    specs: Vec<PathBuf>,
    #[command(flatten)]
    kinds: Kinds,
    /// Accept it even if it bursts, or does not hold the object of its own `load` section; and compute a shell of any size.
    #[arg(long)]
    anyway: bool,
    /// Draw the faults and warnings of a drawing over it, into this SVG.
    #[arg(long, value_name = "FILE")]
    picture: Option<PathBuf>,
    #[command(flatten)]
    fabric: FabricArg,
    #[command(flatten)]
    verbosity: Verbosity,
}

/// Makes and proves the files as `build` does, in memory, and prints the result.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    refuse_two_stdin(&args.specs)?;
    if args.picture.is_some() && args.specs.len() > 1 {
        return Err(Failure::Usage("--picture is for one spec: check them one by one".to_owned()));
    }
    batch::run(&args.specs, args.verbosity, |spec| check_one(args, spec))
}

/// The mark of a fault or a warning.
fn mark(place: Option<&DrawnPlace>, message: &str, remedy: &str) -> FaultMark {
    let point = place.and_then(|place| place.at).map(|[x, y]| Point::new(x, y));
    FaultMark { at: point, text: format!("{message}: {remedy}") }
}

/// Draws the `marks` of a drawing, with --picture.
fn pictured(args: &Args, loaded: &Loaded, marks: &[FaultMark]) -> Result<(), Failure> {
    let Some(path) = &args.picture else { return Ok(()) };
    let spec = &loaded.reading.spec;
    if spec.product() != ProductKind::Drawing && marks.is_empty() {
        tell(&format!("note: {} is not written: the spec has no drawing", escaped_line(path)));
        return Ok(());
    }
    refuse_foreign(path, "a picture of a check", emit::is_faults)?;
    replace(path, &emit::faults(&spec.name, &figures(spec), marks))?;
    let subject = match marks.len() {
        0 => "the drawing without findings".to_owned(),
        1 => "the drawing and 1 finding".to_owned(),
        number => format!("the drawing and {number} findings"),
    };
    tell(&format!("note: {} shows {subject}", escaped_line(path)));
    Ok(())
}

fn check_one(args: &Args, spec: &Path) -> Result<Option<Value>, Failure> {
    let loaded = Loaded::with_fabric(spec, &args.fabric, args.verbosity)?;
    let forecast = loaded.forecast(args.anyway).or_else(|failure| {
        if let Failure::Faults(faults) = &failure {
            let marks =
                faults.list().iter().map(|fault| mark(fault.drawn.as_deref(), &fault.message, &fault.label));
            pictured(args, &loaded, &marks.collect::<Vec<_>>())?;
        }
        Err(failure)
    })?;
    let warnings = forecast.design.warnings.iter();
    let marks = warnings.map(|warning| mark(warning.drawn.as_deref(), &warning.found, &warning.remedy));
    pictured(args, &loaded, &marks.collect::<Vec<_>>())?;
    loaded.fit(&forecast, args.anyway)?;
    let list = forecast.precautions(Interface::Command(&argument(spec)));
    args.kinds.refuse_programs(&loaded)?;
    let request = args.kinds.request().of_spec(&forecast.spec);
    let proven = loaded.proven(forecast, &request)?;
    args.kinds.tell_missing(proven.built(), &request);
    overview::answer(&proven, &list, None, args.verbosity)
}
