//! `Optimum`: the best star of a search, and the designs that it was compared with.

use std::sync::Arc;

use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict, PyTuple, PyType};
use stargrip_cam::cli::embedded::{self, Loaded, optimize_keywords};
use stargrip_cam::forecast::optimize::Evaluation;
use stargrip_cam::forecast::outcome::Outcome;
use stargrip_cam::units::Length;

use crate::arrays::floats;
use crate::equality::hash_of_text;
use crate::faults::of_failure;
use crate::options::options;
use crate::spec::{Spec, of_text};
use crate::waiting::wait;

/// The values of some designs, a list for each column.
type Columns = Vec<(String, Vec<f64>)>;

/// The result of a search: the best star, and the designs that it was compared with.
#[pyclass(frozen, module = "stargrip_cam")]
pub(crate) struct Optimum {
    /// The spec with the best star that can be built; None if no design meets all constraints and can be built.
    #[pyo3(get)]
    spec: Option<Spec>,
    /// The number of designs that were computed.
    #[pyo3(get)]
    computed: usize,
    best: Columns,
    short: Vec<Vec<(String, f64)>>,
    front: Columns,
}

/// Searches around `spec` for the best star. The keywords are the options of the command `optimize`. Ranges are pairs or texts:
/// points=(3, 8), tip_angle=("20 deg", "60 deg") or "20 deg..60 deg".
///
/// goal: "hold" (the object's mass with the least fabric), "contraction", "stiffness" or "fabric" (the least). Default: "hold" if
///     [load] has an object, else "contraction".
/// points: numbers of points; default: (3, 12).
/// tip_angle: tip angles; default: 10 to 90 deg.
/// tube_width: tube widths; default: half to one and a half times the spec's.
/// tip_radius, corner_radius, inner_radius, pressure: default: the spec's.
/// count: numbers of stars; default: the spec's.
/// grasp: radii of objects that the star must close to and open to.
/// payload: least payload of the stack, kg.
/// largest_force: largest radial force of one star, N; default: that of [load].
/// burst_margin: least burst pressure over the pressure; default: 1 if the seal's strength is known.
/// progress: True shows a line with the progress; a callable gets the part that is done, 0 to 1, and a text.
///
/// Raises UsageError for wrong arguments. A search that is interrupted stops at its next design.
#[pyfunction]
#[pyo3(
    signature = (spec, *, progress = None, **question),
    text_signature = "(spec, *, goal=None, points=None, tip_angle=None, tube_width=None, tip_radius=None, corner_radius=None, \
                      inner_radius=None, pressure=None, count=None, grasp=None, payload=None, largest_force=None, \
                      burst_margin=None, progress=None)"
)]
pub(crate) fn optimize(
    py: Python<'_>,
    spec: &Spec,
    progress: Option<&Bound<'_, PyAny>>,
    question: Option<&Bound<'_, PyDict>>,
) -> PyResult<Optimum> {
    let option_list = options("optimize", &optimize_keywords(), question)?;
    let loaded = Arc::clone(&spec.given);
    let optimum = wait(py, progress, move |line| {
        line.tell(0.0, "searching");
        embedded::optimum(&loaded, &option_list, &line.cancel)
    })?;
    let embedded::Optimum { found: search, best, short } =
        optimum.map_err(|failure| of_failure(py, &failure))?;
    let Loaded { source, path, .. } = spec.given.as_ref();
    let owned =
        |missed: Vec<(&str, f64)>| missed.into_iter().map(|(what, part)| (what.to_owned(), part)).collect();
    Ok(Optimum {
        spec: best.map(|text| of_text(py, &text, &source.name, path)).transpose()?,
        computed: search.computed,
        best: columns(&search.best),
        short: short.into_iter().map(owned).collect(),
        front: columns(&search.front),
    })
}

