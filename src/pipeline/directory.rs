//! Reads the spec and the machine profile of a published directory.

use design::Refusals;
use proof::verify::{Finding, FindingCode, OutputFiles};
use spec::{DrawingSpec, Faults, Machine, Reading, Source};

/// The directory's own spec and machine profile; a finding for each that is missing or refused.
pub(super) fn sources_of(files: &OutputFiles<'_>) -> Result<(Reading, Machine), Vec<Finding>> {
    let read_spec = |source: &Source| {
        let reading = spec::read(source)?;
        let name = reading.spec.drawing.as_ref().map(DrawingSpec::published_name);
        Ok(match name.and_then(|name| files.get(name)) {
            Some(bytes) => reading.with_drawing(bytes),
            None => reading,
        })
    };
    match (source_of(files, "spec.toml", read_spec), source_of(files, "machine.toml", spec::read_machine)) {
        (Ok(reading), Ok(machine)) => Ok((reading, machine)),
        (spec, machine) => Err(spec.err().into_iter().chain(machine.err()).collect()),
    }
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
        let message = faults.list().first().map_or("faults", |fault| &fault.message).to_owned();
        Finding::new(FindingCode::Unreadable, message, "text that `check` accepts").in_file(name)
    })
}

/// The refusals of the directory's design, as findings.
pub(super) fn refused(refusals: Refusals) -> Vec<Finding> {
    let findings =
        refusals.into_iter().map(|refusal| Finding::new(refusal.code, refusal.found, refusal.remedy));
    findings.map(|finding| finding.in_file("spec.toml")).collect()
}
