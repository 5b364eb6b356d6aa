//! Faults: what is wrong with a text, where, and what would be right.
//!
//! A **fault** is one thing found at one place. Reading goes on after a fault, so that a person sees all
//! of them at once; a fault of level [`Severity::Error`] refuses the text, one of level [`Severity::Warning`] does not.

use std::fmt;
use std::ops::Range;

use crate::spec::source::Source;
use crate::spec::{Code, render};

/// Whether a fault refuses the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// It does.
    Error,
    /// It does not, but a person should know.
    Warning,
}

/// One thing found at one place of a [`Source`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The word of its [`Code`] for scripts, such as `unknown-key`.
    pub code: &'static str,
    /// Whether it refuses the text.
    pub level: Severity,
    /// What was found.
    pub message: String,
    /// What is allowed; stands at the caret.
    pub label: String,
    /// Where, in bytes of the text.
    pub span: Range<usize>,
    /// What to do about it.
    pub help: Option<String>,
}

impl Fault {
    /// A fault that refuses the text; `message` says what was found.
    pub fn error(code: impl Code, span: Range<usize>, message: impl Into<String>) -> Self {
        Self {
            code: code.as_str(),
            level: Severity::Error,
            message: message.into(),
            label: String::new(),
            span,
            help: None,
        }
    }

    /// A fault that lets the text pass; `message` says what was found.
    pub fn warning(code: impl Code, span: Range<usize>, message: impl Into<String>) -> Self {
        Self { level: Severity::Warning, ..Self::error(code, span, message) }
    }

    /// The same fault with `label`, what is allowed, at its caret.
    pub fn label(self, label: impl Into<String>) -> Self {
        Self { label: label.into(), ..self }
    }

    /// The same fault with `help`, what to do about it.
    pub fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }
}

/// All faults of one source, in the order of their places. It prints without colour.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Faults {
    source: Source,
    list: Vec<Fault>,
}

impl Faults {
    /// Collects `list`, the faults of `source`; spans outside the text are drawn to its end.
    pub fn new(source: &Source, mut list: Vec<Fault>) -> Self {
        for fault in &mut list {
            let end = boundary(&source.text, fault.span.end);
            fault.span = boundary(&source.text, fault.span.start).min(end)..end;
        }
        list.sort_by_key(|fault| (fault.span.start, fault.span.end));
        Self { source: source.clone(), list }
    }

    /// The faults in the order of their places.
    pub fn list(&self) -> &[Fault] {
        &self.list
    }

    /// The text they speak of.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Whether at least one of them refuses the text.
    pub fn refuse(&self) -> bool {
        self.list.iter().any(|fault| fault.level == Severity::Error)
    }

    /// All faults for a terminal, with colour; [`fmt::Display`] gives the same without.
    pub fn coloured(&self) -> String {
        render::coloured(self)
    }
}

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&render::plain(self))
    }
}

impl std::error::Error for Faults {}

/// The last place at or before `at` where a character of `text` begins or the text ends.
fn boundary(text: &str, at: usize) -> usize {
    let at = at.min(text.len());
    (0..=at).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0)
}

/// `text` as it may stand in a message: between backticks, on one line, at most 60 characters of it.
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
    use crate::spec::FaultCode;

    #[test]
    fn spans_are_drawn_into_the_text() {
        let source = Source::new("a", "µ = 1");
        #[expect(clippy::reversed_empty_ranges, reason = "this is what must do no harm")]
        let spans = [1..3, 100..200, 3..1, 2..usize::MAX];
        let faults =
            Faults::new(&source, spans.into_iter().map(|s| Fault::error(FaultCode::Name, s, "m")).collect());
        for fault in faults.list() {
            assert!(source.text.get(fault.span.clone()).is_some(), "{:?}", fault.span);
        }
        assert!(!faults.to_string().is_empty());
    }

    #[test]
    fn faults_stand_in_the_order_of_their_places() {
        let source = Source::new("a", "a\nb\nc\n");
        let faults = Faults::new(
            &source,
            [4, 0, 2].map(|at| Fault::warning(FaultCode::Name, at..at + 1, "m")).into_iter().collect(),
        );
        assert_eq!(faults.list().iter().map(|f| f.span.start).collect::<Vec<_>>(), [0, 2, 4]);
        assert!(!faults.refuse());
        assert!(Faults::new(&source, vec![Fault::error(FaultCode::Name, 0..0, "m")]).refuse());
    }

    #[test]
    fn what_is_quoted_stays_on_its_line() {
        assert_eq!(quoted("a \"b\"\n\u{1b}[31m"), "`a \"b\"\\n\\u{1b}[31m`");
        assert_eq!(quoted(&"é".repeat(61)), format!("`{}...`", "é".repeat(60)));
    }
}
