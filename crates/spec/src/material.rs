//! Materials: a fabric by its name, with the settings that seal it, as `calibrate` prints them.
//!
//! A material is written into the text of a spec, so that a build states every value that it used. Nothing is written that the material
//! does not state.

use toml_edit::{DocumentMut, Item, Table, TableLike};

use crate::edit::{document, set};
use crate::fault::Fault;
use crate::faults::Faults;
use crate::foreign::{self, Document};
use crate::press;
use crate::processes::read_processes;
use crate::product::ProductKind;
use crate::raw::RawSpec;
use crate::reading::{read, read_fabric_with, read_with};
use crate::seal::read_seal;
use crate::section::Reader;
use crate::source::Source;
use crate::value::RawValue;
use crate::{FaultCode, PRESS_PROFILE, key};

/// The materials that come with the program: name and text. Their figures are those of a source that the text names.
const BUILTIN: [(&str, &str); 1] = [("paper", include_str!("../templates/materials/paper.toml"))];

/// The names of the materials that come with the program.
pub fn builtin_materials() -> impl Iterator<Item = &'static str> {
    BUILTIN.iter().map(|(name, _)| *name)
}

/// The text of the material that comes with the program under `name`.
pub fn builtin_material(name: &str) -> Option<&'static str> {
    BUILTIN.iter().find(|(material, _)| *material == name).map(|(_, text)| *text)
}

/// The text of `spec` with the values of `material`: `[fabric]` and, where `material` is no whole spec, the settings of its tool, `[seal]` and
/// `[process.NAME]` of an iron or `[press]`. A process is taken where the spec has one of this name. A spec that is not TOML stays as it is: its
/// reader reports why.
///
/// A material with a `thickness` is a fabric, and replaces all of `[fabric]`. One without it is a measurement of the spec's own fabric, and
/// replaces single values.
///
/// # Errors
/// All faults of `material`, by the rules of a spec.
pub fn with_material(spec: &Source, material: &Source) -> Result<String, Faults> {
    // Sections that the spec cannot have are dropped from the material first. Then values of the spec that contradict the
    // material go, and those of the material are set one by one, so that everything else stays as it is written.
    let is_whole = check(material)?;
    let (Ok(mut target), mut stated) = (spec.text.parse::<DocumentMut>(), document(material)?) else {
        return Ok(spec.text.clone());
    };
    if is_whole {
        stated.retain(|section, _| section == "fabric");
    }
    let other_tool: &[&str] = if is_pressed(&target) { &["seal", "process"] } else { &["press"] };
    stated.retain(|section, _| !other_tool.contains(&section));
    let strengths = [("fabric", key::fabric::SEAL_STRENGTH.key()), ("seal", key::seal::STRENGTH.key())];
    // Both are the strength of the same seams: the material's replaces either.
    if strengths.iter().any(|(section, key)| states(&stated, section, key)) {
        for (section, key) in strengths {
            let table = target.get_mut(section).and_then(Item::as_table_like_mut);
            let _ = table.and_then(|table| table.remove(key));
        }
    }
    if states(&stated, "fabric", key::fabric::THICKNESS.key())
        && let Some(fabric) = target.get_mut("fabric").and_then(Item::as_table_like_mut)
    {
        fabric.clear();
    }
    for (section, item) in stated.iter() {
        let Some(values) = item.as_table_like() else { continue };
        if section == "process" {
            for (name, process) in values.iter() {
                let place = target.get_mut(section).and_then(|processes| processes.get_mut(name));
                if let (Some(place), Some(values)) = (place, process.as_table_like()) {
                    copy(values, place);
                }
            }
            continue;
        }
        copy(values, target.entry(section).or_insert_with(|| Item::Table(Table::new())));
    }
    Ok(target.to_string())
}

fn states(material: &DocumentMut, section: &str, key: &str) -> bool {
    material.get(section).and_then(|item| item.get(key)).is_some()
}

/// Sets every value of `values` in `place`, a section.
fn copy(values: &dyn TableLike, place: &mut Item) {
    let is_inline = place.is_inline_table();
    let Some(section) = place.as_table_like_mut() else { return };
    for (key, item) in values.iter() {
        let Some(value) = item.as_value() else { continue };
        let mut value = value.clone();
        // The comment behind a value is about the material's file.
        value.decor_mut().clear();
        set(section, is_inline, key, value);
    }
}

/// Whether the seams of the spec `tree` are pressed.
fn is_pressed(tree: &DocumentMut) -> bool {
    let profile = tree.get("machine").and_then(|machine| machine.get("profile")).and_then(Item::as_str);
    tree.get("press").is_some() || profile == Some(PRESS_PROFILE)
}

