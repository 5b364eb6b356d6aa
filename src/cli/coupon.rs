//! `stargrip-cam coupon`

use std::fmt::Write;
use std::path::PathBuf;
use std::{fs, io};

use crate::artifact::program_ending;
use crate::cli::failure::{Failure, say};
use crate::cli::harmless::shown;
use crate::cli::load::Loaded;
use crate::cli::quantity::quantity;
use crate::cli::text_file::write_new;
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
    #[arg(long, value_delimiter = ',', value_parser = quantity::<Temperature>(Allowed::between(0.0, 300.0)))]
    temperatures: Vec<Temperature>,
    /// Speeds of the grid; default: once, twice and five times the spec's.
    #[arg(long, value_delimiter = ',', value_parser = quantity::<Speed>(Allowed::closed(1e-3, 1e3)))]
    speeds: Vec<Speed>,
    /// Heights of the tip in contact; default: the profile's.
    #[arg(long, value_delimiter = ',', value_parser = quantity::<Length>(Allowed::closed(-20.0, 1e5)), allow_hyphen_values = true)]
    heights: Vec<Length>,
    /// How often each setting is sealed.
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u8).range(1..=20))]
    repeats: u8,
}

/// Writes the coupons.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let loaded = Loaded::new(&args.spec)?;
    let (spec, machine) = (&loaded.reading.spec, &loaded.machine);
    let seal = &spec.seal;
    let or = |given: &[Temperature]| if given.is_empty() { vec![seal.temperature] } else { given.to_vec() };
    let speeds = [1.0, 2.0, 5.0].map(|factor| Speed(factor * seal.speed.0));
    let grid = Grid {
        temperatures: or(&args.temperatures),
        speeds: if args.speeds.is_empty() { speeds.to_vec() } else { args.speeds.clone() },
        heights: if args.heights.is_empty() {
            vec![machine.process.heights.contact]
        } else {
            args.heights.clone()
        },
        repeats: usize::from(args.repeats),
    };
    // The spec's own speed may be too fast for five times of it.
    if let Some(v) = grid.speeds.iter().find(|v| !(1e-3..=1e3).contains(&v.0)) {
        return Err(Failure::Message(format!("a speed of {v}; it must be from 0.001 to 1000 mm/s")));
    }
    let travel = machine.process.heights.travel;
    if let Some(h) = grid.heights.iter().find(|h| !(-20.0..travel.0).contains(&h.0)) {
        return Err(Failure::Message(format!("a height of {h}; it must be from -20 mm to below {travel}")));
    }
    if let Some(why) = grid.alike() {
        return Err(Failure::Message(why));
    }
    let set = coupons(spec, machine, &grid).map_err(|refusals| loaded.refused(refusals))?;
    fs::create_dir(&args.output).map_err(|error| match error.kind() {
        io::ErrorKind::AlreadyExists => {
            Failure::Message(format!("{} exists already; choose another name", shown(&args.output)))
        }
        _ => Failure::file("create", &args.output, &error),
    })?;
    let mut said = String::new();
    let program = program_ending(machine.controller.dialect);
    for coupon in &set {
        for (ending, text) in [(program, &coupon.gcode), ("svg", &coupon.svg)] {
            let path = args.output.join(format!("{}.{ending}", coupon.name));
            write_new(&path, text)?;
            let _ = writeln!(said, "wrote {}", shown(&path));
        }
    }
    let whole = args.output.join("strips.svg");
    write_new(&whole, &overview(spec, &grid.strips(machine)))?;
    let _ = writeln!(said, "wrote {}: every strip with its setting and its cut", shown(&whole));
    let results = args.output.join("results.csv");
    write_new(&results, &table(&grid.strips(machine)))?;
    say(&format!(
        "{said}wrote {}\nseal the strips, cut each 25 mm wide with legs of 75 mm, pull them apart (T-peel), fill in peel_N, \
         then: stargrip-cam calibrate {}\n",
        shown(&results),
        shown(&results)
    ))
}
