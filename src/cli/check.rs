//! `stargrip-cam check`

use std::path::PathBuf;

use crate::airtight;
use crate::cli::failure::{Failure, say};
use crate::cli::load::Loaded;
use crate::cli::summary;
use crate::design::Design;
use crate::plan;

/// Arguments of `check`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The spec to check.
    spec: PathBuf,
}

/// Designs and plans, and says what came out.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let loaded = Loaded::new(&args.spec)?;
    let spec = &loaded.reading.spec;
    let design = Design::new(spec, &loaded.machine).map_err(|refusals| loaded.refused(refusals))?;
    loaded.warn(&design.warnings);
    let programs = plan::seal_programs(spec, &loaded.machine, &design);
    let traces = plan::trace_programs(spec, &loaded.machine, &design);
    let refusals = plan::refusals(spec, &loaded.machine, &programs, &traces);
    refusals.or(()).map_err(|refusals| loaded.refused(refusals))?;
    let report = airtight::report(spec, &loaded.machine, &design);
    say(&summary::design(spec, &design, &programs))?;
    say(&summary::conditions(spec, &loaded.machine, &programs))?;
    say(&report.to_string())?;
    report.leaks.or(()).map_err(|leaks| loaded.refused(leaks))
}
