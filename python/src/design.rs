//! `Design` and `Star`: the exact geometry of a spec.

use std::sync::Arc;

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple, PyType};
use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::cli::embedded::Loaded;
use stargrip_cam::design as exact;
use stargrip_cam::design::{Contour as Trimmed, Part, PlacedPart, Side, StarDesign};
use stargrip_cam::geom::{Path, Point};
use stargrip_cam::pipeline::Forecast;
use stargrip_cam::units::count_text;

use crate::arrays::{floats, rows};
use crate::equality::{has_same_content, hash_of_text};
use crate::faults::{of_design, usage};
use crate::piece::Piece;
use crate::shapes::{Contour, TOLERANCE, polygon};
use crate::spec::Spec;

/// The exact flat geometry of a gripper. Lengths in mm, angles in degrees; everything counts counterclockwise seen from above.
#[pyclass(frozen, module = "stargrip_cam")]
pub(crate) struct Design {
    given: Arc<Loaded>,
    design: Arc<exact::Design>,
}

/// One star of a design, in its own frame: the axis at the origin, corner 1 on +X.
#[pyclass(frozen, module = "stargrip_cam")]
pub(crate) struct Star {
    whole: Py<Design>,
    placed: PlacedPart,
}

/// The exact geometry of `spec`. Raises DesignError with all reasons if there is none.
#[pyfunction]
pub(crate) fn design(py: Python<'_>, spec: &Spec) -> PyResult<Design> {
    let loaded = Arc::clone(&spec.given);
    let result = py.detach(|| exact::Design::new(&loaded.reading.spec, &loaded.machine));
    let design = result.map_err(|refusals| of_design(py, &loaded, refusals))?;
    Ok(Design { given: loaded, design: Arc::new(design) })
}

#[pymethods]
impl Design {
    /// Stars of the design, bottom first; empty for a drawing, which has `pieces`.
    #[getter]
    fn stars(slf: &Bound<'_, Self>) -> Vec<Star> {
        let star = |placed: &PlacedPart| Star { whole: slf.clone().unbind(), placed: *placed };
        slf.get().placed().iter().map(star).collect()
    }

    /// The pieces, stars or drawn ones, with their outlines and seams.
    #[getter]
    fn pieces(&self) -> Vec<Piece> {
        Piece::pieces_of(&self.given, &self.design)
    }

    /// The sheets: dicts of `index`, `width_mm` and `height_mm`.
    #[getter]
    fn sheets<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let sheet_dicts = self.design.sheets.iter().map(|sheet| {
            let sheet_dict = PyDict::new(py);
            sheet_dict.set_item("index", sheet.index)?;
            sheet_dict.set_item("width_mm", sheet.width)?;
            sheet_dict.set_item("height_mm", sheet.height)?;
            Ok(sheet_dict)
        });
        PyList::new(py, sheet_dicts.collect::<PyResult<Vec<_>>>()?)
    }

    /// Warnings before it is made: dicts of code, key, found and remedy.
    #[getter]
    fn warnings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let warning_dicts = self.design.warnings.iter().map(|warning| {
            let warning_dict = PyDict::new(py);
            warning_dict.set_item("code", warning.code.to_string())?;
            warning_dict.set_item("key", warning.key.to_string())?;
            warning_dict.set_item("found", &warning.found)?;
            warning_dict.set_item("remedy", &warning.remedy)?;
            Ok(warning_dict)
        });
        PyList::new(py, warning_dicts.collect::<PyResult<Vec<_>>>()?)
    }

    /// The preview of its first sheet, for notebooks: None if the machine cannot seal it.
    fn _repr_svg_(&self) -> Option<String> {
        let Loaded { reading, machine, .. } = self.given.as_ref();
        let forecast = Forecast::new(reading.spec.clone(), machine.clone()).ok()?;
        let built = forecast.build(self.given.sources(), &KindRequest::exactly(&[Kind::PreviewSvg]));
        let preview = built.artifacts.into_iter().find(|file| file.output.kind == Kind::PreviewSvg)?;
        String::from_utf8(preview.bytes).ok()
    }

    /// Called by `__reduce__`.
    #[classmethod]
    fn _restored(_class: &Bound<'_, PyType>, py: Python<'_>, spec: &Spec) -> PyResult<Self> {
        design(py, spec)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (Spec,))> {
        let spec = Spec { given: Arc::clone(&slf.get().given) };
        Ok((slf.get_type().getattr("_restored")?, (spec,)))
    }

    fn __eq__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        has_same_content(slf, other)
    }

    fn __hash__(slf: &Bound<'_, Self>) -> PyResult<isize> {
        hash_of_text(slf)
    }

    fn __repr__(&self) -> String {
        let name = &self.given.reading.spec.name;
        let (pieces, sheets) = (self.design.placed().len(), self.design.sheets.len());
        let kind = if self.design.assembly().is_some() { "star" } else { "piece" };
        format!("<Design {name:?}: {}, {}>", count_text(pieces, kind), count_text(sheets, "sheet"))
    }
}

