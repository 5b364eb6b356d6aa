//! The overview of `check` and `build`: the design, whether it meets its load, precautions before sealing, the end of the job, and the next
//! steps.

use std::io::{stderr, stdout};
use std::path::Path;
use std::time::SystemTime;

use jiff::tz::TimeZone;
use jiff::{SignedDuration, Timestamp, Zoned};
use serde_json::{Value, json};

use crate::answer::proof::scope;
use crate::answer::{hours, overview_json, processes_in_words, sealing_in_words, sealing_time, verdict};
use crate::cli::details;
use crate::cli::escape::escaped_line;
use crate::cli::failure::{Failure, say, tell_under};
use crate::cli::terminal::{width, wrapped};
use crate::cli::verbosity::Verbosity;
use crate::cli::words::count_beyond;
use crate::pipeline::{Forecast, Precaution, Proven};
use design::{DrawnPiece, FlatPiece, PressPlan};
use forecast::ranges::shown::rounded;
use proof::artifact::Kind;
use spec::StarSpec;
use spec::units::{Length, count_text};

/// Columns of the labels.
const LABEL: usize = 11;

/// Notes on repairs and choices in a drawing that are shown.
const NOTES: usize = 2;

/// A label and its text; a row without a label is a sentence.
type OverviewRow = (&'static str, String);

/// Prints the answer of `check`, or of `build`, which has published the files in `target`. Returns it as JSON if that is requested.
pub(super) fn answer(
    proven: &Proven,
    notes: &[Precaution],
    target: Option<&Path>,
    verbosity: Verbosity,
) -> Result<Option<Value>, Failure> {
    let forecast = &proven.built().forecast;
    if verbosity.json {
        let mut answer = overview_json(forecast, notes);
        match target {
            Some(target) => answer["written"] = written_json(proven, target),
            None => answer["proven"] = in_memory_json(proven),
        }
        return Ok(Some(answer));
    }
    if verbosity.quiet {
        warn(forecast.doubt().iter().map(|doubt| &doubt.text));
        return Ok(None);
    }
    show(&head(forecast))?;
    warn(notes.iter().map(|note| &note.text));
    // A build without a program has no sealing time.
    if target.is_none() || proven.sealing_time().is_some() || forecast.spec.press.is_some() {
        show(&work(forecast, present_time().as_ref()))?;
    }
    show(&target.map_or_else(|| in_memory(proven), |target| file_rows(proven, target)))?;
    if verbosity.verbose {
        let details = if target.is_some() { details::built(proven) } else { details::checked(forecast) };
        verbosity.remark(&details)?;
    } else {
        show(&[("details", "-v".to_owned())])?;
    }
    Ok(None)
}

/// The design and its prediction.
fn head(forecast: &Forecast) -> Vec<OverviewRow> {
    let mut rows = vec![("", forecast.spec.name.clone())];
    rows.extend(pieces(forecast).into_iter().map(|text| ("", text)));
    if forecast.design.assembly().is_some() {
        rows.push(("", verdict::in_words(forecast)));
        rows.extend(verdict::rows(forecast));
    }
    if let Some(pieces) = forecast.design.drawn_pieces() {
        rows.extend(pieces.notes.iter().take(NOTES).map(|note| ("drawing", note.clone())));
        let rest = count_beyond(pieces.notes.len(), NOTES);
        rows.extend(rest.map(|rest| ("drawing", format!("{rest} more notes by -v"))));
    }
    rows.extend(verdict::of_drawing(forecast));
    rows
}

/// Equal pieces once.
fn pieces(forecast: &Forecast) -> Vec<String> {
    let (placed, piece_count) = (forecast.design.placed(), forecast.design.placed().len());
    let lines = forecast.design.firsts().filter_map(|first| {
        let alike = placed.iter().filter(|placed| placed.distinct == first.distinct);
        let numbers: Vec<String> = alike.map(|placed| placed.index.to_string()).collect();
        let (kind, words) = (
            first.kind,
            match forecast.design.part(first) {
                FlatPiece::Star(_) => in_words(forecast.spec.stars.get(first.index - 1)?),
                FlatPiece::Drawn(piece) => drawn_in_words(piece),
            },
        );
        Some(match numbers.len() {
            _ if piece_count == 1 => format!("1 {kind}: {words}"),
            n if n == piece_count => format!("{piece_count} equal {kind}s: {words}"),
            1 => format!("{kind} {}: {words}", numbers[0]),
            _ => format!("{kind}s {}: {words}", numbers.join(", ")),
        })
    });
    lines.collect()
}

/// A drawn piece: its size, chambers, ports and seams.
fn drawn_in_words(piece: &DrawnPiece) -> String {
    let size = piece.part.outside.bounds();
    let length: f64 = piece.shape.seams.iter().map(|seam| seam.center_line.length()).sum();
    let valves = match piece.shape.valves.len() {
        0 => String::new(),
        number => format!("{}, ", count_text(number, "valve")),
    };
    format!(
        "{} x {} mm, {}, {}, {valves}{} of {} mm in all",
        rounded(size.width()),
        rounded(size.height()),
        count_text(piece.shape.topology().chambers.len(), "chamber"),
        count_text(piece.shape.ports.len(), "port"),
        count_text(piece.shape.seams.len(), "seam"),
        rounded(length)
    )
}

/// A star in the vocabulary of the spec.
fn in_words(star: &StarSpec) -> String {
    let StarSpec { points, inner_radius, tube_width, tip_angle, tip_radius, corner_radius, .. } = star;
    let radii = [("tip radius", tip_radius), ("corner radius", corner_radius)];
    let round = radii.into_iter().filter(|(_, radius)| **radius != Length(0.0));
    let curved = round.map(|(name, radius)| format!(", {name} {radius}")).collect::<Vec<_>>().concat();
    format!(
        "{points} points, inner radius {inner_radius}, tube width {tube_width}, tip angle {tip_angle}{curved}"
    )
}

/// The sealing time and the machine; of a press the settings and the paper.
fn work(forecast: &Forecast, start: Option<&Zoned>) -> Vec<OverviewRow> {
    if let Some(plan) = PressPlan::new(&forecast.spec, &forecast.design) {
        return pressing(forecast, &plan);
    }
    let seconds = sealing_time(forecast);
    let end = start
        .and_then(|start| finish(start, seconds))
        .map(|end| format!("; started now, it ends {end}, without heating and pauses"));
    let number = forecast.design.sheets.len();
    let area = match forecast.machine.bench.work_area {
        Some((x, y)) => format!("; the machine reaches {} x {} mm", rounded(x.0), rounded(y.0)),
        None => String::new(),
    };
    let sheets = format!("{number} of {}{area}", forecast.sheet_sizes());
    let processes = processes_in_words(&forecast.programs);
    let speed = if processes.is_some() { String::new() } else { format!(" at {}", forecast.spec.seal.speed) };
    let mut rows = vec![("sealing", format!("{}{speed}{}", hours(seconds), end.unwrap_or_default()))];
    rows.extend(processes.map(|processes| ("processes", processes)));
    rows.extend(cutting(forecast));
    rows.push((if number == 1 { "sheet" } else { "sheets" }, sheets));
    rows
}

/// Length and time of the cut on the machine.
fn cutting(forecast: &Forecast) -> Option<OverviewRow> {
    let process = forecast.spec.cut.program?;
    let seconds: f64 = forecast.cuts.iter().map(|program| program.time).sum();
    let cuts = forecast.cuts.iter().flat_map(|program| &program.seams);
    let length: f64 = cuts.map(|cut| cut.length).sum();
    let (tool, speed) = (process.tool.in_words(), process.speed);
    Some(("cutting", format!("{} mm in {} at {speed}, with a {tool}", rounded(length), hours(seconds))))
}

/// The settings of a press, its sheets of fabric, and the paper for separators.
fn pressing(forecast: &Forecast, plan: &PressPlan) -> Vec<OverviewRow> {
    let papers = forecast.design.papers.first().map(|paper| {
        let size = format!("{} x {} mm", rounded(paper.width), rounded(paper.height));
        let separators: usize = forecast.design.papers.iter().map(|paper| paper.separators.len()).sum();
        format!(
            "{} in {} of {size}",
            count_text(separators, "separator"),
            count_text(forecast.design.papers.len(), "sheet")
        )
    });
    let number = forecast.design.sheets.len();
    let mut rows = vec![
        ("pressing", format!("{}; a force of {}", sealing_in_words(forecast), plan.force_in_words())),
        (
            if number == 1 { "sheet" } else { "sheets" },
            format!("{number} of {}, two layers each", forecast.sheet_sizes()),
        ),
    ];
    rows.extend(papers.map(|papers| ("paper", papers)));
    rows
}

/// The written files, the page to open, and the next command.
fn file_rows(proven: &Proven, target: &Path) -> Vec<OverviewRow> {
    let number = proven.built().files().count();
    let mut rows =
        vec![("files", format!("{number} in {}", escaped_line(target))), ("proven", scope(proven.proof()))];
    rows.extend(to_look_at(proven).map(|picture| ("look at", escaped_line(target.join(picture)))));
    let traces = named(proven, Kind::TraceGcode);
    let seals = named(proven, Kind::SealGcode);
    let packages: Vec<String> =
        [Kind::Seal3mf, Kind::Trace3mf, Kind::Cut3mf].iter().flat_map(|kind| named(proven, *kind)).collect();
    let run = match (traces.first(), seals.first()) {
        (Some(trace), Some(seal)) => {
            Some(format!("{trace} first (moves only, seals nothing), then {seal}{}", more_text(&seals)))
        }
        (None, Some(seal)) => Some(format!("{seal}{}; no trace was requested", more_text(&seals))),
        _ => None,
    };
    rows.extend(run.map(|run| ("run", run)));
    let package = packages.first().map(|_| format!("{}: the same programs in packages", packages.join(", ")));
    rows.extend(package.map(|package| ("package", package)));
    let cut = named(proven, Kind::CutGcode);
    let run_cut = cut.first().map(|first| format!("{first}{}, after the seal", more_text(&cut)));
    rows.extend(run_cut.map(|run_cut| ("cut", run_cut)));
    let plan = named(proven, Kind::PressPlan).into_iter().next();
    rows.extend(plan.map(|plan| ("print", format!("{plan}: the instructions for the press"))));
    rows
}

/// The number of files proven in memory, and whether other kinds were left out.
fn in_memory(proven: &Proven) -> Vec<OverviewRow> {
    let number = proven.built().files().count();
    let unwritten = match left_out(proven).len() {
        0 => String::new(),
        more => format!("; {more} more kinds by --with"),
    };
    vec![("proven", format!("{number} files in memory: {}{unwritten}", scope(proven.proof())))]
}

/// The JSON of [`in_memory`].
fn in_memory_json(proven: &Proven) -> Value {
    let kinds_left_out: Vec<&str> = left_out(proven).iter().map(|kind| kind.name()).collect();
    json!({ "files": proven.built().files().count(), "kinds_left_out": kinds_left_out })
}

/// The kinds that were not made because they were not requested.
fn left_out(proven: &Proven) -> Vec<Kind> {
    let request = proven.built().manifest.request();
    Kind::ALL.iter().copied().filter(|kind| !request.includes(*kind)).collect()
}

/// The file name of the page that shows most of the gripper.
pub(super) fn to_look_at(proven: &Proven) -> Option<String> {
    [Kind::Report, Kind::PreviewPng, Kind::PreviewSvg]
        .into_iter()
        .find_map(|kind| named(proven, kind).into_iter().next())
}

/// The files of one kind, by name.
fn named(proven: &Proven, kind: Kind) -> Vec<String> {
    let files = proven.built().artifacts.iter().filter(|file| file.output.kind == kind);
    files.map(|file| file.name.clone()).collect()
}

fn more_text(programs: &[String]) -> String {
    match programs.len() {
        0 | 1 => String::new(),
        2 => ", and the second in the same way".to_owned(),
        n => format!(", and the other {} in the same way", n - 1),
    }
}

/// Prints rows to standard output.
fn show(rows: &[OverviewRow]) -> Result<(), Failure> {
    let terminal_width = width(&stdout());
    let line = |(label, text): &OverviewRow| match *label {
        "" => wrapped(text, 2, terminal_width) + "\n",
        label => wrapped(&format!("{label:LABEL$}{text}"), LABEL, terminal_width) + "\n",
    };
    say(&rows.iter().map(line).collect::<String>())
}

/// Prints precautions on standard error, so that they stay visible when the answer goes into a file.
pub(super) fn warn<'a>(list: impl Iterator<Item = &'a String>) {
    let terminal_width = width(&stderr());
    let lines: Vec<String> =
        list.map(|text| wrapped(&format!("  - {}", escaped_line(text)), 4, terminal_width)).collect();
    if !lines.is_empty() {
        tell_under("before you seal", &lines.join("\n"));
    }
}

