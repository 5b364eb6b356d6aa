//! `Prediction` and `ActuatorPrediction`: answers as attributes, dicts, text and pickles.

use std::collections::BTreeMap;
use std::sync::Arc;

use pyo3::PyClass;
use pyo3::prelude::*;
use pyo3::pyclass::boolean_struct::True;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyCFunction, PyDict, PyTuple, PyType};
use stargrip_cam::cli::embedded::{GripperAnswer, Loaded};
use stargrip_cam::forecast::actuator::ActuatorPrediction as Actuated;
use stargrip_cam::forecast::keys::{Key, KeyKind};
use stargrip_cam::forecast::prediction as answers;
use stargrip_cam::shell::cases::InflatedShape;

use crate::mesh::Mesh;

/// An answer: the crate's own structure, or the content of a pickle.
pub(crate) enum Answer {
    Gripper(Arc<Loaded>, GripperAnswer),
    Actuator(Box<Actuated>),
    Restored { fields: Py<PyDict>, page: String, shown: String },
}

impl Answer {
    /// A new dict, equal to the JSON of the command's `--json`.
    fn dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let made = match self {
            Self::Gripper(_, answer) => pythonize::pythonize(py, answer)?,
            Self::Actuator(actuated) => pythonize::pythonize(py, actuated)?,
            Self::Restored { fields, .. } => py.import("copy")?.call_method1("deepcopy", (fields,))?,
        };
        Ok(made.cast_into::<PyDict>()?)
    }

    /// The text that the command prints.
    fn page(&self) -> String {
        match self {
            Self::Gripper(given, answer) => answer.text(&given.reading.spec),
            Self::Actuator(actuated) => actuated.to_text(),
            Self::Restored { page, .. } => page.clone(),
        }
    }

    /// The text of `repr`.
    fn shown(&self) -> String {
        match self {
            Self::Gripper(given, answer) => {
                let model = match answer {
                    GripperAnswer::Star(star) => star.first.model,
                    GripperAnswer::Drawn(drawn) => drawn.model,
                };
                format!("<Prediction {:?} by {model}>", given.reading.spec.name)
            }
            Self::Actuator(answer) => format!("<ActuatorPrediction by {}>", answer.model),
            Self::Restored { shown, .. } => shown.clone(),
        }
    }
}

/// The content of both classes: an answer, its dict, which is made at the first access, and the shell's mesh.
pub(crate) struct PythonAnswer {
    answer: Answer,
    fields: PyOnceLock<Py<PyDict>>,
    mesh: Option<Py<Mesh>>,
}

impl PythonAnswer {
    fn new(py: Python<'_>, answer: Answer, shape: Option<InflatedShape>) -> PyResult<Self> {
        let mesh = shape.map(|shape| Py::new(py, Mesh(shape))).transpose()?;
        Ok(Self { answer, fields: PyOnceLock::new(), mesh })
    }

    /// The value of the key `name`; None if this answer has no such key.
    fn value(&self, py: Python<'_>, name: &str) -> PyResult<Py<PyAny>> {
        let fields = self.fields.get_or_try_init(py, || self.answer.dict(py).map(Bound::unbind))?;
        Ok(fields.bind(py).get_item(name)?.map_or_else(|| py.None(), Bound::unbind))
    }
}

/// A class whose attributes are the keys of an answer.
pub(crate) trait Keyed: PyClass<Frozen = True> + Sync {
    /// The keys, in lists.
    const KEYS: &'static [&'static [Key]];
    /// The content of the object.
    fn answer_object(&self) -> &PythonAnswer;
}

/// Adds to the class `T` a property with a docstring for each of its keys.
pub(crate) fn add_properties<T: Keyed>(py: Python<'_>) -> PyResult<()> {
    let class = py.get_type::<T>();
    let property = py.import("builtins")?.getattr("property")?;
    for key in T::KEYS.iter().copied().flatten() {
        let get = move |of: &Bound<'_, PyTuple>, _: Option<&Bound<'_, PyDict>>| -> PyResult<Py<PyAny>> {
            of.get_item(0)?.cast::<T>()?.get().answer_object().value(of.py(), key.name)
        };
        let get = PyCFunction::new_closure(py, None, None, get)?;
        class.setattr(key.name, property.call1((get, py.None(), py.None(), key.about))?)?;
    }
    Ok(())
}

