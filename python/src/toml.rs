//! Converts Python's dicts and values into TOML, and back. Values that TOML does not have are refused here; an invalid spec is refused by
//! the spec's own reader.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyList, PyString, PyTuple};
use toml_edit::{Array, ArrayOfTables, DocumentMut, Item, Table, TableLike, Value};

use crate::faults::usage;

/// A text, a number, a bool or a list of them.
pub(crate) fn value(object: &Bound<'_, PyAny>) -> PyResult<Value> {
    // A bool is an int in Python, so it comes first.
    if let Ok(truth) = object.cast::<PyBool>() {
        return Ok(truth.is_true().into());
    }
    if let Ok(text) = object.cast::<PyString>() {
        return Ok(text.to_string().into());
    }
    if object.is_instance_of::<PyList>() || object.is_instance_of::<PyTuple>() {
        let items = object.try_iter()?.map(|item| value(&item?));
        return Ok(Value::Array(items.collect::<PyResult<Array>>()?));
    }
    if object.is_instance_of::<PyFloat>() {
        return Ok(object.extract::<f64>()?.into());
    }
    // NumPy's integers are not ints, but they are indices; its floats are floats.
    let integer = object.call_method0("__index__").and_then(|index| index.extract::<i64>());
    let kind = object.get_type().name()?;
    integer.map(Value::from).map_err(|_| {
        PyTypeError::new_err(format!("a value of a spec is a str, int, float, bool or list, not {kind}"))
    })
}

/// The TOML text of a dict of sections.
pub(crate) fn text(sections: &Bound<'_, PyDict>) -> PyResult<String> {
    let mut document = DocumentMut::new();
    *document.as_table_mut() = table(sections)?;
    Ok(document.to_string())
}

fn table(dict: &Bound<'_, PyDict>) -> PyResult<Table> {
    let mut table = Table::new();
    for (name, found) in dict {
        let name: String = name.extract()?;
        if found.is_none() {
            continue;
        }
        let item = if let Ok(section) = found.cast::<PyDict>() {
            Item::Table(self::table(section)?)
        } else if let Some(list) = tables(&found)? {
            Item::ArrayOfTables(list)
        } else {
            Item::Value(value(&found)?)
        };
        let _ = table.insert(&name, item);
    }
    Ok(table)
}

/// A list that contains only dicts.
fn tables(object: &Bound<'_, PyAny>) -> PyResult<Option<ArrayOfTables>> {
    let Ok(list) = object.cast::<PyList>() else { return Ok(None) };
    if list.is_empty() || !list.iter().all(|item| item.is_instance_of::<PyDict>()) {
        return Ok(None);
    }
    let tables = list.iter().map(|item| table(item.cast::<PyDict>()?));
    tables.collect::<PyResult<ArrayOfTables>>().map(Some)
}

/// The dict of a TOML text.
pub(crate) fn dict<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyDict>> {
    let document: DocumentMut =
        text.parse().map_err(|error: toml_edit::TomlError| usage(py, error.message()))?;
    section(py, document.as_table())
}

fn section<'py>(py: Python<'py>, table: &dyn TableLike) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    for (name, item) in table.iter() {
        if let Some(inner) = item.as_table_like() {
            dict.set_item(name, section(py, inner)?)?;
        } else if let Some(list) = item.as_array_of_tables() {
            let inner = list.iter().map(|table| section(py, table)).collect::<PyResult<Vec<_>>>()?;
            dict.set_item(name, inner)?;
        } else if let Some(value) = item.as_value() {
            dict.set_item(name, plain(py, value)?)?;
        }
    }
    Ok(dict)
}

fn plain<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::String(text) => text.value().into_pyobject(py)?.into_any(),
        Value::Integer(whole) => whole.value().into_pyobject(py)?.into_any(),
        Value::Float(number) => number.value().into_pyobject(py)?.into_any(),
        Value::Boolean(truth) => truth.value().into_pyobject(py)?.to_owned().into_any(),
        Value::Datetime(date) => date.value().to_string().into_pyobject(py)?.into_any(),
        Value::Array(list) => {
            let items = list.iter().map(|item| plain(py, item)).collect::<PyResult<Vec<_>>>()?;
            items.into_pyobject(py)?.into_any()
        }
        Value::InlineTable(inner) => section(py, inner)?.into_any(),
    })
}
