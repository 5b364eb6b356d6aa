//! Parts are complete files, continue after an interruption, and join into the whole.

use std::fs;

use super::{STUDY, done, folder, names, refused, run, text};

#[test]
fn parts_stand_alone_and_join_to_the_whole() {
    let dir = folder(STUDY);
    let at = dir.path();
    for more in [&[][..], &["--units"][..]] {
        let whole = done(at, &[&["sweep", "study.toml"], more].concat());
        assert_eq!(whole.lines().count(), 217 + more.len());
        let file = |args: &[&str], name: &str| {
            let _ = done(at, &[&["sweep", "study.toml", "-o", name], args, more].concat());
        };
        file(&[], "whole.csv");
        assert_eq!(fs::read_to_string(at.join("whole.csv")).expect("written"), whole);
        // On standard output only the first has the header.
        let piped =
            ["1/2", "2/2"].map(|part| done(at, &[&["sweep", "study.toml", "--part", part], more].concat()));
        assert_eq!(piped.concat(), whole);
        let parts = format!("parts{}", more.len());
        file(&["--part", "2/3"], &parts);
        file(&["--part", "3/3", "--threads", "1"], &parts);
        let said = refused(at, &["study", "join", &parts, "-o", "joined.csv"], 1);
        assert!(said.contains("1 of 3 parts are missing: 1; compute them with --part k/3"), "{said}");
        assert!(!at.join("joined.csv").exists());
        file(&["--parts", "3"], &parts);
        let expected =
            ["1", "2", "3"].map(|k| [format!("part-{k}-of-3.csv"), format!("part-{k}-of-3.json")]).concat();
        assert_eq!(names(&at.join(&parts)), expected);
        for (k, rows) in [("1", 0..72), ("2", 72..144), ("3", 144..216)] {
            let part =
                fs::read_to_string(at.join(&parts).join(format!("part-{k}-of-3.csv"))).expect("written");
            let mut lines = part.lines().filter(|line| !line.starts_with('#'));
            assert_eq!(lines.next(), whole.lines().next(), "every part has the header");
            let numbers: Vec<&str> = lines.map(|line| line.split(',').next().expect("a row")).collect();
            assert_eq!(numbers, rows.map(|row| row.to_string()).collect::<Vec<_>>());
        }
        let _ = done(at, &["study", "join", &parts, "-o", "joined.csv"]);
        assert_eq!(fs::read_to_string(at.join("joined.csv")).expect("written"), whole);
        fs::remove_file(at.join("joined.csv")).expect("removed");
    }
}

/// The rows of three parts and of four are the same, but a directory holds one division: `run` refuses the second, and `join` says so of
/// files that were copied together.
#[test]
fn two_divisions_of_a_study_are_not_mixed() {
    let dir = folder(STUDY);
    let at = dir.path();
    let _ = done(at, &["study", "run", "study.toml", "--parts", "3", "-o", "parts"]);
    let said = refused(at, &["study", "run", "study.toml", "--parts", "4", "-o", "parts"], 1);
    assert!(said.contains("of-3.csv is one of 3 parts, and this run is of 4"), "{said}");
    let _ = done(at, &["study", "run", "study.toml", "--parts", "4", "-o", "others"]);
    for name in names(&at.join("others")) {
        let _ = fs::copy(at.join("others").join(&name), at.join("parts").join(&name)).expect("copied");
    }
    let said = refused(at, &["study", "join", "parts", "-o", "joined.csv"], 1);
    assert!(said.contains("part-4-of-4.csv are of 4 parts, and part-1-of-3.csv is of 3: move one"), "{said}");
    assert!(!said.contains("not a part of this study"), "{said}");
}

