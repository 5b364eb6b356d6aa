//! `stargrip-cam feedcheck`

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::json;

use crate::answer::quantity::quantity;
use crate::cli::escape::{argument, escaped_line};
use crate::cli::failure::Failure;
use crate::cli::load::Loaded;
use crate::cli::package_file::PackageFile;
use crate::cli::text_file::{refuse_foreign, replace, write_new};
use crate::cli::verbosity::Verbosity;
use crate::emit;
use crate::manifest::FEED_CHECK_MANIFEST;
use crate::pipeline;
use crate::pipeline::{FeedCheckFault, PACKAGE_ENDING, ProvenFeedCheck};
use program::plan;
use program::plan::FeedCorrection;
use proof::artifact::program_ending;
use spec::units::{Duration, Quantity, Readable, Speed};
use spec::{Allowed, Machine, Spec};

/// Arguments of `feedcheck`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The spec whose machine and speed are checked.
    spec: PathBuf,
    /// The program to write; default: feedcheck.gcode, for LinuxCNC feedcheck.ngc.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Replace an existing program.
    #[arg(long)]
    force: bool,
    /// The time that a line of 10 mm took, such as "96 s": what to change is printed, and no program is written.
    #[arg(long, value_name = "TIME", conflicts_with_all = ["output", "force"], allow_hyphen_values = true, value_parser = quantity::<Duration>(MEASURED))]
    took: Option<Duration>,
    #[command(flatten)]
    verbosity: Verbosity,
}

/// Times of a line by a stopwatch, s.
const MEASURED: Allowed = Allowed::closed(0.1, 1e5);

/// Writes the program that measures the machine's real speed, or prints what follows from a measurement.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let loaded = Loaded::read_spec(&args.spec, args.verbosity)?;
    if let Some(measured) = args.took {
        return correct(&loaded, measured, args.verbosity);
    }
    let (spec, machine) = (&loaded.reading.spec, &loaded.machine);
    let output = args.output.clone().unwrap_or_else(|| default_output(machine));
    let name = output.file_name().unwrap_or_default().to_string_lossy();
    let proven = feed_check(&loaded, &name)?;
    refuse_foreign(&output, "the program of a feed check", |text| text.contains(emit::FEED_CHECK_TITLE))?;
    let package = proven.package.as_ref().map(|bytes| PackageFile::new(&output, bytes));
    if !args.force && (output.exists() || package.as_ref().is_some_and(|package| package.path.exists())) {
        let remedy = "--force replaces it, -o FILE writes another";
        let message = format!("{} exists already, from an earlier run: {remedy}", escaped_line(&output));
        return Err(Failure::Message(message));
    }
    // The manifest comes first: a program without one could be run, but not verified.
    let manifest = manifest_path(&output);
    replace(&manifest, &String::from_utf8_lossy(&proven.manifest.to_json()))?;
    let outcome = if args.force { replace(&output, &proven.text) } else { write_new(&output, &proven.text) };
    outcome.inspect_err(|_| {
        let _ = fs::remove_file(&manifest);
    })?;
    package.as_ref().map_or(Ok(()), PackageFile::write)?;
    let packed = package.as_ref().map_or_else(String::new, PackageFile::in_words);
    let seconds = plan::CHECK_LENGTH / spec.seal.speed.0;
    let command = format!("stargrip-cam feedcheck {} --took", argument(&args.spec));
    let (length, example) = (plan::CHECK_LENGTH, 0.96 * seconds);
    let ways = if machine.controller.arcs {
        format!("three lines (X, Y, 45 deg) and two arcs (G2, G3) of {length} mm")
    } else {
        format!("three lines of {length} mm (X, Y, 45 deg)")
    };
    let text = format!(
        "wrote {}{packed}, and beside it {} for `verify`\neach of its {ways} must take {seconds:.0} s; if one took {example:.0} s, \
         `{command} \"{example:.0} s\"` prints what to change\nat each {} it must stop and wait, at the X, Y and Z in the comment before it; \
         if it runs on, or stops elsewhere, do not seal with this profile\n",
        escaped_line(&output),
        escaped_line(manifest.file_name().unwrap_or_default()),
        machine.script.pause
    );
    let json = json!({
        "wrote": output.to_string_lossy(),
        "manifest": manifest.to_string_lossy(),
        "package": package.map(|package| package.path.to_string_lossy().into_owned()),
        "line_mm": length,
        "line_time_s": seconds,
        "ways": if machine.controller.arcs { 5 } else { 3 },
        "pause": machine.script.pause,
    });
    args.verbosity.report(&text, &json)
}

