//! From a path to a spec, its machine and its design.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use crate::cli::failure::{Failure, shown, warn};
use crate::design::Refusals;
use crate::pipeline::{Forecast, Sources};
use crate::spec;
use crate::spec::{Fault, Faults, Machine, Reading, SIZE_LIMIT, Source, key};

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

    /// Everything that can be known of it without making its files.
    pub(super) fn forecast(&self) -> Result<Forecast, Failure> {
        Forecast::of(self.reading.spec.clone(), self.machine.clone())
            .map_err(|refusals| self.refused(refusals))
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
    let known: Vec<&str> = spec::builtin_machines().collect();
    let fault = Fault::error(
        "unknown-machine",
        reading.raw.span_of(key::machine::PROFILE),
        format!("no machine profile has this name, and there is no file {}", shown(&file)),
    )
    .label(format!("a built-in profile ({}) or a path relative to the spec", known.join(", ")));
    Err(Faults::new(source, vec![fault]).into())
}
