//! The command line: commands, files, terminal. Only this module touches files, arguments and the environment.
//!
//! Exit codes: 0 done; 1 the spec, the design or the outputs are refused; 2 wrong usage. Results go to
//! standard output, faults to standard error.

mod actuator;
mod align;
mod batch;
mod bench;
mod build;
mod cache;
mod calibrate;
mod candidates;
mod check;
mod completions;
mod coupon;
mod defaults;
mod details;
pub mod embedded;
mod escape;
mod explain;
mod failure;
mod feedcheck;
mod findings;
mod interrupt;
mod kinds;
mod load;
mod machines;
mod man;
mod material;
mod new;
mod new_object;
mod open;
mod optimize;
mod overview;
mod package_file;
mod predict;
mod progress;
mod publish;
mod rebuilt;
mod resume;
mod schema;
mod shell;
mod source_file;
mod study;
mod terminal;
mod text_file;
mod trade;
mod verbosity;
mod verify;
mod version;
mod watch;
mod whole_file;
mod words;

use std::env;
use std::ffi::OsString;
use std::process::ExitCode;

use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser, Subcommand};

use crate::cli::escape::escaped_line;

pub use publish::{PublishFault, Published, publish};

/// Fabrication CAM for fabric-based star soft grippers.
#[derive(Parser, Debug)]
#[command(
    version,
    disable_version_flag = true,
    about,
    after_help = "Start with `stargrip-cam new`, then `stargrip-cam build spec.toml`."
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Print the version; with -v also the build: commit, target, features.
    #[arg(short = 'V', long, action = clap::ArgAction::Version)]
    version: Option<bool>,
}

/// The commands in the groups of `--help`; a command without a group is an old name of `study run`.
const GROUPS: [(&str, &[&str]); 4] = [
    ("Design", &["new", "check", "build", "verify"]),
    ("Workshop", &["machines", "feedcheck", "coupon", "calibrate", "align", "resume"]),
    ("Numbers", &["predict", "actuator", "optimize", "study", "trade"]),
    ("Shell", &["schema", "explain", "completions", "man"]),
];

#[derive(Subcommand, Debug)]
enum Command {
    /// Write a commented starter spec, or with --object the spec of a gripper that holds the object.
    New(new::Args),
    /// Read a spec and print what would be built, or all of its faults.
    Check(check::Args),
    /// Build everything in a spec, prove it, and publish it as one directory.
    Build(build::Args),
    /// Prove a published directory: hashes, and every file against the exact geometry.
    Verify(verify::Args),
    /// List the built-in machine profiles and how to know your controller; check a profile of your own.
    Machines(machines::Args),
    /// Write a program that measures the machine's real speed.
    Feedcheck(feedcheck::Args),
    /// Write programs for seal strips and pouches that test a machine and a fabric.
    Coupon(coupon::Args),
    /// Convert bench tests (peeled strips, a V-actuator, a disc) into values for the spec.
    Calibrate(calibrate::Args),
    /// Write the programs of a build for a sheet that was moved, from where its two marks lie now.
    Align(align::Args),
    /// Write a program for the rest of a job that was interrupted.
    Resume(resume::Args),
    /// Predict the behaviour of the gripper of a spec: closing, force, pressures, payload.
    Predict(predict::Args),
    /// Predict the behaviour of one hinge between two arms: angle, stiffness, moment against angle.
    Actuator(actuator::Args),
    /// Search for the best star: points, tip angle, width and radii within bounds, under constraints.
    Optimize(optimize::Args),
    /// Compute many designs at once: a row for each of a study file, or for every combination of values; show a study.
    Study(study::Args),
    /// Compare cost and error of every model: shells are stored, the others are measured on this machine.
    Trade(trade::Args),
    /// Print the JSON Schema of a spec, for editors.
    Schema(schema::Args),
    /// Print the meaning of a message's code, and the remedy.
    Explain(explain::Args),
    /// Print a script that completes commands and options in a shell.
    Completions(completions::Args),
    /// Print a page of the manual.
    Man(man::Args),
    /// Another name of `study run`.
    #[command(hide = true, alias = "table")]
    Sweep(study::compute::Args),
}

/// The program's commands, with its help in groups.
fn program() -> clap::Command {
    let program = Cli::command();
    let line = |name: &&str| {
        let description = program.find_subcommand(name).and_then(clap::Command::get_about);
        format!("  {name:12} {}\n", description.map(ToString::to_string).unwrap_or_default())
    };
    let group = |(title, names): &(&str, &[&str])| {
        format!("{title}:\n{}\n", names.iter().map(line).collect::<String>())
    };
    let groups: String = GROUPS.iter().map(group).collect();
    program.help_template(format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{groups}Options:\n{{options}}{{after-help}}"
    ))
}

