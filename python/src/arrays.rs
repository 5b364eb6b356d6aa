//! NumPy arrays: each is one copy of memory into a buffer that the array then owns. NumPy is imported when the first one is made.

use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyByteArray, PyTuple};

fn array<'py, const N: usize, T>(
    py: Python<'py>,
    values: &[T],
    shape: &[usize],
    (kind, bytes): (&str, fn(&T) -> [u8; N]),
) -> PyResult<Bound<'py, PyAny>> {
    static NDARRAY: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    let buffer = PyByteArray::new_with(py, N * values.len(), |buffer| {
        for (slot, value) in buffer.chunks_exact_mut(N).zip(values) {
            slot.copy_from_slice(&bytes(value));
        }
        Ok(())
    })?;
    let ndarray =
        NDARRAY.get_or_try_init(py, || py.import("numpy")?.getattr("ndarray").map(Bound::unbind))?.bind(py);
    ndarray.call1((PyTuple::new(py, shape)?, kind, buffer))
}

/// An array of float64 of this shape, whose product is the number of `values`.
pub(crate) fn floats<'py>(py: Python<'py>, values: &[f64], shape: &[usize]) -> PyResult<Bound<'py, PyAny>> {
    array(py, values, shape, ("=f8", |value| value.to_ne_bytes()))
}

/// An array of int64 of this shape.
pub(crate) fn integers<'py>(py: Python<'py>, values: &[i64], shape: &[usize]) -> PyResult<Bound<'py, PyAny>> {
    array(py, values, shape, ("=i8", |value| value.to_ne_bytes()))
}

/// Rows of N floats, times `scale`, as an array of shape (rows, N).
pub(crate) fn rows<'py, const N: usize>(
    py: Python<'py>,
    rows: &[[f64; N]],
    scale: f64,
) -> PyResult<Bound<'py, PyAny>> {
    let values: Vec<f64> = rows.as_flattened().iter().map(|value| scale * value).collect();
    floats(py, &values, &[rows.len(), N])
}
