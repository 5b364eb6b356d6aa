//! RepRapFirmware: dwells in milliseconds, M109 that waits, M73 with minutes (GCodes2.cpp).

use crate::emit::gcode::speech::Speech;

/// The spelling of RepRapFirmware.
pub(super) struct RepRapFirmware;

impl Speech for RepRapFirmware {
    fn progress(&self, percent: u32, minutes: u32) -> Option<String> {
        Some(format!("M73 P{percent} R{minutes}"))
    }
}
