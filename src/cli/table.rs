//! `stargrip-cam table`

use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::failure::{Failure, say, tell};
use crate::cli::quantity::part;
use crate::cli::shell::{refused, watched};
use crate::cli::text_file::{read_table, replace};
use crate::cli::whole_file::sweep_leftovers;
use crate::forecast::arms::{Climbed, FINENESS, Ladder, join, ladders};
use crate::forecast::stars::computed::{self, Computed, FORCE_FINENESS, OPENINGS, in_turn};
use crate::forecast::stars::draw::{Drawn, Set};
use crate::forecast::stars::shipped;
use crate::shell::cases::Fineness;

/// Arguments of `table`.
#[derive(clap::Args, Debug)]
#[command(
    after_help = "Examples: stargrip-cam table ladders --part 1/2 & stargrip-cam table ladders --part 2/2; \
                        stargrip-cam table ladders --join > arms.txt\n\
                        stargrip-cam table stars --set all; stargrip-cam table stars --set all --forces; \
                        stargrip-cam table stars --set all --join > stars.txt"
)]
pub(super) struct Args {
    /// Where each ladder or star is a file; those that are there already are not computed again.
    dir: PathBuf,
    /// Stars of a set, fit, range, test, paper or all, in place of ladders.
    #[arg(long, value_name = "SET", value_parser = sets)]
    set: Option<Sets>,
    /// Open the stars by round objects, too.
    #[arg(long, requires = "set")]
    forces: bool,
    /// Compute only part k of N.
    #[arg(long, value_name = "k/N", value_parser = part)]
    part: Option<(usize, usize)>,
    /// Edges across the hinge of the coarsest mesh; the shipped ladders have 5, stars 12.
    #[arg(long, hide = true)]
    cells: Option<f64>,
    /// Compute nothing: print the table of what is there, and of stars whose files are not, as they are shipped.
    #[arg(long, conflicts_with = "part")]
    join: bool,
}

/// The sets that are meant.
#[derive(Clone, Debug)]
struct Sets(Vec<Set>);

fn sets(text: &str) -> Result<Sets, String> {
    let meant: Vec<Set> = Set::ALL.into_iter().filter(|set| text == "all" || text == set.name()).collect();
    if meant.is_empty() { Err("it is fit, range, test, paper or all".to_owned()) } else { Ok(Sets(meant)) }
}

/// Computes ladders or stars, or joins them.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    if !args.join {
        fs::create_dir_all(&args.dir).map_err(|error| Failure::file("create", &args.dir, &error))?;
        sweep_leftovers(&args.dir, |name| Path::new(name).extension().is_some_and(|ending| ending == "txt"));
    }
    match &args.set {
        Some(Sets(sets)) => stars(args, sets),
        None => all_ladders(args),
    }
}

fn all_ladders(args: &Args) -> Result<(), Failure> {
    if args.join {
        let climbed: Vec<Climbed> =
            ladders().iter().filter_map(|ladder| climbed(&file(&args.dir, ladder))).collect();
        return say(&join(&climbed).map_err(|fault| Failure::Message(fault.to_string()))?);
    }
    for ladder in of_part(args, ladders()) {
        let path = file(&args.dir, &ladder);
        if climbed(&path).is_some() {
            continue;
        }
        let fineness = Fineness { cells: args.cells.unwrap_or(FINENESS.cells), ..FINENESS };
        let text = watched(|watch| ladder.climb(fineness, watch).map_err(|fault| refused(&fault)))?;
        replace(&path, &text)?;
        tell(&format!("ladder {} of {}", ladder.number, ladders().len()));
    }
    Ok(())
}

fn stars(args: &Args, sets: &[Set]) -> Result<(), Failure> {
    let all: Vec<Drawn> = in_turn().into_iter().filter(|star| sets.contains(&star.set)).collect();
    if args.join {
        let known = shipped::shipped();
        let joined: Vec<Computed> = all.iter().filter_map(|star| both(&args.dir, star, &known)).collect();
        return say(&shipped::join(&joined));
    }
    for star in of_part(args, all) {
        let (openings, fineness) = match star.set {
            _ if args.forces => (&OPENINGS[..], FORCE_FINENESS),
            Set::Paper => (&[][..], computed::PAPER_FINENESS),
            Set::Fit | Set::Range | Set::Test => (&[][..], computed::FINENESS),
        };
        let fineness = Fineness { cells: args.cells.unwrap_or(fineness.cells), ..fineness };
        let path = star_file(&args.dir, &star, args.forces);
        if read_star(&path, &star).is_none() {
            let found =
                watched(|watch| star.compute(openings, fineness, watch).map_err(|fault| refused(&fault)))?;
            replace(&path, &found)?;
            tell(&format!("star {} of {}", star.number, star.set.name()));
        }
    }
    Ok(())
}

/// The part of the work that was asked for.
fn of_part<T>(args: &Args, all: Vec<T>) -> impl Iterator<Item = T> {
    let (k, n) = args.part.unwrap_or((1, 1));
    all.into_iter().skip(k - 1).step_by(n)
}

fn file(dir: &Path, ladder: &Ladder) -> PathBuf {
    dir.join(format!("ladder-{:02}.txt", ladder.number))
}

/// The ladder in a file; `None` if it is not there, or torn.
fn climbed(path: &Path) -> Option<Climbed> {
    path.exists().then(|| read_table(path).ok()).flatten().and_then(|text| Climbed::read(&text))
}

fn star_file(dir: &Path, star: &Drawn, forces: bool) -> PathBuf {
    dir.join(format!("{}-{:02}{}.txt", star.set.name(), star.number, if forces { "-forces" } else { "" }))
}

fn read_star(path: &Path, star: &Drawn) -> Option<Computed> {
    path.exists().then(|| read_table(path).ok()).flatten().and_then(|text| star.read(&text))
}

/// A star at rest, as the shipped table has it if it is not there, with its secants where they are there.
fn both(dir: &Path, star: &Drawn, known: &[Computed]) -> Option<Computed> {
    let shipped = || known.iter().find(|one| one.star == *star).cloned();
    let mut rest = read_star(&star_file(dir, star, false), star).or_else(shipped)?;
    let opened = read_star(&star_file(dir, star, true), star).and_then(|opened| opened.found);
    if let (Some(rest), Some(opened)) = (&mut rest.found, opened) {
        rest.secants = opened.secants;
    }
    Some(rest)
}
