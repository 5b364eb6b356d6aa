//! From a machine profile's text to the [`Machine`], and the profiles that come with the program.
//!
//! A new key is added in three steps: a field in [`Machine`], a line in one of the functions below (which
//! makes the key known and gives its range), and a commented line in each profile that needs it.

use crate::spec::FaultCode;
use std::ops::Range;

use crate::spec::allowed::Allowed;
use crate::spec::fault::{Fault, Faults, quoted};
use crate::spec::machine::{Comments, Dialect, DwellUnit, Dwells, Heating, Heights, KeepOut, Machine};
use crate::spec::motion::{Motion, StepRate};
use crate::spec::name::{breaks_line, check_name};
use crate::spec::reading::{SIZE, read_name, read_schema, read_with};
use crate::spec::section::{Reader, Section};
use crate::spec::source::Source;
use crate::units::{Duration, Length, Quantity, Speed};

macro_rules! builtin {
    ($($name:literal),+) => {
        &[$(($name, include_str!(concat!("../../templates/machines/", $name, ".toml")))),+]
    };
}

/// The profiles that come with the program: name and text.
const BUILTIN: &[(&str, &str)] =
    builtin!["generic", "linuxcnc", "grbl", "grblhal", "fluidnc", "marlin", "klipper", "reprapfirmware"];

/// Longest description, in characters.
const DESCRIPTION_LENGTH: usize = 200;
/// Height in contact: a spring is pressed in by less than 20 mm, a thick release layer is less than 5 mm.
const CONTACT: Allowed = Allowed::closed(-20.0, 5.0);
/// Heights without contact: above the release layer, below any gantry.
const HEIGHT: Allowed = Allowed::above(0.0, 1000.0);
/// Speeds of moves without sealing, up to 10 m/s.
const FAST: Allowed = Allowed::closed(0.01, 1e4);
/// Steps per mm: from a coarse belt to a fine screw with microsteps.
const STEPS: Allowed = Allowed::closed(1e-3, 1e6);
/// Lowest step rates, steps/s: from a step a quarter of an hour to what only a broken timer would have.
const RATE: Allowed = Allowed::closed(1e-3, 1e5);

/// The names of the profiles that come with the program.
pub fn builtin_machines() -> impl Iterator<Item = &'static str> {
    BUILTIN.iter().map(|(name, _)| *name)
}

/// The text of the profile that comes with the program under `name`.
pub fn builtin_machine(name: &str) -> Option<&'static str> {
    BUILTIN.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

/// Reads a machine profile.
///
/// # Errors
/// All faults of the text at once, if at least one refuses it.
pub fn read_machine(source: &Source) -> Result<Machine, Faults> {
    read_with(source, read_profile).map(|(machine, _, _)| machine)
}

