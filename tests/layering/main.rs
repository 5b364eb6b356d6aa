//! Data flows one way: the crates that each crate may use, and the rooms that each room of a crate may use.
//!
//! Cargo refuses a circle of crates; the table here refuses an arrow that nobody decided on. Imports are written
//! `use crate::room::{A, B};`, a line a module, so the dependencies of a file can be read from its lines.

mod circles;
mod names;
mod packages;
mod portable;
mod source;
mod words;

use std::fs;
use std::path::{Path, PathBuf};

/// The shipped crates from the ground up: (folder, the crates of this workspace that it may use).
const CRATES: [(&str, &[&str]); 12] = [
    ("crates/geom", &[]),
    ("crates/artwork", &["geom"]),
    ("crates/sealed", &["geom"]),
    ("crates/inflatable", &["geom"]),
    ("crates/spec", &["artwork", "geom"]),
    ("crates/design", &["artwork", "geom", "sealed", "spec"]),
    ("crates/forecast", &["design", "geom", "inflatable", "sealed", "spec"]),
    ("crates/program", &["design", "geom", "sealed", "spec"]),
    ("crates/proof", &["artwork", "design", "geom", "sealed", "spec"]),
    (".", &["artwork", "design", "forecast", "geom", "inflatable", "program", "proof", "sealed", "spec"]),
    ("python", &["stargrip-cam"]),
    ("web", &["stargrip-cam"]),
];

/// The crates that are not shipped.
const TOOLS: [&str; 2] = ["crates/research", "crates/benches"];

/// (crate, room, the rooms of that crate that it may use). A room is a directory or file directly in the crate's `src`.
const ROOMS: [(&str, &str, &[&str]); 19] = [
    ("crates/inflatable", "numerics", &[]),
    ("crates/inflatable", "mechanics", &["numerics"]),
    ("crates/inflatable", "shell", &["numerics"]),
    ("crates/program", "plan", &[]),
    ("crates/program", "number", &[]),
    ("crates/program", "text", &[]),
    ("crates/program", "gcode", &["number", "plan", "text"]),
    ("crates/proof", "artifact", &[]),
    ("crates/proof", "manifest", &["artifact"]),
    ("crates/proof", "verify", &["artifact", "manifest"]),
    (".", "airtight", &[]),
    (".", "manifest", &[]),
    (".", "link", &[]),
    (".", "emit", &["link", "manifest"]),
    (".", "resume", &["emit"]),
    (".", "coupon", &["emit"]),
    (".", "pipeline", &["airtight", "coupon", "emit", "link", "manifest"]),
    (".", "answer", &["pipeline"]),
    (".", "cli", &["airtight", "answer", "coupon", "emit", "manifest", "pipeline", "resume"]),
];

/// Words of the standard library and of dependencies that touch files, clocks, processes and the environment.
const WORLD: [&str; 6] = ["std::fs", "std::env::", "std::time", "std::net", "std::process", "jiff"];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The sources of every crate of the workspace but the benchmarks, which have none.
fn sources() -> impl Iterator<Item = PathBuf> {
    let folders = CRATES.iter().map(|(folder, _)| *folder).chain(TOOLS);
    folders.map(|folder| root().join(folder).join("src")).filter(|source| source.exists())
}

/// Every source file at or below `path`, in the order of the alphabet.
fn rust_files(path: &Path) -> Vec<PathBuf> {
    if path.is_dir() {
        let entries = fs::read_dir(path).expect("a directory").map(|entry| entry.expect("an entry").path());
        let mut entries: Vec<PathBuf> = entries.collect();
        entries.sort();
        return entries.iter().flat_map(|entry| rust_files(entry)).collect();
    }
    if path.extension().is_some_and(|ending| ending == "rs") { vec![path.to_owned()] } else { Vec::new() }
}

fn text_of(file: &Path) -> String {
    fs::read_to_string(file).expect("a source file")
}

/// The crates of this workspace among the dependencies of the manifest `toml`.
fn workspace_dependencies(toml: &str) -> Vec<&str> {
    let section = toml.split("\n[dependencies]\n").nth(1).unwrap_or("").split("\n[").next().unwrap_or("");
    section
        .lines()
        .filter_map(|line| line.split(['.', ' ', '=']).next())
        .filter(|name| *name == "stargrip-cam" || root().join("crates").join(name).exists())
        .collect()
}

#[test]
fn every_crate_uses_only_what_lies_below_it() {
    for (folder, allowed) in CRATES {
        let toml = text_of(&root().join(folder).join("Cargo.toml"));
        let dependencies = workspace_dependencies(&toml);
        let wrong: Vec<&&str> = dependencies.iter().filter(|name| !allowed.contains(name)).collect();
        assert!(wrong.is_empty(), "{folder} must not use {wrong:?}");
        let unused: Vec<&&str> = allowed.iter().filter(|name| !dependencies.contains(name)).collect();
        assert!(unused.is_empty(), "{folder} does not use {unused:?}: take it out of CRATES");
    }
    let folders = fs::read_dir(root().join("crates")).expect("crates/");
    for folder in folders.map(|entry| format!("crates/{}", entry.expect("an entry").file_name().display())) {
        let is_listed =
            CRATES.iter().any(|(listed, _)| *listed == folder) || TOOLS.contains(&folder.as_str());
        assert!(is_listed, "say what {folder} may use");
    }
}

