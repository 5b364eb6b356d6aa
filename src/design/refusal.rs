//! Why a valid spec has no design.

use std::fmt;

/// A spec whose every value is in its range, but whose geometry cannot be made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// The key that is best changed: "star.points".
    pub key: String,
    /// A short name for scripts: "no-arm".
    pub code: &'static str,
    /// What was found, with numbers.
    pub found: String,
    /// What is allowed, and the remedy.
    pub remedy: String,
}

impl Refusal {
    /// A refusal that points at `key`.
    pub fn new(key: &str, code: &'static str, found: String, remedy: String) -> Self {
        Self { key: key.to_owned(), code, found, remedy }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}; {}", self.key, self.found, self.remedy)
    }
}

impl std::error::Error for Refusal {}