fn read_profile(reader: &mut Reader<'_>) -> Machine {
    let mut root = reader.root();
    root.require(&[("schema", "1"), ("name", "\"my machine\""), ("dialect", "\"generic\"")]);
    read_schema(&mut root, 1);
    let name = read_name(&mut root);
    let description = read_description(&mut root);
    let dialect = root.choice("dialect", &Dialect::NAMES).unwrap_or(Dialect::Generic);
    let heating = root
        .choice("heating", &[("operator", Heating::Operator), ("hotend", Heating::Hotend)])
        .unwrap_or(Heating::Operator);
    let comments = root
        .choice("comments", &[("semicolon", Comments::Semicolon), ("parentheses", Comments::Parentheses)])
        .unwrap_or(Comments::Semicolon);
    let arcs = root.truth("arcs").unwrap_or(true);
    let spring_loaded = root.truth("spring_loaded");
    let length = root.count("line_length", 40, 255).map_or(70, |length| length as usize);
    let ramp = root.quantity("ramp", SIZE).unwrap_or(Length(3.0));
    let work_area = read_work_area(&mut reader.section("work_area"));
    let heights = read_heights(&mut reader.section("heights"), spring_loaded);
    let dwell = read_dwells(&mut reader.section("dwell"));
    let motion = read_motion(&mut reader.section("motion"));
    let keep_out = read_keep_out(reader);
    let mut speeds = reader.section("speeds");
    let travel_speed = speeds.quantity("travel", FAST).unwrap_or(Speed(20.0));
    let trace_speed = speeds.quantity("trace", FAST).unwrap_or(Speed(20.0));
    let mut program = reader.section("program");
    program.require(&[("start", "[\"G21\", \"G90\"]"), ("pause", "\"M0\""), ("end", "[\"M2\"]")]);
    let start = read_lines(&mut program, "start", length);
    let pause =
        program.text("pause").map(|(line, span)| read_line(&mut program, "pause", line, span, length));
    let end = read_lines(&mut program, "end", length);
    // Each becomes a comment that begins with "; requires: ".
    let requires = read_lines(&mut program, "requires", length - 12);
    Machine {
        name,
        description,
        dialect,
        work_area,
        line_length: length,
        comments,
        arcs,
        dwell,
        heating,
        spring_loaded: spring_loaded.unwrap_or(heights.contact.0 < 0.0),
        heights,
        ramp,
        travel_speed,
        trace_speed,
        motion,
        keep_out,
        start,
        pause: pause.unwrap_or_default(),
        end,
        requires,
    }
}

fn read_description(root: &mut Section<'_, '_>) -> String {
    let Some((text, span)) = root.text("description") else { return String::new() };
    if text.chars().any(breaks_line) || text.chars().count() > DESCRIPTION_LENGTH {
        let fault = Fault::error(FaultCode::Name, span, format!("`description` is {}", quoted(text)))
            .label(format!("must be one line of at most {DESCRIPTION_LENGTH} characters"));
        root.report(fault);
    }
    text.to_owned()
}

/// Both sizes, or neither: an absent one and "unknown" mean the same.
fn read_work_area(s: &mut Section<'_, '_>) -> Option<(Length, Length)> {
    let mut side = |key| match s.take(key)?.as_text() {
        Some("unknown") => None,
        _ => s.quantity::<Length>(key, SIZE).or(Some(Length(1.0))),
    };
    match (side("x"), side("y")) {
        (Some(x), Some(y)) => Some((x, y)),
        (None, None) => None,
        _ => {
            let fault = Fault::error(FaultCode::Conflict, s.place(), "[work_area] knows one side only")
                .label("must say both `x` and `y`, or neither, or \"unknown\" for both");
            s.report(fault);
            None
        }
    }
}

/// Whether `key` says the word, which stands for a number that there is not.
fn says(s: &mut Section<'_, '_>, key: &'static str, word: &str) -> bool {
    s.take(key).and_then(|value| value.as_text()) == Some(word)
}

/// A plain number, or `None` for "unknown" and for nothing at all.
fn known_number(s: &mut Section<'_, '_>, key: &'static str, allowed: Allowed) -> Option<f64> {
    if says(s, key, "unknown") { None } else { s.number(key, allowed) }
}

/// A quantity, or `None` for "unknown" and for nothing at all.
fn known<Q: Quantity>(s: &mut Section<'_, '_>, key: &'static str, allowed: Allowed) -> Option<Q> {
    if says(s, key, "unknown") { None } else { s.quantity(key, allowed) }
}

fn read_dwells(s: &mut Section<'_, '_>) -> Dwells {
    let units = [("s", DwellUnit::Seconds), ("ms", DwellUnit::Milliseconds)];
    Dwells {
        unit: s.choice("unit", &units).unwrap_or(DwellUnit::Seconds),
        step: s.quantity("step", Allowed::closed(1e-3, 1.0)).unwrap_or(Duration(1e-3)),
    }
}

