//! `stargrip-cam man`

use std::fs;
use std::path::{Path, PathBuf};

use clap::Command;
use clap_mangen::Man;

use crate::cli::escape::escaped_line;
use crate::cli::failure::{Failure, say};
use crate::cli::text_file::replace;
use crate::cli::verbosity::Quiet;

/// Arguments of `man`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The command whose page is printed; without it the program's.
    command: Option<String>,
    /// Write all pages into this directory instead.
    #[arg(long, value_name = "DIR", conflicts_with = "command")]
    dir: Option<PathBuf>,
    /// Has no effect: only the result is printed.
    #[command(flatten)]
    _quiet: Quiet,
}

/// Prints one manual page of `program`, for `man -l -`, or writes all of them.
pub(super) fn run(args: &Args, program: Command) -> Result<(), Failure> {
    let program_name = program.get_name().to_owned();
    let manual_pages = pages(program);
    if let Some(dir) = &args.dir {
        return write(dir, &manual_pages);
    }
    let name =
        args.command.as_ref().map_or(program_name.clone(), |command| format!("{program_name}-{command}"));
    match manual_pages.iter().find(|(page, _)| *page == name) {
        Some((_, text)) => say(text),
        None => Err(Failure::Message(format!(
            "there is no page {}; `stargrip-cam --help` lists the commands",
            escaped_line(name)
        ))),
    }
}

/// All manual pages, with their names.
fn pages(program: Command) -> Vec<(String, String)> {
    let mut program = program.disable_help_subcommand(true);
    // `build` gives the commands their full names and the common options.
    program.build();
    let commands = program.get_subcommands().filter(|command| !command.is_hide_set());
    std::iter::once(&program).chain(commands).map(page).collect()
}

fn page(command: &Command) -> (String, String) {
    let name = command.get_display_name().unwrap_or_else(|| command.get_name()).to_owned();
    let mut text = Vec::new();
    // Writing to memory does not fail.
    let _ = Man::new(command.clone()).render(&mut text);
    (name, String::from_utf8_lossy(&text).into_owned())
}

fn write(dir: &Path, pages: &[(String, String)]) -> Result<(), Failure> {
    fs::create_dir_all(dir).map_err(|error| Failure::file("create", dir, &error))?;
    for (name, text) in pages {
        replace(&dir.join(format!("{name}.1")), text)?;
    }
    say(&format!("wrote {} pages to {}\n", pages.len(), escaped_line(dir)))
}
