//! Reads the spec and the machine profile of a published directory.

use crate::design::Refusal;
use crate::spec;
use crate::spec::{DrawingSpec, Faults, Machine, Reading, Source};
use crate::verify::{Finding, FindingCode, OutputFiles};

/// The directory's own spec and machine profile.
pub(super) fn sources_of(files: &OutputFiles<'_>) -> (Result<Reading, Finding>, Result<Machine, Finding>) {
    let read_spec = |source: &Source| {
        let reading = spec::read(source)?;
        let name = reading.spec.drawing.as_ref().map(DrawingSpec::published_name);
        Ok(match name.and_then(|name| files.get(name)) {
            Some(bytes) => reading.with_drawing(bytes),
            None => reading,
        })
    };
    (source_of(files, "spec.toml", read_spec), source_of(files, "machine.toml", spec::read_machine))
}

fn source_of<T>(
    files: &OutputFiles<'_>,
    name: &'static str,
    read: impl Fn(&Source) -> Result<T, Faults>,
) -> Result<T, Finding> {
    let Some(bytes) = files.get(name) else {
        return Err(files.lacks(name, "the file of the build"));
    };
    Source::from_bytes(name, bytes).and_then(|source| read(&source)).map_err(|faults| {
        let found = faults.list().first().map_or("faults", |fault| &fault.message).to_owned();
        Finding::new(FindingCode::Unreadable, found, "text that `check` accepts").in_file(name)
    })
}

/// A refusal of the directory's design, as a finding.
pub(super) fn refused(refusal: Refusal) -> Finding {
    Finding::new(refusal.code, refusal.found, refusal.remedy).in_file("spec.toml")
}
