//! Equality of answers: those of one class are equal if they have the same content. A hash is that of the `repr`, which equal answers share.

use pyo3::prelude::*;

/// Whether `other` is of the class of `answer` and has the same content, as `__reduce__` gives it to a pickle.
pub(crate) fn has_same_content(answer: &Bound<'_, PyAny>, other: &Bound<'_, PyAny>) -> PyResult<bool> {
    if !other.get_type().is(answer.get_type()) {
        return Ok(false);
    }
    content(answer)?.eq(content(other)?)
}

/// The arguments with which a pickle makes `answer` again.
fn content<'py>(answer: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    answer.call_method0("__reduce__")?.get_item(1)
}

/// The hash of `answer`.
pub(crate) fn hash_of_text(answer: &Bound<'_, PyAny>) -> PyResult<isize> {
    answer.repr()?.hash()
}
