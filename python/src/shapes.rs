//! Exact lines, arcs and contours; with a tolerance also as polygons.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple, PyType};
use stargrip_cam::emit::chords;
use stargrip_cam::geom;
use stargrip_cam::geom::{Path, Point, Segment};

use crate::arrays::rows;
use crate::faults::usage;

/// Default tolerance of a polygon, its largest distance from the curve, mm: a tenth of a laser's cut width.
pub(crate) const TOLERANCE: f64 = 0.01;

/// A straight piece of a contour, from `start` to `end`: (x, y) in mm.
#[pyclass(frozen, get_all, eq, skip_from_py_object, module = "stargrip_cam")]
#[derive(Clone, PartialEq)]
pub(crate) struct Line {
    /// First point, (x, y) in mm.
    start: (f64, f64),
    /// Last point, (x, y) in mm.
    end: (f64, f64),
}

#[pymethods]
impl Line {
    #[new]
    fn new(start: (f64, f64), end: (f64, f64)) -> Self {
        Self { start, end }
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyType>, Bound<'py, PyTuple>)> {
        let Self { start, end } = slf.get();
        Ok((slf.get_type(), (*start, *end).into_pyobject(slf.py())?))
    }

    fn __repr__(&self) -> String {
        format!("Line(start={:?}, end={:?})", self.start, self.end)
    }
}

/// A circular piece of a contour: around `center`, (x, y) in mm, from the direction `start_angle_deg`, turning by `sweep_deg`,
/// counterclockwise if positive.
#[pyclass(frozen, get_all, eq, skip_from_py_object, module = "stargrip_cam")]
#[derive(Clone, PartialEq)]
pub(crate) struct Arc {
    /// Centre of the circle, (x, y) in mm.
    center: (f64, f64),
    /// Radius, mm.
    radius_mm: f64,
    /// Direction from the centre to the first point, degrees.
    start_angle_deg: f64,
    /// Turn from the first to the last point, degrees, counterclockwise if positive.
    sweep_deg: f64,
}

#[pymethods]
impl Arc {
    #[new]
    fn new(center: (f64, f64), radius_mm: f64, start_angle_deg: f64, sweep_deg: f64) -> Self {
        Self { center, radius_mm, start_angle_deg, sweep_deg }
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyType>, Bound<'py, PyTuple>)> {
        let Self { center, radius_mm, start_angle_deg, sweep_deg } = slf.get();
        let state = (*center, *radius_mm, *start_angle_deg, *sweep_deg);
        Ok((slf.get_type(), state.into_pyobject(slf.py())?))
    }

    /// First point, (x, y) in mm.
    #[getter]
    fn start(&self) -> (f64, f64) {
        pair(self.exact().start())
    }

    /// Last point, (x, y) in mm.
    #[getter]
    fn end(&self) -> (f64, f64) {
        pair(self.exact().end())
    }

    fn __repr__(&self) -> String {
        let Self { center, radius_mm, start_angle_deg, sweep_deg } = self;
        format!(
            "Arc(center={center:?}, radius_mm={radius_mm}, start_angle_deg={start_angle_deg}, sweep_deg={sweep_deg})"
        )
    }
}

impl Arc {
    fn exact(&self) -> geom::Arc {
        let (start, sweep) = (self.start_angle_deg.to_radians(), self.sweep_deg.to_radians());
        geom::Arc::new(Point::new(self.center.0, self.center.1), self.radius_mm, start, sweep)
    }
}

/// A chain of lines and arcs, exact, in mm.
#[pyclass(frozen, eq, skip_from_py_object, module = "stargrip_cam")]
#[derive(Clone, PartialEq)]
pub(crate) struct Contour(pub(crate) Path);

