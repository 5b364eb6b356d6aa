//! The JSON Schemas of a spec and of a machine profile, for editors: completion, hints, and slips underlined while one types.
//!
//! Each truth keeps its home: the reader defines the keys and the values that each takes ([`ValueShape`]). Meanings, defaults and
//! examples come from the starter and the profile `generic`.

mod notes;

use std::collections::BTreeMap;

use serde_json::{Map, Value, json};

use crate::builtin_machine;
use crate::product::ProductKind;
use crate::profile::read_profile;
use crate::raw::RawSpec;
use crate::reading::read_spec;
use crate::schema::notes::{Note, Notes};
use crate::section::Reader;
use crate::shape::{ValueShape, capital};
use crate::starter::TEMPLATE;

/// The file's name beside a spec, as in the first line of the starter.
pub const SCHEMA_FILE: &str = "stargrip-cam.schema.json";

/// The section whose keys are those of sections with names.
const NAMED: &str = "process";
/// The section whose keys are those of a list of sections.
const LIST: &str = "stack.star";
/// The products: a spec has one of these sections.
const EITHER: [&str; ProductKind::WORDS.len()] = ProductKind::WORDS;
/// The section of a profile that only a laser has, and the key of `[heights]` that a laser has not.
const OF_LASERS: &str = "laser";
const OF_IRONS: &str = "contact";
/// The profile's list, which is in no section.
const CLAMPS: &str = "keep_out";

/// Keys that the starter leaves out, because they exclude a key that is shown.
pub(super) const INSTEAD: &str = r#"
[load]
chambers = { "right-hose": "0 kPa" }  # pressures of chambers of a drawing that differ from `pressure`, by the names of their ports
plates = "20 mm"  # distance of two rigid level plates between which the chambers of a drawing are inflated; absent: no plates
object_radius = "30 mm"  # half of object_diameter, which it replaces; set one of the two
[seal]
strength = "3 N/mm"  # peel strength of the seams, in place of `seal_strength` in [fabric]; set one of the two
power = "10 %"  # of a laser, as a part of its full power, in place of `temperature`; `tip` is then the width of its spot
focus = "12 mm"  # height of a laser's focus above the sheet, in place of `height`; absent: that of the machine's profile
[process.weak]
power = "8 %"  # of a laser, in place of `temperature`
focus = "12 mm"  # height of a laser's focus above the sheet, in place of `height`
[cut]
power = "60 %"  # of a laser that cuts, as a part of its full power, in place of `temperature`
focus = "12 mm"  # height of a laser's focus above the sheet while it cuts, in place of `height`
# A shape by your own drawing, in place of [star], [stack] and [frame].
[drawing]
file = "outline.svg"  # SVG or ASCII DXF, beside this file
units = "mm"  # of the file's numbers; it replaces the unit that the file states, and a note says so
# join = "0.02 mm"  # ends of curves up to this far apart are joined, and reported
# passage = "15 mm"  # a narrower passage of the air gives a warning
# flange = "10 mm"  # width of a valve's flange around its hole, where its rim is not drawn
layers = { "air": ["chamber"], "port": ["inlet"] }  # the role of each layer: air edges, seam centre lines, ports, cut, holes, valves, measures, bars that pull, or ignored
process = { "weak": ["tear"] }  # the process of some seams: names of layers, elements, roles (air, seam) or seams; all others are made by [seal]
measure = { "tip": ["174 mm, 15 mm", "174 mm, 95 mm"] }  # what is measured after inflation: a name with points, X to the right and Y upwards, or with one element of the drawing
"#;

