//! `stargrip-cam machines`

use std::fmt::Write;

use crate::cli::failure::Failure;
use crate::cli::failure::say;
use crate::spec;
use crate::spec::Source;

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
    match &args.command {
        Some(Command::Show { name }) => match spec::builtin_machine(name) {
            Some(text) => say(text),
            None => {
                let known: Vec<&str> = spec::builtin_machines().collect();
                let known = known.join(", ");
                Err(Failure::Message(format!("no built-in profile is called {name}; there are: {known}")))
            }
        },
        None => say(&list()?),
    }
}

fn list() -> Result<String, Failure> {
    let mut out = String::new();
    for name in spec::builtin_machines() {
        let text = spec::builtin_machine(name).unwrap_or_default();
        let machine = spec::read_machine(&Source::new(name, text))?;
        let _ = writeln!(out, "{name:12} {}", machine.description);
    }
    Ok(out)
}
