//! `stargrip-cam machines`

use std::fmt::Write;

use serde_json::json;

use crate::cli::escape::shown;
use crate::cli::failure::{Failure, say};
use crate::cli::verbosity::{Quiet, Verbosity, pretty};
use program::plan::actual_speed;
use spec::{Machine, Motion, SealingTool};

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
}

/// Lists the built-in profiles, or prints one.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let Some(MachinesCommand::Show { name, .. }) = &args.command else {
        let builtin_machines = machines()?;
        return match args.verbosity {
            Verbosity { json: true, .. } => say(&json(&builtin_machines)),
            Verbosity { quiet: true, .. } => say(&names(&builtin_machines)),
            verbosity => verbosity.remark(&list(&builtin_machines)),
        };
    };
    let builtin_names: Vec<&str> = spec::builtin_machines().collect();
    let text = spec::builtin_machine(name).ok_or_else(|| {
        Failure::Message(format!(
            "no built-in profile is called {}; there are: {}",
            shown(name),
            builtin_names.join(", ")
        ))
    })?;
    say(text)
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

fn list(machines: &[Machine]) -> String {
    let mut text = String::new();
    for machine in machines {
        let _ = writeln!(text, "{:15} {}", machine.name, machine.description);
        let _ = writeln!(text, "{:15}   {}", "", at_slow(machine));
    }
    text
}

fn json(machines: &[Machine]) -> String {
    let one = |machine: &Machine| json!({ "name": machine.name, "description": machine.description, "ability": ability(machine) });
    pretty(&json!({ "speed_mm_s": SLOW, "machines": machines.iter().map(one).collect::<Vec<_>>() }))
}

/// The ability of a machine that no program moves.
const NO_PROGRAM: &str = "no program: `time` and `temperature` in [press]";

/// The behaviour at the seal speed of the paper, with that speed where there is one.
fn at_slow(machine: &Machine) -> String {
    match machine.tool {
        SealingTool::Iron => format!("at {SLOW} mm/s: {}", ability(machine)),
        SealingTool::Press => ability(machine),
    }
}

/// The behaviour of a machine at a commanded speed of 0.1 mm/s.
fn ability(machine: &Machine) -> String {
    match machine.tool {
        SealingTool::Iron => steady_or_chopped(&machine.motion),
        SealingTool::Press => NO_PROGRAM.to_owned(),
    }
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
