//! A finding of the verifier in a file.

use std::fmt;

use serde::Serialize;

use crate::verify::FindingCode;
use spec::{Code, misleads};

/// Most findings kept for one file; the rest is only counted, so that junk of any size stays readable.
const LIMIT: usize = 100;

/// Longest quotation from a file, in characters.
const QUOTATION: usize = 60;

/// Longest text of a found or an allowed value, in characters: whatever a file calls its elements, the message stays readable.
const LONGEST: usize = 1000;

/// One fault of one file: the value found and the value allowed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// Path of the file in the output directory; empty until [`Finding::in_file`] fills it in.
    pub file: String,
    /// Line in the file, from 1, where a line is to blame.
    pub line: Option<usize>,
    /// The word of its [`FindingCode`] for scripts; of a design that is refused, of the refusal's code.
    pub code: &'static str,
    /// The content of the file.
    pub found: String,
    /// The right content.
    pub allowed: String,
}

impl Finding {
    /// A finding about a whole file, which is not known yet.
    pub fn new(code: impl Code, fault: impl Into<String>, allowed: impl Into<String>) -> Self {
        Self::in_line(code, None, fault, allowed)
    }

    /// A finding about a line of a file that is not known yet.
    pub fn in_line(
        code: impl Code,
        line: impl Into<Option<usize>>,
        fault: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Self {
        Self {
            file: String::new(),
            line: line.into(),
            code: code.as_str(),
            found: fit(fault.into()),
            allowed: fit(allowed.into()),
        }
    }

    /// This finding, about `file`.
    pub fn in_file(self, file: &str) -> Self {
        Self { file: file.to_owned(), ..self }
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.file.is_empty() { "file" } else { &self.file })?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
        }
        write!(f, ": {}: found {}, allowed {}", self.code, self.found, self.allowed)
    }
}

/// The findings about one file, in order; beyond a hundred they are only counted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Findings {
    kept: Vec<Finding>,
    dropped: usize,
}

impl Findings {
    /// Adds a finding about the whole file.
    pub fn add(&mut self, code: impl Code, fault: impl Into<String>, allowed: impl Into<String>) {
        self.push(Finding::new(code, fault, allowed));
    }

    /// Adds a finding about a line.
    pub fn add_at(
        &mut self,
        code: impl Code,
        line: impl Into<Option<usize>>,
        fault: impl Into<String>,
        allowed: impl Into<String>,
    ) {
        self.push(Finding::in_line(code, line, fault, allowed));
    }

    /// Adds a finding that exists already.
    pub fn push(&mut self, finding: Finding) {
        if self.kept.len() < LIMIT {
            self.kept.push(finding);
        } else {
            self.dropped += 1;
        }
    }

    /// Adds findings that exist already.
    pub fn extend(&mut self, findings: impl IntoIterator<Item = Finding>) {
        findings.into_iter().for_each(|finding| self.push(finding));
    }

    /// Adds all that another list has kept and counted.
    pub(super) fn absorb(&mut self, other: Self) {
        self.extend(other.kept);
        self.dropped += other.dropped;
    }

    /// Whether there are no findings.
    pub fn is_empty(&self) -> bool {
        self.kept.is_empty()
    }

    /// Whether further findings are only counted.
    pub(super) fn is_full(&self) -> bool {
        self.kept.len() >= LIMIT
    }

    /// All that were kept, and one more that counts the rest, if there is one.
    pub fn into_vec(mut self) -> Vec<Finding> {
        if self.dropped > 0 {
            let fault = format!("{} more findings", self.dropped);
            self.kept.push(Finding::new(FindingCode::MoreFindings, fault, "none"));
        }
        self.kept
    }
}

/// `text` on one line of bounded length, with control characters of a terminal spelt out: not every reader quotes the content of
/// a file.
fn fit(text: String) -> String {
    let long = text.len() > LONGEST && text.chars().count() > LONGEST;
    if !long && !text.contains(misleads) {
        return text;
    }
    let mut escaped = String::new();
    for c in text.chars().take(LONGEST) {
        if misleads(c) { escaped.extend(c.escape_default()) } else { escaped.push(c) }
    }
    escaped + if long { "..." } else { "" }
}

/// A piece of a file, fit to be shown: short, on one line, quoted.
pub(super) fn quote(text: &str) -> String {
    let mut start: String = text.chars().take(QUOTATION).collect();
    if start.len() < text.len() {
        start.push_str("...");
    }
    format!("{start:?}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shows_file_line_and_both_sides() {
        let finding = Finding::in_line(FindingCode::WrongFeed, 7, "F12", "F6").in_file("star-1.gcode");
        assert_eq!(finding.to_string(), "star-1.gcode:7: wrong-feed: found F12, allowed F6");
        let json = serde_json::to_string(&finding).unwrap();
        assert_eq!(
            json,
            r#"{"file":"star-1.gcode","line":7,"code":"wrong-feed","found":"F12","allowed":"F6"}"#
        );
    }

    #[test]
    fn no_finding_commands_a_terminal_or_fills_it() {
        let finding = Finding::in_line(FindingCode::UnknownWord, 1, "/Ro\u{7f}t\u{9b}\n", "x".repeat(5000));
        assert_eq!(finding.found, "/Ro\\u{7f}t\\u{9b}\\n");
        assert_eq!(finding.allowed.len(), LONGEST + 3);
        assert_eq!(Finding::in_line(FindingCode::UnknownWord, 1, "µ 星", "").found, "µ 星");
    }

    #[test]
    fn counts_what_it_does_not_keep() {
        let mut findings = Findings::default();
        for line in 0..250 {
            findings.add_at(FindingCode::UnknownWord, line, "x", "y");
        }
        let list = findings.into_vec();
        assert_eq!(list.len(), LIMIT + 1);
        assert_eq!(list[LIMIT].found, "150 more findings");
    }

    #[test]
    fn quotes_are_short_and_harmless() {
        assert_eq!(quote("a\r\u{1b}b"), r#""a\r\u{1b}b""#);
        assert!(quote(&"x".repeat(1 << 20)).len() < 80);
    }
}
