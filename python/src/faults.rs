//! Refusals as exceptions: `stargrip_cam.errors` has the classes, this module fills them.

use std::fmt::Display;

use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;
use stargrip_cam::answer::refused::at_keys;
use stargrip_cam::cli::embedded::{Failure, Loaded};
use stargrip_cam::design::Refusals;
use stargrip_cam::forecast::predict::PredictFault;
use stargrip_cam::pipeline::no_prediction;
use stargrip_cam::spec::{Fault, Faults, Severity};
use stargrip_cam::verify::Finding;

use crate::options::in_keywords;

/// The exception `name` of `stargrip_cam.errors` with the message `text` and the faults `about`.
fn raised(py: Python<'_>, name: &str, text: &str, about: &Bound<'_, PyAny>) -> PyErr {
    static MODULE: PyOnceLock<Py<PyModule>> = PyOnceLock::new();
    let module = MODULE.get_or_try_init(py, || py.import("stargrip_cam.errors").map(Bound::unbind));
    let made = module.and_then(|module| module.bind(py).getattr(name)?.call1((text, about)));
    made.map_or_else(|error| error, PyErr::from_value)
}

/// The exception `name` with one fault: the code `code`, and `text`, whose options become keywords.
pub(crate) fn plain(py: Python<'_>, name: &str, code: &str, text: &str) -> PyErr {
    let text = in_keywords(text);
    let about = || {
        let one = PyDict::new(py);
        one.set_item("code", code)?;
        one.set_item("found", &text)?;
        Ok(vec![one].into_pyobject(py)?.into_any())
    };
    about().map_or_else(|error: PyErr| error, |about| raised(py, name, &text, &about))
}

/// Wrong arguments, or arguments that exclude each other: `UsageError`.
pub(crate) fn usage(py: Python<'_>, text: impl Display) -> PyErr {
    plain(py, "UsageError", "usage", &text.to_string())
}

/// The faults of a text: `SpecError`.
pub(crate) fn of_spec(py: Python<'_>, faults: &Faults) -> PyErr {
    of_faults(py, "SpecError", faults)
}

/// The refusals of a design: `DesignError`.
pub(crate) fn of_design(py: Python<'_>, given: &Loaded, refusals: Refusals) -> PyErr {
    of_faults(py, "DesignError", &at_keys(&given.source, &given.reading.raw, refusals))
}

/// A prediction that cannot be made: `PredictionError`.
pub(crate) fn of_prediction(py: Python<'_>, given: &Loaded, fault: &PredictFault) -> PyErr {
    let refusals = no_prediction(fault).into();
    of_faults(py, "PredictionError", &at_keys(&given.source, &given.reading.raw, refusals))
}

fn of_faults(py: Python<'_>, name: &str, faults: &Faults) -> PyErr {
    let about = faults.list().iter().filter(|fault| fault.level == Severity::Error);
    let about = about.map(|fault| one(py, faults, fault)).collect::<PyResult<Vec<_>>>();
    match about.and_then(|about| Ok(about.into_pyobject(py)?.into_any())) {
        Ok(about) => raised(py, name, faults.to_string().trim_end(), &about),
        Err(error) => error,
    }
}

/// One fault with its place, as a dict.
pub(crate) fn one<'py>(py: Python<'py>, faults: &Faults, fault: &Fault) -> PyResult<Bound<'py, PyDict>> {
    let one = PyDict::new(py);
    one.set_item("code", fault.code)?;
    one.set_item("key", faults.key_of(fault))?;
    one.set_item("line", faults.line_of(fault))?;
    one.set_item("file", &faults.source().name)?;
    one.set_item("found", &fault.message)?;
    one.set_item("allowed", Some(&fault.label).filter(|label| !label.is_empty()))?;
    one.set_item("help", &fault.help)?;
    Ok(one)
}

/// Findings of reading back: `ProofError`.
pub(crate) fn of_findings(py: Python<'_>, findings: &[Finding]) -> PyErr {
    let text: Vec<String> = findings.iter().map(ToString::to_string).collect();
    match pythonize::pythonize(py, findings) {
        Ok(about) => raised(py, "ProofError", &text.join("\n"), &about),
        Err(error) => error.into(),
    }
}

/// A failed command: the exception of its class.
pub(crate) fn of_failure(py: Python<'_>, failure: &Failure) -> PyErr {
    match failure {
        Failure::Faults(faults) => of_spec(py, faults),
        Failure::Unproven(unproven) => of_findings(py, &unproven.findings),
        Failure::Publish(fault) => plain(py, "PublishError", "publish", &fault.to_string()),
        Failure::Infeasible(text, _) | Failure::File(_, text) | Failure::Message(text) => {
            plain(py, "Error", "refused", text)
        }
        Failure::Usage(text) => usage(py, text),
        Failure::Interrupted | Failure::Stopped(_) => pyo3::exceptions::PyKeyboardInterrupt::new_err(()),
        // Only a command that prints can end with them, and none does here.
        Failure::Reported | Failure::NotCompared | Failure::Pipe => {
            plain(py, "Error", "refused", "the output is closed")
        }
    }
}