fn read_motion(s: &mut Section<'_, '_>) -> Motion {
    let axes = [
        known_number(s, "x_steps_per_mm", STEPS),
        known_number(s, "y_steps_per_mm", STEPS),
        known_number(s, "z_steps_per_mm", STEPS),
    ];
    let steps_per_mm = match axes {
        [Some(x), Some(y), Some(z)] => Some([x, y, z]),
        [None, None, None] => None,
        _ => {
            let fault =
                Fault::error(FaultCode::Conflict, s.place(), "[motion] knows the steps of some axes only")
                    .label(
                        "must say `x_steps_per_mm`, `y_steps_per_mm` and `z_steps_per_mm`, or none of them",
                    );
            s.report(fault);
            None
        }
    };
    let step_rate = if says(s, "min_step_rate", "none") {
        StepRate::NoLimit
    } else {
        known_number(s, "min_step_rate", RATE).map_or(StepRate::Unknown, StepRate::AtLeast)
    };
    Motion {
        steps_per_mm,
        step_rate,
        min_feed: s.quantity("min_feed", Allowed::closed(0.0, 1e3)).unwrap_or(Speed(0.0)),
        acceleration: known(s, "acceleration", Allowed::closed(0.1, 1e6)),
        chop_feed: known(s, "chop_feed", Allowed::closed(1e-3, 1e3)),
    }
}

fn read_keep_out(reader: &mut Reader<'_>) -> Vec<KeepOut> {
    let Some(list) = reader.raw.root_list("keep_out") else {
        // So that the section's name is known even where there is none.
        let _ = reader.section("keep_out");
        return Vec::new();
    };
    list.iter()
        .map(|value| {
            let mut s = reader.element("keep_out", value);
            s.require(&[
                ("x", "\"0 mm\""),
                ("y", "\"0 mm\""),
                ("width", "\"20 mm\""),
                ("depth", "\"20 mm\""),
            ]);
            let place = Allowed::closed(-1e5, 1e5);
            let name = s.text("name");
            let mut side = |key, allowed, default| s.quantity(key, allowed).unwrap_or(Length(default));
            let (x, y) = (side("x", place, 0.0), side("y", place, 0.0));
            let (width, depth) = (side("width", SIZE, 1.0), side("depth", SIZE, 1.0));
            let height = known(&mut s, "height", HEIGHT);
            let name = name.map_or("clamp".to_owned(), |(name, span)| {
                if let Err(reason) = check_name(name) {
                    let fault = Fault::error(FaultCode::Name, span, format!("`name` is {}", quoted(name)));
                    s.report(fault.label(reason.to_string()));
                }
                name.to_owned()
            });
            KeepOut { name, x, y, width, depth, height }
        })
        .collect()
}

