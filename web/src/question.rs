//! What every question has: texts by name, faults of its own, and a receiver of its progress.

use serde_json::{Value, json};

/// Receives the part of long work that is done, 0 to 1, and the current step.
pub(crate) type Tell = fn(f64, &str);

/// The answer to a question with a fault of its own.
pub(crate) fn wrong(text: impl Into<Value>) -> Value {
    json!({ "wrong": text.into() })
}

/// The text `name` of a question.
pub(crate) fn text<'q>(question: &'q Value, name: &str) -> Option<&'q str> {
    question[name].as_str()
}
