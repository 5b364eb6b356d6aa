//! Unknown keys and sections, and the ones that their writer may have meant; missing keys.

use crate::FaultCode;
use crate::fault::{Fault, NewSpec, quoted};
use crate::message::header;
use crate::product::ProductKind;
use crate::units::{Length, Quantity};
use crate::value::{RawEntry, RawKind, RawTable, RawValue};
use geom::order::sort_by_key;
use std::ops::Range;

/// A section that was read: its keys and its content in the text.
pub(super) struct Known<'r> {
    /// Name of the section; "" for the keys before the first section.
    pub(super) section: &'static str,
    /// The keys that were taken.
    pub(super) keys: Vec<&'static str>,
    /// The table in the text; `None` if it was not written.
    pub(super) table: Option<&'r RawTable>,
}

/// Words that people write for a key.
const MEANT: [(&str, &str); 3] =
    [("weight", "mass"), ("payload", "mass"), ("elastic_modulus", "young_modulus")];

/// Longest word compared with the registered keys, in bytes; the comparison's cost grows with its square.
const COMPARED: usize = 40;

/// Most unknown keys for which similar ones are looked up.
const HINTED: usize = 200;

/// A fault for each key and section of the text that is not in `sections`, in the order of the text; the first have a hint.
pub(super) fn faults(sections: &[Known<'_>]) -> Vec<Fault> {
    let entries = sections.iter().flat_map(|one| {
        let entries = one.table.into_iter().flat_map(|table| &table.0);
        entries.map(move |entry| (one, entry))
    });
    let is_unknown = |(one, entry): &(&Known<'_>, &RawEntry)| {
        let is_section = one.section.is_empty() && section_names(sections).any(|name| name == entry.key);
        !is_section && !one.keys.contains(&entry.key.as_str())
    };
    let mut unknown: Vec<_> = entries.filter(is_unknown).collect();
    sort_by_key(&mut unknown, |(_, entry)| entry.key_span.start);
    let numbered = unknown.into_iter().enumerate();
    numbered.map(|(i, (section, entry))| fault(section, entry, sections, i < HINTED)).collect()
}

/// The fault of the unknown `entry` of `section`, with a hint if `is_hinted`.
fn fault(section: &Known<'_>, entry: &RawEntry, sections: &[Known<'_>], is_hinted: bool) -> Fault {
    let (word, place) = (entry.key.as_str(), entry.key_span.clone());
    let table = entry.value.as_table().filter(|_| section.section.is_empty());
    let fault = if table.is_some() {
        Fault::error(FaultCode::UnknownSection, place, format!("unknown section [{}]", bare(word)))
            .label("no section has this name")
    } else {
        let home = if section.section.is_empty() {
            String::new()
        } else {
            format!(" in {}", header(section.section))
        };
        Fault::error(FaultCode::UnknownKey, place, format!("unknown key {}{home}", quoted(word)))
            .label("no key has this name here")
    };
    if !is_hinted {
        return fault;
    }
    fault.help(match table {
        Some(table) => section_hint(word, table, sections),
        None => diameter_hint(word, &entry.value, section)
            .or_else(|| star_size_hint(word, &entry.value, section))
            .unwrap_or_else(|| key_hint(word, section, sections)),
    })
}

/// The word of `candidates` that differs from `word` by few enough slips of the keyboard.
pub fn nearest<'c>(word: &str, candidates: impl IntoIterator<Item = &'c str>) -> Option<&'c str> {
    if word.len() > COMPARED {
        return None;
    }
    let lower = word.to_lowercase().replace('-', "_");
    candidates
        .into_iter()
        .map(|candidate| (strsim::damerau_levenshtein(&lower, candidate), candidate))
        .filter(|(slips, candidate)| *slips <= candidate.len().max(3) / 3)
        .min_by_key(|(slips, _)| *slips)
        .map(|(_, candidate)| candidate)
}

fn bare(word: &str) -> String {
    quoted(word).trim_matches('`').to_owned()
}

/// The sections of the first level.
fn section_names<'k>(sections: &'k [Known<'_>]) -> impl Iterator<Item = &'static str> + 'k {
    sections.iter().map(|one| one.section).filter(|name| !name.is_empty() && !name.contains('.'))
}