fn read_heights(s: &mut Section<'_, '_>, spring_loaded: Option<bool>) -> Heights {
    s.require(&[("contact", "\"0 mm\""), ("travel", "\"5 mm\""), ("park", "\"30 mm\"")]);
    let contact = s.quantity("contact", CONTACT);
    let travel = s.quantity("travel", HEIGHT);
    let park = s.quantity("park", HEIGHT);
    if let (Some(false), Some(Length(contact))) = (spring_loaded, contact)
        && contact < 0.0
    {
        let fault = Fault::error(
            FaultCode::OutOfRange,
            s.place_of("contact"),
            format!("`contact` is {}", Length(contact)),
        )
        .label("must be 0 mm or above for a tip without a spring, which `spring_loaded = false` says it is");
        s.report(fault);
    }
    for (low, low_key, high, high_key) in
        [(contact, "contact", travel, "travel"), (travel, "travel", park, "park")]
    {
        if let (Some(Length(low)), Some(Length(high))) = (low, high)
            && high <= low
        {
            let fault = Fault::error(
                FaultCode::OutOfRange,
                s.place_of(high_key),
                format!("`{high_key}` is {}", Length(high)),
            )
            .label(format!("must be above `{low_key}`, {}", Length(low)));
            s.report(fault);
        }
    }
    Heights {
        contact: contact.unwrap_or(Length(0.0)),
        travel: travel.unwrap_or(Length(5.0)),
        park: park.unwrap_or(Length(30.0)),
    }
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
        Fault::error(FaultCode::ProgramLine, span, format!("a line of `{key}` is {}", quoted(line)))
            .label(label),
    );
    String::new()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_profile_that_comes_with_the_program_is_valid_and_bears_its_name() {
        assert!(builtin_machines().count() > 0);
        for name in builtin_machines() {
            let text = builtin_machine(name).expect("listed");
            match read_machine(&Source::new(name, text)) {
                Ok(machine) => assert_eq!(machine.name, name),
                Err(faults) => panic!("{faults}"),
            }
        }
        assert_eq!(builtin_machine("no such"), None);
    }

    #[test]
    fn generic_is_the_papers_machine() {
        let text = builtin_machine("generic").expect("built in");
        let machine = read_machine(&Source::new("generic", text)).expect("valid");
        assert_eq!(machine.heights.contact, Length(-0.3));
        assert_eq!((machine.heights.travel, machine.heights.park), (Length(5.0), Length(30.0)));
        assert_eq!((machine.line_length, machine.ramp, machine.work_area), (70, Length(3.0), None));
        assert_eq!(machine.start, ["G21", "G17", "G90", "G91.1", "G94"]);
        assert_eq!((machine.pause.as_str(), machine.end), ("M0", vec!["M2".to_owned()]));
    }

    /// The faults' codes of the generic profile with `old` replaced by `new`.
    fn codes(old: &str, new: &str) -> Vec<&'static str> {
        let text = builtin_machine("generic").expect("built in");
        assert!(text.contains(old), "{old}");
        match read_machine(&Source::new("changed", text.replacen(old, new, 1))) {
            Ok(_) => Vec::new(),
            Err(faults) => faults.list().iter().map(|fault| fault.code).collect(),
        }
    }

    #[test]
    fn a_line_for_the_controller_is_short_and_plain() {
        let of_length = |n: usize| format!("\"M2 ;{}\"", "x".repeat(n - 4));
        assert_eq!(codes("\"M2\"", &of_length(70)), [""; 0]);
        assert_eq!(codes("\"M2\"", &of_length(71)), ["program-line"]);
        assert_eq!(codes("\"M0\"", "\"\\u0000\""), ["program-line"]);
        assert_eq!(codes("\"M0\"", "\" \""), ["program-line"]);
        assert_eq!(codes("[\"M2\"]", "[]"), [""; 0]);
    }

    #[test]
    fn heights_are_in_their_order() {
        assert_eq!(codes("travel = \"5 mm\"", "travel = \"30 mm\""), ["out-of-range"]);
        assert_eq!(codes("contact = \"-0.3 mm\"", "contact = \"5 mm\""), ["out-of-range"]);
        assert_eq!(codes("contact = \"-0.3 mm\"", "contact = \"0 mm\""), [""; 0]);
        assert_eq!(codes("travel = \"5 mm\"", ""), ["missing-key"]);
    }

    #[test]
    fn a_work_area_is_known_whole_or_not_at_all() {
        let text = builtin_machine("generic").expect("built in");
        let known =
            text.replace("x = \"unknown\"", "x = \"60 cm\"").replace("y = \"unknown\"", "y = \"400 mm\"");
        let machine = read_machine(&Source::new("known", known)).expect("valid");
        assert_eq!(machine.work_area, Some((Length(600.0), Length(400.0))));
        assert_eq!(codes("x = \"unknown\"", "x = \"60 cm\""), ["conflict"]);
        assert_eq!(codes("x = \"unknown\"", "x = 600"), ["conflict", "no-unit"]);
        assert_eq!(codes("x = \"unknown\"\ny = \"unknown\"", ""), [""; 0]);
    }
}
