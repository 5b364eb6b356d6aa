//! Keywords as the options of a command, which has their names, defaults and limits: `tube_width="30 mm"` is `--tube-width=30 mm`.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use stargrip_cam::cli::embedded::nearest;

/// The options that equal `keywords`. None is left out; a pair (from, to) is the range "from..to", a list is "one,two". An unknown keyword of `function` is a
/// TypeError, as for any function of Python.
pub(crate) fn options(
    function: &str,
    names: &[String],
    keywords: Option<&Bound<'_, PyDict>>,
) -> PyResult<Vec<String>> {
    let mut options = Vec::new();
    for (name, value) in keywords.into_iter().flatten() {
        let name = name.extract::<String>()?;
        if !names.contains(&name) {
            return Err(unexpected(function, names, &name));
        }
        let name = name.replace('_', "-");
        if value.is_none() {
            continue;
        }
        let text = match value.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>() {
            Ok((from, to)) if !value.is_instance_of::<pyo3::types::PyString>() => format!("{from}..{to}"),
            _ => match value.cast::<PyList>() {
                Ok(items) => {
                    let items: Vec<String> = items.iter().map(|item| item.to_string()).collect();
                    items.join(",")
                }
                Err(_) => value.str()?.to_string(),
            },
        };
        options.push(format!("--{name}={text}"));
    }
    Ok(options)
}

/// Refuses the `unknown` keywords of `function`, which has those of `names`.
pub(crate) fn refuse_unknown(
    function: &str,
    names: &[&str],
    unknown: Option<&Bound<'_, PyDict>>,
) -> PyResult<()> {
    let Some((name, _)) = unknown.and_then(|unknown| unknown.iter().next()) else { return Ok(()) };
    let names: Vec<String> = names.iter().map(ToString::to_string).collect();
    Err(unexpected(function, &names, &name.extract::<String>()?))
}

/// The refusal of the keyword `name`, which `function` does not have, with a proposal.
pub(crate) fn unexpected(function: &str, names: &[String], name: &str) -> PyErr {
    let proposal =
        nearest(name, names).map_or_else(String::new, |proposal| format!("Did you mean '{proposal}'? "));
    PyTypeError::new_err(format!(
        "{function}() got an unexpected keyword argument '{name}'. {proposal}Allowed are {}",
        names.join(", ")
    ))
}

/// `text` with the options of a command as keywords: "--tube-width" as "tube_width".
pub(crate) fn in_keywords(text: &str) -> String {
    let mut parts = text.split("--");
    let mut words = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let end = part.find(|c: char| c != '-' && !c.is_ascii_lowercase()).unwrap_or(part.len());
        let follows_word = words.ends_with(|c: char| c.is_alphanumeric() || c == '-');
        let (name, rest) = part.split_at(end);
        if name.is_empty() || follows_word {
            words.push_str("--");
            words.push_str(part);
        } else {
            words.push_str(&name.replace('-', "_"));
            words.push_str(rest);
        }
    }
    words
}
