//! Arguments whose types PyO3 would refuse in terms of Rust, and without their names. Each refusal here names the argument, the found value
//! and the allowed ones.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};
use stargrip_cam::artifact::Kind;

use crate::faults::usage;

fn refused(name: &str, found: &Bound<'_, PyAny>, allowed: &str) -> PyErr {
    let kind = found.get_type().name().map_or_else(|_| "object".to_owned(), |name| name.to_string());
    PyTypeError::new_err(format!("`{name}`: found {kind}; allowed is {allowed}"))
}

/// A text or None.
fn text(name: &str, found: &Bound<'_, PyAny>, allowed: &str) -> PyResult<Option<String>> {
    if found.is_none() {
        return Ok(None);
    }
    let text = found.cast::<PyString>().map_err(|_| refused(name, found, allowed))?;
    Ok(Some(text.to_cow()?.into_owned()))
}

/// A list or tuple of texts, or None. A single text is refused: its letters would be taken as the items.
fn texts(name: &str, found: &Bound<'_, PyAny>, allowed: &str) -> PyResult<Option<Vec<String>>> {
    if found.is_none() {
        return Ok(None);
    }
    if found.is_instance_of::<PyString>() || found.is_instance_of::<PyDict>() {
        return Err(refused(name, found, allowed));
    }
    let items = found.try_iter().map_err(|_| refused(name, found, allowed))?;
    let item = |item: PyResult<Bound<'_, PyAny>>| {
        item?.extract::<String>().map_err(|_| refused(name, found, allowed))
    };
    items.map(item).collect::<PyResult<_>>().map(Some)
}

/// A model's name.
pub(crate) fn model(found: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    text("model", found, "the name of a model: fit, ring, bvp, section, shell or auto")
}

/// Radii of objects.
pub(crate) fn radii(found: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    text("radii", found, "a text with units: \"30 mm\" or \"20 mm..40 mm/5\"")
}

/// The fineness of a shell's meshes.
pub(crate) fn fineness(found: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    text("fineness", found, "coarse, medium or fine")
}

/// The largest accepted error of a prediction.
pub(crate) fn accuracy(found: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    text("accuracy", found, "a text with its unit: \"2 %\"")
}

/// The text of a study file.
pub(crate) fn study(found: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    text("study", found, "the text of a study file")
}

/// Names of columns.
pub(crate) fn outputs(found: &Bound<'_, PyAny>) -> PyResult<Option<Vec<String>>> {
    texts("outputs", found, "a list of names of columns: [\"final_radius_mm\"]")
}

fn names_of_kinds() -> String {
    Kind::ALL.iter().map(|kind| kind.name()).collect::<Vec<_>>().join(", ")
}

/// The only kinds of files.
pub(crate) fn only(found: &Bound<'_, PyAny>) -> PyResult<Option<Vec<Kind>>> {
    kinds("only", found)
}

/// Further kinds of files.
pub(crate) fn with(found: &Bound<'_, PyAny>) -> PyResult<Option<Vec<Kind>>> {
    kinds("with_", found)
}

fn kinds(name: &str, found: &Bound<'_, PyAny>) -> PyResult<Option<Vec<Kind>>> {
    let names = texts(name, found, &format!("a list of kinds of file: {}", names_of_kinds()))?;
    let kind = |name: String| {
        Kind::from_name(&name).ok_or_else(|| {
            usage(found.py(), format!("`{name}` is not a kind of file; allowed are {}", names_of_kinds()))
        })
    };
    names.map(|names| names.into_iter().map(kind).collect()).transpose()
}

/// Number of a part and number of all parts, from 1.
pub(crate) fn part(found: &Bound<'_, PyAny>) -> PyResult<Option<(usize, usize)>> {
    if found.is_none() {
        return Ok(None);
    }
    let allowed = "(k, n) with k from 1 to n";
    let (k, n) = found.extract::<(i64, i64)>().map_err(|_| refused("part", found, allowed))?;
    match (usize::try_from(k), usize::try_from(n)) {
        (Ok(k), Ok(n)) if (1..=n).contains(&k) => Ok(Some((k, n))),
        _ => Err(usage(found.py(), format!("part is ({k}, {n}); allowed is {allowed}"))),
    }
}

/// A number of threads.
pub(crate) fn threads(found: &Bound<'_, PyAny>) -> PyResult<Option<usize>> {
    if found.is_none() {
        return Ok(None);
    }
    let allowed = "a number from 1 to 4096";
    let threads = found.extract::<i64>().map_err(|_| refused("threads", found, allowed))?;
    match usize::try_from(threads) {
        Ok(threads @ 1..=4096) => Ok(Some(threads)),
        _ => Err(usage(found.py(), format!("threads is {threads}; allowed is {allowed}"))),
    }
}

/// The values of one key of a sweep, as in the text of a study file: a text is taken unchanged.
pub(crate) fn values(key: &str, found: &Bound<'_, PyAny>) -> PyResult<String> {
    let py = found.py();
    if let Ok(text) = found.cast::<PyString>() {
        return Ok(text.to_cow()?.into_owned());
    }
    let allowed = "a list of values, or a text such as \"10 mm..40 mm/31\"";
    let items = found.try_iter().map_err(|_| refused(key, found, allowed))?;
    let items: Vec<String> = items.map(|item| Ok(item?.str()?.to_string())).collect::<PyResult<_>>()?;
    if items.is_empty() {
        return Err(usage(py, format!("the list of values of `{key}` is empty; allowed is {allowed}")));
    }
    Ok(items.join(","))
}
