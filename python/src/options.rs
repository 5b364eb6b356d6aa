//! Keywords as the options of a command, which has their meaning, defaults and limits: `tube_width="30 mm"` is `--tube-width=30 mm`.

use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The options that `keywords` put. None is not said; a pair (from, to) is the range "from..to"; True is a flag.
pub(crate) fn options(keywords: Option<&Bound<'_, PyDict>>) -> PyResult<Vec<String>> {
    let mut options = Vec::new();
    for (name, value) in keywords.into_iter().flatten() {
        let name = name.extract::<String>()?.replace('_', "-");
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
