//! `stargrip-cam trade`

use std::fs;
use std::path::PathBuf;
use std::time::Instant;

use crate::cli::failure::{Failure, say};
use crate::cli::load::Loaded;
use crate::forecast::trade;
use crate::spec::StarSpec;

/// Arguments of `trade`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The spec whose star gives the size; default: the paper's star.
    spec: Option<PathBuf>,
    /// Write the table as CSV.
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write a plot of error against time as SVG.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

/// Measures on this machine, and prints the table.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let base = match &args.spec {
        Some(path) => Loaded::new(path)?.reading.spec.stars.first().cloned(),
        None => None,
    };
    let start = Instant::now();
    let rows = trade::measure(&base.unwrap_or_else(|| StarSpec::paper(5)), &|| start.elapsed().as_secs_f64())
        .map_err(|fault| Failure::Message(fault.to_string()))?;
    for (path, text) in [(&args.csv, trade::csv(&rows)), (&args.svg, trade::plot(&rows))] {
        if let Some(path) = path {
            fs::write(path, text).map_err(|error| Failure::file("write", path, &error))?;
        }
    }
    let list = |values: &[f64]| values.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    say(&format!(
        "Largest relative error against the exact ring, over R* = {} and stars of {:?} points.\n\n{}",
        list(&trade::R_STARS),
        trade::POINTS,
        trade::table(&rows)
    ))
}
