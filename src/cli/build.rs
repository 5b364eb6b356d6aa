//! `stargrip-cam build`

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

use serde_json::Value;

use crate::cli::escape::{argument, escaped_line};
use crate::cli::failure::{Failure, tell};
use crate::cli::kinds::Kinds;
use crate::cli::load::{Loaded, lasting, refuse_two_stdin};
use crate::cli::material::FabricArg;
use crate::cli::open::open;
use crate::cli::overview::present_time;
use crate::cli::publish::extras_of;
use crate::cli::rebuilt::Snapshot;
use crate::cli::verbosity::Verbosity;
use crate::cli::whole_file::is_standard_input;
use crate::cli::{batch, new, overview, publish, watch};
use crate::pipeline::{Forecast, Interface, Precaution, Proven};
use proof::artifact::{Kind, KindRequest};

/// Arguments of `build`.
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// The specs to build; - for standard input.
    #[arg(required = true, value_name = "SPEC")]
    specs: Vec<PathBuf>,
    /// Where to put the files; default: out/ and the spec's file name without its ending, of standard input the design's name.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    #[command(flatten)]
    kinds: Kinds,
    /// Build it even if it bursts, or does not hold the object of its own `load` section; and compute a shell of any size.
    #[arg(long)]
    anyway: bool,
    /// Build again whenever a spec or its machine profile is saved; Ctrl-C ends it.
    #[arg(long, conflicts_with = "json")]
    watch: bool,
    /// Open the report, or the preview where there is none.
    #[arg(long)]
    open: bool,
    #[command(flatten)]
    fabric: FabricArg,
    #[command(flatten)]
    verbosity: Verbosity,
}

/// Builds, proves and publishes each spec.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    refuse_two_stdin(&args.specs)?;
    let target_of = targets(args)?;
    if args.watch {
        if args.specs.iter().any(|spec| is_standard_input(spec)) {
            return Err(Failure::Usage("--watch needs files: it cannot watch standard input".to_owned()));
        }
        rebuild_on_save(args, &target_of);
    }
    batch::run(&args.specs, args.verbosity, |spec| {
        print_answer(args, &build_one(args, &target_of, spec, args.verbosity)?)
    })
}

/// Builds each spec, and builds it again whenever it is saved. The first build prints the whole answer, each later one a line.
fn rebuild_on_save(args: &Args, targets: &BTreeMap<&Path, PathBuf>) -> ! {
    let mut snapshots: BTreeMap<PathBuf, Snapshot> = BTreeMap::new();
    let mut is_first = true;
    watch::on_every_save(&args.specs, |saved| {
        let _ = batch::run(saved, args.verbosity, |spec| {
            let start = Instant::now();
            // The first build of a spec has no earlier one to compare with.
            let previous = snapshots.get(spec).cloned();
            let verbosity = Verbosity { quiet: args.verbosity.quiet || previous.is_some(), ..args.verbosity };
            let published = build_one(args, targets, spec, verbosity).inspect_err(|_| {
                // The time of day separates the faults of successive saves.
                if !is_first {
                    tell(&format!("{} {} was not rebuilt:", time_of_day(), escaped_line(spec)));
                }
            })?;
            let snapshot =
                Snapshot::new(&published.loaded, &published.proven.built().forecast, &published.notes);
            match &previous {
                Some(previous) => rebuilt(args.verbosity, spec, start, &snapshot, previous)?,
                None => drop(print_answer(args, &published)?),
            }
            let _ = snapshots.insert(spec.to_owned(), snapshot);
            Ok(None)
        })
        .map_err(Failure::report);
        if is_first && !args.verbosity.quiet {
            tell("waiting for the next save; Ctrl-C ends it");
        }
        is_first = false;
    })
}

/// Prints what a build has changed: its time, its duration, the changed values, and their effect.
fn rebuilt(
    verbosity: Verbosity,
    spec: &Path,
    start: Instant,
    snapshot: &Snapshot,
    previous: &Snapshot,
) -> Result<(), Failure> {
    let (time, spec) = (time_of_day(), escaped_line(spec));
    let seconds = start.elapsed().as_secs_f64();
    verbosity
        .remark(&format!("{time} {spec} rebuilt in {seconds:.1} s: {}\n", snapshot.changes(previous)))?;
    if !verbosity.quiet {
        overview::warn(snapshot.new_notes(previous));
    }
    Ok(())
}

