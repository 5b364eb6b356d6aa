//! Tables appear whole, replace nothing but tables, and have the same bytes in a file and on standard output.

use std::fs;

use super::{STUDY, done, folder, names, refused, run, text};

#[test]
fn a_table_is_the_same_in_a_file_and_by_one_thread() {
    let dir = folder(STUDY);
    let at = dir.path();
    for more in [&[][..], &["--units"][..]] {
        let whole = done(at, &[&["sweep", "study.toml"], more].concat());
        assert_eq!(whole.lines().count(), 217 + more.len());
        let _ = done(at, &[&["sweep", "study.toml", "-o", "whole.csv", "--threads", "1"], more].concat());
        assert_eq!(fs::read_to_string(at.join("whole.csv")).expect("written"), whole);
    }
}

/// Parts are computed by the Python package.
#[test]
fn parts_and_joins_are_unknown() {
    let dir = folder(STUDY);
    for args in [&["sweep", "study.toml", "--part", "1/2"][..], &["study", "join", "parts", "-o", "x.csv"]] {
        let said = refused(dir.path(), args, 2);
        assert!(said.contains("unexpected argument") || said.contains("unrecognized subcommand"), "{said}");
    }
}

/// A spec, a study, a program: a table replaces nothing but a table.
#[test]
fn a_file_that_is_no_table_is_not_replaced() {
    let dir = folder(STUDY);
    let at = dir.path();
    let before = fs::read_to_string(at.join("study.toml")).expect("it");
    let said = refused(at, &["study", "run", "study.toml", "-o", "study.toml"], 1);
    assert!(said.contains("study.toml exists and is not a table of a study"), "{said}");
    for _ in 0..2 {
        let _ = done(at, &["study", "run", "study.toml", "-o", "table.csv"]);
    }
    assert_eq!(fs::read_to_string(at.join("study.toml")).expect("it"), before);
}

/// Rows of `section` would have the labels of other models.
#[test]
fn models_that_only_a_study_file_computes_are_not_varied() {
    let dir = folder(STUDY);
    let at = dir.path();
    let vary = |models: &str| {
        let models = format!("accuracy.model={models}");
        run(at, &["study", "run", "spec.toml", "--vary", &models])
    };
    for models in ["section,bvp", "shell"] {
        let refused = vary(models);
        assert_eq!((refused.status.code(), refused.stdout.len()), (Some(1), 0), "{models}");
    }
    assert_eq!(vary("section,ring,auto").status.code(), Some(0));
}

#[test]
fn a_study_says_what_it_asks_for() {
    let dir = folder(STUDY);
    let said = done(dir.path(), &["study", "show", "study.toml"]);
    assert!(said.starts_with("216 rows\n"), "{said}");
    let line = |name: &str| {
        said.lines().find(|line| line.starts_with(name)).unwrap_or_else(|| panic!("{name}: {said}"))
    };
    assert_eq!(line("star.tube_width_mm").split_whitespace().nth(1), Some("mm"));
    assert!(line("bendability").contains("1/eps") && line("refused_code").contains("text"));
}

/// The error of a full file system: here, files may have no more than 4 KiB.
#[cfg(unix)]
#[test]
fn a_disk_that_is_full_is_said_and_nothing_is_left() {
    let dir = folder(STUDY);
    let at = dir.path();
    let full = |rest: &str| {
        let program = env!("CARGO_BIN_EXE_stargrip-cam");
        let script = format!("trap '' XFSZ; ulimit -f 8; exec {program} {rest}");
        let output = std::process::Command::new("sh").current_dir(at).args(["-c", &script]).output();
        let output = output.expect("a shell");
        assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
        text(&output.stderr)
    };
    let said = full("sweep study.toml -o out.csv");
    assert!(said.contains("cannot write out.csv"), "{said}");
    assert_eq!(names(at), ["spec.toml", "study.toml"]);
    // The earlier file is unchanged.
    fs::write(at.join("out.csv"), "before").expect("written");
    let _ = full("sweep study.toml -o out.csv");
    assert_eq!(fs::read_to_string(at.join("out.csv")).expect("there"), "before");
    let said = refused(at, &["sweep", "study.toml", "-o", "spec.toml/x.csv"], 1);
    assert!(said.contains("cannot write"), "{said}");
}

#[test]
fn parquet_is_refused_with_the_function_that_writes_it() {
    let dir = folder(STUDY);
    let refusals: [&[&str]; 2] =
        [&["sweep", "study.toml", "-o", "whole.parquet"], &["sweep", "study.toml", "--format", "parquet"]];
    for args in refusals {
        let said = refused(dir.path(), args, 1);
        assert!(said.contains("ends in .csv"), "{said}");
        assert!(said.contains("stargrip_cam.sweep_to_parquet("), "{said}");
    }
    assert_eq!(names(dir.path()), ["spec.toml", "study.toml"]);
}
