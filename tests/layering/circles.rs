//! The imports between files, and circles among them.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The files that each file imports from, by module path ("emit::gcode::writer"), and the children that a room's face (`mod.rs`)
/// calls. An import through a face counts as an import from the defining file; tests do not count.
pub(super) type Imports = BTreeMap<String, BTreeSet<String>>;

/// Reads the imports of every file under `src`.
pub(super) fn imports(src: &Path) -> Imports {
    let texts: BTreeMap<String, String> = files(src)
        .into_iter()
        .map(|file| (module(src, &file), fs::read_to_string(&file).expect("a source file")))
        .collect();
    let of_tests: BTreeSet<String> = texts.iter().flat_map(|(name, text)| test_files(name, text)).collect();
    let texts: BTreeMap<String, String> = texts
        .into_iter()
        .filter(|(name, _)| !of_tests.contains(name))
        .map(|(name, text)| (name, production(&text)))
        .collect();
    let modules: BTreeSet<String> = texts.keys().cloned().collect();
    let home = |path: &str| resolve(path, &modules, &texts, 0);
    texts
        .iter()
        .map(|(name, text)| {
            let imported = uses(name, text).into_iter().filter_map(|path| home(&path));
            (name.clone(), imported.chain(called_children(name, text)).collect())
        })
        .collect()
}

/// The circles of files: sets in which every file depends on every other, directly or through others.
pub(super) fn circles(imports: &Imports) -> BTreeSet<BTreeSet<&str>> {
    let reaches: BTreeMap<&str, BTreeSet<&str>> =
        imports.keys().map(|file| (file.as_str(), reach(file, imports))).collect();
    let circle = |file: &&str| -> BTreeSet<&str> {
        let back = |other: &&str| reaches.get(other).is_some_and(|reached| reached.contains(file));
        reaches[file].iter().copied().filter(back).collect()
    };
    reaches.keys().map(circle).filter(|circle| circle.len() > 1).collect()
}

/// The files on which `file` depends, directly or through others.
fn reach<'a>(file: &str, imports: &'a Imports) -> BTreeSet<&'a str> {
    let mut reachable = BTreeSet::new();
    let mut open: Vec<&str> = imports.get(file).into_iter().flatten().map(String::as_str).collect();
    while let Some(next) = open.pop() {
        if next != file && reachable.insert(next) {
            open.extend(imports.get(next).into_iter().flatten().map(String::as_str));
        } else if next == file {
            let _ = reachable.insert(imports.get_key_value(file).map_or("", |(key, _)| key));
        }
    }
    reachable
}

fn files(path: &Path) -> Vec<PathBuf> {
    if path.is_dir() {
        let entries = fs::read_dir(path).expect("a directory");
        return entries.flat_map(|entry| files(&entry.expect("an entry").path())).collect();
    }
    let is_source = path.extension().is_some_and(|ending| ending == "rs");
    let is_test = path.file_stem().is_some_and(|stem| stem == "tests");
    if is_source && !is_test { vec![path.to_owned()] } else { Vec::new() }
}

fn module(src: &Path, file: &Path) -> String {
    let path = file.strip_prefix(src).expect("below src").with_extension("");
    let mut parts: Vec<String> = path.iter().map(|part| part.to_string_lossy().into_owned()).collect();
    if parts.last().is_some_and(|last| last == "mod") {
        let _ = parts.pop();
    }
    parts.join("::")
}

const OF_TESTS: &str = "#[cfg(test)]\n";

/// The files that the face `name` declares for tests alone.
fn test_files(name: &str, text: &str) -> Vec<String> {
    let declared = text.split(OF_TESTS).skip(1).filter_map(|rest| rest.strip_prefix("mod ")?.split_once(';'));
    let file = |child: &str| if name.is_empty() { child.to_owned() } else { format!("{name}::{child}") };
    declared.filter(|(child, _)| !child.contains(char::is_whitespace)).map(|(child, _)| file(child)).collect()
}

/// The text without its tests: imports and declarations for them alone, and the module at its end.
pub(super) fn production(text: &str) -> String {
    let mut parts = text.split(OF_TESTS);
    let mut shipped = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let line = part.split('\n').next().unwrap_or_default();
        if line.ends_with('{') {
            break;
        }
        shipped.push_str(&part[line.len()..]);
    }
    shipped
}

