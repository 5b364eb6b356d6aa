//! From a machine profile's text to the [`Machine`], a file a subject.
//!
//! A new key is added in three steps: a field in [`Machine`]'s part, a line in the file that reads this part (which registers the
//! key and gives its range), and a commented line in each profile that needs it.

mod builtin;
mod controller;
mod known;
mod laser;
mod line;
mod modes;
mod motion;
mod order;
mod process;
mod recognition;
mod script;

use crate::dialect::Dialect;
use crate::faults::Faults;
use crate::foreign::Document;
use crate::machine::{Machine, Script, SealingTool};
use crate::name::misleads;
use crate::profile::controller::{read_controller, read_dwells};
use crate::profile::laser::{check_laser, read_laser};
use crate::profile::motion::read_motion;
use crate::profile::process::{read_bench, read_origin, read_process, read_tip};
use crate::profile::script::read_script;
use crate::reading::{read_schema, read_with};
use crate::section::Reader;
use crate::source::Source;
use crate::value::RawValue;
use crate::{Code, FaultCode};

pub use builtin::{builtin_machine, builtin_machines, usual_profile};
pub use motion::{FIRST_STEP_RATE, LEAST_ACCELERATION, MOST_ACCELERATION};
pub use recognition::{UNSERVED_MACHINES, UnservedMachine, machine_remedy};
pub use script::limits_set_by;

/// Longest description, in characters.
const DESCRIPTION_LENGTH: usize = 200;

/// Reads a machine profile.
///
/// # Errors
/// All faults of the text at once, if at least one refuses it.
pub fn read_machine(source: &Source) -> Result<Machine, Faults> {
    read_with(source, Document::Profile, read_profile).map(|(machine, _, _)| machine)
}

/// Takes a profile's keys out of the document of `reader`.
pub(crate) fn read_profile(reader: &mut Reader<'_>) -> Machine {
    let mut root = reader.root();
    root.require(&[("schema", "1"), ("name", "\"my machine\"")]);
    read_schema(&mut root, 1);
    let name = root.name().unwrap_or_default();
    let description = root.checked_text("description", FaultCode::Name, |text| {
        let is_wrong = text.chars().any(misleads) || text.chars().count() > DESCRIPTION_LENGTH;
        is_wrong.then(|| format!("must be one line of at most {DESCRIPTION_LENGTH} characters"))
    });
    let description = description.unwrap_or_default();
    let tools = [("iron", SealingTool::Iron), ("press", SealingTool::Press), ("laser", SealingTool::Laser)];
    let tool = root.choice("tool", &tools).unwrap_or(SealingTool::Iron);
    if tool == SealingTool::Press {
        return Machine::press(name, description);
    }
    root.require(&[("dialect", "\"generic\"")]);
    let mut controller = read_controller(&mut root);
    let tip = read_tip(&mut root);
    if tool == SealingTool::Laser {
        check_laser(&mut root, controller.dialect);
    }
    controller.dwell = read_dwells(&mut reader.section("dwell"), controller.dialect);
    let laser = read_laser(reader, tool);
    controller.laser = laser.as_ref().map(|laser| laser.drive);
    let process = read_process(reader, tip, laser.map(|laser| laser.focus));
    (controller.place.x, controller.place.y) = read_origin(&mut reader.section("origin"));
    let bench = read_bench(reader, controller.place);
    let motion = read_motion(&mut reader.section("motion"), controller.dialect);
    let mut machine =
        Machine { name, description, tool, controller, process, bench, motion, script: Script::default() };
    machine.script = read_script(reader, &machine);
    if !has_known_dialect(reader) {
        // Which words, units and lines are allowed follows from the dialect: faults by another one would mislead.
        let of_dialect = [FaultCode::Conflict, FaultCode::ProgramLine].map(FaultCode::as_str);
        reader.faults.retain(|fault| !of_dialect.contains(&fault.code));
    }
    machine
}

/// Whether the profile names a dialect that exists.
fn has_known_dialect(reader: &Reader<'_>) -> bool {
    let name = reader.raw.root().get("dialect").and_then(RawValue::as_text);
    name.is_some_and(|name| Dialect::ALL.iter().any(|(known_name, _)| *known_name == name))
}

