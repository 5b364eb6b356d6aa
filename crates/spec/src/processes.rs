//! Processes: settings with which single seams are made.
//!
//! A **process** is the setting with which one seam is made. `[seal]` is the process of every seam that names no other;
//! `[process.NAME]` is another one, and takes from `[seal]` what it leaves out.

use std::ops::Range;

use crate::FaultCode;
use crate::allowed::{Allowed, EXTRA, SEAL_SPEEDS};
use crate::fault::{Fault, quoted};
use crate::laser::{POWERS, read_focus};
use crate::name::is_plain_word;
use crate::raw::RawSpec;
use crate::seal::{
    LONGEST_WAIT, MOST, STRENGTHS, Seal, SealPause, check_lines, read_height, read_temperature,
};
use crate::section::{Reader, Section};
use crate::units::{Duration, Length, LineForce, Percent, Speed, Temperature};
use crate::unknown::nearest;
use crate::value::RawValue;

/// The name of the process that `[seal]` is.
pub const DEFAULT_PROCESS: &str = "seal";

/// Longest name of a process, letters: comments of programs carry it.
const NAME_LENGTH: usize = 20;
/// Section of the processes.
const SECTION: &str = "process";

/// A named process as it is written: what it leaves out is that of `[seal]`.
#[derive(Clone, Debug, PartialEq)]
pub struct ProcessSpec {
    /// Name of the process.
    pub name: String,
    /// Temperature of the iron.
    pub temperature: Option<Temperature>,
    /// Power of a laser.
    pub power: Option<Percent>,
    /// Speed of the iron in contact.
    pub speed: Option<Speed>,
    /// Height in contact, or of a laser's focus.
    pub height: Option<Length>,
    /// Passes of every line.
    pub passes: Option<u32>,
    /// Lines of a band.
    pub lines: Option<u32>,
    /// Path covered twice.
    pub overlap: Option<Length>,
    /// Wait after every seam.
    pub cool: Option<Duration>,
    /// Pause after a seam.
    pub pause: Option<SealPause>,
    /// Peel strength of such seams.
    pub strength: Option<LineForce>,
}

/// The processes, in the order of the alphabet. A process with a wrong name is reported and left out.
pub(super) fn read_processes(reader: &mut Reader<'_>, seal: &Seal) -> Vec<ProcessSpec> {
    let Some(table) = reader.free(SECTION).and_then(RawValue::as_table) else {
        // Registers the keys, even where the spec has no process.
        let _ = read_process(&mut reader.absent(SECTION), "", seal);
        return Vec::new();
    };
    let mut processes = Vec::new();
    for entry in &table.0 {
        let mut section = reader.element(SECTION, &entry.value);
        let process = read_process(&mut section, &entry.key, seal);
        match wrong_name(&entry.key) {
            Some(label) => {
                let message = format!("a process is called {}", quoted(&entry.key));
                let fault = Fault::error(FaultCode::Name, entry.key_span.clone(), message).label(label);
                section.report(fault);
            }
            None => processes.push(process),
        }
    }
    processes
}

/// Checks that `name` can be that of a `[process.NAME]`.
///
/// # Errors
/// The reason why it cannot.
pub fn check_process_name(name: &str) -> Result<(), String> {
    wrong_name(name).map_or(Ok(()), Err)
}

/// The reason for which `name` is none of a process.
fn wrong_name(name: &str) -> Option<String> {
    if name == DEFAULT_PROCESS {
        return Some("[seal] is the process of this name: write the keys there".to_owned());
    }
    let is_name = name.starts_with(|c: char| c.is_ascii_alphabetic())
        && name.len() <= NAME_LENGTH
        && is_plain_word(name);
    (!is_name)
        .then(|| format!("must be a letter, then letters, digits, - and _, at most {NAME_LENGTH} in all"))
}

/// A `[process.NAME]` beside `seal`.
fn read_process(s: &mut Section<'_, '_>, name: &str, seal: &Seal) -> ProcessSpec {
    let focus = read_focus(s);
    let process = ProcessSpec {
        name: name.to_owned(),
        temperature: read_temperature(s),
        power: s.quantity("power", POWERS),
        speed: s.quantity("speed", SEAL_SPEEDS),
        height: read_height(s).or(focus),
        passes: s.count("passes", 1, MOST),
        lines: s.count("lines", 1, MOST),
        overlap: s.quantity("overlap", EXTRA),
        cool: s.quantity("cool", Allowed::closed(0.0, LONGEST_WAIT)),
        pause: s.choice("pause", &SealPause::ALL),
        strength: s.quantity("strength", STRENGTHS),
    };
    if process.lines.is_some() {
        check_lines(s, &Seal { lines: process.lines, ..seal.clone() });
    }
    process
}

/// A place of the text that names a process.
struct ProcessPlace<'r> {
    name: &'r str,
    span: Range<usize>,
}

