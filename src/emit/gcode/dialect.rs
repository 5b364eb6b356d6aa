//! What controllers say differently, as a table. None of it decides geometry, order or times.

use crate::emit::number::Decimals;
use crate::spec::{Dialect, DwellUnit};
use crate::units::Temperature;

/// The spelling of one dialect.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spelling {
    /// Whether a dwell is told a millisecond short: the controller rounds it up to a whole step in 32-bit floats
    /// (nuts_bolts.c, delay_sec), and no rounding of the float shall make it a step longer.
    dwell_early: bool,
    /// Whether G0 is G1 by another name: it runs at the feed in force (Klipper, gcode_move.py, cmd_G1; Marlin, G0_G1.cpp,
    /// without `G0_FEEDRATE`; RepRapFirmware, GCodes.cpp, outside of CNC mode).
    pub(super) travel_at_feed: bool,
    /// What its display shows.
    progress: Progress,
}

/// How the display is told the job's progress.
#[derive(Clone, Copy, Debug)]
enum Progress {
    /// There is no command for it.
    None,
    /// M73 with the per cent done (Klipper, extras/display_status.py).
    Percent,
    /// M73 with the per cent done and the minutes to go.
    PercentAndMinutes,
}

/// Every dialect: whether dwells are told early, whether travels need a feed, and its display.
const SPELLINGS: [(Dialect, bool, bool, Progress); 8] = [
    (Dialect::Generic, false, false, Progress::None),
    (Dialect::LinuxCnc, false, false, Progress::None),
    (Dialect::Grbl, true, false, Progress::None),
    (Dialect::GrblHal, true, false, Progress::None),
    (Dialect::FluidNc, false, false, Progress::None),
    (Dialect::Marlin, false, true, Progress::PercentAndMinutes),
    (Dialect::Klipper, false, true, Progress::Percent),
    (Dialect::RepRapFirmware, false, true, Progress::PercentAndMinutes),
];

impl Spelling {
    /// The spelling of `dialect`.
    pub(super) fn of(dialect: Dialect) -> Self {
        let row = SPELLINGS.iter().find(|(known, ..)| *known == dialect);
        let (_, dwell_early, travel_at_feed, progress) = row.copied().unwrap_or(SPELLINGS[0]);
        Self { dwell_early, travel_at_feed, progress }
    }

    /// A wait of `seconds`, whole milliseconds.
    pub(super) fn dwell(self, unit: DwellUnit, seconds: f64) -> String {
        let seconds = if self.dwell_early { seconds - 0.001 } else { seconds };
        let time = match unit {
            DwellUnit::Seconds => Decimals::exactly(3).text(seconds),
            DwellUnit::Milliseconds => Decimals::exactly(0).text(seconds * 1e3),
        };
        format!("G4 P{time}")
    }

    /// The display's progress, where there is a command for it: whole per cent done, whole minutes to go.
    pub(super) fn progress(self, percent: u32, minutes: u32) -> Option<String> {
        match self.progress {
            Progress::None => None,
            Progress::Percent => Some(format!("M73 P{percent}")),
            Progress::PercentAndMinutes => Some(format!("M73 P{percent} R{minutes}")),
        }
    }
}

/// Heating a hotend, and waiting until it is hot.
pub(super) fn heat(temperature: Temperature) -> String {
    format!("M109 S{}", Decimals::exactly(1).text(temperature.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_dialect_has_its_row() {
        for (_, dialect) in Dialect::NAMES {
            assert_eq!(SPELLINGS.iter().filter(|(known, ..)| *known == dialect).count(), 1, "{dialect:?}");
        }
    }

    #[test]
    fn a_dwell_is_what_the_controller_makes_of_it() {
        for (dialect, unit, text) in [
            (Dialect::Generic, DwellUnit::Seconds, "G4 P1.65"),
            (Dialect::LinuxCnc, DwellUnit::Seconds, "G4 P1.65"),
            (Dialect::Grbl, DwellUnit::Seconds, "G4 P1.649"),
            (Dialect::GrblHal, DwellUnit::Seconds, "G4 P1.649"),
            (Dialect::FluidNc, DwellUnit::Seconds, "G4 P1.65"),
            (Dialect::Marlin, DwellUnit::Milliseconds, "G4 P1650"),
            (Dialect::Klipper, DwellUnit::Milliseconds, "G4 P1650"),
            (Dialect::RepRapFirmware, DwellUnit::Milliseconds, "G4 P1650"),
        ] {
            assert_eq!(Spelling::of(dialect).dwell(unit, 1.65), text, "{dialect:?}");
        }
    }

    #[test]
    fn progress_where_there_is_a_display() {
        let said = |dialect| Spelling::of(dialect).progress(37, 215);
        assert_eq!(said(Dialect::Grbl), None);
        assert_eq!(said(Dialect::Marlin).as_deref(), Some("M73 P37 R215"));
        assert_eq!(said(Dialect::Klipper).as_deref(), Some("M73 P37"));
        assert_eq!(said(Dialect::RepRapFirmware).as_deref(), Some("M73 P37 R215"));
    }
}
