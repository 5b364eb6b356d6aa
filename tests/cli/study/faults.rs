//! Messages about study files with unknown keys and values.

use stargrip_cam::forecast::study::Study;
use stargrip_cam::spec::Source;
use stargrip_cam::spec::study::read_study;

use super::{SPEC, folder, refused};

/// Code and text of every fault of a study.
fn faults(text: &str) -> Vec<(String, String)> {
    let source = Source::new("study.toml", text);
    let found = read_study(&source).and_then(|file| Study::new(&file, &Source::new("spec.toml", SPEC)));
    let faults = found.err().unwrap_or_else(|| panic!("accepted:\n{text}"));
    let said = |fault: &stargrip_cam::spec::Fault| {
        let help = fault.help.as_deref().unwrap_or_default();
        (fault.code.to_owned(), format!("{}: {} ({help})", fault.message, fault.label))
    };
    faults.list().iter().map(said).collect()
}

/// A study with `rest` after its first lines.
fn with(rest: &str) -> String {
    format!("schema = 1\nspec = \"spec.toml\"\n{rest}")
}

/// Asserts that each study is refused with this code and this text.
fn refuses(cases: &[(String, &str, &str)]) {
    for (text, code, words) in cases {
        let found = faults(text);
        assert!(
            found.iter().any(|(own, said)| own == code && said.contains(words)),
            "{text}\n{code}: {words}\n{found:?}"
        );
    }
}

#[test]
fn keys_of_processes_are_refused_with_what_is_allowed() {
    refuses(&[
        (
            with("[vary]\nprocess.weka.strength = [\"1 N/mm\"]\n"),
            "unknown-process",
            "the spec has no process `weka`: must be the name of a section [process.NAME] of the spec",
        ),
        (
            with("[vary]\nprocess.weak.sped = [\"1 mm/s\"]\n"),
            "unknown-key",
            "did you mean `process.weak.speed`?",
        ),
        (with("[vary]\nprocess.speed = [\"1 mm/s\"]\n"), "unknown-key", "did you mean `process.NAME.speed`?"),
    ]);
}

