//! The inflated sheet in triangles, as arrays.

use pyo3::prelude::*;
use pyo3::types::{PyTuple, PyType};
use stargrip_cam::forecast::shell::sheet::ModelledSheet;
use stargrip_cam::shell::cases::{BodySeam, InflatedShape, Symmetry};

use crate::arrays::{floats, integers, rows};
use crate::body::Body;
use crate::equality::{has_same_content, hash_of_text};
use crate::faults::{plain, usage};
use crate::shapes::Contour;

/// The sheet of a shell model, at rest under pressure, on its finest mesh: N nodes, M triangles. For a star it is one of the two sheets of
/// half a sector beside corner 1, for a V-actuator one sheet of half: `whole()` adds the mirror images.
#[pyclass(frozen, module = "stargrip_cam")]
pub(crate) struct Mesh {
    pub(crate) sheet: ModelledSheet,
}

#[pymethods]
impl Mesh {
    /// Positions of the nodes: (N, 3), mm; the axis of a star is z.
    #[getter]
    fn nodes_mm<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, &self.sheet.shape.points, 1e3)
    }

    /// Positions of the nodes on the flat sheet: (N, 2), mm.
    #[getter]
    fn flat_mm<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, &self.sheet.shape.flat, 1e3)
    }

    /// The nodes of each triangle: (M, 3), int64, from 0.
    #[getter]
    fn triangles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let nodes = self.sheet.shape.triangles.as_flattened().iter();
        // The number of nodes is far below the limit of an integer.
        let nodes: Vec<i64> = nodes.map(|node| i64::try_from(*node).unwrap_or(i64::MAX)).collect();
        integers(py, &nodes, &[self.sheet.shape.triangles.len(), 3])
    }

    /// Principal tensions of each triangle, the larger first: (M, 2), N/mm. Below 0 it is compressed.
    #[getter]
    #[expect(non_snake_case, reason = "names contain units in their usual spelling")]
    fn tension_N_per_mm<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, &self.sheet.shape.tension, 1e-3)
    }

    /// Stretches of each triangle along the principal tensions: (M, 2); 0.01 is one per cent longer.
    #[getter]
    fn stretch<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, &self.sheet.shape.stretch, 1.0)
    }

    /// Principal curvatures of each triangle: (M, 2), 1/mm.
    #[getter]
    fn curvature_per_mm<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, &self.sheet.shape.curvature, 1e-3)
    }

    /// Largest stretch of each node's triangles: (N,), for plots that colour nodes.
    #[getter]
    fn node_stretch<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let mut largest = vec![f64::NEG_INFINITY; self.sheet.shape.points.len()];
        for (nodes, stretch) in self.sheet.shape.triangles.iter().zip(&self.sheet.shape.stretch) {
            for node in nodes {
                largest[*node] = largest[*node].max(stretch[0]);
            }
        }
        floats(py, &largest, &[largest.len()])
    }

    /// The whole body, closed: both sheets and all mirror images, with named seams.
    fn whole(&self, py: Python<'_>) -> Body {
        py.detach(|| Body::new(&self.sheet))
    }

    /// The sheet as the text of a VTU file, which ParaView reads.
    fn vtu(&self, py: Python<'_>) -> PyResult<String> {
        self.sheet.shape.vtu().map_err(|fault| plain(py, "Error", "vtu", &fault.to_string()))
    }

    /// Called by `__reduce__`: nodes and flat nodes in m, triangles, tensions in N/m, stretches, curvatures in 1/m; the number of sectors,
    /// 0 for both sheets alone and 1 for a mirror; the seams.
    #[classmethod]
    fn _restored(
        class: &Bound<'_, PyType>,
        nodes: (Vec<[f64; 3]>, Vec<[f64; 2]>),
        triangles: Vec<[usize; 3]>,
        of_triangles: [Vec<[f64; 2]>; 3],
        sectors: u32,
        seams: Vec<(String, Bound<'_, Contour>)>,
    ) -> PyResult<Self> {
        let ((points, flat), [tension, stretch, curvature]) = (nodes, of_triangles);
        let are_as_many =
            [&tension, &stretch, &curvature].iter().all(|values| values.len() == triangles.len());
        let are_nodes = triangles.as_flattened().iter().all(|node| *node < points.len());
        if !(are_as_many && are_nodes && points.len() == flat.len()) {
            return Err(usage(class.py(), "the lists of a mesh do not fit together"));
        }
        let symmetry = match sectors {
            0 => Symmetry::Sheets,
            1 => Symmetry::Mirror,
            count => Symmetry::Sectors(count),
        };
        let seams =
            seams.into_iter().map(|(name, contour)| BodySeam { name, center_line: contour.get().0.clone() });
        let shape = InflatedShape { points, flat, triangles, tension, stretch, curvature };
        Ok(Self { sheet: ModelledSheet { shape, symmetry, seams: seams.collect() } })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let ModelledSheet { shape, symmetry, seams } = &slf.get().sheet;
        let InflatedShape { points, flat, triangles, tension, stretch, curvature } = shape;
        let sectors = match symmetry {
            Symmetry::Sheets => 0,
            Symmetry::Mirror => 1,
            Symmetry::Sectors(count) => *count,
        };
        let seams: Vec<(&String, Contour)> =
            seams.iter().map(|seam| (&seam.name, Contour(seam.center_line.clone()))).collect();
        let content = ((points, flat), triangles, [tension, stretch, curvature], sectors, seams);
        Ok((slf.get_type().getattr("_restored")?, content.into_pyobject(slf.py())?))
    }

    fn __eq__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        has_same_content(slf, other)
    }

    fn __hash__(slf: &Bound<'_, Self>) -> PyResult<isize> {
        hash_of_text(slf)
    }

    fn __repr__(&self) -> String {
        format!(
            "<Mesh: {} nodes, {} triangles>",
            self.sheet.shape.points.len(),
            self.sheet.shape.triangles.len()
        )
    }
}
