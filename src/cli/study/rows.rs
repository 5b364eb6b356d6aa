//! Rows of a study as CSV, computed, and kept where each takes long.

use std::io;
use std::io::Write;
use std::ops::Range;
use std::path::Path;

use crate::cli::interrupt::Listening;
use crate::cli::progress::Progress;
use crate::cli::study::checkpoint::{Checkpoint, beside, drop_beside};
use crate::forecast::study::{RowBatch, Study, csv};

/// Some rows of a study, as they are to be written.
pub(in crate::cli) struct StudyRows<'a> {
    pub(in crate::cli) study: &'a Study,
    /// Which.
    pub(in crate::cli) range: Range<usize>,
    /// Whether the text begins with the names of the columns.
    pub(in crate::cli) header: bool,
    /// Whether a comment under the header says the units.
    pub(in crate::cli) units: bool,
    /// The file that they are for; where one takes long, each is kept beside it until it is whole.
    pub(in crate::cli) target: Option<&'a Path>,
}

/// Who is told how far it is, and says when it shall stop.
pub(in crate::cli) struct StudyMonitor<'a> {
    pub(in crate::cli) progress: &'a Progress,
    pub(in crate::cli) listening: &'a Listening,
}

impl StudyRows<'_> {
    /// Computes the rows and writes them to `out`, which is handed back. An error of the kind `Interrupted` is a signal's.
    pub(in crate::cli) fn write<W: Write + Send>(&self, mut out: W, ear: &StudyMonitor<'_>) -> io::Result<W> {
        if self.header {
            out.write_all(csv::header(self.study.columns(), self.units).as_bytes())?;
        }
        self.run(ear, |batch| csv::lines(&batch), |text| out.write_all(&text))?;
        out.flush()?;
        Ok(out)
    }

    /// Drops what was kept for the file, which is whole.
    pub(in crate::cli) fn forget(&self) {
        if let Some(target) = self.target.filter(|_| self.study.is_slow()) {
            drop_beside(target);
        }
    }

    fn run<T: Send>(
        &self,
        ear: &StudyMonitor<'_>,
        make: impl Fn(RowBatch) -> T + Sync,
        mut take: impl FnMut(T) -> io::Result<()> + Send,
    ) -> io::Result<()> {
        if let Some(target) = self.target.filter(|_| self.study.is_slow()) {
            let mut kept = self.kept(target, ear)?;
            let rows = self.range.clone().filter_map(|row| kept.take(row));
            return rows.map(make).try_for_each(take);
        }
        let (mut done, mut result) = (0, Ok(()));
        let _ = self.study.run(self.range.clone(), &ear.listening.flag(), make, |made, count| {
            result = take(made);
            done += count;
            self.tell(done, ear);
            result.is_ok()
        });
        result?;
        if done < self.range.len() { Err(io::ErrorKind::Interrupted.into()) } else { Ok(()) }
    }

    /// All rows, those that were kept beside `target` and those that are computed now, and kept.
    fn kept(&self, target: &Path, ear: &StudyMonitor<'_>) -> io::Result<Checkpoint> {
        let mut kept = Checkpoint::open(&beside(target), self.study)?;
        let missing: Vec<usize> = self.range.clone().filter(|row| !kept.has(*row)).collect();
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
