//! The same face inside another program: what the Python package does as the command does it, but for the words.
//!
//! A spec is read with the machine profile it names, a build's directory is read no further than it claims to go, and a search
//! takes the arguments of the command, so that files, limits and defaults have one home. Nothing is printed.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::{Args as _, Command, FromArgMatches};

use crate::cli::load::{Loaded, machine_source, read_source, refused};
use crate::cli::{cache, optimize, verify};
use crate::design::{Design, Refusals};
use crate::forecast::optimize::{Evaluated, Found, shortfalls};
use crate::pipeline::Claim;
use crate::spec;
use crate::spec::{Faults, Machine, Reading, Source};
use crate::verify::{OutputFiles, Proof};

pub use crate::cli::failure::Failure;

/// A spec with the machine it names, both read and valid.
#[derive(Clone, Debug)]
pub struct Given {
    /// The spec's text and its name.
    pub source: Source,
    /// What it says.
    pub reading: Reading,
    /// What it is made on.
    pub machine: Machine,
    /// The machine profile as resolved.
    pub machine_text: String,
    /// The path that the machine profile's is relative to: the spec's own.
    pub path: PathBuf,
}

impl Given {
    /// The spec of the file `path`; "-" is standard input.
    ///
    /// # Errors
    /// If the file cannot be read, or all that is wrong with the spec or its machine profile.
    pub fn from_file(path: &Path) -> Result<Self, Failure> {
        Self::from_source(read_source(path)?, path)
    }

    /// The spec of a text that is at hand; a machine profile that it names by path is looked for beside `path`.
    ///
    /// # Errors
    /// As for [`Given::from_file`].
    pub fn from_source(source: Source, path: &Path) -> Result<Self, Failure> {
        // The limits of a file's text are those of every text.
        let source = Source::from_bytes(source.name, source.text.as_bytes())?;
        let reading = spec::read(&source)?;
        let (profile, _) = machine_source(path, &source, &reading)?;
        let machine = spec::read_machine(&profile)?;
        Ok(Self { source, reading, machine, machine_text: profile.text, path: path.to_owned() })
    }

    /// Refusals of its design as faults at the keys they speak of.
    pub fn refused(&self, refusals: Refusals) -> Faults {
        refused(&self.source, &self.reading.raw, refusals)
    }
}

/// Proves the build in the directory `dir`, as `verify` does.
///
/// # Errors
/// If it cannot be read, or nobody published there.
pub fn prove(dir: &Path) -> Result<Proof, Failure> {
    verify::holds_a_build(dir)?;
    let (claim, files): (Claim, OutputFiles<'_>) = verify::read_directory(dir)?;
    Ok(claim.prove(&files))
}

/// A proof as `verify --json` prints it.
pub fn proof_json(proof: &Proof) -> String {
    verify::json(proof)
}

/// What a search has come to.
#[derive(Clone, Debug)]
pub struct Optimum {
    /// All that was found.
    pub found: Found,
    /// The spec's text with the best design that can be built, and that design; `None` if there is none.
    pub best: Option<(String, Design)>,
    /// Of each of `found.best` the constraints that it misses, and by which part.
    pub short: Vec<Vec<(&'static str, f64)>>,
}

/// Searches around `given` as `optimize` does; `options` are those of the command ("--points", "4..6"), without the spec.
///
/// # Errors
/// If an option is wrong, or two do not go together.
pub fn optimum(given: &Given, options: &[String]) -> Result<Optimum, Failure> {
    let command = optimize::Args::augment_args(Command::new("optimize").no_binary_name(true));
    let arguments = options.iter().map(OsString::from).chain(["-".into()]);
    let usage = |fault: clap::Error| Failure::Usage(without_advice(&fault));
    let matches = command.try_get_matches_from(arguments).map_err(usage)?;
    let args = optimize::Args::from_arg_matches(&matches).map_err(usage)?;
    let Given { source, reading, machine, machine_text, .. } = given.clone();
    let loaded = Loaded::quiet(source, reading, machine, machine_text);
    let optimize::Answered { found, constraints, best } = optimize::answer(&args, &loaded)?;
    let short =
        found.best.iter().map(|Evaluated { point, answer, .. }| shortfalls(point, answer, &constraints));
    Ok(Optimum { short: short.collect(), best: best.map(|(text, design, _)| (text, design)), found })
}

/// The first line of a fault of arguments, without "error: ": what follows is advice for a command line.
fn without_advice(fault: &clap::Error) -> String {
    let text = fault.to_string();
    let line = text.lines().next().unwrap_or_default();
    line.strip_prefix("error: ").unwrap_or(line).to_owned()
}

/// Says that the program's code is in the library `file`: kept answers of shells are its, not the loading program's.
pub fn code_is_in(file: PathBuf) {
    cache::code_is_in(file);
}
