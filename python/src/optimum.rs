//! `Optimum`: the best star that was found, and what was weighed against it.

use std::sync::Arc;

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stargrip_cam::cli::embedded::{self, Given};
use stargrip_cam::forecast::optimize::Evaluated;
use stargrip_cam::forecast::outcome::Outcome;
use stargrip_cam::units::Length;

use crate::arrays::floats;
use crate::faults::of_failure;
use crate::options::options;
use crate::spec::{Spec, of_text};
use crate::waiting::wait;

/// What a search has come to.
#[pyclass(frozen, module = "stargrip_cam")]
pub(crate) struct Optimum {
    given: Arc<Given>,
    found: embedded::Optimum,
}

/// Searches around `spec` for the best star. The keywords are the options of the command `optimize`: goal, points=(3, 8),
/// tip_angle=("20 deg", "60 deg"), tube_width, tip_radius, corner_radius, inner_radius, pressure, count, grasp, payload,
/// largest_force, burst_margin. A search that is interrupted stops at its next design.
#[pyfunction]
#[pyo3(signature = (spec, *, progress = None, **question))]
pub(crate) fn optimize(
    py: Python<'_>,
    spec: &Spec,
    progress: Option<&Bound<'_, PyAny>>,
    question: Option<&Bound<'_, PyDict>>,
) -> PyResult<Optimum> {
    let options = options(question)?;
    let given = Arc::clone(&spec.given);
    let found = wait(py, progress, move |line| {
        line.tell(0.0, "searching");
        embedded::optimum(&given, &options, &line.cancel)
    })?;
    let found = found.map_err(|failure| of_failure(py, &failure))?;
    Ok(Optimum { given: Arc::clone(&spec.given), found })
}

#[pymethods]
impl Optimum {
    /// The spec with the best star that can be built; None if no design meets all constraints and can be built.
    #[getter]
    fn spec(&self, py: Python<'_>) -> PyResult<Option<Spec>> {
        let Given { source, path, .. } = self.given.as_ref();
        let best = self.found.best.as_ref();
        best.map(|text| of_text(py, text.clone(), &source.name, path)).transpose()
    }

    /// Designs that were computed.
    #[getter]
    fn computed(&self) -> usize {
        self.found.found.computed
    }

    /// The best for each number of points, best first: arrays by column, NaN where nothing is known. `violation` is 0 where all
    /// constraints are met.
    #[getter]
    fn best<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        columns(py, &self.found.found.best)
    }

    /// Of each of `best` the constraints that it misses, and by which part.
    #[getter]
    fn short<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let all = self.found.short.iter().map(|missed| {
            let one = PyDict::new(py);
            for (what, part) in missed {
                one.set_item(what, part)?;
            }
            Ok(one)
        });
        all.collect()
    }

    /// Designs that meet all constraints, and that none beats in contraction, stiffness and fabric at once: arrays by column.
    #[getter]
    fn front<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        columns(py, &self.found.found.front)
    }

    fn __repr__(&self) -> String {
        let (best, front) = (&self.found.found.best, &self.found.found.front);
        format!("<Optimum of {} designs: {} best, {} on the front>", self.computed(), best.len(), front.len())
    }
}

/// A column: its name and the value of one design.
type Column = (&'static str, fn(&Evaluated) -> Option<f64>);

fn own(one: &Evaluated) -> Option<&Outcome> {
    one.answer.outcome.as_ref()
}

fn mm(metres: f64) -> f64 {
    Length::from_metres(metres).0
}

const COLUMNS: &[Column] = &[
    ("points", |one| Some(f64::from(one.point.star.points))),
    ("count", |one| Some(f64::from(one.point.stars))),
    ("pressure_kPa", |one| one.point.load.pressure.map(|pressure| pressure.0)),
    ("inner_radius_mm", |one| Some(one.point.star.inner_radius.0)),
    ("tip_angle_deg", |one| Some(one.point.star.tip_angle.0)),
    ("tube_width_mm", |one| Some(one.point.star.tube_width.0)),
    ("tip_radius_mm", |one| Some(one.point.star.tip_radius.0)),
    ("corner_radius_mm", |one| Some(one.point.star.corner_radius.0)),
    ("arm_length_mm", |one| Some(one.answer.star.l)),
    ("final_radius_mm", |one| own(one).map(|own| mm(own.rest.radius))),
    ("final_radius_lo_mm", |one| own(one)?.ranges.radius.map(|range| mm(range[0]))),
    ("final_radius_hi_mm", |one| own(one)?.ranges.radius.map(|range| mm(range[1]))),
    ("contraction", |one| own(one).map(|own| own.contraction)),
    ("widest_radius_mm", |one| own(one).map(|own| mm(own.graspable[1]))),
    ("radial_stiffness_N_per_m", |one| own(one)?.stiffness),
    ("object_force_N", |one| own(one)?.object_force()),
    ("object_force_lo_N", |one| own(one)?.force_range.map(|range| range[0])),
    ("object_force_hi_N", |one| own(one)?.force_range.map(|range| range[1])),
    ("payload_kg", |one| one.answer.payload),
    ("payload_lo_kg", |one| one.answer.payload_range.map(|range| range[0])),
    ("payload_hi_kg", |one| one.answer.payload_range.map(|range| range[1])),
    // mm^2 to cm^2.
    ("fabric_cm2", |one| one.answer.fabric.map(|area| area / 100.0)),
    ("violation", |one| Some(one.violation)),
];

fn columns<'py>(py: Python<'py>, designs: &[Evaluated]) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    for (name, value) in COLUMNS {
        let values: Vec<f64> = designs.iter().map(|one| value(one).unwrap_or(f64::NAN)).collect();
        all.set_item(name, floats(py, &values, &[values.len()])?)?;
    }
    Ok(all)
}
