//! `stargrip-cam align`

use std::path::{Path, PathBuf};

use serde_json::json;

use crate::cli::escape::escaped_line;
use crate::cli::failure::{Failure, tell};
use crate::cli::progress;
use crate::cli::publish::publish;
use crate::cli::verbosity::Verbosity;
use crate::cli::verify::{holds_a_build, read_directory};
use crate::pipeline::{Proven, align, read_mark};
use geom::Point;

/// Arguments of `align`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The directory that `build` published.
    dir: PathBuf,
    /// Where the first mark lies now, as the machine shows it in mm: "12.3, 8.1".
    #[arg(long, value_name = "X,Y", value_parser = read_mark, allow_hyphen_values = true)]
    mark1: Point,
    /// Where the second mark lies now: "310.2, 290.4".
    #[arg(long, value_name = "X,Y", value_parser = read_mark, allow_hyphen_values = true)]
    mark2: Point,
    /// The sheet that lies on the machine, if there are several.
    #[arg(long, value_name = "NUMBER")]
    sheet: Option<usize>,
    /// The directory to write; default: the name of the build with -aligned, beside it.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    #[command(flatten)]
    verbosity: Verbosity,
}

/// The build in `dir` with the programs for a sheet whose marks lie at `measured`.
pub(super) fn aligned(
    dir: &Path,
    sheet: Option<usize>,
    measured: [Point; 2],
    verbosity: Verbosity,
) -> Result<Proven, Failure> {
    holds_a_build(dir)?;
    let (_, files) = read_directory(dir)?;
    progress::with_line(verbosity, "aligning", |_| align(&files, sheet, measured))
        .map_err(|fault| Failure::Message(format!("{}: {fault}", escaped_line(dir))))
}

/// Publishes the programs for the moved sheet.
///
/// The published build is proven and planned anew for the moved sheet. Its files appear together in a directory of their own, and the
/// motion is printed as the operator can check it: the turn, the shift and the error of the distance.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let proven = aligned(&args.dir, args.sheet, [args.mark1, args.mark2], args.verbosity)?;
    let target = args.output.clone().unwrap_or_else(|| default_target(&args.dir));
    tell(&publish(&target, &proven)?.to_string());
    let Some(alignment) = proven.built().forecast.design.alignment else { return Ok(()) };
    let (turn, shift) = (alignment.motion.rotation.to_degrees(), alignment.motion.shift);
    let names: Vec<&str> = proven
        .built()
        .artifacts
        .iter()
        .filter(|file| !file.output.kind.is_source())
        .map(|file| file.name.as_str())
        .collect();
    let text = format!(
        "wrote {}\n{}\n{}\nproven where the sheet lies now; the machine's zero stays where it was when the marks were measured\n",
        escaped_line(&target),
        alignment.in_words(),
        names.join(", ")
    );
    let json = json!({
        "wrote": target.to_string_lossy(),
        "sheet": alignment.sheet,
        "turn_deg": turn,
        "shift_mm": [shift.x, shift.y],
        "stretch_mm": alignment.stretch,
        "programs": names,
    });
    args.verbosity.report(&text, &json)
}

/// The default directory: beside the build.
fn default_target(dir: &Path) -> PathBuf {
    // `.` and `..` have no name of their own.
    named_beside(dir)
        .or_else(|| named_beside(&dir.canonicalize().ok()?))
        .unwrap_or_else(|| PathBuf::from("aligned"))
}

/// The directory beside `dir` that is named after it; `None` if it has no name.
fn named_beside(dir: &Path) -> Option<PathBuf> {
    Some(dir.with_file_name(format!("{}-aligned", dir.file_name()?.to_string_lossy())))
}