#[test]
fn every_fault_says_what_was_found_and_what_is_allowed() {
    let vary = "[vary]\nstar.points = [4]\n";
    let cases = [
        (with("[vary]\nstar.tube_widht = [\"3 mm\"]\n"), "unknown-key", "did you mean `star.tube_width`?"),
        (with("[vary.star]\ntube_widht = [\"3 mm\"]\n"), "unknown-key", "did you mean `star.tube_width`?"),
        (with("[vary]\ntube_width = [\"3 mm\"]\n"), "unknown-key", "did you mean `star.tube_width`?"),
        (with("[vary]\n\"stack.star\" = [1]\n"), "unknown-key", "`stack.star` cannot be set by a study"),
        (with(&format!("vray = 1\n{vary}")), "unknown-key", "unknown key `vray`"),
        (with(&format!("{vary}[sett]\nx = 1\n")), "unknown-section", "did you mean [set]?"),
        (
            with("[vary]\nstar.points = 4\n"),
            "wrong-type",
            "must be a list, [a, b, c], or \"FROM..TO/COUNT\" (a single fixed value belongs in [set])",
        ),
        (with("[vary]\nstar.points = []\n"), "out-of-range", "must hold at least one value"),
        (with("[vary]\nstar.points = [2]\n"), "out-of-range", "`points` is 2: must be from 3 to 64"),
        (with("[vary]\nstar.tube_width = [30]\n"), "no-unit", "a length needs a unit"),
        (with("[vary]\nstar.tube_width = [\"30 kPa\"]\n"), "unknown-unit", "is not a unit of length"),
        (with("[vary]\nstar.tube_width = \"10 mm..40 mm\"\n"), "out-of-range", "lacks the number of values"),
        (
            with("[vary]\nstar.points = \"3..6/3\"\n"),
            "out-of-range",
            "choose the number of values so that all are whole",
        ),
        (
            with("[vary]\nmask.mirror = \"true..false/2\"\n"),
            "out-of-range",
            "takes no numbers: list its values",
        ),
        (
            with(&format!("[set]\nstar.points = 4\n{vary}")),
            "conflict",
            "set sets it already (delete one of them)",
        ),
        (
            with(&format!("model = \"ring\"\n[set]\naccuracy.model = \"fit\"\n{vary}")),
            "conflict",
            "model sets it already",
        ),
        (
            with("[set]\nload.object_radius = \"40 mm\"\n[vary]\nload.object_diameter = [\"70 mm\"]\n"),
            "conflict",
            "`load.object_diameter` is set besides `load.object_radius`, the same size",
        ),
        (
            with(&format!("[set]\nstar.inner_radius = \"-1 mm\"\n{vary}")),
            "out-of-range",
            "must be at least 0.001 mm",
        ),
        (with(&format!("[set]\ninlet.tip = 6\n{vary}")), "out-of-range", "the inlet is at tip 6"),
        (
            with("[rows]\nstar.points = [4, 5]\nload.friction = [0.5]\n"),
            "cell-count",
            "must have 2, as `star.points`",
        ),
        (with("[draw]\ncount = 10\n"), "missing-key", "between"),
        (
            with("[draw]\ncount = 0\n[draw.between]\nload.friction = \"0.1..1\"\n"),
            "out-of-range",
            "must be from 1 to 1000000000",
        ),
        (
            with("[draw]\ncount = 9\nmethod = \"sobol\"\n[draw.between]\nload.friction = \"0.1..1\"\n"),
            "unknown-choice",
            "\"latin\", \"random\"",
        ),
        (
            with("[draw]\ncount = 9\n[draw.between]\nload.friction = \"1..0.1\"\n"),
            "out-of-range",
            "the range is descending",
        ),
        (
            with("[draw]\ncount = 9\n[draw.between]\nload.friction = [0.1, 1]\n"),
            "out-of-range",
            "must be a text, \"FROM..TO\"",
        ),
        (with(&format!("model = \"sectoin\"\n{vary}")), "unknown-choice", "did you mean \"section\"?"),
        (
            with(&format!("outputs = [\"final_radius\"]\n{vary}")),
            "no-column",
            "did you mean \"final_radius_mm\"?",
        ),
        (with(&format!("outputs = [\"stretch\", \"stretch\"]\n{vary}")), "two-columns", "it is named twice"),
        (with(&format!("outputs = \"stretch\"\n{vary}")), "wrong-type", "must be a list of texts"),
        (with(""), "missing-key", "nothing is varied: a study needs [vary], [rows] or [draw]"),
        (format!("schema = 2\nspec = \"spec.toml\"\n{vary}"), "schema", "the only version"),
        (format!("schema = 1\n{vary}"), "missing-key", "spec"),
        (format!("schema = 1\nspec = \"\"\n{vary}"), "name", "must be the path of a spec"),
        (with("[vary\n"), "syntax", ""),
    ];
    refuses(&cases);
}

#[test]
fn what_only_shells_know_is_asked_of_shells() {
    let vary = "[vary]\nstar.points = [4]\n";
    refuses(&[
        (
            with(&format!("fineness = \"coarse\"\n{vary}")),
            "conflict",
            "`fineness` is for shells only: no row of this study computes a shell",
        ),
        (with(&format!("model = \"shell\"\nfineness = \"finest\"\n{vary}")), "unknown-choice", "\"fine\""),
        (with(&format!("outputs = [\"volume_mm3\"]\n{vary}")), "no-column", "only shells have this column"),
        (
            with(&format!("model = \"shell\"\noutputs = [\"final_radius_lo_mm\"]\n{vary}")),
            "no-column",
            "shells have no such column",
        ),
    ]);
}

#[test]
fn too_many_rows_are_refused_before_anything_is_computed() {
    let thousand = "[vary]\nload.pressure = \"1 kPa..2 kPa/1000\"\nload.friction = \"1..2/1000\"\nstar.tip_angle = \"30 deg..40 deg/1001\"\n";
    let found = faults(&with(thousand));
    assert_eq!(found, [("out-of-range".to_owned(), "more than 1000000000 rows:  ()".to_owned())]);
}

#[test]
fn faults_show_the_line_and_the_place() {
    let dir = folder("schema = 1\nspec = \"spec.toml\"\n[vary]\nstar.points = [4, 5, 66]\n");
    let said = refused(dir.path(), &["sweep", "study.toml"], 1);
    assert!(said.contains("study.toml:4:22") && said.contains("must be from 3 to 64"), "{said}");
    assert!(said.contains("star.points = [4, 5, 66]") && said.contains("^^"), "{said}");
    let said = refused(dir.path(), &["sweep", "spec.toml"], 2);
    assert!(said.contains("varies no key: name a study file, or use `study run` with --vary"), "{said}");
    let said = refused(dir.path(), &["sweep", "spec.toml", "--vary", "star.pionts=4"], 1);
    assert!(said.contains("did you mean `star.points`?"), "{said}");
}
