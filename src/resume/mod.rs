//! Resumes an interrupted job: reads a program's file alone, and writes a new program for the rest of the job.
//!
//! The **record** is the machine and the seal as the file's structured comments state them; the **toolpath** is its moves with the iron's
//! state in each. A **stop** is a place on it, and a **window** is the part of its seam before the stop. The new program consists of the
//! old one's beginning up to the heating, a ramp down along the seam that ends an overlap before the stop, and the unchanged old lines, the
//! first with its feed. Its **figures** are its own length and time. Both programs are checked against the old one's comments; no comment
//! is trusted without a check.

mod fault;
mod figures;
mod header;
mod judge;
mod record;
mod resume_at;
mod stated;
mod toolpath;
mod window;

use crate::emit;
use crate::resume::figures::Figures;
use crate::resume::header::StatedProcess;
use crate::resume::record::Record;
use crate::resume::resume_at::StopPoint;
use crate::resume::toolpath::Toolpath;
use crate::resume::window::{Next, Window, with_feed};
use program::plan::{Height, Pace, Ramp, Step};
use proof::artifact::takes_packages;
use proof::verify::{Finding, judge_clamps};
use spec::{KeepOut, Process};

pub use fault::ResumeFault;
pub use resume_at::ResumeAt;

/// How often a longer overlap is tried, and by how much it is longer each time, mm.
const TRIES: u32 = 4;
const LONGER: f64 = 0.25;

/// A new program for the rest of a job.
#[derive(Clone, Debug, PartialEq)]
pub struct Resumed {
    /// The program.
    pub text: String,
    /// The program in a package, for a machine that takes packages.
    pub package: Option<Vec<u8>>,
    /// Line of the old program in which the iron comes into contact again, from 1.
    pub line: usize,
    /// Length that is sealed twice, mm.
    pub overlap: f64,
    /// Fraction of the whole job's time that was over at the stop, 0 to 1.
    pub done: f64,
    /// Time of the new program, without heating and pauses, s.
    pub seconds: f64,
}

/// The program that resumes the sealing program `text` at `place`, and seals `overlap` mm again (`None`: the overlap of its closures).
///
/// # Errors
/// If the file is damaged, is not one of ours or disagrees with its comments, if the job is complete, or if the new program would break the
/// rules of the old one.
pub fn resume(text: &str, place: ResumeAt, overlap: Option<f64>) -> Result<Resumed, ResumeFault> {
    let record = Record::read(text)?;
    let toolpath = Toolpath::read(text, &record)?;
    let contradiction = judge::contradiction(&record, text, toolpath.seconds);
    let first_fault = || judge::first_fault(&record, text, &toolpath.reach);
    if let Some(finding) = contradiction.or_else(first_fault).or_else(|| stated::first_fault(&toolpath)) {
        return Err(ResumeFault::Disagrees(finding));
    }
    let stop = place.find(&toolpath)?;
    let least_overlap = overlap.unwrap_or(record.seal.overlap.0);
    let first = rest(&toolpath, &stop, least_overlap);
    let Err(ResumeFault::Unproven(_)) = first else { return first };
    // Chopped strokes that end without a dwell are joined to the old one that follows. A little farther back others end there.
    let longer = (1..=TRIES).map(|tries| least_overlap + LONGER * f64::from(tries));
    longer.map(|least_overlap| rest(&toolpath, &stop, least_overlap)).find(Result::is_ok).unwrap_or(first)
}

/// A program for the rest of a job, with an overlap of at least `least_overlap` mm.
fn rest(toolpath: &Toolpath<'_>, stop: &StopPoint, least_overlap: f64) -> Result<Resumed, ResumeFault> {
    let record = toolpath.record;
    // At a stop of the machine the seam may continue one stroke farther back.
    let spare = if record.joins_moves() { record.seal.band.0 } else { 0.0 };
    let back = least_overlap + record.process.ramp.0 + spare;
    let (mut way, mut overlap) = (String::new(), 0.0);
    let line = match Window::enclosing(toolpath, stop, back).ok_or(ResumeFault::NothingLeft)? {
        Next::Within(window) => {
            let (start, line) =
                approach(toolpath, &window, (window.done - least_overlap).max(0.0), &mut way)?;
            overlap = window.done - start;
            line
        }
        // Away from the fabric the next seam begins as planned.
        Next::Travel(line) => line,
    };
    let share = stop.done;
    let note = format!("resume: from_line={} overlap_mm={overlap:.3} percent={:.1}", line + 1, 100.0 * share);
    let note = record.comment(&note);
    // A draft with the old figures gives the new ones.
    let draft = assembled(toolpath, &note, &way, line, None);
    let figures = Figures::new(toolpath, &Toolpath::read(&draft, record)?);
    let text = assembled(toolpath, &note, &way, line, Some(&figures));
    if let Some(finding) = judge::first_fault(record, &text, &toolpath.reach) {
        return Err(ResumeFault::Unproven(finding));
    }
    let is_packed = takes_packages(record.controller.dialect);
    let package = is_packed.then(|| emit::package(&text, figures.seconds)).flatten();
    Ok(Resumed { text, package, line: line + 1, overlap, done: share, seconds: figures.seconds })
}

