//! One name, one type: a name that two types have makes a reader look up which of them is meant.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Names that several types may have, and why.
const REPEATED: &[(&str, &str)] = &[
    // The standard library's.
    ("Output", "an associated type of the standard library; and one file of a build"),
    // One a module, by custom.
    ("Args", "the arguments of each command, always written `build::Args`"),
    ("Command", "the program's commands, as clap has them; and what a controller is told"),
    // The verifier shares no code with the writers.
    (
        "Block",
        "the word for a line of G-code, for a part of a page or of a drawing, for equal columns of a study, for dense parts of a matrix",
    ),
    ("Drawing", "what is drawn, and what is read back"),
    ("Line", "a line of a program, and a straight segment"),
    ("Machine", "the machine of a profile, and the reader's model of it"),
    ("Program", "what is planned, and what is read back"),
    // The physics has words of its own for the things that a spec describes in other units.
    ("Actuator", "what is asked, and its shell"),
    ("Fabric", "as a spec describes it, and in SI units"),
    ("Sheet", "of the machine, and of the shell"),
    ("Piece", "a part of a curve, and a part of a mesh"),
    ("Mesh", "of a scene, and of a shell"),
    ("Section", "of a spec, of its schema, and the model of a hinge"),
    ("Element", "of a drawing, and of a hinge's section"),
    ("Place", "in a user's drawing, and in a mesh"),
    // The readers of users' drawings have faults of their own, which a spec takes over with its places.
    ("Fault", "of a user's drawing, and of a spec"),
    ("Limits", "of what is read of a drawing, and of a machine's axes"),
    ("Note", "on a drawing, and on a key of the schema"),
];

/// Python's classes have the names of the types that they describe.
const UNREAD: [&str; 1] = ["python"];

type Definitions = BTreeMap<String, Vec<String>>;

/// Adds the types that `text` of `file` defines: structs, enums, traits, aliases, associated types. Tests at its end do not count.
fn define(definitions: &mut Definitions, file: &str, text: &str) {
    for line in text.lines().map(str::trim_start).take_while(|line| !line.starts_with("mod tests {")) {
        let line = match line.strip_prefix("pub(").and_then(|rest| rest.split_once(") ")) {
            Some((_, rest)) => rest,
            None => line.strip_prefix("pub ").unwrap_or(line),
        };
        let Some((word, rest)) = line.split_once(' ') else { continue };
        let name: String = rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
        if ["struct", "enum", "trait", "type"].contains(&word) && name.starts_with(char::is_uppercase) {
            definitions.entry(name).or_default().push(file.to_owned());
        }
    }
}

/// Whether a module is compiled for tests only, by the lines of its parent.
fn is_test(path: &Path) -> bool {
    let name = path.file_stem().expect("a name").to_string_lossy();
    let sibling = |parent: &str| fs::read_to_string(path.with_file_name(parent)).unwrap_or_default();
    name == "tests" || sibling("mod.rs").contains(&format!("#[cfg(test)]\nmod {name};"))
}

fn walk(definitions: &mut Definitions, path: &Path) {
    for entry in fs::read_dir(path).expect("a directory") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            walk(definitions, &path);
        } else if path.extension().is_some_and(|ending| ending == "rs") && !is_test(&path) {
            define(definitions, &path.to_string_lossy(), &fs::read_to_string(&path).expect("a source file"));
        }
    }
}

#[test]
fn a_name_has_one_type() {
    let mut definitions = Definitions::new();
    for source in super::sources()
        .filter(|source| UNREAD.iter().all(|folder| *source != super::root().join(folder).join("src")))
    {
        walk(&mut definitions, &source);
    }
    assert!(definitions.len() > 500, "only {} types were read", definitions.len());
    definitions.retain(|_, files| files.len() > 1);
    let mut faults: Vec<String> = definitions
        .iter()
        .filter(|(name, _)| !REPEATED.iter().any(|(repeated, _)| repeated == name))
        .map(|(name, files)| format!("{name} is defined in {}: give one another name", files.join(", ")))
        .collect();
    let unneeded = REPEATED.iter().filter(|(name, _)| !definitions.contains_key(*name));
    faults.extend(unneeded.map(|(name, _)| format!("{name} is defined once: take it out of REPEATED")));
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn a_second_type_of_a_name_is_seen() {
    let mut definitions = Definitions::new();
    define(
        &mut definitions,
        "a.rs",
        "pub(in crate::cli) struct Job<'a> {\n    type Item = Job;\n}\nenum Job2 {}\n",
    );
    define(
        &mut definitions,
        "b.rs",
        "pub type Job = u32;\n// struct Item\nmod tests {\n    struct Item;\n}\n",
    );
    assert_eq!(definitions["Job"], ["a.rs", "b.rs"]);
    assert_eq!((definitions["Item"].len(), definitions.len()), (1, 3));
}
