//! Why a valid spec has no design.

use std::fmt;

/// A spec whose every value is in its range, but whose geometry cannot be made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// The key that is best changed: "star.points".
    pub key: String,
    /// The star (1 = bottom) that the refusal speaks of, where the key is one of `[star]` and stars differ.
    pub star: Option<u32>,
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
        Self { key: key.to_owned(), star: None, code, found, remedy }
    }

    /// The same refusal about star `index`, if it concerns one of the keys that stars can have of their own.
    pub(super) fn of_star(self, index: usize) -> Self {
        let own = self.key.starts_with("star.");
        Self { star: u32::try_from(index).ok().filter(|_| own), ..self }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}; {}", self.key, self.found, self.remedy)
    }
}

impl std::error::Error for Refusal {}
