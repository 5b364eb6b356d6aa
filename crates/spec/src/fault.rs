//! A fault of a text: the finding, its place, and the right content.
//!
//! A **fault** is one thing found at one place. Reading goes on after a fault, so that a person sees all
//! of them at once; a fault of level [`Severity::Error`] refuses the text, one of level [`Severity::Warning`] does not.

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
    /// The place in the drawing that the text names.
    pub drawn: Option<Box<DrawnPlace>>,
}

impl Fault {
    /// A fault that refuses the text; `message` states the finding.
    pub fn error(code: impl Code, span: Range<usize>, message: impl Into<String>) -> Self {
        Self {
            code: code.as_str(),
            level: Severity::Error,
            message: message.into(),
            label: String::new(),
            span,
            help: None,
            drawn: None,
        }
    }

    /// A fault that lets the text pass; `message` states the finding.
    pub fn warning(code: impl Code, span: Range<usize>, message: impl Into<String>) -> Self {
        Self { level: Severity::Warning, ..Self::error(code, span, message) }
    }

    /// The same fault with `label`, the allowed values, at its caret.
    pub fn label(self, label: impl Into<String>) -> Self {
        Self { label: label.into(), ..self }
    }

    /// The same fault, found at a place of the drawing.
    pub fn drawn_at(self, drawn: Option<Box<DrawnPlace>>) -> Self {
        Self { drawn, ..self }
    }

    /// The same fault with the remedy `help`.
    pub fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }
}

/// `text` made fit for a message: between backticks, on one line, cut at 60 characters.
pub(super) fn quoted(text: &str) -> String {
    const LONGEST: usize = 60;
    let mut shown: String = text.chars().take(LONGEST).flat_map(char::escape_debug).collect();
    if text.chars().nth(LONGEST).is_some() {
        shown.push_str("...");
    }
    format!("`{}`", shown.replace("\\\"", "\"").replace("\\'", "'"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_quoted_stays_on_its_line() {
        assert_eq!(quoted("a \"b\"\n\u{1b}[31m"), "`a \"b\"\\n\\u{1b}[31m`");
        assert_eq!(quoted(&"é".repeat(61)), format!("`{}...`", "é".repeat(60)));
    }
}
