//! Rows as columns of numbers, computed in parallel, in order; slow rows one by one.

use crate::candidate::Candidate;
use crate::study::Study;
use crate::study::output::{ColumnKind, StudyRow};
use rayon::prelude::*;
use spec::study::KeyValue;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// Rows that one task computes: long enough to hide the hand-over, short enough that all threads end together.
const CHUNK: usize = 1024;
/// Chunks that are in memory at a time, whatever the size of the study.
const AT_ONCE: usize = 64;

/// The values of one column.
#[derive(Clone, Debug)]
pub enum ColumnValues {
    /// Numbers; NaN where unknown.
    Real(Vec<f64>),
    /// Whole numbers.
    Whole(Vec<i64>),
    /// Words; `None` for an empty cell.
    Text(Vec<Option<Box<str>>>),
}

/// Consecutive rows, by column.
#[derive(Clone, Debug)]
pub struct RowBatch {
    /// Which rows of the study.
    pub rows: Range<usize>,
    /// One for each of [`Study::columns`], each as long as `rows`.
    pub columns: Vec<ColumnValues>,
}

impl ColumnValues {
    fn new(kind: ColumnKind, len: usize) -> Self {
        match kind {
            ColumnKind::Real => Self::Real(Vec::with_capacity(len)),
            ColumnKind::Whole => Self::Whole(Vec::with_capacity(len)),
            ColumnKind::Text => Self::Text(Vec::with_capacity(len)),
        }
    }

    fn push_number(&mut self, value: f64) {
        match self {
            Self::Real(values) => values.push(value),
            #[expect(
                clippy::cast_possible_truncation,
                reason = "whole numbers of a spec are below 2^32, rows below 1e9"
            )]
            Self::Whole(values) => values.push(value as i64),
            Self::Text(values) => values.push(None),
        }
    }

    fn push_word(&mut self, word: Option<&str>) {
        match self {
            Self::Text(values) => values.push(word.map(Into::into)),
            own => own.push_number(f64::NAN),
        }
    }

    fn push(&mut self, value: &KeyValue) {
        match value {
            KeyValue::Number(number) => self.push_number(*number),
            KeyValue::Word(word) => self.push_word(Some(word)),
            KeyValue::Truth(truth) => self.push_word(Some(&truth.to_string())),
        }
    }
}

impl Study {
    /// Applies `make` to `rows` in parallel, and passes the results in order to `take` with the number of rows, while the next
    /// are computed; `take` may stop by returning false. Memory does not grow with the study. Returns whether it ran to the end.
    pub fn run<T: Send>(
        &self,
        rows: Range<usize>,
        cancel: &Arc<AtomicBool>,
        make: impl Fn(RowBatch) -> T + Sync,
        mut take: impl FnMut(T, usize) -> bool + Send,
    ) -> bool {
        if self.is_slow {
            return self.run_slowly(rows, cancel, |batch| take(make(batch), 1));
        }
        let chunks: Vec<Range<usize>> =
            rows.clone().step_by(CHUNK).map(|from| from..rows.end.min(from + CHUNK)).collect();
        let compute = |some: &[Range<usize>]| -> Option<Vec<(T, usize)>> {
            let batch_of =
                |chunk: &Range<usize>| Some((make(self.chunk(chunk.clone(), cancel)?), chunk.len()));
            some.par_iter().map(batch_of).collect()
        };
        let mut ready: Vec<(T, usize)> = Vec::new();
        for some in chunks.chunks(AT_ONCE) {
            let computed = std::mem::take(&mut ready);
            let (next, goes_on) =
                rayon::join(|| compute(some), || computed.into_iter().all(|(made, count)| take(made, count)));
            match next {
                Some(next) if goes_on => ready = next,
                _ => return false,
            }
        }
        ready.into_iter().all(|(made, count)| take(made, count))
    }

    /// One chunk, by this thread.
    pub(super) fn chunk(&self, rows: Range<usize>, cancel: &Arc<AtomicBool>) -> Option<RowBatch> {
        let mut columns: Vec<ColumnValues> =
            self.columns.iter().map(|column| ColumnValues::new(column.kind, rows.len())).collect();
        let mut place = Vec::new();
        let mut point = self.designs.base.clone();
        for row in rows.clone() {
            if cancel.load(Ordering::Relaxed) {
                return None;
            }
            self.designs.place(row, &mut place);
            self.fill(row, &place, &mut point, &mut columns, cancel)?;
        }
        Some(RowBatch { rows, columns })
    }

    /// Adds a row, and makes `point` its design; `None` if its answer was cancelled.
    fn fill(
        &self,
        row: usize,
        place: &[usize],
        point: &mut Candidate,
        columns: &mut [ColumnValues],
        cancel: &Arc<AtomicBool>,
    ) -> Option<()> {
        // The columns are filled in their order: number, varied values, outputs, refusal. A refused design has no outputs,
        // and its row is not left out.
        let mut columns = columns.iter_mut();
        let mut next = |with: &dyn Fn(&mut ColumnValues)| {
            if let Some(column) = columns.next() {
                with(column);
            }
        };
        #[expect(clippy::cast_precision_loss, reason = "at most 1e9 rows")]
        next(&|column| column.push_number(row as f64));
        for (b, axis) in self.designs.axes() {
            next(&|column| column.push(&axis.value(place[b])));
        }
        let designed = self.designs.set(point, place);
        let answered = designed.and_then(|()| self.models.answer(point, cancel)).transpose()?;
        let row = answered.as_ref().ok().map(|(answer, shell)| StudyRow {
            point,
            answer,
            shell: shell.as_deref(),
            all: self.codes,
        });
        for output in &self.outputs {
            let value = row.as_ref().and_then(|row| output.value(row)).unwrap_or(f64::NAN);
            next(&|column| column.push_number(value));
        }
        let refused = answered.as_ref().err();
        if self.codes {
            next(&|column| column.push_word(refused.map(|refused| refused.code)));
        }
        next(&|column| column.push_word(refused.map(|refused| refused.text.as_str())));
        Some(())
    }
}

impl Study {
    /// Computes each of `rows` on its own in parallel, and hands it to `take` in order as a batch of one: rows that are ready too early
    /// wait for those before them. `take` may stop by returning false. Returns whether it ran to the end.
    fn run_slowly(
        &self,
        rows: Range<usize>,
        cancel: &Arc<AtomicBool>,
        take: impl FnMut(RowBatch) -> bool + Send,
    ) -> bool {
        let queue = Mutex::new((rows.start, BTreeMap::new(), take));
        let compute = |row: usize| {
            let batch = self.chunk(row..row + 1, cancel)?;
            let mut queue = queue.lock().unwrap_or_else(PoisonError::into_inner);
            let (next, early, take) = &mut *queue;
            let _ = early.insert(row, batch);
            while let Some(batch) = early.remove(next) {
                *next += 1;
                if !take(batch) {
                    return None;
                }
            }
            Some(())
        };
        rows.par_bridge().try_for_each(compute).is_some()
    }
}
