//! A spec with its machine, from the texts of a question.

use serde_json::Value;
use stargrip_cam::design::RefusalCode;
use stargrip_cam::spec;
use stargrip_cam::spec::{Fault, FaultCode, Faults, Machine, Reading, Source, key};

use crate::commands::faults::refused;
use crate::question::text;

/// The name of the spec in faults, equal to that in the ZIP.
const NAME: &str = "spec.toml";

/// A valid spec with its valid machine profile.
pub(super) struct Given {
    /// The spec's text.
    pub(super) source: Source,
    /// The parsed spec.
    pub(super) reading: Reading,
    /// The parsed machine profile.
    pub(super) machine: Machine,
    /// The profile's text.
    pub(super) machine_text: String,
}

/// The text `spec` of a question.
pub(super) fn source(question: &Value) -> Result<Source, Value> {
    let spec_text = text(question, "spec").unwrap_or_default();
    Source::from_bytes(NAME, spec_text.as_bytes()).map_err(|faults| refused(&faults))
}

impl Given {
    /// The spec of a question, with its drawing if that is one of the `files`. A profile that is not built in is the `machine` of the
    /// question: a page opens no files.
    ///
    /// # Errors
    /// The answer with all faults of either.
    pub(super) fn read(question: &Value, files: &[(String, Vec<u8>)]) -> Result<Self, Value> {
        let spec_source = source(question)?;
        let reading = spec::read(&spec_source).and_then(|reading| with_drawing(&spec_source, reading, files));
        let reading = reading.map_err(|faults| refused(&faults))?;
        let name = &reading.spec.machine.profile;
        let own_profile = || text(question, "machine");
        let Some(profile) = spec::builtin_machine(name).or_else(own_profile).map(str::to_owned) else {
            return Err(refused(&Faults::new(&spec_source, vec![unknown(&reading)])));
        };
        let profile = Source::from_bytes("machine.toml", profile.as_bytes());
        let machine = profile.and_then(|profile| Ok((spec::read_machine(&profile)?, profile)));
        let (machine, profile) = machine.map_err(|faults| refused(&faults))?;
        Ok(Self { source: spec_source, reading, machine, machine_text: profile.text })
    }
}

/// The reading with its drawing, under the name in the spec or that of a published directory.
fn with_drawing(source: &Source, reading: Reading, files: &[(String, Vec<u8>)]) -> Result<Reading, Faults> {
    let Some(drawing) = &reading.spec.drawing else { return Ok(reading) };
    let file_name = drawing.file_name();
    let mut named = files.iter().filter(|(name, _)| name == file_name || name == drawing.published_name());
    if let Some((_, bytes)) = named.next() {
        return Ok(reading.with_drawing(bytes));
    }
    let place = reading.raw.span_of(key::drawing::FILE);
    let fault = Fault::error(
        RefusalCode::DrawingUnread,
        place,
        format!("the page does not have the drawing {file_name:?}"),
    )
    .label("a drawing that was dropped on the page")
    .help("drop the drawing's file on the page");
    Err(Faults::new(source, vec![fault]))
}

/// The fault of a profile that is neither built in nor given.
fn unknown(reading: &Reading) -> Fault {
    let name = &reading.spec.machine.profile;
    let builtin_names: Vec<&str> = spec::builtin_machines().collect();
    let place = reading.raw.span_of(key::machine::PROFILE);
    let fault = Fault::error(
        FaultCode::UnknownMachine,
        place,
        "no built-in machine profile has this name, and a page opens no files",
    )
    .label(format!("a built-in profile: {}", builtin_names.join(", ")));
    let otherwise = || "drop the profile's file on the page together with the spec".to_owned();
    fault.help(spec::machine_remedy(name).unwrap_or_else(otherwise))
}
