//! The commands' functions for a program that embeds this crate: the Python package computes as the command does, without its output.
//!
//! A spec is read with its machine profile, a build's directory no further than its manifest states, and a search takes the arguments of
//! the command. So files, limits and defaults are defined once. Nothing is printed.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Command;

use crate::answer;
use crate::answer::refused::at_keys;
use crate::cli::load::{Loaded, machine_source, read_source, with_drawing};
use crate::cli::words::value_of;
use crate::cli::{actuator, cache, optimize, predict, verify};
use crate::design::Refusals;
use crate::forecast::actuator::Actuator;
use crate::forecast::optimize::{Evaluation, SearchResult, shortfalls};
use crate::forecast::shell::Detail;
use crate::pipeline::PublishedBuild;
use crate::spec;
use crate::spec::{Faults, Machine, ModelChoice, Reading, Source};
use crate::verify::{OutputFiles, Proof};
use inflatable::mechanics::hinge::Level;

pub use crate::cli::failure::Failure;

/// A valid spec with its valid machine profile.
#[derive(Clone, Debug)]
pub struct Given {
    /// The spec's text and its name.
    pub source: Source,
    /// The parsed spec.
    pub reading: Reading,
    /// The parsed machine profile.
    pub machine: Machine,
    /// The machine profile as resolved.
    pub machine_text: String,
    /// The spec's own path; the path of its machine profile is relative to it.
    pub path: PathBuf,
}

impl Given {
    /// The spec of the file `path`; "-" is standard input.
    ///
    /// # Errors
    /// If the file cannot be read, or if the spec or its machine profile is invalid; all faults are listed.
    pub fn from_file(path: &Path) -> Result<Self, Failure> {
        Self::from_source(read_source(path)?, path)
    }

    /// Reads a spec from a text; a path of its machine profile is relative to the directory of `path`.
    ///
    /// # Errors
    /// As for [`Given::from_file`].
    pub fn from_source(source: Source, path: &Path) -> Result<Self, Failure> {
        // A text has the same limits as a file.
        let source = Source::from_bytes(source.name, source.text.as_bytes())?;
        let (reading, _) = with_drawing(path, &source, spec::read(&source)?)?;
        let (profile, _) = machine_source(path, &source, &reading)?;
        let machine = spec::read_machine(&profile)?;
        Ok(Self { source, reading, machine, machine_text: profile.text, path: path.to_owned() })
    }

    /// Refusals of the design as faults at their keys.
    pub fn refused(&self, refusals: Refusals) -> Faults {
        at_keys(&self.source, &self.reading.raw, refusals)
    }
}

