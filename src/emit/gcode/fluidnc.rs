//! FluidNC: the plain subset; dwells are whole milliseconds.

use crate::emit::gcode::speech::Speech;

/// The spelling of FluidNC.
pub(super) struct FluidNc;

impl Speech for FluidNc {}
