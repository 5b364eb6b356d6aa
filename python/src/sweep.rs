//! `sweep`: many designs at once, as one array a column.

use std::ops::Range;
use std::sync::Arc;

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use rayon::ThreadPoolBuilder;
use stargrip_cam::forecast::study::{ColumnValues, RowBatch, Study};
use stargrip_cam::spec::Source;
use stargrip_cam::spec::study::{Axis, Block, StudyFile, Wanted, read_study};

use crate::arguments;
use crate::arrays::{floats, integers};
use crate::faults::{of_spec, usage};
use crate::options::refuse_unknown;
use crate::spec::Spec;
use crate::waiting::{Line, wait};

/// Rows between two reports of progress.
const STEP: usize = 1 << 14;

/// Computes many designs around `spec`. Returns a dict of arrays, one for each column: NaN where a number is unknown; columns of text
/// are arrays of str and None.
///
/// vary: a dict from keys to values, each a list or "10 mm..40 mm/31". Every combination is computed; the last key runs fastest.
/// study: instead of `vary`, the text of a study file. Its own `spec` is not read.
/// outputs: a list of the columns to compute; default: all.
/// part: (k, n) computes part k of n, from 1. Rows do not depend on how a sweep is split.
/// threads: the number of threads; default: one a core.
/// progress: True shows a line with the progress; a callable gets the part that is done, 0 to 1, and a text.
///
/// Raises SpecError for a study or a column that is refused, UsageError for wrong arguments.
#[pyfunction]
#[pyo3(
    signature = (spec, vary = None, *, study = None, outputs = None, part = None, threads = None, progress = None, **unknown),
    text_signature = "(spec, vary=None, *, study=None, outputs=None, part=None, threads=None, progress=None)"
)]
#[expect(clippy::too_many_arguments, reason = "keywords, of which a call names few")]
pub(crate) fn sweep<'py>(
    py: Python<'py>,
    spec: &Spec,
    vary: Option<&Bound<'py, PyDict>>,
    #[pyo3(from_py_with = arguments::study)] study: Option<String>,
    #[pyo3(from_py_with = arguments::outputs)] outputs: Option<Vec<String>>,
    #[pyo3(from_py_with = arguments::part)] part: Option<(usize, usize)>,
    #[pyo3(from_py_with = arguments::threads)] threads: Option<usize>,
    progress: Option<&Bound<'py, PyAny>>,
    unknown: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyDict>> {
    // The rows of the part are computed in the threads of a pool, if the caller limits their number, else in those of the process. Each column
    // then becomes an array.
    refuse_unknown("sweep", &["vary", "study", "outputs", "part", "threads", "progress"], unknown)?;
    let study = study_of(py, spec, vary, study, outputs)?;
    let (k, n) = part.unwrap_or((1, 1));
    let rows = study.part(k, n);
    let pool = threads.map(|threads| ThreadPoolBuilder::new().num_threads(threads).build()).transpose();
    let pool = pool.map_err(|error| usage(py, format!("cannot start the threads: {error}")))?;
    let study = Arc::new(study);
    let column_values = {
        let study = Arc::clone(&study);
        wait(py, progress, move |line| match pool {
            Some(pool) => pool.install(|| computed(&study, rows, line)),
            None => computed(&study, rows, line),
        })?
    };
    let columns = PyDict::new(py);
    for (column, values) in study.columns().iter().zip(column_values) {
        columns.set_item(&column.name, array(py, values)?)?;
    }
    Ok(columns)
}

/// The columns of a sweep with these arguments: (number of rows, fingerprint, columns), each column as (name, unit, meaning).
#[pyfunction]
#[pyo3(signature = (spec, vary = None, *, study = None, outputs = None))]
pub(crate) fn sweep_columns(
    py: Python<'_>,
    spec: &Spec,
    vary: Option<&Bound<'_, PyDict>>,
    #[pyo3(from_py_with = arguments::study)] study: Option<String>,
    #[pyo3(from_py_with = arguments::outputs)] outputs: Option<Vec<String>>,
) -> PyResult<(usize, String, Vec<Described>)> {
    let study = study_of(py, spec, vary, study, outputs)?;
    let columns =
        study.columns().iter().map(|column| (column.name.clone(), column.unit, column.about.clone()));
    Ok((study.rows(), study.fingerprint(), columns.collect()))
}

