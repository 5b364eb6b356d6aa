//! `Prediction`, `DrawnPrediction` with its chambers, and `ActuatorPrediction`: answers as attributes, dicts, text and pickles.

use std::collections::BTreeMap;
use std::sync::Arc;

use pyo3::PyClass;
use pyo3::prelude::*;
use pyo3::pyclass::boolean_struct::True;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyCFunction, PyDict, PyTuple, PyType};
use stargrip_cam::cli::embedded::{GripperAnswer, Loaded};
use stargrip_cam::forecast::actuator::ActuatorPrediction as Actuated;
use stargrip_cam::forecast::drawn::chamber_prediction::ChamberPrediction;
use stargrip_cam::forecast::drawn::prediction::DrawnPrediction as Drawn;
use stargrip_cam::forecast::keys::{Key, KeyKind};
use stargrip_cam::forecast::prediction as answers;
use stargrip_cam::units::count_text;

use crate::equality::{has_same_content, hash_of_text};
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
        let value = match self {
            Self::Gripper(_, answer) => pythonize::pythonize(py, answer)?,
            Self::Actuator(actuated) => pythonize::pythonize(py, actuated)?,
            Self::Restored { fields, .. } => py.import("copy")?.call_method1("deepcopy", (fields,))?,
        };
        Ok(value.cast_into::<PyDict>()?)
    }

    /// The text that the command prints.
    fn page(&self) -> String {
        match self {
            Self::Gripper(given, answer) => answer.text(&given.reading.spec, true),
            Self::Actuator(actuated) => actuated.to_text(),
            Self::Restored { page, .. } => page.clone(),
        }
    }

    /// The text of `repr`.
    fn representation(&self) -> String {
        match self {
            Self::Gripper(given, answer) => {
                let name = &given.reading.spec.name;
                match answer {
                    GripperAnswer::Star(star) => format!("<Prediction {name:?} by {}>", star.first.model),
                    GripperAnswer::Drawn(drawn) => {
                        let chambers = count_text(drawn.chambers.len(), "chamber");
                        format!("<DrawnPrediction {name:?} by {}: {chambers}>", drawn.model)
                    }
                }
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
    fn new(py: Python<'_>, answer: Answer, mesh: Option<Mesh>) -> PyResult<Self> {
        let mesh = mesh.map(|mesh| Py::new(py, mesh)).transpose()?;
        Ok(Self { answer, fields: PyOnceLock::new(), mesh })
    }

    /// The value of the key `name`; None if this answer has no such key.
    fn value(&self, py: Python<'_>, name: &str) -> PyResult<Py<PyAny>> {
        let fields = self.fields.get_or_try_init(py, || self.answer.dict(py).map(Bound::unbind))?;
        let Some(value) = fields.bind(py).get_item(name)? else { return Ok(py.None()) };
        if name != CHAMBERS {
            return Ok(value.unbind());
        }
        let chambers = value.try_iter()?.map(|fields| Py::new(py, Chamber(fields?.cast_into()?.unbind())));
        Ok(chambers.collect::<PyResult<Vec<_>>>()?.into_pyobject(py)?.unbind())
    }
}

/// The key whose values have a class of their own.
const CHAMBERS: &str = "chambers";

/// A class whose attributes are the keys of an answer.
pub(crate) trait Keyed: PyClass<Frozen = True> + Sync {
    /// The keys, in lists.
    const KEYS: &'static [&'static [Key]];
    /// The value of the key `name`; None if the object has no such key.
    fn value(&self, py: Python<'_>, name: &str) -> PyResult<Py<PyAny>>;
}

/// Adds to the class `T` a property with a docstring for each of its keys.
pub(crate) fn add_properties<T: Keyed>(py: Python<'_>) -> PyResult<()> {
    let class = py.get_type::<T>();
    let property = py.import("builtins")?.getattr("property")?;
    for key in T::KEYS.iter().copied().flatten() {
        let get = move |of: &Bound<'_, PyTuple>, _: Option<&Bound<'_, PyDict>>| -> PyResult<Py<PyAny>> {
            of.get_item(0)?.cast::<T>()?.get().value(of.py(), key.name)
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
    let kind = if key.name == CHAMBERS { "list[Chamber]" } else { kind };
    if key.always { kind.to_owned() } else { format!("{kind} | None") }
}

/// Name and type of every key of each class, for `python/stubs.py`.
#[pyfunction]
pub(crate) fn keys() -> BTreeMap<&'static str, Vec<(&'static str, String)>> {
    BTreeMap::from([
        ("Prediction", typed(Prediction::KEYS)),
        ("DrawnPrediction", typed(DrawnPrediction::KEYS)),
        ("Chamber", typed(Chamber::KEYS)),
        ("ActuatorPrediction", typed(ActuatorPrediction::KEYS)),
    ])
}

/// The names of `keys`, each with its type.
fn typed(keys: &'static [&'static [Key]]) -> Vec<(&'static str, String)> {
    keys.iter().copied().flatten().map(|key| (key.name, spelled(key))).collect()
}

/// Implements a class of answers with these keys.
macro_rules! answer {
    ($class:ident, $keys:expr) => {
        impl Keyed for $class {
            const KEYS: &'static [&'static [Key]] = $keys;

            fn value(&self, py: Python<'_>, name: &str) -> PyResult<Py<PyAny>> {
                self.0.value(py, name)
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
                self.0.answer.representation()
            }

            fn __eq__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<bool> {
                has_same_content(slf, other)
            }

            fn __hash__(slf: &Bound<'_, Self>) -> PyResult<isize> {
                hash_of_text(slf)
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
                representation: String,
                mesh: Option<Py<Mesh>>,
            ) -> Self {
                let answer = Answer::Restored { fields, page, shown: representation };
                Self(PythonAnswer { answer, fields: PyOnceLock::new(), mesh })
            }

            fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
                let (py, PythonAnswer { answer, mesh, .. }) = (slf.py(), &slf.get().0);
                let state = (answer.dict(py)?, answer.page(), answer.representation(), mesh.as_ref());
                Ok((slf.get_type().getattr("_restored")?, state.into_pyobject(py)?))
            }
        }
    };
}

