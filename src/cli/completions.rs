//! `stargrip-cam completions`

use clap::Command;
use clap_complete::{Shell, generate};

use crate::cli::failure::{Failure, say};
use crate::cli::verbosity::Quiet;

/// Arguments of `completions`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The shell.
    shell: Shell,
    /// Has no effect: only the result is printed.
    #[command(flatten)]
    _quiet: Quiet,
}

/// Prints a script with which a shell completes the commands of `program`.
pub(super) fn run(args: &Args, mut program: Command) -> Result<(), Failure> {
    let (name, mut text) = (program.get_name().to_owned(), Vec::new());
    generate(args.shell, &mut program, name, &mut text);
    say(&String::from_utf8_lossy(&text))
}
