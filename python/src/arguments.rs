//! Arguments whose types PyO3 would refuse in terms of Rust, and without their names. Each refusal here names the argument, the found value
//! and the allowed ones.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};
use stargrip_cam::artifact::Kind;

use crate::faults::usage;

fn refused(name: &str, value: &Bound<'_, PyAny>, allowed: &str) -> PyErr {
    let kind = value.get_type().name().map_or_else(|_| "object".to_owned(), |name| name.to_string());
    PyTypeError::new_err(format!("`{name}`: found {kind}; allowed is {allowed}"))
}

/// A text or None.
fn text(name: &str, value: &Bound<'_, PyAny>, allowed: &str) -> PyResult<Option<String>> {
    if value.is_none() {
        return Ok(None);
    }
    let text = value.cast::<PyString>().map_err(|_| refused(name, value, allowed))?;
    Ok(Some(text.to_cow()?.into_owned()))
}

/// A list or tuple of texts, or None. A single text is refused: its letters would be taken as the items.
fn texts(name: &str, value: &Bound<'_, PyAny>, allowed: &str) -> PyResult<Option<Vec<String>>> {
    if value.is_none() {
        return Ok(None);
    }
    if value.is_instance_of::<PyString>() || value.is_instance_of::<PyDict>() {
        return Err(refused(name, value, allowed));
    }
    let items = value.try_iter().map_err(|_| refused(name, value, allowed))?;
    let item = |item: PyResult<Bound<'_, PyAny>>| {
        item?.extract::<String>().map_err(|_| refused(name, value, allowed))
    };
    items.map(item).collect::<PyResult<_>>().map(Some)
}

/// A model's name.
pub(crate) fn model(value: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    text("model", value, "the name of a model: fit, ring, bvp, section, shell or auto")
}

/// Radii of objects.
pub(crate) fn radii(value: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    text("radii", value, "a text with units: \"30 mm\" or \"20 mm..40 mm/5\"")
}

/// The fineness of a shell's meshes.
pub(crate) fn fineness(value: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    text("fineness", value, "coarse, medium or fine")
}

/// The largest accepted error of a prediction.
pub(crate) fn accuracy(value: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    text("accuracy", value, "a text with its unit: \"2 %\"")
}

/// The text of a study file.
pub(crate) fn study(value: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    text("study", value, "the text of a study file")
}

/// Names of columns.
pub(crate) fn outputs(value: &Bound<'_, PyAny>) -> PyResult<Option<Vec<String>>> {
    texts("outputs", value, "a list of names of columns: [\"final_radius_mm\"]")
}

fn names_of_kinds() -> String {
    Kind::ALL.iter().map(|kind| kind.name()).collect::<Vec<_>>().join(", ")
}

/// The only kinds of files.
pub(crate) fn only_kinds(value: &Bound<'_, PyAny>) -> PyResult<Option<Vec<Kind>>> {
    kinds("only", value)
}

/// Further kinds of files.
pub(crate) fn more_kinds(value: &Bound<'_, PyAny>) -> PyResult<Option<Vec<Kind>>> {
    kinds("with_", value)
}

fn kinds(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Option<Vec<Kind>>> {
    let names = texts(name, value, &format!("a list of kinds of file: {}", names_of_kinds()))?;
    let kind = |name: String| {
        Kind::from_name(&name).ok_or_else(|| {
            usage(value.py(), format!("`{name}` is not a kind of file; allowed are {}", names_of_kinds()))
        })
    };
    names.map(|names| names.into_iter().map(kind).collect()).transpose()
}

/// Number of a part and number of all parts, from 1.
pub(crate) fn part(value: &Bound<'_, PyAny>) -> PyResult<Option<(usize, usize)>> {
    if value.is_none() {
        return Ok(None);
    }
    let allowed = "(k, n) with k from 1 to n";
    let (k, n) = value.extract::<(i64, i64)>().map_err(|_| refused("part", value, allowed))?;
    match (usize::try_from(k), usize::try_from(n)) {
        (Ok(k), Ok(n)) if (1..=n).contains(&k) => Ok(Some((k, n))),
        _ => Err(usage(value.py(), format!("part is ({k}, {n}); allowed is {allowed}"))),
    }
}

/// A number of threads.
pub(crate) fn threads(value: &Bound<'_, PyAny>) -> PyResult<Option<usize>> {
    if value.is_none() {
        return Ok(None);
    }
    let allowed = "a number from 1 to 4096";
    let threads = value.extract::<i64>().map_err(|_| refused("threads", value, allowed))?;
    match usize::try_from(threads) {
        Ok(threads @ 1..=4096) => Ok(Some(threads)),
        _ => Err(usage(value.py(), format!("threads is {threads}; allowed is {allowed}"))),
    }
}

/// The values of one key of a sweep, as in the text of a study file: a text is taken unchanged.
pub(crate) fn values(key: &str, value: &Bound<'_, PyAny>) -> PyResult<String> {
    let py = value.py();
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(text.to_cow()?.into_owned());
    }
    let allowed = "a list of values, or a text such as \"10 mm..40 mm/31\"";
    let items = value.try_iter().map_err(|_| refused(key, value, allowed))?;
    let items: Vec<String> = items.map(|item| Ok(item?.str()?.to_string())).collect::<PyResult<_>>()?;
    if items.is_empty() {
        return Err(usage(py, format!("the list of values of `{key}` is empty; allowed is {allowed}")));
    }
    Ok(items.join(","))
}
