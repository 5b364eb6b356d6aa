//! `stargrip-cam coupon`

use std::fmt::Write;
use std::path::PathBuf;

use serde_json::json;

use crate::answer::hours;
use crate::answer::quantity::quantity;
use crate::cli::escape::{argument, escaped_line};
use crate::cli::failure::{Failure, tell};
use crate::cli::load::{Loaded, lasting};
use crate::cli::material::FabricArg;
use crate::cli::publish::publish_files;
use crate::cli::verbosity::Verbosity;
use crate::cli::words::words;
use crate::coupon::{CouponGroup, PressGrid, StripGrid, TEMPERATURES};
use crate::pipeline::{MadeCoupons, OVERVIEW, ProvenCoupons, TABLE};
use proof::artifact::Kind;
use spec::units::{Duration, Length, Percent, Speed, Temperature, count_text};
use spec::{CONTACT, FOCUSES, POWERS, PRESS_TIMES, Press, SEAL_SPEEDS, Spec};

/// How often each setting is sealed by default.
const REPEATS: u8 = 3;

/// Arguments of `coupon`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The spec whose machine, fabric and tube are tested.
    spec: PathBuf,
    /// A new directory for the programs, drawings and the table.
    #[arg(short, long, value_name = "DIR", default_value = "coupons")]
    output: PathBuf,
    /// Temperatures of the grid, above 40 C and below 300 C, where the PTFE release layer gives off toxic fumes; default: the spec's.
    #[arg(long, value_delimiter = ',', allow_hyphen_values = true, value_parser = quantity::<Temperature>(TEMPERATURES))]
    temperatures: Vec<Temperature>,
    /// Powers of a laser, in place of temperatures; default: three quarters, once and five quarters of the spec's.
    #[arg(long, value_delimiter = ',', allow_hyphen_values = true, value_parser = quantity::<Percent>(POWERS), conflicts_with_all = ["temperatures", "heights", "times"])]
    powers: Vec<Percent>,
    /// Speeds of the grid; default: once, twice and five times the spec's; of a laser half, once and twice.
    #[arg(long, value_delimiter = ',', allow_hyphen_values = true, value_parser = quantity::<Speed>(SEAL_SPEEDS))]
    speeds: Vec<Speed>,
    /// Times of a heat press, in place of speeds and heights; default: half, once and twice the spec's.
    #[arg(long, value_delimiter = ',', allow_hyphen_values = true, value_parser = quantity::<Duration>(PRESS_TIMES), conflicts_with_all = ["speeds", "heights", "process"])]
    times: Vec<Duration>,
    /// Heights of the tip in contact; default: the profile's.
    #[arg(long, value_delimiter = ',', value_parser = quantity::<Length>(CONTACT), allow_hyphen_values = true)]
    heights: Vec<Length>,
    /// Heights of a laser's focus above the sheet, each below `travel` of the profile; default: the spec's.
    #[arg(long, value_delimiter = ',', value_parser = quantity::<Length>(FOCUSES), allow_hyphen_values = true, conflicts_with_all = ["temperatures", "heights", "times"])]
    focuses: Vec<Length>,
    /// Coupons of these kinds only; default: all.
    #[arg(long, value_name = "KIND,...", value_delimiter = ',', value_parser = words(&CouponGroup::NAMES, &[]))]
    only: Vec<CouponGroup>,
    /// How often each setting is sealed; default: 3.
    #[arg(long, value_parser = clap::value_parser!(u8).range(1..=20))]
    repeats: Option<u8>,
    /// The process of the spec that is tested, in the place of `[seal]`: its settings are the defaults.
    #[arg(long, value_name = "NAME")]
    process: Option<String>,
    #[command(flatten)]
    fabric: FabricArg,
    #[command(flatten)]
    verbosity: Verbosity,
}

impl Args {
    /// The file `name` of the coupons, for a message.
    fn place(&self, name: &str) -> String {
        escaped_line(self.output.join(name))
    }