/// The predicted behaviour of a star gripper. Every key of `predict --json` is an attribute: lengths in mm, angles in degrees, forces in N,
/// with the unit in the name. None where the value is unknown, or needs something that the spec does not give.
#[pyclass(frozen, module = "stargrip_cam")]
pub(crate) struct Prediction(PythonAnswer);

answer!(Prediction, answers::Prediction::KEYS);

/// The predicted behaviour of a drawn piece. Every key of `predict --json` is an attribute, with the unit in the name; None where the value is
/// unknown, or needs the shell. Numbers of a shell are dicts of `value` and `mesh_error`.
#[pyclass(frozen, module = "stargrip_cam")]
pub(crate) struct DrawnPrediction(PythonAnswer);

answer!(DrawnPrediction, &[Drawn::KEYS]);

/// The answer about the gripper of `loaded`, a `Prediction` or a `DrawnPrediction`; only the shell's has a `mesh`.
pub(crate) fn of_gripper(
    py: Python<'_>,
    loaded: Arc<Loaded>,
    answer: GripperAnswer,
    mesh: Option<Mesh>,
) -> PyResult<Py<PyAny>> {
    let is_drawn = matches!(answer, GripperAnswer::Drawn(_));
    let answer = PythonAnswer::new(py, Answer::Gripper(loaded, answer), mesh)?;
    if is_drawn {
        Ok(Py::new(py, DrawnPrediction(answer))?.into_any())
    } else {
        Ok(Py::new(py, Prediction(answer))?.into_any())
    }
}

/// One chamber of a drawn piece. Every key of a chamber in `predict --json` is an attribute, with the unit in the name; None where the value
/// is unknown, or needs the shell. Numbers of a shell are dicts of `value` and `mesh_error`, some with a place.
#[pyclass(frozen, module = "stargrip_cam")]
pub(crate) struct Chamber(Py<PyDict>);

impl Keyed for Chamber {
    const KEYS: &'static [&'static [Key]] = &[ChamberPrediction::KEYS];

    fn value(&self, py: Python<'_>, name: &str) -> PyResult<Py<PyAny>> {
        Ok(self.0.bind(py).get_item(name)?.map_or_else(|| py.None(), Bound::unbind))
    }
}

#[pymethods]
impl Chamber {
    /// All keys, equal to the JSON of the command's `--json`.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        Ok(py.import("copy")?.call_method1("deepcopy", (&self.0,))?.cast_into()?)
    }

    /// Called by `__reduce__`.
    #[classmethod]
    fn _restored(_class: &Bound<'_, PyType>, fields: Py<PyDict>) -> Self {
        Self(fields)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (Py<PyDict>,))> {
        Ok((slf.get_type().getattr("_restored")?, (slf.get().0.clone_ref(slf.py()),)))
    }

    fn __eq__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        has_same_content(slf, other)
    }

    fn __hash__(slf: &Bound<'_, Self>) -> PyResult<isize> {
        hash_of_text(slf)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let [number, width] = ["chamber", "width_mm"].map(|name| self.value(py, name));
        Ok(format!("<Chamber {}: {} mm wide>", number?, width?))
    }
}

/// The predicted behaviour of a V-actuator. Every key of `actuator --json` is an attribute, None where the value is unknown.
#[pyclass(frozen, module = "stargrip_cam")]
pub(crate) struct ActuatorPrediction(PythonAnswer);

impl ActuatorPrediction {
    pub(crate) fn new(py: Python<'_>, answer: Actuated, mesh: Option<Mesh>) -> PyResult<Self> {
        PythonAnswer::new(py, Answer::Actuator(Box::new(answer)), mesh).map(Self)
    }
}

answer!(ActuatorPrediction, &[Actuated::KEYS]);
