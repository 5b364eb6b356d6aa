//! Values as they were written, each with its place.

use geom::order::sort_by;
use std::ops::Range;

use toml::de::{DeFloat, DeInteger, DeTable, DeValue};

use crate::fault::quoted;

/// A value that was written, with its place.
#[derive(Clone, Debug)]
pub(super) struct RawValue {
    /// The value.
    pub(super) kind: RawKind,
    /// Span of the value, in bytes of the text; of a section, the span of its header.
    pub(super) span: Range<usize>,
}

/// The kinds of values.
#[derive(Clone, Debug)]
pub(super) enum RawKind {
    Text(String),
    Number(RawNumber),
    Truth(bool),
    /// A date or a time, which no key takes.
    Date,
    List(Vec<RawValue>),
    Table(RawTable),
}

/// A number without quotes.
#[derive(Clone, Debug)]
pub(super) struct RawNumber {
    /// The text of the number, without underscores.
    pub(super) text: String,
    /// Value of the number; NaN if it is too large.
    pub(super) value: f64,
    /// Whether it was written as an integer.
    pub(super) is_integer: bool,
    /// The integer, unless it is too large.
    pub(super) whole: Option<i64>,
}

/// A key with its value.
#[derive(Clone, Debug)]
pub(super) struct RawEntry {
    /// The key.
    pub(super) key: String,
    /// The span of the key.
    pub(super) key_span: Range<usize>,
    /// Value of the key.
    pub(super) value: RawValue,
}

/// A table: keys, each once, in the order of the alphabet.
#[derive(Clone, Debug)]
pub(super) struct RawTable(pub(super) Vec<RawEntry>);

impl RawTable {
    /// The value of `key`.
    pub(super) fn get(&self, key: &str) -> Option<&RawValue> {
        let index = self.0.binary_search_by(|entry| entry.key.as_str().cmp(key)).ok()?;
        self.0.get(index).map(|entry| &entry.value)
    }
}

impl RawValue {
    /// The table, if it is one.
    pub(super) fn as_table(&self) -> Option<&RawTable> {
        let RawKind::Table(table) = &self.kind else { return None };
        Some(table)
    }

    /// The text, if it is one.
    pub(super) fn as_text(&self) -> Option<&str> {
        let RawKind::Text(text) = &self.kind else { return None };
        Some(text)
    }

    /// The elements, if it is a list.
    pub(super) fn as_list(&self) -> Option<&[RawValue]> {
        let RawKind::List(list) = &self.kind else { return None };
        Some(list)
    }

    /// The value in plain words.
    pub(super) fn in_words(&self) -> String {
        match &self.kind {
            RawKind::Text(text) => format!("the text {}", quoted(text)),
            RawKind::Number(number) => format!("the number {}", number.shortened_text()),
            RawKind::Truth(truth) => truth.to_string(),
            RawKind::Date => "a date".to_owned(),
            RawKind::List(_) => "a list".to_owned(),
            RawKind::Table(_) => "a section".to_owned(),
        }
    }
}

impl RawNumber {
    /// The number as it was written, cut if it is very long.
    pub(super) fn shortened_text(&self) -> String {
        const LONGEST: usize = 30;
        let cut = self.text.chars().take(LONGEST).collect::<String>();
        if cut.len() < self.text.len() { format!("{cut}...") } else { cut }
    }
}

impl From<&DeTable<'_>> for RawTable {
    fn from(table: &DeTable<'_>) -> Self {
        let entry = |(key, value): (&toml::Spanned<_>, &toml::Spanned<DeValue<'_>>)| {
            let text: &std::borrow::Cow<'_, str> = key.get_ref();
            RawEntry { key: text.to_string(), key_span: key.span(), value: value.into() }
        };
        let mut entries: Vec<RawEntry> = table.iter().map(entry).collect();
        sort_by(&mut entries, |a, b| a.key.cmp(&b.key));
        Self(entries)
    }
}

impl From<&toml::Spanned<DeValue<'_>>> for RawValue {
    fn from(value: &toml::Spanned<DeValue<'_>>) -> Self {
        let kind = match value.get_ref() {
            DeValue::String(text) => RawKind::Text(text.to_string()),
            DeValue::Integer(number) => RawKind::Number(number.into()),
            DeValue::Float(number) => RawKind::Number(number.into()),
            DeValue::Boolean(truth) => RawKind::Truth(*truth),
            DeValue::Datetime(_) => RawKind::Date,
            DeValue::Array(list) => RawKind::List(list.iter().map(Into::into).collect()),
            DeValue::Table(table) => RawKind::Table(table.into()),
        };
        Self { kind, span: value.span() }
    }
}

impl From<&DeInteger<'_>> for RawNumber {
    fn from(number: &DeInteger<'_>) -> Self {
        let integer = i64::from_str_radix(number.as_str(), number.radix()).ok();
        #[expect(clippy::cast_precision_loss, reason = "no range reaches to where integers are lost")]
        let value = integer.map_or(f64::NAN, |integer| integer as f64);
        Self { text: number.to_string(), value, is_integer: true, whole: integer }
    }
}

impl From<&DeFloat<'_>> for RawNumber {
    fn from(number: &DeFloat<'_>) -> Self {
        // The parser has checked the form already, unless it reported an error here.
        let value = number.as_str().parse().unwrap_or(f64::NAN);
        Self { text: number.to_string(), value, is_integer: false, whole: None }
    }
}