    /// Refuses options of the grid of strips where `--only` names no strips.
    fn refuse_strips_alone(&self) -> Result<(), Failure> {
        if self.only.is_empty() || self.only.contains(&CouponGroup::Strips) {
            return Ok(());
        }
        let options = [
            ("--temperatures", !self.temperatures.is_empty()),
            ("--powers", !self.powers.is_empty()),
            ("--speeds", !self.speeds.is_empty()),
            ("--heights", !self.heights.is_empty()),
            ("--focuses", !self.focuses.is_empty()),
            ("--times", !self.times.is_empty()),
            ("--repeats", self.repeats.is_some()),
        ];
        let misplaced = options.into_iter().find(|(_, is_given)| *is_given);
        misplaced.map_or(Ok(()), |(option, _)| {
            Err(Failure::Usage(format!("{option} is for strips: leave it out, or add strips to --only")))
        })
    }
}

/// Writes the coupons.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    // The output is looked at first, because coupons take a while. They are proven before any file is written, and told as text
    // and as JSON afterwards.
    let loaded = Loaded::with_fabric(&args.spec, &args.fabric, args.verbosity)?;
    let (spec, machine) = (&loaded.reading.spec, &loaded.machine);
    if args.output.symlink_metadata().is_ok() {
        let text = format!("{} exists already; choose another name", escaped_line(&args.output));
        return Err(Failure::Message(text));
    }
    if let Some(parent) =
        args.output.parent().filter(|parent| !parent.as_os_str().is_empty() && !parent.is_dir())
    {
        let text = format!(
            "cannot create {}: {} is not a directory",
            escaped_line(&args.output),
            escaped_line(parent)
        );
        return Err(Failure::Message(text));
    }
    if let Some(press) = &spec.press {
        return run_pressed(args, &loaded, press);
    }
    let (grid, proven) = (grid(args, &loaded)?, coupons(args, &loaded)?);
    let files: Vec<_> = proven.files().into_iter().map(|(name, bytes)| (name, bytes.into())).collect();
    tell(&publish_files(&args.output, &files)?.to_string());
    let made_coupons = proven.made_coupons();
    let [programs, drawings] = [Kind::SealGcode, Kind::SealSvg].map(|kind| {
        let files = made_coupons.files.iter().filter(|file| file.output.kind == kind);
        files.map(|file| &file.name).collect::<Vec<_>>()
    });
    let has_strips = made_coupons.table.is_some();
    let times = programs.iter().zip(&made_coupons.coupons);
    let times: Vec<_> = times
        .map(|(name, coupon)| json!({ "program": name, "time_s": coupon.program.time.round() }))
        .collect();
    let mut json = json!({
        "wrote": args.output,
        "programs": programs,
        "times": times,
        "drawings": drawings,
        "look_at": has_strips.then_some(OVERVIEW),
        "table": has_strips.then_some(TABLE),
        "strips": if has_strips { grid.strips(machine).len() } else { 0 },
        "temperatures_C": grid.temperatures.iter().map(|temperature| temperature.0).collect::<Vec<_>>(),
        "speeds_mm_s": grid.speeds.iter().map(|speed| speed.0).collect::<Vec<_>>(),
        "heights_mm": grid.heights.iter().map(|height| height.0).collect::<Vec<_>>(),
        "repeats": grid.repeats,
    });
    if !grid.powers.is_empty() {
        json["powers_percent"] = json!(grid.powers.iter().map(|power| power.0).collect::<Vec<_>>());
    }
    let has_pressure = spec.load.as_ref().is_some_and(|load| load.pressure.is_some());
    args.verbosity.report(&text(args, (&proven, has_pressure), &programs, &drawings), &json)
}