/// Prints what to change where a line took `measured`.
fn correct(loaded: &Loaded, measured: Duration, verbosity: Verbosity) -> Result<(), Failure> {
    // The plan tells which value explains the time. Here it becomes the key to change, its new value, and a sentence with the
    // present one.
    loaded.with_programs("feedcheck")?;
    let (spec, machine) = (&loaded.reading.spec, &loaded.machine);
    let nominal = Duration(plan::CHECK_LENGTH / spec.seal.speed.0);
    let correction = plan::feed_correction(spec, machine, measured);
    let motion = &machine.motion;
    let (key, value, remedy) = match correction {
        FeedCorrection::None => {
            (None, None, "a stopwatch shows no difference: nothing is to be changed".to_owned())
        }
        FeedCorrection::Acceleration(value) => {
            let present = motion.acceleration.map_or("unknown".to_owned(), |present| present.to_string());
            (
                Some("motion.acceleration"),
                Some(three_digits(value)),
                in_profile("acceleration", &three_digits(value), &present),
            )
        }
        FeedCorrection::StartDelay(value) => (
            Some("motion.start_delay"),
            Some(three_digits(value)),
            in_profile("start_delay", &three_digits(value), &motion.start_delay.to_string()),
        ),
        FeedCorrection::SealSpeed(value) => (
            Some("seal.speed"),
            Some(three_digits(value)),
            format!(
                "no acceleration explains it: write `speed = \"{}\"` in [seal], in place of {}",
                three_digits(value),
                spec.seal.speed
            ),
        ),
        FeedCorrection::Dwell => (
            Some("dwell.unit"),
            None,
            "strokes alone do not explain it: the controller waits in another unit, or not at all; check `unit` and `step` in [dwell], \
             the dialect, and the host"
                .to_owned(),
        ),
        FeedCorrection::RealSpeed(value) => {
            (None, Some(three_digits(value)), unchopped(spec, machine, value))
        }
    };
    let next_step =
        if correction == FeedCorrection::None { "" } else { "\nthen write and time the feed check again" };
    let text = format!("a line took {measured}, and must take {nominal}\n{remedy}{next_step}\n");
    let json = json!({ "measured_s": measured.0, "line_time_s": nominal.0, "key": key, "value": value, "remedy": remedy });
    verbosity.report(&text, &json)
}

/// The remedy that changes `key` of `[motion]`.
fn in_profile(key: &str, value: &str, present: &str) -> String {
    format!(
        "write `{key} = \"{value}\"` in [motion] of your own profile, in place of {present} (`stargrip-cam machines show` prints one \
         to start from)"
    )
}

/// The remedy where the machine moved at `real` along a line that is not chopped.
fn unchopped(spec: &Spec, machine: &Machine, real: Speed) -> String {
    let real_speed = three_digits(real);
    if real.0 < spec.seal.speed.0 {
        return format!(
            "the machine moves at {real_speed}: set its feed override to 100 %, or write this speed in [seal]"
        );
    }
    let is_able = machine.motion.speed_range().is_some_and(|(_, worst)| worst <= spec.seal.speed.0);
    let remedy = if is_able {
        "set its feed override to 100 %; if that is right, correct `min_step_rate` and the steps per mm in [motion]"
    } else if plan::Chop::new(spec, machine).is_none() {
        "name your controller with `profile` in [machine] (`stargrip-cam machines` tells which), and use `feed_floor = \"chop\"`"
    } else {
        "use `feed_floor = \"chop\"` in [machine]"
    };
    format!(
        "the machine moves at {real_speed}, and {} is required: {remedy}; or seal at that speed if a coupon holds",
        spec.seal.speed
    )
}

/// A quantity with three significant digits.
fn three_digits<Q: Quantity>(quantity: Q) -> String {
    let base = quantity.base();
    let exponent = if base > 0.0 { libm::log10(base).floor() } else { 0.0 };
    let step = libm::exp10(exponent - 2.0);
    format!("{} {}", Readable((base / step).round() * step), Q::KIND.unit())
}

/// The file of the program without a name of the user's.
pub(super) fn default_output(machine: &Machine) -> PathBuf {
    PathBuf::from("feedcheck").with_extension(program_ending(machine.controller.dialect))
}

/// The feed check for a file called `name`, read back.
pub(super) fn feed_check(loaded: &Loaded, name: &str) -> Result<ProvenFeedCheck, Failure> {
    let check = pipeline::feed_check(&loaded.reading.spec, &loaded.machine, loaded.sources(), name);
    check.map_err(|fault| match fault {
        FeedCheckFault::Refused(refusals) => loaded.refused(refusals),
        FeedCheckFault::Wrong(findings) => loaded.unproven(findings),
    })
}

/// The manifest beside the feed check `program`, or its package, from which `verify` proves it.
pub(super) fn manifest_path(program: &Path) -> PathBuf {
    let name = program.file_name().unwrap_or_default().to_string_lossy();
    let mut name = name.strip_suffix(PACKAGE_ENDING).unwrap_or(&name).to_owned();
    name.push_str(FEED_CHECK_MANIFEST);
    program.with_file_name(name)
}
