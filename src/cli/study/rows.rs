//! Rows of a study as CSV, to standard output or to a file.

use std::io::{self, IsTerminal, Write, stdout};
use std::path::{Path, PathBuf};

use crate::cli::escape::escaped_line;
use crate::cli::failure::Failure;
use crate::cli::interrupt::Listening;
use crate::cli::progress::{self, Progress};
use crate::cli::text_file::refuse_foreign;
use crate::cli::verbosity::{Quiet, Verbosity};
use crate::cli::whole_file::{WholeFile, sweep_own};
use forecast::study::{RowBatch, Study, csv};

/// The form and the destination of the rows.
#[derive(clap::Args, Debug)]
pub(super) struct Destination {
    /// The file to write; default: standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The form: `csv`. Parquet is written by the Python package.
    #[arg(long, value_name = "FORM", hide = true)]
    format: Option<Form>,
    /// Add a line to the header that begins with # and gives the unit of each column.
    #[arg(long)]
    units: bool,
    /// Threads, at most 256; default: one for each processor.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=256))]
    threads: Option<u16>,
    #[command(flatten)]
    pub(super) quiet: Quiet,
}

/// The form of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Form {
    /// Text: a header, a line a row.
    Csv,
    /// Columns for analysis, which this program no longer writes.
    Parquet,
}

/// Refuses a file whose name ends in `.parquet`.
fn refuse_parquet(path: &Path) -> Result<(), Failure> {
    if path.extension().is_none_or(|ending| ending != "parquet") {
        return Ok(());
    }
    let text = "this program writes studies as CSV, not as Parquet: give the file a name that ends in .csv; or take the Python \
                package: stargrip_cam.sweep_to_parquet(\"study.parquet\", spec, study=\"study.toml\")";
    Err(Failure::Message(text.to_owned()))
}

impl Destination {
    /// Computes the rows of `study`, and writes them in order.
    pub(super) fn run(&self, study: &Study) -> Result<(), Failure> {
        match (self.format, &self.output) {
            (Some(Form::Csv), _) | (None, None) => {}
            (Some(Form::Parquet), _) => refuse_parquet(Path::new("study.parquet"))?,
            (None, Some(output)) => refuse_parquet(output)?,
        }
        if let Some(output) = &self.output {
            // Every table of a study begins with the column `row`.
            refuse_foreign(output, "a table of a study", |text| text.starts_with("row,"))?;
        }
        if let Some(threads) = self.threads {
            rayon::ThreadPoolBuilder::new()
                .num_threads(usize::from(threads))
                .build_global()
                .map_err(|error| Failure::Message(format!("cannot start {threads} threads: {error}")))?;
        }
        // Rows on a terminal show the progress themselves.
        let quiet = self.quiet.quiet || (self.output.is_none() && stdout().is_terminal());
        let listening = Listening::new();
        progress::listening(Verbosity { quiet, ..Verbosity::default() }, "designs", |progress| {
            let rows = StudyRows { study, units: self.units, progress, listening: &listening };
            match &self.output {
                None => rows.to_stdout(),
                Some(path) => rows.to_file(path),
            }
        })
    }
}

/// The rows of a study, the form of their text, the progress line to report to, and the signals that stop the work.
struct StudyRows<'a> {
    study: &'a Study,
    /// Whether a comment under the header gives the units.
    units: bool,
    progress: &'a Progress,
    listening: &'a Listening,
}

impl StudyRows<'_> {
    /// Computes the rows and writes them to `output`. A signal gives an error of the kind `Interrupted`.
    fn write(&self, output: &mut (impl Write + Send)) -> io::Result<()> {
        output.write_all(csv::header(self.study.columns(), self.units).as_bytes())?;
        let total = self.study.rows();
        let (mut rows_done, mut result) = (0, Ok(()));
        let lines = |batch: RowBatch| csv::lines(&batch);
        let _ = self.study.run(0..total, &self.listening.flag(), lines, |lines, count| {
            result = output.write_all(&lines);
            rows_done += count;
            #[expect(clippy::cast_precision_loss, reason = "at most 1e9 rows")]
            self.progress.tell_part(
                rows_done as f64 / total.max(1) as f64,
                &format!("{rows_done} of {total} designs"),
            );
            result.is_ok()
        });
        result?;
        if rows_done < total { Err(io::ErrorKind::Interrupted.into()) } else { output.flush() }
    }

    fn to_stdout(&self) -> Result<(), Failure> {
        // The writer receives large chunks; a line buffer would only slow it down.
        self.write(&mut stdout()).map_err(|error| match error.kind() {
            io::ErrorKind::BrokenPipe => Failure::Pipe,
            io::ErrorKind::Interrupted if self.listening.has_heard() => {
                Failure::Stopped("stopped".to_owned())
            }
            _ => Failure::Message(format!("cannot write the rows: {error}")),
        })
    }

    fn to_file(&self, path: &Path) -> Result<(), Failure> {
        self.publish(path).map_err(|error| match error.kind() {
            io::ErrorKind::Interrupted if self.listening.has_heard() => {
                Failure::Stopped(format!("stopped; {} was not written", escaped_line(path)))
            }
            _ => Failure::file("write", path, &error),
        })
    }

    fn publish(&self, path: &Path) -> io::Result<()> {
        sweep_own(path);
        let mut file = WholeFile::begin(path)?;
        self.write(&mut file)?;
        file.publish()
    }
}
