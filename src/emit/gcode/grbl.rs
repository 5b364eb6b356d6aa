//! GRBL 1.1: a dwell is rounded up to a multiple of 50 ms (nuts_bolts.c, delay_sec), in 32-bit floats.

use crate::emit::gcode::generic::Generic;
use crate::emit::gcode::speech::Speech;
use crate::spec::DwellUnit;

/// The spelling of GRBL.
pub(super) struct Grbl;

impl Speech for Grbl {
    fn dwell(&self, unit: DwellUnit, seconds: f64) -> String {
        early(unit, seconds)
    }
}

/// The dwell told a millisecond short, so that no rounding of the float makes it a whole step longer.
pub(super) fn early(unit: DwellUnit, seconds: f64) -> String {
    Generic.dwell(unit, seconds - 0.001)
}
