//! The form of the page and the settings of a drawing against the reader: neither has a key that the reader refuses beside a drawing.

use std::fs;

use stargrip_cam::spec::key::{self, named};
use stargrip_cam::spec::{KeyPath, ProductKind, Source, drawing_settings, read};

use crate::home;

const DRAWN: &str = "schema = 1\nname = \"x\"\n[drawing]\nfile = \"a.svg\"\nlayers = { air = [\"a\"] }\n";

/// The entries of the `list` of a product in web/page/form.js.
fn entries(product: &str, list: &str) -> Vec<String> {
    let form = fs::read_to_string(home().join("web/page/form.js")).expect("the form");
    let (_, table) = form.split_once("const PRODUCTS = {").expect("the products");
    let (_, row) = table.split_once(&format!("    {product}: {{")).unwrap_or_else(|| panic!("no {product}"));
    let (_, values) = row.split_once(&format!("{list}: [")).unwrap_or_else(|| panic!("no {list}"));
    let (values, _) = values.split_once(']').expect("an end");
    values.split('"').skip(1).step_by(2).map(str::to_owned).collect()
}

/// The value that the template shows for `key`; `None` for a key that it does not show.
fn example(key: KeyPath) -> Option<String> {
    let template = fs::read_to_string(home().join("crates/spec/templates/spec.toml")).expect("the template");
    let mut section = String::new();
    for line in template.lines().map(|line| line.trim_start_matches(['#', ' '])) {
        if let Some(name) = line.strip_prefix('[').and_then(|rest| rest.split_once(']')) {
            name.0.clone_into(&mut section);
        }
        if let Some((name, value)) = line.split_once(" = ")
            && (section.as_str(), name) == (key.section(), key.key())
        {
            return Some(value.split("  #").next().unwrap_or(value).trim().to_owned());
        }
    }
    None
}

/// Whether the reader refuses `key` beside a drawing, whatever its value.
fn is_refused(key: KeyPath) -> bool {
    let Some(value) = example(key) else { return false };
    let separator = "kind = \"separator\"\n";
    let lines = match key {
        key::mask::KIND => separator.to_owned(),
        _ if key.section() == "mask" => format!("{separator}{} = {value}\n", key.key()),
        _ => format!("{} = {value}\n", key.key()),
    };
    let source = Source::new("spec", format!("{DRAWN}[{}]\n{lines}", key.section()));
    let refusals = read(&source).err();
    refusals
        .is_some_and(|faults| faults.list().iter().any(|fault| fault.message.contains("beside [drawing]")))
}

#[test]
fn a_key_that_only_stars_have_is_neither_in_the_form_nor_in_the_settings_of_a_drawing() {
    let (first, groups, hidden) =
        (entries("drawing", "first"), entries("drawing", "groups"), entries("drawing", "without"));
    let settings = drawing_settings(&Source::new("spec", DRAWN));
    let refused: Vec<&KeyPath> = key::ALL.iter().filter(|key| is_refused(**key)).collect();
    assert!(refused.len() > 20, "{refused:?}");
    for key in refused {
        let name = key.to_string();
        let is_shown = first.contains(&name)
            || groups.iter().any(|group| group == key.section()) && !hidden.contains(&name);
        assert!(!is_shown, "web/page/form.js shows {name} for a drawing");
        let is_set = settings
            .iter()
            .any(|setting| (setting.section.as_str(), setting.key.as_str()) == (key.section(), key.key()));
        assert!(!is_set, "`is_of_stars` of crates/spec/src/values.rs has no {name}");
    }
}

#[test]
fn the_form_has_every_product_and_only_keys_of_the_reader() {
    for section in ProductKind::WORDS {
        let keys = [entries(section, "first"), entries(section, "without")].concat();
        let unknown: Vec<&String> = keys.iter().filter(|name| named(name).is_err()).collect();
        assert!(unknown.is_empty(), "{section}: {unknown:?}");
        assert!(entries(section, "groups").iter().any(|group| group == section));
    }
}