/// Writes the strips for a heat press.
fn run_pressed(args: &Args, loaded: &Loaded, press: &Press) -> Result<(), Failure> {
    // The files are proven and written as those of an iron are. The text tells the steps of the workshop in their order, and
    // the JSON has the keys of an iron that a press has, too.
    let (grid, proven) = (press_grid(args, loaded, press)?, coupons(args, loaded)?);
    let files: Vec<_> = proven.files().into_iter().map(|(name, bytes)| (name, bytes.into())).collect();
    tell(&publish_files(&args.output, &files)?.to_string());
    let drawings: Vec<&String> = proven
        .made_coupons()
        .files
        .iter()
        .filter(|file| file.output.kind == Kind::SealSvg)
        .map(|file| &file.name)
        .collect();
    let spec = lasting(&args.spec, &args.output);
    let text = format!(
        "wrote {} and {} to {}\nlook at {}: every strip with its setting; cut two sheets of each card of cards.svg, and a paper.svg \
         for each\nlay the paper between the sheets of its card, its lower edge on the line, and press each card at its setting and {}\n\
         cut the strips 25 mm wide with legs of 75 mm, pull them apart (T-peel), fill in peel_N in {}, then: stargrip-cam calibrate {} \
         --press --spec {}\n",
        count_text(grid.cards(), "card"),
        count_text(drawings.len(), "drawing"),
        escaped_line(&args.output),
        args.place(OVERVIEW),
        press.pressure_in_bar(),
        args.place(TABLE),
        argument(args.output.join(TABLE)),
        argument(&spec)
    );
    let json = json!({
        "wrote": args.output,
        "programs": [],
        "drawings": drawings,
        "look_at": OVERVIEW,
        "table": TABLE,
        "strips": grid.strips(),
        "temperatures_C": grid.temperatures.iter().map(|temperature| temperature.0).collect::<Vec<_>>(),
        "times_s": grid.times.iter().map(|time| time.0).collect::<Vec<_>>(),
        "repeats": grid.repeats,
    });
    args.verbosity.report(&text, &json)
}

/// The grid of settings of a press to test.
fn press_grid(args: &Args, loaded: &Loaded, press: &Press) -> Result<PressGrid, Failure> {
    if args.only.iter().any(|group| *group != CouponGroup::Strips) {
        loaded.with_programs("this coupon")?;
    }
    let is_of_laser = !args.powers.is_empty() || !args.focuses.is_empty();
    let is_path = !args.speeds.is_empty() || !args.heights.is_empty();
    if is_path || is_of_laser || args.process.is_some() {
        return Err(Failure::Usage(
            "a press has --temperatures and --times, no powers, speeds, heights, focuses and processes"
                .to_owned(),
        ));
    }
    let usual = PressGrid::around_press(press, usize::from(args.repeats.unwrap_or(REPEATS)));
    let grid = PressGrid {
        temperatures: values_or(&args.temperatures, &usual.temperatures),
        times: values_or(&args.times, &usual.times),
        ..usual
    };
    grid.refusal().map_or(Ok(grid), |why| Err(Failure::Message(why)))
}

/// The coupons that `args` describe, read back.
pub(super) fn coupons(args: &Args, loaded: &Loaded) -> Result<ProvenCoupons, Failure> {
    args.refuse_strips_alone()?;
    if let Some(press) = &loaded.reading.spec.press {
        let grid = press_grid(args, loaded, press)?;
        let coupons = MadeCoupons::pressed(&loaded.reading.spec, loaded.sources(), &grid);
        return coupons.prove().map_err(|findings| loaded.unproven(findings));
    }
    if !args.times.is_empty() {
        return Err(Failure::Usage("--times is for a heat press: an iron has --speeds".to_owned()));
    }
    let (spec, machine) = (&tested_spec(args, loaded)?, &loaded.machine);
    if args.only.contains(&CouponGroup::VActuator) && !spec.has_stars() {
        let text = "a V-actuator has the tips of a star, and this spec has a drawing: leave v-actuator out of --only";
        return Err(Failure::Message(text.to_owned()));
    }
    let (grid, groups) =
        (grid(args, loaded)?, values_or(&args.only, &CouponGroup::NAMES.map(|(_, group)| group)));
    let coupons = MadeCoupons::new(spec, machine, loaded.sources(), &grid, &groups)
        .map_err(|refusals| loaded.refused(refusals))?;
    coupons.of_process(args.process.clone()).prove().map_err(|findings| loaded.unproven(findings))
}

/// The spec whose `[seal]` is the process that is tested.
fn tested_spec(args: &Args, loaded: &Loaded) -> Result<Spec, Failure> {
    let spec = &loaded.reading.spec;
    let Some(name) = &args.process else { return Ok(spec.clone()) };
    let process = spec.process(name);
    if process.name == *name {
        return Ok(spec.sealed_by(&process));
    }
    let names: Vec<&str> = spec.processes.iter().map(|process| process.name.as_str()).collect();
    let hint = match spec::nearest(name, names.iter().copied()) {
        Some(near) => format!("did you mean {near}?"),
        None if names.is_empty() => format!("write a section [process.{name}]"),
        None => format!("there are {}", names.join(", ")),
    };
    Err(Failure::Message(format!(
        "{}: no process is called {name}; {hint}",
        escaped_line(&loaded.source.name)
    )))
}

