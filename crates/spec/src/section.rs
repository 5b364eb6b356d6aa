//! Takes values out of the parsed text: key by key, each with its kind and its range.
//!
//! A **section** is a table with a name. Taking a key registers it, so that a key that is never taken is an unknown one, and
//! there is no second list of keys to maintain.

mod quantities;
mod words;

use std::ops::Range;

use crate::FaultCode;
use crate::allowed::Allowed;
use crate::fault::Fault;
use crate::message::header;
use crate::raw::RawSpec;
use crate::shape::ValueShape;
use crate::units::{Length, Percent, Quantity};
use crate::unknown::{self, Known, Missing};
use crate::value::{RawKind, RawTable, RawValue};

/// Reads one document and collects its faults.
pub(super) struct Reader<'r> {
    /// The parsed text.
    pub(super) raw: &'r RawSpec,
    /// The faults so far.
    pub(super) faults: Vec<Fault>,
    known: Vec<Known<'r>>,
    missing: Vec<Missing>,
    shapes: Vec<(&'static str, &'static str, ValueShape)>,
    required: Vec<(&'static str, &'static str)>,
}

/// One table of the document, or the lack of it.
pub(super) struct Section<'a, 'r> {
    reader: &'a mut Reader<'r>,
    name: &'static str,
    table: Option<&'r RawTable>,
    place: Range<usize>,
}

impl<'r> Reader<'r> {
    /// Begins to read `raw`.
    pub(super) fn new(raw: &'r RawSpec) -> Self {
        Self {
            raw,
            faults: Vec::new(),
            known: Vec::new(),
            missing: Vec::new(),
            shapes: Vec::new(),
            required: Vec::new(),
        }
    }

    /// The keys before the first section.
    pub(super) fn root(&mut self) -> Section<'_, 'r> {
        let table = Some(self.raw.root());
        self.open("", table, 0..0)
    }

    /// Section `name`; it need not have been written.
    pub(super) fn section(&mut self, name: &'static str) -> Section<'_, 'r> {
        match self.raw.root().get(name) {
            // At the end of the text, where it would be added.
            None => self.open(name, None, usize::MAX..usize::MAX),
            Some(value) => self.element(name, value),
        }
    }

    /// One `value` that must be a table, as a section called `name`.
    pub(super) fn element(&mut self, name: &'static str, value: &'r RawValue) -> Section<'_, 'r> {
        let table = value.as_table();
        if table.is_none() {
            let fault = Fault::error(
                FaultCode::WrongType,
                value.span.clone(),
                format!("`{name}` is {}", value.in_words()),
            )
            .label(format!("must be a section, [{name}]"));
            self.faults.push(fault);
        }
        self.open(name, table, value.span.clone())
    }

    /// Section `name`, as if it were not written: registers its keys.
    pub(super) fn absent(&mut self, name: &'static str) -> Section<'_, 'r> {
        self.open(name, None, usize::MAX..usize::MAX)
    }

