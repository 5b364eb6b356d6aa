//! `edit`: a new value in a user's text, whose layout is kept.

use serde_json::{Value, json};
use stargrip_cam::spec::{edit as text_edit, key};

use crate::commands::faults::refused;
use crate::commands::spec::source;
use crate::commands::{text, wrong};

/// The spec with `value`, a TOML value, at `key`. The result is not validated here: a slider may pass an invalid value.
///
/// # Errors
/// If there is no such key, or the text cannot be changed.
pub(super) fn edit(question: &Value) -> Result<Value, Value> {
    let source = source(question)?;
    let name = text(question, "key").unwrap_or_default();
    let key = key::named(name).map_err(|_| wrong(format!("no key is called {name:?}")))?;
    let edited = match text(question, "value") {
        Some(value) => text_edit::with_values(&source, &[(key, value.to_owned())]),
        None => text_edit::with_changes(&source, &[(key, None)]),
    };
    let spec = edited.map_err(|faults| refused(&faults))?;
    Ok(json!({ "spec": spec }))
}
