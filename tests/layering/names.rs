//! One name, one type: a type name that is defined in two places has two meanings, and a reader has to find out which.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// File by file, the types that are defined under each name; tests do not count.
pub(crate) type Definitions = BTreeMap<String, Vec<String>>;

/// Adds the types that `text` of `file` defines: structs, enums, traits, type aliases, associated types.
pub(crate) fn define(found: &mut Definitions, file: &str, text: &str) {
    for line in text.lines().map(str::trim_start).take_while(|line| !line.starts_with("mod tests")) {
        let mut words = line.split([' ', '<', '(', '{', ';', ':', '=']).filter(|word| !word.is_empty());
        let mut word = words.next();
        if word == Some("pub") {
            word = words.next();
            // "pub(super)" and "pub(in crate::cli)" are split into words, too.
            while word.is_some_and(|word| word.ends_with(')') || ["in", "crate"].contains(&word)) {
                word = words.next();
            }
        }
        if matches!(word, Some("struct" | "enum" | "trait" | "type"))
            && let Some(name) = words.next().filter(|name| name.starts_with(char::is_uppercase))
        {
            found.entry(name.to_owned()).or_default().push(file.to_owned());
        }
    }
}

/// The types of all files below `path`.
pub(crate) fn defined(found: &mut Definitions, path: &Path) {
    let mut entries: Vec<_> = fs::read_dir(path).expect("a directory").map(|e| e.expect("an entry").path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            defined(found, &path);
        } else if path.extension().is_some_and(|ending| ending == "rs")
            && path.file_name().is_some_and(|name| name != "tests.rs")
        {
            let text = fs::read_to_string(&path).expect("a source file");
            define(found, &path.to_string_lossy(), &text);
        }
    }
}

/// Names that more than one type has.
pub(crate) fn doubled(found: Definitions) -> Definitions {
    found.into_iter().filter(|(_, files)| files.len() > 1).collect()
}
