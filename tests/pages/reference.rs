//! The references of keys are generated from the schemas, which are generated from the reader.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;

use serde_json::Value;

use crate::{home, renews};

const SPEC: &str = "# Every key of a spec

This page is generated from `stargrip-cam schema`. `new` writes a spec with the same keys and their defaults;
[choosing.md](choosing.md) explains the important ones. A quantity is a text with its unit, `\"50 mm\"`; the last table lists units.
";

const PROFILE: &str = "# Every key of a machine profile

This page is generated from `stargrip-cam schema --machine`. `stargrip-cam machines show grbl` prints a profile to start from;
[machines.md](machines.md) explains the values. A key without default that is absent or \"unknown\" is not checked.
";

#[test]
fn the_reference_of_the_spec_is_its_schema() {
    let template = include_str!("../../crates/spec/templates/spec.toml");
    assert_page("docs/spec.md", &page(SPEC, &stargrip_cam::spec::schema(), template));
}

#[test]
fn the_reference_of_profiles_is_their_schema() {
    let template = include_str!("../../crates/spec/templates/machines/generic.toml");
    assert_page("docs/profile.md", &page(PROFILE, &stargrip_cam::spec::machine_schema(), template));
}

fn assert_page(name: &str, page: &str) {
    let path = home().join(name);
    if renews() {
        fs::write(&path, page).expect("written");
    }
    let on_disk = fs::read_to_string(&path).unwrap_or_default();
    assert!(on_disk == page, "{name} is old: INSTA_UPDATE=always cargo test --test pages");
}

/// The page of a schema, its keys in the order of `template`.
fn page(head: &str, schema: &str, template: &str) -> String {
    let schema: Value = serde_json::from_str(schema).expect("JSON");
    let mut units = BTreeMap::new();
    let mut page_text = head.to_owned();
    let order = |section: &str, key: &str| place(template, section, key);
    page_text += &table("Before the first section", "", &schema, &order, &mut units);
    let mut sections: Vec<(&String, &Value)> =
        properties(&schema).filter(|(_, value)| is_section(value)).collect();
    sections.sort_by_key(|(name, _)| place(template, name, ""));
    for (name, section) in sections {
        let section_words = section["description"].as_str().unwrap_or_default();
        let (heading, object) = match (section.get("items"), section.get("properties")) {
            (Some(items), _) => (format!("[[{name}]]"), items),
            (None, Some(_)) => (format!("[{name}]"), section),
            // Sections with names of their own have equal keys.
            (None, None) => (format!("[{name}.NAME]"), &section["additionalProperties"]),
        };
        page_text += &table(&heading, section_words, object, &|_, key| order(name, key), &mut units);
        for (key, list) in properties(section).filter(|(_, value)| value["items"]["type"] == "object") {
            let list_words = list["items"]["description"].as_str().unwrap_or_default();
            let inner = format!("{name}.{key}");
            page_text += &table(
                &format!("[[{inner}]]"),
                list_words,
                &list["items"],
                &|_, key| order(&inner, key),
                &mut units,
            );
        }
    }
    page_text += "\n## Units\n\n| kind | units |\n|---|---|\n";
    for (kind, list) in units {
        let _ = writeln!(page_text, "| {kind} | {list} |");
    }
    page_text
}

fn properties(object: &Value) -> impl Iterator<Item = (&String, &Value)> {
    object["properties"].as_object().into_iter().flatten()
}

/// Whether a property is a section or a list of sections. A key that takes a table has an example of it.
fn is_section(property: &Value) -> bool {
    property["items"]["type"] == "object"
        || property["type"] == "object" && property.get("examples").is_none()
}

/// Whether the section `name` of a template is `section`, or one of its sections with names.
fn is_in_section(name: &str, section: &str) -> bool {
    name == section || name.split_once('.').is_some_and(|(head, _)| head == section)
}

/// The line number of `key` of `section`, or of the section itself, in `template`; a missing key comes last.
fn place(template: &str, section: &str, key: &str) -> usize {
    let mut section_name = "";
    let mut position = usize::MAX;
    for (line, number) in template.lines().zip(1..) {
        // An indented line is an example inside of a sentence.
        let bare = line.trim_start_matches('#');
        let bare = bare.strip_prefix(' ').unwrap_or(bare);
        if let Some((name, _)) =
            bare.strip_prefix('[').and_then(|rest| rest.trim_start_matches('[').split_once(']'))
        {
            section_name = name;
            if key.is_empty() && is_in_section(section_name, section) {
                position = position.min(number);
            }
        } else if is_in_section(section_name, section)
            && !key.is_empty()
            && bare.starts_with(&format!("{key} = "))
        {
            position = position.min(number);
        }
    }
    position
}

