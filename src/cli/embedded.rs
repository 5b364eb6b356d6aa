//! The commands' functions for a program that embeds this crate: the Python package computes as the command does, without its output.
//!
//! A spec is read with its machine profile, a build's directory no further than its manifest states, and a search takes the arguments of
//! the command. So files, limits and defaults are defined once. Nothing is printed.

use std::ffi::OsString;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Command;

use crate::cli::package_file::package_path;
use crate::cli::verbosity::Verbosity;
use crate::cli::words::value_of;
use crate::cli::{actuator, align, coupon, feedcheck, new_object, optimize, predict, resume, verify};
use crate::pipeline::{Proven, ProvenCoupons, PublishedBuild};
use crate::resume::Resumed;
use forecast::optimize::{Evaluation, SearchResult, Shortfall, shortfalls};
use geom::Point;
use proof::verify::{OutputFiles, Proof};
use spec::{Machine, ModelChoice};

pub use crate::cli::actuator::ActuatorQuestion;
pub use crate::cli::cache::code_is_in;
pub use crate::cli::failure::Failure;
pub use crate::cli::load::Loaded;
pub use crate::cli::predict::{GripperAnswer, StarQuestion};

/// Proves the build in the directory `dir`, as `verify` does.
///
/// # Errors
/// If the directory cannot be read, or has no manifest of a build.
pub fn prove(dir: &Path) -> Result<Proof, Failure> {
    verify::holds_a_build(dir)?;
    let (published, files): (PublishedBuild, OutputFiles<'_>) = verify::read_directory(dir)?;
    Ok(published.prove(&files))
}

/// The build in `dir` with the programs for a sheet whose marks lie at `marks` now, as `align` makes it; `sheet` names one of several.
///
/// # Errors
/// If the directory cannot be read or is not a build of this version, or the sheet cannot lie there.
pub fn aligned(dir: &Path, sheet: Option<usize>, marks: [Point; 2]) -> Result<Proven, Failure> {
    align::aligned(dir, sheet, marks, Verbosity { quiet: true, ..Verbosity::default() })
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

/// Searches around `loaded` as `optimize` does; `options` are those of the command ("--points", "4..6"), without the spec. Raising `cancel`
/// ends the search without a result.
///
/// # Errors
/// If an option is wrong, if two exclude each other, or if the search was cancelled.
pub fn optimum(loaded: &Loaded, options: &[String], cancel: &AtomicBool) -> Result<Optimum, Failure> {
    // The caller reports progress and handles Ctrl-C.
    let options: Vec<String> = options.iter().cloned().chain(["--quiet".to_owned()]).collect();
    let args: optimize::Args = parsed(&options, Some(Path::new("-")))?;
    let (search, constraints) = optimize::answer(&args, loaded, Some(cancel))?;
    if cancel.load(Ordering::Relaxed) {
        return Err(Failure::Interrupted);
    }
    let spec = optimize::best_spec(&args, loaded, &search);
    let short = search.best.iter().map(|Evaluation { point, answer, .. }| {
        let missed = shortfalls(point, answer, &constraints).into_iter();
        missed.map(|Shortfall { constraint, part }| (constraint.name(), part)).collect::<Vec<_>>()
    });
    Ok(Optimum { short: short.collect(), best: spec, found: search })
}

/// The question that the options of `predict` describe ("--model", "ring"), without the spec.
///
/// # Errors
/// If an option is wrong.
pub fn star_question(options: &[String]) -> Result<StarQuestion, Failure> {
    Ok(parsed::<predict::Args>(options, Some(Path::new("-")))?.question())
}

/// The model called `name`, such as "ring"; `None` if there is none.
pub fn model(name: &str) -> Option<ModelChoice> {
    value_of(&ModelChoice::ALL, name)
}

/// The question that the options of `actuator` describe.
///
/// # Errors
/// If an option is wrong or missing.
pub fn actuator_question(options: &[String]) -> Result<ActuatorQuestion, Failure> {
    parsed::<actuator::Args>(options, None)?.question()
}

/// The machine of a built-in profile, or of a file.
///
/// # Errors
/// If there is neither, or the file is refused.
pub fn machine(profile: &str) -> Result<Machine, Failure> {
    new_object::machine(profile)
}

/// The coupons that the options of `coupon` describe, for `loaded`, read back.
///
/// # Errors
/// If an option is wrong, or the machine cannot seal one of them.
pub fn coupons(loaded: &Loaded, options: &[String]) -> Result<ProvenCoupons, Failure> {
    coupon::coupons(&parsed(options, Some(Path::new("-")))?, loaded)
}

/// The feed check of `loaded`, read back, with its manifest: names and bytes.
///
/// # Errors
/// If the profile contradicts the seal.
pub fn feed_check(loaded: &Loaded) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    let program = feedcheck::default_output(&loaded.machine);
    let proven = feedcheck::feed_check(loaded, &program.to_string_lossy())?;
    let paths = [program.clone(), package_path(&program), feedcheck::manifest_path(&program)];
    let [program, package, manifest] = paths.map(|path| path.to_string_lossy().into_owned());
    let packed = proven.package.map(|bytes| (package, bytes));
    let files = std::iter::once((program, proven.text.into_bytes())).chain(packed);
    Ok(files.chain([(manifest, proven.manifest.to_json())]).collect())
}

/// The rest of the job with the text `job`, from the place that the options of `resume` describe.
///
/// # Errors
/// If an option is wrong or missing, or the text is no sealing program.
pub fn resumed(job: &str, options: &[String]) -> Result<Resumed, Failure> {
    parsed::<resume::Args>(options, Some(Path::new("-")))?.rest_of(job)
}

/// The options of `coupon` as keywords of a function.
pub fn coupon_keywords() -> Vec<String> {
    keywords::<coupon::Args>()
}

/// The options of `resume` as keywords of a function; marks need a directory.
pub fn resume_keywords() -> Vec<String> {
    let mut keywords = keywords::<resume::Args>();
    keywords.retain(|keyword| !resume::MARKS.contains(&keyword.as_str()));
    keywords
}

/// The options of `optimize` as keywords of a function.
pub fn optimize_keywords() -> Vec<String> {
    keywords::<optimize::Args>()
}

/// The options of `actuator` as keywords of a function.
pub fn actuator_keywords() -> Vec<String> {
    keywords::<actuator::Args>()
}

/// The options of a command as keywords of a function, "tube_width", in the order of the command's help. Options about output are left
/// out.
fn keywords<A: clap::Args>() -> Vec<String> {
    let command = A::augment_args(Command::new("stargrip-cam"));
    let options = command.get_arguments().filter_map(clap::Arg::get_long);
    let long_options = options.filter(|option| !OF_THE_SCREEN.contains(option));
    long_options.map(|option| option.replace('-', "_")).collect()
}

/// The one of `keywords` with the most similar spelling to `name`.
pub fn nearest<'k>(name: &str, keywords: &'k [String]) -> Option<&'k str> {
    spec::nearest(name, keywords.iter().map(String::as_str))
}

/// Options about the output, the cache, and the text of the spec, which a caller has read already.
const OF_THE_SCREEN: [&str; 9] =
    ["verbose", "quiet", "json", "output", "vtu", "stl", "obj", "no-cache", "fabric"];

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
