//! Sound lines in a wrong order: the program of every machine is refused by a code for each.

use crate::{PRINTERS, PROFILES, findings_after, profile, spec_text, text, try_built_with};
use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::pipeline::Built;

const SEAL: &str = "star-1-seal.gcode";

/// What is done in a wrong order: the code of the finding, and the change of the lines.
struct Disorder {
    code: &'static str,
    change: fn(&mut Vec<String>),
}

const DISORDERS: [Disorder; 9] = [
    // The first contact before the iron is hot.
    Disorder { code: "cold-seal", change: |lines| shift(lines, is_heat, is_contact, 1) },
    // Heat after the whole seal.
    Disorder { code: "cold-seal", change: heat_at_the_end },
    // To the seam before the way up.
    Disorder { code: "blind-move", change: |lines| shift(lines, is_travel, is_lift, 0) },
    // Down to travel height before the way to the seam.
    Disorder { code: "stray-travel", change: |lines| shift(lines, is_low, is_travel, 0) },
    // The end of the program before its last seam.
    Disorder { code: "after-end", change: end_in_the_seam },
    // A contact before the travel to it.
    Disorder { code: "deviation", change: |lines| shift(lines, is_contact, is_touch_down, 0) },
    // The ramp down before the iron is above its seam.
    Disorder { code: "stray-travel", change: |lines| shift(lines, is_touch_down, is_travel, 0) },
    // Positions as displacements.
    Disorder { code: "profile-line", change: |lines| insert(lines, "G91", is_contact) },
    // Back to positions in the middle: a line of `start` at another place.
    Disorder { code: "profile-line", change: |lines| shift(lines, |line| line == "G90", is_contact, 1) },
];

fn is_code(line: &str) -> bool {
    !line.starts_with([';', '('])
}

/// The line that waits for the heat: of the controller, or the first pause of the operator.
fn is_heat(line: &str) -> bool {
    line.starts_with("M109") || line == "M0"
}

fn is_contact(line: &str) -> bool {
    ["G1 X", "G2 X", "G3 X"].iter().any(|start| line.starts_with(start)) && !line.contains(['Z', 'F'])
}

fn is_touch_down(line: &str) -> bool {
    line.starts_with("G1 X") && line.contains('Z')
}

fn is_travel(line: &str) -> bool {
    line.starts_with("G0 X")
}

/// The way up to the park height, the first of all motions.
fn is_lift(line: &str) -> bool {
    line.starts_with("G0 Z")
}

/// The way down to travel height above the first seam.
fn is_low(line: &str) -> bool {
    ["G0 Z5", "G0 Z6"].iter().any(|start| line.starts_with(start))
}

/// The place of the first line of code that `is_sought`.
fn place(lines: &[String], is_sought: fn(&str) -> bool) -> usize {
    lines.iter().position(|line| is_code(line) && is_sought(line)).expect("such a line")
}

/// Moves the first line that is `moved` to before the first one that is `goal`, or `offset` lines behind that place.
fn shift(lines: &mut Vec<String>, moved: fn(&str) -> bool, goal: fn(&str) -> bool, offset: usize) {
    let line = lines.remove(place(lines, moved));
    let goal = place(lines, goal) + offset;
    lines.insert(goal, line);
}

/// The place of the line that ends the program: the last one of code.
fn end(lines: &[String]) -> usize {
    lines.iter().rposition(|line| is_code(line)).expect("an end")
}

/// Heats before the last line instead of the first seam.
fn heat_at_the_end(lines: &mut Vec<String>) {
    let heat = lines.remove(place(lines, is_heat));
    lines.insert(end(lines), heat);
}

/// Ends behind the first move in contact.
fn end_in_the_seam(lines: &mut Vec<String>) {
    let last = lines.remove(end(lines));
    let goal = place(lines, is_contact) + 1;
    lines.insert(goal, last);
}

/// Inserts `line` before the first one that is `goal`.
fn insert(lines: &mut Vec<String>, line: &str, goal: fn(&str) -> bool) {
    let goal = place(lines, goal);
    lines.insert(goal, line.to_owned());
}

/// A small seal without strokes.
fn seal_on(name: &str) -> Built {
    let request = KindRequest::exactly(&[Kind::SealGcode]);
    try_built_with(&spec_text("[seal]\nspeed = \"10 mm/s\"\n"), profile(name), &request)
        .unwrap_or_else(|refusals| panic!("{name}: {refusals:?}"))
}

#[test]
fn no_program_with_lines_in_a_wrong_order_is_proven() {
    let mut unproven = Vec::new();
    for name in PROFILES.into_iter().chain(PRINTERS) {
        let build = seal_on(name);
        assert!(text(&build, SEAL).lines().filter(|line| is_code(line)).count() > 20, "{name}");
        for (disorder, number) in DISORDERS.iter().zip(1..) {
            let findings = findings_after(&build, SEAL, disorder.change);
            if !findings.iter().any(|finding| finding.code == disorder.code) {
                let codes: Vec<_> =
                    findings.iter().take(6).map(|finding| (finding.code, finding.line)).collect();
                unproven.push(format!("{name}, {number}: no {} in {codes:?}", disorder.code));
            }
        }
    }
    assert!(unproven.is_empty(), "{unproven:#?}");
}
