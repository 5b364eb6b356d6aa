//! Rows that take a second to minutes each: every thread takes the next row that is not started.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, PoisonError};

use rayon::prelude::*;

use crate::forecast::study::Study;
use crate::forecast::study::batch::RowBatch;

impl Study {
    /// Computes each of `rows` in parallel, and hands it to `take` as a batch of one when it is there, in no order; `take` may stop
    /// by returning false. Returns whether it was done.
    pub fn each(
        &self,
        rows: impl Iterator<Item = usize> + Send,
        cancel: &Arc<AtomicBool>,
        take: impl FnMut(RowBatch) -> bool + Send,
    ) -> bool {
        let take = Mutex::new(take);
        let one = |row: usize| {
            let batch = self.chunk(row..row + 1, cancel)?;
            let mut take = take.lock().unwrap_or_else(PoisonError::into_inner);
            take(batch).then_some(())
        };
        rows.par_bridge().try_for_each(one).is_some()
    }

    /// The same in order: those that are too early wait for those before them.
    pub(super) fn run_slowly(
        &self,
        rows: Range<usize>,
        cancel: &Arc<AtomicBool>,
        mut take: impl FnMut(RowBatch) -> bool + Send,
    ) -> bool {
        let (mut next, mut early) = (rows.start, BTreeMap::new());
        self.each(rows, cancel, |batch| {
            let _ = early.insert(batch.rows.start, batch);
            while let Some(batch) = early.remove(&next) {
                next += 1;
                if !take(batch) {
                    return false;
                }
            }
            true
        })
    }
}
