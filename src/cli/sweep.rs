//! `stargrip-cam sweep`

use std::fs::File;
use std::io::{BufWriter, IsTerminal, Write};
use std::path::PathBuf;

use crate::cli::failure::Failure;
use crate::cli::load::Loaded;
use crate::cli::quantity::part;
use crate::forecast::study::{Study, csv};
use crate::spec::study::Lane;

/// Arguments of `sweep`.
#[derive(clap::Args, Debug)]
#[command(
    after_help = "Example: stargrip-cam sweep spec.toml --vary star.points=3,4,5 --vary \"star.tube_width=10 mm..40 mm/31\""
)]
pub(super) struct Args {
    /// The spec around which values are varied.
    spec: PathBuf,
    /// What is varied: KEY=A,B,C or KEY=FROM..TO/COUNT; may be given several times, the last runs fastest.
    #[arg(long, value_name = "KEY=VALUES", required = true)]
    vary: Vec<String>,
    /// Compute only part k of N; only part 1 has the header, so that the parts can be joined.
    #[arg(long, value_name = "k/N", value_parser = part)]
    part: Option<(usize, usize)>,
    /// Where to write the CSV; default: standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Threads; default: all.
    #[arg(long)]
    threads: Option<usize>,
}

/// Computes the rows and writes them in order.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let loaded = Loaded::new(&args.spec)?;
    let lanes = args.vary.iter().map(|text| Lane::parse(text)).collect::<Result<Vec<_>, _>>();
    let sweep = Study::vary(&loaded.source, lanes.map_err(Failure::Message)?)?.map_err(Failure::Message)?;
    if let Some(threads) = args.threads {
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build_global()
            .map_err(|error| Failure::Message(format!("cannot start {threads} threads: {error}")))?;
    }
    let (k, n) = args.part.unwrap_or((1, 1));
    let rows = sweep.part(k, n);
    match &args.output {
        None => write_rows(&sweep, rows, k == 1, std::io::stdout()),
        Some(path) => {
            let file = File::create(path).map_err(|error| Failure::file("create", path, &error))?;
            write_rows(&sweep, rows, k == 1, BufWriter::new(file))
        }
    }
}

fn write_rows(
    sweep: &Study,
    rows: std::ops::Range<usize>,
    header: bool,
    mut out: impl Write + Send,
) -> Result<(), Failure> {
    let total = rows.len();
    let show = std::io::stderr().is_terminal();
    let mut result = if header { out.write_all(csv::header(sweep.columns(), false).as_bytes()) } else { Ok(()) };
    let mut done = 0;
    let never = std::sync::atomic::AtomicBool::new(false);
    let _ = sweep.run(rows, &never, |batch| csv::lines(&batch), |text, count| {
        if result.is_ok() {
            result = out.write_all(&text);
        }
        done += count;
        if show {
            let _ =
                write!(std::io::stderr(), "\r{:3} %  {done} of {total} designs", 100 * done / total.max(1));
        }
        result.is_ok()
    });
    if show {
        let _ = writeln!(std::io::stderr());
    }
    result.and_then(|()| out.flush()).map_err(|error| match error.kind() {
        std::io::ErrorKind::BrokenPipe => Failure::Pipe,
        _ => Failure::Message(format!("cannot write the rows: {error}")),
    })
}
