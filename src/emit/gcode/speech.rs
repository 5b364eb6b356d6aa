//! What controllers say differently: the one interface behind which every dialect has its room.

use crate::emit::gcode::fluidnc::FluidNc;
use crate::emit::gcode::generic::Generic;
use crate::emit::gcode::grbl::Grbl;
use crate::emit::gcode::grblhal::GrblHal;
use crate::emit::gcode::klipper::Klipper;
use crate::emit::gcode::linuxcnc::LinuxCnc;
use crate::emit::gcode::marlin::Marlin;
use crate::emit::gcode::reprapfirmware::RepRapFirmware;
use crate::emit::number::Decimals;
use crate::spec::{Dialect, DwellUnit};
use crate::units::Temperature;

/// The spelling of one dialect. None of it decides geometry, order or times.
pub(super) trait Speech {
    /// A wait of `seconds`, whole milliseconds.
    fn dwell(&self, unit: DwellUnit, seconds: f64) -> String {
        let time = match unit {
            DwellUnit::Seconds => Decimals::exactly(3).text(seconds),
            DwellUnit::Milliseconds => Decimals::exactly(0).text(seconds * 1e3),
        };
        format!("G4 P{time}")
    }

    /// Heating a hotend, and waiting until it is hot.
    fn heat(&self, temperature: Temperature) -> String {
        format!("M109 S{}", Decimals::exactly(1).text(temperature.0))
    }

    /// The display's progress, where there is a command for it: whole per cent done, whole minutes to go.
    fn progress(&self, percent: u32, minutes: u32) -> Option<String> {
        let _ = (percent, minutes);
        None
    }
}

/// The spelling of `dialect`.
pub(super) fn speech(dialect: Dialect) -> &'static dyn Speech {
    match dialect {
        Dialect::Generic => &Generic,
        Dialect::LinuxCnc => &LinuxCnc,
        Dialect::Grbl => &Grbl,
        Dialect::GrblHal => &GrblHal,
        Dialect::FluidNc => &FluidNc,
        Dialect::Marlin => &Marlin,
        Dialect::Klipper => &Klipper,
        Dialect::RepRapFirmware => &RepRapFirmware,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
            assert_eq!(speech(dialect).dwell(unit, 1.65), text, "{dialect:?}");
        }
    }

    #[test]
    fn progress_where_there_is_a_display() {
        let said = |dialect| speech(dialect).progress(37, 215);
        assert_eq!(said(Dialect::Grbl), None);
        assert_eq!(said(Dialect::Marlin).as_deref(), Some("M73 P37 R215"));
        assert_eq!(said(Dialect::Klipper).as_deref(), Some("M73 P37"));
        assert_eq!(said(Dialect::RepRapFirmware).as_deref(), Some("M73 P37 R215"));
    }
}
