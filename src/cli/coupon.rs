//! `stargrip-cam coupon`

use std::fmt::Write;
use std::path::PathBuf;
use std::{fs, io};

use serde_json::json;

use crate::artifact::program_ending;
use crate::cli::failure::Failure;
use crate::cli::harmless::shown;
use crate::cli::load::Loaded;
use crate::cli::quantity::quantity;
use crate::cli::text_file::write_new;
use crate::cli::voice::Voice;
use crate::coupon::{Grid, coupons, overview, table};
use crate::spec::Allowed;
use crate::units::{Length, Speed, Temperature};

/// Arguments of `coupon`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The spec whose machine, fabric and tube are tried out.
    spec: PathBuf,
    /// A new directory for the programs, drawings and the table.
    #[arg(short, long, value_name = "DIR", default_value = "coupons")]
    output: PathBuf,
    /// Temperatures of the grid, below 300 C, where the PTFE release layer gives off toxic fumes; default: the spec's.
    #[arg(long, value_delimiter = ',', allow_hyphen_values = true, value_parser = quantity::<Temperature>(Allowed::between(0.0, 300.0)))]
    temperatures: Vec<Temperature>,
    /// Speeds of the grid; default: once, twice and five times the spec's.
    #[arg(long, value_delimiter = ',', allow_hyphen_values = true, value_parser = quantity::<Speed>(Allowed::closed(1e-3, 1e3)))]
    speeds: Vec<Speed>,
    /// Heights of the tip in contact; default: the profile's.
    #[arg(long, value_delimiter = ',', value_parser = quantity::<Length>(Allowed::closed(-20.0, 1e5)), allow_hyphen_values = true)]
    heights: Vec<Length>,
    /// How often each setting is sealed.
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u8).range(1..=20))]
    repeats: u8,
    #[command(flatten)]
    voice: Voice,
}

/// Writes the coupons.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let loaded = Loaded::spoken(&args.spec, args.voice)?;
    let (spec, machine) = (&loaded.reading.spec, &loaded.machine);
    let grid = grid(args, &loaded)?;
    let set = coupons(spec, machine, &grid).map_err(|refusals| loaded.refused(refusals))?;
    fs::create_dir(&args.output).map_err(|error| match error.kind() {
        io::ErrorKind::AlreadyExists => {
            Failure::Message(format!("{} exists already; choose another name", shown(&args.output)))
        }
        _ => Failure::file("create", &args.output, &error),
    })?;
    let ending = program_ending(machine.controller.dialect);
    let (mut programs, mut drawings) = (Vec::new(), Vec::new());
    let written = |list: &mut Vec<String>, name: String, text: &str| {
        write_new(&args.output.join(&name), text)?;
        list.push(name);
        Ok::<(), Failure>(())
    };
    for coupon in &set {
        written(&mut programs, format!("{}.{ending}", coupon.name), &coupon.gcode)?;
        written(&mut drawings, format!("{}.svg", coupon.name), &coupon.svg)?;
    }
    let strips = grid.strips(machine);
    written(&mut drawings, OVERVIEW.to_owned(), &overview(spec, &strips))?;
    written(&mut Vec::new(), TABLE.to_owned(), &table(&strips))?;
    let json = json!({
        "wrote": args.output,
        "programs": programs,
        "drawings": drawings,
        "look_at": OVERVIEW,
        "table": TABLE,
        "strips": strips.len(),
        "temperatures_C": grid.temperatures.iter().map(|temperature| temperature.0).collect::<Vec<_>>(),
        "speeds_mm_s": grid.speeds.iter().map(|speed| speed.0).collect::<Vec<_>>(),
        "heights_mm": grid.heights.iter().map(|height| height.0).collect::<Vec<_>>(),
        "repeats": grid.repeats,
    });
    args.voice.report(&text(args, &programs, &drawings, &grid), &json)
}

/// Every strip with its setting and its cut.
const OVERVIEW: &str = "strips.svg";
/// What is filled in.
const TABLE: &str = "results.csv";

/// What is tried out.
fn grid(args: &Args, loaded: &Loaded) -> Result<Grid, Failure> {
    let (seal, heights) = (&loaded.reading.spec.seal, &loaded.machine.process.heights);
    let speeds = [1.0, 2.0, 5.0].map(|factor| Speed(factor * seal.speed.0));
    let grid = Grid {
        temperatures: or(&args.temperatures, &[seal.temperature]),
        speeds: or(&args.speeds, &speeds),
        heights: or(&args.heights, &[heights.contact]),
        repeats: usize::from(args.repeats),
    };
    // The spec's own speed may be too fast for five times of it.
    if let Some(v) = grid.speeds.iter().find(|v| !(1e-3..=1e3).contains(&v.0)) {
        return Err(Failure::Message(format!("a speed of {v}; it must be from 0.001 to 1000 mm/s")));
    }
    let travel = heights.travel;
    if let Some(h) = grid.heights.iter().find(|h| !(-20.0..travel.0).contains(&h.0)) {
        return Err(Failure::Message(format!("a height of {h}; it must be from -20 mm to below {travel}")));
    }
    grid.alike().map_or(Ok(grid), |why| Err(Failure::Message(why)))
}

/// What was given, else what is usual.
fn or<T: Clone>(given: &[T], usual: &[T]) -> Vec<T> {
    if given.is_empty() { usual.to_vec() } else { given.to_vec() }
}

/// What was written, and what to do with it.
fn text(args: &Args, programs: &[String], drawings: &[String], grid: &Grid) -> String {
    let place = |name: &str| shown(args.output.join(name));
    let mut out = format!(
        "wrote {} programs and {} drawings to {}\n",
        programs.len(),
        drawings.len(),
        shown(&args.output)
    );
    if args.voice.verbose {
        for name in programs.iter().chain(drawings) {
            // A String takes everything.
            let _ = writeln!(out, "  {}", place(name));
        }
    }
    let (look, results, settings) = (place(OVERVIEW), place(TABLE), grid.settings().count());
    let _ = writeln!(out, "look at {look}: every strip with its setting and its cut");
    let _ = writeln!(
        out,
        "seal the strips of {settings} programs, cut each 25 mm wide with legs of 75 mm, pull them apart (T-peel), fill in \
         peel_N in {results}, then: stargrip-cam calibrate {results}"
    );
    out
}
