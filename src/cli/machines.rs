//! `stargrip-cam machines`

use std::fmt::Write;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::cli::escape::{argument, escaped_line};
use crate::cli::failure::{Failure, say};
use crate::cli::source_file::read_source;
use crate::cli::verbosity::{Quiet, Verbosity, pretty};
use program::plan::{actual_speed, homing_by_hand, laser_settings};
use spec::units::Least;
use spec::{Machine, Motion, SealingTool, StepRate};

/// Arguments of `machines`.
#[derive(clap::Args, Debug)]
#[command(args_conflicts_with_subcommands = true)]
pub(super) struct Args {
    #[command(subcommand)]
    command: Option<MachinesCommand>,
    #[command(flatten)]
    verbosity: Verbosity,
}

#[derive(clap::Subcommand, Debug)]
enum MachinesCommand {
    /// Print one profile, to start your own from.
    Show {
        /// Name of a built-in profile.
        name: String,
        /// Has no effect: only the result is printed.
        #[command(flatten)]
        _quiet: Quiet,
    },
    /// Read your own profile without a spec, and print all of its faults, or what it says.
    Check {
        /// The profile, a TOML file; "-" is standard input.
        profile: PathBuf,
        #[command(flatten)]
        verbosity: Verbosity,
    },
}

/// Lists the built-in profiles, prints one, or checks one of the user's own.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    match &args.command {
        Some(MachinesCommand::Show { name, .. }) => show(name),
        Some(MachinesCommand::Check { profile, verbosity }) => check(profile, *verbosity),
        None => {
            let builtin_machines = machines()?;
            match args.verbosity {
                Verbosity { json: true, .. } => say(&json(&builtin_machines)),
                Verbosity { quiet: true, .. } => say(&names(&builtin_machines)),
                verbosity => verbosity.remark(&list(&builtin_machines, verbosity.verbose)),
            }
        }
    }
}

/// Prints the text of the built-in profile `name`.
fn show(name: &str) -> Result<(), Failure> {
    if let Some(text) = spec::builtin_machine(name) {
        return say(text);
    }
    let builtin_names: Vec<&str> = spec::builtin_machines().collect();
    let remedy = if Path::new(name).is_file() {
        format!("`stargrip-cam machines check {}` reads the file of this name", argument(name))
    } else {
        let names = || format!("there are: {}", builtin_names.join(", "));
        spec::machine_remedy(name).unwrap_or_else(names)
    };
    Err(Failure::Message(format!("no built-in profile is called {}; {remedy}", escaped_line(name))))
}

/// Reads the profile in the file `path`, and prints what it says.
fn check(path: &Path, verbosity: Verbosity) -> Result<(), Failure> {
    let machine = match path.to_str().and_then(spec::builtin_machine) {
        Some(text) if !path.exists() => spec::read_machine(&spec::Source::new("built-in profile", text))?,
        _ => spec::read_machine(&read_source(path)?)?,
    };
    let unknown = unknown_values(&machine);
    let mut text = format!("{}: sound; {}\n", escaped_line(&machine.name), controller(&machine));
    let _ = writeln!(text, "{}", ability_in_words(&machine));
    if !unknown.is_empty() {
        let _ = writeln!(text, "unknown, so not checked: {}", unknown.join(", "));
    }
    let laser = machine.controller.laser;
    let settings = laser.map(|drive| laser_settings(&machine.controller, drive)).into_iter().flatten();
    let homing = homing_by_hand(&machine).map(str::to_owned);
    let tasks: Vec<String> = settings.chain(homing).chain(machine.script.requires.iter().cloned()).collect();
    for task in &tasks {
        let _ = writeln!(text, "before every job: {}", escaped_line(task));
    }
    if machine.tool != SealingTool::Press {
        text += "speed, reach and clamps are checked with a spec: name the file as `profile` in [machine], then `stargrip-cam check`\n";
    }
    let mut json = machine_json(&machine);
    json["unknown"] = json!(unknown);
    json["requires"] = json!(tasks);
    verbosity.report(&text, &json)
}

/// The dialect and the heater of a machine, in words.
fn controller(machine: &Machine) -> String {
    match machine.tool {
        SealingTool::Iron => {
            format!("dialect {}, heated {}", machine.controller.dialect.name(), machine.heater())
        }
        SealingTool::Laser => format!("dialect {}, a laser", machine.controller.dialect.name()),
        SealingTool::Press => "a heat press".to_owned(),
    }
}

/// The keys of the profile whose values are unknown, so that nothing can be checked against them.
fn unknown_values(machine: &Machine) -> Vec<&'static str> {
    if machine.tool == SealingTool::Press {
        return Vec::new();
    }
    let motion = &machine.motion;
    let keys = [
        ("[work_area] x, y", machine.bench.work_area.is_none()),
        ("[motion] x_steps_per_mm, y_steps_per_mm, z_steps_per_mm", motion.steps_per_mm.is_none()),
        ("[motion] min_step_rate", motion.step_rate == StepRate::Unknown),
        ("[motion] acceleration", motion.acceleration.is_none()),
    ];
    keys.into_iter().filter(|(_, is_unknown)| *is_unknown).map(|(key, _)| key).collect()
}

