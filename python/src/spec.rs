//! `Spec`: a valid text, with its machine profile.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyType};
use stargrip_cam::cli::embedded::Loaded;
use stargrip_cam::spec::edit::with_changes;
use stargrip_cam::spec::key::named;
use stargrip_cam::spec::{KeyPath, settings, starter};

use crate::faults::{fault_dict, of_failure, of_spec, usage};
use crate::{gripper, toml};

/// The specification of a gripper: valid TOML. It never changes; `replace` makes another.
///
/// Quantities are strings with a unit, "50 mm"; a bare number where a unit is needed is refused.
#[pyclass(frozen, from_py_object, module = "stargrip_cam")]
#[derive(Clone)]
pub(crate) struct Spec {
    pub(crate) given: Arc<Loaded>,
}

#[pymethods]
impl Spec {
    /// Reads a spec: `source` is its text, or names its file, as a path or as a string that ends in ".toml" (no spec is one
    /// line). A machine profile named by path is looked for beside the file; of a text, in the current directory.
    ///
    /// Raises SpecError with all faults at once, OSError if there is no such file.
    #[classmethod]
    fn from_toml(_class: &Bound<'_, PyType>, source: &Bound<'_, PyAny>) -> PyResult<Self> {
        let py = source.py();
        match source.extract::<String>() {
            Ok(text) if !is_path(&text) => of_text(py, &text, "spec", Path::new("")),
            _ => {
                let path: PathBuf = source.extract()?;
                // Python's own exception describes best why a file cannot be opened.
                let _ = py.import("os")?.call_method1("stat", (&path,))?;
                Loaded::from_file(&path).map(Self::new).map_err(|failure| of_failure(py, &failure))
            }
        }
    }

    /// Makes a spec from a dict, as `to_dict` returns it: sections are dicts, `stack["star"]` a list of dicts.
    ///
    /// Raises SpecError with all faults at once; their lines are those of `to_toml()`.
    #[classmethod]
    fn from_dict(_class: &Bound<'_, PyType>, sections: &Bound<'_, PyDict>) -> PyResult<Self> {
        of_text(sections.py(), &toml::text(sections)?, "spec", Path::new(""))
    }

    /// The commented spec of the paper's star, with every key and its default.
    #[classmethod]
    fn starter(_class: &Bound<'_, PyType>, py: Python<'_>, name: &str) -> PyResult<Self> {
        of_text(py, &starter(name).map_err(|fault| usage(py, fault))?, "spec", Path::new(""))
    }

