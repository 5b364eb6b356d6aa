//! `edit`: a new value in a user's text, whose layout is kept.

use serde_json::{Value, json};
use stargrip_cam::spec;
use stargrip_cam::spec::{KeyPath, LayerRole, Source, edit as text_edit, key};

use crate::commands::faults::refused;
use crate::commands::spec::source;
use crate::question::{text, wrong};

/// The spec with `value`, a TOML value, at `key`, "star.points" or "process.weak.speed". The result is not validated here: a slider may pass an invalid value.
///
/// # Errors
/// If there is no such key, or the text cannot be changed.
pub(super) fn edit(question: &Value) -> Result<Value, Value> {
    let spec_source = source(question)?;
    let name = text(question, "key").unwrap_or_default();
    let value = text(question, "value");
    let process = name.strip_prefix("process.").and_then(|rest| rest.rsplit_once('.'));
    let spec = match process {
        Some((process, key)) => {
            text_edit::with_process(&spec_source, process, key_of(&format!("process.{key}"))?, value)
        }
        None => text_edit::edited(&spec_source, &[(key_of(name)?, value)]),
    };
    Ok(json!({ "spec": spec.map_err(|faults| refused(&faults))? }))
}

/// The key called `name`.
///
/// # Errors
/// If there is no such key.
fn key_of(name: &str) -> Result<KeyPath, Value> {
    key::named(name).map_err(|_| wrong(format!("no key is called {name:?}")))
}

/// The spec with the process `process` for the seams that `name` names: an element, a layer or a role of its drawing. `""` is that of
/// `[seal]`. A process that the spec does not have gets a section with the speed of `[seal]`.
///
/// # Errors
/// If the spec is refused, or cannot be edited.
pub(super) fn process(question: &Value) -> Result<Value, Value> {
    let spec_source = source(question)?;
    let (name, process) =
        (text(question, "name").unwrap_or_default(), text(question, "process").unwrap_or_default());
    let reading = spec::read(&spec_source).map_err(|faults| refused(&faults))?;
    let speed = format!("\"{} mm/s\"", reading.spec.seal.speed.0);
    let drawing = reading.spec.drawing.ok_or_else(|| wrong("the spec has no drawing"))?;
    let mut processes = drawing.processes;
    processes.retain(|(seam, _)| seam != name);
    if !process.is_empty() {
        processes.push((name.to_owned(), process.to_owned()));
    }
    let mut lists: Vec<(&str, Vec<&str>)> = Vec::new();
    for (seam, process) in &processes {
        match lists.iter_mut().find(|(listed, _)| listed == process) {
            Some((_, seams)) => seams.push(seam),
            None => lists.push((process, vec![seam])),
        }
    }
    let value = (!lists.is_empty()).then(|| table_of_lists(&lists));
    let edited = text_edit::edited(&spec_source, &[(key::drawing::PROCESS, value.as_deref())]);
    let mut edited = edited.map_err(|faults| refused(&faults))?;
    if !process.is_empty() && !reading.spec.processes.iter().any(|own| own.name == process) {
        let with_lists = Source::new("spec.toml", edited);
        edited = text_edit::with_process(&with_lists, process, key::process::SPEED, Some(&speed))
            .map_err(|faults| refused(&faults))?;
    }
    Ok(json!({ "spec": edited }))
}

/// Lists of names as an inline table of TOML, each at its key: the word of a role, or the name of a process.
fn table_of_lists(lists: &[(&str, Vec<&str>)]) -> String {
    let entry = |(key, names): &(&str, Vec<&str>)| {
        let names: Vec<String> = names.iter().map(|name| json!(name).to_string()).collect();
        format!("{key} = [{}]", names.join(", "))
    };
    format!("{{ {} }}", lists.iter().map(entry).collect::<Vec<_>>().join(", "))
}

