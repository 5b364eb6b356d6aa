//! A spec's text with other values for its star, everything else as it was, comments included.

use toml_edit::{DocumentMut, Item, TableLike, TomlError, Value};

use crate::fault::Fault;
use crate::faults::Faults;
use crate::key::KeyPath;
use crate::model::{Spec, StarSpec};
use crate::reading::{Reading, read};
use crate::source::Source;
use crate::units::{Angle, Length};
use crate::{FaultCode, key};
use std::ops::Range;

/// The values of `[star]` that a search may change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StarEdit {
    /// Number of points, 3 to 64.
    pub points: u32,
    /// Tube width W.
    pub tube_width: Length,
    /// Tip angle phi_i0.
    pub tip_angle: Angle,
    /// Tip radius R_i.
    pub tip_radius: Length,
    /// Corner radius R_e.
    pub corner_radius: Length,
}

impl StarEdit {
    /// The values that `star` has already.
    pub fn new(star: &StarSpec) -> Self {
        let StarSpec { points, tube_width, tip_angle, tip_radius, corner_radius, .. } = *star;
        Self { points, tube_width, tip_angle, tip_radius, corner_radius }
    }

    /// Keys and values as TOML. `{}` prints the shortest decimals that read back to the same number.
    fn entries(&self) -> [(KeyPath, String); 5] {
        [
            (key::star::POINTS, self.points.to_string()),
            (key::star::TUBE_WIDTH, in_millimetres(self.tube_width)),
            (key::star::TIP_ANGLE, format!("\"{} deg\"", self.tip_angle.0)),
            (key::star::TIP_RADIUS, in_millimetres(self.tip_radius)),
            (key::star::CORNER_RADIUS, in_millimetres(self.corner_radius)),
        ]
    }
}

/// `length` as the text of a value, in mm.
fn in_millimetres(length: Length) -> String {
    format!("\"{} mm\"", length.0)
}

/// The text of `source` with the values of `star` set in `[star]`, however that section is written: a table, dotted
/// keys (which then all spell `star` as the first does), an inline table, quoted keys. Lines end with LF. The result has
/// been read back: its first star has exactly these values.
///
/// # Errors
/// If `source` is refused, if a `[[stack.star]]` decides one of the keys, the inner radius or the pitch for a star, or if the result is
/// refused (five points may have an inlet at tip 5, four may not).
pub fn with_star(source: &Source, star: &StarEdit) -> Result<String, Faults> {
    let Reading { raw, spec, .. } = read(source)?;
    let entries = star.entries();
    let searched = entries.iter().map(|(key, _)| *key).chain([key::star::INNER_RADIUS, key::stack::PITCH]);
    let has_own = |(key, star): &(KeyPath, usize)| raw.span_of(key.of_star(*star)) != raw.span_of(*key);
    let own_keys =
        searched.flat_map(|key| (1..=spec.stars.len()).map(move |star| (key, star))).filter(has_own);
    let star_faults = own_keys.map(|(key, star)| {
        let message = format!("star {star} has its own `{}`", key.key());
        Fault::error(FaultCode::OwnValue, raw.span_of(key.of_star(star)), message)
            .label(format!("a value in [{}] does not reach it", key.section()))
            .help(format!("move it into [{}]", key.section()))
    });
    let star_faults: Vec<Fault> = star_faults.collect();
    if !star_faults.is_empty() {
        return Err(Faults::new(source, star_faults));
    }
    let (text, spec_read) = read_back(source, with_values(source, &entries)?)?;
    if spec_read.stars.first().map(StarEdit::new) == Some(*star) {
        Ok(text)
    } else {
        Err(cannot_edit(source, raw.span_of(key::star::POINTS), "the star", "must take new values"))
    }
}

/// The text of `source` with `value`, TOML of its own ("3", "\"40 mm\""), set at `key`, which is no key of a single star. Lines
/// end with LF. The result has been read back.
///
/// # Errors
/// If `source`, the value or the result is refused.
pub fn with_value(source: &Source, key: KeyPath, value: &str) -> Result<String, Faults> {
    with_changes(source, &[(key, Some(value))])
}

/// `source` with several values, of which only all together need be valid; `None` takes a key away, so that its default holds.
///
/// # Errors
/// If `source`, a value or the result is refused.
pub fn with_changes(source: &Source, values: &[(KeyPath, Option<&str>)]) -> Result<String, Faults> {
    let _ = read(source)?;
    read_back(source, edited(source, values)?).map(|(text, _)| text)
}

/// `text`, the edited text of `source`, if it is valid.
fn read_back(source: &Source, text: String) -> Result<(String, Spec), Faults> {
    let edited = Source::new(format!("{}, edited", source.name), text);
    read(&edited).map(|reading| (edited.text, reading.spec))
}

fn cannot_edit(source: &Source, place: Range<usize>, subject: &str, label: &str) -> Faults {
    let fault = Fault::error(FaultCode::Edit, place, format!("{subject} cannot be edited here"));
    Faults::new(source, vec![fault.label(label).help("write its section with one key a line")])
}

/// The text of `source`, a valid spec, with every key set to its value, TOML of its own. Lines end with LF. It has not been read
/// back: the values may not go together.
///
/// # Errors
/// If a value is not TOML, or the section of a key cannot be edited.
pub fn with_values(source: &Source, values: &[(KeyPath, String)]) -> Result<String, Faults> {
    let values: Vec<_> = values.iter().map(|(key, value)| (*key, Some(value.as_str()))).collect();
    edited(source, &values)
}

