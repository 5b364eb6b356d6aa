//! From a machine profile's text to the [`Machine`], and the profiles that come with the program.
//!
//! A new key is added in three steps: a field in [`Machine`], a line in one of the functions below (which
//! makes the key known and gives its range), and a commented line in each profile that needs it.

use std::ops::Range;

use crate::spec::allowed::Allowed;
use crate::spec::fault::{Fault, Faults, quoted};
use crate::spec::machine::{Dialect, Heating, Heights, Machine};
use crate::spec::reading::{SIZE, read_name, read_schema, read_with};
use crate::spec::section::{Reader, Section};
use crate::spec::source::Source;
use crate::spec::words::breaks_line;
use crate::units::{Length, Speed};

/// The profiles that come with the program: name and text.
const BUILTIN: &[(&str, &str)] = &[("generic", include_str!("../../templates/machines/generic.toml"))];

/// Longest description, in characters.
const DESCRIPTION_LENGTH: usize = 200;
/// Height in contact: a spring is pressed in by less than 20 mm, a thick release layer is less than 5 mm.
const CONTACT: Allowed = Allowed::closed(-20.0, 5.0);
/// Heights without contact: above the release layer, below any gantry.
const HEIGHT: Allowed = Allowed::above(0.0, 1000.0);
/// Speeds of moves without sealing, up to 10 m/s.
const FAST: Allowed = Allowed::closed(0.01, 1e4);

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
    let dialect = root.choice("dialect", &[("generic", Dialect::Generic)]).unwrap_or(Dialect::Generic);
    let heating = root.choice("heating", &[("operator", Heating::Operator)]).unwrap_or(Heating::Operator);
    let length = root.count("line_length", 40, 255).map_or(70, |length| length as usize);
    let ramp = root.quantity("ramp", SIZE).unwrap_or(Length(3.0));
    let work_area = read_work_area(&mut reader.section("work_area"));
    let heights = read_heights(&mut reader.section("heights"));
    let mut speeds = reader.section("speeds");
    let travel_speed = speeds.quantity("travel", FAST).unwrap_or(Speed(20.0));
    let trace_speed = speeds.quantity("trace", FAST).unwrap_or(Speed(20.0));
    let mut program = reader.section("program");
    program.require(&[("start", "[\"G21\", \"G90\"]"), ("pause", "\"M0\""), ("end", "[\"M2\"]")]);
    let start = read_lines(&mut program, "start", length);
    let pause =
        program.text("pause").map(|(line, span)| read_line(&mut program, "pause", line, span, length));
    let end = read_lines(&mut program, "end", length);
    Machine {
        name,
        description,
        dialect,
        work_area,
        line_length: length,
        heating,
        heights,
        ramp,
        travel_speed,
        trace_speed,
        start,
        pause: pause.unwrap_or_default(),
        end,
    }
}

fn read_description(root: &mut Section<'_, '_>) -> String {
    let Some((text, span)) = root.text("description") else { return String::new() };
    if text.chars().any(breaks_line) || text.chars().count() > DESCRIPTION_LENGTH {
        let fault = Fault::error("name", span, format!("`description` is {}", quoted(text)))
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
            let fault = Fault::error("conflict", s.place(), "[work_area] knows one side only")
                .label("must say both `x` and `y`, or neither, or \"unknown\" for both");
            s.report(fault);
            None
        }
    }
}

fn read_heights(s: &mut Section<'_, '_>) -> Heights {
    s.require(&[("contact", "\"0 mm\""), ("travel", "\"5 mm\""), ("park", "\"30 mm\"")]);
    let contact = s.quantity("contact", CONTACT);
    let travel = s.quantity("travel", HEIGHT);
    let park = s.quantity("park", HEIGHT);
    for (low, low_key, high, high_key) in
        [(contact, "contact", travel, "travel"), (travel, "travel", park, "park")]
    {
        if let (Some(Length(low)), Some(Length(high))) = (low, high)
            && high <= low
        {
            let fault = Fault::error(
                "out-of-range",
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
        Fault::error("program-line", span, format!("a line of `{key}` is {}", quoted(line))).label(label),
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