/// Notes that the profile `generic` lacks. A line that begins with `# ` is a default, with the meaning that `generic` gives where
/// this one is empty.
const MORE: &str = r#"
schema = 1  # the version of this format
name = "my-machine"  # what programs and messages call it
description = "GRBL on a router"  # one line for `stargrip-cam machines`
# tool = "iron"  # "iron" or "laser", which programs lead along the seams, or "press", which takes no other key of these
# heating = "operator"
# line_length = 72
# comments = "semicolon"
# thumbnails = false
# arcs = true
# ramp = "3 mm"
# surface = "0 mm"  # height of the release layer above the machine's Z 0, for a printer that homes: board, fabric and paper
[origin]
# x = "0 mm"  # X of the sheet's lower left corner in the machine's coordinates; 0 where they are set to 0 there by hand
# y = "0 mm"  # Y of the sheet's lower left corner in the machine's coordinates; 0 where they are set to 0 there by hand
[work_area]
x = "unknown"  # along X, from the machine's zero; set both, or none
y = "unknown"  # along Y, from the machine's zero; set both, or none
[heights]
contact = "-0.3 mm"  # while sealing: below 0 for a spring-loaded tip, 0 for a rigid one; required of an iron, and none of a laser, which has `focus`
[speeds]
# travel = "20 mm/s"
# trace = "20 mm/s"
[motion]
x_steps_per_mm = 80  # steps of this axis for a millimetre; set all three axes, or none
y_steps_per_mm = 80  # steps of this axis for a millimetre; set all three axes, or none
z_steps_per_mm = 400  # steps of this axis for a millimetre; set all three axes, or none
# min_feed = "0 mm/s"  # the controller raises any lower feed to this
acceleration = "10 mm/s^2"  # of X and Y; chopping counts with it
# start_delay = "0 s"
# first_step_rate = "none"
# min_move_steps = 0
z_speed = "5 mm/s"  # largest speed of Z (M203 Z, $112), where it is below that of X and Y
z_acceleration = "100 mm/s^2"  # acceleration of Z (M201 Z, $122), where it is below that of X and Y
# s_curve = false  # whether speeds follow an S (Marlin: S_CURVE_ACCELERATION)
[dwell]
# unit = "s"  # of G4's P; of the dialects marlin, klipper, reprapfirmware and bambu it is "ms", and no other is taken
# step = "1 ms"
[laser]  # A laser, with `tool = "laser"`. Such a profile has no `contact` in [heights], no `heating` and no `spring_loaded`.
full_power = 1000  # the S word of full power: $30 of GRBL and grblHAL, the end of `speed_map` of FluidNC
focus = "12 mm"  # height of its focus above the sheet, for a spot as wide as `tip` in [seal]; below `travel`
laser_mode = true  # that $32=1 is set (FluidNC: a Laser spindle in its configuration); false is refused
[keep_out]
# name = "clamp"  # what messages and the preview call it
x = "0 mm"  # its lower left corner, from the sheet's
y = "100 mm"  # its lower left corner, from the sheet's
"#;

/// The schema of a spec, draft 7, as text.
pub fn schema() -> String {
    let (raw, _) = RawSpec::parse("[stack]\ncount = 64\n[[stack.star]]\nindex = 1\n");
    let mut reader = Reader::new(&raw);
    let _ = read_spec(&mut reader);
    let mut notes = Notes::read(TEMPLATE);
    notes.keys.extend(Notes::read(INSTEAD).keys);
    let mut sections = sections_of(&reader, &notes);
    let list = sections.remove(LIST).unwrap_or_default().object(notes.of_section(LIST));
    if let Some(stars) = sections.get_mut("stack").and_then(|stack| stack.keys.get_mut("star")) {
        stars["items"] = list;
    }
    text_of(
        sections,
        &notes,
        (
            "A specification for stargrip-cam",
            "A heat-sealed inflatable: a fabric star gripper or a drawn shape.",
        ),
    )
}

/// The schema of a machine profile, draft 7, as text.
pub fn machine_schema() -> String {
    let (raw, _) = RawSpec::parse("[[keep_out]]\n");
    let mut reader = Reader::new(&raw);
    let _ = read_profile(&mut reader);
    let notes = profile_notes();
    let mut sections = sections_of(&reader, &notes);
    let clamps = sections.remove(CLAMPS).unwrap_or_default().object("");
    let description = notes.of_section(CLAMPS);
    let mut root = sections.remove("").unwrap_or_default();
    let list = json!({ "type": "array", "description": description, "items": clamps });
    let _ = root.keys.insert(CLAMPS, list);
    let _ = sections.insert("", root);
    text_of(sections, &notes, ("A machine profile for stargrip-cam", "One controller and its iron."))
}

/// The notes on a profile's keys.
fn profile_notes() -> Notes {
    let mut notes = Notes::read(builtin_machine("generic").unwrap_or_default());
    // The values of `generic` belong to one machine and are not defaults.
    notes.keys.values_mut().for_each(|note| note.is_default = false);
    for (key, mut more) in Notes::read(MORE).keys {
        if let Some(note) = notes.keys.get_mut(&key).filter(|_| more.meaning.is_empty()) {
            more.meaning = std::mem::take(&mut note.meaning);
        }
        let _ = notes.keys.insert(key, more);
    }
    notes
}