/// The hint for an unknown section: of the similar names first one that has all keys of `table`.
fn section_hint(word: &str, table: &RawTable, sections: &[Known<'_>]) -> String {
    let names: Vec<&str> = section_names(sections).collect();
    let has_all = |name: &&str| {
        let section = sections.iter().find(|one| one.section == *name);
        section.is_some_and(|one| table.0.iter().all(|entry| one.keys.contains(&entry.key.as_str())))
    };
    match nearest(word, names.iter().copied().filter(has_all))
        .or_else(|| nearest(word, names.iter().copied()))
    {
        Some(near) => format!("did you mean [{near}]?"),
        None => {
            format!(
                "sections are {}",
                names.iter().map(|name| format!("[{name}]")).collect::<Vec<_>>().join(", ")
            )
        }
    }
}

/// The radius that goes with a diameter: `inner_radius` for `inner_diameter`.
pub(super) fn radius_of(word: &str) -> Option<String> {
    Some(format!("{}radius", word.strip_suffix("diameter")?))
}

/// The hint for a diameter where the key is a radius: the radius, with half of the value.
fn diameter_hint(word: &str, value: &RawValue, section: &Known<'_>) -> Option<String> {
    let radius = radius_of(word)?;
    let _ = section.keys.iter().find(|key| **key == radius)?;
    let half = match &value.kind {
        RawKind::Text(text) => Length::parse(text).ok().map(|length| Length(0.5 * length.0)),
        _ => None,
    };
    Some(match half {
        Some(half) => format!("write {radius} = \"{half}\", half of the diameter"),
        None => format!("write `{radius}`, half of the diameter"),
    })
}

/// The hint for the hole or the outer size of a star, which are no keys: the key that decides them.
fn star_size_hint(word: &str, value: &RawValue, section: &Known<'_>) -> Option<String> {
    // A word is a place and a measure, as in `hole_diameter`. Of a hole the radius is given with the flap added; the outer size
    // follows from several keys.
    let _ = section.keys.iter().find(|key| **key == "inner_radius")?;
    let (place, part) = match word.split_once('_')? {
        (place, "diameter") => (place, 0.5),
        (place, "radius") => (place, 1.0),
        _ => return None,
    };
    match place {
        "hole" | "opening" => {
            let flap = "the hole is narrower than inner_radius by the band and its `hole_allowance`";
            let radius = match &value.kind {
                RawKind::Text(text) => Length::parse(text).ok(),
                RawKind::Number(_)
                | RawKind::Truth(_)
                | RawKind::Date
                | RawKind::List(_)
                | RawKind::Table(_) => None,
            };
            let radius = radius.map(|length| Length(part * length.0 + DEFAULT_FLAP));
            Some(radius.map_or_else(
                || format!("write `inner_radius`: {flap}, 3 mm by default"),
                |radius| format!("write inner_radius = \"{radius}\": {flap}, 3 mm by default"),
            ))
        }
        "outer" => Some(
            "no key sets the outer size: it follows from inner_radius, points, tube_width and tip_angle"
                .to_owned(),
        ),
        _ => None,
    }
}

/// Width of the band and its allowance at the hole by default, mm.
const DEFAULT_FLAP: f64 = 3.0;

/// Whether `word` is `key` with a word before it.
fn ends_in_key(word: &str, key: &str) -> bool {
    word.strip_suffix(key).is_some_and(|beginning| beginning.ends_with('_'))
}

/// The hint for a key: a similar one in the section, the same one elsewhere, a similar one elsewhere, else all keys of the
/// section.
fn key_hint(word: &str, place: &Known<'_>, sections: &[Known<'_>]) -> String {
    let other_sections = sections.iter().filter(|one| one.section != place.section);
    if let Some((_, key)) = MEANT.iter().find(|(other, key)| *other == word && place.keys.contains(key)) {
        return format!("did you mean `{key}`?");
    }
    if let Some(section) = other_sections.clone().find(|one| one.keys.contains(&word)) {
        return format!("`{word}` belongs {}", home_in_words(section));
    }
    // A key with a word before it, `object_mass` for `mass`, is that key.
    let last = place.keys.iter().copied().find(|key| ends_in_key(word, key));
    if let Some(suggestion) = last.or_else(|| nearest(word, place.keys.iter().copied())) {
        return format!("did you mean `{suggestion}`?");
    }
    let mut other_sections = other_sections;
    let suggestions = other_sections
        .find_map(|one| nearest(word, one.keys.iter().copied()).map(|suggestions| (suggestions, one)));
    if let Some((suggestion, section)) = suggestions {
        return format!("did you mean `{suggestion}`, which belongs {}?", home_in_words(section));
    }
    format!(
        "keys here are {}",
        place.keys.iter().map(|key| format!("`{key}`")).collect::<Vec<_>>().join(", ")
    )
}

/// The place of a section's keys in words.
fn home_in_words(section: &Known<'_>) -> String {
    match section.section {
        "" => "before the first section".to_owned(),
        name => format!("in {}", header(name)),
    }
}