impl Design {
    /// Stars with their places; empty for a drawing.
    fn placed(&self) -> &[PlacedPart] {
        self.design.assembly().map_or(&[], |assembly| &assembly.stars)
    }

    /// The distinct stars.
    fn distinct(&self) -> &[StarDesign] {
        self.design.assembly().map_or(&[], |assembly| &assembly.distinct)
    }
}

impl Star {
    fn part(&self) -> &StarDesign {
        &self.whole.get().distinct()[self.placed.distinct]
    }

    fn flat(&self) -> &exact::Star {
        &self.part().star
    }

    fn centers<'py>(&self, py: Python<'py>, center_of: impl Fn(u32) -> Point) -> PyResult<Bound<'py, PyAny>> {
        let points: Vec<[f64; 2]> =
            (1..=self.flat().n).map(center_of).map(|point| [point.x, point.y]).collect();
        rows(py, &points, 1.0)
    }
}

fn contours(paths: [&Path; 2]) -> (Contour, Contour) {
    (Contour(paths[0].clone()), Contour(paths[1].clone()))
}

#[pymethods]
impl Star {
    /// Number of the star, 1 = bottom.
    #[getter]
    fn index(&self) -> usize {
        self.placed.index
    }

    /// Number of its sheet, from 1.
    #[getter]
    fn sheet(&self) -> usize {
        self.placed.sheet
    }