/// The type of a key's value in a stub.
fn spelled(key: &Key) -> String {
    let kind = match key.kind {
        KeyKind::Text => "str",
        KeyKind::Number => "float",
        KeyKind::Pair => "tuple[float, float]",
        KeyKind::Hinges => "dict[str, float | None]",
        KeyKind::Object => "dict[str, Any]",
        KeyKind::List => "list[dict[str, Any]]",
        KeyKind::Rows => "list[tuple[float | None, ...]]",
        KeyKind::Variant => return "Any".to_owned(),
    };
    if key.always { kind.to_owned() } else { format!("{kind} | None") }
}

/// Name and type of every key of each class, for `python/stubs.py`.
#[pyfunction]
pub(crate) fn keys() -> BTreeMap<&'static str, Vec<(&'static str, String)>> {
    let typed = |keys: &'static [&'static [Key]]| {
        keys.iter().copied().flatten().map(|key| (key.name, spelled(key))).collect()
    };
    BTreeMap::from([
        ("Prediction", typed(Prediction::KEYS)),
        ("ActuatorPrediction", typed(ActuatorPrediction::KEYS)),
    ])
}

/// Implements a class of answers with these keys.
macro_rules! answer {
    ($class:ident, $keys:expr) => {
        impl Keyed for $class {
            const KEYS: &'static [&'static [Key]] = $keys;

            fn answer_object(&self) -> &PythonAnswer {
                &self.0
            }
        }

        #[pymethods]
        impl $class {
            /// The sheet in the shell model; None for every other model.
            #[getter]
            fn mesh(&self, py: Python<'_>) -> Option<Py<Mesh>> {
                self.0.mesh.as_ref().map(|mesh| mesh.clone_ref(py))
            }

            /// All keys, equal to the JSON of the command's `--json`.
            fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
                self.0.answer.dict(py)
            }

            fn __str__(&self) -> String {
                self.0.answer.page()
            }

            fn __repr__(&self) -> String {
                self.0.answer.shown()
            }

            /// The answer as a table of its numbers with their ranges, for notebooks.
            fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
                slf.py().import("stargrip_cam._shown")?.getattr("prediction")?.call1((slf,))
            }

            #[classmethod]
            fn _restored(
                _class: &Bound<'_, PyType>,
                fields: Py<PyDict>,
                page: String,
                shown: String,
                mesh: Option<Py<Mesh>>,
            ) -> Self {
                let answer = Answer::Restored { fields, page, shown };
                Self(PythonAnswer { answer, fields: PyOnceLock::new(), mesh })
            }

            fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
                let (py, PythonAnswer { answer, mesh, .. }) = (slf.py(), &slf.get().0);
                let kept = (answer.dict(py)?, answer.page(), answer.shown(), mesh.as_ref());
                Ok((slf.get_type().getattr("_restored")?, kept.into_pyobject(py)?))
            }
        }
    };
}

/// The predicted behaviour of a gripper. Every key of `predict --json` is an attribute: lengths in mm, angles in degrees, forces in N,
/// with the unit in the name. None where the value is unknown, or needs something that the spec does not give.
#[pyclass(frozen, module = "stargrip_cam")]
pub(crate) struct Prediction(PythonAnswer);

impl Prediction {
    /// The answer of any model; only the shell's has a `shape`.
    pub(crate) fn new(py: Python<'_>, answer: Answer, shape: Option<InflatedShape>) -> PyResult<Self> {
        PythonAnswer::new(py, answer, shape).map(Self)
    }
}

answer!(Prediction, answers::Prediction::KEYS);

/// The predicted behaviour of a V-actuator. Every key of `actuator --json` is an attribute, None where the value is unknown.
#[pyclass(frozen, module = "stargrip_cam")]
pub(crate) struct ActuatorPrediction(PythonAnswer);

impl ActuatorPrediction {
    pub(crate) fn new(py: Python<'_>, answer: Actuated, shape: Option<InflatedShape>) -> PyResult<Self> {
        PythonAnswer::new(py, Answer::Actuator(Box::new(answer)), shape).map(Self)
    }
}

answer!(ActuatorPrediction, &[Actuated::KEYS]);
