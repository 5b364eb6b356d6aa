//! From a path to a spec, its machine and its design.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use crate::cli::failure::{Failure, tell, warn};
use crate::cli::harmless::shown;
use crate::design::{Refusals, Warning};
use crate::manifest::MANIFEST;
use crate::pipeline::{Forecast, Sources};
use crate::spec;
use crate::spec::{Fault, FaultCode, Faults, Machine, Reading, SIZE_LIMIT, Source, key};

/// The profile's name in a published directory.
const MACHINE: &str = "machine.toml";

/// A spec with the machine it names, both read and valid.
#[derive(Debug)]
pub(super) struct Loaded {
    pub(super) reading: Reading,
    pub(super) source: Source,
    pub(super) machine: Machine,
    machine_text: String,
}

impl Loaded {
    /// Reads the spec at `path` and the machine profile it names; prints warnings.
    pub(super) fn new(path: &Path) -> Result<Self, Failure> {
        let source = read_source(path)?;
        let reading = spec::read(&source)?;
        warn(&reading.warnings);
        let profile = machine_source(path, &source, &reading)?;
        let machine = spec::read_machine(&profile)?;
        Ok(Self { reading, source, machine, machine_text: profile.text })
    }

    /// The texts as read.
    pub(super) fn sources(&self) -> Sources<'_> {
        Sources { spec: &self.source.text, machine: &self.machine_text }
    }

    /// Prints what a person should know about a design, at the keys it speaks of.
    pub(super) fn warn(&self, warnings: &[Warning]) {
        let faults = warnings.iter().map(|warning| {
            Fault::warning(warning.code, self.reading.raw.span_of(warning.key), warning.found.clone())
                .label(warning.remedy.clone())
        });
        warn(&Faults::new(&self.source, faults.collect()));
    }

    /// Everything that can be known of it without making its files; prints the design's warnings.
    pub(super) fn forecast(&self) -> Result<Forecast, Failure> {
        let forecast = Forecast::of(self.reading.spec.clone(), self.machine.clone())
            .map_err(|refusals| self.refused(refusals))?;
        self.warn(&forecast.design.warnings);
        Ok(forecast)
    }

    /// Refusals of the design as faults at the keys they speak of.
    pub(super) fn refused(&self, refusals: Refusals) -> Failure {
        let faults = refusals.into_iter().map(|refusal| {
            let (key, raw) = (refusal.key, &self.reading.raw);
            let fault = Fault::error(refusal.code, raw.span_of(key), refusal.found).label(refusal.remedy);
            if raw.find(key).is_some() {
                return fault;
            }
            fault.help(format!(
                "`{}` in [{}] is not written: this is about its default",
                key.key(),
                key.section()
            ))
        });
        Failure::Faults(Faults::new(&self.source, faults.collect()))
    }
}

/// Reads a text file, but not more of it than a spec may have.
pub(super) fn read_source(path: &Path) -> Result<Source, Failure> {
    let limit = u64::try_from(SIZE_LIMIT).unwrap_or(u64::MAX).saturating_add(1);
    let mut bytes = Vec::new();
    let _ = File::open(path)
        .and_then(|file| file.take(limit).read_to_end(&mut bytes))
        .map_err(|error| Failure::file("read", path, &error))?;
    Ok(Source::from_bytes(path.display().to_string(), &bytes)?)
}

/// The profile of the build whose directory holds the spec at `path`: the profile's own path led elsewhere when the
/// spec was copied there. Only beside a manifest, so that no other file of this name is taken by chance.
fn published_profile(path: &Path) -> Option<PathBuf> {
    let profile = path.with_file_name(MACHINE);
    (path.with_file_name(MANIFEST).is_file() && profile.is_file()).then_some(profile)
}

/// The machine profile that the spec at `path` names: a built-in one, or a file relative to the spec.
fn machine_source(path: &Path, source: &Source, reading: &Reading) -> Result<Source, Failure> {
    let name = &reading.spec.machine.profile;
    if let Some(text) = spec::builtin_machine(name) {
        return Ok(Source::new(format!("built-in machine profile {name}"), text));
    }
    let file: PathBuf = path.parent().unwrap_or(Path::new("")).join(name);
    if file.is_file() {
        return read_source(&file);
    }
    if let Some(published) = published_profile(path) {
        let (named, found) = (shown(&file), shown(&published));
        let said = format!("note: there is no {named}; {found} is used, as published");
        tell(&said);
        return read_source(&published);
    }
    let known: Vec<&str> = spec::builtin_machines().collect();
    let fault = Fault::error(
        FaultCode::UnknownMachine,
        reading.raw.span_of(key::machine::PROFILE),
        format!("no machine profile has this name, and there is no file {}", shown(&file)),
    )
    .label(format!("a built-in profile ({}) or a path relative to the spec", known.join(", ")));
    Err(Faults::new(source, vec![fault]).into())
}
