//! Rows of a study to standard output, a file, or parts in a directory: the destinations of `study run`.

use std::io::{self, IsTerminal, stdout};
use std::path::{Path, PathBuf};

use crate::cli::escape::shown;
use crate::cli::failure::{Failure, tell};
use crate::cli::interrupt::Listening;
use crate::cli::progress;
use crate::cli::study::part::Parts;
use crate::cli::study::rows::{StudyMonitor, StudyRows};
use crate::cli::text_file::refuse_foreign;
use crate::cli::verbosity::{Quiet, Verbosity};
use crate::cli::whole_file::{WholeFile, sweep_own};
use forecast::study::Study;

/// The rows to compute, and their destination.
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct Destination {
    /// Compute only part k of N, or parts A..B of N. On standard output only part 1 has the header, so that parts can be
    /// joined by `cat`; as files, all have.
    #[arg(long, value_name = "k/N", value_parser = span)]
    pub(in crate::cli) part: Option<Span>,
    /// Compute all of N parts, one after the other, into a directory; existing parts are skipped.
    #[arg(long, value_name = "N", conflicts_with = "part", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    parts: Option<u32>,
    /// Where to write; default: standard output. With --parts, or with --part and a name without an ending, a directory of parts.
    #[arg(short, long, value_name = "FILE|DIR")]
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
    pub(in crate::cli) quiet: Quiet,
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
pub(super) fn refuse_parquet(path: &Path) -> Result<(), Failure> {
    if path.extension().is_none_or(|ending| ending != "parquet") {
        return Ok(());
    }
    let text = "this program writes studies as CSV, not as Parquet: give the file a name that ends in .csv; or take the Python \
                package: stargrip_cam.sweep_to_parquet(\"study.parquet\", spec, study=\"study.toml\")";
    Err(Failure::Message(text.to_owned()))
}

/// Refuses to replace a file that is not a table of a study: every table begins with the column `row`.
pub(super) fn refuse_no_table(path: &Path) -> Result<(), Failure> {
    refuse_foreign(path, "a table of a study", |text| text.starts_with("row,"))
}

/// Parts `from` to `to` of `of`, from 1.
#[derive(Clone, Copy, Debug)]
pub(in crate::cli) struct Span {
    pub(in crate::cli) from: usize,
    pub(in crate::cli) to: usize,
    pub(in crate::cli) of: usize,
}

/// Reads "k/N" or "A..B/N".
fn span(text: &str) -> Result<Span, String> {
    let fault = || format!("`{text}` is not k/N with k from 1 to N, nor A..B/N");
    let (which, of) = text.split_once('/').ok_or_else(fault)?;
    let (from, to) = which.split_once("..").unwrap_or((which, which));
    let number = |text: &str| text.parse::<usize>().map_err(|_| fault());
    let span = Span { from: number(from)?, to: number(to)?, of: number(of)? };
    let Span { from, to, of } = span;
    if 1 <= from && from <= to && to <= of && of <= 1_000_000 { Ok(span) } else { Err(fault()) }
}

impl Destination {
    /// Computes the rows of `study`, and writes them in order.
    pub(in crate::cli) fn run(&self, study: &Study) -> Result<(), Failure> {
        match (self.format, &self.output) {
            (Some(Form::Csv), _) | (None, None) => {}
            (Some(Form::Parquet), _) => refuse_parquet(Path::new("study.parquet"))?,
            (None, Some(output)) => refuse_parquet(output)?,
        }
        if let Some(output) = &self.output {
            refuse_no_table(output)?;
        }
        if let Some(threads) = self.threads {
            rayon::ThreadPoolBuilder::new()
                .num_threads(usize::from(threads))
                .build_global()
                .map_err(|error| Failure::Message(format!("cannot start {threads} threads: {error}")))?;
        }
        let whole = self.parts.map_or(1, |parts| usize::try_from(parts).unwrap_or(1));
        let span = self.part.unwrap_or(Span { from: 1, to: whole, of: whole });
        if self.output.is_none() && self.parts.is_some() {
            return Err(Failure::Usage("--parts needs a directory: add -o DIR".to_owned()));
        }
        // Rows on a terminal show the progress themselves.
        let quiet = self.quiet.quiet || (self.output.is_none() && stdout().is_terminal());
        let listening = Listening::new();
        let there =
            progress::listening(Verbosity { quiet, ..Verbosity::default() }, "designs", |progress| {
                let ear = StudyMonitor { progress, listening: &listening };
                let range = study.part(span.from, span.of).start..study.part(span.to, span.of).end;
                let rows = StudyRows { study, range, header: true, units: self.units, target: None };
                match &self.output {
                    None => to_stdout(&StudyRows { header: span.from == 1, ..rows }, &ear).map(|()| 0),
                    Some(dir) if self.is_directory(dir) => {
                        let parts = Parts { dir, study, of: span.of, units: self.units };
                        parts.compute([span.from, span.to], &ear)
                    }
                    Some(path) => to_file(path, rows, &ear).map(|()| 0),
                }
            })?;
        if there > 0 && !self.quiet.quiet {
            tell(&format!("{there} of {} parts existed already", span.to - span.from + 1));
        }
        Ok(())
    }

    /// Whether `path` is a directory of parts.
    fn is_directory(&self, path: &Path) -> bool {
        let ends_so = path.as_os_str().to_string_lossy().ends_with(std::path::is_separator);
        self.parts.is_some()
            || path.is_dir()
            || ends_so
            || (self.part.is_some() && path.extension().is_none())
    }
}

fn to_stdout(rows: &StudyRows<'_>, ear: &StudyMonitor<'_>) -> Result<(), Failure> {
    // The writer receives large chunks; a line buffer would only slow it down.
    rows.write(&mut stdout(), ear).map_err(|error| match error.kind() {
        io::ErrorKind::BrokenPipe => Failure::Pipe,
        io::ErrorKind::Interrupted if ear.listening.has_heard() => Failure::Stopped("stopped".to_owned()),
        _ => Failure::Message(format!("cannot write the rows: {error}")),
    })
}

fn to_file(path: &Path, rows: StudyRows<'_>, ear: &StudyMonitor<'_>) -> Result<(), Failure> {
    let is_slow = rows.study.is_slow();
    let written = || -> io::Result<()> {
        sweep_own(path);
        let rows = StudyRows { target: Some(path), ..rows };
        let mut file = WholeFile::begin(path)?;
        rows.write(&mut file, ear)?;
        file.publish()?;
        rows.forget();
        Ok(())
    };
    written().map_err(|error| match error.kind() {
        io::ErrorKind::Interrupted if ear.listening.has_heard() => {
            let kept = if is_slow { "; the same command continues where it stopped" } else { "" };
            Failure::Stopped(format!("stopped; {} was not written{kept}", shown(path)))
        }
        _ => Failure::file("write", path, &error),
    })
}
