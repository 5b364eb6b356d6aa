//! The verifier can fail: for each of its findings a file that is wrong in just that way.
//!
//! Every corruption is a build of the paper's star with one file changed; unless the test is about the
//! hash, the manifest is changed too, as a careful forger would, so that only reading the file can tell.

mod directory;
mod drawings;
mod programs;

use std::ops::RangeInclusive;

use stargrip_cam::pipeline::read_back;
use stargrip_cam::verify::{Finding, OutputFiles};

use crate::support::{self, files_of, replace, reseal};

const SEAL: &str = "star-1-seal.gcode";
const TRACE: &str = "star-1-trace.gcode";

fn output_files() -> OutputFiles<'static> {
    archive_of(support::PAPER)
}

fn archive_of(text: &str) -> OutputFiles<'static> {
    files_of(&support::build(text).expect("a gripper"))
}

fn text(files: &OutputFiles<'_>, file: &str) -> String {
    String::from_utf8(files.get(file).expect("a file").to_vec()).expect("text")
}

/// The findings after `change` of `file`, with a manifest that agrees.
fn forged(file: &str, change: impl Fn(&str) -> String) -> Vec<Finding> {
    forged_in(support::PAPER, file, change)
}

fn forged_in(spec: &str, file: &str, change: impl Fn(&str) -> String) -> Vec<Finding> {
    let mut files = archive_of(spec);
    let before = text(&files, file);
    let after = change(&before);
    assert!(before != after, "the corruption changes nothing");
    replace(&mut files, file, after.into_bytes());
    reseal(&mut files);
    // By reading alone: bytes that are compared would find everything.
    read_back(&files).findings
}

#[track_caller]
fn assert_found(findings: &[Finding], code: &str, file: &str) {
    let is_found = findings.iter().any(|finding| finding.code == code && finding.file == file);
    assert!(is_found, "no {code} for {file} in {findings:#?}");
}

/// Changes the lines of a program, and makes its last line count them.
fn with_lines(program: &str, change: impl Fn(&mut Vec<String>)) -> String {
    let mut lines: Vec<String> = program.lines().map(str::to_owned).collect();
    change(&mut lines);
    let count = lines.len();
    let last = lines.last_mut().expect("lines");
    if last.starts_with("; end of program") {
        *last = format!("; end of program, {count} lines");
    }
    lines.join("\n") + "\n"
}

/// Index of the `n`-th line (from 0) that begins with `start`.
fn nth(lines: &[String], start: &str, n: usize) -> usize {
    let mut matches = lines.iter().enumerate().filter(|(_, line)| line.starts_with(start));
    matches.nth(n).map(|(i, _)| i).expect("such a line")
}

/// Index of the first move of seam `n` (from 0) at contact height.
fn contact(lines: &[String], n: usize) -> usize {
    nth(lines, "; seam:", n) + 2
}

/// The lines of `bad`, from 1, that are not those of `good`; the last one, which counts the others, does not matter.
fn changed(good: &str, bad: &str) -> RangeInclusive<usize> {
    let body = |text: &str| text.lines().map(str::to_owned).collect::<Vec<_>>();
    let (mut good, mut bad) = (body(good), body(bad));
    drop((good.pop(), bad.pop()));
    let equal_lines = good.iter().zip(&bad).take_while(|(a, b)| a == b).count();
    let rest = good[equal_lines..]
        .iter()
        .rev()
        .zip(bad[equal_lines..].iter().rev())
        .take_while(|(a, b)| a == b)
        .count();
    equal_lines + 1..=bad.len() - rest
}

/// The lines in which a fault at `place` may be found: a removed line is missed by those around it.
fn neighbourhood(place: &RangeInclusive<usize>) -> RangeInclusive<usize> {
    place.start().saturating_sub(2)..=place.end() + 2
}

/// The fault has its name, and the line that is blamed is where the program was changed.
#[track_caller]
fn assert_program_fault(code: &str, change: impl Fn(&mut Vec<String>)) {
    assert_blamed(code, change, neighbourhood);
}

/// Checks a fault that only shows further on in the program.
#[track_caller]
fn assert_later_fault(code: &str, change: impl Fn(&mut Vec<String>)) {
    assert_blamed(code, change, |place| *place.start()..=usize::MAX);
}

#[track_caller]
fn assert_blamed(
    code: &str,
    change: impl Fn(&mut Vec<String>),
    lines: impl Fn(&RangeInclusive<usize>) -> RangeInclusive<usize>,
) {
    let good = text(&output_files(), SEAL);
    let allowed_lines = lines(&changed(&good, &with_lines(&good, &change)));
    let findings = forged(SEAL, |program| with_lines(program, &change));
    let is_it = |finding: &&Finding| finding.code == code && finding.file == SEAL;
    let blamed: Vec<_> = findings.iter().filter(is_it).map(|finding| finding.line).collect();
    let is_found = blamed.iter().any(|line| line.is_some_and(|line| allowed_lines.contains(&line)));
    assert!(is_found, "{code} blames {blamed:?}, not a line of {allowed_lines:?}: {findings:#?}");
}
