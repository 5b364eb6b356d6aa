//! What a workshop needs beside a build: coupons, the feed check, the rest of an interrupted job, machine profiles.

use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use stargrip_cam::cli::embedded;
use stargrip_cam::resume::{Resumed, clamp_in_the_way};
use stargrip_cam::spec::{Machine, builtin_machines};

use crate::faults::{of_failure, plain, usage};
use crate::options::options;
use crate::spec::Spec;

/// Files by their names, as bytes.
pub(crate) fn files<N: AsRef<str>, B: AsRef<[u8]>>(
    py: Python<'_>,
    contents: impl IntoIterator<Item = (N, B)>,
) -> PyResult<Bound<'_, PyDict>> {
    let bytes_by_name = PyDict::new(py);
    for (name, bytes) in contents {
        bytes_by_name.set_item(name.as_ref(), PyBytes::new(py, bytes.as_ref()))?;
    }
    Ok(bytes_by_name)
}

/// The files of test pieces for the machine, the fabric and the tube of `spec`, by name: programs, drawings, and the table to fill in.
/// They have been read back.
///
/// temperatures: of the grid of strips, `["180 C", "200 C"]`; default: the spec's.
/// powers: of a laser, in place of temperatures and heights, `["8 %", "10 %"]`; default: three quarters, once and five quarters of the spec's.
/// speeds: of the grid, `["0.1 mm/s", "0.2 mm/s"]`; default: once, twice and five times the spec's; of a laser half, once and twice.
/// heights: of the tip in contact, `["0 mm", "0.1 mm"]`; default: the profile's.
/// focuses: of a laser, heights of its focus above the sheet, `["11 mm", "12 mm"]`; default: the spec's.
/// times: of a heat press, in place of speeds and heights, `["10 s", "20 s"]`; default: half, once and twice the spec's.
/// only: the only kinds of coupons to make, a list: `["strips", "disc"]`; default: all.
/// repeats: how often each setting is sealed, 1 to 20; default: 3.
///
/// Raises DesignError if the machine cannot seal one of them, UsageError for wrong arguments.
#[pyfunction]
#[pyo3(
    signature = (spec, **grid),
    text_signature = "(spec, *, temperatures=None, powers=None, speeds=None, heights=None, focuses=None, times=None, only=None, repeats=None)"
)]
pub(crate) fn coupon<'py>(
    py: Python<'py>,
    spec: &Spec,
    grid: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyDict>> {
    let arguments = options("coupon", &embedded::coupon_keywords(), grid)?;
    let proven = py.detach(|| embedded::coupons(&spec.given, &arguments));
    let proven = proven.map_err(|failure| of_failure(py, &failure))?;
    files(py, proven.files().into_iter().map(|(name, bytes)| (name.to_owned(), bytes)))
}

/// The program that measures the real speed of the machine of `spec`, and its manifest, by name. The program has been read back.
///
/// Raises DesignError if the machine's profile contradicts the seal.
#[pyfunction]
pub(crate) fn feed_check<'py>(py: Python<'py>, spec: &Spec) -> PyResult<Bound<'py, PyDict>> {
    let contents =
        py.detach(|| embedded::feed_check(&spec.given)).map_err(|failure| of_failure(py, &failure))?;
    files(py, contents)
}

/// The program for the rest of the interrupted sealing program with the text `program`, with the place where it goes on:
/// `stargrip_cam.resume` has its arguments.
#[pyfunction]
#[pyo3(
    signature = (program, spec = None, **place),
    text_signature = "(program, spec=None, *, line=None, at=None, near=None, overlap=None)"
)]
pub(crate) fn rest<'py>(
    py: Python<'py>,
    program: &str,
    spec: Option<&Spec>,
    place: Option<&Bound<'py, PyDict>>,
) -> PyResult<(String, usize, f64, f64, f64)> {
    let arguments = options("resume", &embedded::resume_keywords(), place)?;
    let Resumed { text, line, overlap, done: share, seconds, .. } =
        py.detach(|| embedded::resumed(program, &arguments)).map_err(|failure| of_failure(py, &failure))?;
    if let Some(spec) = spec {
        let clamps = &spec.given.machine.bench.keep_out;
        let collision = clamp_in_the_way(&text, clamps).map_err(|fault| usage(py, fault))?;
        if let Some(collision) = collision {
            let text = format!(
                "line {} of the rest: {}; must be {}",
                collision.line.unwrap_or(0),
                collision.found,
                collision.allowed
            );
            return Err(plain(py, "DesignError", "clamp-in-the-way", &text));
        }
    }
    Ok((text, line, share, overlap, seconds))
}

/// The built-in machine profiles: name and description.
#[pyfunction]
pub(crate) fn machines(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let dict = PyDict::new(py);
    for name in builtin_machines() {
        let machine = Machine::builtin(name).map_err(|fault| usage(py, fault))?;
        dict.set_item(name, machine.description)?;
    }
    Ok(dict)
}
