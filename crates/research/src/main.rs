//! `research`: computes the stars and ladders of the shipped tables, a file each, and joins them. Existing files are not computed again.

use std::error::Error;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use inflatable::mechanics::star::residuals::OPENINGS;
use inflatable::shell::cases::{Fineness, Watch};
use research::ladders::{self, Ladder, LadderTable, ladders};
use research::residuals;
use research::stars::computed::{self, ComputedStar, FORCE_FINENESS, in_turn};
use research::stars::draw::{DrawnStar, Set};
use research::stars::{finest, shipped};

/// Makes the tables of computed shells that stargrip-cam ships.
#[derive(Parser)]
struct ResearchArgs {
    #[command(subcommand)]
    table: TableCommand,
}

#[derive(Subcommand)]
enum TableCommand {
    /// V-actuators at rising pressures: what arms add to a hinge.
    Ladders {
        #[command(flatten)]
        work: WorkArgs,
        /// Join the table of thin fabric.
        #[arg(long, requires = "join")]
        thin: bool,
    },
    /// Stars of the drawn sets.
    Stars {
        #[command(flatten)]
        work: WorkArgs,
        /// Which set: fit, range, test, paper, wide or all.
        #[arg(long, default_value = "all", value_parser = sets)]
        set: Sets,
        /// Open the stars by round objects, too.
        #[arg(long)]
        forces: bool,
    },
    /// Print the table of residuals beyond the closed forms of a star.
    Residuals {
        /// Print the lengths of the most likely interpolation instead.
        #[arg(long)]
        lengths: bool,
    },
    /// Print the paper's stars as `stargrip-cam trade` ships them.
    Finest,
}

#[derive(clap::Args)]
struct WorkArgs {
    /// Directory with a file for each result.
    dir: PathBuf,
    /// Compute nothing: print the table of the existing files; stars without a file are printed as shipped.
    #[arg(long)]
    join: bool,
    /// Compute only part k of N, for several processes at once.
    #[arg(long, value_name = "k/N", value_parser = part, default_value = "1/1", conflicts_with = "join")]
    part: PartArgs,
    /// Edges across the hinge of the coarsest mesh, in place of those of the shipped tables.
    #[arg(long)]
    cells: Option<f64>,
    /// How often triangles are cut into four, in place of those of the shipped tables.
    #[arg(long)]
    cuts: Option<usize>,
    /// Compute only the results from this number on.
    #[arg(long, default_value_t = 1)]
    from: u32,
}

#[derive(Clone)]
struct Sets(Vec<Set>);

fn sets(text: &str) -> Result<Sets, String> {
    let selection: Vec<Set> =
        Set::ALL.into_iter().filter(|set| text == "all" || text == set.name()).collect();
    if selection.is_empty() {
        Err("allowed are fit, range, test, paper, wide, narrow and all".to_owned())
    } else {
        Ok(Sets(selection))
    }
}

#[derive(Clone, Copy)]
struct PartArgs {
    own: usize,
    of: usize,
}

fn part(text: &str) -> Result<PartArgs, String> {
    let numbers = text.split_once('/');
    let part = numbers
        .and_then(|(number, count)| Some(PartArgs { own: number.parse().ok()?, of: count.parse().ok()? }));
    part.filter(|part| (1..=part.of).contains(&part.own))
        .ok_or_else(|| format!("`{text}` is not k/N with k from 1 to N"))
}

fn main() -> ExitCode {
    match run(ResearchArgs::parse().table) {
        Ok(()) => ExitCode::SUCCESS,
        Err(fault) => {
            eprintln!("error: {fault}");
            ExitCode::FAILURE
        }
    }
}

fn run(table: TableCommand) -> Result<(), Box<dyn Error>> {
    match table {
        TableCommand::Ladders { work, thin } if work.join => {
            let read_ladder = |ladder: &Ladder| LadderTable::read(&text_of(&ladder_file(&work.dir, ladder))?);
            let tables: Vec<LadderTable> = ladders().iter().filter_map(read_ladder).collect();
            print!("{}", ladders::join(&tables, thin)?);
        }
        TableCommand::Ladders { work, .. } => all_ladders(&work)?,
        TableCommand::Stars { work, set, .. } if work.join => {
            let shipped_stars = shipped::shipped();
            let of_set = in_turn().into_iter().filter(|star| set.0.contains(&star.set));
            let joined: Vec<ComputedStar> =
                of_set.filter_map(|star| rest_and_forces(&work.dir, &star, &shipped_stars)).collect();
            print!("{}", shipped::join(&joined));
        }
        TableCommand::Stars { work, set, forces } => stars(&work, &set.0, forces)?,
        TableCommand::Residuals { lengths: true } => {
            println!("{:.2?}", residuals::likeliest(&shipped::shipped()));
        }
        TableCommand::Residuals { .. } => print!("{}", residuals::fitted(&shipped::shipped())?.table()),
        TableCommand::Finest => print!("{}", finest::table(&shipped::shipped())),
    }
    Ok(())
}

