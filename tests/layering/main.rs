//! Data flows one way: the rooms on which each room may depend.
//!
//! Imports are written `use crate::room::{A, B};`, a line a module, so the dependencies of a file can be read from its lines.

mod circles;
mod names;
mod portable;

use std::fs;
use std::path::Path;

/// The directories of the rooms.
const SOURCES: [&str; 2] = ["crates/inflatable/src", "src"];

/// (room, the rooms it may use). A room is a directory or file directly in one of [`SOURCES`].
const MAY_USE: [(&str, &[&str]); 24] = [
    ("digest", &[]),
    ("geom", &[]),
    ("numerics", &[]),
    ("readable", &[]),
    ("units", &["readable"]),
    ("shape", &["geom"]),
    ("spec", &["units"]),
    ("design", &["geom", "shape", "spec", "units"]),
    ("mechanics", &["numerics", "readable"]),
    ("shell", &["geom", "numerics"]),
    ("forecast", &["design", "digest", "mechanics", "numerics", "shell", "spec", "units"]),
    ("airtight", &["design", "forecast", "geom", "shape", "spec", "units"]),
    ("plan", &["design", "geom", "shape", "spec", "units"]),
    ("artifact", &["design", "spec"]),
    ("manifest", &["artifact", "design", "digest", "forecast", "plan", "shape", "spec"]),
    ("link", &[]),
    ("emit", &["design", "forecast", "geom", "link", "manifest", "plan", "shape", "spec", "units"]),
    ("verify", &["artifact", "design", "forecast", "geom", "manifest", "shape", "spec", "units"]),
    ("resume", &["emit", "geom", "plan", "spec", "units", "verify"]),
    ("coupon", &["design", "emit", "geom", "plan", "shape", "spec", "units"]),
    (
        "pipeline",
        &[
            "airtight", "artifact", "coupon", "design", "emit", "forecast", "geom", "link", "manifest",
            "plan", "spec", "units", "verify",
        ],
    ),
    ("answer", &["artifact", "design", "forecast", "mechanics", "pipeline", "spec", "units", "verify"]),
    (
        "cli",
        &[
            "airtight",
            "answer",
            "artifact",
            "coupon",
            "design",
            "digest",
            "emit",
            "forecast",
            "geom",
            "manifest",
            "mechanics",
            "pipeline",
            "plan",
            "resume",
            "shell",
            "spec",
            "units",
            "verify",
        ],
    ),
    ("main", &["cli"]),
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The rooms of this crate and of `inflatable` that a line of code names.
fn rooms_named(line: &str) -> Vec<&str> {
    let code = line.split("//").next().unwrap_or("");
    let after = |word: &'static str| code.split(word).skip(1);
    after("crate::")
        .chain(after("inflatable::"))
        .map(|rest| rest.split(|c: char| !(c.is_alphanumeric() || c == '_')).next().unwrap_or(""))
        .collect()
}

/// Everything in `file` of `room` that the room may not use.
fn trespasses(room: &str, file: &Path, text: &str) -> Vec<String> {
    let allowed = MAY_USE.iter().find(|(name, _)| *name == room).map_or(&[][..], |(_, rooms)| rooms);
    let mut found = Vec::new();
    for (line, number) in text.lines().zip(1..) {
        if line.contains("crate::{") || line.contains("inflatable::{") {
            found.push(format!("{}:{number}: write one `use` a line", file.display()));
        }
        for other in rooms_named(line) {
            if !other.is_empty() && other != room && !allowed.contains(&other) {
                found.push(format!("{}:{number}: {room} must not know {other}", file.display()));
            }
        }
    }
    found
}

fn walk(room: &str, path: &Path, found: &mut Vec<String>) {
    if path.is_dir() {
        for entry in fs::read_dir(path).expect("a directory") {
            walk(room, &entry.expect("an entry").path(), found);
        }
    } else if path.extension().is_some_and(|ending| ending == "rs") {
        found.extend(trespasses(room, path, &fs::read_to_string(path).expect("a source file")));
    }
}

#[test]
fn every_room_knows_only_what_lies_before_it() {
    let mut found = Vec::new();
    for entry in SOURCES.into_iter().flat_map(|source| fs::read_dir(root().join(source)).expect("src/")) {
        let path = entry.expect("an entry").path();
        let room = path.file_stem().expect("a name").to_string_lossy().into_owned();
        if room != "lib" {
            assert!(MAY_USE.iter().any(|(name, _)| *name == room), "say what {room} may use");
            walk(&room, &path, &mut found);
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn a_trespass_is_seen() {
    let file = Path::new("x.rs");
    assert_eq!(trespasses("geom", file, "use crate::design::Star;").len(), 1);
    assert_eq!(trespasses("verify", file, "let x = crate::emit::svg();").len(), 1);
    assert_eq!(trespasses("geom", file, "use crate::{geom, spec};").len(), 1);
    assert_eq!(trespasses("plan", file, "use inflatable::shell::mesh::Mesh;").len(), 1);
    assert!(trespasses("plan", file, "use crate::geom::Point; // not crate::emit").is_empty());
}

/// Only the command line touches files, clocks and the environment.
#[test]
fn only_the_face_touches_the_world() {
    let mut found = Vec::new();
    let worldly = ["std::fs", "std::env::", "std::time", "std::net", "std::process", "jiff"];
    for (room, _) in MAY_USE.iter().filter(|(room, _)| !["cli", "main"].contains(room)) {
        for source in SOURCES.map(|source| root().join(source)) {
            for path in [source.join(room), source.join(format!("{room}.rs"))] {
                if path.exists() {
                    scan(&path, &worldly, &mut found);
                }
            }
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

fn scan(path: &Path, words: &[&str], found: &mut Vec<String>) {
    if path.is_dir() {
        fs::read_dir(path)
            .expect("a directory")
            .for_each(|e| scan(&e.expect("an entry").path(), words, found));
        return;
    }
    let text = fs::read_to_string(path).expect("a source file");
    for (line, number) in text.lines().zip(1..) {
        found.extend(
            words
                .iter()
                .filter(|word| line.contains(**word))
                .map(|w| format!("{}:{number}: {w}", path.display())),
        );
    }
}

/// Two files that depend on each other are one subject in two places, or two in one.
#[test]
fn no_files_know_each_other_in_a_circle() {
    for (source, least) in SOURCES.into_iter().zip([60, 150]) {
        let imports = circles::imports(&root().join(source));
        assert!(imports.len() > least, "only {} files of {source} were read", imports.len());
        let found = circles::circles(&imports);
        assert!(found.is_empty(), "{found:#?}");
    }
}

#[test]
fn a_circle_is_seen() {
    let imports = |pairs: &[(&str, &str)]| -> circles::Imports {
        let mut imports = circles::Imports::new();
        for (file, other) in pairs {
            let _ = imports.entry((*file).to_owned()).or_default().insert((*other).to_owned());
        }
        imports
    };
    assert!(circles::circles(&imports(&[("a", "b"), ("b", "c"), ("a", "c")])).is_empty());
    let round = imports(&[("a", "b"), ("b", "c"), ("c", "b")]);
    let found = circles::circles(&round);
    assert_eq!(found.into_iter().flatten().collect::<Vec<_>>(), ["b", "c"]);
}
