//! Modes that a profile must set in `start`, and the limits of its dialect: programs state every position, arc and dwell as it reads them.

use crate::spec::machine::{Controller, Dialect, DwellUnit, Heating};
use crate::spec::section::Section;
use crate::spec::{Fault, FaultCode, Vocabulary};

/// A mode: the word that sets it, its name, and whether only arcs need it.
type Mode = (&'static str, &'static str, bool);

const UNITS: Mode = ("G21", "millimetres", false);
const PLANE: Mode = ("G17", "the XY plane", true);
const CENTRES: Mode = ("G91.1", "arc centres relative to the start", true);
const DISTANCE: Mode = ("G90", "absolute positions", false);
const FEED: Mode = ("G94", "feed per minute", false);

/// Modes that a controller of this family keeps from the program before, so that a program must set them.
fn modes(dialect: Dialect) -> &'static [Mode] {
    match dialect {
        Dialect::Generic | Dialect::LinuxCnc | Dialect::Grbl | Dialect::GrblHal | Dialect::FluidNc => {
            &[UNITS, PLANE, CENTRES, DISTANCE, FEED]
        }
        // Arc centres are always relative to the start (reprapfirmware.org, G2).
        Dialect::RepRapFirmware => &[UNITS, PLANE, DISTANCE, FEED],
        Dialect::Klipper => &[UNITS, DISTANCE],
        Dialect::Marlin => &[DISTANCE],
    }
}

/// Whether programs may hold arcs: `arcs` as written, and false where the dialect draws none. A profile that requests arcs there
/// is refused.
pub(super) fn check_arcs(root: &mut Section<'_, '_>, dialect: Dialect, arcs: Option<bool>) -> bool {
    let draws = Vocabulary::of(dialect).draws_arcs();
    if draws || arcs != Some(true) {
        return arcs.unwrap_or(draws);
    }
    let found = format!("`arcs` is true, but G2 and G3 are options of {}", dialect.title());
    let fault = Fault::error(FaultCode::Conflict, root.place_of("arcs"), found)
        .label("must be false for this dialect: the program cuts arcs into chords");
    root.report(fault);
    false
}

/// Reports a profile whose controller is to heat, by a word that it does not read.
pub(super) fn check_heating(root: &mut Section<'_, '_>, dialect: Dialect, heating: Heating) {
    if heating == Heating::Operator || Vocabulary::of(dialect).command(b'M', 109.0).is_some() {
        return;
    }
    let found = format!("`heating` is \"hotend\", but controllers of `{}` read no M109", dialect.name());
    let fault = Fault::error(FaultCode::Conflict, root.place_of("heating"), found)
        .label("must be \"operator\" for this dialect");
    root.report(fault);
}

/// The unit of P in G4 on a controller of the family `dialect`. A profile with another one `written` is refused.
pub(super) fn check_dwell_unit(
    dwell: &mut Section<'_, '_>,
    dialect: Dialect,
    written: Option<DwellUnit>,
) -> DwellUnit {
    let (unit, name, words) = match dialect {
        Dialect::Marlin | Dialect::Klipper | Dialect::RepRapFirmware => {
            (DwellUnit::Milliseconds, "ms", "milliseconds")
        }
        Dialect::Generic | Dialect::LinuxCnc | Dialect::Grbl | Dialect::GrblHal | Dialect::FluidNc => {
            (DwellUnit::Seconds, "s", "seconds")
        }
    };
    if written.is_some_and(|written| written != unit) {
        let found =
            format!("`unit` is not {words}, in which controllers of `{}` read G4's P", dialect.name());
        let fault = Fault::error(FaultCode::Conflict, dwell.place_of("unit"), found)
            .label(format!("must be \"{name}\" for this dialect"));
        dwell.report(fault);
    }
    unit
}

