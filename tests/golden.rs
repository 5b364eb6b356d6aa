//! Golden files: every output of every shipped design, byte for byte.
//!
//! The snapshots are the real files (`snapshots/<design>@<file>-<ending>.snap.<ending>`). The same snapshots are
//! checked in debug and in release, so both write the same bytes.

use std::fs;
use std::path::Path;

use stargrip_cam::pipeline::{Built, Sources};
use stargrip_cam::spec::Source;
use stargrip_cam::{pipeline, spec};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// (name, text) of every design, sorted by name.
fn designs() -> Vec<(String, String)> {
    let mut designs: Vec<(String, String)> = fs::read_dir(Path::new(ROOT).join("designs"))
        .expect("designs/")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "toml"))
        .map(|path| {
            let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
            (name, fs::read_to_string(&path).expect("a design"))
        })
        .collect();
    designs.sort();
    assert!(designs.len() >= 7, "the shipped designs are not where they should be");
    designs
}

fn build(text: &str) -> Built {
    let reading = spec::read(&Source::new("design", text)).expect("a valid design");
    let machine_text = spec::builtin_machine(&reading.spec.machine.profile).expect("a built-in profile");
    let machine = spec::read_machine(&Source::new("machine", machine_text)).expect("a valid profile");
    let sources = Sources { spec: text, machine: machine_text };
    let build = pipeline::build(&reading.spec, &machine, sources, &[]).expect("a design that can be made");
    let proof = build.proof();
    assert_eq!(proof.findings, []);
    build
}

#[test]
fn every_output_of_every_design_is_golden() {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(Path::new(ROOT).join("snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| {
        for (name, text) in designs() {
            for (file, bytes) in build(&text).files() {
                let (stem, ending) = file.rsplit_once('.').expect("an ending");
                // The spec and the profile are copies of files that are in the repository anyway.
                if ending != "toml" {
                    // insta keeps its own notes beside the real file under a name without the ending.
                    let snapshot = format!("{name}@{stem}-{ending}.{ending}");
                    insta::assert_binary_snapshot!(&snapshot, bytes.into_owned());
                }
            }
        }
    });
}

#[test]
fn a_second_build_gives_the_same_bytes() {
    for (name, text) in designs() {
        let (first, second) = (build(&text), build(&text));
        assert!(first.files().eq(second.files()), "{name} differs between two builds");
    }
}
