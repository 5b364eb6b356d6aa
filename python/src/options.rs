//! Keywords as the options of a command, which has their names, defaults and limits: `tube_width="30 mm"` is `--tube-width=30 mm`.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stargrip_cam::cli::embedded::nearest;

/// The options that equal `keywords`. None is left out; a pair (from, to) is the range "from..to". An unknown keyword of `function` is a
/// TypeError, as for any function of Python.
pub(crate) fn options(
    function: &str,
    known: &[String],
    keywords: Option<&Bound<'_, PyDict>>,
) -> PyResult<Vec<String>> {
    let mut options = Vec::new();
    for (name, value) in keywords.into_iter().flatten() {
        let name = name.extract::<String>()?;
        if !known.contains(&name) {
            let near =
                nearest(&name, known).map_or_else(String::new, |near| format!("Did you mean '{near}'? "));
            return Err(PyTypeError::new_err(format!(
                "{function}() got an unexpected keyword argument '{name}'. {near}Allowed are {}",
                known.join(", ")
            )));
        }
        let name = name.replace('_', "-");
        if value.is_none() {
            continue;
        }
        let text = match value.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>() {
            Ok((from, to)) if !value.is_instance_of::<pyo3::types::PyString>() => format!("{from}..{to}"),
            _ => value.str()?.to_string(),
        };
        options.push(format!("--{name}={text}"));
    }
    Ok(options)
}
