//! Every value of a spec as a person wrote it, or its default: for reports.
//!
//! Keys, defaults and their meaning are those of the starter, which a test holds to the reader.

use serde::Serialize;

use crate::KeyPath;
use crate::raw::RawSpec;
use crate::schema::INSTEAD;
use crate::source::Source;
use crate::starter::TEMPLATE;
use crate::value::{RawKind, RawTable, RawValue};

/// One key with its value.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Setting {
    /// The section that holds it, without brackets; "" before the first.
    pub section: String,
    /// The key.
    pub key: String,
    /// Value of the key, without quotes; `None` where it is absent and has no default.
    pub value: Option<String>,
    /// Whether it was written.
    pub given: bool,
    /// Meaning of the key, in a few words; often empty.
    pub meaning: String,
}

impl Setting {
    /// Whether both are of one key of one section.
    pub fn is_same_key(&self, other: &Self) -> bool {
        (&self.section, &self.key) == (&other.section, &other.key)
    }
}

/// The settings of `source`, which must be a valid spec: all keys in the starter's order, then those of single stars and of processes.
pub fn settings(source: &Source) -> Vec<Setting> {
    settings_of(source, known_keys(TEMPLATE))
}

/// [`settings`] for a form, with the keys that exclude one of the starter's: those of `[drawing]`, and `object_radius`.
pub fn form_settings(source: &Source) -> Vec<Setting> {
    settings_of(source, known_keys(TEMPLATE).chain(known_keys(INSTEAD)))
}

/// [`settings`] of a spec with a drawing: with `[drawing]`, and without the defaults of keys that only stars have.
pub fn drawing_settings(source: &Source) -> Vec<Setting> {
    form_settings(source).into_iter().filter(|setting| setting.given || !is_of_stars(setting)).collect()
}

/// Whether only stars have the key.
fn is_of_stars(setting: &Setting) -> bool {
    match (setting.section.as_str(), setting.key.as_str()) {
        ("star" | "stack" | "frame" | "mask", _) | ("seal", "hole_allowance") | ("machine", "program") => {
            true
        }
        ("inlet", key) => key != "tube_diameter",
        ("load", key) => key != "pressure",
        _ => false,
    }
}

/// Whether `key` has a default value.
pub fn has_default(key: KeyPath) -> bool {
    known_keys(TEMPLATE)
        .chain(known_keys(INSTEAD))
        .any(|own| (own.section, own.key) == (key.section(), key.key()) && own.default.is_some())
}

fn settings_of(source: &Source, keys: impl Iterator<Item = KnownKey>) -> Vec<Setting> {
    let (raw, _) = RawSpec::parse(&source.text);
    let mut list: Vec<Setting> = keys
        .map(|KnownKey { section, key, default, meaning }| {
            let own_value = written_value(&raw, section, key);
            let is_written = own_value.is_some();
            let value = own_value.or_else(|| default.map(str::to_owned));
            Setting {
                section: section.to_owned(),
                key: key.to_owned(),
                value,
                given: is_written,
                meaning: meaning.to_owned(),
            }
        })
        .filter(|setting| setting.key != "schema")
        .collect();
    for star in raw.overrides().iter().filter_map(RawValue::as_table) {
        let section = format!("star {}", star.get("index").map(plain_text).unwrap_or_default());
        list.extend(section_settings(star, section).filter(|setting| setting.key != "index"));
    }
    let processes = raw.root().get("process").and_then(RawValue::as_table);
    for entry in processes.into_iter().flat_map(|table| &table.0) {
        let table = entry.value.as_table();
        list.extend(
            table.into_iter().flat_map(|table| section_settings(table, format!("process.{}", entry.key))),
        );
    }
    list
}

/// The value of `key` in the text; `None` where it does not write it.
fn written_value(raw: &RawSpec, section: &str, key: &str) -> Option<String> {
    let table = if section.is_empty() { Some(raw.root()) } else { raw.root().get(section)?.as_table() };
    Some(plain_text(table?.get(key)?))
}

/// The settings that `table` writes, as those of `section`.
fn section_settings(table: &RawTable, section: String) -> impl Iterator<Item = Setting> {
    table.0.iter().map(move |entry| Setting {
        section: section.clone(),
        key: entry.key.clone(),
        value: Some(plain_text(&entry.value)),
        given: true,
        meaning: String::new(),
    })
}

/// A value as people write it, without quotes.
fn plain_text(value: &RawValue) -> String {
    match &value.kind {
        RawKind::Text(text) => text.clone(),
        RawKind::Number(number) => number.shortened_text(),
        RawKind::Truth(truth) => truth.to_string(),
        RawKind::List(list) => list.iter().map(plain_text).collect::<Vec<_>>().join(", "),
        RawKind::Table(table) => {
            let entries = table.0.iter().map(|entry| format!("{}: {}", entry.key, plain_text(&entry.value)));
            entries.collect::<Vec<_>>().join("; ")
        }
        RawKind::Date => String::new(),
    }
}

/// A key of the starter.
struct KnownKey {
    section: &'static str,
    key: &'static str,
    default: Option<&'static str>,
    meaning: &'static str,
}

