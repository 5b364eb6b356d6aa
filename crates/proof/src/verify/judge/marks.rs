//! The stops above the marks of a sheet: each at travel height, where the design has its mark.

use crate::verify::judge::{HEIGHT, Judge};
use crate::verify::read::gcode::{BlindMove, Comment, Move, Pause};
use crate::verify::{FindingCode, Findings};
use geom::Point;

/// Reports every mark at which a program does not stop, and every stop that is announced as one and is elsewhere.
pub(super) struct MarkJudge<'a> {
    marks: &'a [Point],
    /// Height of travels, mm, and slack on places, mm.
    travel: f64,
    tolerance: f64,
    /// Number of stops so far.
    stops: usize,
    /// Line of the comment that announces a stop which has not come yet.
    announced: Option<usize>,
}

impl<'a> MarkJudge<'a> {
    pub(super) fn new(marks: &'a [Point], travel: f64, tolerance: f64) -> Self {
        Self { marks, travel, tolerance, stops: 0, announced: None }
    }

    /// Reports a stop that was announced and is not there.
    fn end_announcement(&mut self, findings: &mut Findings) {
        if let Some(line) = self.announced.take() {
            findings.add_at(
                FindingCode::MissingMark,
                line,
                "no pause at the mark",
                "a pause above every mark",
            );
        }
    }
}

impl Judge for MarkJudge<'_> {
    fn comment(&mut self, comment: &Comment, findings: &mut Findings) {
        if comment.key() == Some("mark") {
            self.end_announcement(findings);
            self.announced = Some(comment.line);
        }
    }

    fn step(&mut self, _: &Move, findings: &mut Findings) {
        self.end_announcement(findings);
    }

    fn blind(&mut self, _: &BlindMove, findings: &mut Findings) {
        self.end_announcement(findings);
    }

    fn pause(&mut self, pause: &Pause, findings: &mut Findings) {
        if self.announced.take().is_none() {
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
