//! Warnings of predictions, with a code for callers that treat some of them in their own way.

use std::fmt;

use serde::{Serialize, Serializer};

/// The subject of a warning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WarningCode {
    /// No model applies; the text is the reason for the choice of the model, too.
    NoModel,
    /// A seal bursts, or may burst.
    Bursting,
    /// The object is not held, or may not be.
    Object,
    /// A drawn piece leaves its plane.
    LeavesPlane,
    /// A limit of validity, or a remark.
    Validity,
}

/// A warning for the user; in JSON it is its text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PredictionWarning {
    /// The subject.
    pub code: WarningCode,
    /// The sentence, without its full stop.
    pub text: String,
}

impl PredictionWarning {
    /// A warning about the subject `code`.
    pub fn new(code: WarningCode, text: impl Into<String>) -> Self {
        Self { code, text: text.into() }
    }
}

impl From<String> for PredictionWarning {
    /// A warning about a limit of validity.
    fn from(text: String) -> Self {
        Self::new(WarningCode::Validity, text)
    }
}

impl fmt::Display for PredictionWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl Serialize for PredictionWarning {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.text)
    }
}