    /// Finds a gripper that holds an object, as `stargrip-cam new` does: the spec that holds it best within its sheet and machine.
    ///
    /// object: width of the object where it is gripped, "75 mm".
    /// mass: "1.2 kg".
    /// name: of the gripper.
    /// height: of the object, default as wide; shape: "ball" (default) or "cylinder".
    /// pressure: of the pump; default: the best from 5 to 60 kPa.
    /// friction: between corners and object; default 0.3.
    /// fragile: largest radial force of one star that the object bears, "20 N".
    /// sheet: size of the fabric, "400x400" in mm, or "A3".
    /// machine: a built-in profile or the path of one; default: generic.
    ///
    /// Raises DesignError with the reasons and the nearest objects if there is none, UsageError for wrong arguments.
    #[classmethod]
    #[pyo3(
        signature = (object, mass, *, name = "gripper", **more),
        text_signature = "($cls, object, mass, *, name=\"gripper\", height=None, shape=None, pressure=None, friction=None, fragile=None, \
                          sheet=None, machine=None)"
    )]
    fn for_object(
        _class: &Bound<'_, PyType>,
        py: Python<'_>,
        object: &str,
        mass: &str,
        name: &str,
        more: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let text = gripper::for_object(py, [object, mass, name], more)?;
        of_text(py, &text, "spec", Path::new(""))
    }

    /// Called by `__reduce__`.
    #[classmethod]
    fn _restored(
        _class: &Bound<'_, PyType>,
        py: Python<'_>,
        text: &str,
        name: &str,
        path: PathBuf,
    ) -> PyResult<Self> {
        of_text(py, text, name, &path)
    }

    /// A spec with other values: `replace({"star.points": 6})`, or `replace(**{"star.points": 6})`. None takes a key away, so
    /// that its default holds. Comments and layout stay. Only all values together need be valid.
    ///
    /// Raises SpecError; its lines are those of the text with the new values.
    #[pyo3(signature = (values = None, /, **more))]
    fn replace(
        &self,
        py: Python<'_>,
        values: Option<&Bound<'_, PyDict>>,
        more: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let mut changes: Vec<(KeyPath, Option<String>)> = Vec::new();
        for (name, value) in values.into_iter().chain(more).flatten() {
            let path = key(py, &name.extract::<String>()?)?;
            let value = if value.is_none() { None } else { Some(toml::value(&value)?.to_string()) };
            changes.push((path, value));
        }
        let changes: Vec<_> = changes.iter().map(|(key, value)| (*key, value.as_deref())).collect();
        let Loaded { source, path, .. } = self.given.as_ref();
        let text = with_changes(source, &changes).map_err(|faults| of_spec(py, &faults))?;
        of_text(py, &text, &source.name, path)
    }

    /// The text.
    fn to_toml(&self) -> &str {
        &self.given.source.text
    }

    /// The keys in the text, as a dict of sections.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        toml::dict(py, &self.given.source.text)
    }

    /// Every key with its value, defaults included, as strings: {"star.points": "5", ...}; None where a key has no default.
    fn settings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        for setting in settings(&self.given.source) {
            let dot = if setting.section.is_empty() { "" } else { "." };
            dict.set_item(format!("{}{dot}{}", setting.section, setting.key), setting.value)?;
        }
        Ok(dict)
    }

    /// Name of the gripper in the spec.
    #[getter]
    fn name(&self) -> &str {
        &self.given.reading.spec.name
    }

    /// Warnings about the valid spec: Faults.
    #[getter]
    fn warnings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let class = py.import("stargrip_cam.errors")?.getattr("Fault")?;
        let warnings = &self.given.reading.warnings;
        let warning_objects =
            warnings.list().iter().map(|fault| class.call((), Some(&fault_dict(py, warnings, fault)?)));
        PyList::new(py, warning_objects.collect::<PyResult<Vec<_>>>()?)
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        let is_equal = |other: PyRef<'_, Self>| {
            // A drawing is no part of the text.
            other.given.source.text == self.given.source.text
                && other.given.machine == self.given.machine
                && other.given.reading.spec == self.given.reading.spec
        };
        other.extract::<PyRef<'_, Self>>().is_ok_and(is_equal)
    }

    fn __hash__(&self, py: Python<'_>) -> PyResult<isize> {
        self.given.source.text.as_str().into_pyobject(py)?.hash()
    }

    fn __repr__(&self) -> String {
        format!("<Spec {:?}>", self.given.reading.spec.name)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (String, String, PathBuf))> {
        let Loaded { source, path, .. } = slf.get().given.as_ref();
        Ok((slf.get_type().getattr("_restored")?, (source.text.clone(), source.name.clone(), path.clone())))
    }
}

impl Spec {
    pub(crate) fn new(loaded: Loaded) -> Self {
        Self { given: Arc::new(loaded) }
    }
}

/// Whether `text` names a file.
fn is_path(text: &str) -> bool {
    !text.contains('\n') && Path::new(text.trim_end()).extension().is_some_and(|ending| ending == "toml")
}

/// The spec of `text`, called `name`, with paths relative to that of `path`.
pub(crate) fn of_text(py: Python<'_>, text: &str, name: &str, path: &Path) -> PyResult<Spec> {
    let loaded = Loaded::from_text(name, text, path);
    loaded.map(Spec::new).map_err(|failure| of_failure(py, &failure))
}

/// The key called `name`: "star.points".
fn key(py: Python<'_>, name: &str) -> PyResult<KeyPath> {
    named(name).map_err(|near| {
        let suggestion = near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
        usage(py, format!("`{name}` is not a key of a spec{suggestion}"))
    })
}
