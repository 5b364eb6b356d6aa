//! LinuxCNC: the plain subset. It refuses M73, M104, M109 and M117.

use crate::emit::gcode::speech::Speech;

/// The spelling of LinuxCNC.
pub(super) struct LinuxCnc;

impl Speech for LinuxCnc {}
