//! A laser in place of an iron: its spot welds by power and speed, from the height of its focus, and touches nothing.
//!
//! `power` in `[seal]` makes a spec one for a laser. A profile of the user's own may be a laser, too: it is read later, and then
//! compared with the spec.

use std::ops::Range;

use crate::allowed::Allowed;
use crate::fault::{Fault, quoted};
use crate::machine::to_micrometres;
use crate::profile::builtin_machine;
use crate::raw::RawSpec;
use crate::section::Section;
use crate::source::Source;
use crate::units::Length;
use crate::value::{RawTable, RawValue};
use crate::{FaultCode, key};

/// The name of the built-in profile of a laser.
pub const LASER_PROFILE: &str = "grbl-laser";

/// Powers of a seal, as parts of full power, %.
pub const POWERS: Allowed = Allowed::half_open(0.0, 100.0);
/// Heights of a laser's focus above the sheet, mm.
pub const FOCUSES: Allowed = Allowed::half_open(0.0, 500.0);

/// The word of a laser that cuts, in `[cut]`.
pub(super) const CUT_BY_LASER: &str = "laser";

/// Reads `focus`, in whole micrometres as other heights.
pub(super) fn read_focus(s: &mut Section<'_, '_>) -> Option<Length> {
    s.quantity("focus", FOCUSES).map(|Length(mm)| Length(to_micrometres(mm)))
}

/// Whether `source` is a spec for a laser, whatever faults it has.
pub fn seals_by_laser(source: &Source) -> bool {
    let (raw, _) = RawSpec::parse(&source.text);
    place_of(&raw, "seal", "power").is_some()
}

/// Keys outside of processes that a spec for a laser does not have: section, key, and the remedy.
const OF_IRONS: [(&str, &str, &str); 1] = [(
    "machine",
    "feed_floor",
    "strokes and dwells would burn holes: write a `speed` that the machine holds",
)];

/// Keys that neither `[seal]` nor a process has for a laser, with the remedy.
const OF_IRON_PROCESSES: [(&str, &str); 2] = [
    ("temperature", "delete it: `power` takes its place"),
    ("height", "a laser touches nothing: write `focus`, its height above the sheet"),
];

/// A fault for everything in `raw` that a laser does not have, and for every key of a laser without one. `profile` is the name of the
/// machine.
pub(super) fn faults(raw: &RawSpec, profile: &str) -> Vec<Fault> {
    let Some(power) = place_of(raw, "seal", "power") else { return without_power(raw, profile) };
    if profile != LASER_PROFILE && builtin_machine(profile).is_some() {
        let message = format!("`power` in [seal] beside the machine {}", quoted(profile));
        let help = format!("write profile = \"{LASER_PROFILE}\" in [machine], or delete `power`");
        let fault = Fault::error(FaultCode::Conflict, power, message);
        return vec![fault.label("only a laser has a power").help(help)];
    }
    let mut faults = Vec::new();
    if place_of(raw, "seal", "tip").is_none() {
        let fault = Fault::error(FaultCode::MissingKey, power, "`power` in [seal] without `tip`")
            .label("the number of lines follows from the width of the spot");
        faults
            .push(fault.help("for example tip = \"0.5 mm\": weld one line on scrap, and measure its width"));
    }
    for (section, key, remedy) in OF_IRONS {
        let place = place_of(raw, section, key);
        faults.extend(place.map(|place| of_iron(place, &format!("`{key}` in [{section}]"), remedy)));
    }
    if let Some(place) = place_of(raw, "cut", "tool").filter(|_| !cuts_by_laser(raw)) {
        faults.push(of_iron(
            place,
            "this `tool` in [cut]",
            "write tool = \"laser\": nothing takes its place",
        ));
    }
    let seal = raw.root().get("seal").and_then(RawValue::as_table).map(|seal| ("seal".to_owned(), seal));
    for (section, process) in seal.into_iter().chain(processes(raw)) {
        for (key, remedy) in OF_IRON_PROCESSES {
            let place = place_in(process, key);
            faults.extend(place.map(|place| of_iron(place, &format!("`{key}` in [{section}]"), remedy)));
        }
    }
    faults
}

/// The fault of a key of irons, called `subject`, in a spec for a laser.
fn of_iron(place: Range<usize>, subject: &str, remedy: &str) -> Fault {
    let message = format!("{subject} beside `power` in [seal]");
    Fault::error(FaultCode::Conflict, place, message).label("a laser does not have it").help(remedy)
}

