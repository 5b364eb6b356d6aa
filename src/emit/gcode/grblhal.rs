//! grblHAL: it rounds dwells as GRBL does (nuts_bolts.c, delay_sec).

use crate::emit::gcode::grbl::early;
use crate::emit::gcode::speech::Speech;
use crate::spec::DwellUnit;

/// The spelling of grblHAL.
pub(super) struct GrblHal;

impl Speech for GrblHal {
    fn dwell(&self, unit: DwellUnit, seconds: f64) -> String {
        early(unit, seconds)
    }
}