#[pymethods]
impl Contour {
    /// Pieces in order, each a Line or an Arc.
    #[getter]
    fn segments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let pieces = self.0.segments.iter().map(|segment| match segment {
            Segment::Line(line) => {
                Ok(Line { start: pair(line.start), end: pair(line.end) }.into_pyobject(py)?.into_any())
            }
            Segment::Arc(arc) => Ok(Arc {
                center: pair(arc.center),
                radius_mm: arc.radius,
                start_angle_deg: arc.start_angle.to_degrees(),
                sweep_deg: arc.sweep.to_degrees(),
            }
            .into_pyobject(py)?
            .into_any()),
        });
        PyTuple::new(py, pieces.collect::<PyResult<Vec<_>>>()?)
    }

    /// Whether it ends where it begins.
    #[getter]
    fn closed(&self) -> bool {
        self.0.closed
    }

    /// Length of the contour, mm.
    #[getter]
    fn length_mm(&self) -> f64 {
        self.0.length()
    }

    /// The area that it encloses, mm^2, positive if it runs counterclockwise; None if it is open.
    #[getter]
    fn area_mm2(&self) -> Option<f64> {
        self.0.closed.then(|| self.0.area())
    }

    /// Corners of a polygon that leaves the contour by `tolerance_mm` at most: an array of shape (N, 2), mm. A closed one does not
    /// repeat its first point.
    #[pyo3(signature = (tolerance_mm = 0.01))]
    fn points<'py>(&self, py: Python<'py>, tolerance_mm: f64) -> PyResult<Bound<'py, PyAny>> {
        let corner_points = corners(py, &self.0, tolerance_mm)?.into_iter().map(|point| [point.x, point.y]);
        rows(py, &corner_points.collect::<Vec<_>>(), 1.0)
    }

    /// As GeoJSON, within 0.01 mm, for shapely.geometry.shape and other readers.
    #[getter]
    fn __geo_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        if self.0.closed {
            return polygon(py, std::slice::from_ref(&self.0), TOLERANCE);
        }
        self.line_string(py)
    }

    /// Called by `__reduce__`: for a line its ends, for an arc centre, radius, first angle and turn in rad.
    #[classmethod]
    fn _restored(class: &Bound<'_, PyType>, segments: Vec<Vec<f64>>, closed: bool) -> PyResult<Self> {
        let segment = |numbers: Vec<f64>| match numbers[..] {
            [x, y, to_x, to_y] => {
                Ok(Segment::Line(geom::Line::new(Point::new(x, y), Point::new(to_x, to_y))))
            }
            [x, y, radius, start, sweep] => {
                Ok(Segment::Arc(geom::Arc::new(Point::new(x, y), radius, start, sweep)))
            }
            _ => Err(usage(class.py(), "a segment has four or five numbers")),
        };
        let segments = segments.into_iter().map(segment).collect::<PyResult<_>>()?;
        Ok(Self(Path { segments, closed }))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let Path { segments, closed } = &slf.get().0;
        let segments = segments.iter().map(|segment| match segment {
            Segment::Line(line) => vec![line.start.x, line.start.y, line.end.x, line.end.y],
            Segment::Arc(arc) => vec![arc.center.x, arc.center.y, arc.radius, arc.start_angle, arc.sweep],
        });
        let state = (segments.collect::<Vec<_>>(), *closed);
        Ok((slf.get_type().getattr("_restored")?, state.into_pyobject(slf.py())?))
    }

    fn __repr__(&self) -> String {
        let kind = if self.0.closed { "closed" } else { "open" };
        format!("<Contour: {kind}, {} segments, {:.3} mm>", self.0.segments.len(), self.0.length())
    }
}

impl Contour {
    /// As a line in GeoJSON, within 0.01 mm; a closed one ends where it begins.
    pub(crate) fn line_string<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let mut line: Vec<_> = corners(py, &self.0, TOLERANCE)?.into_iter().map(pair).collect();
        line.extend(line.first().copied().filter(|_| self.0.closed));
        geometry(py, "LineString", PyTuple::new(py, line)?)
    }
}

/// The corners of `path` within `tolerance`, mm.
fn corners(py: Python<'_>, path: &Path, tolerance: f64) -> PyResult<Vec<Point>> {
    if !(1e-6..=1e3).contains(&tolerance) {
        return Err(usage(py, format!("tolerance_mm is {tolerance}; allowed are 1e-6 to 1000 mm")));
    }
    Ok(chords(path, tolerance))
}

/// Closed paths as a GeoJSON polygon: the first is its edge, the others are its holes.
pub(crate) fn polygon<'py>(py: Python<'py>, paths: &[Path], tolerance: f64) -> PyResult<Bound<'py, PyDict>> {
    let rings = paths.iter().zip(0..).map(|(path, hole)| {
        let mut ring: Vec<_> = corners(py, path, tolerance)?.into_iter().map(pair).collect();
        // GeoJSON requires edges counterclockwise, holes clockwise, and closed rings.
        if (path.area() > 0.0) != (hole == 0) {
            ring.reverse();
        }
        ring.extend(ring.first().copied());
        PyTuple::new(py, ring)
    });
    geometry(py, "Polygon", PyTuple::new(py, rings.collect::<PyResult<Vec<_>>>()?)?)
}

fn geometry<'py>(
    py: Python<'py>,
    kind: &str,
    coordinates: Bound<'py, PyTuple>,
) -> PyResult<Bound<'py, PyDict>> {
    let geometry = PyDict::new(py);
    geometry.set_item("type", kind)?;
    geometry.set_item("coordinates", coordinates)?;
    Ok(geometry)
}

pub(crate) fn pair(point: Point) -> (f64, f64) {
    (point.x, point.y)
}