    /// Section `name`, whose keys the caller checks; `None` if it was not written.
    pub(super) fn free(&mut self, name: &'static str) -> Option<&'r RawValue> {
        let value = self.raw.root().get(name);
        if let Some(value) = value {
            let _ = self.element(name, value);
        }
        if let Some(known_section) = self.known.last_mut().filter(|known| known.section == name) {
            known_section.table = None;
        } else {
            self.known.push(Known { section: name, keys: Vec::new(), table: None });
        }
        value
    }

    fn open(
        &mut self,
        name: &'static str,
        table: Option<&'r RawTable>,
        place: Range<usize>,
    ) -> Section<'_, 'r> {
        self.known.push(Known { section: name, keys: Vec::new(), table });
        Section { reader: self, name, table, place }
    }

    /// The shape of each key taken so far, by section and key; of a key taken twice the later shape holds.
    pub(super) fn shapes(&self) -> impl Iterator<Item = (&'static str, &'static str, &ValueShape)> {
        self.shapes.iter().map(|(section, key, shape)| (*section, *key, shape))
    }

    /// The keys that are required, by section.
    pub(super) fn required(&self) -> impl Iterator<Item = (&'static str, &'static str)> {
        self.required.iter().copied()
    }

    /// Every section and key taken so far.
    #[cfg(test)]
    pub(super) fn keys_taken(&self) -> impl Iterator<Item = (&'static str, &'static str)> {
        self.known.iter().flat_map(|known| known.keys.iter().map(|key| (known.section, *key)))
    }

    /// Adds a fault for each key and section that was never taken, and returns all faults.
    pub(super) fn finish(mut self) -> Vec<Fault> {
        // A misspelt key is reported as such, and not as missing too.
        let missing = self.missing.into_iter().filter_map(|missing| missing.but_for(&self.known));
        self.faults.extend(missing.map(Missing::fault));
        self.faults.extend(unknown::faults(&self.known));
        self.faults
    }
}

impl<'r> Section<'_, 'r> {
    /// Whether the section was written at all.
    pub(super) fn is_written(&self) -> bool {
        self.table.is_some()
    }

    /// Whether `key` was written, whatever its value.
    pub(super) fn contains(&self, key: &str) -> bool {
        self.table.is_some_and(|table| table.get(key).is_some())
    }

    /// The span of the section's header.
    pub(super) fn place(&self) -> Range<usize> {
        self.place.clone()
    }

    /// The span of the value of `key`, or of the section's header if the key was not written.
    pub(super) fn place_of(&self, key: &str) -> Range<usize> {
        self.table.and_then(|table| table.get(key)).map_or(self.place(), |value| value.span.clone())
    }

