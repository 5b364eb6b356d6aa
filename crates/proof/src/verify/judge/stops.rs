//! Stops that a program announces: it waits for the operator after each announcement, and above the marks of a sheet at travel height,
//! where the design has them.

use crate::verify::judge::{HEIGHT, Judge};
use crate::verify::read::gcode::{BlindMove, Comment, Move, Pause};
use crate::verify::{FindingCode, Findings};
use geom::Point;

/// The key of the comment that announces a stop above a mark.
const MARK: &str = "mark";
/// The keys of the comments that announce a stop, besides those for the heat, which the interpreter follows.
const STOPS: [&str; 4] = [MARK, "tool", "pause", "beam"];

/// Reports every announced stop that does not come, and every stop above a mark that is elsewhere, or is missing.
pub(super) struct StopJudge<'a> {
    marks: &'a [Point],
    /// Height of travels, mm, and slack on places, mm.
    travel: f64,
    tolerance: f64,
    /// Number of stops so far.
    stops: usize,
    /// The announcement of a stop that has not come yet.
    announced: Option<Announcement>,
}

/// A comment that announces a stop.
#[derive(Clone, Copy)]
struct Announcement {
    line: usize,
    key: &'static str,
}

impl<'a> StopJudge<'a> {
    pub(super) fn new(marks: &'a [Point], travel: f64, tolerance: f64) -> Self {
        Self { marks, travel, tolerance, stops: 0, announced: None }
    }

    /// Reports a stop that was announced and is not there.
    fn end_announcement(&mut self, findings: &mut Findings) {
        let Some(Announcement { line, key }) = self.announced.take() else { return };
        let code = if key == MARK { FindingCode::MissingMark } else { FindingCode::ProfileLine };
        findings.add_at(code, line, format!("the comment {key:?} without a pause after it"), "a pause there");
    }
}

impl Judge for StopJudge<'_> {
    fn comment(&mut self, comment: &Comment, findings: &mut Findings) {
        let key = comment.key();
        if key == Some("heat") {
            self.end_announcement(findings);
        }
        if let Some(key) = STOPS.into_iter().find(|stop| key == Some(*stop)) {
            self.end_announcement(findings);
            self.announced = Some(Announcement { line: comment.line, key });
        }
    }

    fn step(&mut self, _: &Move, findings: &mut Findings) {
        self.end_announcement(findings);
    }

    fn blind(&mut self, _: &BlindMove, findings: &mut Findings) {
        self.end_announcement(findings);
    }

    fn pause(&mut self, pause: &Pause, findings: &mut Findings) {
        if self.announced.take().is_none_or(|announcement| announcement.key != MARK) {
            return;
        }
        let mark = self.marks.get(self.stops).copied();
        self.stops += 1;
        let is_there = |mark: Point| {
            pause.at.is_some_and(|place| {
                place.xy().distance(mark) <= 2.0 * self.tolerance && (place.z - self.travel).abs() <= HEIGHT
            })
        };
        if !mark.is_some_and(is_there) {
            let fault = pause.at.map_or("a stop at an unknown place".to_owned(), |place| {
                format!("a stop at X{:.3} Y{:.3} Z{:.3}", place.x, place.y, place.z)
            });
            let allowed = mark.map_or("no further mark".to_owned(), |mark| {
                format!("above the mark at X{:.3} Y{:.3}, at Z{}", mark.x, mark.y, self.travel)
            });
            findings.add_at(FindingCode::MissingMark, pause.line, fault, allowed);
        }
    }

    fn end(&mut self, findings: &mut Findings) {
        self.end_announcement(findings);
        if self.stops < self.marks.len() {
            let allowed = format!("{} stops", self.marks.len());
            findings.add(FindingCode::MissingMark, format!("{} stops above marks", self.stops), allowed);
        }
    }
}
