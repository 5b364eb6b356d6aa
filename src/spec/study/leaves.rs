//! The keys of the spec that a section of a study names, each as written: `"star.points" = ...`, `star.points = ...`, or under
//! `[vary.star]`.

use std::ops::Range;

use crate::spec::FaultCode;
use crate::spec::fault::{Fault, quoted};
use crate::spec::study::field::Field;
use crate::spec::value::{RawEntry, RawTable, RawValue};

/// A key of the study, with its value.
pub(super) struct Leaf<'r> {
    /// The key of the spec.
    pub(super) field: Field,
    /// The span of its name.
    pub(super) place: Range<usize>,
    /// Its value.
    pub(super) value: &'r RawValue,
}

/// The keys of `table`, in the order in which they were written; a fault for each that the spec does not have.
pub(super) fn leaves<'r>(table: &'r RawTable, faults: &mut Vec<Fault>) -> Vec<Leaf<'r>> {
    let mut found = Vec::new();
    for entry in &table.0 {
        gather(entry, "", &mut found, faults);
    }
    found.sort_by_key(|leaf| leaf.place.start);
    found
}

fn gather<'r>(entry: &'r RawEntry, section: &str, found: &mut Vec<Leaf<'r>>, faults: &mut Vec<Fault>) {
    let name = format!("{section}{}", entry.key);
    if let Some(field) = Field::of(&name) {
        found.push(Leaf { field, place: entry.key_span.clone(), value: &entry.value });
        return;
    }
    if let Some(table) = entry.value.as_table().filter(|_| section.is_empty()) {
        for inner in &table.0 {
            gather(inner, &format!("{name}."), found, faults);
        }
        return;
    }
    let help = match Field::near(&name) {
        Some(near) => format!("did you mean `{near}`?"),
        None => "keys are written with their section: star.points, load.pressure".to_owned(),
    };
    let what = if name.starts_with("stack.star") || name == "schema" {
        format!("{} cannot be set by a study", quoted(&name))
    } else {
        format!("unknown key {}", quoted(&name))
    };
    let fault = Fault::error(FaultCode::UnknownKey, entry.key_span.clone(), what);
    faults.push(fault.label("must be a key of the spec").help(help));
}
