//! The command `stargrip-cam`, part of the wheel.

use std::ffi::OsString;

use pyo3::prelude::*;
use stargrip_cam::cli;
use stargrip_cam::cli::embedded::code_is_in;

/// Runs the command with `args`, of which the first is its name; returns the exit code. `file` is the library with this code.
#[pyfunction]
pub(crate) fn run(py: Python<'_>, args: Vec<OsString>, file: OsString) -> u8 {
    code_is_in(file.into());
    py.detach(|| cli::run(args))
}