/// The text of `source` with `values`, each TOML of its own; `None` takes a key away, and its section with it if that is empty then.
/// Neither text need be a valid spec.
///
/// # Errors
/// If `source` or a value is not TOML, or the section of a key cannot be edited.
pub fn edited(source: &Source, values: &[(KeyPath, Option<&str>)]) -> Result<String, Faults> {
    let mut tree = document(source)?;
    // One of the two size keys replaces the other, unless both are set here.
    let set_sizes = values.iter().filter(|(_, value)| value.is_some());
    let twins = set_sizes.filter_map(|(key, _)| key.twin());
    let replaced = twins.filter(|twin| !values.iter().any(|(key, _)| key == twin)).map(|twin| (twin, None));
    for (key, value) in replaced.chain(values.iter().copied()) {
        let Some(value) = value else {
            let root = tree.as_table_mut();
            let section: Option<&mut dyn TableLike> = match key.section() {
                "" => Some(root),
                name => root.get_mut(name).and_then(Item::as_table_like_mut),
            };
            let is_emptied =
                section.is_some_and(|section| section.remove(key.key()).is_some() && section.is_empty());
            if is_emptied && !key.section().is_empty() {
                let _ = tree.remove(key.section());
            }
            continue;
        };
        let value: Value = value.parse().map_err(|error| syntax(source, &error))?;
        if key.section().is_empty() {
            set(tree.as_table_mut(), false, key.key(), value);
            continue;
        }
        let item = tree.entry(key.section()).or_insert_with(toml_edit::table);
        let inline = item.is_inline_table();
        let Some(section) = item.as_table_like_mut() else {
            // Not in a valid spec.
            return Err(cannot_edit(source, 0..0, &format!("`{key}`"), "must take a new value"));
        };
        set(section, inline, key.key(), value);
    }
    Ok(tree.to_string())
}

/// The text of `source` with `value`, TOML of its own, at `key` of the process `name`, which is added if it is new; `None` takes the key
/// away. The section of the process stays, because seams may name it. Neither text need be a valid spec.
///
/// # Errors
/// If `source` or the value is not TOML, or the section of the process cannot be edited.
pub fn with_process(
    source: &Source,
    name: &str,
    key: KeyPath,
    value: Option<&str>,
) -> Result<String, Faults> {
    let mut tree = document(source)?;
    let value: Option<Value> =
        value.map(str::parse).transpose().map_err(|error: TomlError| syntax(source, &error))?;
    let unnamed_section = || {
        let mut table = toml_edit::Table::new();
        table.set_implicit(true);
        Item::Table(table)
    };
    let processes = tree.entry(key.section()).or_insert_with(unnamed_section).as_table_like_mut();
    let process = processes.map(|table| table.entry(name).or_insert_with(toml_edit::table));
    let Some(process) = process else {
        return Err(cannot_edit(source, 0..0, &format!("`{key}`"), "must take a new value"));
    };
    let inline = process.is_inline_table();
    match (process.as_table_like_mut(), value) {
        (Some(section), Some(value)) => set(section, inline, key.key(), value),
        (Some(section), None) => drop(section.remove(key.key())),
        (None, _) => {
            return Err(cannot_edit(source, 0..0, &format!("`process.{name}`"), "must take a new value"));
        }
    }
    Ok(tree.to_string())
}

/// The text of `source` with other comments behind values. `renewed` takes section, key and comment, "" for none, and returns the new
/// comment. Comments on lines of their own, and those within inline tables, stay.
///
/// # Errors
/// If `source` is not TOML.
pub fn with_comments(
    source: &Source,
    mut renewed: impl FnMut(&str, &str, &str) -> String,
) -> Result<String, Faults> {
    let mut tree = document(source)?;
    for (section, item) in tree.iter_mut() {
        let Some(table) = item.as_table_mut() else { continue };
        for (key, item) in table.iter_mut() {
            let Some(value) = item.as_value_mut() else { continue };
            let suffix = value.decor().suffix().and_then(toml_edit::RawString::as_str).unwrap_or_default();
            let (blanks, comment) = suffix.split_once('#').unwrap_or(("  ", ""));
            let new = renewed(section.get(), key.get(), comment.trim());
            if new != comment.trim() {
                let suffix = if new.is_empty() { String::new() } else { format!("{blanks}# {new}") };
                value.decor_mut().set_suffix(suffix);
            }
        }
    }
    Ok(tree.to_string())
}

/// The text of `source` as TOML with its layout.
pub(crate) fn document(source: &Source) -> Result<DocumentMut, Faults> {
    source.text.parse().map_err(|error| syntax(source, &error))
}

/// The fault of `source` where TOML cannot be read.
fn syntax(source: &Source, error: &TomlError) -> Faults {
    let fault = Fault::error(FaultCode::Syntax, error.span().unwrap_or(0..0), error.message());
    Faults::new(source, vec![fault])
}

/// Sets `key`; the blanks and comments around an old value stay.
pub(crate) fn set(section: &mut dyn TableLike, inline: bool, key: &str, mut value: Value) {
    if let Some(old) = section.get_mut(key).and_then(Item::as_value_mut) {
        *value.decor_mut() = old.decor().clone();
        *old = value;
        return;
    }
    // The blank before a `}` belongs to the last value: it goes with the end.
    let last = section.iter_mut().last().filter(|_| inline);
    if let Some(last) = last.and_then(|(_, item)| item.as_value_mut())
        && let Some(end) = last.decor().suffix().cloned()
    {
        last.decor_mut().set_suffix("");
        value.decor_mut().set_suffix(end);
    }
    let _ = section.insert(key, Item::Value(value));
}

#[cfg(test)]
mod tests;