/// The JSON of [`file_rows`].
fn written_json(proven: &Proven, target: &Path) -> Value {
    let files: Vec<Value> =
        proven.built().files().map(|(name, bytes)| json!({ "path": name, "bytes": bytes.len() })).collect();
    let pairs = [
        (Kind::TraceGcode, Kind::Trace3mf),
        (Kind::SealGcode, Kind::Seal3mf),
        (Kind::CutGcode, Kind::Cut3mf),
    ];
    // A package holds the program that lies beside it.
    let programs = pairs.map(|(plain, package)| {
        let files = named(proven, plain);
        if files.is_empty() { named(proven, package) } else { files }
    });
    json!({
        "directory": target.to_string_lossy(),
        "files": files,
        "look_at": to_look_at(proven),
        "run": programs.concat(),
    })
}

/// The present time in the user's zone; `None` if the system's clock is beyond the calendar.
pub(super) fn present_time() -> Option<Zoned> {
    zoned(SystemTime::now())
}

/// `time` in the user's zone; `None` outside of the years that the calendar has, up to 9999.
fn zoned(time: SystemTime) -> Option<Zoned> {
    Some(Timestamp::try_from(time).ok()?.to_zoned(TimeZone::system()))
}

/// The end of a job of `seconds` that begins at `start`, in the zone of `start`: "Monday 23 November at 02:52 CET"; `None` above about a
/// thousand years.
fn finish(start: &Zoned, seconds: f64) -> Option<String> {
    // More than a thousand years have no useful date.
    if !(0.0..3.2e10).contains(&seconds) {
        return None;
    }
    let end = start.checked_add(SignedDuration::try_from_secs_f64(seconds.round()).ok()?).ok()?;
    let day = match (end.date() == start.date(), end.year() == start.year()) {
        (true, _) => "today".to_owned(),
        (_, true) => end.strftime("%A %-d %B").to_string(),
        _ => end.strftime("%A %-d %B %Y").to_string(),
    };
    Some(format!("{day} at {}", end.strftime("%H:%M %Z")))
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn a_clock_beyond_the_calendar_has_no_date() {
        let year_10000 = SystemTime::UNIX_EPOCH + Duration::from_secs(253_402_300_800);
        assert!(zoned(year_10000).is_none());
        assert!(zoned(year_10000 - Duration::from_secs(30 * 86_400)).is_some());
    }

    fn end(start: &str, seconds: f64) -> String {
        finish(&start.parse().expect("a time"), seconds).unwrap_or_default()
    }

    #[test]
    fn an_end_has_its_weekday_in_the_zone_where_the_job_begins() {
        let day = 86_400.0;
        assert_eq!(end("2026-11-22T10:00[UTC]", 3599.0), "today at 10:59 UTC");
        assert_eq!(end("2026-11-22T23:00:01[UTC]", 3599.0), "Monday 23 November at 00:00 UTC");
        assert_eq!(end("2026-11-22T10:00+01:00[+01:00]", 17.0 * 3600.0), "Monday 23 November at 03:00 +01");
        assert_eq!(end("2026-12-31T10:00[UTC]", day), "Friday 1 January 2027 at 10:00 UTC");
        for seconds in [f64::NAN, f64::INFINITY, -1.0, 1e11] {
            assert_eq!(end("2026-11-22T10:00[UTC]", seconds), "");
        }
    }
}
