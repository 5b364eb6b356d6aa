//! `stargrip-cam table`: many shells at once, each kept when it is there. Those of a study file are rows, as `study run` computes them; those of
//! the shipped tables are ladders of V-actuators and drawn stars, a file each.

use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::failure::{Failure, say, tell};
use crate::cli::shell::{refused, watched_by};
use crate::cli::study::{Destination, Span, loaded};
use crate::cli::text_file::{read_table, replace};
use crate::cli::whole_file::sweep_leftovers;
use crate::forecast::arms::{FINENESS, Ladder, LadderTable, join, ladders};
use crate::forecast::stars::computed::{self, ComputedStar, FORCE_FINENESS, OPENINGS, in_turn};
use crate::forecast::stars::draw::{DrawnStar, Set};
use crate::forecast::stars::shipped;
use inflatable::shell::cases::Fineness;

/// Arguments of `table`.
#[derive(clap::Args, Debug)]
#[command(
    after_help = "Examples: stargrip-cam table ladders --part 1/2 & stargrip-cam table ladders --part 2/2; \
                        stargrip-cam table ladders --join > arms.txt\n\
                        stargrip-cam table stars --set all; stargrip-cam table stars --set all --forces; \
                        stargrip-cam table stars --set all --join > stars.txt\n\
                        stargrip-cam table study.toml --parts 4 -o parts; stargrip-cam study join parts -o study.csv"
)]
pub(super) struct Args {
    /// Where each ladder or star is a file; those that are there already are not computed again. Or a study file, as for `study run`.
    #[arg(value_name = "DIR|STUDY")]
    dir: PathBuf,
    /// Stars of a set, fit, range, test, paper or all, in place of ladders.
    #[arg(long, value_name = "SET", value_parser = sets)]
    set: Option<Sets>,
    /// Open the stars by round objects, too.
    #[arg(long, requires = "set")]
    forces: bool,
    #[command(flatten)]
    rows: Destination,
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

/// Computes a study, ladders or stars, or joins the last two.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    // A study that is not there is missed, not made a directory.
    if args.dir.is_file() || args.dir.extension().is_some_and(|ending| ending == "toml") {
        return study(args);
    }
    if args.rows.is_of_a_study() {
        let text = "--parts, -o, --format, --units and --threads are a study's: name a study file, or leave them out";
        return Err(Failure::Usage(text.to_owned()));
    }
    if !args.join {
        fs::create_dir_all(&args.dir).map_err(|error| Failure::file("create", &args.dir, &error))?;
        sweep_leftovers(&args.dir, |name| Path::new(name).extension().is_some_and(|ending| ending == "txt"));
    }
    match &args.set {
        Some(Sets(sets)) => stars(args, sets),
        None => all_ladders(args),
    }
}

fn study(args: &Args) -> Result<(), Failure> {
    if args.set.is_some() || args.cells.is_some() || args.join {
        let text = "--set, --forces, --cells and --join are the shipped tables': name a directory, or leave them out; parts of a study \
                    are joined by `study join`";
        return Err(Failure::Usage(text.to_owned()));
    }
    args.rows.run(&loaded(&args.dir, args.rows.quiet.verbosity())?)
}

fn all_ladders(args: &Args) -> Result<(), Failure> {
    if args.join {
        let climbed: Vec<LadderTable> =
            ladders().iter().filter_map(|ladder| climbed(&file(&args.dir, ladder))).collect();
        return say(&join(&climbed).map_err(|fault| Failure::Message(fault.to_string()))?);
    }
    for ladder in of_part(args, ladders()) {
        let path = file(&args.dir, &ladder);
        if climbed(&path).is_some() {
            continue;
        }
        let fineness = Fineness { cells: args.cells.unwrap_or(FINENESS.cells), ..FINENESS };
        let text = watched_by(args.rows.quiet.verbosity(), |watch| {
            ladder.compute(fineness, watch).map_err(|fault| refused(&fault))
        })?;
        replace(&path, &text)?;
        if !args.rows.quiet.quiet {
            tell(&format!("ladder {} of {}", ladder.number, ladders().len()));
        }
    }
    Ok(())
}

fn stars(args: &Args, sets: &[Set]) -> Result<(), Failure> {
    let all: Vec<DrawnStar> = in_turn().into_iter().filter(|star| sets.contains(&star.set)).collect();
    if args.join {
        let known = shipped::shipped();
        let joined: Vec<ComputedStar> = all.iter().filter_map(|star| both(&args.dir, star, &known)).collect();
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
            let found = watched_by(args.rows.quiet.verbosity(), |watch| {
                star.compute(openings, fineness, watch).map_err(|fault| refused(&fault))
            })?;
            replace(&path, &found)?;
            if !args.rows.quiet.quiet {
                tell(&format!("star {} of {}", star.number, star.set.name()));
            }
        }
    }
    Ok(())
}

/// The part of the work that was asked for.
fn of_part<T>(args: &Args, all: Vec<T>) -> impl Iterator<Item = T> {
    let Span { from, to, of } = args.rows.part.unwrap_or(Span { from: 1, to: 1, of: 1 });
    let own = move |(place, _): &(usize, T)| (from..=to).contains(&(place % of + 1));
    all.into_iter().enumerate().filter(own).map(|(_, one)| one)
}

fn file(dir: &Path, ladder: &Ladder) -> PathBuf {
    dir.join(format!("ladder-{:02}.txt", ladder.number))
}

/// The ladder in a file; `None` if it is not there, or torn.
fn climbed(path: &Path) -> Option<LadderTable> {
    path.exists().then(|| read_table(path).ok()).flatten().and_then(|text| LadderTable::read(&text))
}

fn star_file(dir: &Path, star: &DrawnStar, forces: bool) -> PathBuf {
    dir.join(format!("{}-{:02}{}.txt", star.set.name(), star.number, if forces { "-forces" } else { "" }))
}

fn read_star(path: &Path, star: &DrawnStar) -> Option<ComputedStar> {
    path.exists().then(|| read_table(path).ok()).flatten().and_then(|text| star.read(&text))
}

/// A star at rest, as the shipped table has it if it is not there, with its secants where they are there.
fn both(dir: &Path, star: &DrawnStar, known: &[ComputedStar]) -> Option<ComputedStar> {
    let shipped = || known.iter().find(|one| one.star == *star).cloned();
    let mut rest = read_star(&star_file(dir, star, false), star).or_else(shipped)?;
    let opened = read_star(&star_file(dir, star, true), star).and_then(|opened| opened.found);
    if let (Some(rest), Some(opened)) = (&mut rest.found, opened) {
        rest.secants = opened.secants;
    }
    Some(rest)
}
