//! Faults for the page: as with `--json`, but with warnings, and with the place for an editor.

use serde_json::{Value, json};
use stargrip_cam::answer::refused::{at_keys, fault_json};
use stargrip_cam::design::{Refusals, Warning};
use stargrip_cam::spec::{Fault, FaultCode, Faults, Reading, Severity, Source};

/// What to do with a text that is a file of another kind, in place of the command that takes it.
const INSTEAD: &str = "open or drop a file of this kind, or begin with an object, a drawing or a design";

/// All of `faults`: the values of `--json`, whether each is a warning, its column, and its start and end in the text.
///
/// Columns (from 1) and places are counted as in JavaScript: in units of UTF-16.
pub(super) fn listed(faults: &Faults) -> Vec<Value> {
    let text = &faults.source().text;
    let page_fault = |fault: &Fault| {
        let mut value = fault_json(faults, fault);
        let line = text[..fault.span.start].rfind('\n').map_or(0, |end| end + 1);
        let is_for_command = value["remedy"].as_str().is_some_and(|remedy| remedy.contains("`stargrip-cam "));
        if FaultCode::NotASpec == fault.code && is_for_command {
            value["remedy"] = INSTEAD.into();
        }
        value["warning"] = json!(fault.level == Severity::Warning);
        value["column"] = json!(1 + utf16_units(text, fault.span.start) - utf16_units(text, line));
        value["place"] = json!([utf16_units(text, fault.span.start), utf16_units(text, fault.span.end)]);
        value
    };
    faults.list().iter().map(page_fault).collect()
}

/// The length of the first `end` bytes of `text` in units of UTF-16.
fn utf16_units(text: &str, end: usize) -> usize {
    text[..end].encode_utf16().count()
}

/// The answer to a question whose texts have `faults`.
pub(super) fn refused(faults: &Faults) -> Value {
    json!({ "faults": listed(faults) })
}

/// The refusals of the design of a spec, which was read as `reading` from `source`.
pub(super) fn of_design(source: &Source, reading: &Reading, refusals: Refusals) -> Vec<Value> {
    listed(&at_keys(source, &reading.raw, refusals))
}

/// The warnings of the design of a spec, which was read as `reading` from `source`.
pub(super) fn of_warnings(source: &Source, reading: &Reading, warnings: &[Warning]) -> Vec<Value> {
    let fault = |warning: &Warning| {
        Fault::warning(warning.code, reading.raw.span_of(warning.key), warning.found.clone())
            .label(warning.remedy.clone())
            .drawn_at(warning.drawn.clone())
    };
    listed(&Faults::new(source, warnings.iter().map(fault).collect()))
}
