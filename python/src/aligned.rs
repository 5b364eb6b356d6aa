//! Programs for a sheet that was moved, found again by its two marks.

use std::path::PathBuf;

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stargrip_cam::cli::embedded;
use stargrip_cam::design::Alignment;
use stargrip_cam::geom::Point;
use stargrip_cam::pipeline::{self, Proven, read_mark};

use crate::build::{Build, has_same_files, publish_into};
use crate::equality::hash_of_text;
use crate::faults::{of_failure, plain, usage};
use crate::options::refuse_unknown;
use crate::workshop::files;

/// The programs of a build, turned and shifted to where its sheet lies now. They have been read back and agree with the design there.
#[pyclass(frozen, module = "stargrip_cam._native")]
pub(crate) struct Aligned {
    proven: Proven,
    alignment: Alignment,
}

/// The programs of `build` for a sheet that was moved: turned and shifted by where its two marks lie now.
///
/// build: a Build, or the directory of a published one.
/// mark1: the first mark as the machine shows it, in mm: "126.9, 14.2".
/// mark2: the second mark: "129.6, 319.6".
/// sheet: the number of the sheet that lies on the machine, from 1, if there are several.
///
/// Raises Error if the sheet cannot lie there, or the build has no programs or was not made by this version; UsageError for wrong marks.
#[pyfunction]
#[pyo3(
    signature = (build, mark1, mark2, *, sheet = None, **unknown),
    text_signature = "(build, mark1, mark2, *, sheet=None)"
)]
pub(crate) fn align(
    py: Python<'_>,
    build: &Bound<'_, PyAny>,
    mark1: &str,
    mark2: &str,
    sheet: Option<usize>,
    unknown: Option<&Bound<'_, PyDict>>,
) -> PyResult<Aligned> {
    refuse_unknown("align", &["build", "mark1", "mark2", "sheet"], unknown)?;
    let marks = [mark(py, "mark1", mark1)?, mark(py, "mark2", mark2)?];
    let proven = if let Ok(build) = build.cast::<Build>() {
        let built = build.get().proven.built();
        py.detach(|| pipeline::align(&built.output_files(), sheet, marks))
            .map_err(|fault| plain(py, "Error", "refused", &fault.to_string()))?
    } else {
        let dir: PathBuf = build.extract()?;
        py.detach(|| embedded::aligned(&dir, sheet, marks)).map_err(|failure| of_failure(py, &failure))?
    };
    let alignment = proven.built().forecast.design.alignment;
    let alignment = alignment.ok_or_else(|| plain(py, "Error", "refused", "the build has no sheet"))?;
    Ok(Aligned { proven, alignment })
}

/// The mark in the argument `name`.
fn mark(py: Python<'_>, name: &str, text: &str) -> PyResult<Point> {
    read_mark(text).map_err(|allowed| usage(py, format!("{name}: found {text:?}; allowed are {allowed}")))
}

#[pymethods]
impl Aligned {
    /// Name and content of every file, the manifest last: the bytes that the command `align` writes.
    #[getter]
    fn files<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        files(py, self.proven.built().files())
    }

    /// The number of the sheet, from 1.
    #[getter]
    fn sheet(&self) -> usize {
        self.alignment.sheet
    }

    /// The turn of the sheet, deg, counterclockwise seen from above.
    #[getter]
    fn turn_deg(&self) -> f64 {
        self.alignment.motion.rotation.to_degrees()
    }

    /// The shift of the sheet along X and Y, mm.
    #[getter]
    fn shift_mm(&self) -> (f64, f64) {
        let shift = self.alignment.motion.shift;
        (shift.x, shift.y)
    }

    /// The measured distance of the marks less the one of the design, mm.
    #[getter]
    fn stretch_mm(&self) -> f64 {
        self.alignment.stretch
    }

    /// Writes the files into the directory `path`, completely or not at all, as the command does. Returns notes, one a line; "" without
    /// any. Raises PublishError, and then leaves the directory unchanged.
    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<String> {
        publish_into(py, &path, &self.proven)
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| has_same_files(&self.proven, &other.get().proven))
    }

    fn __hash__(slf: &Bound<'_, Self>) -> PyResult<isize> {
        hash_of_text(slf)
    }

    fn __repr__(&self) -> String {
        let (turn, (x, y)) = (self.turn_deg(), self.shift_mm());
        format!("<Aligned sheet {}: turned by {turn:.3} deg, shifted by X {x:.2} Y {y:.2} mm>", self.sheet())
    }
}
