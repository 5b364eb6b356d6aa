//! Going on after an interruption: from a program's file alone to a new program for the rest of the job.
//!
//! The **record** is what the file says of its machine and its seal (structured comments); the **toolpath** is its moves
//! with what the iron does in each; a **stop** is a place on it, a **window** what of its seam lies before that. The new program is the old one's beginning up to the
//! heating, a way down along the seam that ends an overlap before the stop, and then the old lines as they were, the
//! first with its feed. Both programs are judged by what the old one says of itself: a comment alone is believed nothing.

mod fault;
mod judge;
mod record;
mod resume_at;
mod toolpath;
mod window;

use crate::emit;
use crate::plan::{Height, Pace, Ramp, Step};
use crate::resume::record::Record;
use crate::resume::toolpath::Toolpath;
use crate::resume::window::{Next, Window, with_feed};

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
    judge::agrees(&record, text, &toolpath.reach)?;
    let stop = place.find(&toolpath)?;
    let wanted = overlap.unwrap_or(record.seal.overlap.0);
    let back = wanted + record.process.ramp.0;
    let (mut way, mut overlap) = (String::new(), 0.0);
    let line = match Window::around(&toolpath, &stop, back).ok_or(ResumeFault::NothingLeft)? {
        Next::Within(window) => {
            let from = (window.done - wanted).max(0.0);
            overlap = window.done - from;
            approach(&toolpath, &window, from, &mut way)?
        }
        // Away from the fabric: the next seam is begun as it was meant to be.
        Next::Travel(line) => line,
    };
    let done = stop.done;
    let note = format!("resume: from_line={} overlap_mm={overlap:.3} percent={:.1}", line + 1, 100.0 * done);
    let text = assembled(&toolpath, &record.comment(&note), &way, line);
    judge::proves(&record, &text, &toolpath.reach)?;
    Ok(Resumed { text, line: line + 1, overlap, done })
}

/// Writes the way back to `from` (mm along the seam's run) into `out`, and the rest of the move in which that lies; the index of
/// the old line that comes next.
fn approach(
    toolpath: &Toolpath<'_>,
    window: &Window,
    from: f64,
    out: &mut String,
) -> Result<usize, ResumeFault> {
    let record = toolpath.record;
    let heights = &record.process.heights;
    // The way down of the seam itself lies before its run: there is always room for a ramp.
    let (pieces, rest, last) =
        window.way_to(from, record.process.ramp.0, least_rest(record)).ok_or(ResumeFault::NothingLeft)?;
    let start = pieces.first().ok_or(ResumeFault::NothingLeft)?.start();
    let steps = vec![
        Step::Travel(start),
        Step::Height(Height::Travel),
        Step::TouchDown(Ramp { pieces, from: heights.travel.0, to: heights.contact.0 }),
        Step::Seal(rest),
    ];
    if let Some(title) = &window.title {
        out.push_str(title);
        out.push('\n');
    }
    let _ = emit::write_steps(out, record.facts(), &steps, record.pace, start)
        .map_err(|_| ResumeFault::NothingLeft)?;
    // The dwells of the old move belong to it, and have been written anew with its rest.
    Ok(toolpath.after(last))
}

/// The shortest way after which a chopped program stops, whatever it owes; 0 of a steady one, mm.
///
/// What is shorter has no time for a dwell, so the controller would run on into the first old stroke, which is counted from a
/// stop: the iron would be early by what a stop takes (65 ms on GRBL).
fn least_rest(record: &Record) -> f64 {
    match record.pace {
        Pace::Chopped(chop) => 2.0 * chop.least_stroke(record.seal.speed.0),
        Pace::Steady => 0.0,
    }
}

/// The new file: what comes before the heat with a note, the way back, the rest from the line of index `from`, the first
/// move of it with its feed, and a last line that counts.
fn assembled(toolpath: &Toolpath<'_>, note: &str, way: &str, from: usize) -> String {
    let (first, text) = (with_feed(toolpath, from), toolpath.text);
    let mut out = String::with_capacity(text.len() + way.len() + 200);
    let mut count = 1;
    let mut add = |line: &str| {
        out.push_str(line);
        out.push('\n');
        count += 1;
    };
    for (line, i) in text.lines().take(toolpath.hot).zip(0..) {
        // After the title and the name.
        if i == 2.min(toolpath.hot - 1) {
            add(note);
        }
        add(line);
    }
    way.lines().for_each(&mut add);
    for (line, i) in text.lines().zip(0..).take(toolpath.lines.saturating_sub(1)).skip(from) {
        match &first {
            Some((at, with_feed)) if *at == i => add(with_feed),
            // That of the whole job.
            _ if line.contains("estimated printing time") => {}
            _ => add(line),
        }
    }
    out.push_str(&toolpath.record.comment(&format!("end of program, {count} lines")));
    out.push('\n');
    out
}
