//! Common options and functions of commands that run the shell model: fineness, progress, interruption, cache.

use std::path::PathBuf;

use crate::cli::cache::Cache;
use crate::cli::failure::Failure;
use crate::cli::interrupt::Listening;
use crate::cli::load::Loaded;
use crate::cli::progress;
use crate::cli::text_file::{refuse_foreign, replace};
use crate::cli::verbosity::Verbosity;
use crate::cli::words::words;
use crate::pipeline::no_prediction;
use design::{RefusalCode, Refusals};
use forecast::pressures::pressure_finding;
use forecast::shell::star::ShellRefusal;
use forecast::shell::{Detail, SHELL};
use inflatable::shell::cases::{InflatedShape, ShellFault, Watch};

/// Arguments for the shell model only.
#[derive(clap::Args, Debug)]
pub(super) struct ShellArgs {
    /// For the shell: fineness of its meshes; default: medium for stars, coarse for drawings. Every number is printed with its mesh error.
    #[arg(long, value_name = "HOW", value_parser = words(&Detail::ALL, &MESHES))]
    pub(super) fineness: Option<Detail>,
    /// For the shell: write the inflated sheet as a VTU file, which ParaView reads.
    #[arg(long, value_name = "FILE")]
    vtu: Option<PathBuf>,
    /// For the shell: do not use the cache.
    #[arg(long)]
    no_cache: bool,
}

/// The help of the meshes, in the order of [`Detail::ALL`].
const MESHES: [&str; 3] = ["A first look: seconds", "For most purposes", "Where mesh errors matter"];

impl ShellArgs {
    /// Refuses options that only the shell model has.
    pub(super) fn not_by_others(&self) -> Result<(), Failure> {
        let options = [(self.vtu.is_some(), "--vtu"), (self.fineness.is_some(), "--fineness")];
        match options.into_iter().find(|(is_given, _)| *is_given) {
            Some((_, option)) => Err(Failure::Usage(format!(
                "{option} needs the shell model: add --model shell, or leave it out"
            ))),
            None => Ok(()),
        }
    }

    /// Shows the answer to `question`, which must contain all inputs: from the cache, or computed by `compute` as JSON, text and shape.
    pub(super) fn show(
        &self,
        question: &str,
        verbosity: Verbosity,
        compute: impl FnOnce(&Watch<'_>) -> Result<(String, String, Option<InflatedShape>), Failure>,
    ) -> Result<(), Failure> {
        if let Some(path) = &self.vtu {
            refuse_foreign(path, "a VTU file", |text| text.contains("<VTKFile "))?;
        }
        let cache = Cache::new(self.no_cache);
        let key = cache.key(&[question, &format!("{:?} {}", self.fineness, self.vtu.is_some())]);
        let stored = cache.get(&key).and_then(|parts| parts.try_into().ok());
        let [json, text, vtu] = if let Some(stored) = stored {
            stored
        } else {
            let (json, text, shape) = watched_by(verbosity, self.fineness.is_some(), compute)?;
            let vtu = shape.filter(|_| self.vtu.is_some()).map(|shape| shape.vtu()).transpose();
            let parts = [json, text, vtu.map_err(Failure::message)?.unwrap_or_default()];
            cache.store(&key, &parts.each_ref().map(String::as_str));
            parts
        };
        if let Some(path) = &self.vtu {
            replace(path, &vtu)?;
        }
        verbosity.show(&text, &json)
    }
}

/// The shell's fault as a failure of the command.
pub(super) fn refused(fault: &ShellFault) -> Failure {
    match fault {
        ShellFault::Cancelled => Failure::Interrupted,
        ShellFault::Pressure { found, least, most } => {
            let (message, remedy) = pressure_finding(SHELL, *found, [*least, *most]);
            Failure::Message(format!("{message}: {remedy}"))
        }
        fault => Failure::message(fault),
    }
}

/// The shell's refusal as a failure of the command.
pub(super) fn not_computed(loaded: &Loaded, refusal: ShellRefusal) -> Failure {
    match refusal {
        ShellRefusal::Cancelled => Failure::Interrupted,
        ShellRefusal::Fault(fault) => {
            let mut refusals = Refusals::from(no_prediction(&fault));
            // A whole command: `--fineness` excludes `--accuracy`.
            let command = "`stargrip-cam predict SPEC --model shell --fineness coarse` computes it";
            refusals.offer(RefusalCode::LargeShell, command);
            loaded.refused(refusals)
        }
    }
}

/// Computes while Ctrl-C is caught: the first one asks the computation to stop, the second one ends the program. A terminal shows the
/// progress unless `verbosity` is quiet. A drawing of many unknowns is refused, unless it `is_asked` for.
pub(super) fn watched_by<T>(
    verbosity: Verbosity,
    is_asked: bool,
    compute: impl FnOnce(&Watch<'_>) -> Result<T, Failure>,
) -> Result<T, Failure> {
    let listening = Listening::new();
    progress::listening(verbosity, "the shell", |progress| {
        let tell = |part: f64, what: &str| progress.tell_part(part, &format!("shell: {what}"));
        compute(&Watch { progress: Some(&tell), cancel: listening.flag(), is_bounded: !is_asked })
    })
}