/// The table of an object's keys, below a heading.
fn table(
    heading: &str,
    words: &str,
    object: &Value,
    order: &dyn Fn(&str, &str) -> usize,
    units: &mut BTreeMap<String, String>,
) -> String {
    let mut keys: Vec<(&String, &Value)> =
        properties(object).filter(|(_, value)| !is_section(value)).collect();
    keys.sort_by_key(|(key, _)| order("", key));
    let mut table_text = format!("\n## {heading}\n\n");
    if !words.is_empty() {
        let mut sentence = words.to_owned();
        sentence[..1].make_ascii_uppercase();
        let _ = writeln!(table_text, "{}.\n", sentence.trim_end_matches('.'));
    }
    table_text += "| key | meaning | values | default |\n|---|---|---|---|\n";
    let required = object["required"].as_array();
    for (key, property) in keys {
        let (meaning, values) = meaning_and_values(property, units);
        let is_required = required.is_some_and(|list| list.iter().any(|name| name == key));
        let example = property["examples"][0].to_string();
        let default = match property.get("default") {
            Some(default) => format!("`{default}`"),
            None if is_required => format!("required; such as `{example}`"),
            None if heading == "[[stack.star]]" => "that of the others".to_owned(),
            None if heading == "[process.NAME]" => "that of [seal]".to_owned(),
            None => format!("none; such as `{example}`"),
        };
        let _ = writeln!(table_text, "| `{key}` | {meaning} | {values} | {default} |");
    }
    table_text
}

/// The meaning of a property, and its values.
fn meaning_and_values(property: &Value, units: &mut BTreeMap<String, String>) -> (String, String) {
    let text = property["description"].as_str().unwrap_or_default();
    let begin = [
        "A plain number; ",
        "A whole number ",
        "Always ",
        "One of ",
        "Two lengths ",
        "A list of texts",
        " with its unit (",
    ]
    .iter()
    .filter_map(|words| text.find(words))
    .min()
    // "A length with its unit" is the beginning of this sentence.
    .map(|at| {
        text[..at].rfind(". ").map_or(if text[at..].starts_with(' ') { 0 } else { at }, |stop| stop + 2)
    });
    let (meaning, values) = text.split_at(begin.unwrap_or(text.len()));
    let meaning = small(&meaning.trim().trim_end_matches('.').replace('|', "\\|"));
    let (prefix, bare_values) = match values.trim().trim_end_matches('.').strip_prefix("By name: ") {
        Some(value) => ("by name: ", value),
        None => ("", values.trim().trim_end_matches('.')),
    };
    if let Some((kind, rest)) = bare_values.split_once(" with its unit (") {
        let kind = kind.split_once(' ').map_or(kind, |(_, kind)| kind).to_owned();
        let (list, range) = rest.split_once("); ").expect("units and a range");
        let _ = units.insert(kind.clone(), list.to_owned());
        return (meaning, format!("{prefix}{kind}, {}", short(range)));
    }
    let values_in_words = match (property["type"].as_str(), bare_values) {
        (Some("boolean"), _) => "true or false".to_owned(),
        (Some("string"), "") => "text".to_owned(),
        (Some("object"), "") => "table of lists".to_owned(),
        (_, words) => {
            short(&words.replacen("A plain number; ", "number, ", 1).replacen("A whole", "whole", 1))
        }
    };
    (
        meaning,
        values_in_words
            .replacen("One of ", "", 1)
            .replacen("Always ", "", 1)
            .replacen("A list", "list", 1)
            .replacen("Two", "two", 1),
    )
}

/// A range in short form.
fn short(range: &str) -> String {
    let range = range
        .replace("must be ", "")
        .replace(" and at most ", " to ")
        .replace(" and less than ", " to below ");
    let range = range.replace("at least ", "").replace("more than ", "above ").replace(". Or ", ", or ");
    // The unit is given once, after both ends.
    let Some((low, high)) = range.split_once(" to ") else { return range };
    let unit = low
        .rsplit_once(' ')
        .map(|(_, unit)| unit)
        .filter(|unit| high.split([' ', ',']).any(|word| word == *unit));
    let low = unit.map_or(low, |unit| low.trim_end_matches(unit).trim_end());
    format!("{low} to {high}")
}

/// `text` with a lower-case first letter, for use behind a key, unless its first word is a name.
fn small(text: &str) -> String {
    let mut letters = text.chars();
    let rest: String = letters.clone().skip(1).collect();
    match letters.next() {
        Some(first) if !rest.starts_with(|c: char| c.is_uppercase() || c.is_ascii_digit()) => {
            first.to_lowercase().chain(rest.chars()).collect()
        }
        _ => text.to_owned(),
    }
}
