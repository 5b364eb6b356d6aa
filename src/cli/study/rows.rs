//! Rows of a study as bytes of a form: CSV, or Parquet where it was built in.

use std::io;
use std::io::Write;
use std::ops::Range;
use std::path::Path;

use crate::cli::failure::Failure;
use crate::cli::interrupt::Listening;
use crate::cli::progress::Progress;
use crate::cli::study::kept::{Kept, beside, drop_beside};
use crate::forecast::study::{Batch, Study, csv};

/// The form of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(in crate::cli) enum Form {
    /// Text: a header, a line a row.
    Csv,
    /// Columns, for pandas, polars, `DuckDB`.
    Parquet,
}

impl Form {
    /// How its files end.
    pub(in crate::cli) fn ending(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Parquet => "parquet",
        }
    }

    /// The form that the name of a file says; CSV for every ending but Parquet's.
    pub(in crate::cli) fn of(path: &Path) -> Self {
        let is_parquet = path.extension().is_some_and(|ending| ending == Self::Parquet.ending());
        if is_parquet { Self::Parquet } else { Self::Csv }
    }

    /// Refuses what this program was built without.
    pub(in crate::cli) fn built_in(self) -> Result<Self, Failure> {
        if self == Self::Csv || cfg!(feature = "parquet") {
            return Ok(self);
        }
        let text = "this program was built without Parquet; write CSV, or build it with `--features parquet`";
        Err(Failure::Message(text.to_owned()))
    }
}

/// Some rows of a study, as they are to be written.
pub(in crate::cli) struct Rows<'a> {
    pub(in crate::cli) study: &'a Study,
    /// Which.
    pub(in crate::cli) range: Range<usize>,
    pub(in crate::cli) form: Form,
    /// Of CSV: whether it begins with the names of the columns.
    pub(in crate::cli) header: bool,
    /// Of CSV: whether a comment under the header says the units.
    pub(in crate::cli) units: bool,
    /// The file that they are for; where one takes long, each is kept beside it until it is whole.
    pub(in crate::cli) target: Option<&'a Path>,
}

/// Who is told how far it is, and says when it shall stop.
pub(in crate::cli) struct Ear<'a> {
    pub(in crate::cli) progress: &'a Progress,
    pub(in crate::cli) listening: &'a Listening,
}

impl Rows<'_> {
    /// Computes the rows and writes them to `out`, which is handed back. An error of the kind `Interrupted` is a signal's.
    pub(in crate::cli) fn write<W: Write + Send>(&self, out: W, ear: &Ear<'_>) -> io::Result<W> {
        match self.form {
            Form::Csv => self.csv(out, ear),
            #[cfg(feature = "parquet")]
            Form::Parquet => {
                use crate::forecast::study::parquet::Writer;
                let mut writer = Writer::new(out, self.study.columns(), &self.study.fingerprint())?;
                self.run(ear, |batch| batch, |batch| writer.write(batch))?;
                writer.finish()
            }
            #[cfg(not(feature = "parquet"))]
            Form::Parquet => Err(io::ErrorKind::Unsupported.into()),
        }
    }

    /// Drops what was kept for the file, which is whole.
    pub(in crate::cli) fn forget(&self) {
        if let Some(target) = self.target.filter(|_| self.study.is_slow()) {
            drop_beside(target);
        }
    }

    fn csv<W: Write + Send>(&self, mut out: W, ear: &Ear<'_>) -> io::Result<W> {
        if self.header {
            out.write_all(csv::header(self.study.columns(), self.units).as_bytes())?;
        }
        self.run(ear, |batch| csv::lines(&batch), |text| out.write_all(&text))?;
        out.flush()?;
        Ok(out)
    }

    fn run<T: Send>(
        &self,
        ear: &Ear<'_>,
        make: impl Fn(Batch) -> T + Sync,
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
    fn kept(&self, target: &Path, ear: &Ear<'_>) -> io::Result<Kept> {
        let mut kept = Kept::open(&beside(target), self.study)?;
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

    fn tell(&self, done: usize, ear: &Ear<'_>) {
        let total = self.range.len();
        #[expect(clippy::cast_precision_loss, reason = "at most 1e9 rows")]
        ear.progress.tell_part(done as f64 / total.max(1) as f64, &format!("{done} of {total} designs"));
    }
}