/// The spec with the role `role` for the `layer` of its drawing; the order of the other layers stays.
///
/// # Errors
/// If there is no such role, or the spec is refused.
pub(super) fn role(question: &Value) -> Result<Value, Value> {
    let spec_source = source(question)?;
    let (layer, word) =
        (text(question, "layer").unwrap_or_default(), text(question, "role").unwrap_or_default());
    let role = LayerRole::ALL.iter().find(|(known, _)| *known == word).map(|(_, role)| *role);
    let role = role.ok_or_else(|| wrong(format!("no role is called {word:?}")))?;
    let reading = spec::read(&spec_source).map_err(|faults| refused(&faults))?;
    let drawing = reading.spec.drawing.ok_or_else(|| wrong("the spec has no drawing"))?;
    let mut layers = drawing.layers;
    match layers.iter_mut().find(|(name, _)| name == layer) {
        Some((_, own)) => *own = role,
        None => layers.push((layer.to_owned(), role)),
    }
    let mut lists: Vec<(&str, Vec<&str>)> = LayerRole::ALL
        .iter()
        .map(|(word, role)| {
            let names = layers.iter().filter(|(_, layer_role)| layer_role == role);
            (*word, names.map(|(name, _)| name.as_str()).collect())
        })
        .collect();
    lists.retain(|(_, names)| !names.is_empty());
    let value = table_of_lists(&lists);
    let edited = text_edit::edited(&spec_source, &[(key::drawing::LAYERS, Some(&value))]);
    Ok(json!({ "spec": edited.map_err(|faults| refused(&faults))? }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_layer_changes_its_role_and_the_others_stay() {
        let spec = "schema = 1\nname = \"x\"\n# mine\n[drawing]\nfile = \"a.svg\"\n[drawing.layers]\nair = [\"a\"]\nport = [\"b\", \"c\"]\n";
        let with_role = |layer: &str, role: &str| role_of(spec, layer, role);
        for (layer, word, lists) in [
            ("b", "ignore", r#"layers = { air = ["a"], port = ["c"], ignore = ["b"] }"#),
            ("a", "port", r#"layers = { port = ["a", "b", "c"] }"#),
            (
                "a \"new\" one",
                "seam",
                r#"layers = { air = ["a"], seam = ["a \"new\" one"], port = ["b", "c"] }"#,
            ),
        ] {
            let text = with_role(layer, word).expect(word);
            assert!(text.contains(lists) && text.contains("# mine"), "{text}");
        }
        assert!(with_role("a", "glue").is_err());
    }

    #[test]
    fn seams_change_their_process_and_a_new_one_gets_a_section() {
        let spec = "schema = 1\nname = \"x\"\n[drawing]\nfile = \"a.svg\"\nlayers = { air = [\"a\"], port = [\"b\"] }\n";
        let process_of = |spec: &str, name: &str, process: &str| {
            let answer =
                super::process(&json!({ "spec": spec, "name": name, "process": process })).expect(name);
            answer["spec"].as_str().unwrap_or_default().to_owned()
        };
        let weak = process_of(spec, "tear", "weak");
        assert!(weak.contains(r#"process = { weak = ["tear"] }"#), "{weak}");
        assert!(weak.ends_with("[process.weak]\nspeed = \"0.1 mm/s\"\n"), "{weak}");
        let two = process_of(&weak, "seam", "weak");
        assert!(two.contains(r#"process = { weak = ["tear", "seam"] }"#), "{two}");
        let strong = process_of(&two, "tear", "strong");
        assert!(strong.contains(r#"process = { weak = ["seam"], strong = ["tear"] }"#), "{strong}");
        let without_process = process_of(&weak, "tear", "");
        assert!(
            !without_process.contains("process = {") && without_process.contains("[process.weak]"),
            "{without_process}"
        );
        let slower = super::edit(&json!({ "spec": weak, "key": "process.weak.passes", "value": "2" }));
        assert!(
            slower.expect("a key of processes")["spec"]
                .as_str()
                .unwrap_or_default()
                .ends_with("passes = 2\n")
        );
    }

    fn role_of(spec: &str, layer: &str, role: &str) -> Result<String, Value> {
        let answer = super::role(&json!({ "spec": spec, "layer": layer, "role": role }))?;
        Ok(answer["spec"].as_str().unwrap_or_default().to_owned())
    }
}
