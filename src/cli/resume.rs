//! `stargrip-cam resume`

use std::path::{Path, PathBuf};

use serde_json::json;

use crate::answer::hours;
use crate::cli::align::aligned;
use crate::cli::escape::escaped_line;
use crate::cli::failure::Failure;
use crate::cli::load::MACHINE;
use crate::cli::package_file::PackageFile;
use crate::cli::source_file::read_source;
use crate::cli::text_file::{PROGRAM, read_text, write_new};
use crate::cli::verbosity::Verbosity;
use crate::cli::whole_file::directory_of;
use crate::manifest::{MANIFEST, Manifest, sha256};
use crate::pipeline::{PACKAGE_ENDING, read_mark};
use crate::resume::{ResumeAt, ResumeFault, Resumed, clamp_in_the_way, resume};
use design::RefusalCode;
use geom::Point;
use spec::units::{Duration, Length, Percent, Quantity};
use spec::{Fault, Faults};

/// The options of `resume` that need the directory of the job.
pub(super) const MARKS: [&str; 2] = ["mark1", "mark2"];

/// Arguments of `resume`.
#[derive(clap::Args, Debug)]
#[command(group(clap::ArgGroup::new("place").required(true)))]
pub(super) struct Args {
    /// The sealing program that was interrupted.
    job: PathBuf,
    /// The line that was running, counted from 1.
    #[arg(long, group = "place", allow_hyphen_values = true)]
    line: Option<usize>,
    /// The elapsed part of the whole job's time, as the program shows it (M73, `; progress:`): 37%. Or the time since
    /// this program began, without heating and pauses: "1 h 20 min".
    #[arg(long, group = "place", value_name = "TIME", value_parser = elapsed, allow_hyphen_values = true)]
    at: Option<ResumeAt>,
    /// A point near which the iron stopped, from the sheet's lower left corner: "120.5 mm,80 mm".
    #[arg(long, group = "place", value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    near: Option<Point>,
    /// Length to seal again before the stop, such as "5 mm"; default: the overlap of the closures.
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, value_parser = length)]
    overlap: Option<f64>,
    /// Where the first mark of the sheet lies now, if it was moved, as the machine shows it in mm: "12.3, 8.1".
    #[arg(long, value_name = "X,Y", value_parser = read_mark, allow_hyphen_values = true, requires = "mark2")]
    mark1: Option<Point>,
    /// Where the second mark lies now.
    #[arg(long, value_name = "X,Y", value_parser = read_mark, allow_hyphen_values = true, requires = "mark1")]
    mark2: Option<Point>,
    /// The program to write; default: the job's name with -resume, beside a published directory, never in it. An
    /// existing file is never overwritten.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    verbosity: Verbosity,
}

impl Args {
    /// The place where the job stopped.
    fn place(&self) -> Result<ResumeAt, Failure> {
        let place = self.line.map(ResumeAt::Line).or(self.at).or(self.near.map(ResumeAt::Near));
        place.ok_or_else(|| Failure::message("give the place where it stopped: --line, --at or --near"))
    }

    /// The program for the rest of the job with the text `job`.
    pub(super) fn rest_of(&self, job: &str) -> Result<Resumed, Failure> {
        if self.mark1.is_some() || self.mark2.is_some() {
            return Err(Failure::message(
                "marks need the directory of the build: align it, and resume the program that is written then",
            ));
        }
        resume(job, self.place()?, self.overlap).map_err(Failure::message)
    }
}

/// A percentage of the job, or a sum of durations such as "1 h 20 min".
fn elapsed(text: &str) -> Result<ResumeAt, String> {
    let share = Percent::parse(text).ok().map(Percent::ratio).filter(|share| (0.0..=1.0).contains(share));
    let place = share
        .map(ResumeAt::Share)
        .or_else(|| seconds(text).filter(|time| (0.0..1e9).contains(time)).map(ResumeAt::Time));
    place.ok_or_else(|| {
        "a percentage from 0 to 100, such as 37%, or a time, such as \"1 h 20 min\"".to_owned()
    })
}

/// The sum of the durations in `text`, s: each begins with a digit behind the unit of the one before.
fn seconds(text: &str) -> Option<f64> {
    let mut sum = 0.0;
    let mut rest = text.trim();
    while !rest.is_empty() {
        let unit = rest.find(char::is_alphabetic)?;
        let next = rest[unit..].find(|c: char| c.is_ascii_digit()).map_or(rest.len(), |digit| unit + digit);
        sum += Duration::parse(rest[..next].trim()).ok()?.0;
        rest = &rest[next..];
    }
    (!text.trim().is_empty()).then_some(sum)
}

