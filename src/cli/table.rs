//! `stargrip-cam table`

use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::failure::{Failure, say, tell};
use crate::cli::quantity::part;
use crate::cli::shell::{refused, watched};
use crate::cli::text_file::{read_table, replace};
use crate::forecast::arms::{Climbed, FINENESS, Ladder, join, ladders};
use crate::shell::cases::Fineness;

/// Arguments of `table`.
#[derive(clap::Args, Debug)]
#[command(
    after_help = "Example: stargrip-cam table ladders --part 1/2 & stargrip-cam table ladders --part 2/2; \
                        stargrip-cam table ladders --join > arms.txt"
)]
pub(super) struct Args {
    /// Where each ladder is a file; ladders that are there already are not computed again.
    dir: PathBuf,
    /// Compute only part k of N.
    #[arg(long, value_name = "k/N", value_parser = part)]
    part: Option<(usize, usize)>,
    /// Edges across the hinge of the coarsest mesh; the shipped table has 5.
    #[arg(long, hide = true, default_value_t = FINENESS.cells)]
    cells: f64,
    /// Compute nothing: print the table of the ladders that are there.
    #[arg(long, conflicts_with = "part")]
    join: bool,
}

/// Computes ladders, or joins them.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    if args.join {
        let climbed: Vec<Climbed> =
            ladders().iter().filter_map(|ladder| climbed(&file(&args.dir, ladder))).collect();
        return say(&join(&climbed).map_err(|fault| Failure::Message(fault.to_string()))?);
    }
    fs::create_dir_all(&args.dir).map_err(|error| Failure::file("create", &args.dir, &error))?;
    let (k, n) = args.part.unwrap_or((1, 1));
    for ladder in ladders().into_iter().skip(k - 1).step_by(n) {
        let path = file(&args.dir, &ladder);
        if climbed(&path).is_some() {
            continue;
        }
        let fineness = Fineness { cells: args.cells, ..FINENESS };
        let text = watched(|watch| ladder.climb(fineness, watch).map_err(|fault| refused(&fault)))?;
        replace(&path, &text)?;
        tell(&format!("ladder {} of {}", ladder.number, ladders().len()));
    }
    Ok(())
}

fn file(dir: &Path, ladder: &Ladder) -> PathBuf {
    dir.join(format!("ladder-{:02}.txt", ladder.number))
}

/// The ladder in a file; `None` if it is not there, or torn.
fn climbed(path: &Path) -> Option<Climbed> {
    path.exists().then(|| read_table(path).ok()).flatten().and_then(|text| Climbed::read(&text))
}
