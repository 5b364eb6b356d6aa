//! Answers against the keys that are documented.

use serde_json::Value;
use stargrip_cam::forecast::keys::{Key, KeyKind};

/// Every key of `answer` that `keys` does not have, with an entry to copy, and every key whose value is of another kind.
pub fn misfits(answer: &Value, keys: &[&[Key]]) -> Vec<String> {
    let keys = keys.concat();
    let answer = answer.as_object().expect("an object");
    let unknown = answer.iter().filter(|(name, _)| keys.iter().all(|key| key.name != name.as_str()));
    let unknown = unknown.map(|(name, value)| format!("{name} is not among the keys: {value}"));
    let wrong = keys.iter().filter(|key| match answer.get(key.name) {
        None | Some(Value::Null) => key.always,
        Some(value) => !is_of(key.kind, value),
    });
    let wrong = wrong.map(|key| format!("{} is {:?}, not {:?}", key.name, answer.get(key.name), key.kind));
    unknown.chain(wrong).collect()
}

fn is_of(kind: KeyKind, value: &Value) -> bool {
    let number = |value: &Value| value.is_number() || value.is_null();
    let rows = |row: fn(&Value) -> bool| value.as_array().is_some_and(|rows| rows.iter().all(row));
    match kind {
        KeyKind::Text => value.is_string(),
        KeyKind::Number => value.is_number(),
        KeyKind::Pair => {
            value.as_array().is_some_and(|ends| ends.len() == 2 && ends.iter().all(Value::is_number))
        }
        KeyKind::Hinges => value.as_object().is_some_and(|pair| {
            pair.len() == 2 && ["tip", "corner"].iter().all(|at| pair.get(*at).is_some_and(number))
        }),
        KeyKind::Object => value.is_object(),
        KeyKind::List => rows(Value::is_object),
        KeyKind::Rows => {
            rows(|row| row.as_array().is_some_and(|row| row.iter().all(|v| v.is_number() || v.is_null())))
        }
        KeyKind::Variant => true,
    }
}
