//! `Body`: the whole inflated body in triangles, closed.

use std::collections::BTreeMap;

use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyTuple, PyType};
use stargrip_cam::forecast::shell::sheet::ModelledSheet;
use stargrip_cam::shell::cases::WholeBody;

use crate::arrays::{integers, rows};
use crate::equality::{has_same_content, hash_of_text};
use crate::faults::usage;

/// A whole inflated body in triangles: both sheets and all their mirror images, closed, N nodes, M triangles, counterclockwise from outside:
/// `trimesh.Trimesh(body.nodes_mm, body.triangles)` is watertight.
#[pyclass(frozen, module = "stargrip_cam")]
pub(crate) struct Body {
    surface: WholeBody,
    /// The nodes of each seam.
    seams: BTreeMap<String, Vec<usize>>,
}

impl Body {
    /// The body of which `sheet` is a part; each node on a seal belongs to the nearest seam, or to "seam" without any.
    pub(crate) fn new(sheet: &ModelledSheet) -> Self {
        let surface = sheet.shape.body(sheet.symmetry);
        Self { seams: surface.points_by_seam(&sheet.seams), surface }
    }
}

/// Numbers of nodes or triangles, far below the limit of an integer.
fn numbers(values: impl Iterator<Item = usize>) -> Vec<i64> {
    values.map(|value| i64::try_from(value).unwrap_or(i64::MAX)).collect()
}

#[pymethods]
impl Body {
    /// Positions of the nodes: (N, 3), mm.
    #[getter]
    fn nodes_mm<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, &self.surface.points, 1e3)
    }

    /// Positions of the nodes on the flat sheets: (N, 2), mm.
    #[getter]
    fn flat_mm<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, &self.surface.flat, 1e3)
    }

    /// The nodes of each triangle: (M, 3), int64, from 0. The first half is the upper sheet.
    #[getter]
    fn triangles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let nodes = numbers(self.surface.triangles.iter().flatten().copied());
        integers(py, &nodes, &[self.surface.triangles.len(), 3])
    }

    /// For each triangle the one of the `Mesh` of which it is an image: (M,), int64. `mesh.stretch[body.images]` is the stretch of each.
    #[getter]
    fn images<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        integers(py, &numbers(self.surface.images.iter().copied()), &[self.surface.images.len()])
    }

    /// The nodes of each seam by its name: arrays of int64. There the sheets are sealed to each other.
    #[getter]
    fn seams<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let seams = PyDict::new(py);
        for (name, nodes) in &self.seams {
            seams.set_item(name, integers(py, &numbers(nodes.iter().copied()), &[nodes.len()])?)?;
        }
        Ok(seams)
    }

    /// The body as a binary STL file, mm.
    fn stl<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.surface.stl())
    }

    /// The body as the text of an OBJ file, mm: groups of triangles for the sheets, and groups of lines for the seams.
    fn obj(&self) -> String {
        self.surface.obj(&self.seams)
    }

    /// Called by `__reduce__`: nodes and flat nodes in m, triangles with their images, seams.
    #[classmethod]
    fn _restored(
        class: &Bound<'_, PyType>,
        points: Vec<[f64; 3]>,
        flat: Vec<[f64; 2]>,
        triangles: Vec<[usize; 3]>,
        images: Vec<usize>,
        seams: BTreeMap<String, Vec<usize>>,
    ) -> PyResult<Self> {
        let mut nodes_in_use = triangles.as_flattened().iter().chain(seams.values().flatten());
        let is_whole = nodes_in_use.all(|node| *node < points.len());
        if !is_whole || points.len() != flat.len() || triangles.len() != images.len() {
            return Err(usage(class.py(), "the lists of a body do not fit together"));
        }
        let mut sealed: Vec<usize> = seams.values().flatten().copied().collect();
        sealed.sort_unstable();
        Ok(Self { surface: WholeBody { points, flat, triangles, images, sealed }, seams })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let Self { surface, seams } = slf.get();
        let WholeBody { points, flat, triangles, images, .. } = surface;
        let content = (points, flat, triangles, images, seams);
        Ok((slf.get_type().getattr("_restored")?, content.into_pyobject(slf.py())?))
    }

    fn __eq__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        has_same_content(slf, other)
    }

    fn __hash__(slf: &Bound<'_, Self>) -> PyResult<isize> {
        hash_of_text(slf)
    }

    fn __repr__(&self) -> String {
        let WholeBody { points, triangles, .. } = &self.surface;
        format!("<Body: {} nodes, {} triangles, closed>", points.len(), triangles.len())
    }
}