/// The grid of settings to test.
fn grid(args: &Args, loaded: &Loaded) -> Result<StripGrid, Failure> {
    let seal = &tested_spec(args, loaded)?.seal;
    let is_iron_grid = !args.temperatures.is_empty() || !args.heights.is_empty();
    let is_laser_grid = !args.powers.is_empty() || !args.focuses.is_empty();
    match seal.power {
        Some(_) if is_iron_grid => {
            return Err(Failure::Usage(
                "a laser has --powers, --speeds and --focuses, no temperatures and heights".to_owned(),
            ));
        }
        None if is_laser_grid => {
            let text = "--powers and --focuses are for a laser: an iron has --temperatures and --heights";
            return Err(Failure::Usage(text.to_owned()));
        }
        _ => {}
    }
    let factors = if seal.power.is_some() { [0.5, 1.0, 2.0] } else { [1.0, 2.0, 5.0] };
    let usual_powers: Vec<Percent> = seal.power.map_or_else(Vec::new, |power| {
        let powers = [0.75, 1.0, 1.25].map(|factor| Percent(factor * power.0));
        powers.into_iter().filter(|power| POWERS.contains(power.0)).collect()
    });
    let usual_temperatures: &[Temperature] = if seal.power.is_some() { &[] } else { &[seal.temperature] };
    let grid = StripGrid {
        temperatures: values_or(&args.temperatures, usual_temperatures),
        powers: values_or(&args.powers, &usual_powers),
        speeds: values_or(&args.speeds, &factors.map(|factor| Speed(factor * seal.speed.0))),
        heights: values_or(
            if seal.power.is_some() { &args.focuses } else { &args.heights },
            &[seal.contact(&loaded.machine.process)],
        ),
        repeats: usize::from(args.repeats.unwrap_or(REPEATS)),
    };
    // The spec's temperature, and five times its speed, may be out of range, too.
    grid.refusal(&loaded.machine).map_or(Ok(grid), |why| Err(Failure::Message(why)))
}

/// `values`, or the `usual` ones if there are none.
fn values_or<T: Clone>(values: &[T], usual: &[T]) -> Vec<T> {
    if values.is_empty() { usual.to_vec() } else { values.to_vec() }
}

/// The written files, and the next steps; `has_pressure` is whether the spec states a pressure, from which the required strength follows.
fn text(
    args: &Args,
    (proven, has_pressure): (&ProvenCoupons, bool),
    programs: &[&String],
    drawings: &[&String],
) -> String {
    let (number, figures) = (count_text(programs.len(), "program"), count_text(drawings.len(), "drawing"));
    let mut lines = format!("wrote {number} and {figures} to {}\n", escaped_line(&args.output));
    // Writing to a String does not fail.
    for (name, coupon) in programs.iter().zip(&proven.made_coupons().coupons) {
        let _ = writeln!(lines, "  {name:32} {}", hours(coupon.program.time));
    }
    if args.verbosity.verbose {
        for (name, _) in proven.files() {
            let _ = writeln!(lines, "  {}", args.place(name));
        }
    }
    let settings = proven.made_coupons().coupons.iter().filter(|coupon| coupon.is_strips()).count();
    if settings > 0 {
        let spec = lasting(&args.spec, &args.output);
        let (look, results) = (args.place(OVERVIEW), args.place(TABLE));
        let _ = writeln!(lines, "look at {look}: every strip with its setting and its cut");
        let process = args.process.as_ref().map_or_else(String::new, |name| format!(" --process {name}"));
        let _ = writeln!(
            lines,
            "seal the strips of {}, cut each 25 mm wide with legs of 75 mm, pull them apart (T-peel), fill in \
             peel_N in {results}{}, then: stargrip-cam calibrate {}{}{process} --spec {}",
            if settings == 1 { "the program".to_owned() } else { format!("{settings} programs") },
            if has_pressure {
                String::new()
            } else {
                format!(", write `pressure` into [load] of {}", escaped_line(&spec))
            },
            argument(args.output.join(TABLE)),
            if proven.is_of_laser() { " --laser" } else { "" },
            argument(&spec)
        );
    }
    lines
}