impl Machine {
    /// The machine that comes with the program under `name`: "generic", "grbl" and so on, as [`builtin_machines`] lists.
    ///
    /// # Errors
    /// If there is no such machine.
    pub fn builtin(name: &str) -> Result<Self, String> {
        let text = builtin_machine(name);
        // A profile of our own that does not read is a fault of this program; a test reads each of them.
        let machine = text.and_then(|text| read_machine(&Source::new(name, text)).ok());
        machine.ok_or_else(|| {
            let names: Vec<&str> = builtin_machines().collect();
            format!("no machine {name:?} comes with the program; there are {}", names.join(", "))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Length;

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
        assert_eq!(machine.process.heights.contact, Length(-0.3));
        assert_eq!(
            (machine.process.heights.travel, machine.process.heights.park),
            (Length(5.0), Length(30.0))
        );
        assert_eq!(
            (machine.controller.line_length, machine.process.ramp, machine.bench.work_area),
            (72, Length(3.0), None)
        );
        assert_eq!(machine.script.start, ["G21", "G17", "G90", "G94"]);
        assert_eq!((machine.script.pause.as_str(), machine.script.end), ("M0", vec!["M2".to_owned()]));
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
        let of_length = |n: usize| format!("\"M2{}\"", " ".repeat(n - 2));
        assert_eq!(codes("\"M2\"", &of_length(72)), [""; 0]);
        assert_eq!(codes("\"M2\"", &of_length(73)), ["program-line"]);
        assert_eq!(codes("\"M0\"", "\"\\u0000\""), ["program-line"]);
        assert_eq!(codes("\"M0\"", "\" \""), ["program-line"]);
        assert_eq!(codes("[\"M2\"]", "[]"), ["program-line"]);
        assert_eq!(codes("[\"M2\"]", "[\"M2\", \"G21\"]"), ["program-line"; 2]);
    }

    #[test]
    fn marlin_is_never_without_a_floor() {
        let read = |name: &str, old: &str| {
            let text = builtin_machine(name).expect("built in");
            assert!(text.contains(old));
            let text = text.replace(old, "min_step_rate = \"none\"");
            read_machine(&Source::new(name, text)).map_err(|faults| faults.list()[0].code)
        };
        assert_eq!(read("marlin", "min_step_rate = 32").map(|_| ()), Err("conflict"));
        assert!(read("grblhal", "min_step_rate = 9.54").is_ok());
    }

    /// Lines, units and lengths are those of a dialect: none is judged by another one in its place.
    #[test]
    fn an_unknown_dialect_is_the_only_fault() {
        for name in builtin_machines() {
            let text = builtin_machine(name).expect("built in");
            let Some(line) = text.lines().find(|line| line.starts_with("dialect = ")) else { continue };
            for (dialect, code) in [("dialect = \"marlni\"", "unknown-choice"), ("", "missing-key")] {
                let faults =
                    read_machine(&Source::new(name, text.replacen(line, dialect, 1))).expect_err(name);
                let codes: Vec<&str> = faults.list().iter().map(|fault| fault.code).collect();
                assert_eq!(codes, [code], "{name}: {faults}");
            }
        }
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
        let filled_in =
            text.replace("x = \"unknown\"", "x = \"60 cm\"").replace("y = \"unknown\"", "y = \"400 mm\"");
        let machine = read_machine(&Source::new("known", filled_in)).expect("valid");
        assert_eq!(machine.bench.work_area, Some((Length(600.0), Length(400.0))));
        assert_eq!(codes("x = \"unknown\"", "x = \"60 cm\""), ["conflict"]);
        assert_eq!(codes("x = \"unknown\"", "x = 600"), ["conflict", "no-unit"]);
        assert_eq!(codes("x = \"unknown\"\ny = \"unknown\"", ""), [""; 0]);
    }
}

#[cfg(test)]
mod builtin_tests {
    use super::*;

    #[test]
    fn every_listed_machine_is_there_and_no_other() {
        for name in builtin_machines() {
            assert!(Machine::builtin(name).is_ok(), "{name}");
        }
        let fault = Machine::builtin("grlb").expect_err("a typo");
        assert!(fault.contains("\"grlb\"") && fault.contains("grbl, "), "{fault}");
    }
}
