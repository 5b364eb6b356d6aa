//! `stargrip-cam trade`

use std::path::PathBuf;
use std::time::Instant;

use serde_json::{Value, json};

use crate::cli::failure::Failure;
use crate::cli::load::Loaded;
use crate::cli::progress;
use crate::cli::progress::Progress;
use crate::cli::text_file::{refuse_foreign, replace};
use crate::cli::verbosity::Verbosity;
use forecast::trade;
use forecast::trade::TradeRow;
use forecast::trade::computed::provenance;
use forecast::trade::picture;
use forecast::trade::shells::{ShellRow, against_shells};
use forecast::trade::shown;
use inflatable::mechanics::fault::StarFault;
use spec::StarSpec;

/// Arguments of `trade`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The spec whose star gives the size; default: the paper's star.
    spec: Option<PathBuf>,
    /// Write the table as CSV.
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write the choice of a model as SVG: question, model, error, cost. Beside it FILE-shells.svg: error against time.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    #[command(flatten)]
    verbosity: Verbosity,
}

/// Measures the models but shells on this machine, and prints the tables.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    // Files that are not this command's own are refused before anything is measured. All models but shells are
    // measured here; the rows of shells are stored with their program.
    let loaded = args.spec.as_ref().map(|path| Loaded::read_spec(path, args.verbosity)?.with_stars("trade"));
    let star = loaded.transpose()?.and_then(|loaded| loaded.reading.spec.stars.first().cloned());
    let base = star.unwrap_or_else(|| StarSpec::paper(5));
    let shells_svg = args.svg.as_ref().map(|path| {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        path.with_file_name(format!("{stem}-shells.svg"))
    });
    if let Some(path) = &args.csv {
        refuse_foreign(path, "a table of `trade`", |text| text.starts_with("model,time_s"))?;
    }
    for path in args.svg.iter().chain(&shells_svg) {
        refuse_foreign(path, "a plot of `trade`", picture::is_picture)?;
    }
    let start = Instant::now();
    let clock = || start.elapsed().as_secs_f64();
    let measure = |_: &Progress| Ok((trade::measure(&base, &clock)?, against_shells(&clock)?));
    let (rows, shells) = progress::with_line(args.verbosity, "measuring every model", measure)
        .map_err(|fault: StarFault| Failure::message(fault))?;
    for (path, text) in [
        (&args.csv, trade::csv(&rows)),
        (&args.svg, picture::of_choice(&shells, &rows)),
        (&shells_svg, picture::against_shells(&shells)),
    ] {
        if let Some(path) = path {
            replace(path, &text)?;
        }
    }
    let r_stars: Vec<String> = trade::R_STARS.iter().map(ToString::to_string).collect();
    let text = format!(
        "{}.\n\nLargest relative error against the exact ring, over R* = {} and stars of {:?} points.\n\n{}\n{}",
        shown::sources(&shells),
        r_stars.join(", "),
        trade::POINTS,
        trade::table(&rows),
        shown::tables(&shells)
    );
    let program = provenance();
    args.verbosity.report(
        &text,
        &json!({
            "stored_shells": { "commit": program.commit, "date": program.date },
            "models": rows.iter().map(row).collect::<Vec<_>>(),
            "against_shells": shells.iter().map(shell_row).collect::<Vec<_>>(),
        }),
    )
}

/// A row as JSON.
fn row(row: &TradeRow) -> Value {
    let [lambda, curvature, seal_load, radius, stiffness] = row.errors;
    json!({
        "model": row.model,
        "time_s": row.time,
        "relative_error": {
            "lambda_t": lambda,
            "d2v_dlambda2": curvature,
            "seal_load": seal_load,
            "final_radius_mm": radius,
            "radial_stiffness_N_per_m": stiffness,
        },
    })
}

/// A row of the comparison with shells as JSON; relative errors, one a star.
fn shell_row(row: &ShellRow) -> Value {
    json!({
        "model": row.model,
        "pressure_kPa": row.pressure,
        "measured_here": row.is_measured,
        "time_s": row.time,
        "actuator": { "angle_error_deg": row.actuator.map(|own| own[0]), "stiffness_error": row.actuator.map(|own| own[1]) },
        "relative_error": {
            "points": row.stars.iter().map(|star| star.points).collect::<Vec<_>>(),
            "final_radius_mm": row.stars.iter().map(|star| star.radius).collect::<Vec<_>>(),
            "radial_stiffness_N_per_m": row.stars.iter().map(|star| star.stiffness).collect::<Vec<_>>(),
            "force_N": row.stars.iter().map(|star| star.force).collect::<Vec<_>>(),
        },
    })
}
