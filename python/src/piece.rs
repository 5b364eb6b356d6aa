//! `Piece` and `Seam`: what is cut out and sealed, whatever the product.

use std::sync::Arc;

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple, PyType};
use stargrip_cam::cli::embedded::Loaded;
use stargrip_cam::design;
use stargrip_cam::design::{CutEdge, FlatPiece, PlacedPart};
use stargrip_cam::geom::Path;

use crate::arrays::rows;
use crate::equality::{has_same_content, hash_of_text};
use crate::faults::{of_design, usage};
use crate::shapes::{Contour, TOLERANCE, polygon};
use crate::spec::Spec;

/// One piece of a design, star or drawn, in its own frame: that of the star, or of the drawing. Lengths in mm.
#[pyclass(frozen, module = "stargrip_cam")]
pub(crate) struct Piece {
    loaded: Arc<Loaded>,
    design: Arc<design::Design>,
    /// Place among all pieces of the design.
    place: usize,
}

/// One seam of a piece: the centre line of its band, from where the sealing starts.
#[pyclass(frozen, eq, skip_from_py_object, module = "stargrip_cam")]
#[derive(Clone, PartialEq)]
pub(crate) struct Seam {
    name: String,
    band: f64,
    center_line: Path,
}

impl Piece {
    pub(crate) fn pieces_of(loaded: &Arc<Loaded>, design: &Arc<design::Design>) -> Vec<Self> {
        let places = 0..design.placed().len();
        places.map(|place| Self { loaded: Arc::clone(loaded), design: Arc::clone(design), place }).collect()
    }

    fn placed(&self) -> &PlacedPart {
        &self.design.placed()[self.place]
    }

    fn flat(&self) -> FlatPiece<'_> {
        self.design.part(self.placed())
    }
}

fn contours<'p>(paths: impl IntoIterator<Item = &'p Path>) -> Vec<Contour> {
    paths.into_iter().cloned().map(Contour).collect()
}

#[pymethods]
impl Piece {
    /// Name of the piece, as in files and messages: "star 2".
    #[getter]
    fn name(&self) -> String {
        self.placed().name().to_string()
    }

    /// Number of its sheet, from 1.
    #[getter]
    fn sheet(&self) -> usize {
        self.placed().sheet
    }

    /// The cut edges: around it, then those of its holes.
    #[getter]
    fn outline(&self) -> Vec<Contour> {
        let cut = self.flat().cut(CutEdge::Part);
        contours(std::iter::once(cut.outside).chain(cut.inside))
    }

    /// The seams, in the order in which they are sealed.
    #[getter]
    fn seams(&self) -> Vec<Seam> {
        let shape = self.flat().shape();
        let seams = shape.seams.iter().map(|seam| Seam {
            name: seam.name.clone(),
            band: shape.band,
            center_line: seam.center_line.clone(),
        });
        seams.collect()
    }

    /// The edges of the air, as the iron makes them.
    #[getter]
    fn air(&self) -> Vec<Contour> {
        contours(self.flat().tube())
    }

    /// The ports: (k, 3), the middle of the mouth and the width between the bands, mm.
    #[getter]
    fn ports_mm<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let ports = self.flat().shape().ports.iter().map(|port| [port.at.x, port.at.y, port.width]);
        rows(py, &ports.collect::<Vec<_>>(), 1.0)
    }

    /// Registration holes: (m, 3), centre and diameter, mm.
    #[getter]
    fn registration_mm<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let holes = self.flat().cut(CutEdge::Part).holes.iter();
        let holes: Vec<[f64; 3]> = holes.map(|hole| [hole.center.x, hole.center.y, hole.diameter]).collect();
        rows(py, &holes, 1.0)
    }

    /// Fabric of both sheets, mm^2.
    #[getter]
    fn fabric_mm2(&self) -> f64 {
        self.flat().fabric()
    }

    /// The cut fabric as a GeoJSON polygon with its holes, within `tolerance_mm`: shapely.geometry.shape(piece.polygon()).
    #[pyo3(signature = (tolerance_mm = 0.01))]
    fn polygon<'py>(&self, py: Python<'py>, tolerance_mm: f64) -> PyResult<Bound<'py, PyDict>> {
        let paths: Vec<Path> = self.outline().into_iter().map(|contour| contour.0).collect();
        polygon(py, &paths, tolerance_mm)
    }

    /// The cut fabric within 0.01 mm: shapely.geometry.shape(piece).
    #[getter]
    fn __geo_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.polygon(py, TOLERANCE)
    }

    /// Called by `__reduce__`.
    #[classmethod]
    fn _restored(class: &Bound<'_, PyType>, spec: &Spec, place: usize) -> PyResult<Self> {
        let (py, loaded) = (class.py(), &spec.given);
        let design = py.detach(|| design::Design::new(&loaded.reading.spec, &loaded.machine));
        let design = design.map_err(|refusals| of_design(py, loaded, refusals))?;
        let piece = Self::pieces_of(loaded, &Arc::new(design)).into_iter().nth(place);
        piece.ok_or_else(|| usage(py, format!("the design has no piece {place}")))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let Self { loaded, place, .. } = slf.get();
        let content = (Spec { given: Arc::clone(loaded) }, *place).into_pyobject(slf.py())?;
        Ok((slf.get_type().getattr("_restored")?, content))
    }

    fn __eq__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        has_same_content(slf, other)
    }

    fn __hash__(slf: &Bound<'_, Self>) -> PyResult<isize> {
        hash_of_text(slf)
    }

    fn __repr__(&self) -> String {
        let seams: Vec<String> = self.seams().into_iter().map(|seam| seam.name).collect();
        format!("<Piece {:?} with the seams {seams:?}, on sheet {}>", self.name(), self.sheet())
    }
}

#[pymethods]
impl Seam {
    #[new]
    fn new(name: String, band_mm: f64, center_line: &Bound<'_, Contour>) -> Self {
        Self { name, band: band_mm, center_line: center_line.get().0.clone() }
    }

    /// Name of the seam, as on drawings, in programs and in predictions.
    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    /// Width of its band, mm.
    #[getter]
    fn band_mm(&self) -> f64 {
        self.band
    }

    /// The centre line of its band.
    #[getter]
    fn center_line(&self) -> Contour {
        Contour(self.center_line.clone())
    }

    /// Length of the centre line, mm.
    #[getter]
    fn length_mm(&self) -> f64 {
        self.center_line.length()
    }

    /// The centre line as GeoJSON, within 0.01 mm: shapely.geometry.shape(seam).buffer(seam.band_mm / 2) is the band.
    #[getter]
    fn __geo_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.center_line().line_string(py)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyType>, Bound<'py, PyTuple>)> {
        let Self { name, band, .. } = slf.get();
        Ok((slf.get_type(), (name, *band, slf.get().center_line()).into_pyobject(slf.py())?))
    }

    fn __repr__(&self) -> String {
        format!("<Seam {:?}: {:.3} mm, band of {} mm>", self.name, self.center_line.length(), self.band)
    }
}