/// A spec, a study, a program: a table replaces nothing but a table.
#[test]
fn a_file_that_is_no_table_is_not_replaced() {
    let dir = folder(STUDY);
    let at = dir.path();
    let _ = done(at, &["study", "run", "study.toml", "--parts", "2", "-o", "parts"]);
    let before = fs::read_to_string(at.join("study.toml")).expect("it");
    for args in [&["study", "run", "study.toml"][..], &["study", "join", "parts"]] {
        let said = refused(at, &[args, &["-o", "study.toml"]].concat(), 1);
        assert!(said.contains("study.toml exists and is not a table of a study"), "{said}");
        let _ = done(at, &[args, &["-o", "table.csv"]].concat());
        let _ = done(at, &[args, &["-o", "table.csv"]].concat());
    }
    assert_eq!(fs::read_to_string(at.join("study.toml")).expect("it"), before);
    for name in ["parts/part-1-of-2.csv", "parts/part-3-of-2.csv"] {
        let kept = names(&at.join("parts"));
        let said = refused(at, &["study", "join", "parts", "-o", name], 1);
        assert!(said.contains("has the name of a part"), "{said}");
        assert_eq!(names(&at.join("parts")), kept);
    }
    let _ = done(at, &["study", "join", "parts", "-o", "parts/table.csv"]);
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
fn what_is_there_is_not_computed_again() {
    let dir = folder(STUDY);
    let at = dir.path();
    let _ = done(at, &["sweep", "study.toml", "--parts", "4", "-o", "parts"]);
    let modified =
        || fs::metadata(at.join("parts/part-2-of-4.csv")).and_then(|file| file.modified()).expect("there");
    let before = modified();
    fs::remove_file(at.join("parts/part-3-of-4.csv")).expect("removed");
    let again = run(at, &["sweep", "study.toml", "--parts", "4", "-o", "parts"]);
    assert!(text(&again.stderr).contains("3 of 4 parts existed already"), "{}", text(&again.stderr));
    assert_eq!(modified(), before);
    let _ = done(at, &["study", "join", "parts", "-o", "joined.csv"]);
    assert_eq!(
        fs::read_to_string(at.join("joined.csv")).expect("joined"),
        done(at, &["sweep", "study.toml"])
    );
}

#[test]
fn parts_of_another_study_are_neither_joined_nor_written_over() {
    let dir = folder(STUDY);
    let at = dir.path();
    let _ = done(at, &["sweep", "study.toml", "--parts", "2", "-o", "parts"]);
    // Another study of the same shape.
    fs::write(at.join("other.toml"), STUDY.replace("20 kPa", "21 kPa")).expect("written");
    let said = refused(at, &["sweep", "other.toml", "--parts", "2", "-o", "parts"], 1);
    assert!(said.contains("part-1-of-2.csv is not a part of this study and is not overwritten"), "{said}");
    let _ = done(at, &["sweep", "other.toml", "--parts", "2", "-o", "others"]);
    for ending in ["csv", "json"] {
        let name = format!("part-2-of-2.{ending}");
        let _ = fs::copy(at.join("others").join(&name), at.join("parts").join(&name)).expect("copied");
    }
    let said = refused(at, &["study", "join", "parts", "-o", "joined.csv"], 1);
    assert!(
        said.contains("part-2-of-2.csv is not a part of this study")
            && said.contains("1 of 2 parts are missing: 2"),
        "{said}"
    );
    // A part that was edited.
    let path = at.join("others/part-1-of-2.csv");
    let edited = fs::read_to_string(&path).expect("there").replacen('7', "8", 1);
    fs::write(&path, edited).expect("written");
    let said = refused(at, &["study", "join", "others", "-o", "joined.csv"], 1);
    assert!(said.contains("part-1-of-2.csv is damaged"), "{said}");
    // One that was cut short: a run says the same as a join.
    fs::write(&path, "row\n").expect("written");
    for command in [
        &["study", "join", "others", "-o", "joined.csv"][..],
        &["study", "run", "other.toml", "--part", "1/2", "-o", "others"],
    ] {
        let said = refused(at, command, 1);
        assert!(said.contains("part-1-of-2.csv is damaged") && said.contains("delete it"), "{said}");
    }
    fs::remove_file(&path).expect("removed");
    let _ = done(at, &["study", "run", "other.toml", "--part", "1/2", "-o", "others"]);
    let said = refused(at, &["study", "join", ".", "-o", "joined.csv"], 1);
    assert!(said.contains("holds no parts"), "{said}");
    assert!(!at.join("joined.csv").exists());
}

/// Links and pipes may have no end: nothing is read of them.
#[cfg(unix)]
#[test]
fn a_part_that_is_no_file_of_its_own_is_not_read() {
    let dir = folder(STUDY);
    let at = dir.path();
    let _ = done(at, &["sweep", "study.toml", "--parts", "2", "-o", "parts"]);
    let [part, ticket] = ["csv", "json"].map(|ending| at.join(format!("parts/part-2-of-2.{ending}")));
    for path in [&part, &ticket] {
        let whole = fs::read(path).expect("there");
        fs::remove_file(path).expect("removed");
        std::os::unix::fs::symlink("/dev/zero", path).expect("linked");
        let said = refused(at, &["study", "join", "parts", "-o", "joined.csv"], 1);
        assert!(said.contains("part-2-of-2.csv is not a part of this study"), "{said}");
        fs::remove_file(path).expect("removed");
        fs::write(path, whole).expect("written");
    }
    fs::remove_file(&part).expect("removed");
    let made = std::process::Command::new("mkfifo").arg(&part).status().expect("it starts");
    assert!(made.success());
    let said = refused(at, &["study", "join", "parts", "-o", "joined.csv"], 1);
    assert!(said.contains("part-2-of-2.csv is not a part of this study"), "{said}");
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
    let said = full("sweep study.toml --parts 2 -o parts");
    assert!(said.contains("part-1-of-2.csv"), "{said}");
    assert_eq!(names(&at.join("parts")), Vec::<String>::new());
    assert_eq!(names(at), ["parts", "spec.toml", "study.toml"]);
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
    let refusals: [&[&str]; 4] = [
        &["sweep", "study.toml", "-o", "whole.parquet"],
        &["sweep", "study.toml", "--format", "parquet"],
        &["sweep", "study.toml", "--format", "parquet", "--parts", "2", "-o", "parts"],
        &["study", "join", "parts", "-o", "whole.parquet"],
    ];
    for args in refusals {
        let said = refused(dir.path(), args, 1);
        assert!(said.contains("ends in .csv"), "{said}");
        assert!(said.contains("stargrip_cam.sweep_to_parquet("), "{said}");
    }
    assert_eq!(names(dir.path()), ["spec.toml", "study.toml"]);
}