/// The first move of the sealing program `text` that meets one of `clamps`.
///
/// # Errors
/// If it is not a program of ours.
pub fn clamp_in_the_way(text: &str, clamps: &[KeepOut]) -> Result<Option<Finding>, ResumeFault> {
    let record = Record::read(text)?;
    let lines = text.split_inclusive('\n');
    Ok(judge_clamps(clamps, record.seal.band.0 / 2.0, lines, record.dialect()))
}

/// Writes the path back to `from` (mm along the seam's run) into `added_lines`, and the rest of the move that contains it. Returns the
/// place where the seam continues, and the index of the next old line.
fn approach(
    toolpath: &Toolpath<'_>,
    window: &Window,
    from: f64,
    added_lines: &mut String,
) -> Result<(f64, usize), ResumeFault> {
    let record = toolpath.record;
    let Process { heights, ramp, .. } = &record.process;
    let title = window.title.as_deref().and_then(|title| figures::comment(record, title));
    let stated = record.process_of(title.as_ref());
    // The seam's own ramp lies before its run, so there is always space for a ramp.
    let (from, (rest, last)) = if record.joins_moves() {
        let (from, last) = window.stop_before(from).ok_or(ResumeFault::NothingLeft)?;
        // The last strokes down may have no dwell of their own: then the next ones are joined to them, and need another dwell.
        (from, window.run_from(from).unwrap_or((Vec::new(), last)))
    } else {
        (from, window.rest_from(from, least_rest(stated)).ok_or(ResumeFault::NothingLeft)?)
    };
    let pieces = window.way_down(from, ramp.0);
    let start = pieces.first().ok_or(ResumeFault::NothingLeft)?.start();
    let steps = vec![
        Step::Travel(start),
        Step::Height(Height::Travel),
        Step::TouchDown(Ramp { pieces, from: heights.travel.0, to: stated.contact(&record.process).0 }),
        Step::Seal(rest),
    ];
    if let Some(title) = &window.title {
        added_lines.push_str(title);
        added_lines.push('\n');
    }
    added_lines.push_str(&emit::steps_text(record.facts(stated), &steps, stated.pace, start));
    // The dwells of the old move belong to it, and have been written again with its rest.
    Ok((from, toolpath.line_after_dwells(last)))
}

/// The shortest path, mm, after which a chopped program stops in any case; 0 for a steady one.
///
/// A shorter path leaves no time for a dwell. The controller would run on into the first old stroke, whose timing assumes a stop: the iron
/// would be early by the time of a stop (65 ms on GRBL).
fn least_rest(stated: &StatedProcess) -> f64 {
    match stated.pace {
        Pace::Chopped(chop) => 2.0 * chop.least_stroke(stated.seal.speed.0),
        Pace::Steady => 0.0,
    }
}

/// The new file: the lines before the first heating with a note, the heating in force, the path back, the rest from the line of index
/// `first_line`, its first move with its feed, and a last line with counts. With `figures` it states its own length and time.
fn assembled(
    toolpath: &Toolpath<'_>,
    note: &str,
    way: &str,
    first_line: usize,
    figures: Option<&Figures>,
) -> String {
    let (first, record, text) = (with_feed(toolpath, first_line), toolpath.record, toolpath.text);
    let mut program = String::with_capacity(text.len() + way.len() + 200);
    let mut count = 1;
    let mut add = |line: &str| {
        program.push_str(line);
        program.push('\n');
        count += 1;
    };
    let mut restate = |line: &str| match figures {
        Some(figures) => figures.line(record, line).iter().for_each(|line| add(line)),
        None => add(line),
    };
    // The head up to the first heating, and the heating that is in force where the job goes on.
    let heating = toolpath.heating_before(first_line);
    let head = text.lines().take(toolpath.cold);
    let heating = text.lines().take(heating.end).skip(heating.start);
    for (line, i) in head.chain(heating).zip(0..) {
        // The place after the title and the name.
        if i == 2.min(toolpath.hot - 1) {
            restate(note);
        }
        restate(line);
    }
    way.lines().for_each(&mut restate);
    for (line, i) in text.lines().zip(0..).take(toolpath.lines.saturating_sub(1)).skip(first_line) {
        match &first {
            Some((at, with_feed)) if *at == i => restate(with_feed),
            _ => restate(line),
        }
    }
    program.push_str(&record.comment(&format!("end of program, {count} lines")));
    program.push('\n');
    program
}
