//! `stargrip-cam machines`

use std::fmt::Write;

use crate::cli::failure::{Failure, say};
use crate::cli::harmless::shown;
use crate::spec;
use crate::spec::{Motion, Source};

/// Arguments of `machines`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(clap::Subcommand, Debug)]
enum Command {
    /// Print one profile, to start your own from.
    Show {
        /// Name of a built-in profile.
        name: String,
    },
}

/// Lists the built-in profiles, or prints one.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let Some(Command::Show { name }) = &args.command else { return say(&list()?) };
    let known: Vec<&str> = spec::builtin_machines().collect();
    let text = spec::builtin_machine(name).ok_or_else(|| {
        Failure::Message(format!(
            "no built-in profile is called {}; there are: {}",
            shown(name),
            known.join(", ")
        ))
    })?;
    say(text)
}

/// The seal speed of the paper, mm/s: what a machine has to go at, and most cannot.
const SLOW: f64 = 0.1;

fn list() -> Result<String, Failure> {
    let mut out = String::new();
    for name in spec::builtin_machines() {
        let text = spec::builtin_machine(name).unwrap_or_default();
        let machine = spec::read_machine(&Source::new(name, text))?;
        let _ = writeln!(out, "{name:15} {}", machine.description);
        let _ = writeln!(out, "{:15}   at {SLOW} mm/s: {}", "", ability(&machine.motion));
    }
    Ok(out)
}

/// What a machine does when it is told to go at 0.1 mm/s.
fn ability(motion: &Motion) -> String {
    let need = motion.steps_needed(SLOW).map_or(String::new(), |(axis, diagonal)| {
        format!("; as it is from {:.0} steps/mm along an axis, {:.0} at 45 deg", axis.ceil(), diagonal.ceil())
    });
    match (motion.speed_range(), motion.steps_per_mm) {
        (Some((_, most)), _) if most <= SLOW => "as it is".to_owned(),
        (Some((least, most)), Some([x, _, _])) => {
            format!("chopped; alone, at {x} steps/mm, it would run at {least:.2} to {most:.2} mm/s{need}")
        }
        (Some((_, most)), None) => format!("chopped; alone it would run at {most:.2} mm/s"),
        (None, _) => format!("unknown: run `stargrip-cam feedcheck`{need}"),
    }
}
