//! Modes that a profile must set in `start`, and the limits of its dialect: programs state every position, arc and dwell as it reads them.

use crate::dialect::{Dialect, DialectFamily};
use crate::machine::{Controller, DwellUnit, Heating};
use crate::section::Section;
use crate::{Command, FaultCode, Vocabulary};

/// Modes on which programs depend: the command, the word that sets it, its name, and whether only arcs need it.
const MODES: [(Command, &str, &str, bool); 5] = [
    (Command::Millimetres, "G21", "millimetres", false),
    (Command::PlaneXy, "G17", "the XY plane", true),
    (Command::CentersRelative, "G91.1", "arc centres relative to the start", true),
    (Command::Absolute, "G90", "absolute positions", false),
    (Command::PerMinute, "G94", "feed per minute", false),
];

/// Whether programs may hold arcs: `arcs` as written, and false where the dialect draws none. A profile that requests arcs there
/// is refused.
pub(super) fn check_arcs(root: &mut Section<'_, '_>, dialect: Dialect, arcs: Option<bool>) -> bool {
    let draws = Vocabulary::for_dialect(dialect).draws_arcs;
    if draws || arcs != Some(true) {
        return arcs.unwrap_or(draws);
    }
    let problem = format!("`arcs` is true, but G2 and G3 are options of {}", dialect.title());
    let allowed = "must be false for this dialect: the program cuts arcs into chords";
    root.refuse(FaultCode::Conflict, "arcs", problem, allowed);
    false
}

/// Reports a profile whose controller is to heat, by a word that it does not read.
pub(super) fn check_heating(root: &mut Section<'_, '_>, dialect: Dialect, heating: &Heating) {
    let word = match heating {
        Heating::Operator => return,
        Heating::Hotend(_) if Vocabulary::for_dialect(dialect).command(b'M', 109.0).is_some() => return,
        Heating::Heater(_) if dialect == Dialect::Klipper => return,
        Heating::Hotend(_) => "M109",
        Heating::Heater(_) => "SET_HEATER_TEMPERATURE",
    };
    let (heating, name) = (heating.name(), dialect.name());
    let problem = format!("`heating` is \"{heating}\", but controllers of `{name}` read no {word}");
    let allowed = if word == "M109" {
        "must be \"operator\" for this dialect"
    } else {
        "must be \"operator\" or \"hotend\" for this dialect: Klipper alone has heaters with a name"
    };
    root.refuse(FaultCode::Conflict, "heating", problem, allowed);
}

/// The unit of P in G4 on a controller of `dialect`. A profile with another one `stated` is refused.
pub(super) fn check_dwell_unit(
    dwell: &mut Section<'_, '_>,
    dialect: Dialect,
    stated: Option<DwellUnit>,
) -> DwellUnit {
    let (unit, name, words) = match dialect.family() {
        DialectFamily::Printer => (DwellUnit::Milliseconds, "ms", "milliseconds"),
        DialectFamily::Plain | DialectFamily::Mill => (DwellUnit::Seconds, "s", "seconds"),
    };
    if stated.is_some_and(|stated| stated != unit) {
        let problem =
            format!("`unit` is not {words}, in which controllers of `{}` read G4's P", dialect.name());
        dwell.refuse(FaultCode::Conflict, "unit", problem, format!("must be \"{name}\" for this dialect"));
    }
    unit
}

/// Reports the modes that the lines of `start`, in `[program]`, do not set and that programs for `controller` need.
pub(super) fn check_modes(program: &mut Section<'_, '_>, start: &[String], controller: &Controller) {
    if !program.contains("start") {
        return;
    }
    let set_words: Vec<String> = start.iter().flat_map(|line| words(line)).collect();
    // Other modes a controller keeps from the program before.
    let fixed = Vocabulary::for_dialect(controller.dialect).fixed;
    let required =
        MODES.iter().filter(|(mode, .., for_arcs)| !fixed.contains(mode) && (controller.arcs || !for_arcs));
    let missing: Vec<_> = required.filter(|(_, word, ..)| !set_words.iter().any(|set| set == word)).collect();
    if missing.is_empty() {
        return;
    }
    let meanings: Vec<&str> = missing.iter().map(|(_, _, what, _)| *what).collect();
    let words: Vec<String> = missing.iter().map(|(_, word, ..)| format!("\"{word}\"")).collect();
    let only_arcs = missing.iter().all(|(.., for_arcs)| *for_arcs);
    let alternative = if only_arcs { "; or write `arcs = false`" } else { "" };
    let problem = format!("`start` does not set {}", meanings.join(", "));
    let allowed = format!("must hold {}{alternative}", words.join(", "));
    program.refuse(FaultCode::ProgramLine, "start", problem, allowed);
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
    use super::*;
    use crate::source::Source;
    use crate::{builtin_machine, read_machine};

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
        for (name, dialect) in Dialect::ALL {
            match dialect.family() {
                DialectFamily::Plain | DialectFamily::Mill => {
                    assert_eq!(codes(name, "unit = \"s\"", "unit = \"ms\""), ["conflict"], "{name}");
                    let hotend = codes(name, "heating = \"operator\"", "heating = \"hotend\"");
                    assert_eq!(hotend, ["conflict"], "{name}");
                }
                DialectFamily::Printer => {
                    assert_eq!(codes(name, "unit = \"ms\"", "unit = \"s\""), ["conflict"], "{name}");
                    assert_eq!(codes(name, "unit = \"ms\"", ""), [""; 0], "{name}");
                }
            }
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
