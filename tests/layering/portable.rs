//! Checks that a feature of some systems only is never called without a fallback for the others.

use std::fs;
use std::path::Path;

/// Features of some systems only: modules of the standard library, and a dependency for Linux alone.
const OF_SOME: [&str; 3] = ["std::os::", "rustix::", "libc::"];
/// Most lines between a call and the condition above it.
const NEAR: usize = 3;

/// The lines of `text` that call a feature of some systems only, under no condition.
fn unconditional(text: &str) -> Vec<usize> {
    let lines: Vec<&str> = text.lines().collect();
    let is_call = |line: &str| {
        let code = line.split("//").next().unwrap_or("");
        OF_SOME.iter().any(|name| code.contains(name))
    };
    let is_under_condition = |at: usize| {
        lines[at.saturating_sub(NEAR)..at].iter().any(|line| line.trim_start().starts_with("#[cfg("))
    };
    (0..lines.len()).filter(|at| is_call(lines[*at]) && !is_under_condition(*at)).map(|at| at + 1).collect()
}

fn walk(path: &Path, calls: &mut Vec<String>) {
    if path.is_dir() {
        for entry in fs::read_dir(path).expect("a directory") {
            walk(&entry.expect("an entry").path(), calls);
        }
    } else if path.extension().is_some_and(|ending| ending == "rs") {
        let text = fs::read_to_string(path).expect("a source file");
        calls.extend(unconditional(&text).into_iter().map(|line| format!("{}:{line}", path.display())));
    }
}

#[test]
fn what_only_some_systems_have_stands_under_a_condition() {
    let mut calls = Vec::new();
    for source in super::sources() {
        walk(&source, &mut calls);
    }
    assert!(calls.is_empty(), "write #[cfg(...)] above it, and what is done elsewhere: {}", calls.join(", "));
}

#[test]
fn a_call_without_a_condition_is_seen() {
    assert_eq!(unconditional("fn f() {\n    use std::os::unix::fs::PermissionsExt;\n}\n"), [2]);
    assert!(
        unconditional("#[cfg(unix)]\nfn f() {\n    use std::os::unix::fs::PermissionsExt;\n}\n").is_empty()
    );
    assert!(unconditional("// not std::os::unix\n").is_empty());
}