/// Required keys of one section that are not written.
pub(super) struct Missing {
    /// The section; "" for the keys before the first one.
    pub(super) section: &'static str,
    /// Whether the section itself is written.
    pub(super) is_written: bool,
    /// The span that the fault points to.
    pub(super) place: Range<usize>,
    /// Each key with an example of its value.
    pub(super) keys: Vec<(&'static str, &'static str)>,
}

/// The other product.
const DRAWING: &str = "or, for a drawing of your own:\n[drawing]\nfile = \"outline.svg\"\nlayers = { air = [\"chamber\"], port = [\"inlet\"] }";

impl Missing {
    /// These faults without the keys that are only misspelt: an unknown key of the section, or an unknown
    /// section, that is near, or a diameter; `None` if nothing is left.
    pub(super) fn but_for(mut self, sections: &[Known<'_>]) -> Option<Self> {
        if !self.is_written && has_misspelt(sections, "", self.section) {
            return None;
        }
        let section = self.section;
        self.keys.retain(|(key, _)| !has_misspelt(sections, section, key));
        (!self.keys.is_empty()).then_some(self)
    }

    /// The fault that reports the missing keys.
    pub(super) fn fault(self) -> Fault {
        let Self { section, is_written, place, keys } = self;
        let list = keys.iter().map(|(key, _)| format!("`{key}`")).collect::<Vec<_>>().join(", ");
        let lines = keys.iter().map(|(key, example)| format!("{key} = {example}")).collect::<Vec<_>>();
        let (message, help) = match (section, is_written) {
            ("", _) => (format!("the file has no {list}"), lines.join("\n")),
            (name, true) => (format!("{} has no {list}", header(name)), lines.join("\n")),
            ("star", false) => (
                format!(
                    "there is neither {}; a [star] needs {list}",
                    ProductKind::WORDS.map(|product| format!("[{product}]")).join(" nor ")
                ),
                format!("[star]\n{}\n{DRAWING}", lines.join("\n")),
            ),
            (name, false) => (
                format!("there is no [{name}], which needs {list}"),
                format!("[{name}]\n{}", lines.join("\n")),
            ),
        };
        let label = if keys.len() == 1 { "this key is required" } else { "these keys are required" };
        Fault::error(FaultCode::MissingKey, place, message)
            .label(label)
            .help(format!("write for instance:\n{help}"))
            .or_new_spec((!is_written).then_some(NewSpec::Starter))
    }
}

/// Whether `key` of `section`, or the section `key` where `section` is empty, is in the text with slips or as a diameter.
fn has_misspelt(sections: &[Known<'_>], section: &str, key: &str) -> bool {
    sections.iter().filter(|one| one.section == section).any(|one| {
        let words = one.table.into_iter().flat_map(|table| &table.0).map(|entry| entry.key.as_str());
        let mut unknown = words.filter(|word| {
            let is_section = section.is_empty() && sections.iter().any(|one| one.section == *word);
            !(one.keys.contains(word) || is_section)
        });
        unknown
            .any(|word| nearest(word, [key]).is_some() || radius_of(word).is_some_and(|radius| radius == key))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_diameter_is_twice_a_radius() {
        let text = "schema = 1\nname = \"x\"\n[star]\npoints = 5\ninner_diameter = \"79 mm\"\n";
        let faults = crate::read(&crate::Source::new("a", text)).expect_err("no such key");
        assert!(faults.list().iter().all(|fault| !fault.message.contains("`inner_radius`")), "{faults}");
        let help =
            faults.list().iter().find_map(|fault| fault.help.clone().filter(|_| fault.code == "unknown-key"));
        assert_eq!(help.as_deref(), Some("write inner_radius = \"39.5 mm\", half of the diameter"));
    }

    #[test]
    fn a_word_before_a_key_is_no_other_key() {
        let text = "schema = 1\nname = \"x\"\n[load]\nobject_mass = \"1 kg\"\n";
        let faults = crate::read(&crate::Source::new("a", text)).expect_err("no such key");
        assert!(faults.to_string().contains("did you mean `mass`?"), "{faults}");
        let text = text.replace("object_mass", "weight");
        let faults = crate::read(&crate::Source::new("a", &text)).expect_err("no such key");
        assert!(faults.to_string().contains("did you mean `mass`?"), "{faults}");
    }

    #[test]
    fn slips_are_forgiven_and_other_words_are_not() {
        let keys = ["tube_width", "tip_angle", "points"];
        assert_eq!(nearest("tube_widht", keys), Some("tube_width"));
        assert_eq!(nearest("Tube-Width", keys), Some("tube_width"));
        assert_eq!(nearest("point", keys), Some("points"));
        assert_eq!(nearest("colour", keys), None);
        assert_eq!(nearest(&"tube_width".repeat(100_000), keys), None);
    }
}
