//! Reads the laser of a machine: its full power, its focus, and whether the controller is in laser mode.

use crate::FaultCode;
use crate::allowed::Allowed;
use crate::dialect::Dialect;
use crate::fault::Fault;
use crate::laser::read_focus;
use crate::machine::{LaserDrive, SealingTool};
use crate::section::{Reader, Section};
use crate::units::Length;

/// S words of full power.
const FULL_POWERS: Allowed = Allowed::closed(1.0, 1e6);

/// The section `[laser]`: the laser, and the height of its focus above the sheet.
pub(super) struct LaserSection {
    pub(super) drive: LaserDrive,
    pub(super) focus: Length,
}

/// Reads `[laser]` of a machine with `tool`; `None` unless that is a laser. Keys are read in any case, so that each is known.
pub(super) fn read_laser(reader: &mut Reader<'_>, tool: SealingTool) -> Option<LaserSection> {
    let mut section = reader.section("laser");
    let is_laser = tool == SealingTool::Laser;
    section.require_if(
        is_laser,
        &[("full_power", "1000"), ("focus", "\"12 mm\""), ("laser_mode", "true, once $32=1 is set")],
    );
    let full_power = section.number("full_power", FULL_POWERS).unwrap_or(1000.0);
    let focus = read_focus(&mut section).unwrap_or(Length(12.0));
    if section.truth("laser_mode") == Some(false) {
        let (message, allowed) = (
            "`laser_mode` is false",
            "must be true: set $32=1 on the controller (FluidNC: a Laser spindle in its configuration), then write true",
        );
        section.refuse(FaultCode::Conflict, "laser_mode", message, allowed);
    }
    if section.is_written() && !is_laser {
        let fault = Fault::error(FaultCode::Conflict, section.place(), "[laser] without `tool = \"laser\"`")
            .label("it is for a laser")
            .help("write tool = \"laser\" before the first section, or delete [laser]");
        section.report(fault);
    }
    is_laser.then_some(LaserSection { drive: LaserDrive { full_power }, focus })
}

/// Reports a laser's profile with keys of irons, or for a controller outside of GRBL's family: no other has M4 with a power that follows
/// the speed, and G0 without power.
pub(super) fn check_laser(root: &mut Section<'_, '_>, dialect: Dialect) {
    if !dialect.drives_lasers() {
        let message = format!("`dialect` is \"{}\", and `tool` is \"laser\"", dialect.name());
        let allowed = "must be grbl, grblhal or fluidnc: programs for lasers are written for these";
        root.refuse(FaultCode::Conflict, "dialect", message, allowed);
    }
    for (key, remedy) in [
        ("heating", "delete it: `power` in [seal] of the spec heats"),
        ("spring_loaded", "delete it: a laser touches nothing"),
    ] {
        if root.contains(key) {
            let fault =
                Fault::error(FaultCode::Conflict, root.place_of(key), format!("`{key}` beside a laser"));
            root.report(fault.label("a laser does not have it").help(remedy));
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::source::Source;
    use crate::units::Length;
    use crate::{LASER_PROFILE, LaserDrive, Machine, SealingTool, builtin_machine, read_machine};

    /// The faults' codes and words of the laser's profile with `old` replaced by `new`.
    fn faults(old: &str, new: &str) -> (Vec<&'static str>, String) {
        let text = builtin_machine(LASER_PROFILE).expect("built in");
        assert!(text.contains(old), "{old}");
        match read_machine(&Source::new("mine", text.replacen(old, new, 1))) {
            Ok(_) => (Vec::new(), String::new()),
            Err(faults) => (faults.list().iter().map(|fault| fault.code).collect(), faults.to_string()),
        }
    }

    #[test]
    fn the_focus_takes_the_place_of_a_contact() {
        let machine = Machine::builtin(LASER_PROFILE).expect("built in");
        assert_eq!(
            (machine.tool, machine.controller.laser),
            (SealingTool::Laser, Some(LaserDrive { full_power: 1000.0 }))
        );
        assert_eq!(machine.process.heights.contact, Length(12.0));
        assert!(!machine.process.spring_loaded && machine.controller.heating_name() == "laser");
    }

    #[test]
    fn every_fault_of_a_lasers_profile_has_its_code_and_its_remedy() {
        for (old, new, code, words) in [
            ("laser_mode = true", "laser_mode = false", "conflict", "set $32=1 on the controller"),
            ("laser_mode = true", "", "missing-key", "once $32=1 is set"),
            ("full_power = 1000 ", "full_power = 0 ", "out-of-range", "at least 1"),
            ("travel = \"13 mm\"", "travel = \"12 mm\"", "out-of-range", "must be above `focus`, 12 mm"),
            ("[heights]\n", "[heights]\ncontact = \"0 mm\"\n", "conflict", "`focus` in [laser]"),
            ("dialect = \"grbl\"", "dialect = \"linuxcnc\"", "conflict", "must be grbl, grblhal or fluidnc"),
            ("comments = ", "heating = \"operator\"\ncomments = ", "conflict", "`power` in [seal]"),
            ("comments = ", "spring_loaded = true\ncomments = ", "conflict", "touches nothing"),
            ("tool = \"laser\"", "tool = \"iron\"", "conflict", "write tool = \"laser\""),
            ("start = [\"M5\", ", "start = [", "program-line", "must hold \"M5\""),
            ("end = [\"M5\", ", "end = [", "program-line", "must hold \"M5\""),
            ("start = [\"M5\"", "start = [\"M4 S10\", \"M5\"", "program-line", "must be one of"),
            ("start = [\"M5\"", "start = [\"M3 S1000\", \"M5\"", "program-line", "must be one of"),
            ("end = [\"M5\"", "end = [\"S0\", \"M5\"", "program-line", "must be one of"),
            ("pause = \"M0\"", "pause = \"M5\"", "program-line", "must be one of"),
        ] {
            let (codes, text) = faults(old, new);
            assert!(codes.contains(&code), "{new}: {text}");
            assert!(text.contains(words), "{new}: {text}");
        }
        for dialect in ["grblhal", "fluidnc"] {
            assert_eq!(faults("dialect = \"grbl\"", &format!("dialect = \"{dialect}\"")).1, "");
        }
    }
}