/// Reports every place of the text that writes a process or uses one: a press has one temperature for all bands. The process of
/// `[seal]` is no other.
pub(super) fn refuse_processes(reader: &mut Reader<'_>) {
    let uses = process_uses(reader.raw).into_iter().filter(|place| place.name != DEFAULT_PROCESS);
    for ProcessPlace { name, span } in process_sections(reader.raw).chain(uses) {
        let message = format!("the process {} beside a heat press", quoted(name));
        let fault = Fault::error(FaultCode::Conflict, span, message);
        reader.faults.push(fault.label("a press seals all bands at once, at one temperature").help(
            "delete it, and every use of it; or write the profile of a machine with an iron in [machine]",
        ));
    }
}

/// The section of every process in the text.
fn process_sections(raw: &RawSpec) -> impl Iterator<Item = ProcessPlace<'_>> {
    places_of(raw.root().get(SECTION))
}

/// The keys of `table`, which are names of processes.
fn places_of(table: Option<&RawValue>) -> impl Iterator<Item = ProcessPlace<'_>> {
    let entries = table.and_then(RawValue::as_table).into_iter().flat_map(|table| &table.0);
    entries.map(|entry| ProcessPlace { name: &entry.key, span: entry.key_span.clone() })
}

/// Every use of a process in the text: loops of stars, and the keys of `[drawing.process]`.
fn process_uses(raw: &RawSpec) -> Vec<ProcessPlace<'_>> {
    let star = raw.root().get("star").and_then(RawValue::as_table);
    let stars = star.into_iter().chain(raw.overrides().iter().filter_map(RawValue::as_table));
    let loops = stars.flat_map(|table| ["inner_process", "outer_process"].map(|key| table.get(key)));
    let loops = loops
        .flatten()
        .filter_map(|value| Some(ProcessPlace { name: value.as_text()?, span: value.span.clone() }));
    let drawing = raw.root().get("drawing").and_then(RawValue::as_table);
    loops.chain(places_of(drawing.and_then(|table| table.get(SECTION)))).collect()
}