/// The rooms of its own crate that a line of code names.
fn rooms_named(line: &str) -> Vec<&str> {
    let code = line.split("//").next().unwrap_or("");
    code.split("crate::")
        .skip(1)
        .map(|rest| rest.split(|c: char| !(c.is_alphanumeric() || c == '_')).next().unwrap_or(""))
        .collect()
}

/// Everything in `file` of `room` that the room, which may use the rooms `allowed`, may not use.
fn trespasses(room: &str, allowed: &[&str], file: &Path, text: &str) -> Vec<String> {
    let mut trespasses = Vec::new();
    for (line, number) in text.lines().zip(1..) {
        if line.contains("crate::{") {
            trespasses.push(format!("{}:{number}: write one `use` a line", file.display()));
        }
        for other in rooms_named(line) {
            if !other.is_empty() && other != room && !allowed.contains(&other) {
                trespasses.push(format!("{}:{number}: {room} must not know {other}", file.display()));
            }
        }
    }
    trespasses
}

#[test]
fn every_room_knows_only_what_lies_before_it() {
    let mut faults = Vec::new();
    for folder in ["crates/inflatable", "crates/program", "crates/proof", "."] {
        for entry in fs::read_dir(root().join(folder).join("src")).expect("src/") {
            let path = entry.expect("an entry").path();
            let room = path.file_stem().expect("a name").to_string_lossy().into_owned();
            if room == "lib" || room == "main" {
                continue;
            }
            let row = ROOMS.iter().find(|(of, name, _)| *of == folder && *name == room);
            let (_, _, allowed) = row.unwrap_or_else(|| panic!("say what {room} of {folder} may use"));
            for file in rust_files(&path) {
                faults.extend(trespasses(&room, allowed, &file, &text_of(&file)));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn a_trespass_is_seen() {
    let file = Path::new("x.rs");
    assert_eq!(trespasses("verify", &["artifact"], file, "use crate::plan::Program;").len(), 1);
    assert_eq!(trespasses("verify", &[], file, "let x = crate::emit::svg();").len(), 1);
    assert_eq!(trespasses("plan", &["number"], file, "use crate::{number, text};").len(), 1);
    assert!(trespasses("gcode", &["plan"], file, "use crate::plan::Pace; // not crate::emit").is_empty());
    let toml = "[package]\n\n[dependencies]\ngeom.workspace = true\nproof = { path = \"x\" }\nlibm = \"0.2\"\n\n[lints]\nx = 1\n";
    assert_eq!(workspace_dependencies(toml), ["geom", "proof"]);
}

/// Only the command line touches files, clocks and the environment.
#[test]
fn only_the_face_touches_the_world() {
    let mut faults = Vec::new();
    for (folder, _) in CRATES.iter().filter(|(folder, _)| !["python", "web"].contains(folder)) {
        let source = root().join(folder).join("src");
        let files = rust_files(&source).into_iter();
        for file in files.filter(|file| !file.starts_with(source.join("cli")) && !file.ends_with("main.rs")) {
            for (line, number) in text_of(&file).lines().zip(1..) {
                let words = WORLD.iter().filter(|word| line.contains(**word));
                faults.extend(words.map(|word| format!("{}:{number}: {word}", file.display())));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Whether a text in the line `code` names an option, as in "use --anyway".
fn names_option(code: &str) -> bool {
    let text = code.trim_start();
    let parts: Vec<&str> = text.split("--").collect();
    !text.starts_with("//")
        && parts.windows(2).any(|around| {
            around[0].ends_with([' ', '`', '"', '\''])
                && around[1].starts_with(|c: char| c.is_ascii_lowercase())
        })
}

/// A message of a lower room is read on a page and in an exception of Python, too: there are no options.
#[test]
fn only_the_command_names_its_options() {
    assert!(names_option(r#"  "give it, or use --anyway""#) && !names_option("/// `--anyway`"));
    let mut faults = Vec::new();
    let rooms = sources().filter(|source| !source.starts_with(root().join("python")));
    for file in rooms.flat_map(|source| rust_files(&source)) {
        if file.starts_with(root().join("src/cli")) || is_tool(&file) {
            continue;
        }
        let text = circles::production(&text_of(&file));
        let lines = text.lines().filter(|line| names_option(line));
        faults.extend(lines.map(|line| format!("{}: {}", file.display(), line.trim())));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Whether `file` belongs to a crate that is not shipped.
fn is_tool(file: &Path) -> bool {
    TOOLS.iter().any(|tool| file.starts_with(root().join(tool)))
}

/// Two files that depend on each other are one subject in two places, or two in one.
#[test]
fn no_files_know_each_other_in_a_circle() {
    let mut count = 0;
    for source in sources() {
        let imports = circles::imports(&source);
        count += imports.len();
        let circles = circles::circles(&imports);
        assert!(circles.is_empty(), "{}: {circles:#?}", source.display());
    }
    assert!(count > 500, "only {count} files were read");
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
    let files = circles::circles(&round);
    assert_eq!(files.into_iter().flatten().collect::<Vec<_>>(), ["b", "c"]);
}