    /// From the star's frame to its sheet's: an array of shape (2, 3), `xy_sheet = placement[:, :2] @ xy + placement[:, 2]`.
    #[getter]
    fn placement<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let [o, x, y] =
            [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)].map(|(x, y)| self.placed.placement.point(Point::new(x, y)));
        floats(py, &[x.x - o.x, y.x - o.x, o.x, x.y - o.y, y.y - o.y, o.y], &[2, 3])
    }

    /// Number of points n.
    #[getter]
    fn points(&self) -> u32 {
        self.flat().n
    }

    /// Inner radius rho_0, mm.
    #[getter]
    fn inner_radius_mm(&self) -> f64 {
        self.flat().rho_0
    }

    /// Tube width W between the inner edges of the bands, mm.
    #[getter]
    fn tube_width_mm(&self) -> f64 {
        self.flat().w
    }

    /// Internal angle phi_i0 of the tips, degrees.
    #[getter]
    fn tip_angle_deg(&self) -> f64 {
        self.flat().phi_i.to_degrees()
    }

    /// External angle phi_e0 of the reentrant corners, degrees.
    #[getter]
    fn corner_angle_deg(&self) -> f64 {
        self.flat().phi_e.to_degrees()
    }

    /// Arm length l, mm.
    #[getter]
    fn arm_length_mm(&self) -> f64 {
        self.flat().l
    }

    /// Fabric of both sheets, mm^2.
    #[getter]
    fn fabric_mm2(&self) -> f64 {
        self.part().fabric()
    }

    /// Centres of the tips' arcs: (n, 2), mm, tip 1 first.
    #[getter]
    fn tip_centers_mm<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.centers(py, |k| self.flat().tip_center(k))
    }

    /// Centres of the corners' arcs: (n, 2), mm, corner 1 first.
    #[getter]
    fn corner_centers_mm<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.centers(py, |k| self.flat().corner_center(k))
    }

    /// The straight tubes as rectangles: (2n, 4, 2), mm. Arm 2k - 1 runs from corner k to tip k, arm 2k on to corner k + 1; of each
    /// the start and the end of its edge towards the hole, then the end and the start of the outer one.
    #[getter]
    fn arms_mm<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let edge = |side| self.flat().contour(side, 0.0, 0.0).unwrap_or_default();
        let (hole, outer_edge) = (edge(Side::Hole), edge(Side::Outside));
        let ends = |of: &Trimmed, arm: u32| {
            let segment =
                of.parts.iter().find(|(part, _)| *part == Part::Arm(arm)).map(|(_, segment)| segment);
            segment.map_or([[f64::NAN; 2]; 2], |segment| [segment.start(), segment.end()].map(|p| [p.x, p.y]))
        };
        let coordinates = (1..=2 * self.flat().n).flat_map(|arm| {
            let ([a, b], [d, c]) = (ends(&hole, arm), ends(&outer_edge, arm));
            [a, b, c, d]
        });
        let numbers: Vec<f64> = coordinates.flatten().collect();
        floats(py, &numbers, &[numbers.len() / 8, 4, 2])
    }

    /// The tube's edges as drawn, towards the hole and outside; that one is open where the inlet is.
    #[getter]
    fn edges(&self) -> (Contour, Contour) {
        contours(self.part().edges.each_ref())
    }

    /// The iron's paths, inner and outer loop: the centre lines of the bands, without overlap.
    #[getter]
    fn seams(&self) -> (Contour, Contour) {
        contours([0, 1].map(|i| &self.part().shape.seams[i].center_line))
    }

    /// The cut edges: around the star and around the hole.
    #[getter]
    fn outline(&self) -> (Contour, Contour) {
        let outline = &self.part().outline;
        contours([&outline.outside, &outline.hole])
    }

    /// The windows of the coating mask.
    #[getter]
    fn windows(&self) -> Vec<Contour> {
        self.part().mask.windows.iter().cloned().map(Contour).collect()
    }

    /// Registration holes: (m, 3), centre and diameter, mm.
    #[getter]
    fn registration_mm<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let holes = self.part().outline.registration.iter();
        let holes: Vec<[f64; 3]> = holes.map(|hole| [hole.center.x, hole.center.y, hole.diameter]).collect();
        rows(py, &holes, 1.0)
    }

    /// The cut fabric as a GeoJSON polygon with its hole, within `tolerance_mm`: shapely.geometry.shape(star.polygon()).
    #[pyo3(signature = (tolerance_mm = 0.01))]
    fn polygon<'py>(&self, py: Python<'py>, tolerance_mm: f64) -> PyResult<Bound<'py, PyDict>> {
        let outline = &self.part().outline;
        polygon(py, &[outline.outside.clone(), outline.hole.clone()], tolerance_mm)
    }

    /// The polygon within 0.01 mm: shapely.geometry.shape(star).
    #[getter]
    fn __geo_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.polygon(py, TOLERANCE)
    }

    /// Called by `__reduce__`.
    #[classmethod]
    fn _restored(class: &Bound<'_, PyType>, design: Py<Design>, index: usize) -> PyResult<Self> {
        let placed = design.get().placed().iter().find(|placed| placed.index == index).copied();
        let placed = placed.ok_or_else(|| usage(class.py(), format!("the design has no star {index}")))?;
        Ok(Self { whole: design, placed })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let star = slf.get();
        let state = (&star.whole, star.placed.index).into_pyobject(slf.py())?;
        Ok((slf.get_type().getattr("_restored")?, state))
    }

    fn __eq__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        has_same_content(slf, other)
    }

    fn __hash__(slf: &Bound<'_, Self>) -> PyResult<isize> {
        hash_of_text(slf)
    }

    fn __repr__(&self) -> String {
        let star = self.flat();
        format!(
            "<Star {}: {} points, arms of {:.3} mm, on sheet {}>",
            self.placed.index, star.n, star.l, self.placed.sheet
        )
    }
}