impl WorkArgs {
    /// The items of `list` that belong to this part.
    fn of_part<T>(&self, list: Vec<T>) -> impl Iterator<Item = T> {
        let PartArgs { own: number, of: count } = self.part;
        list.into_iter().enumerate().filter(move |(place, _)| place % count + 1 == number).map(|(_, one)| one)
    }

    fn fineness(&self, shipped: Fineness) -> Fineness {
        Fineness { cells: self.cells.unwrap_or(shipped.cells), cuts: self.cuts.unwrap_or(shipped.cuts) }
    }
}

fn all_ladders(work: &WorkArgs) -> Result<(), Box<dyn Error>> {
    fs::create_dir_all(&work.dir)?;
    for ladder in work.of_part(ladders().into_iter().skip(work.from as usize - 1).collect()) {
        let path = ladder_file(&work.dir, &ladder);
        if text_of(&path).and_then(|text| LadderTable::read(&text)).is_none() {
            replace(&path, &ladder.compute(work.fineness(ladders::FINENESS), &Watch::default())?)?;
            eprintln!("ladder {} of {}", ladder.number, ladders().len());
        }
    }
    Ok(())
}

fn stars(work: &WorkArgs, sets: &[Set], forces: bool) -> Result<(), Box<dyn Error>> {
    fs::create_dir_all(&work.dir)?;
    let is_meant = |star: &DrawnStar| sets.contains(&star.set) && star.number >= work.from;
    let stars_drawn = in_turn().into_iter().filter(is_meant).collect();
    for star in work.of_part(stars_drawn) {
        let (openings, fineness) = match star.set {
            Set::Narrow if forces => (&OPENINGS[..2], FORCE_FINENESS), // wider objects do not pass their holes
            _ if forces => (&OPENINGS[..], FORCE_FINENESS),
            Set::Paper => (&[][..], computed::PAPER_FINENESS),
            Set::Wide => (&[][..], Fineness::default()),
            Set::Fit | Set::Range | Set::Test | Set::Narrow => (&[][..], computed::FINENESS),
        };
        let path = star_file(&work.dir, &star, forces);
        if read_star(&path, &star).is_none() {
            replace(&path, &star.compute(openings, work.fineness(fineness), &Watch::default())?)?;
            eprintln!("star {} of {}", star.number, star.set.name());
        }
    }
    Ok(())
}

fn ladder_file(dir: &Path, ladder: &Ladder) -> PathBuf {
    dir.join(format!("ladder-{:02}.txt", ladder.number))
}

fn star_file(dir: &Path, star: &DrawnStar, forces: bool) -> PathBuf {
    dir.join(format!("{}-{:02}{}.txt", star.set.name(), star.number, if forces { "-forces" } else { "" }))
}

fn read_star(path: &Path, star: &DrawnStar) -> Option<ComputedStar> {
    star.read(&text_of(path)?)
}

/// A star at rest, as the shipped table has it if its file is missing, with the secants of its file of forces.
fn rest_and_forces(dir: &Path, star: &DrawnStar, shipped_stars: &[ComputedStar]) -> Option<ComputedStar> {
    let shipped = || shipped_stars.iter().find(|one| one.star == *star).cloned();
    let mut rest = read_star(&star_file(dir, star, false), star).or_else(shipped)?;
    let opened = read_star(&star_file(dir, star, true), star).and_then(|opened| opened.found);
    if let (Some(rest), Some(opened)) = (&mut rest.found, opened) {
        rest.secants = opened.secants;
    }
    Some(rest)
}

/// The text of a file; `None` if there is none.
fn text_of(path: &Path) -> Option<String> {
    fs::read_to_string(path).ok()
}

/// Writes a file whole or not at all.
fn replace(path: &Path, text: &str) -> io::Result<()> {
    let unfinished = path.with_extension("unfinished");
    fs::write(&unfinished, text)?;
    fs::rename(unfinished, path)
}