fn point(text: &str) -> Result<Point, String> {
    let (x, y) = text.split_once(',').unwrap_or((text, ""));
    let numbers = [x, y]
        .map(|text| Length::parse(text).ok().map(|length| length.0).filter(|number| number.abs() < 1e6));
    match numbers {
        [Some(x), Some(y)] => Ok(Point::new(x, y)),
        _ => Err("two lengths with their units, such as \"120.5 mm,80 mm\"".to_owned()),
    }
}

fn length(text: &str) -> Result<f64, String> {
    match Length::parse(text) {
        // Without an overlap the seam leaks where it was interrupted.
        Ok(length) if length.0 > 0.0 && length.0 <= 1000.0 => Ok(length.0),
        _ => Err("a length above 0, up to 1 m, with its unit, such as \"5 mm\"".to_owned()),
    }
}

/// Writes the program for the rest of the job.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    if args.job.to_string_lossy().ends_with(PACKAGE_ENDING) {
        let text = "is a package: name the program beside it, without .3mf; the rest is packed, too";
        return Err(Failure::Message(format!("{} {text}", escaped_line(&args.job))));
    }
    let text = read_text(&args.job, PROGRAM)?;
    let resumed = resume(&text, args.place()?, args.overlap).map_err(|fault| {
        let seal_file = seal_file_beside(&args.job).filter(|_| fault == ResumeFault::Trace);
        let hint = seal_file.map_or_else(String::new, |path| format!(", {}", escaped_line(path)));
        Failure::Message(format!("{}: {fault}{hint}", escaped_line(&args.job)))
    })?;
    let resumed = on_moved_sheet(args, resumed)?;
    let manifest = args.job.with_file_name(MANIFEST);
    // Reading a pipe or a device of this name would block, and it cannot be a manifest.
    let has_manifest = manifest.is_file();
    if has_manifest {
        check_unchanged(&args.job, &manifest, &text)?;
        check_clear_of_clamps(&args.job, &resumed.text)?;
    }
    let target = args.output.clone().unwrap_or_else(|| default_target(&args.job, has_manifest));
    refuse_published(&target)?;
    let package = resumed.package.as_ref().map(|bytes| PackageFile::new(&target, bytes));
    if let Some(PackageFile { path, .. }) =
        package.as_ref().filter(|package| package.path.symlink_metadata().is_ok())
    {
        return Err(Failure::Message(format!("{} exists already; choose another name", escaped_line(path))));
    }
    write_new(&target, &resumed.text)?;
    package.as_ref().map_or(Ok(()), PackageFile::write)?;
    let packed = package.as_ref().map_or_else(String::new, PackageFile::in_words);
    let text = format!(
        "wrote {}{packed}\ncontinues at line {} of the old program, after {:.1} % of the job's time; seals the last {:.1} mm again\n\
         about {} left\n{}\n\
         before you start it: same sheet, same zero, the tool above the fabric\n",
        escaped_line(&target),
        resumed.line,
        100.0 * resumed.done,
        resumed.overlap,
        hours(resumed.seconds),
        if has_manifest {
            "the job is unchanged: its hash is the one in manifest.json"
        } else {
            "no manifest.json beside the job: whether the job was changed after the build, and whether a clamp is in the way, \
             is unknown"
        }
    );
    let json = json!({
        "wrote": target.to_string_lossy(),
        "package": package.map(|package| package.path.to_string_lossy().into_owned()),
        "line": resumed.line,
        "done": resumed.done,
        "overlap_mm": resumed.overlap,
        "remaining_s": resumed.seconds,
        "named_in_manifest": has_manifest,
    });
    args.verbosity.report(&text, &json)
}

