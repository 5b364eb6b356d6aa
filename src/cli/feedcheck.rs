//! `stargrip-cam feedcheck`

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::json;

use crate::cli::escape::shown;
use crate::cli::failure::Failure;
use crate::cli::load::Loaded;
use crate::cli::text_file::{refuse_foreign, replace, write_new};
use crate::cli::verbosity::Verbosity;
use crate::emit;
use crate::manifest::FEED_CHECK_MANIFEST;
use crate::pipeline;
use crate::pipeline::{FeedCheckFault, ProvenFeedCheck};
use program::plan;
use proof::artifact::program_ending;
use spec::{FeedFloor, Machine};

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
    #[command(flatten)]
    verbosity: Verbosity,
}

/// Writes the program that measures the machine's real speed.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let loaded = Loaded::spoken(&args.spec, args.verbosity)?;
    let (spec, machine) = (&loaded.reading.spec, &loaded.machine);
    let output = args.output.clone().unwrap_or_else(|| default_output(machine));
    let name = output.file_name().unwrap_or_default().to_string_lossy();
    let proven = feed_check(&loaded, &name)?;
    refuse_foreign(&output, "the program of a feed check", |text| text.contains(emit::FEED_CHECK_TITLE))?;
    if !args.force && output.exists() {
        let remedy = "--force replaces it, -o FILE writes another";
        let message = format!("{} exists already, from an earlier run: {remedy}", shown(&output));
        return Err(Failure::Message(message));
    }
    // The manifest comes first: a program without one could be run, but not verified.
    let manifest = manifest_path(&output);
    replace(&manifest, &String::from_utf8_lossy(&proven.manifest.to_json()))?;
    let outcome = if args.force { replace(&output, &proven.text) } else { write_new(&output, &proven.text) };
    outcome.inspect_err(|_| {
        let _ = fs::remove_file(&manifest);
    })?;
    let seconds = plan::CHECK_LENGTH / spec.seal.speed.0;
    let remedy = match spec.machine.feed_floor {
        FeedFloor::Chop => "correct `chop_feed` and `acceleration` in the profile's [motion]",
        FeedFloor::Refuse if plan::Chop::new(spec, machine).is_some() => {
            "use `feed_floor = \"chop\"` in [machine]"
        }
        FeedFloor::Refuse => {
            "name your controller with `profile` in [machine] (`stargrip-cam machines` lists them), and use `feed_floor = \"chop\"`"
        }
    };
    let length = plan::CHECK_LENGTH;
    let ways = if machine.controller.arcs {
        format!("three lines (X, Y, 45 deg) and two arcs (G2, G3) of {length} mm")
    } else {
        format!("three lines of {length} mm (X, Y, 45 deg)")
    };
    let text = format!(
        "wrote {}, and beside it {} for `verify`\neach of its {ways} must take {seconds:.0} s; if one is faster, the \
         machine cannot go at {}: {remedy}\nat each {} it must stop and wait, at the X, Y and Z in the comment before it; \
         if it runs on, or stops elsewhere, do not seal with this profile\n",
        shown(&output),
        shown(manifest.file_name().unwrap_or_default()),
        spec.seal.speed,
        machine.script.pause
    );
    let json = json!({
        "wrote": output.to_string_lossy(),
        "manifest": manifest.to_string_lossy(),
        "line_mm": length,
        "line_time_s": seconds,
        "ways": if machine.controller.arcs { 5 } else { 3 },
        "pause": machine.script.pause,
    });
    args.verbosity.report(&text, &json)
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

/// The manifest beside the feed check `program`, from which `verify` proves it.
pub(super) fn manifest_path(program: &Path) -> PathBuf {
    let mut name = program.file_name().unwrap_or_default().to_owned();
    name.push(FEED_CHECK_MANIFEST);
    program.with_file_name(name)
}
