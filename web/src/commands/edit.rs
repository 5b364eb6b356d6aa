//! `edit`: a new value in a user's text, whose layout is kept.

use serde_json::{Value, json};
use stargrip_cam::spec;
use stargrip_cam::spec::{LayerRole, edit as text_edit, key};

use crate::commands::faults::refused;
use crate::commands::spec::source;
use crate::question::{text, wrong};

/// The spec with `value`, a TOML value, at `key`. The result is not validated here: a slider may pass an invalid value.
///
/// # Errors
/// If there is no such key, or the text cannot be changed.
pub(super) fn edit(question: &Value) -> Result<Value, Value> {
    let spec_source = source(question)?;
    let name = text(question, "key").unwrap_or_default();
    let key = key::named(name).map_err(|_| wrong(format!("no key is called {name:?}")))?;
    let spec = text_edit::edited(&spec_source, &[(key, text(question, "value"))])
        .map_err(|faults| refused(&faults))?;
    Ok(json!({ "spec": spec }))
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
    let lists = LayerRole::ALL.iter().filter_map(|(word, role)| {
        let names = layers.iter().filter(|(_, own)| own == role).map(|(name, _)| json!(name).to_string());
        let names: Vec<String> = names.collect();
        (!names.is_empty()).then(|| format!("{word} = [{}]", names.join(", ")))
    });
    let value = format!("{{ {} }}", lists.collect::<Vec<_>>().join(", "));
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

    fn role_of(spec: &str, layer: &str, role: &str) -> Result<String, Value> {
        let answer = super::role(&json!({ "spec": spec, "layer": layer, "role": role }))?;
        Ok(answer["spec"].as_str().unwrap_or_default().to_owned())
    }
}
