//! The seeds of the fuzz targets, and the cases that once failed, through the targets' own functions.
//!
//! `make fuzz` lets a fuzzer look further (docs/reliability.md).

#[expect(unreachable_pub, reason = "the fuzz targets have it as a library")]
#[path = "../../fuzz/src/lib.rs"]
mod fuzz;

use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz")
}

fn files(dir: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(dir).unwrap_or_else(|error| panic!("{}: {error}", dir.display()));
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    paths
}

#[test]
fn every_seed_passes_its_target() {
    for (name, _) in fuzz::TARGETS {
        let seeds = files(&root().join("corpus").join(name));
        assert!(!seeds.is_empty(), "{name} has no seed");
        for seed in seeds {
            let bytes = fs::read(&seed).expect("a seed");
            let run = std::panic::catch_unwind(|| fuzz::run(name, &bytes));
            assert!(run.is_ok(), "{}", seed.display());
        }
    }
}

#[test]
fn every_target_can_be_fuzzed() {
    let mut named: Vec<String> = fuzz::TARGETS.iter().map(|(name, _)| (*name).to_owned()).collect();
    named.sort();
    let stem = |path: &PathBuf| path.file_stem().expect("a name").to_string_lossy().into_owned();
    let targets: Vec<String> = files(&root().join("fuzz_targets")).iter().map(stem).collect();
    assert_eq!(targets, named);
    let manifest = fs::read_to_string(root().join("Cargo.toml")).expect("a manifest");
    for name in named {
        let text = fs::read_to_string(root().join(format!("fuzz_targets/{name}.rs"))).expect("a target");
        assert!(text.contains(&format!("run(\"{name}\", bytes)")), "{name}");
        assert!(manifest.contains(&format!("name = \"{name}\"")), "{name}");
    }
}