/// The time of day: "13:02:11".
fn time_of_day() -> String {
    present_time().map_or_else(String::new, |now| now.strftime("%H:%M:%S").to_string())
}

/// The output directory of each spec whose path determines it; two specs may not share one.
fn targets(args: &Args) -> Result<BTreeMap<&Path, PathBuf>, Failure> {
    if args.output.is_some() && args.specs.len() > 1 {
        return Err(Failure::Usage(
            "-o is for one spec only: each of several gets its own directory, out/ and the spec's name"
                .to_owned(),
        ));
    }
    let mut targets: BTreeMap<&Path, PathBuf> = BTreeMap::new();
    for spec in &args.specs {
        let target = match &args.output {
            Some(output) => output.clone(),
            None if is_standard_input(spec) => continue,
            None => Path::new("out").join(spec.file_stem().unwrap_or("design".as_ref())),
        };
        if let Some((other, _)) = targets.iter().find(|(_, taken)| **taken == target) {
            let (other_name, spec_name, target_name) =
                (escaped_line(other), escaped_line(spec), escaped_line(&target));
            return Err(Failure::Usage(format!(
                "{other_name} and {spec_name} would both be written to {target_name}: build them one by one, with -o"
            )));
        }
        let _ = targets.insert(spec, target);
    }
    Ok(targets)
}

/// A published build, with its precautions and sources.
struct PublishedOutput {
    proven: Proven,
    target: PathBuf,
    notes: Vec<Precaution>,
    loaded: Loaded,
}

/// Builds, proves and publishes one spec.
fn build_one(
    args: &Args,
    targets: &BTreeMap<&Path, PathBuf>,
    spec: &Path,
    verbosity: Verbosity,
) -> Result<PublishedOutput, Failure> {
    let loaded = Loaded::with_fabric(spec, &args.fabric, verbosity)?;
    args.kinds.refuse_programs(&loaded)?;
    let forecast = loaded.forecast(args.anyway)?;
    let target = targets.get(spec).cloned().map_or_else(|| output_by_name(&forecast.spec.name), Ok)?;
    let kinds = request(args, &forecast, &target, verbosity);
    loaded.fit(&forecast, args.anyway)?;
    let notes = forecast.precautions(Interface::Command(&argument(lasting(spec, &target))));
    let proven = loaded.proven(forecast, &kinds)?;
    args.kinds.tell_missing(proven.built(), &kinds);
    // The fate of earlier files is reported even with --quiet.
    tell(&publish(&target, &proven)?.to_string());
    Ok(PublishedOutput { proven, target, notes, loaded })
}

/// Prints the answer for one build, and opens its page with --open.
fn print_answer(args: &Args, published: &PublishedOutput) -> Result<Option<Value>, Failure> {
    let PublishedOutput { proven, target, notes, .. } = published;
    if args.open {
        match overview::to_look_at(proven) {
            Some(page) => open(&target.join(page)),
            None => tell("note: neither a report nor a preview was built: nothing to open"),
        }
    }
    overview::answer(proven, notes, Some(target), args.verbosity)
}

/// The kinds to build: those of the options and the spec, and without `--with` and `--only` also those of the build that is replaced.
/// Reports the kinds that are kept or left out.
fn request(args: &Args, forecast: &Forecast, target: &Path, verbosity: Verbosity) -> KindRequest {
    let mut request = args.kinds.request().of_spec(&forecast.spec);
    let extras: Vec<Kind> = extras_of(target).into_iter().filter(|kind| !request.includes(*kind)).collect();
    if extras.is_empty() {
        return request;
    }
    let names = extras.iter().map(|kind| kind.name()).collect::<Vec<_>>().join(",");
    if args.kinds.is_default() {
        request.add(extras);
        if !verbosity.quiet {
            let target_name = escaped_line(target);
            tell(&format!(
                "note: {target_name} has `{names}`, which is built again; to build other kinds, use --with"
            ));
        }
    } else {
        tell(&format!(
            "note: {} has `{names}`, which is not built again; to build it, add --with {names}",
            escaped_line(target)
        ));
    }
    request
}

/// The output directory of a design that is read from standard input: `out/` and its name.
///
/// # Errors
/// If the name has no letter or digit for it: all such designs would share one directory.
fn output_by_name(name: &str) -> Result<PathBuf, Failure> {
    let stem = new::file_stem(name).ok_or_else(|| {
        let problem = new::nameless(name, "a directory");
        Failure::Message(format!("{problem}: name one with -o"))
    })?;
    Ok(Path::new("out").join(stem))
}
