//! `stargrip-cam sweep`

use std::io;
use std::io::{BufWriter, stdout};
use std::path::{Path, PathBuf};

use crate::cli::failure::{Failure, tell};
use crate::cli::study::{Form, Parts, Rows, Stop, loaded, varied};
use crate::cli::whole_file::{WholeFile, sweep_leftovers};
use crate::forecast::study::Study;

/// Arguments of `sweep`.
#[derive(clap::Args, Debug)]
#[command(
    after_help = "Examples: stargrip-cam sweep spec.toml --vary star.points=3,4,5 --vary \"star.tube_width=10 mm..40 mm/31\"\n\
                        stargrip-cam sweep study.toml -o study.csv\n\
                        stargrip-cam sweep study.toml --part 3/16 -o parts; stargrip-cam study join parts -o study.csv"
)]
pub(super) struct Args {
    /// A study file; or, with --vary, the spec around which values are varied.
    #[arg(value_name = "STUDY")]
    spec: PathBuf,
    /// What is varied: KEY=A,B,C or KEY=FROM..TO/COUNT; may be given several times, the last runs fastest.
    #[arg(long, value_name = "KEY=VALUES")]
    vary: Vec<String>,
    /// Compute only part k of N, or parts A..B of N. On standard output only part 1 has the header, so that parts can be joined
    /// by `cat`; as files, all have.
    #[arg(long, value_name = "k/N", value_parser = span)]
    part: Option<Span>,
    /// Compute all of N parts, one after the other, into a directory; those that are there already are left out.
    #[arg(long, value_name = "N", conflicts_with = "part", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    parts: Option<u32>,
    /// Where to write; default: standard output. With --parts, or with --part and a name without an ending, a directory of parts.
    #[arg(short, long, value_name = "FILE|DIR")]
    output: Option<PathBuf>,
    /// The form; default: what the name of the file says, else CSV.
    #[arg(long, value_name = "FORM")]
    format: Option<Form>,
    /// Add a line to the header that begins with # and says the unit of each column.
    #[arg(long)]
    units: bool,
    /// Threads; default: all.
    #[arg(long)]
    threads: Option<usize>,
}

/// Parts `from` to `to` of `of`.
#[derive(Clone, Copy, Debug)]
struct Span {
    from: usize,
    to: usize,
    of: usize,
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

/// Computes the rows and writes them in order.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let study = if args.vary.is_empty() { loaded(&args.spec)? } else { varied(&args.spec, &args.vary)? };
    if let Some(threads) = args.threads {
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build_global()
            .map_err(|error| Failure::Message(format!("cannot start {threads} threads: {error}")))?;
    }
    let stop = Stop::new();
    let whole = args.parts.map_or(1, |parts| usize::try_from(parts).unwrap_or(1));
    let span = args.part.unwrap_or(Span { from: 1, to: whole, of: whole });
    match &args.output {
        None if args.parts.is_some() => {
            Err(Failure::Usage("--parts needs a directory: add -o DIR".to_owned()))
        }
        None => to_stdout(args, &study, span, &stop),
        Some(path) if is_directory(args, path) => to_parts(args, path, (&study, span), &stop),
        Some(path) => to_file(args, path, (&study, span), &stop),
    }
}

/// Whether `path` is one of parts.
fn is_directory(args: &Args, path: &Path) -> bool {
    let ends_so = path.as_os_str().to_string_lossy().ends_with(std::path::is_separator);
    args.parts.is_some() || path.is_dir() || ends_so || (args.part.is_some() && path.extension().is_none())
}

fn rows<'a>(args: &Args, study: &'a Study, span: Span, form: Form) -> Rows<'a> {
    let range = study.part(span.from, span.of).start..study.part(span.to, span.of).end;
    Rows { study, range, form, header: true, units: args.units }
}

fn to_stdout(args: &Args, study: &Study, span: Span, stop: &Stop) -> Result<(), Failure> {
    let form = args.format.unwrap_or(Form::Csv).built_in()?;
    let rows = Rows { header: span.from == 1, ..rows(args, study, span, form) };
    let written = match form {
        // Whole chunks are written at a time; a buffer of lines would only slow them down.
        Form::Csv => rows.write(stdout(), stop).map(drop),
        Form::Parquet => {
            rows.write(BufWriter::new(stdout()), stop).and_then(|mut out| io::Write::flush(&mut out))
        }
    };
    written.map_err(|error| match error.kind() {
        io::ErrorKind::BrokenPipe => Failure::Pipe,
        io::ErrorKind::Interrupted if stop.is_raised() => Failure::Stopped("stopped".to_owned()),
        _ => Failure::Message(format!("cannot write the rows: {error}")),
    })
}

fn to_parts(args: &Args, dir: &Path, (study, span): (&Study, Span), stop: &Stop) -> Result<(), Failure> {
    let form = args.format.unwrap_or(Form::Csv).built_in()?;
    let parts = Parts { dir, study, of: span.of, form, units: args.units };
    let there = parts.compute([span.from, span.to], stop)?;
    if there > 0 {
        tell(&format!("{there} of {} parts were there already", span.to - span.from + 1));
    }
    Ok(())
}

fn to_file(args: &Args, path: &Path, (study, span): (&Study, Span), stop: &Stop) -> Result<(), Failure> {
    let rows = rows(args, study, span, args.format.unwrap_or(Form::of(path)).built_in()?);
    let own = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let dir = path.parent().filter(|dir| !dir.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let written = || -> io::Result<()> {
        // A pipe or a device is written to as it is: it must not be replaced by a file.
        if path.exists() && !path.is_file() {
            let file = std::fs::File::options().write(true).open(path)?;
            return rows.write(BufWriter::new(file), stop).and_then(|mut out| io::Write::flush(&mut out));
        }
        sweep_leftovers(dir, |name| name == own);
        let out = rows.write(BufWriter::new(WholeFile::begin(path)?), stop)?;
        out.into_inner().map_err(io::IntoInnerError::into_error)?.publish()
    };
    written().map_err(|error| match error.kind() {
        io::ErrorKind::Interrupted if stop.is_raised() => {
            Failure::Stopped(format!("stopped; {} was not written", crate::cli::harmless::shown(path)))
        }
        _ => Failure::file("write", path, &error),
    })
}
