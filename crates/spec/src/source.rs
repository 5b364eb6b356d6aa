//! The text that is read, and where it came from.

/// Largest text read, in bytes: hundreds of times a long spec, and small enough that a wrong file costs nothing.
pub const SIZE_LIMIT: usize = 1 << 20;

/// A text with the name that faults show.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// A path or another name; shown in faults, never opened.
    pub name: String,
    /// The text.
    pub text: String,
}

impl Source {
    /// A source from a text that is at hand already.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        Self { name: name.into(), text: text.into() }
    }
}

/// The last place at or before `place` where a character of `text` begins or the text ends.
pub(super) fn boundary(text: &str, place: usize) -> usize {
    let limit = place.min(text.len());
    (0..=limit).rev().find(|limit| text.is_char_boundary(*limit)).unwrap_or(0)
}