/// The keys in `notes`, written as the starter, but those of single stars and of processes.
fn known_keys(notes: &'static str) -> impl Iterator<Item = KnownKey> {
    let mut section = "";
    notes.lines().filter_map(move |line| {
        let (line, has_default) = match (line.strip_prefix("## "), line.strip_prefix("# ")) {
            (Some(absent), _) => (absent, false),
            (_, Some(default)) => (default, true),
            _ => (line, false),
        };
        if let Some(header) = line.strip_prefix('[') {
            section = header.trim_start_matches('[').split(']').next().unwrap_or_default();
            return None;
        }
        let (key, rest) = line.split_once(" = ")?;
        let is_key = key.bytes().all(|byte| byte.is_ascii_lowercase() || byte == b'_');
        if !is_key || section == "stack.star" || section.starts_with("process.") {
            return None;
        }
        let (value, meaning) = rest.split_once("  #").unwrap_or((rest, ""));
        let default = has_default.then(|| value.trim().trim_matches('"'));
        Some(KnownKey { section, key, default, meaning: meaning.trim() })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::key;
    use crate::reading::read;
    use crate::starter::starter;

    const MARKED: &str = "schema = 1\nname = \"x\"\nseal.band = \"3 mm\"\n[star]\npoints = 5\ninner_radius = \"50 mm\"\n\
        tube_width = '30 mm'\ntip_angle = \"30 deg\"\n[stack]\ncount = 2\n[[stack.star]]\nindex = 2\ninner_radius = \"4 cm\"\n";

    fn setting_of(text: &str, section: &str, key: &str) -> Setting {
        let list = settings(&Source::new("x", text));
        let matching =
            list.iter().filter(|setting| (setting.section.as_str(), setting.key.as_str()) == (section, key));
        let matching: Vec<&Setting> = matching.collect();
        assert_eq!(matching.len(), 1, "{section}.{key}");
        matching[0].clone()
    }

    #[test]
    fn what_was_written_stands_beside_the_defaults() {
        let setting = |section, key| {
            let Setting { value, given: is_written, .. } = setting_of(MARKED, section, key);
            (value.unwrap_or_default(), is_written)
        };
        let expected = |value: &str, given| (value.to_owned(), given);
        assert_eq!(setting("star", "tube_width"), expected("30 mm", true));
        assert_eq!(setting("seal", "band"), expected("3 mm", true));
        assert_eq!(setting("seal", "speed"), expected("0.1 mm/s", false));
        assert_eq!(setting("stack", "count"), expected("2", true));
        assert_eq!(setting("star 2", "inner_radius"), expected("4 cm", true));
        assert_eq!(setting_of(MARKED, "load", "pressure").value, None);
        assert!(setting_of(MARKED, "seal", "band").meaning.contains("width of the sealed strip"));
    }

    #[test]
    fn a_form_has_every_key_once() {
        let text = MARKED.replace("[stack]", "[load]\nobject_radius = \"30 mm\"\n[stack]");
        let list = form_settings(&Source::new("x", text));
        let named = |key: &key::KeyPath| {
            list.iter()
                .filter(|one| (one.section.as_str(), one.key.as_str()) == (key.section(), key.key()))
                .count()
        };
        // A form has no field for the version and for the list of single stars.
        // A process has a name of the user's.
        let missing: Vec<_> = key::ALL
            .iter()
            .filter(|key| key.section() != "process" && named(key) != 1)
            .map(ToString::to_string)
            .collect();
        assert_eq!(missing, ["schema", "stack.star"]);
        let join = list.iter().find(|one| one.key == "join").expect("a drawing's key");
        assert_eq!((join.value.as_deref(), join.given), (Some("0.02 mm"), false));
        let radius = list.iter().find(|one| one.key == "object_radius").expect("its own key");
        assert_eq!((radius.value.as_deref(), radius.given), (Some("30 mm"), true));
    }

    #[test]
    fn a_drawing_has_its_own_keys_and_none_of_stars() {
        let text = "schema = 1\nname = \"x\"\n[drawing]\nfile = \"a.svg\"\n[drawing.layers]\nair = [\"a\"]\n[load]\npressure = \"5 kPa\"\n";
        let list = drawing_settings(&Source::new("x", text));
        let has_key = |section: &str, key: &str| {
            list.iter().any(|one| (one.section.as_str(), one.key.as_str()) == (section, key))
        };
        for (section, key) in [
            ("drawing", "file"),
            ("drawing", "layers"),
            ("load", "pressure"),
            ("seal", "band"),
            ("inlet", "tube_diameter"),
        ] {
            assert!(has_key(section, key), "[{section}] {key}");
        }
        let layers = list.iter().find(|one| one.key == "layers" && one.section == "drawing");
        assert_eq!(layers.and_then(|layers| layers.value.as_deref()), Some("air: a"));
        for (section, key) in [
            ("star", "tip_radius"),
            ("stack", "count"),
            ("frame", "posts"),
            ("mask", "border"),
            ("inlet", "tip"),
            ("machine", "program"),
        ] {
            assert!(!has_key(section, key), "[{section}] {key}");
        }
    }

    /// A default that is written explicitly changes nothing: the settings show the reader's values.
    #[test]
    fn the_defaults_are_the_readers() {
        let bare = starter("x").expect("a name");
        let mut text = String::new();
        let list = settings(&Source::new("x", bare.clone()));
        let mut section = String::new();
        for setting in &list {
            let Some(value) = &setting.value else { continue };
            if setting.section != section {
                section.clone_from(&setting.section);
                text.extend(["[", &section, "]\n"]);
            }
            let plain =
                value == "true" || value == "false" || value.starts_with('[') || value.parse::<f64>().is_ok();
            let quote = if plain { "" } else { "\"" };
            text.extend([setting.key.as_ref(), " = ", quote, value, quote, "\n"]);
        }
        let spec =
            |text: String| read(&Source::new("x", text)).unwrap_or_else(|faults| panic!("{faults}")).spec;
        assert_eq!(spec(format!("schema = 1\n{text}")), spec(bare));
        assert!(list.len() > 40, "{}", list.len());
    }
}