/// The faults of a spec without `power` in `[seal]`: a machine that needs it, or other keys of a laser.
fn without_power(raw: &RawSpec, profile: &str) -> Vec<Fault> {
    if profile == LASER_PROFILE {
        let message = format!("the machine {} is a laser, and [seal] has no `power`", quoted(profile));
        let fault = Fault::error(FaultCode::MissingKey, raw.span_of(key::machine::PROFILE), message)
            .label("a laser seals by `power` and `speed`");
        let help = "write power = \"10 %\" and `tip`, the width of the spot, into [seal]; a coupon finds the power of your fabric";
        return vec![fault.help(help)];
    }
    let focus = place_of(raw, "seal", "focus").map(|place| ("seal".to_owned(), "focus", place));
    let tool = place_of(raw, "cut", "tool").filter(|_| cuts_by_laser(raw));
    let mut keys_of_lasers: Vec<(String, &str, Range<usize>)> = focus.into_iter().collect();
    keys_of_lasers.extend(tool.map(|place| ("cut".to_owned(), "tool", place)));
    for (section, process) in processes(raw) {
        let places = ["power", "focus"].into_iter().filter_map(|key| Some((key, place_in(process, key)?)));
        keys_of_lasers.extend(places.map(|(key, place)| (section.clone(), key, place)));
    }
    let fault = |(section, key, place): (String, &str, Range<usize>)| {
        let message = format!("`{key}` in [{section}], and no `power` in [seal]");
        let fault = Fault::error(FaultCode::Conflict, place, message).label("it is for a laser");
        fault.help("write `power` into [seal], too, for a laser; or delete it")
    };
    keys_of_lasers.into_iter().map(fault).collect()
}

/// Whether the tool in `[cut]` is a laser.
fn cuts_by_laser(raw: &RawSpec) -> bool {
    let cut = raw.root().get("cut").and_then(RawValue::as_table);
    cut.and_then(|cut| cut.get("tool")).and_then(RawValue::as_text) == Some(CUT_BY_LASER)
}

/// The place of `key` in `section`, if it is written.
fn place_of(raw: &RawSpec, section: &str, key: &str) -> Option<Range<usize>> {
    place_in(raw.root().get(section)?.as_table()?, key)
}

/// The place of `key` in `table`, if it is written.
fn place_in(table: &RawTable, key: &str) -> Option<Range<usize>> {
    table.0.iter().find(|entry| entry.key == key).map(|entry| entry.key_span.clone())
}