/// Checks a material; whether it is a whole spec.
fn check(material: &Source) -> Result<bool, Faults> {
    let (raw, _) = RawSpec::parse(&material.text);
    let mut names = raw.root().0.iter().map(|entry| &*entry.key);
    if names.any(|name| ["schema", "name"].contains(&name) || ProductKind::WORDS.contains(&name)) {
        return read(material).map(|_| true);
    }
    if raw.root().0.is_empty() && foreign::fault(&material.text).is_none() {
        let fault = Fault::error(FaultCode::NotASpec, 0..0, "this states nothing about a fabric");
        return Err(Faults::new(
            material,
            vec![fault.label("must have [fabric], [seal], [process.NAME] or [press]")],
        ));
    }
    let pressed = raw.root().get("press").and_then(RawValue::as_table).is_some();
    read_with(material, Document::Spec, |reader: &mut Reader<'_>| {
        let _ = reader.root();
        let (seal, strength) = read_seal(&mut reader.section("seal"));
        let _ = read_processes(reader, &seal);
        let _ = read_fabric_with(reader, strength);
        if pressed {
            let _ = press::read_section(&mut reader.section("press"));
        }
    })
    .map(|_| false)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::LineForce;

    const STAR: &str = "schema = 1\nname = \"x\"\n[fabric]\nthickness = \"0.2 mm\" # ours\nareal_density = \"0.2 kg/m^2\"\n\
        [star]\npoints = 5\ninner_radius = \"50 mm\"\ntube_width = \"30 mm\"\ntip_angle = \"30 deg\"\nouter_process = \"weak\"\n\
        [process.weak]\nspeed = \"1 mm/s\"\n";

    fn completed(spec: &str, material: &str) -> Result<String, Faults> {
        with_material(&Source::new("star.toml", spec), &Source::new("fabric.toml", material))
    }

    fn spec_of(text: &str) -> crate::Spec {
        read(&Source::new("x", text)).unwrap_or_else(|faults| panic!("{faults}\n{text}")).spec
    }

    #[test]
    fn nothing_is_written_that_the_material_does_not_state() {
        let measured = "# 3 specimens\n[fabric]\nseal_strength = \"3 N/mm\" # T-peel\n[seal]\nspeed = \"0.2 mm/s\"\n\
            [process.weak]\ntemperature = \"170 C\"\n[process.other]\nspeed = \"5 mm/s\"\n[press]\ntime = \"9 s\"\n";
        let text = completed(STAR, measured).expect("sound");
        let spec = spec_of(&text);
        assert_eq!((spec.fabric.thickness.0, spec.seal.speed.0), (0.2, 0.2));
        assert_eq!(spec.fabric.seal_strength, Some(LineForce(3.0)));
        assert!(text.contains("# ours") && !text.contains("T-peel") && !text.contains("specimens"), "{text}");
        for absent in ["young_modulus", "band", "other", "press"] {
            assert!(!text.contains(absent), "{absent}: {text}");
        }
        assert_eq!(
            spec.processes.iter().map(|process| process.temperature.map(|value| value.0)).collect::<Vec<_>>(),
            [Some(170.0)]
        );
    }

    #[test]
    fn a_thickness_makes_another_fabric() {
        let spec = spec_of(&completed(STAR, "[fabric]\nthickness = \"0.4 mm\"\n").expect("sound"));
        assert_eq!((spec.fabric.thickness.0, spec.fabric.areal_density), (0.4, None));
        let material = format!("{}[seal]\nspeed = \"7 mm/s\"\n", STAR.replace("0.2 mm", "0.5 mm"));
        let spec = spec_of(&completed(STAR, &material).expect("sound"));
        assert_eq!((spec.fabric.thickness.0, spec.seal.speed.0), (0.5, 0.1));
    }

    #[test]
    fn one_strength_replaces_the_other_and_a_press_its_own_settings() {
        let spec = STAR.replace("[star]", "seal_strength = \"1 N/mm\"\n[star]");
        let text = completed(&spec, "[seal]\nstrength = \"2 N/mm\"\n").expect("sound");
        assert_eq!(spec_of(&text).fabric.seal_strength, Some(LineForce(2.0)));
        let pressed = "schema = 1\nname = \"x\"\n[machine]\nprofile = \"press\"\n[star]\npoints = 5\ninner_radius = \"50 mm\"\n\
            tube_width = \"30 mm\"\ntip_angle = \"30 deg\"\n";
        let material = "[press]\ntime = \"9 s\"\n[seal]\nspeed = \"1 mm/s\"\n";
        let press = spec_of(&completed(pressed, material).expect("sound")).press.expect("a press");
        assert_eq!(press.time.0, 9.0);
        let paper = builtin_material("paper").expect("built in");
        assert!(spec_of(&completed(pressed, paper).expect("sound")).press.is_some());
    }

    #[test]
    fn faults_of_a_material_are_those_of_a_spec() {
        for (material, code) in [
            ("[fabrik]\nthickness = \"1 mm\"\n", "unknown-section"),
            ("[fabric]\nthicknes = \"1 mm\"\n", "unknown-key"),
            ("[fabric]\nthickness = 1\n", "no-unit"),
            ("[press]\ntime = \"1 h\"\n", "out-of-range"),
            ("[sheet]\nwidth = \"1 m\"\n", "unknown-section"),
            ("dialect = \"grbl\"\n", "not-a-spec"),
            ("{", "not-a-spec"),
            ("# nothing\n", "not-a-spec"),
            ("", "not-a-spec"),
        ] {
            assert_eq!(completed(STAR, material).expect_err(material).list()[0].code, code, "{material}");
        }
        assert_eq!(completed("[star", "[fabric]\n").expect("the spec's own reader tells"), "[star");
        assert!(
            builtin_materials().all(|name| completed(STAR, builtin_material(name).unwrap_or("")).is_ok())
        );
    }
}