#[pymethods]
impl Optimum {
    /// The best design for each number of points, not only the best of all: a dict of arrays, one for each column. Entry 0 of each is
    /// the best design. NaN where a number is unknown; `violation` is 0 where all constraints are met.
    #[getter]
    fn best<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        arrays(py, &self.best)
    }

    /// For each design in `best` the constraints that it violates, and by which fraction.
    #[getter]
    fn short<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        self.short
            .iter()
            .map(|missed| missed.iter().map(|(what, part)| (what, part)).into_py_dict(py))
            .collect()
    }

    /// The designs that meet all constraints, and that none beats in contraction, stiffness and fabric at once: a dict of arrays, one
    /// for each column, by falling contraction.
    #[getter]
    fn front<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        arrays(py, &self.front)
    }

    /// Called by `__reduce__`.
    #[classmethod]
    fn _restored(
        _class: &Bound<'_, PyType>,
        spec: Option<Spec>,
        computed: usize,
        best: Columns,
        short: Vec<Vec<(String, f64)>>,
        front: Columns,
    ) -> Self {
        Self { spec, computed, best, short, front }
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let Self { spec, computed, best, short, front } = slf.get();
        let state = (spec.clone(), *computed, best.clone(), short.clone(), front.clone());
        Ok((slf.get_type().getattr("_restored")?, state.into_pyobject(slf.py())?))
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| {
            let other = other.get();
            let [text, other_text] =
                [self, other].map(|optimum| optimum.spec.as_ref().map(|spec| &spec.given.source.text));
            text == other_text
                && (self.computed, &self.short) == (other.computed, &other.short)
                && are_equal(&self.best, &other.best)
                && are_equal(&self.front, &other.front)
        })
    }

    fn __hash__(slf: &Bound<'_, Self>) -> PyResult<isize> {
        hash_of_text(slf)
    }

    fn __repr__(&self) -> String {
        let (best, front) = (row_count(&self.best), row_count(&self.front));
        format!("<Optimum of {} designs: {best} best by points, {front} on the front>", self.computed)
    }
}

fn row_count(columns: &Columns) -> usize {
    columns.first().map_or(0, |(_, values)| values.len())
}

/// Whether two tables have the same values. A value that is unknown, NaN, equals another one.
fn are_equal(columns: &Columns, other_columns: &Columns) -> bool {
    let bits = |(name, values): &(String, Vec<f64>)| {
        (name.clone(), values.iter().map(|value| value.to_bits()).collect::<Vec<_>>())
    };
    columns.iter().map(bits).eq(other_columns.iter().map(bits))
}

/// A column: its name and the value of one design.
type Column = (&'static str, fn(&Evaluation) -> Option<f64>);

fn outcome_of(evaluation: &Evaluation) -> Option<&Outcome> {
    evaluation.answer.outcome.as_ref()
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
    ("final_radius_mm", |one| outcome_of(one).map(|own| mm(own.rest.radius))),
    ("final_radius_lo_mm", |one| outcome_of(one)?.ranges.radius.map(|range| mm(range[0]))),
    ("final_radius_hi_mm", |one| outcome_of(one)?.ranges.radius.map(|range| mm(range[1]))),
    ("contraction", |one| outcome_of(one).map(|own| own.contraction)),
    ("widest_radius_mm", |one| outcome_of(one).map(|own| mm(own.graspable[1]))),
    ("radial_stiffness_N_per_m", |one| outcome_of(one)?.stiffness),
    ("object_force_N", |one| outcome_of(one)?.object_force()),
    ("object_force_lo_N", |one| outcome_of(one)?.force_range.map(|range| range[0])),
    ("object_force_hi_N", |one| outcome_of(one)?.force_range.map(|range| range[1])),
    ("payload_kg", |one| one.answer.payload),
    ("payload_lo_kg", |one| one.answer.payload_range.map(|range| range[0])),
    ("payload_hi_kg", |one| one.answer.payload_range.map(|range| range[1])),
    // mm^2 to cm^2.
    ("fabric_cm2", |one| one.answer.fabric.map(|area| area / 100.0)),
    ("violation", |one| Some(one.violation)),
];

fn columns(designs: &[Evaluation]) -> Columns {
    let column = |(name, value): &Column| {
        let values = designs.iter().map(|one| value(one).unwrap_or(f64::NAN)).collect();
        ((*name).to_owned(), values)
    };
    COLUMNS.iter().map(column).collect()
}

fn arrays<'py>(py: Python<'py>, columns: &Columns) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    for (name, values) in columns {
        dict.set_item(name, floats(py, values, &[values.len()])?)?;
    }
    Ok(dict)
}