/// Proves the build in the directory `dir`, as `verify` does.
///
/// # Errors
/// If the directory cannot be read, or holds no build.
pub fn prove(dir: &Path) -> Result<Proof, Failure> {
    verify::holds_a_build(dir)?;
    let (published, files): (PublishedBuild, OutputFiles<'_>) = verify::read_directory(dir)?;
    Ok(published.prove(&files))
}

/// A proof as `verify --json` prints it.
pub fn proof_json(proof: &Proof) -> String {
    answer::proof::json(proof)
}

/// Result of a search.
#[derive(Clone, Debug)]
pub struct Optimum {
    /// All results of the search.
    pub found: SearchResult,
    /// The spec's text with the best design that can be built; `None` without such a design.
    pub best: Option<String>,
    /// For each of `found.best` the constraints that it violates, and by which fraction.
    pub short: Vec<Vec<(&'static str, f64)>>,
}

/// Searches around `given` as `optimize` does; `options` are those of the command ("--points", "4..6"), without the spec. Raising `cancel`
/// ends the search without a result.
///
/// # Errors
/// If an option is wrong, if two exclude each other, or if the search was cancelled.
pub fn optimum(given: &Given, options: &[String], cancel: &AtomicBool) -> Result<Optimum, Failure> {
    // The caller reports progress and handles Ctrl-C.
    let options: Vec<String> = options.iter().cloned().chain(["--quiet".to_owned()]).collect();
    let args: optimize::Args = parsed(&options, Some(Path::new("-")))?;
    let Given { source, reading, machine, machine_text, .. } = given.clone();
    let loaded = Loaded::quiet(source, reading, machine, machine_text);
    let (found, constraints) = optimize::answer(&args, &loaded, Some(cancel))?;
    if cancel.load(Ordering::Relaxed) {
        return Err(Failure::Interrupted);
    }
    let best = optimize::best(&args, &loaded, &found, &constraints)?;
    let short =
        found.best.iter().map(|Evaluation { point, answer, .. }| shortfalls(point, answer, &constraints));
    Ok(Optimum { short: short.collect(), best: best.map(|best| best.spec), found })
}

/// Options of a prediction of stars.
#[derive(Clone, Debug)]
pub struct StarQuestion {
    /// The requested model; `None` for the spec's own.
    pub model: Option<ModelChoice>,
    /// Radii of round objects, m.
    pub radii: Vec<f64>,
    /// Fineness of the shell's mesh.
    pub detail: Detail,
}

/// The question that the options of `predict` describe ("--model", "ring"), without the spec.
///
/// # Errors
/// If an option is wrong.
pub fn star_question(options: &[String]) -> Result<StarQuestion, Failure> {
    let args: predict::Args = parsed(options, Some(Path::new("-")))?;
    Ok(StarQuestion { model: args.model(), radii: args.radii().to_vec(), detail: args.detail() })
}

/// The model called `name`, such as "ring"; `None` if there is none.
pub fn model(name: &str) -> Option<ModelChoice> {
    value_of(&ModelChoice::ALL, name)
}

/// A V-actuator and the options of its prediction.
#[derive(Clone, Debug)]
pub struct ActuatorQuestion {
    /// The actuator.
    pub actuator: Actuator,
    /// The angles at which its moment is computed, rad.
    pub angles: Vec<f64>,
    /// The hinge model; `None` for the shell model.
    pub level: Option<Level>,
    /// Fineness of the shell's mesh.
    pub detail: Detail,
}

/// The question that the options of `actuator` describe.
///
/// # Errors
/// If an option is wrong or missing.
pub fn actuator_question(options: &[String]) -> Result<ActuatorQuestion, Failure> {
    let args: actuator::Args = parsed(options, None)?;
    Ok(ActuatorQuestion {
        actuator: args.actuator()?,
        angles: args.angles().to_vec(),
        level: args.level(),
        detail: args.detail(),
    })
}

/// The options of a command as keywords of a function: "tube_width". Options about output are left out.
#[derive(Clone, Debug)]
pub struct Keywords(Vec<String>);

impl Keywords {
    /// The keywords of `optimize`.
    pub fn of_optimize() -> Self {
        Self::of::<optimize::Args>()
    }

    /// The keywords of `actuator`.
    pub fn of_actuator() -> Self {
        Self::of::<actuator::Args>()
    }

    fn of<A: clap::Args>() -> Self {
        let command = A::augment_args(Command::new("stargrip-cam"));
        let options = command.get_arguments().filter_map(clap::Arg::get_long);
        let asked = options.filter(|option| !OF_THE_SCREEN.contains(option));
        Self(asked.map(|option| option.replace('-', "_")).collect())
    }

    /// All keywords, in the order of the command's help.
    pub fn names(&self) -> &[String] {
        &self.0
    }

    /// The keyword with the most similar spelling to `name`.
    pub fn nearest(&self, name: &str) -> Option<&str> {
        spec::nearest(name, self.0.iter().map(String::as_str))
    }
}

/// Options about the output and the cache, and the option that runs a second model.
const OF_THE_SCREEN: [&str; 6] = ["verbose", "quiet", "json", "vtu", "no-cache", "confirm"];

/// The arguments of a command from its options and the spec's path, if it takes one.
fn parsed<A: clap::Args>(options: &[String], spec: Option<&Path>) -> Result<A, Failure> {
    let usage = |fault: clap::Error| Failure::Usage(without_dashes(&fault));
    let command = A::augment_args(Command::new("stargrip-cam").no_binary_name(true));
    let arguments = options.iter().map(OsString::from).chain(spec.map(OsString::from));
    A::from_arg_matches(&command.try_get_matches_from(arguments).map_err(usage)?).map_err(usage)
}

/// A fault of arguments in terms of a function's keywords: "invalid value '3' for tube_width: ...". Only the first paragraph is kept; the
/// others are advice for a command line.
fn without_dashes(fault: &clap::Error) -> String {
    let text = fault.to_string();
    let lines: Vec<&str> = text.lines().take_while(|line| !line.is_empty()).map(str::trim).collect();
    let line = lines.join(" ");
    let mut line = line.strip_prefix("error: ").unwrap_or(&line).to_owned();
    while let Some((before, rest)) = line.split_once("'--") {
        let Some((option, after)) = rest.split_once('\'') else { break };
        let name = option.split([' ', '=']).next().unwrap_or_default().replace('-', "_");
        line = format!("{before}{name}{after}");
    }
    line
}

/// Sets the library `file` that holds this program's code: the cache of shell answers depends on it, not on the loading program.
pub fn code_is_in(file: PathBuf) {
    cache::code_is_in(file);
}
