//! The raw spec: what was written, with the place of each key and value.

use std::ops::Range;

use toml::de::DeTable;

use crate::spec::fault::Fault;
use crate::spec::value::{RawKind, RawTable, RawValue};

/// Most syntax errors collected: a wrong file has one a line.
const SYNTAX_ERRORS: usize = 100;

/// What was written: TOML, nothing decided yet.
#[derive(Clone, Debug)]
pub struct RawSpec {
    root: RawTable,
}

impl RawSpec {
    /// Reads `text` as TOML, with all of its syntax errors; what stands between them is kept.
    pub(super) fn parse(text: &str) -> (Self, Vec<Fault>) {
        let (root, errors) = DeTable::parse_recoverable(text);
        let faults = errors.iter().take(SYNTAX_ERRORS).map(syntax_fault).collect();
        (Self { root: root.get_ref().into() }, faults)
    }

    /// The whole document.
    pub(super) fn root(&self) -> &RawTable {
        &self.root
    }

    /// The elements of the list `name` of the first level, if it is one.
    pub(super) fn root_list(&self, name: &str) -> Option<&[RawValue]> {
        self.root.get(name).and_then(RawValue::as_list)
    }

    /// Place of the value at `path`, such as `star.points`, or of the header of a section, such as `star`;
    /// `None` if it was not written.
    pub fn find(&self, path: &str) -> Option<Range<usize>> {
        let (sections, key) = path.rsplit_once('.').map_or((None, path), |(s, k)| (Some(s), k));
        let mut table = &self.root;
        for section in sections.into_iter().flat_map(|s| s.split('.')) {
            table = table.get(section)?.as_table()?;
        }
        table.get(key).map(|value| value.span.clone())
    }

    /// Place to point at when speaking of `path`: its value, else its section's header, else the start of the text.
    pub fn span_of(&self, path: &str) -> Range<usize> {
        let mut path = path;
        loop {
            if let Some(span) = self.find(path) {
                return span;
            }
            match path.rsplit_once('.') {
                Some((parent, _)) => path = parent,
                None => return 0..0,
            }
        }
    }

    /// Place of what decided `key` of star `index` (1 is the bottom): its own `[[stack.star]]`, else `[star]`,
    /// `[stack]` (`rotation`, `pitch`) or `[inlet]` (`inlet_tip`), as [`RawSpec::span_of`] finds it.
    pub fn span_of_star(&self, index: u32, key: &str) -> Range<usize> {
        let own = self
            .overrides()
            .iter()
            .filter_map(RawValue::as_table)
            .filter(|table| match table.get("index").map(|value| &value.kind) {
                Some(RawKind::Number(number)) => number.whole == Some(i64::from(index)),
                _ => false,
            })
            .find_map(|table| table.get(key));
        match (own, key) {
            (Some(value), _) => value.span.clone(),
            (None, "rotation" | "pitch") => self.span_of(&format!("stack.{key}")),
            (None, "inlet_tip") => self.span_of("inlet.tip"),
            (None, key) => self.span_of(&format!("star.{key}")),
        }
    }

    /// The elements of `[[stack.star]]`.
    pub(super) fn overrides(&self) -> &[RawValue] {
        let stack = self.root.get("stack").and_then(RawValue::as_table);
        stack.and_then(|table| table.get("star")).and_then(RawValue::as_list).unwrap_or_default()
    }
}

/// The parser says "found, expected allowed".
fn syntax_fault(error: &toml::de::Error) -> Fault {
    let (found, allowed) = match error.message().split_once(", expected ") {
        // A quantity without quotes.
        Some((found, "literal string")) => (found, "write it in quotes: \"...\"".to_owned()),
        Some((found, allowed)) => (found, format!("expected {allowed}")),
        None if error.message() == "duplicate key" => (error.message(), "this was written before".to_owned()),
        None => (error.message(), String::new()),
    };
    Fault::error("syntax", error.span().unwrap_or(0..0), found).label(allowed)
}
