//! Klipper: dwells in milliseconds, M109 that waits, M73 without minutes (extras/display_status.py).

use crate::emit::gcode::speech::Speech;

/// The spelling of Klipper.
pub(super) struct Klipper;

impl Speech for Klipper {
    fn progress(&self, percent: u32, _: u32) -> Option<String> {
        Some(format!("M73 P{percent}"))
    }
}