/// Every section `process.NAME` of the text, with its name in full.
fn processes(raw: &RawSpec) -> impl Iterator<Item = (String, &RawTable)> {
    let sections = raw.root().get("process").and_then(RawValue::as_table);
    let entries = sections.into_iter().flat_map(|sections| &sections.0);
    entries.filter_map(|entry| Some((format!("process.{}", entry.key), entry.value.as_table()?)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::{Percent, Temperature};
    use crate::{Faults, Reading, read};

    const STAR: &str = "schema = 1\nname = \"x\"\n[star]\npoints = 5\ninner_radius = \"50 mm\"\ntube_width = \"30 mm\"\n\
                        tip_angle = \"30 deg\"\n";
    const SEAL: &str = "[seal]\npower = \"8 %\"\ntip = \"0.5 mm\"\n";
    const MACHINE: &str = "[machine]\nprofile = \"grbl-laser\"\n";

    fn reading(rest: &str) -> Result<Reading, Faults> {
        read(&Source::new("x", format!("{STAR}{rest}")))
    }

    #[test]
    fn a_laser_has_a_power_and_its_processes_too() {
        let rest = format!(
            "outer_process = \"weak\"\n{SEAL}focus = \"12 mm\"\n{MACHINE}[process.weak]\npower = \"5 %\"\n"
        );
        let spec = reading(&rest).unwrap_or_else(|faults| panic!("{faults}")).spec;
        let weak = spec.process("weak").seal;
        assert_eq!((spec.seal.power, weak.power), (Some(Percent(8.0)), Some(Percent(5.0))));
        assert_eq!((weak.temperature, weak.height), (Temperature(0.0), Some(Length(12.0))));
        assert_eq!((spec.seal.heat_in_words(), weak.heat_in_words()), ("8 %".to_owned(), "5 %".to_owned()));
        // A profile of the user's own is read later.
        assert!(reading(&format!("{SEAL}[machine]\nprofile = \"mine.toml\"\n")).is_ok());
    }

    /// Lines are half a spot apart at most: where a band turns, those of its inner side would else leave gaps at the corner.
    #[test]
    fn lines_overlap_by_half_a_spot() {
        for (tip, fewest) in [("2 mm", 1), ("1 mm", 3), ("0.5 mm", 7), ("0.3 mm", 13)] {
            let rest = format!("[seal]\npower = \"8 %\"\ntip = \"{tip}\"\n{MACHINE}");
            let seal = reading(&rest).unwrap_or_else(|faults| panic!("{faults}")).spec.seal;
            let (offsets, spot) = (seal.line_offsets(), seal.tip_width().0);
            assert_eq!(offsets.len(), fewest, "{tip}");
            assert!(offsets.windows(2).all(|pair| pair[1] - pair[0] <= 0.5 * spot + 1e-9), "{offsets:?}");
        }
    }

    /// A spec for a laser whose outer loop is sealed by a process with `keys`.
    fn with_process(keys: &str) -> String {
        format!("outer_process = \"weak\"\n{SEAL}{MACHINE}[process.weak]\n{keys}\n")
    }

    #[test]
    fn every_fault_of_a_laser_has_its_code_and_its_remedy() {
        // Each text has one fault. A key is missing, or only irons have it, or its value is out of range. A key of a laser without
        // a power is one, too. The cut comes last and alone, because its section has required keys of its own.
        // Every fault is compared by its code, and by the part of its text that tells the remedy.
        for (rest, code, words) in [
            (MACHINE.to_owned(), "missing-key", "write power ="),
            (format!("[seal]\npower = \"8 %\"\n{MACHINE}"), "missing-key", "for example tip ="),
            (SEAL.to_owned(), "conflict", "write profile = \"grbl-laser\""),
            (format!("{SEAL}[machine]\nprofile = \"linuxcnc\"\n"), "conflict", "only a laser has a power"),
            (format!("{SEAL}temperature = \"200 C\"\n{MACHINE}"), "conflict", "`power` takes its place"),
            (format!("{SEAL}height = \"-0.1 mm\"\n{MACHINE}"), "conflict", "write `focus`"),
            (format!("{SEAL}{MACHINE}feed_floor = \"chop\"\n"), "conflict", "would burn holes"),
            (with_process("temperature = \"170 C\""), "conflict", "`power` takes its place"),
            (with_process("height = \"0 mm\""), "conflict", "write `focus`"),
            (with_process("lines = 2"), "conflict", "write lines = 7"),
            (format!("[seal]\npower = \"0 %\"\ntip = \"1 mm\"\n{MACHINE}"), "out-of-range", "more than 0 %"),
            (
                format!("[seal]\npower = \"101 %\"\ntip = \"1 mm\"\n{MACHINE}"),
                "out-of-range",
                "at most 100 %",
            ),
            (format!("{SEAL}focus = \"0 mm\"\n{MACHINE}"), "out-of-range", "more than 0 mm"),
            ("[seal]\nfocus = \"12 mm\"\n".to_owned(), "conflict", "it is for a laser"),
            (
                "outer_process = \"weak\"\n[process.weak]\npower = \"5 %\"\n".to_owned(),
                "conflict",
                "no `power` in [seal]",
            ),
        ] {
            let faults = reading(&rest).expect_err(&rest);
            let codes: Vec<&str> = faults.list().iter().map(|fault| fault.code).collect();
            assert_eq!(codes, [code], "{rest}: {faults}");
            assert!(faults.to_string().contains(words), "{rest}: {faults}");
        }
        let cut =
            "[cut]\ntool = \"hot-tip\"\ntemperature = \"350 C\"\nspeed = \"5 mm/s\"\nheight = \"-1 mm\"\n";
        let faults = reading(&format!("{SEAL}{MACHINE}{cut}")).expect_err("a tool");
        assert!(faults.to_string().contains("write tool = \"laser\""), "{faults}");
        let laser = "[cut]\ntool = \"laser\"\npower = \"60 %\"\nspeed = \"10 mm/s\"\nfocus = \"12 mm\"\n";
        assert!(reading(&format!("{SEAL}{MACHINE}{laser}")).is_ok());
        let faults = reading(laser).expect_err("no power in [seal]");
        assert!(faults.to_string().contains("write `power` into [seal], too"), "{faults}");
    }
}
