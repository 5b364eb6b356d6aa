//! `align`, and `resume` on a sheet that was moved, as a user runs them.

use std::fs;
use std::path::Path;

use crate::support;
use crate::support::program::{run, stderr, stdout, workshop};

/// Runs a command that must end with `code`; returns its standard output and standard error.
#[track_caller]
fn ended(dir: &Path, args: &[&str], code: i32) -> (String, String) {
    let output = run(dir, args);
    assert_eq!(output.status.code(), Some(code), "{args:?}\n{}\n{}", stdout(&output), stderr(&output));
    (stdout(&output), stderr(&output))
}

/// The marks in the comments of a program.
fn marks(program: &str) -> Vec<[f64; 2]> {
    let number = |line: &str, word: &str| -> f64 {
        let value = line.split(' ').find_map(|part| part.strip_prefix(word)).expect("a word");
        value.parse().expect("a number")
    };
    let lines = program.lines().filter(|line| line.starts_with("; mark: "));
    lines.map(|line| [number(line, "x_mm="), number(line, "y_mm=")]).collect()
}

#[test]
fn a_moved_sheet_gets_its_programs_and_the_rest_of_a_job() {
    let dir = workshop();
    let path = dir.path();
    let spec = format!("{}[machine]\nmarks = \"pause\"\n", support::PAPER);
    fs::write(path.join("star.toml"), spec).expect("written");
    let _ = ended(path, &["build", "star.toml", "-q", "--only", "seal-gcode,trace-gcode"], 0);
    let job = "out/star/star-1-seal.gcode";
    let text = fs::read_to_string(path.join(job)).expect("a program");
    let [a, b] = marks(&text)[..] else { panic!("two marks") };
    let place = |[x, y]: [f64; 2]| format!("{}, {}", x + 2.0, y - 1.5);
    let (first, second) = (place(a), place(b));
    let measured_marks = ["--mark1", first.as_str(), "--mark2", second.as_str()];
    let (answer, _) = ended(path, &[&["align", "out/star"], &measured_marks[..]].concat(), 0);
    assert!(answer.contains("turned by 0.000 deg, shifted by X 2.00 Y -1.50 mm"), "{answer}");
    let _ = ended(path, &["verify", "out/star-aligned", "-q"], 0);
    // The rest of a job on the moved sheet, and on the sheet where it was.
    let rest = |name: &str, more: &[&str]| {
        let _ = ended(path, &[&["resume", job, "--at", "40%", "-o", name], more].concat(), 0);
        fs::read_to_string(path.join(name)).expect("a program")
    };
    let (moved_rest, unmoved_rest) = (rest("there.gcode", &measured_marks), rest("here.gcode", &[]));
    assert!(moved_rest.contains("; aligned: ") && !unmoved_rest.contains("; aligned: "));
    let last = |text: &str| text.lines().rfind(|line| line.starts_with("G1 X")).expect("a move").to_owned();
    assert_ne!(last(&moved_rest), last(&unmoved_rest));
    let _ = ended(path, &["resume", "there.gcode", "--at", "60%", "-q", "-o", "later.gcode"], 0);
}

#[test]
fn wrong_marks_and_wrong_directories_write_nothing() {
    let dir = workshop();
    let path = dir.path();
    let _ = ended(path, &["build", "star.toml", "-q", "--only", "seal-gcode"], 0);
    for wrong in ["nan, 1", "1", "1, 2, 3", "1e99 mm, 2 mm", "inf, 0", "", ",", "1 kg, 2 kg"] {
        let _ = ended(path, &["align", "out/star", "--mark1", wrong, "--mark2", "1, 2"], 2);
    }
    let (_, fault) = ended(path, &["align", "out/star", "--mark1", "1, 2", "--mark2", "1, 2"], 1);
    assert!(fault.contains("mm apart"), "{fault}");
    let _ = ended(path, &["align", "out/star", "--mark1", "1, 2", "--mark2", "900000, 2", "--sheet", "7"], 1);
    let _ = ended(path, &["align", ".", "--mark1", "1, 2", "--mark2", "3, 4"], 1);
    let _ = ended(path, &["align", "out/star", "--mark1", "1, 2"], 2);
    assert!(!path.join("out/star-aligned").exists());
}