/// A column's name, unit and meaning.
type Described = (String, Option<&'static str>, String);

fn study_of(
    py: Python<'_>,
    spec: &Spec,
    vary: Option<&Bound<'_, PyDict>>,
    study: Option<String>,
    outputs: Option<Vec<String>>,
) -> PyResult<Study> {
    let file = match (vary, study) {
        (Some(vary), None) => varied(vary)?,
        (None, Some(text)) => {
            read_study(&Source::new("study", text)).map_err(|faults| of_spec(py, &faults))?
        }
        _ => return Err(usage(py, "a sweep takes either `vary` or `study`")),
    };
    let selected = outputs.map(|names| names.into_iter().map(|name| Wanted { name, place: 0..0 }).collect());
    let file = StudyFile { outputs: selected.or(file.outputs), ..file };
    Study::new(&file, &spec.given.source).map_err(|faults| of_spec(py, &faults))
}

/// The study of every combination of the values of `vary`.
fn varied(vary: &Bound<'_, PyDict>) -> PyResult<StudyFile> {
    let py = vary.py();
    let mut blocks = Vec::new();
    for (key, values) in vary {
        let list = arguments::values(&key.str()?.to_cow()?, &values)?;
        let axis = Axis::parse(&format!("{key}={list}")).map_err(|text| usage(py, text))?;
        let block = Block::new(vec![axis]);
        blocks.push(block.ok_or_else(|| usage(py, format!("`{key}` is given no values")))?);
    }
    let source = Source::new("vary", "");
    let (spec, set) = (String::new(), Vec::new());
    Ok(StudyFile {
        source,
        spec,
        model: None,
        fineness: None,
        set,
        blocks,
        outputs: None,
        processes: Vec::new(),
    })
}

/// The columns of `rows`; fewer rows if the call was cancelled.
fn computed(study: &Study, rows: Range<usize>, line: &Line) -> Vec<ColumnValues> {
    let total = rows.len();
    let mut columns: Vec<ColumnValues> = Vec::new();
    let (mut rows_done, mut rows_told) = (0, 0);
    let take = |batch: RowBatch, count: usize| {
        rows_done += count;
        if columns.is_empty() {
            columns = batch.columns.iter().map(|values| empty(values, total)).collect();
        }
        for (own, more) in columns.iter_mut().zip(batch.columns) {
            append(own, more);
        }
        if rows_done >= rows_told + STEP {
            rows_told = rows_done;
            #[expect(clippy::cast_precision_loss, reason = "a part, for people")]
            line.tell(rows_done as f64 / total as f64, "designs");
        }
        true
    };
    let _ = study.run(rows, &line.cancel, |batch| batch, take);
    columns
}

/// An empty column of the kind of `values`, with a capacity for `total`, at most 2^22.
fn empty(values: &ColumnValues, total: usize) -> ColumnValues {
    let total = total.min(1 << 22);
    match values {
        ColumnValues::Real(_) => ColumnValues::Real(Vec::with_capacity(total)),
        ColumnValues::Whole(_) => ColumnValues::Whole(Vec::with_capacity(total)),
        ColumnValues::Text(_) => ColumnValues::Text(Vec::with_capacity(total)),
    }
}

fn append(column: &mut ColumnValues, rows: ColumnValues) {
    match (column, rows) {
        (ColumnValues::Real(column), ColumnValues::Real(rows)) => column.extend(rows),
        (ColumnValues::Whole(column), ColumnValues::Whole(rows)) => column.extend(rows),
        (ColumnValues::Text(column), ColumnValues::Text(rows)) => column.extend(rows),
        _ => {}
    }
}

fn array(py: Python<'_>, values: ColumnValues) -> PyResult<Bound<'_, PyAny>> {
    match values {
        ColumnValues::Real(values) => floats(py, &values, &[values.len()]),
        ColumnValues::Whole(values) => integers(py, &values, &[values.len()]),
        ColumnValues::Text(values) => {
            let list = PyList::new(py, values.iter().map(Option::as_deref))?;
            let object = py.import("builtins")?.getattr("object")?;
            py.import("numpy")?.call_method1("array", (list, object))
        }
    }
}
