//! The text of a spec with the values of a row.

use crate::edit::{with_process, with_values};
use crate::faults::Faults;
use crate::key::KeyPath;
use crate::source::Source;
use crate::study::field::{Field, KeyValue};

/// The text of `source`, a valid spec that has the processes of all fields, with each field set to its value. It has not been read back:
/// the values may not go together.
///
/// # Errors
/// If the section of a field cannot be edited.
pub fn with_fields<'v>(
    source: &Source,
    values: impl IntoIterator<Item = (&'v Field, KeyValue)>,
) -> Result<String, Faults> {
    let (of_process, plain): (Vec<_>, Vec<_>) =
        values.into_iter().partition(|(field, _)| field.process().is_some());
    let plain: Vec<(KeyPath, String)> =
        plain.iter().map(|(field, value)| (field.key(), field.toml(value))).collect();
    let mut text = with_values(source, &plain)?;
    for (field, value) in of_process {
        let Some(name) = field.process() else { continue };
        let edited = Source::new(source.name.as_str(), text);
        text = with_process(&edited, name, field.key(), Some(&field.toml(&value)))?;
    }
    Ok(text)
}
