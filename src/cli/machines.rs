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
    let Some(Command::Show { name }) = &args.command else { return say(&list()?) };
    let known: Vec<&str> = spec::builtin_machines().collect();
    let text = spec::builtin_machine(name).ok_or_else(|| {
        Failure::Message(format!("no built-in profile is called {name}; there are: {}", known.join(", ")))
    })?;
    say(text)
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
