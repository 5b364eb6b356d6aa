//! The raw spec: the text as parsed, with the place of each key and value.

use std::ops::Range;

use toml::de::DeTable;

use crate::fault::Fault;
use crate::value::{RawEntry, RawKind, RawTable, RawValue};
use crate::{KeyPath, syntax};

/// The parsed TOML, before validation.
#[derive(Clone, Debug)]
pub struct RawSpec {
    root: RawTable,
}

impl RawSpec {
    /// Reads `text` as TOML, with the first of its syntax errors; the text between them is kept.
    pub(super) fn parse(text: &str) -> (Self, Vec<Fault>) {
        let (root, errors) = DeTable::parse_recoverable(text);
        let root: RawTable = root.get_ref().into();
        let faults = syntax::faults(&errors, text);
        // The tables that the parser recovers between so many errors are arbitrary.
        let sound_root = if errors.len() < syntax::FLOOD { root } else { RawTable(Vec::new()) };
        (Self { root: sound_root }, faults)
    }

    /// A document in which nothing but `key` is written.
    pub(super) fn of_one(key: KeyPath, value: RawValue) -> Self {
        let span = value.span.clone();
        let table = single_entry(key.key(), value);
        let root = match key.section() {
            "" => table,
            section => single_entry(section, RawValue { kind: RawKind::Table(table), span }),
        };
        Self { root }
    }

    /// The whole document.
    pub(super) fn root(&self) -> &RawTable {
        &self.root
    }

    /// Place of the value that decides `key`: of a star's key its own `[[stack.star]]` before the common section;
    /// `None` if it was not written.
    pub fn find(&self, key: KeyPath) -> Option<Range<usize>> {
        let own_value =
            key.star().zip(key.own_name()).and_then(|(star, name)| self.star_table(star)?.get(name));
        let common = || match key.section() {
            "" => self.root.get(key.key()),
            _ => self.section(key)?.as_table()?.get(key.key()),
        };
        let value = own_value.or_else(common);
        value.map(|value| value.span.clone())
    }

    /// The text of `key` with its place, of a spec that may have faults elsewhere; `None` if no text is written there.
    pub(super) fn text_of(&self, key: KeyPath) -> Option<(&str, Range<usize>)> {
        let value = self.section(key)?.as_table()?.get(key.key())?;
        Some((value.as_text()?, value.span.clone()))
    }

    /// Place to point at when speaking of `key`: its value, else its section's header, else the end of the text, where
    /// the section would be added.
    pub fn span_of(&self, key: KeyPath) -> Range<usize> {
        let header = || self.section(key).map(|section| section.span.clone());
        self.find(key).or_else(header).unwrap_or(usize::MAX..usize::MAX)
    }

    /// The section of `key`, of a process its own; the keys before the first section have none.
    fn section(&self, key: KeyPath) -> Option<&RawValue> {
        let section = self.root.get(key.section())?;
        let Some(process) = key.process() else { return Some(section) };
        let entries = &section.as_table()?.0;
        entries.get(usize::try_from(process).ok()?).map(|entry| &entry.value)
    }

    /// The `[[stack.star]]` of star `index`.
    fn star_table(&self, index: u32) -> Option<&RawTable> {
        self.overrides().iter().filter_map(RawValue::as_table).find(|table| {
            match table.get("index").map(|value| &value.kind) {
                Some(RawKind::Number(number)) => number.whole == Some(i64::from(index)),
                _ => false,
            }
        })
    }

    /// The key whose name or value is at `span`, or the section: `star.points`, `stack.star[2].pitch`, `star`; `None` if none is.
    pub(super) fn key_at(&self, span: &Range<usize>) -> Option<String> {
        key_at(&self.root, span, "")
    }

    /// Whether a star may have values of its own.
    pub fn has_overrides(&self) -> bool {
        !self.overrides().is_empty()
    }

    /// The elements of `[[stack.star]]`.
    pub(super) fn overrides(&self) -> &[RawValue] {
        let stack = self.root.get("stack").and_then(RawValue::as_table);
        stack.and_then(|table| table.get("star")).and_then(RawValue::as_list).unwrap_or_default()
    }
}

/// A table of one entry.
fn single_entry(name: &str, value: RawValue) -> RawTable {
    RawTable(vec![RawEntry { key: name.to_owned(), key_span: value.span.clone(), value }])
}

/// The deepest key of `table`, which is `path`, whose name or value holds `span`.
fn key_at(table: &RawTable, span: &Range<usize>, path: &str) -> Option<String> {
    table.0.iter().find_map(|entry| {
        let dot = if path.is_empty() { "" } else { "." };
        let name = format!("{path}{dot}{}", entry.key);
        let elements = entry.value.as_list().unwrap_or_default();
        let nested = entry.value.as_table().and_then(|table| key_at(table, span, &name)).or_else(|| {
            let tables = elements.iter().zip(1..).filter_map(|(item, i)| Some((item.as_table()?, item, i)));
            let mut names = tables.map(|(table, item, i)| {
                let name = format!("{name}[{i}]");
                key_at(table, span, &name).or_else(|| contains_span(&item.span, span).then_some(name))
            });
            names.find_map(|names| names)
        });
        nested.or_else(|| {
            (contains_span(&entry.key_span, span) || contains_span(&entry.value.span, span)).then_some(name)
        })
    })
}

/// Whether `place` holds all of `span`.
fn contains_span(place: &Range<usize>, span: &Range<usize>) -> bool {
    place.start <= span.start && span.start < place.end && span.end <= place.end
}