/// Reports the modes that the lines of `start`, in `[program]`, do not set and that programs for `controller` need.
pub(super) fn check_modes(program: &mut Section<'_, '_>, start: &[String], controller: &Controller) {
    if !program.has("start") {
        return;
    }
    let is_set = |word: &str| start.iter().any(|line| words(line).any(|own| own == word));
    let missing: Vec<&Mode> = modes(controller.dialect)
        .iter()
        .filter(|(word, _, for_arcs)| !is_set(word) && (controller.arcs || !for_arcs))
        .collect();
    if missing.is_empty() {
        return;
    }
    let list = |texts: Vec<String>| texts.join(", ");
    let what = list(missing.iter().map(|(_, what, _)| (*what).to_owned()).collect());
    let words = list(missing.iter().map(|(word, ..)| format!("\"{word}\"")).collect());
    let only_arcs = missing.iter().all(|(.., for_arcs)| *for_arcs);
    let or = if only_arcs { "; or write `arcs = false`" } else { "" };
    let found = format!("`start` does not set {what}");
    let fault = Fault::error(FaultCode::ProgramLine, program.place_of("start"), found)
        .label(format!("must hold {words}{or}"));
    program.report(fault);
}

/// The words of a line of code, in capital letters.
fn words(line: &str) -> impl Iterator<Item = String> + use<> {
    let code = line.split([';', '(']).next().unwrap_or_default().to_ascii_uppercase();
    let mut words: Vec<String> = Vec::new();
    for c in code.chars().filter(|c| !c.is_whitespace()) {
        match words.last_mut() {
            Some(word) if !c.is_ascii_alphabetic() => word.push(c),
            _ => words.push(c.to_string()),
        }
    }
    words.into_iter()
}

#[cfg(test)]
mod tests {
    use crate::spec::source::Source;
    use crate::spec::{builtin_machine, read_machine};

    /// The faults' codes of profile `name` with `old` replaced by `new`.
    fn codes(name: &str, old: &str, new: &str) -> Vec<&'static str> {
        let text = builtin_machine(name).expect("built in");
        assert!(text.contains(old), "{old}");
        match read_machine(&Source::new("own", text.replace(old, new))) {
            Ok(_) => Vec::new(),
            Err(faults) => faults.list().iter().map(|fault| fault.code).collect(),
        }
    }

    #[test]
    fn arcs_need_a_dialect_that_draws_them_and_their_modes() {
        let arcs = |name, old, new| codes(name, &format!("arcs = false{old}"), &format!("arcs = true{new}"));
        assert_eq!(arcs("marlin", "", ""), ["conflict"]);
        assert_eq!(arcs("klipper", "", ""), ["conflict"]);
        assert_eq!(arcs("generic", "", ""), ["program-line"]);
        assert_eq!(codes("grbl", "\"G91.1\", ", ""), ["program-line"]);
        assert_eq!(codes("grbl", "\"G17\", \"G91.1\", ", ""), ["program-line"]);
        assert_eq!(codes("reprapfirmware", "\"G17\", ", ""), ["program-line"]);
    }

    #[test]
    fn dwells_and_heating_are_those_of_the_dialect() {
        for name in ["generic", "linuxcnc", "grbl", "grblhal", "fluidnc"] {
            assert_eq!(codes(name, "unit = \"s\"", "unit = \"ms\""), ["conflict"], "{name}");
            assert_eq!(codes(name, "heating = \"operator\"", "heating = \"hotend\""), ["conflict"], "{name}");
        }
        for name in ["marlin", "klipper", "reprapfirmware"] {
            assert_eq!(codes(name, "unit = \"ms\"", "unit = \"s\""), ["conflict"], "{name}");
            assert_eq!(codes(name, "unit = \"ms\"", ""), [""; 0], "{name}");
        }
    }

    #[test]
    fn modes_may_share_a_line_and_those_that_nothing_needs_may_be_left_out() {
        assert_eq!(
            codes(
                "grbl",
                "[\"G21\", \"G17\", \"G91.1\", \"G90\", \"G94\"]",
                "[\"G21G17 G91.1\", \"G90 G94\"]"
            ),
            [""; 0]
        );
        assert_eq!(codes("generic", "\"G17\", ", ""), [""; 0]);
        assert_eq!(codes("generic", "\"G21\", ", ""), ["program-line"]);
        assert_eq!(codes("generic", ", \"G94\"]", "]"), ["program-line"]);
        assert_eq!(codes("marlin", "\"G90\", ", ""), ["program-line"]);
    }
}
