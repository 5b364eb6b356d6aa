//! A fault of a text: the finding, its place, and the right content.
//!
//! A **fault** is one thing found at one place. Reading goes on after a fault, so that a person sees all
//! of them at once; a fault of level [`Severity::Error`] refuses the text, one of level [`Severity::Warning`] does not.

use std::borrow::Cow;
use std::ops::Range;

use crate::Code;

/// Whether a fault refuses the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// The text is refused.
    Error,
    /// The text passes; the person should read the warning.
    Warning,
}

/// A place in a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnPlace {
    /// The elements, by their ids.
    pub elements: Vec<String>,
    /// A point, mm; `None` if unknown.
    pub at: Option<[f64; 2]>,
}

/// How a user comes to a whole spec instead of the text that has the fault. An interface has the words for it: [`crate::Faults::offer`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NewSpec {
    /// By a starter.
    Starter,
    /// From a drawing.
    FromDrawing,
}

/// One thing found at one place of a source.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// The word of its [`Code`] for scripts, such as `unknown-key`.
    pub code: &'static str,
    /// Whether it refuses the text.
    pub level: Severity,
    /// The fault found.
    pub message: String,
    /// The allowed values; shown at the caret.
    pub label: String,
    /// The place, in bytes of the text.
    pub span: Range<usize>,
    /// The remedy.
    pub help: Option<String>,
    /// Another remedy.
    pub new_spec: Option<NewSpec>,
    /// The place in the drawing that the text names.
    pub drawn: Option<Box<DrawnPlace>>,
}

impl Fault {
    /// A fault that refuses the text; `message` states the finding.
    pub fn error(code: impl Code, span: Range<usize>, message: impl Into<String>) -> Self {
        Self {
            code: code.as_str(),
            level: Severity::Error,
            message: shortened(&message.into()).into_owned(),
            label: String::new(),
            span,
            help: None,
            new_spec: None,
            drawn: None,
        }
    }

    /// A fault that lets the text pass; `message` states the finding.
    pub fn warning(code: impl Code, span: Range<usize>, message: impl Into<String>) -> Self {
        Self { level: Severity::Warning, ..Self::error(code, span, message) }
    }

    /// This fault with `label`, the allowed values, at its caret.
    pub fn label(self, label: impl Into<String>) -> Self {
        Self { label: shortened(&label.into()).into_owned(), ..self }
    }

    /// This fault, at a place of the drawing.
    pub fn drawn_at(self, place: Option<Box<DrawnPlace>>) -> Self {
        Self { drawn: place, ..self }
    }

    /// This fault with the remedy `help`.
    pub fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(shortened(&help.into()).into_owned()), ..self }
    }

    /// This fault, of a text in place of which a `new_spec` may be written.
    pub(super) fn or_new_spec(self, new_spec: Option<NewSpec>) -> Self {
        Self { new_spec, ..self }
    }
}

/// Longest word of a message, characters. No word of this program's is half as long, but a name from a file may have any length.
const LONGEST_WORD: usize = 200;
/// Longest message, characters: a list of all layers of a large drawing still has room.
const LONGEST_MESSAGE: usize = 8000;

/// `text` with its long words cut, and cut itself where it is too long for a person; `...` stands for what is left out.
pub fn shortened(text: &str) -> Cow<'_, str> {
    if text.len() <= LONGEST_WORD {
        return Cow::Borrowed(text);
    }
    let (mut short, mut word, mut length) = (String::with_capacity(text.len().min(LONGEST_MESSAGE)), 0, 0);
    for c in text.chars() {
        word = if c.is_whitespace() { 0 } else { word + 1 };
        if length >= LONGEST_MESSAGE {
            short.push_str(" ...");
            break;
        }
        match word {
            ..=LONGEST_WORD => {
                short.push(c);
                length += 1;
            }
            _ if word == LONGEST_WORD + 1 => short.push_str("..."),
            _ => {}
        }
    }
    Cow::Owned(short)
}

/// `text` made fit for a message: between backticks, on one line, cut at 60 characters.
pub(super) fn quoted(text: &str) -> String {
    const LONGEST: usize = 60;
    let mut start: String = text.chars().take(LONGEST).flat_map(char::escape_debug).collect();
    if text.chars().nth(LONGEST).is_some() {
        start.push_str("...");
    }
    format!("`{}`", start.replace("\\\"", "\"").replace("\\'", "'"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_any_length_leave_a_message_readable() {
        let message = shortened(&format!("layer \"{}\" has no role", "é".repeat(100_000))).into_owned();
        assert!(message.starts_with("layer \"é") && message.ends_with("é... has no role"), "{message}");
        assert!(message.chars().count() < 250);
        assert!(shortened(&"a ".repeat(100_000)).len() < 9_000);
        let usual = "the drawing has no layer \"a\": ".repeat(20);
        assert_eq!(shortened(&usual), usual);
    }

    #[test]
    fn what_is_quoted_stays_on_its_line() {
        assert_eq!(quoted("a \"b\"\n\u{1b}[31m"), "`a \"b\"\\n\\u{1b}[31m`");
        assert_eq!(quoted(&"é".repeat(61)), format!("`{}...`", "é".repeat(60)));
    }
}
