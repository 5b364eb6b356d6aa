//! Rows of a study as CSV; slow rows are also stored in a checkpoint.

use std::fs;
use std::io;
use std::io::Write;
use std::ops::Range;
use std::path::Path;

use crate::cli::interrupt::Listening;
use crate::cli::progress::Progress;
use crate::cli::study::checkpoint::{Checkpoint, beside};
use forecast::study::{RowBatch, Study, csv};

/// Some rows of a study, and the form of their file.
pub(in crate::cli) struct StudyRows<'a> {
    pub(in crate::cli) study: &'a Study,
    /// The range of rows.
    pub(in crate::cli) range: Range<usize>,
    /// Whether the text begins with the names of the columns.
    pub(in crate::cli) header: bool,
    /// Whether a comment under the header gives the units.
    pub(in crate::cli) units: bool,
    /// The output file; slow rows are stored beside it until it is complete.
    pub(in crate::cli) target: Option<&'a Path>,
}

/// The progress line to report to, and the signals that stop the work.
pub(in crate::cli) struct StudyMonitor<'a> {
    pub(in crate::cli) progress: &'a Progress,
    pub(in crate::cli) listening: &'a Listening,
}

impl StudyRows<'_> {
    /// Computes the rows and writes them to `out`. A signal gives an error of the kind `Interrupted`.
    pub(in crate::cli) fn write(
        &self,
        out: &mut (impl Write + Send),
        ear: &StudyMonitor<'_>,
    ) -> io::Result<()> {
        if self.header {
            out.write_all(csv::header(self.study.columns(), self.units).as_bytes())?;
        }
        if let Some(target) = self.checkpointed() {
            let mut kept = self.kept(target, ear)?;
            // A row is dropped when it is written; the file of the checkpoint keeps it.
            for batch in self.range.clone().filter_map(|row| kept.rows.remove(&row)) {
                out.write_all(&csv::lines(&batch))?;
            }
            return out.flush();
        }
        let (mut done, mut result) = (0, Ok(()));
        let lines = |batch: RowBatch| csv::lines(&batch);
        let _ = self.study.run(self.range.clone(), &ear.listening.flag(), lines, |lines, count| {
            result = out.write_all(&lines);
            done += count;
            self.tell(done, ear);
            result.is_ok()
        });
        result?;
        if done < self.range.len() { Err(io::ErrorKind::Interrupted.into()) } else { out.flush() }
    }

    /// Removes the checkpoint of the file, which is complete.
    pub(in crate::cli) fn forget(&self) {
        if let Some(target) = self.checkpointed() {
            // If it remains, the next run finds its own study in it, and has nothing left to compute.
            let _ = fs::remove_file(beside(target));
        }
    }

    /// The file, if its rows are slow.
    fn checkpointed(&self) -> Option<&Path> {
        self.target.filter(|_| self.study.is_slow())
    }

    /// All rows: those stored beside `target`, and the missing ones, which are computed and stored.
    fn kept(&self, target: &Path, ear: &StudyMonitor<'_>) -> io::Result<Checkpoint> {
        let mut kept = Checkpoint::open(&beside(target), self.study)?;
        let missing: Vec<usize> = self.range.clone().filter(|row| !kept.rows.contains_key(row)).collect();
        let (mut done, mut result) = (self.range.len() - missing.len(), Ok(()));
        self.tell(done, ear);
        let is_done = self.study.each(missing.into_iter(), &ear.listening.flag(), |batch| {
            result = kept.keep(batch);
            done += 1;
            self.tell(done, ear);
            result.is_ok()
        });
        result?;
        if is_done { Ok(kept) } else { Err(io::ErrorKind::Interrupted.into()) }
    }

    fn tell(&self, done: usize, ear: &StudyMonitor<'_>) {
        let total = self.range.len();
        #[expect(clippy::cast_precision_loss, reason = "at most 1e9 rows")]
        ear.progress.tell_part(done as f64 / total.max(1) as f64, &format!("{done} of {total} designs"));
    }
}
