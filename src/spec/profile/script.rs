//! The profile's own lines: start, pause, end, and what the operator has to see to.

use std::ops::Range;

use crate::spec::fault::{Fault, quoted};
use crate::spec::machine::Script;
use crate::spec::section::{Reader, Section};

/// Reads `[program]` for a controller that reads lines of at most `length` characters.
pub(super) fn read_script(reader: &mut Reader<'_>, length: usize) -> Script {
    let mut program = reader.section("program");
    program.require(&[("start", "[\"G21\", \"G90\"]"), ("pause", "\"M0\""), ("end", "[\"M2\"]")]);
    let start = read_lines(&mut program, "start", length);
    let pause =
        program.text("pause").map(|(line, span)| read_line(&mut program, "pause", line, span, length));
    let end = read_lines(&mut program, "end", length);
    // Each becomes a comment that begins with "; requires: ".
    let requires = read_lines(&mut program, "requires", length - 12);
    Script { start, pause: pause.unwrap_or_default(), end, requires }
}

fn read_lines(s: &mut Section<'_, '_>, key: &'static str, length: usize) -> Vec<String> {
    let lines = s.texts(key).unwrap_or_default();
    lines.into_iter().map(|(line, span)| read_line(s, key, line, span, length)).collect()
}

/// One line for the controller: printable ASCII, not longer than it can read.
fn read_line(s: &mut Section<'_, '_>, key: &str, line: &str, span: Range<usize>, length: usize) -> String {
    let is_plain = line.bytes().all(|byte| (b' '..=b'~').contains(&byte));
    let label = if !is_plain {
        "must be one line of printable ASCII".to_owned()
    } else if line.len() > length {
        format!("must be at most {length} characters, as `line_length` says; this line has {}", line.len())
    } else if line.trim().is_empty() {
        "must not be empty".to_owned()
    } else {
        return line.to_owned();
    };
    s.report(
        Fault::error("program-line", span, format!("a line of `{key}` is {}", quoted(line))).label(label),
    );
    String::new()
}
