//! Refusals as exceptions: `stargrip_cam.errors` has the classes, this module fills them.

use std::fmt::Display;

use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;
use stargrip_cam::answer::refused::at_keys;
use stargrip_cam::cli::embedded::{Failure, Loaded};
use stargrip_cam::design::{RefusalCode, Refusals};
use stargrip_cam::forecast::predict::PredictFault;
use stargrip_cam::pipeline::no_prediction;
use stargrip_cam::spec::{Fault, Faults, Severity};
use stargrip_cam::verify::Finding;

use crate::options::in_keywords;

/// The exception `name` of `stargrip_cam.errors` with the message `text` and the faults `faults`.
fn raised(py: Python<'_>, name: &str, text: &str, faults: &Bound<'_, PyAny>) -> PyErr {
    static MODULE: PyOnceLock<Py<PyModule>> = PyOnceLock::new();
    let module = MODULE.get_or_try_init(py, || py.import("stargrip_cam.errors").map(Bound::unbind));
    let exception = module.and_then(|module| module.bind(py).getattr(name)?.call1((text, faults)));
    exception.map_or_else(|error| error, PyErr::from_value)
}

/// The exception `name` with one fault: the code `code`, and `text`, whose options become keywords.
pub(crate) fn plain(py: Python<'_>, name: &str, code: &str, text: &str) -> PyErr {
    let text = in_keywords(text);
    let list = fault_list(py, code, &text);
    list.map_or_else(|error| error, |list| raised(py, name, &text, &list))
}

/// The list of one fault.
fn fault_list<'py>(py: Python<'py>, code: &str, text: &str) -> PyResult<Bound<'py, PyAny>> {
    let fault_dict = PyDict::new(py);
    fault_dict.set_item("code", code)?;
    fault_dict.set_item("found", text)?;
    Ok(vec![fault_dict].into_pyobject(py)?.into_any())
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
pub(crate) fn of_design(py: Python<'_>, loaded: &Loaded, refusals: Refusals) -> PyErr {
    of_faults(py, "DesignError", &at_keys(&loaded.source, &loaded.reading.raw, refusals))
}

/// A prediction that cannot be made: `PredictionError`.
pub(crate) fn of_prediction(py: Python<'_>, loaded: &Loaded, fault: &PredictFault) -> PyErr {
    let mut refusals = Refusals::from(no_prediction(fault));
    refusals
        .offer(RefusalCode::LargeShell, "`predict(spec, model=\"shell\", fineness=\"coarse\")` computes it");
    of_faults(py, "PredictionError", &at_keys(&loaded.source, &loaded.reading.raw, refusals))
}

fn of_faults(py: Python<'_>, name: &str, faults: &Faults) -> PyErr {
    let errors = faults.list().iter().filter(|fault| fault.level == Severity::Error);
    let fault_dicts = errors.map(|fault| fault_dict(py, faults, fault)).collect::<PyResult<Vec<_>>>();
    match fault_dicts.and_then(|fault_dicts| Ok(fault_dicts.into_pyobject(py)?.into_any())) {
        Ok(fault_dicts) => raised(py, name, faults.to_string().trim_end(), &fault_dicts),
        Err(error) => error,
    }
}

/// One fault with its place, as a dict.
pub(crate) fn fault_dict<'py>(
    py: Python<'py>,
    faults: &Faults,
    fault: &Fault,
) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("code", fault.code)?;
    dict.set_item("key", faults.key_of(fault))?;
    dict.set_item("line", faults.line_of(fault))?;
    dict.set_item("file", &faults.source().name)?;
    dict.set_item("found", &fault.message)?;
    dict.set_item("allowed", Some(&fault.label).filter(|label| !label.is_empty()))?;
    dict.set_item("help", &fault.help)?;
    Ok(dict)
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
