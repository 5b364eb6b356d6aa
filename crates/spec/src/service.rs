//! Service lines of printers: they home, level, warm and reset the machine before the first move of a program.
//!
//! A row of a table is a line with the controllers that read it. A value follows where the row ends in `=` or in a letter. Sources:
//! Marlin, marlinfw.org/docs/gcode; Prusa-Firmware, `Marlin_main.cpp` (G28 W); Klipper, docs/G-Codes.md; RepRapFirmware,
//! docs.duet3d.com; Bambu, `resources/profiles/BBL/machine` of the repository bambulab/BambuStudio.

use self::Argument as F;
use crate::dialect::Dialect;
use crate::name::is_plain_word;
use crate::units::Temperature;

/// The highest temperature of a bed or a chamber while a sheet lies in it. Soft polyurethane softens from about 70 C on (Vicat), and
/// two coated sides that lie on each other then stick without a seam.
pub const WARMEST: Temperature = Temperature(60.0);

/// The effect of a service line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Service {
    /// These of the axes X, Y and Z go to their switches, and their coordinates are known from here on.
    Home([bool; 3]),
    /// The heights of the bed correct Z along every path from here on.
    Level,
    /// The bed or the chamber gets a temperature.
    Warm(Warming),
    /// The fan of the hotend is off.
    FanOff,
    /// Feeds are multiplied by this number of per cent.
    FeedOverride(f64),
    /// The controller no longer clamps positions to the range of its axes.
    EndstopsOff,
    /// The motors hold.
    MotorsOn,
}

/// A temperature of what is not the iron.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Warming {
    /// Bed or chamber.
    pub part: WarmPart,
    /// In degrees Celsius; 0 turns it off.
    pub celsius: f64,
    /// Whether the program waits until it is warm.
    pub waits: bool,
}

/// A heater that is not the iron.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WarmPart {
    /// The bed.
    Bed,
    /// The chamber.
    Chamber,
}

impl WarmPart {
    /// The name in messages.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Bed => "bed",
            Self::Chamber => "chamber",
        }
    }
}

/// The values that follow a row's text.
#[derive(Clone, Copy)]
enum Argument {
    /// None: the line is the row's text.
    Whole(Service),
    /// The axes to home; all without any.
    Axes,
    /// A name.
    Named(Service),
    /// A temperature, and whether the line waits for it.
    Warm(WarmPart, bool),
    /// Per cent of the feed.
    Override,
}

/// A text and the values behind it.
type ServiceRow = (&'static str, Argument);

const ALL_AXES: Argument = F::Whole(Service::Home([true; 3]));
const LEVEL: Argument = F::Whole(Service::Level);
const FAN_OFF: Argument = F::Whole(Service::FanOff);
const ENDSTOPS_OFF: Argument = F::Whole(Service::EndstopsOff);

/// Lines that all printers read.
const COMMON: [ServiceRow; 5] = [
    ("G28", F::Axes),
    ("M140 S", F::Warm(WarmPart::Bed, false)),
    ("M190 S", F::Warm(WarmPart::Bed, true)),
    ("M107", FAN_OFF),
    ("M220 S", F::Override),
];
/// Lines for chambers and motors, which Klipper does not read.
const FIRMWARE: [ServiceRow; 4] = [
    ("M141 S", F::Warm(WarmPart::Chamber, false)),
    ("M191 S", F::Warm(WarmPart::Chamber, true)),
    ("M17", F::Whole(Service::MotorsOn)),
    ("G29", LEVEL),
];
/// Marlin; G28 W of Prusa's AVR boards homes without levelling. Their G80 levels, too, but on later boards it also retracts and feeds
/// filament (Prusa-Firmware-Buddy, gcode/calibrate/G80.cpp), so it is unknown.
const MARLIN: [ServiceRow; 3] = [("G28 W", ALL_AXES), ("M420 S1", LEVEL), ("M211 S0", ENDSTOPS_OFF)];
/// Klipper. Its `position_min` is a setting, which no line turns off.
const KLIPPER: [ServiceRow; 2] =
    [("BED_MESH_CALIBRATE", LEVEL), ("BED_MESH_PROFILE LOAD=", F::Named(Service::Level))];
/// RepRapFirmware.
const REPRAPFIRMWARE: [ServiceRow; 3] = [("G29 S1", LEVEL), ("M106 S0", FAN_OFF), ("M564 S0", ENDSTOPS_OFF)];

/// Bambu: the soft endstops are off by axis, a fan is off by its number.
const BAMBU: [ServiceRow; 2] = [("M106 P1 S0", FAN_OFF), ("M211 X0 Y0 Z0", ENDSTOPS_OFF)];

/// Longest name of a mesh, in characters.
const NAME_LENGTH: usize = 32;

/// The rows that controllers of `dialect` read.
fn rows(dialect: Dialect) -> impl Iterator<Item = &'static ServiceRow> {
    let tables: &[&[ServiceRow]] = match dialect {
        Dialect::Generic | Dialect::LinuxCnc | Dialect::Grbl | Dialect::GrblHal | Dialect::FluidNc => &[],
        Dialect::Marlin => &[&COMMON, &FIRMWARE, &MARLIN],
        Dialect::Klipper => &[&COMMON, &KLIPPER],
        Dialect::RepRapFirmware => &[&COMMON, &FIRMWARE, &REPRAPFIRMWARE],
        Dialect::Bambu => &[&COMMON, &FIRMWARE, &BAMBU],
    };
    tables.iter().flat_map(|table| table.iter())
}