/// Every path of the crate that the text of the module `module` imports, one a name, whether by `crate::` or by `super::`.
fn uses(module: &str, text: &str) -> Vec<String> {
    let statements = text.split("use ").skip(1).filter_map(|rest| rest.split(';').next());
    statements.filter_map(|path| absolute(module, path)).flat_map(|path| names(&path)).collect()
}

/// `path` as the module `module` writes it, from the root of the crate on; `None` for a path of another crate.
fn absolute(module: &str, path: &str) -> Option<String> {
    if let Some(rest) = path.strip_prefix("crate::") {
        return Some(rest.to_owned());
    }
    let (mut parent, mut rest) = (module, path);
    while let Some(tail) = rest.strip_prefix("super::") {
        (parent, rest) = (parent.rsplit_once("::").map_or("", |(parent, _)| parent), tail);
    }
    let is_relative = rest.len() < path.len();
    is_relative.then(|| if parent.is_empty() { rest.to_owned() } else { format!("{parent}::{rest}") })
}

/// The children that a face calls by name, as in `child::new()`. Re-exporting their items does not count.
fn called_children(face: &str, text: &str) -> Vec<String> {
    let code = |line: &&str| !line.trim_start().starts_with("//") && !line.contains("use ");
    let words: Vec<&str> =
        text.lines().filter(code).flat_map(|line| line.split(|c: char| !is_of_path(c))).collect();
    let children = text.lines().filter_map(|line| line.split_once("mod ")?.1.strip_suffix(';'));
    let named =
        |child: &&str| words.iter().any(|word| word.split_once("::").is_some_and(|(head, _)| head == *child));
    children.filter(named).map(|child| format!("{face}::{child}")).collect()
}

fn is_of_path(c: char) -> bool {
    c.is_alphanumeric() || c == '_' || c == ':'
}

/// "a::{B, C}" as "a::B", "a::C".
fn names(path: &str) -> Vec<String> {
    let path: String = path.split_whitespace().collect::<Vec<_>>().join(" ");
    match path.split_once("::{") {
        Some((head, list)) => {
            let list = list.trim_end_matches('}').split(',').map(str::trim).filter(|name| !name.is_empty());
            list.map(|name| if name == "self" { head.to_owned() } else { format!("{head}::{name}") })
                .collect()
        }
        None => vec![path],
    }
}

/// The file in which `path` is written.
fn resolve(
    path: &str,
    modules: &BTreeSet<String>,
    texts: &BTreeMap<String, String>,
    depth: usize,
) -> Option<String> {
    if modules.contains(path) || depth > 5 {
        return modules.contains(path).then(|| path.to_owned());
    }
    let (head, name) = path.rsplit_once("::")?;
    let Some(text) = texts.get(head) else { return resolve(head, modules, texts, depth + 1) };
    // A face that re-exports the name has `pub use child::name` or `pub use child::{..., name}`.
    let handed = text.split("pub use ").skip(1).filter_map(|rest| rest.split(';').next()).flat_map(names);
    for other in handed {
        let plain = other.split(" as ").last().unwrap_or_default();
        if plain.rsplit("::").next() == Some(name) {
            let inner = other.split(" as ").next().unwrap_or_default();
            return resolve(&format!("{head}::{inner}"), modules, texts, depth + 1);
        }
    }
    Some(head.to_owned())
}

#[test]
fn imports_by_super_are_seen() {
    let text = "use super::super::b::C;\nuse super::D;\nuse crate::e::F;\nuse geom::Point;\n";
    assert_eq!(uses("x::y::z", text), ["x::b::C", "x::y::D", "e::F"]);
}

#[test]
fn a_call_to_a_child_is_seen_and_handing_on_is_not() {
    let face = "mod a;\nmod b;\n#[cfg(test)]\nmod c;\n\npub use a::A;\n\nfn f() {\n    b::g();\n}\n";
    assert_eq!(called_children("room", face), ["room::b"]);
    assert_eq!(test_files("room", face), ["room::c"]);
    assert!(!production(face).contains("mod c"), "{}", production(face));
    assert!(production(face).contains("b::g()"));
}
