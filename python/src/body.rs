//! `Body`: the whole inflated body in triangles, closed.

use std::collections::BTreeMap;

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple, PyType};
use stargrip_cam::geom::{Path, Point};
use stargrip_cam::shell::cases::{InflatedShape, Symmetry, WholeBody};
use stargrip_cam::units::Length;

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
    /// The body of which `shape` is a part; each node on a seal belongs to the nearest of `seams`, or to "seam" without any.
    pub(crate) fn new(shape: &InflatedShape, symmetry: Symmetry, seams: &[(String, Path)]) -> Self {
        let surface = shape.body(symmetry);
        let mut nodes_by_seam: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for node in &surface.sealed {
            let [x, y] = surface.flat[*node].map(|metres| Length::from_metres(metres).0);
            let place = Point::new(x, y);
            let nearest =
                seams.iter().min_by(|(_, a), (_, b)| a.distance(place).total_cmp(&b.distance(place)));
            let name = nearest.map_or("seam", |(name, _)| name.as_str());
            nodes_by_seam.entry(name.to_owned()).or_default().push(*node);
        }
        Self { surface, seams: nodes_by_seam }
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
