//! `Prediction` and `ActuatorPrediction`: the crate's own structures, as attributes and as dicts when they are asked for.

use std::sync::Arc;

use pyo3::exceptions::PyAttributeError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyList};
use serde::Serialize;
use stargrip_cam::cli::embedded;
use stargrip_cam::cli::embedded::{Given, StarQuestion};
use stargrip_cam::design::{self, Refusals};
use stargrip_cam::forecast::actuator::ActuatorPrediction as Actuated;
use stargrip_cam::forecast::by_shell::Detail;
use stargrip_cam::forecast::predict as ask;
use stargrip_cam::forecast::predict::PredictFault;
use stargrip_cam::forecast::prediction as said;
use stargrip_cam::forecast::report;
use stargrip_cam::forecast::shell_prediction::ShellPrediction;
use stargrip_cam::forecast::star_by_shell::{self, Refusal};
use stargrip_cam::shell::cases::{Shape, Watch};
use stargrip_cam::spec::{ModelChoice, Spec as Read};
use stargrip_cam::units::Length;

use crate::faults::{of_design, of_failure, of_prediction};
use crate::mesh::Mesh;
use crate::spec::Spec;
use crate::waiting::{Line, wait};

/// The dict of an answer, made when it is first asked for.
pub(crate) struct Fields(PyOnceLock<Py<PyDict>>);

impl Fields {
    const fn new() -> Self {
        Self(PyOnceLock::new())
    }

    fn dict<'py>(&self, py: Python<'py>, of: &impl Serialize) -> PyResult<&Bound<'py, PyDict>> {
        let made = || Ok::<_, PyErr>(pythonize::pythonize(py, of)?.cast_into::<PyDict>()?.unbind());
        Ok(self.0.get_or_try_init(py, made)?.bind(py))
    }

    fn named<'py>(&self, py: Python<'py>, of: &impl Serialize, name: &str) -> PyResult<Bound<'py, PyAny>> {
        self.dict(py, of)?.get_item(name)?.ok_or_else(|| {
            PyAttributeError::new_err(format!("a prediction has no `{name}`; dir() of it lists what it has"))
        })
    }
}

/// Methods of a class with `answer`, `fields` and `mesh`, and its own `__str__` and `__repr__`.
macro_rules! answer {
    ($class:ident $($own:tt)*) => {
        #[pymethods]
        impl $class {
            /// The sheet as the shell found it; None of every other model.
            #[getter]
            fn mesh(&self, py: Python<'_>) -> Option<Py<Mesh>> {
                self.mesh.as_ref().map(|mesh| mesh.clone_ref(py))
            }

            /// All of it, as the command prints it with `--json`.
            fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
                Ok(pythonize::pythonize(py, &self.answer)?)
            }

            fn __getattr__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
                self.fields.named(py, &self.answer, name)
            }

            fn __dir__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
                let names = self.fields.dict(py, &self.answer)?.keys();
                for own in ["mesh", "to_dict"] {
                    names.append(own)?;
                }
                Ok(names)
            }

            fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
                slf.py().import("stargrip_cam._shown")?.getattr("prediction")?.call1((slf,))
            }

            $($own)*
        }
    };
}

/// What a gripper does. Every key of `predict --json` is an attribute: lengths in mm, angles in degrees, forces in N, with the unit in
/// the name; None where something is missing that the answer needs. Those at the top speak of star 1, `stars` of each.
#[pyclass(frozen, module = "stargrip_cam")]
pub(crate) struct Prediction {
    given: Arc<Given>,
    answer: Answer,
    fields: Fields,
    mesh: Option<Py<Mesh>>,
}

#[derive(Serialize)]
#[serde(untagged)]
enum Answer {
    Star(Box<said::Prediction>),
    Shell(Box<ShellPrediction>),
}

impl Prediction {
    pub(crate) fn of_star(given: Arc<Given>, prediction: said::Prediction) -> Self {
        Self { given, answer: Answer::Star(Box::new(prediction)), fields: Fields::new(), mesh: None }
    }
}

answer! {
    Prediction

    /// The page that the command prints.
    fn __str__(&self) -> String {
        let spec = &self.given.reading.spec;
        match &self.answer {
            Answer::Star(star) => report::text(spec, star),
            Answer::Shell(shell) => shell.to_text(spec),
        }
    }

    fn __repr__(&self) -> String {
        let model = match &self.answer {
            Answer::Star(star) => star.first.model,
            Answer::Shell(shell) => shell.first.model,
        };
        format!("<Prediction {:?} by {model}>", self.given.reading.spec.name)
    }
}

/// What a V-actuator does: every key of `actuator --json` is an attribute.
#[pyclass(frozen, module = "stargrip_cam")]
pub(crate) struct ActuatorPrediction {
    answer: Actuated,
    fields: Fields,
    mesh: Option<Py<Mesh>>,
}