/// The keys that `reader` took, by section.
fn sections_of(reader: &Reader<'_>, notes: &Notes) -> BTreeMap<&'static str, SectionSchema> {
    let mut sections: BTreeMap<&str, SectionSchema> = BTreeMap::new();
    for (section, key, shape) in reader.shapes() {
        let _ = sections.entry(section).or_default().keys.insert(key, property(section, key, shape, notes));
    }
    for (section, key) in reader.required().filter(|(_, key)| *key != OF_IRONS) {
        sections.entry(section).or_default().required.push(key);
    }
    sections
}

/// `sections` as one object with a title and a description, the keys before the first section outside of them.
fn text_of(
    mut sections: BTreeMap<&'static str, SectionSchema>,
    notes: &Notes,
    (title, description): (&str, &str),
) -> String {
    let mut root = sections.remove("").unwrap_or_default();
    for (name, section) in sections {
        if name == NAMED {
            let keys = section.object("");
            let processes = json!({ "type": "object", "description": notes.of_section(NAMED), "additionalProperties": keys });
            let _ = root.keys.insert(name, processes);
            continue;
        }
        if !section.required.is_empty() && !EITHER.contains(&name) && name != OF_LASERS {
            root.required.push(name);
        }
        let _ = root.keys.insert(name, section.object(notes.of_section(name)));
    }
    let mut object = root.object(description);
    object["$schema"] = json!("http://json-schema.org/draft-07/schema#");
    object["title"] = json!(title);
    if object["properties"].get(EITHER[0]).is_some() {
        object["oneOf"] = EITHER.iter().map(|name| json!({ "required": [name] })).collect();
    }
    format!("{object:#}\n")
}

/// A section on its way to an object.
#[derive(Default)]
struct SectionSchema {
    keys: BTreeMap<&'static str, Value>,
    required: Vec<&'static str>,
}

impl SectionSchema {
    fn object(self, description: &str) -> Value {
        let keys: Map<String, Value> =
            self.keys.into_iter().map(|(key, value)| (key.to_owned(), value)).collect();
        let mut object = json!({ "type": "object", "additionalProperties": false, "properties": keys });
        if !self.required.is_empty() {
            object["required"] = json!(self.required);
        }
        if !description.is_empty() {
            object["description"] = json!(description);
        }
        object
    }
}

fn property(section: &str, key: &str, shape: &ValueShape, notes: &Notes) -> Value {
    let (mut value, range_words) = shape.schema();
    // A key of a single star has the meaning of the same key in the section for all stars.
    let homes: &[(&str, &str)] = match (section, key) {
        (LIST, "inlet_tip") => &[(LIST, "inlet_tip"), ("inlet", "tip")],
        (LIST, _) => &[(LIST, key), ("star", key), ("stack", key)],
        _ => &[(section, key)],
    };
    let notes_of_key = homes.iter().filter_map(|home| notes.of_key(*home));
    let note = notes_of_key.fold(None, |best: Option<&Note>, note| match best {
        // The list's own lines are examples without a meaning.
        Some(best) if !best.meaning.is_empty() && section != LIST => Some(best),
        _ => Some(note),
    });
    let meaning = note.map_or("", |note| note.meaning.as_str());
    let sentences =
        [Some(sentence(meaning)), range_words].into_iter().flatten().filter(|text| !text.is_empty());
    let description = sentences.collect::<Vec<_>>().join(" ");
    if !description.is_empty() {
        value["description"] = json!(description);
    }
    match note {
        Some(note) if note.is_default && section != LIST => value["default"] = note.value.clone(),
        Some(note) => value["examples"] = json!([note.value]),
        None => {}
    }
    value
}

fn sentence(text: &str) -> String {
    if text.is_empty() { String::new() } else { capital(text) + "." }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Source, key, read_machine};

    fn read() -> Value {
        serde_json::from_str(&schema()).expect("JSON")
    }

    /// The property of `key` in `section`.
    fn property_of<'s>(schema: &'s Value, section: &str, key: &str) -> &'s Value {
        let home = match section {
            "" => schema,
            NAMED => &schema["properties"][NAMED]["additionalProperties"],
            section => &schema["properties"][section],
        };
        &home["properties"][key]
    }

    #[test]
    fn every_key_of_the_reader_is_in_the_schema_and_no_other() {
        let schema = read();
        for key in key::ALL {
            assert!(property_of(&schema, key.section(), key.key()).is_object(), "{key}");
        }
        let count = |object: &Value| object["properties"].as_object().map_or(0, Map::len);
        let sections: std::collections::BTreeSet<&str> =
            key::ALL.iter().map(|key| key.section()).filter(|name| !name.is_empty()).collect();
        let home = |name: &str| match name {
            NAMED => count(&schema["properties"][NAMED]["additionalProperties"]),
            name => count(&schema["properties"][name]),
        };
        let section_keys: usize = sections.iter().map(|name| home(name)).sum();
        assert_eq!(count(&schema) - sections.len() + section_keys, key::ALL.len());
        let star_keys = key::ALL.iter().filter_map(|key| key.own_name()).chain(["index"]);
        let stars = &schema["properties"]["stack"]["properties"]["star"]["items"];
        let mut number = 0;
        for name in star_keys {
            assert!(stars["properties"][name].is_object(), "{name}");
            number += 1;
        }
        assert_eq!(count(stars), number);
        assert_eq!(stars["additionalProperties"], json!(false));
    }

    #[test]
    fn every_key_says_what_it_means_and_has_a_default_or_an_example() {
        let schema = read();
        for key in key::ALL.iter().filter(|key| key.to_string() != "stack.star") {
            let property = property_of(&schema, key.section(), key.key());
            assert!(
                property["description"].as_str().is_some_and(|text| text.len() > 10),
                "{key}: {property}"
            );
            assert!(
                property.get("default").is_some() != property.get("examples").is_some(),
                "{key}: {property}"
            );
        }
        assert_eq!(property_of(&schema, "seal", "speed")["default"], json!("0.1 mm/s"));
        assert_eq!(property_of(&schema, "load", "pressure")["examples"], json!(["37 kPa"]));
        assert_eq!(schema["required"], json!(["schema", "name"]));
        assert_eq!(schema["oneOf"], json!([{ "required": ["star"] }, { "required": ["drawing"] }]));
        assert_eq!(property_of(&schema, "machine", "program")["enum"], json!(["star", "piece", "sheet"]));
        assert_eq!(property_of(&schema, "fabric", "poisson_ratio")["exclusiveMinimum"], json!(-1.0));
        assert!(
            schema["properties"]["star"]["description"]
                .as_str()
                .is_some_and(|text| text.starts_with("One flat star"))
        );
    }

    #[test]
    fn every_key_of_a_profile_says_what_it_means() {
        let schema: Value = serde_json::from_str(&machine_schema()).expect("JSON");
        let mut number = 0;
        let mut looked_at = |keys: &Value| {
            for (key, property) in keys["properties"].as_object().expect("keys") {
                if property["type"] != "object" && key != CLAMPS {
                    let description = property["description"].as_str();
                    assert!(description.is_some_and(|text| text.len() > 10), "{key}: {property}");
                    assert!(property["examples"].is_array() != property.get("default").is_some(), "{key}");
                    number += 1;
                }
            }
        };
        looked_at(&schema);
        for section in ["origin", "work_area", "heights", "laser", "speeds", "motion", "dwell", "program"] {
            looked_at(&schema["properties"][section]);
        }
        looked_at(&schema["properties"][CLAMPS]["items"]);
        assert!(number > 35, "{number}");
        assert_eq!(schema["required"], json!(["schema", "name", "dialect", "heights", "program"]));
        let x = property_of(&schema, "work_area", "x");
        assert!(
            x["anyOf"].as_array().is_some_and(|ways| ways.contains(&json!({ "const": "unknown" }))),
            "{x}"
        );
        assert_eq!(property_of(&schema, "program", "start")["type"], json!("array"));
    }

    #[test]
    fn a_profile_without_the_defaults_means_the_same() {
        let bare = "schema = 1\nname = \"m\"\ndialect = \"grbl\"\n";
        let rest = "[heights]\ncontact = \"0 mm\"\ntravel = \"5 mm\"\npark = \"30 mm\"\n\
                    [program]\nstart = [\"G21 G17 G91.1 G90 G94\"]\npause = \"M0\"\nend = [\"M2\"]\n\
                    [[keep_out]]\nx = \"0 mm\"\ny = \"0 mm\"\nwidth = \"9 mm\"\ndepth = \"9 mm\"\n";
        let defaults: Vec<&str> = MORE
            .lines()
            .filter_map(|line| line.strip_prefix("# ").or_else(|| line.starts_with('[').then_some(line)))
            .filter(|line| !["[work_area]", "[heights]"].contains(line) && !line.starts_with("[laser]"))
            .collect();
        assert!(defaults.len() > 14, "{defaults:?}");
        let (root, sections): (Vec<&str>, Vec<&str>) = {
            let end = defaults.iter().position(|line| line.starts_with('[')).expect("a section");
            (defaults[..end].to_vec(), defaults[end..].to_vec())
        };
        let clamp = sections.iter().position(|line| *line == "[keep_out]").expect("clamps");
        let explicit = format!(
            "{bare}{}\n{}\n{rest}{}\n",
            root.join("\n"),
            sections[..clamp].join("\n"),
            sections[clamp + 1..].join("\n")
        );
        let read = |text: &str| {
            read_machine(&Source::new("profile", text)).unwrap_or_else(|why| panic!("{why}\n{text}"))
        };
        assert_eq!(read(&format!("{bare}{rest}")), read(&explicit));
        assert_ne!(read(&format!("{bare}{rest}")), read(&explicit.replace("arcs = true", "arcs = false")));
    }

    #[test]
    fn the_starter_names_the_schema() {
        assert_eq!(TEMPLATE.lines().next(), Some(format!("#:schema ./{SCHEMA_FILE}").as_str()));
    }
}
