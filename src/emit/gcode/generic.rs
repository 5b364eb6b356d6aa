//! The plain subset: no dwell is rounded, no display is known, nobody heats but the operator.

use crate::emit::gcode::speech::Speech;

/// The spelling of the plain subset.
pub(super) struct Generic;

impl Speech for Generic {}