impl Service {
    /// The effect of `line` on a controller of `dialect`; `None` if it is no service line.
    pub fn read(line: &str, dialect: Dialect) -> Option<Self> {
        // Most lines of a program are moves.
        if line.starts_with("G1") || line.starts_with("G0") {
            return None;
        }
        rows(dialect).find_map(|(text, argument)| argument.read(line.strip_prefix(text)?))
    }

    /// The service lines that controllers of `dialect` read, in words.
    pub(crate) fn lines(dialect: Dialect) -> impl Iterator<Item = String> {
        rows(dialect).map(|(text, argument)| match argument {
            Argument::Whole(_) | Argument::Axes => (*text).to_owned(),
            Argument::Named(_) | Argument::Warm(..) => format!("{text}.."),
            Argument::Override => format!("{text}100"),
        })
    }

    /// Whether controllers of `dialect` read any service line.
    pub fn is_read_by(dialect: Dialect) -> bool {
        rows(dialect).next().is_some()
    }

    /// Whether controllers of `dialect` have a line that lets Z go below the range of its axis.
    pub fn can_free_endstops(dialect: Dialect) -> bool {
        rows(dialect).any(|(_, argument)| matches!(argument, Argument::Whole(Self::EndstopsOff)))
    }
}

impl Argument {
    /// The effect of a line that ends in `rest` behind the row's text.
    fn read(self, rest: &str) -> Option<Service> {
        match self {
            Self::Whole(service) => rest.is_empty().then_some(service),
            Self::Axes => axes(rest).map(Service::Home),
            Self::Named(service) => (rest.len() <= NAME_LENGTH && is_plain_word(rest)).then_some(service),
            Self::Warm(part, waits) => {
                amount(rest).map(|celsius| Service::Warm(Warming { part, celsius, waits }))
            }
            Self::Override => amount(rest).map(Service::FeedOverride),
        }
    }
}

/// The axes that ` X Y Z` or ` X0 Y0 Z0` name, each once; all of them for nothing.
fn axes(rest: &str) -> Option<[bool; 3]> {
    let mut axes = [false; 3];
    for word in rest.strip_prefix(' ').unwrap_or_default().split(' ') {
        let axis = match word.strip_suffix('0').unwrap_or(word) {
            "X" => 0,
            "Y" => 1,
            "Z" => 2,
            _ => return rest.is_empty().then_some([true; 3]),
        };
        if std::mem::replace(&mut axes[axis], true) {
            return None;
        }
    }
    Some(axes)
}

/// A whole number of at most three digits.
fn amount(rest: &str) -> Option<f64> {
    let is_plain = (1..=3).contains(&rest.len()) && rest.bytes().all(|byte| byte.is_ascii_digit());
    rest.parse().ok().filter(|_| is_plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn warm(part: WarmPart, celsius: f64, waits: bool) -> Service {
        Service::Warm(Warming { part, celsius, waits })
    }

    #[test]
    fn lines_have_their_effects() {
        let marlin = |line| Service::read(line, Dialect::Marlin);
        assert_eq!(marlin("G28"), Some(Service::Home([true; 3])));
        assert_eq!(marlin("G28 W"), Some(Service::Home([true; 3])));
        assert_eq!(marlin("G28 X Y0"), Some(Service::Home([true, true, false])));
        assert_eq!(marlin("M190 S45"), Some(warm(WarmPart::Bed, 45.0, true)));
        assert_eq!(marlin("M141 S0"), Some(warm(WarmPart::Chamber, 0.0, false)));
        assert_eq!(marlin("M220 S50"), Some(Service::FeedOverride(50.0)));
        assert_eq!(marlin("M211 S0"), Some(Service::EndstopsOff));
        let klipper = |line| Service::read(line, Dialect::Klipper);
        assert_eq!(klipper("BED_MESH_PROFILE LOAD=default"), Some(Service::Level));
        assert_eq!(Service::read("G29 S1", Dialect::RepRapFirmware), Some(Service::Level));
    }

    #[test]
    fn other_lines_have_none() {
        for (name, dialect) in Dialect::ALL {
            for line in [
                "G28X",
                "G28 X X",
                "G28  X",
                "G28 X5",
                "G28 E",
                "G28 ; all",
                "M190 S1e2",
                "M190 R60",
                "M190",
                "M220 S100 B",
                "M220",
                "M107 P1",
                "M211 S1",
                "BED_MESH_PROFILE LOAD=",
                "BED_MESH_PROFILE LOAD=a SAVE=b",
                "BED_MESH_PROFILE REMOVE=a",
                "G1 X5",
                "G92 Z0",
                "M302",
                "",
            ] {
                assert_eq!(Service::read(line, dialect), None, "{name}: {line:?}");
            }
        }
        for mill in [Dialect::Generic, Dialect::Grbl, Dialect::LinuxCnc] {
            assert_eq!(Service::read("G28", mill), None);
        }
    }
}