/// The rest of the job on a sheet that was moved, if its marks are given: the program of the aligned build, resumed at the time at which
/// `resumed` begins.
fn on_moved_sheet(args: &Args, resumed: Resumed) -> Result<Resumed, Failure> {
    let Some((mark1, mark2)) = args.mark1.zip(args.mark2) else { return Ok(resumed) };
    let dir = directory_of(&args.job);
    let name = args.job.file_name().unwrap_or_default().to_string_lossy();
    let read: Option<Manifest> =
        serde_json::from_str(&read_text(&args.job.with_file_name(MANIFEST), PROGRAM)?).ok();
    let sheet = read.and_then(|read| read.files.iter().find(|file| file.path == name)?.sheet);
    let proven = aligned(dir, sheet, [mark1, mark2], args.verbosity)?;
    let file = proven.built().artifacts.iter().find(|file| file.name == name);
    let text = file.and_then(|file| std::str::from_utf8(&file.bytes).ok());
    let text = text.ok_or_else(|| {
        Failure::Message(format!("{} is no program of the build in its directory", escaped_line(&args.job)))
    })?;
    let moved = resume(text, ResumeAt::Share(resumed.done), args.overlap);
    let moved = moved.map_err(|fault| Failure::Message(format!("{}: {fault}", escaped_line(&args.job))))?;
    Ok(Resumed { line: resumed.line, ..moved })
}

/// The sealing program beside the trace program `trace`, if there is one.
fn seal_file_beside(trace: &Path) -> Option<PathBuf> {
    let name = trace.file_name()?.to_string_lossy().replace("-trace.", "-seal.");
    Some(trace.with_file_name(name)).filter(|path| path != trace && path.is_file())
}

/// The default path of the program: beside the job, or for a job in a published directory, beside the directory.
fn default_target(job: &Path, published: bool) -> PathBuf {
    let stem = job.file_stem().unwrap_or_default().to_string_lossy();
    // Host software lists files by their ending, so the ending is kept.
    let ending = job.extension().map_or("gcode".into(), |ending| ending.to_string_lossy());
    let sibling = job.with_file_name(format!("{stem}-resume.{ending}"));
    if !published {
        return sibling;
    }
    // `job.gcode` and `./job.gcode` have a parent without a name.
    let directory = directory_of(job).canonicalize().ok();
    let Some(name) = directory.as_deref().and_then(Path::file_name) else { return sibling };
    let name = format!("{}-{stem}-resume.{ending}", name.to_string_lossy());
    match job.parent().filter(|parent| parent.file_name().is_some()) {
        Some(parent) => parent.with_file_name(name),
        None => job.with_file_name("..").join(name),
    }
}

/// Refuses a new file in a published directory: the next `build` and `verify` would find it foreign.
fn refuse_published(target: &Path) -> Result<(), Failure> {
    let is_inside = target.with_file_name(MANIFEST).is_file() && target.symlink_metadata().is_err();
    if !is_inside {
        return Ok(());
    }
    let text = "is in a published directory, in which `build` and `verify` take no other files; name a file beside it";
    Err(Failure::Message(format!("{} {text}", escaped_line(target))))
}

/// Checks that the job equals, byte by byte, the file that the manifest beside it names.
fn check_unchanged(job: &Path, manifest: &Path, text: &str) -> Result<(), Failure> {
    let read: Manifest = serde_json::from_str(&read_text(manifest, PROGRAM)?)
        .map_err(|fault| Failure::Message(format!("{} cannot be read: {fault}", escaped_line(manifest))))?;
    let name = job.file_name().unwrap_or_default().to_string_lossy();
    let entry = read.files.iter().find(|file| file.path == name);
    let fault = match entry {
        Some(entry) if entry.sha256 == sha256(text.as_bytes()) => return Ok(()),
        Some(_) => "was changed after it was built: its hash is not the one in manifest.json",
        None => "is not named in the manifest.json beside it",
    };
    let remedy = "build again, or resume a copy elsewhere if you made the change yourself";
    Err(Failure::Message(format!("{} {fault}; {remedy}", escaped_line(job))))
}

/// Checks that `program`, the rest of `job`, meets no clamp of the profile beside the job: it goes to places between which the
/// job itself does not travel.
fn check_clear_of_clamps(job: &Path, program: &str) -> Result<(), Failure> {
    let profile = read_source(&job.with_file_name(MACHINE))?;
    let clamps = spec::read_machine(&profile)?.bench.keep_out;
    let wrong = |fault: ResumeFault| Failure::Message(format!("{}: {fault}", escaped_line(job)));
    let Some(crossing) = clamp_in_the_way(program, &clamps).map_err(wrong)? else { return Ok(()) };
    let line = crossing.line.unwrap_or_default();
    let fault = Fault::error(
        RefusalCode::ClampInTheWay,
        usize::MAX..usize::MAX,
        format!("line {line} of the program for the rest would be {}", crossing.found),
    )
    .label(format!("must be {}", crossing.allowed))
    .help("move the clamp, and resume a copy of the job elsewhere: no profile is compared with it there");
    Err(Faults::new(&profile, vec![fault]).into())
}
