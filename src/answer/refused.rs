//! Refusals as faults at the keys of a spec, and as JSON.

use serde_json::{Value, json};

use design::{Refusals, Warning};
use proof::verify::Finding;
use spec::{Code, Fault, Faults, RawSpec, Severity, Source, has_default};

/// Refusals of the design of `raw`, read from `source`, as faults at their keys.
pub fn at_keys(source: &Source, raw: &RawSpec, refusals: Refusals) -> Faults {
    let faults = refusals.into_iter().map(|refusal| {
        let key = refusal.key;
        // At a place of a drawing, the drawing is best changed.
        let is_drawn = refusal.drawn.is_some();
        let fault = Fault::error(refusal.code, raw.span_of(key), refusal.found)
            .label(refusal.remedy)
            .drawn_at(refusal.drawn);
        if is_drawn || raw.find(key).is_some() || !has_default(key) {
            return fault;
        }
        fault.help(format!(
            "the spec does not give `{}` in [{}], so its default is used",
            key.key(),
            key.section()
        ))
    });
    // Stars that differ elsewhere have the same fault at the same place.
    let mut distinct: Vec<Fault> = Vec::new();
    for fault in faults {
        if !distinct.contains(&fault) {
            distinct.push(fault);
        }
    }
    Faults::new(source, distinct)
}

/// One refusal: its code, and the text `message`. The other keys are null.
pub fn refusal(code: &str, message: &str) -> Value {
    json!({ "code": code, "key": null, "found": message, "allowed": null, "remedy": null, "file": null, "line": null })
}

/// The errors among `faults`; warnings are left out.
pub fn refused_by(faults: &Faults) -> Vec<Value> {
    let errors = faults.list().iter().filter(|fault| fault.level == Severity::Error);
    errors.map(|fault| fault_json(faults, fault)).collect()
}

/// One of `faults`, an error or a warning, with its key and its line.
pub fn fault_json(faults: &Faults, fault: &Fault) -> Value {
    let mut value = refusal(fault.code, &fault.message);
    value["key"] = json!(faults.key_of(fault));
    value["allowed"] = json!(fault.label);
    value["remedy"] = json!(fault.help);
    value["file"] = json!(faults.source().name);
    value["line"] = json!(faults.line_of(fault));
    if let Some(drawn_place) = &fault.drawn {
        value["elements"] = json!(drawn_place.elements);
        value["at_mm"] = json!(drawn_place.at);
    }
    value
}

/// A warning about a design: its code, its key, the finding, the remedy, and the place in a drawing, null without one.
pub fn warning_json(warning: &Warning) -> Value {
    let drawn_place = warning.drawn.as_deref();
    json!({
        "code": warning.code.as_str(),
        "key": warning.key.to_string(),
        "found": warning.found,
        "remedy": warning.remedy,
        "elements": drawn_place.map_or(&[][..], |drawn_place| &drawn_place.elements),
        "at_mm": drawn_place.and_then(|drawn_place| drawn_place.at),
    })
}

/// A finding in a file that was just made, as a refusal.
pub fn finding_json(finding: &Finding) -> Value {
    let mut value = refusal(finding.code, &finding.found);
    value["allowed"] = json!(finding.allowed);
    value["file"] = json!(finding.file);
    value["line"] = json!(finding.line);
    value
}