/// Reports uses of processes that do not exist, and processes that nothing uses.
pub(super) fn check_uses(reader: &mut Reader<'_>, processes: &[ProcessSpec]) {
    let names: Vec<&str> =
        processes.iter().map(|process| process.name.as_str()).chain([DEFAULT_PROCESS]).collect();
    let (known_uses, unknown_uses): (Vec<_>, Vec<_>) =
        process_uses(reader.raw).into_iter().partition(|place| names.contains(&place.name));
    // A misspelt use may be that of a process without one.
    let judges_uses = unknown_uses.is_empty();
    for ProcessPlace { name, span } in unknown_uses {
        let message = format!("no process is called {}", quoted(name));
        let fault = Fault::error(FaultCode::UnknownProcess, span, message);
        let help = match nearest(name, names.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("write its section, [process.{name}]; there are {}", names.join(", ")),
        };
        reader.faults.push(fault.label("must be the name of a section [process.NAME], or seal").help(help));
    }
    for ProcessPlace { name, span } in process_sections(reader.raw).filter(|_| judges_uses) {
        // A section with a wrong name is none of a process.
        let is_process = processes.iter().any(|process| process.name == name);
        if is_process && known_uses.iter().all(|place| place.name != name) {
            let message = format!("no seam uses the process {}", quoted(name));
            let fault = Fault::warning(FaultCode::NoEffect, span, message)
                .label("a process counts where a seam names it")
                .help(format!(
                    "name layers, ids or roles of a drawing by {name} = [...] in [drawing.process], or write `inner_process` or `outer_process` in [star]"
                ));
            reader.faults.push(fault);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Source;
    use crate::{Faults, Reading, read};

    const STAR: &str = "schema = 1\nname = \"x\"\n[star]\npoints = 5\ninner_radius = \"50 mm\"\ntube_width = \"30 mm\"\n\
                        tip_angle = \"30 deg\"\n";

    fn reading(rest: &str) -> Result<Reading, Faults> {
        read(&Source::new("x", format!("{STAR}{rest}")))
    }

    /// Codes and words of the faults of a spec with `rest`.
    fn faults(rest: &str) -> (Vec<&'static str>, String) {
        let faults = match reading(rest) {
            Ok(reading) => reading.warnings,
            Err(faults) => faults,
        };
        (faults.list().iter().map(|fault| fault.code).collect(), faults.to_string())
    }

    #[test]
    fn a_process_takes_what_it_leaves_out_from_seal() {
        let rest = "inner_process = \"weak\"\n[fabric]\nseal_strength = \"3 N/mm\"\n[seal]\nspeed = \"0.5 mm/s\"\npasses = 2\n\
                    tip = \"1 mm\"\n[process.weak]\ntemperature = \"170 C\"\nstrength = \"0.8 N/mm\"\n";
        let spec = reading(rest).unwrap_or_else(|faults| panic!("{faults}")).spec;
        let weak = spec.process("weak");
        assert_eq!((weak.seal.temperature, weak.seal.speed), (Temperature(170.0), Speed(0.5)));
        assert_eq!((weak.seal.passes, weak.seal.line_count()), (2, 2));
        assert_eq!(
            (weak.strength, spec.default_process().strength),
            (Some(LineForce(0.8)), Some(LineForce(3.0)))
        );
        // A name without a section is that of [seal]: reading has refused it.
        assert!(spec.process("other").is_default());
        assert_eq!(spec.sealed_by(&weak).fabric.seal_strength, Some(LineForce(0.8)));
    }

    #[test]
    fn every_fault_of_processes_has_its_code_and_its_remedy() {
        // Each row is the rest of a star's spec with one fault. The fault has its code, and its message and remedy have the words.
        let uses_weak = "outer_process = \"weak\"\n";
        for (rest, code, words) in [
            ("outer_process = \"weka\"\n[process.weak]\n", "unknown-process", "did you mean `weak`?"),
            ("[process.weak]\n", "no-effect", "no seam uses the process `weak`"),
            ("[process.seal]\n", "name", "[seal] is the process of this name"),
            ("[process.\"two words\"]\n", "name", "at most 20 in all"),
            (
                "outer_process = \"weak\"\n[process.weak]\npasses = 0\n",
                "out-of-range",
                "must be from 1 to 20",
            ),
            (
                "outer_process = \"weak\"\n[process.weak]\ntemperature = \"310 C\"\n",
                "ptfe",
                "less than 300 C",
            ),
            ("outer_process = \"weak\"\n[process.weak]\nheight = \"1 mm\"\n", "out-of-range", "at most 0 mm"),
            (
                "outer_process = \"weak\"\n[process.weak]\nsped = \"1 mm/s\"\n",
                "unknown-key",
                "did you mean `speed`?",
            ),
            ("outer_process = \"weak\"\n[process.weak]\nlines = 2\n", "conflict", "write `tip` in [seal]"),
            ("[seal]\ntip = \"3 mm\"\n", "conflict", "every line would leave the band"),
            ("[seal]\ntip = \"0.5 mm\"\nlines = 3\n", "conflict", "write lines = 4"),
            ("[seal]\ntip = \"0.01 mm\"\n", "conflict", "at most 20 lines are sealed"),
            ("[seal]\npause = \"always\"\n", "unknown-choice", "must be one of"),
            ("[seal]\ncool = \"2 h\"\n", "out-of-range", "at most 3600 s"),
            (
                "[fabric]\nseal_strength = \"3 N/mm\"\n[seal]\nstrength = \"3 N/mm\"\n",
                "conflict",
                "delete one of them",
            ),
        ] {
            let (codes, text) = faults(rest);
            assert_eq!(codes, [code], "{rest}: {text}");
            assert!(text.contains(words), "{rest}: {text}");
        }
        // All at once.
        let (codes, text) = faults(&format!(
            "{uses_weak}[process.weak]\npasses = 0\ntemperature = \"310 C\"\n[process.other]\n"
        ));
        assert_eq!(codes, ["out-of-range", "ptfe", "no-effect"], "{text}");
    }

    /// A press has one temperature and one time for all bands; the process of [seal] is no other.
    #[test]
    fn a_press_has_no_processes() {
        let press = "[machine]\nprofile = \"press\"\n";
        let (codes, text) = faults(&format!("outer_process = \"weak\"\n{press}[process.weak]\n"));
        assert_eq!(codes, ["conflict", "conflict"], "{text}");
        assert!(text.contains("a press seals all bands at once, at one temperature"), "{text}");
        for key in [
            "height = \"-0.1 mm\"",
            "tip = \"1 mm\"",
            "lines = 1",
            "passes = 2",
            "cool = \"1 s\"",
            "pause = \"seam\"",
        ] {
            let (codes, text) = faults(&format!("{press}[seal]\n{key}\n"));
            assert_eq!(codes, ["conflict"], "{key}: {text}");
        }
        let (codes, text) =
            faults(&format!("inner_process = \"seal\"\n{press}[seal]\nstrength = \"2 N/mm\"\n"));
        assert!(codes.is_empty(), "{text}");
    }

    #[test]
    fn a_layer_has_one_process() {
        let text = "schema = 1\nname = \"x\"\n[drawing]\nfile = \"a.svg\"\n[drawing.layers]\nair = [\"a\"]\n[drawing.process]\n\
                    weak = [\"a\", \"b\"]\nstrong = [\"a\", 3]\nnone = \"a\"\n[process.weak]\n[process.strong]\n";
        let faults = read(&Source::new("x", text)).expect_err("four faults");
        let codes: Vec<&str> = faults.list().iter().map(|fault| fault.code).collect();
        assert_eq!(codes, ["conflict", "wrong-type", "unknown-process", "wrong-type"], "{faults}");
    }
}
