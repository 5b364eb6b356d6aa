//! `stargrip-cam build`

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use jiff::Zoned;
use serde_json::Value;

use crate::cli::failure::{Failure, tell};
use crate::cli::harmless::shown;
use crate::cli::kinds::Kinds;
use crate::cli::load::{Loaded, is_standard_input};
use crate::cli::voice::Voice;
use crate::cli::{again, each, glance, new, publish, summary, watch};

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
    /// Build it even if it bursts, or does not hold the object of its own `load` section.
    #[arg(long)]
    anyway: bool,
    /// Build again whenever a spec or its machine profile is saved; Ctrl-C ends it.
    #[arg(long, conflicts_with = "json")]
    watch: bool,
    #[command(flatten)]
    voice: Voice,
}

/// Builds, proves and publishes each spec.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let targets = targets(args)?;
    if args.watch {
        if args.specs.iter().any(|spec| is_standard_input(spec)) {
            return Err(Failure::Usage("--watch needs files: standard input is not saved again".to_owned()));
        }
        again::on_every_save(&args.specs, || {
            let _ = each::each(&args.specs, args.voice, |spec| one(args, &targets, spec))
                .map_err(Failure::report);
            if !args.voice.quiet {
                tell("waiting for the next save; Ctrl-C ends it");
            }
        });
    }
    each::each(&args.specs, args.voice, |spec| one(args, &targets, spec))
}

/// Where each spec's files go, where its path says so; two specs in one directory are one too many.
fn targets(args: &Args) -> Result<BTreeMap<&Path, PathBuf>, Failure> {
    if args.output.is_some() && args.specs.len() > 1 {
        return Err(Failure::Usage(
            "-o is for one spec: several have a directory each, out/ and the spec's name".to_owned(),
        ));
    }
    let mut targets: BTreeMap<&Path, PathBuf> = BTreeMap::new();
    for spec in &args.specs {
        let target = match &args.output {
            Some(output) => output.clone(),
            None if is_standard_input(spec) => continue,
            None => default_output(spec),
        };
        if let Some((other, _)) = targets.iter().find(|(_, taken)| **taken == target) {
            let (one, two, target) = (shown(other), shown(spec), shown(&target));
            return Err(Failure::Usage(format!(
                "{one} and {two} would both go to {target}: build them one by one, with -o"
            )));
        }
        let _ = targets.insert(spec, target);
    }
    Ok(targets)
}

/// Builds, proves and publishes one spec; what programs are told, if they are.
fn one(args: &Args, targets: &BTreeMap<&Path, PathBuf>, spec: &Path) -> Result<Option<Value>, Failure> {
    let voice = args.voice;
    let loaded = Loaded::spoken(spec, voice)?;
    let forecast = loaded.forecast()?;
    loaded.fit(&forecast, args.anyway)?;
    let list = watch::list(&forecast, spec);
    let proven = loaded.proven(forecast, &args.kinds.asked())?;
    let forecast = &proven.built().forecast;
    let named = || Path::new("out").join(new::file_stem(&forecast.spec.name));
    let target = targets.get(spec).cloned().unwrap_or_else(named);
    // What became of files that were there is told however quiet one is.
    tell(&publish(&target, &proven)?.to_string());
    if voice.json {
        let mut said = glance::json(forecast, &list);
        said["written"] = glance::written_json(&proven, &target);
        return Ok(Some(said));
    }
    if voice.quiet {
        return Ok(None);
    }
    glance::show(&glance::head(forecast))?;
    glance::warn(&list);
    // Without a program there is nothing to wait for.
    if proven.sealing_time().is_some() {
        glance::show(&glance::work(forecast, &Zoned::now()))?;
    }
    glance::show(&glance::written(&proven, &target))?;
    if voice.verbose {
        voice.remark(&summary::built(&proven))?;
    } else {
        glance::show(&[("details", "-v".to_owned())])?;
    }
    Ok(None)
}

/// `out/` and the spec's file name without its ending.
fn default_output(spec: &Path) -> PathBuf {
    Path::new("out").join(spec.file_stem().unwrap_or(std::ffi::OsStr::new("design")))
}
