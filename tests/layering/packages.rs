//! Checks that each published crate compiles from its package alone, and that a release has one version.

use std::path::{Component, Path, PathBuf};

use super::{CRATES, root, rust_files, text_of};

/// The macros that put a file of the sources into the program.
const INCLUDES: [&str; 2] = ["include_str!(", "include_bytes!("];
/// Folders of the root that its package leaves out.
const LEFT_OUT: [&str; 6] = ["crates", "fuzz", "python", "snapshots", "tests", "web"];

/// The paths that `text` includes outside of its tests, which no package has; of a composed path its beginning.
fn included(text: &str) -> Vec<&str> {
    let shipped = text.split("#[cfg(test)]").next().unwrap_or("");
    let calls = INCLUDES.iter().flat_map(|name| shipped.split(*name).skip(1));
    calls.filter_map(|arguments| arguments.split('"').nth(1)).collect()
}

/// `path` without `..`, as far as its own names allow.
fn normal(path: &Path) -> PathBuf {
    let mut normal = PathBuf::new();
    for part in path.components() {
        if part == Component::ParentDir {
            assert!(normal.pop(), "above the root: {}", path.display());
        } else {
            normal.push(part);
        }
    }
    normal
}

#[test]
fn a_crate_includes_only_files_of_its_package() {
    for (folder, _) in CRATES.iter().filter(|(folder, _)| !LEFT_OUT.contains(folder)) {
        let package = normal(&root().join(folder));
        for file in rust_files(&package.join("src")) {
            for path in included(&text_of(&file)) {
                let target = normal(&file.parent().expect("a folder").join(path));
                let inside = target.strip_prefix(&package).unwrap_or_else(|_| {
                    panic!(
                        "{} includes {}, which its package does not have",
                        file.display(),
                        target.display()
                    )
                });
                assert!(
                    *folder != "." || !LEFT_OUT.iter().any(|name| inside.starts_with(name)),
                    "{} includes {}, which the package leaves out",
                    file.display(),
                    inside.display()
                );
            }
        }
    }
}

#[test]
fn an_included_path_is_read_from_its_call() {
    let text = "const A: &str = include_str!(\"../a.txt\");\nlet b = include_bytes!(concat!(\"../b/\", $name));\n\
                #[cfg(test)] const C: &str = include_str!(\"../../c\");";
    assert_eq!(included(text), ["../a.txt", "../b/"]);
    assert_eq!(normal(Path::new("/crate/src/x/../../a.txt")), Path::new("/crate/a.txt"));
}

#[test]
fn the_citation_has_the_version_of_the_program() {
    let citation = text_of(&root().join("CITATION.cff"));
    let line = concat!("version: ", env!("CARGO_PKG_VERSION"));
    assert!(citation.lines().any(|text| text == line), "CITATION.cff has no line {line:?}");
}
