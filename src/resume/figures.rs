//! Figures of the rest: length and time of a new program, for its comments.

use crate::emit;
use crate::resume::record::Record;
use crate::resume::toolpath::Toolpath;
use proof::verify::Phase;
use proof::verify::gcode::Comment;

/// Lengths and times of a new program, whose first seam may be a part of one of the old program.
pub(super) struct Figures {
    /// Number of its first seam, as numbered in the old program.
    seam: f64,
    /// Path in contact of that seam, mm, and its time with ramps, s.
    first: (f64, f64),
    /// Path in contact of all seams, mm.
    length: f64,
    /// Whether the old program itself resumes another one.
    is_again: bool,
    /// Time of all of it, without heating and pauses, s.
    pub(super) seconds: f64,
}

impl Figures {
    /// The figures of `new`, a program that resumes `old`.
    ///
    /// The time of its travels follows the rules of the plan. A steady program does not state the acceleration: it is that with which the old
    /// program takes the time that it states. Where the acceleration is stated, what is left over is the time by which strokes leave their
    /// schedule, and the new program has as large a part of it as it has of the sealing.
    pub(super) fn new(old: &Toolpath<'_>, new: &Toolpath<'_>) -> Self {
        let (mut title, mut seam, mut first, mut length) = (None, 0.0, (0.0, 0.0), 0.0);
        for step in new.moves().filter(|step| step.phase != Phase::Clear) {
            let flat = if step.phase == Phase::Contact { step.flat() } else { 0.0 };
            length += flat;
            if title.is_none() {
                title = step.title;
                let number = |i| comment(new.record, new.line(i)?)?.number("seam");
                seam = step.title.and_then(number).unwrap_or(0.0);
            }
            if step.title == title {
                first = (first.0 + flat, first.1 + step.even);
            }
        }
        let acceleration = old.acceleration;
        let sealing =
            old.stated.map_or(old.sealing, |stated| stated - old.cooling - old.travelling(acceleration));
        let share = new.sealing / old.sealing.max(f64::MIN_POSITIVE);
        Self {
            seam,
            first,
            length,
            is_again: old.job.is_some(),
            seconds: (share * sealing + new.cooling + new.travelling(acceleration)).max(0.0),
        }
    }

    /// The lines that replace a line of the old program; empty if the new program has no such line.
    pub(super) fn line(&self, record: &Record, line: &str) -> Vec<String> {
        let Some(stated) = comment(record, line) else { return vec![line.to_owned()] };
        match stated.key() {
            Some("total") => {
                let mut lines = vec![record.comment(&restated(&stated, (self.length, self.seconds)))];
                // A program resumed twice keeps the job of the first one.
                if !self.is_again {
                    lines.push(record.comment(&stated.text.replacen("total:", "job:", 1)));
                }
                lines
            }
            Some("sealing") if stated.number("seam").is_some_and(|seam| seam < self.seam) => Vec::new(),
            Some("length" | "seam") => match stated.number("seam") {
                Some(seam) if seam < self.seam => Vec::new(),
                Some(seam) if seam == self.seam => vec![record.comment(&restated(&stated, self.first))],
                _ => vec![line.to_owned()],
            },
            _ if stated.text.starts_with("estimated printing time") => {
                let estimate = emit::estimate(record.controller.dialect, self.seconds);
                estimate.map(|estimate| record.comment(&estimate)).into_iter().collect()
            }
            _ => vec![line.to_owned()],
        }
    }
}

/// The comment in a line that contains nothing else.
pub(super) fn comment(record: &Record, line: &str) -> Option<Comment> {
    let text = match line.strip_prefix(';') {
        Some(text) => text,
        None => line.strip_prefix('(')?.strip_suffix(')')?,
    };
    let text = text.trim().to_owned();
    (record.comment(&text) == line.trim_end()).then(|| Comment::new(0, text))
}

/// The text of a comment with another length, mm, and another time, s.
fn restated(comment: &Comment, (mm, s): (f64, f64)) -> String {
    let word = |text: &str| match text.split_once('=') {
        Some(("length_mm", _)) => format!("length_mm={mm:.3}"),
        Some(("time_s", _)) => format!("time_s={s:.0}"),
        _ => text.to_owned(),
    };
    comment.text.split(' ').map(word).collect::<Vec<_>>().join(" ")
}
