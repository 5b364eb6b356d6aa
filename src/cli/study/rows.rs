//! Rows of a study as bytes of a form: CSV, or Parquet where it was built in.

use std::io;
use std::io::{IsTerminal, Write};
use std::ops::Range;
use std::path::Path;

use crate::cli::failure::Failure;
use crate::cli::study::signals::Stop;
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
}

impl Rows<'_> {
    /// Computes the rows and writes them to `out`, which is handed back. Says on a terminal how far it is. An error of the kind
    /// `Interrupted` is a signal's.
    pub(in crate::cli) fn write<W: Write + Send>(&self, out: W, stop: &Stop) -> io::Result<W> {
        match self.form {
            Form::Csv => self.csv(out, stop),
            #[cfg(feature = "parquet")]
            Form::Parquet => {
                use crate::forecast::study::parquet::Writer;
                let mut writer = Writer::new(out, self.study.columns(), &self.study.fingerprint())?;
                self.run(stop, |batch| batch, |batch| writer.write(batch))?;
                writer.finish()
            }
            #[cfg(not(feature = "parquet"))]
            Form::Parquet => Err(io::ErrorKind::Unsupported.into()),
        }
    }

    fn csv<W: Write + Send>(&self, mut out: W, stop: &Stop) -> io::Result<W> {
        if self.header {
            out.write_all(csv::header(self.study.columns(), self.units).as_bytes())?;
        }
        self.run(stop, |batch| csv::lines(&batch), |text| out.write_all(&text))?;
        out.flush()?;
        Ok(out)
    }

    fn run<T: Send>(
        &self,
        stop: &Stop,
        make: impl Fn(Batch) -> T + Sync,
        mut take: impl FnMut(T) -> io::Result<()> + Send,
    ) -> io::Result<()> {
        let (total, mut done, mut result) = (self.range.len(), 0, Ok(()));
        let show = io::stderr().is_terminal();
        let _ = self.study.run(self.range.clone(), stop.flag(), make, |made, count| {
            result = take(made);
            done += count;
            if show {
                let part = 100 * done / total.max(1);
                let _ = write!(io::stderr(), "\r{part:3} %  {done} of {total} designs");
            }
            result.is_ok()
        });
        if show {
            let _ = writeln!(io::stderr());
        }
        result?;
        if done < total { Err(io::ErrorKind::Interrupted.into()) } else { Ok(()) }
    }
}