    /// The written keys but `left_out`.
    pub(super) fn other_keys(&self, left_out: &str) -> Vec<&'r str> {
        let entries = self.table.into_iter().flat_map(|table| &table.0);
        entries.map(|entry| entry.key.as_str()).filter(|key| *key != left_out).collect()
    }

    /// Adds a fault.
    pub(super) fn report(&mut self, fault: Fault) {
        self.reader.faults.push(fault);
    }

    /// Refuses the value of `key`: the finding and the allowed values.
    pub(super) fn refuse(
        &mut self,
        code: FaultCode,
        key: &str,
        problem: impl Into<String>,
        allowed: impl Into<String>,
    ) {
        self.report(Fault::error(code, self.place_of(key), problem).label(allowed));
    }

    /// A length within `allowed`, or `default`, mm.
    pub(super) fn length(&mut self, key: &'static str, allowed: Allowed, default: f64) -> Length {
        self.quantity(key, allowed).unwrap_or(Length(default))
    }

    /// Adds one fault if some of `required`, pairs of a key and an example value, were not written.
    pub(super) fn require(&mut self, required: &[(&'static str, &'static str)]) {
        self.require_if(true, required);
    }

    /// Requires the keys where the section is needed; else they are only registered as required in it.
    pub(super) fn require_if(&mut self, is_needed: bool, required: &[(&'static str, &'static str)]) {
        self.reader.required.extend(required.iter().map(|(key, _)| (self.name, *key)));
        let keys: Vec<_> = required.iter().filter(|(key, _)| !self.contains(key)).copied().collect();
        // A value in the section's place is reported already.
        let is_other = self.table.is_none() && self.reader.raw.root().get(self.name).is_some();
        if is_needed && !is_other && !keys.is_empty() {
            let (section, is_written, place) = (self.name, self.table.is_some(), self.place());
            self.reader.missing.push(Missing { section, is_written, place, keys });
        }
    }

    /// Narrows the allowed values of `key`.
    pub(super) fn narrow(&mut self, key: &'static str, shape: ValueShape) {
        self.reader.shapes.push((self.name, key, shape));
    }

    /// Allows `word` for `key`, which was taken, as well.
    pub(super) fn or_word(&mut self, key: &'static str, word: &'static str) {
        let name = self.name;
        let own_shape =
            self.reader.shapes.iter_mut().rfind(|(section, other, _)| (*section, *other) == (name, key));
        match own_shape {
            Some((_, _, ValueShape::Or(_, words))) => words.push(word),
            Some((_, _, shape)) => *shape = ValueShape::Or(Box::new(shape.clone()), vec![word]),
            None => {}
        }
    }

    /// The value of `key`, which takes values of `shape`; registers the key.
    pub(super) fn take(&mut self, key: &'static str, shape: ValueShape) -> Option<&'r RawValue> {
        self.reader.shapes.push((self.name, key, shape));
        if let Some(known_section) = self.reader.known.iter_mut().rfind(|known| known.section == self.name) {
            known_section.keys.push(key);
        }
        self.table?.get(key)
    }

    /// A plain number within `allowed`; `None` if it is absent or faulty.
    pub(super) fn number(&mut self, key: &'static str, allowed: Allowed) -> Option<f64> {
        let value = self.take(key, ValueShape::Number(allowed))?;
        let RawKind::Number(number) = &value.kind else {
            let fault = self.wrong_type(key, value, "must be a plain number, without quotes and unit");
            let quoted_number = plain(value).filter(|number| allowed.contains(*number));
            self.report(match quoted_number {
                Some(number) => fault.help(format!("write {key} = {number}")),
                None => fault,
            });
            return None;
        };
        if allowed.contains(number.value) {
            return Some(number.value);
        }
        self.refuse(
            FaultCode::OutOfRange,
            key,
            format!("`{key}` is {}", number.shortened_text()),
            allowed.in_words(""),
        );
        None
    }

    /// A whole number from `low` to `high`; `None` if it is absent or faulty.
    pub(super) fn count(&mut self, key: &'static str, low: u32, high: u32) -> Option<u32> {
        let value = self.take(key, ValueShape::Count(low, high))?;
        let number = match &value.kind {
            RawKind::Number(number) if number.is_integer => number,
            _ => return self.refuse_type(key, value, "must be a whole number, without quotes and unit"),
        };
        let count = number.whole.and_then(|whole| u32::try_from(whole).ok());
        if let Some(count) = count.filter(|count| (low..=high).contains(count)) {
            return Some(count);
        }
        let allowed = format!("must be from {low} to {high}");
        self.refuse(FaultCode::OutOfRange, key, format!("`{key}` is {}", number.shortened_text()), allowed);
        None
    }

    /// `true` or `false`; `None` if it is absent or faulty.
    pub(super) fn truth(&mut self, key: &'static str) -> Option<bool> {
        let value = self.take(key, ValueShape::Truth)?;
        match value.kind {
            RawKind::Truth(found) => Some(found),
            _ => self.refuse_type(key, value, "must be true or false, without quotes"),
        }
    }

    fn wrong_type(&self, key: &str, value: &RawValue, label: &str) -> Fault {
        let section = if self.name.is_empty() { String::new() } else { format!(" in {}", header(self.name)) };
        let message = format!("`{key}`{section} is {}", value.in_words());
        Fault::error(FaultCode::WrongType, value.span.clone(), message).label(label)
    }

    /// Reports [`Self::wrong_type`]; always `None`.
    fn refuse_type<T>(&mut self, key: &str, value: &RawValue, label: &str) -> Option<T> {
        let fault = self.wrong_type(key, value, label);
        self.report(fault);
        None
    }
}

/// The number that a text expresses: 0.5 of "0.5" and of "50 %".
fn plain(value: &RawValue) -> Option<f64> {
    let RawKind::Text(text) = &value.kind else { return None };
    text.trim().parse().ok().or_else(|| Percent::parse(text).ok().map(Percent::ratio))
}

#[cfg(test)]
mod tests;
