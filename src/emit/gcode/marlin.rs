//! Marlin: dwells in milliseconds, M109 that waits, M73 with minutes.

use crate::emit::gcode::speech::Speech;

/// The spelling of Marlin.
pub(super) struct Marlin;

impl Speech for Marlin {
    fn progress(&self, percent: u32, minutes: u32) -> Option<String> {
        Some(format!("M73 P{percent} R{minutes}"))
    }
}
