//! Going on after an interruption: from a program's file alone to a new program for the rest of the job.
//!
//! The **record** is what the file says of its machine and its seal (structured comments); the **toolpath** is its moves
//! with what the iron does in each; a **stop** is a place on it. The new program is the old one's beginning up to the
//! heating, a way down along the seam that ends an overlap before the stop, and then the old lines as they were, the
//! first with its feed. Both programs are judged by what the old one says of itself: a comment alone is believed nothing.

mod fault;
mod judge;
mod record;
mod resume_at;
mod toolpath;

use crate::emit;
use crate::geom::{Path, Segment};
use crate::plan::{Height, Ramp, Step};
use crate::resume::record::Record;
use crate::resume::toolpath::{Run, Toolpath};

pub use fault::ResumeFault;
pub use resume_at::ResumeAt;

/// A new program for the rest of a job.
#[derive(Clone, Debug, PartialEq)]
pub struct Resumed {
    /// The program.
    pub text: String,
    /// Line of the old program in which the iron comes into contact again, from 1.
    pub line: usize,
    /// What is sealed twice, mm.
    pub overlap: f64,
    /// Part of the job's time that was done at the stop, 0 to 1.
    pub done: f64,
}

/// The program that goes on from `place` in the sealing program `text`, sealing `overlap` mm again (`None`: as much as
/// its closures overlap).
///
/// # Errors
/// If the file is damaged, not one of ours or not what its comments say, if nothing is left to do, or if the new program
/// would not keep the rules of the old one.
pub fn resume(text: &str, place: ResumeAt, overlap: Option<f64>) -> Result<Resumed, ResumeFault> {
    let record = Record::read(text)?;
    let toolpath = Toolpath::read(text, &record)?;
    judge::agrees(&record, text)?;
    let stop = place.find(&toolpath)?;
    let overlap = overlap.unwrap_or(record.seal.overlap.0);
    let lines: Vec<&str> = text.lines().collect();
    let mut out = Vec::new();
    let mut sealed_twice = 0.0;
    let line = match toolpath.run_at(stop.step) {
        Some(run) => {
            let s = stop.along.min(run.length());
            let from = (s - overlap).max(0.0);
            sealed_twice = s - from;
            approach(&record, &toolpath, &run, from, &mut out)?
        }
        // Away from the fabric: the next seam is begun as it was meant to be.
        None => toolpath.next_travel(stop.step).ok_or(ResumeFault::NothingLeft)?,
    };
    let rest = &lines[line..];
    let done = stop.done;
    let note =
        format!("resume: from_line={} overlap_mm={sealed_twice:.3} percent={:.1}", line + 1, 100.0 * done);
    let first = toolpath.with_feed(line);
    let rest: Vec<&str> = match &first {
        Some((at, text)) => {
            (line..).zip(rest).map(|(i, old)| if i == *at { text.as_str() } else { *old }).collect()
        }
        None => rest.to_vec(),
    };
    let new = assembled(&record, &lines[..toolpath.hot], &record.comment(&note), &out, &rest);
    judge::proves(&record, text, &new)?;
    Ok(Resumed { text: new, line: line + 1, overlap: sealed_twice, done })
}

/// Writes the way back to `from` (mm along `run`) into `out`, and the rest of the move in which that lies; the index of
/// the old line that comes next.
fn approach(
    record: &Record,
    toolpath: &Toolpath,
    run: &Run<'_>,
    from: f64,
    out: &mut Vec<String>,
) -> Result<usize, ResumeFault> {
    let (heights, ramp) = (&record.process.heights, record.process.ramp.0);
    // The way down of the seam itself lies before its run: there is always room for a ramp.
    let track = Path::open(run.down.iter().chain(run.steps).filter_map(|step| step.step.path).collect());
    let before: f64 = run.down.iter().filter_map(|step| step.step.path).map(|path| path.length()).sum();
    let down = track.part((before + from - ramp).max(0.0), before + from);
    let mut along = 0.0;
    let mut rest: Vec<Segment> = Vec::new();
    let mut last = run.steps.first().ok_or(ResumeFault::NothingLeft)?;
    for step in run.steps {
        let length = step.step.path.map_or(0.0, |path| path.length());
        last = step;
        // A sliver left of a move is rounding: the next move is as good a beginning.
        if along + length > from + 1e-6 {
            rest = track.part(before + from, before + along + length).segments;
            break;
        }
        along += length;
    }
    let start = down.start().ok_or(ResumeFault::NothingLeft)?;
    let (travel, contact) = (heights.travel.0, heights.contact.0);
    let steps = vec![
        Step::Travel(start),
        Step::Height(Height::Travel),
        Step::TouchDown(Ramp { pieces: down.segments, from: travel, to: contact }),
        Step::Seal(rest),
    ];
    let mut text = String::new();
    let _ = emit::write_steps(&mut text, record.facts(), &steps, record.pace, start)
        .map_err(|_| ResumeFault::NothingLeft)?;
    out.extend(run.title.clone());
    out.extend(text.lines().map(str::to_owned));
    // The dwells of the old move belong to it, and have been written anew with its rest.
    Ok(toolpath.after(last.step.line))
}

/// The new file: what comes before the heat with a note, the way back, the rest, and a last line that counts.
fn assembled(record: &Record, head: &[&str], note: &str, way: &[String], rest: &[&str]) -> String {
    let mut lines: Vec<&str> = head.to_vec();
    // After the title and the name.
    lines.insert(2.min(lines.len()), note);
    lines.extend(way.iter().map(String::as_str));
    lines.extend(&rest[..rest.len().saturating_sub(1)]);
    let mut text = lines.join("\n");
    text.push('\n');
    text.push_str(&record.comment(&format!("end of program, {} lines", lines.len() + 1)));
    text.push('\n');
    text
}