/// Runs the program with the arguments of the process.
pub fn main() -> ExitCode {
    interrupt::outlive_size_limit();
    ExitCode::from(run(env::args_os().collect()))
}

/// Runs the program with `args`, of which the first is its name, and returns the exit code. `build --watch` does not return: Ctrl-C ends
/// it.
pub fn run(args: Vec<OsString>) -> u8 {
    if version::wants_build(&args) {
        return failure::say(&version::build()).map_or_else(failure::Failure::report, |()| 0);
    }
    let parsed = program().try_get_matches_from(&args);
    let parsed = parsed.and_then(|matches| Ok((Cli::from_arg_matches(&matches)?, wants_json(&matches))));
    let (cli, json) = match parsed {
        Ok(parsed) => parsed,
        Err(fault) => return misused(args, fault),
    };
    let result = match cli.command {
        Command::Build(args) => build::run(&args),
        Command::Check(args) => check::run(&args),
        Command::Predict(args) => predict::run(&args),
        Command::Actuator(args) => actuator::run(&args),
        Command::Optimize(args) => optimize::run(&args),
        Command::Sweep(args) => study::compute::run(&args),
        Command::Study(args) => study::run(&args),
        Command::Trade(args) => trade::run(&args),
        Command::Verify(args) => verify::run(&args),
        Command::New(args) => new::run(&args),
        Command::Machines(args) => machines::run(&args),
        Command::Feedcheck(args) => feedcheck::run(&args),
        Command::Coupon(args) => coupon::run(&args),
        Command::Calibrate(args) => calibrate::run(&args),
        Command::Align(args) => align::run(&args),
        Command::Resume(args) => resume::run(&args),
        Command::Schema(args) => schema::run(&args),
        Command::Explain(args) => explain::run(&args),
        Command::Completions(args) => completions::run(&args, program()),
        Command::Man(args) => man::run(&args, program()),
    };
    match result {
        Ok(()) => 0,
        Err(failure) if json => failure.report_json(),
        Err(failure) => failure.report(),
    }
}

/// Whether the arguments contain `--json`.
fn wants_json(matches: &ArgMatches) -> bool {
    let Some((_, command)) = matches.subcommand() else { return false };
    let flag = command.try_get_one::<bool>("json").ok().flatten().copied();
    flag.unwrap_or(false) || wants_json(command)
}

/// Prints a message of `clap`: help, or wrong usage. It quotes arguments, so they are escaped first.
fn misused(args: Vec<OsString>, fault: clap::Error) -> u8 {
    let fault = program().try_get_matches_from(args.into_iter().map(escaped_line)).err().unwrap_or(fault);
    // A failed print leaves no place for a message.
    let _ = fault.print();
    u8::try_from(fault.exit_code()).unwrap_or(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Commands whose only answer is a document for other programs.
    const DOCUMENTS: [&str; 3] = ["schema", "completions", "man"];
    /// Commands that may run for hours and whose answers are files.
    const FILES: [&str; 4] = ["run", "show", "join", "sweep"];

    #[test]
    fn every_command_that_reports_speaks_as_loud_as_one_likes() {
        let stargrip = program();
        let study = stargrip.find_subcommand("study").expect("a command").get_subcommands();
        for command in stargrip.get_subcommands().filter(|command| command.get_name() != "study").chain(study)
        {
            let name = command.get_name();
            let has_option = |option: &str| command.get_arguments().any(|arg| arg.get_long() == Some(option));
            let output_options =
                ["quiet", "verbose", "json"].into_iter().filter(|option| has_option(option)).count();
            let excepted = DOCUMENTS.contains(&name) || FILES.contains(&name);
            assert!(
                output_options == 3 || (excepted && output_options == 1),
                "{name} has {output_options} of --quiet, --verbose, --json"
            );
            assert!(has_option("quiet"), "{name}");
        }
        stargrip.clone().debug_assert();
        // Each command is in one group, or is an old name.
        let mut grouped: Vec<&str> = GROUPS.iter().flat_map(|(_, names)| names.iter().copied()).collect();
        let mut visible: Vec<&str> = stargrip
            .get_subcommands()
            .filter(|command| !command.is_hide_set())
            .map(clap::Command::get_name)
            .collect();
        grouped.sort_unstable();
        visible.sort_unstable();
        assert_eq!(grouped, visible);
    }
}
