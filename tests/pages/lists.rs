//! Lists of the program's words that are written by hand in other languages: each has every word.

use std::collections::BTreeSet;
use std::fs;

use stargrip_cam::artifact::Kind;
use stargrip_cam::coupon::CouponGroup;
use stargrip_cam::spec::{Detail, Dialect, DialectFamily, Extra, ModelChoice, machine_schema};

use crate::home;

fn text(file: &str) -> String {
    fs::read_to_string(home().join(file)).unwrap_or_else(|fault| panic!("{file}: {fault}"))
}

/// The words in quotes of the literal type `name` in Python.
fn literal(types: &str, name: &str) -> BTreeSet<String> {
    let (_, tail) = types.split_once(&format!("{name} = Literal[")).unwrap_or_else(|| panic!("no {name}"));
    let (list, _) = tail.split_once(']').expect("an end");
    list.split('"').skip(1).step_by(2).map(str::to_owned).collect()
}

fn set(words: &[&str]) -> BTreeSet<String> {
    words.iter().map(|word| (*word).to_owned()).collect()
}

#[test]
fn the_literals_of_python_have_every_word() {
    let types = text("python/package/stargrip_cam/_words.py");
    let kinds: Vec<&str> = Kind::ALL.iter().map(|kind| kind.name()).collect();
    assert_eq!(literal(&types, "FileKind"), set(&kinds));
    assert_eq!(literal(&types, "Model"), set(&ModelChoice::WORDS));
    assert_eq!(literal(&types, "Fineness"), set(&Detail::WORDS));
    assert_eq!(literal(&types, "CouponKind"), set(&CouponGroup::NAMES.map(|(name, _)| name)));
}

/// A kind of file that comes where it is named is named where people look for it, and strangers read it.
#[test]
fn every_extra_kind_is_named_in_the_pages_and_read_by_strangers() {
    for file in ["README.md", "crates/spec/templates/spec.toml"] {
        let page = text(file);
        let missing: Vec<&str> = Extra::WORDS.into_iter().filter(|word| !page.contains(word)).collect();
        assert!(missing.is_empty(), "{file} has no {missing:?}");
    }
    let strangers = text("tests/strangers/run");
    // `make check` compares pictures in pixels with a reader of its own.
    let unread = |word: &&str| *word != Extra::PreviewPng.name() && !strangers.contains(*word);
    assert_eq!(Extra::WORDS.into_iter().filter(unread).collect::<Vec<_>>(), [""; 0], "tests/strangers/run");
}

/// LinuxCNC's interpreter reads what is written for mills; the schema tells which dialects have dwells in milliseconds.
#[test]
fn every_dialect_is_where_its_family_is_listed() {
    let strangers = text("tests/strangers/run");
    let schema: serde_json::Value = serde_json::from_str(&machine_schema()).expect("JSON");
    let unit = schema["properties"]["dwell"]["properties"]["unit"]["description"].as_str().expect("a text");
    for (name, dialect) in Dialect::ALL {
        match dialect.family() {
            DialectFamily::Plain => {}
            DialectFamily::Mill => assert!(strangers.contains(name), "tests/strangers/run has no {name}"),
            DialectFamily::Printer => assert!(unit.contains(name), "crates/spec/src/schema.rs: {unit}"),
        }
    }
}