impl ActuatorPrediction {
    pub(crate) fn new(py: Python<'_>, answer: Actuated, shape: Option<Shape>) -> PyResult<Self> {
        Ok(Self {
            answer,
            fields: Fields::new(),
            mesh: shape.map(|shape| Py::new(py, Mesh(shape))).transpose()?,
        })
    }
}

answer! {
    ActuatorPrediction

    /// The page that the command prints.
    fn __str__(&self) -> String {
        self.answer.to_text()
    }

    fn __repr__(&self) -> String {
        format!("<ActuatorPrediction by {}>", self.answer.model)
    }
}

/// Why there is no answer.
enum Refused {
    Design(Refusals),
    Fault(PredictFault),
    Cancelled,
}

/// What the gripper of `spec` does, by `model` ("fit", "ring", "bvp", "section", "shell", "auto") or the spec's own. With `radii`, such
/// as "20 mm..40 mm/5", also the force on round objects. `fineness` is the shell's: "coarse", "medium" or "fine".
#[pyfunction]
#[pyo3(signature = (spec, *, model = None, radii = None, fineness = None, progress = None))]
pub(crate) fn predict(
    py: Python<'_>,
    spec: &Spec,
    model: Option<&str>,
    radii: Option<&str>,
    fineness: Option<&str>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Prediction> {
    let given = Arc::clone(&spec.given);
    let asked = question(model, radii, fineness).map_err(|failure| of_failure(py, &failure))?;
    let model = asked.model.unwrap_or(given.reading.spec.accuracy.model);
    let answered = if model == ModelChoice::Shell {
        let given = Arc::clone(&given);
        wait(py, progress, move |line| by_shell(&given, &asked, line))?
    } else {
        py.detach(|| by_others(&given, &asked))
    };
    let (answer, shape) = answered.map_err(|refused| match refused {
        Refused::Design(refusals) => of_design(py, &given, refusals),
        Refused::Fault(fault) => of_prediction(py, &given, &fault),
        Refused::Cancelled => of_failure(py, &embedded::Failure::Interrupted),
    })?;
    let mesh = shape.map(|shape| Py::new(py, Mesh(shape))).transpose()?;
    Ok(Prediction { given, answer, fields: Fields::new(), mesh })
}

/// Computes what `predict` does `times` times, without Python: what tests/overhead.py compares its calls with.
#[pyfunction]
pub(crate) fn repeat(py: Python<'_>, spec: &Spec, model: Option<&str>, times: u32) -> PyResult<()> {
    let asked = question(model, None, None).map_err(|failure| of_failure(py, &failure))?;
    for _ in 0..times {
        let _ = std::hint::black_box(by_others(&spec.given, &asked));
    }
    Ok(())
}

/// The question in the command's own words; those of a model alone need no reading.
fn question(
    model: Option<&str>,
    radii: Option<&str>,
    fineness: Option<&str>,
) -> Result<StarQuestion, embedded::Failure> {
    let known = model.map(embedded::model);
    if radii.is_none() && fineness.is_none() && known != Some(None) {
        return Ok(StarQuestion { model: known.flatten(), radii: Vec::new(), detail: Detail::Medium });
    }
    let options = [("--model", model), ("--radii", radii), ("--fineness", fineness)];
    let options = options.iter().filter_map(|(name, value)| Some(format!("{name}={}", (*value)?)));
    embedded::star_question(&options.collect::<Vec<_>>())
}

/// The spec with the model that is asked for.
fn asked_spec(given: &Given, asked: &StarQuestion) -> Read {
    let mut spec = given.reading.spec.clone();
    if let Some(model) = asked.model {
        spec.accuracy.model = model;
    }
    spec
}

fn by_others(given: &Given, asked: &StarQuestion) -> Result<(Answer, Option<Shape>), Refused> {
    let spec = asked_spec(given, asked);
    let design = design::Design::new(&spec, &given.machine).map_err(Refused::Design)?;
    let mut prediction = ask::predict(&spec, &design).map_err(Refused::Fault)?;
    if !asked.radii.is_empty() {
        let radii: Vec<Length> = asked.radii.iter().copied().map(Length::from_metres).collect();
        ask::add_curve((&spec, &design), &radii, &mut prediction).map_err(Refused::Fault)?;
    }
    Ok((Answer::Star(Box::new(prediction)), None))
}

fn by_shell(given: &Given, asked: &StarQuestion, line: &Line) -> Result<(Answer, Option<Shape>), Refused> {
    let spec = asked_spec(given, asked);
    let design = design::Design::new(&spec, &given.machine).map_err(Refused::Design)?;
    let tell = |part: f64, what: &str| line.tell(part, what);
    let watch = Watch { progress: Some(&tell), cancel: Arc::clone(&line.cancel) };
    let found = star_by_shell::predict((&spec, &design), &asked.radii, asked.detail, &watch);
    let (prediction, shape) = found.map_err(|refusal| match refusal {
        Refusal::Cancelled => Refused::Cancelled,
        Refusal::Fault(fault) => Refused::Fault(fault),
    })?;
    Ok((Answer::Shell(Box::new(prediction)), Some(shape)))
}