/// The seal speed of the paper, mm/s; most machines cannot move this slowly.
const SLOW: f64 = 0.1;

/// All built-in profiles.
fn machines() -> Result<Vec<Machine>, Failure> {
    let read = |name| Machine::builtin(name).map_err(Failure::Message);
    spec::builtin_machines().map(read).collect()
}

/// One name a line, for scripts.
fn names(machines: &[Machine]) -> String {
    machines.iter().flat_map(|machine| [machine.name.as_str(), "\n"]).collect()
}

/// Which controller a user has: a row a profile; with `-v` what each can do at the seal speed of the paper. Below it machines without one.
fn list(machines: &[Machine], verbose: bool) -> String {
    let mut text =
        format!("{:15} {:15} {:8} {}\n", "profile", "dialect", "heated", "how to know your controller");
    for machine in machines {
        let dialect = match machine.tool {
            SealingTool::Iron | SealingTool::Laser => machine.controller.dialect.name(),
            SealingTool::Press => "none",
        };
        let _ = writeln!(text, "{:15} {dialect:15} {:8} {}", machine.name, machine.heater(), machine.sign());
        let _ = writeln!(text, "{:15} {}", "", machine.description);
        if verbose {
            let _ = writeln!(text, "{:15} {}", "", ability_in_words(machine));
        }
    }
    text += "\nno profile, and what to try:\n";
    for machine in spec::UNSERVED_MACHINES {
        let _ = writeln!(text, "  {}\n      {}", machine.names, machine.remedy);
    }
    text + "\nthe printed lines show when a console connects; `stargrip-cam machines show NAME` prints a profile to start your own from, \
            `machines check FILE` reads it\n"
}

fn json(machines: &[Machine]) -> String {
    let unserved = |machine: spec::UnservedMachine| json!({ "names": machine.names, "try": machine.remedy });
    pretty(&json!({
        "speed_mm_s": SLOW,
        "machines": machines.iter().map(machine_json).collect::<Vec<_>>(),
        "unserved": spec::UNSERVED_MACHINES.map(unserved),
    }))
}

/// The description of a profile as JSON.
fn machine_json(machine: &Machine) -> Value {
    json!({
        "name": machine.name,
        "description": machine.description,
        "ability": ability(machine),
        "dialect": (machine.tool != SealingTool::Press).then(|| machine.controller.dialect.name()),
        "heated": machine.heater(),
        "sign": machine.sign(),
    })
}

/// The ability of a machine that no program moves.
const NO_PROGRAM: &str = "no program: `time` and `temperature` in [press]";

/// The behaviour at the seal speed of the paper, with that speed where there is one.
fn ability_in_words(machine: &Machine) -> String {
    match machine.tool {
        SealingTool::Iron => format!("at {SLOW} mm/s: {}", ability(machine)),
        SealingTool::Press | SealingTool::Laser => ability(machine),
    }
}

/// The behaviour of a machine at a commanded speed of 0.1 mm/s.
fn ability(machine: &Machine) -> String {
    match machine.tool {
        SealingTool::Iron => steady_or_chopped(&machine.motion),
        SealingTool::Press => NO_PROGRAM.to_owned(),
        SealingTool::Laser => powered(&machine.motion),
    }
}

/// The speeds of a laser, which is never chopped into strokes.
fn powered(motion: &Motion) -> String {
    motion.speed_range().map_or_else(
        || {
            "`power` and `speed` in [seal]; the lowest speed is unknown: run `stargrip-cam feedcheck`"
                .to_owned()
        },
        |(_, lowest)| format!("`power` and `speed` in [seal], from {} mm/s on", Least(lowest)),
    )
}

/// Whether a controller moves that slowly, and how.
fn steady_or_chopped(motion: &Motion) -> String {
    let need = motion.steps_needed(SLOW).map_or(String::new(), |(axis, diagonal)| {
        format!(
            "; without chopping from {:.0} steps/mm along an axis, {:.0} at 45 deg",
            axis.ceil(),
            diagonal.ceil()
        )
    });
    let Some(range) = motion.speed_range() else {
        return format!("unknown: run `stargrip-cam feedcheck`{need}");
    };
    if range.1 <= SLOW {
        return "without chopping".to_owned();
    }
    let resolution = motion.steps_per_mm.map_or(String::new(), |[x, ..]| format!(", at {x} steps/mm,"));
    format!("chopped; without chopping{resolution} it would run {}{need}", actual_speed(motion, SLOW, range))
}
