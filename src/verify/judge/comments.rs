//! Comments against the design: what is told to the operator, and what `resume` goes by.
//!
//! Every comment is one that the design asks for, each in its place and once: structured or prose, a comment is a fact.

use crate::verify::finding::quote;
use crate::verify::judge::Judge;
use crate::verify::judge::facts::{ESTIMATE, Facts, MAKER, Place};
use crate::verify::judge::progress::{Clock, Told};
use crate::verify::judge::rules::IronRules;
use crate::verify::judge::script::is_code;
use crate::verify::judge::task::ProgramTask;
use crate::verify::judge::thumbnail::{Seen, Thumbnails};
use crate::verify::read::gcode::{Comment, Event, Line};
use crate::verify::{FindingCode, Findings};

/// Figures of length are told to a thousandth, mm.
const LENGTH: f64 = 0.51e-3;
/// All others, to nine digits behind the point.
const EXACT: f64 = 0.51e-9;

/// Reports every comment that the design does not ask for, and the first that is missing.
pub(super) struct Comments<'a> {
    task: &'a ProgramTask<'a>,
    /// The comments so far but those of progress, as many of them as there may be and one more.
    said: Vec<Said>,
    most: usize,
    /// Whether the last comment is among them: it counts the lines, and the reader has judged it.
    is_last: bool,
    coded: bool,
    /// Line of the last motion so far; 0 before the first.
    moved: usize,
    chopped: bool,
    clock: Clock<'a>,
    told: Told<'a>,
    thumbnails: Thumbnails,
}

/// A comment, and where it stands.
struct Said {
    comment: Comment,
    place: Place,
}

impl<'a> Comments<'a> {
    pub(super) fn new(task: &'a ProgramTask<'a>, rules: &'a IronRules<'a>) -> Self {
        let most = Facts { task, chopped: true, seconds: 0.0 }.all().len() + 1;
        Self {
            task,
            said: Vec::new(),
            most,
            is_last: false,
            coded: false,
            moved: 0,
            chopped: false,
            clock: Clock::new(rules, task.machine.controller.dialect, task.spec.accuracy.path.0),
            told: Told::new(task.machine),
            thumbnails: Thumbnails::new(task.machine.controller.thumbnails),
        }
    }

    fn comment(&mut self, comment: &Comment) {
        if comment.text.is_empty() {
            return;
        }
        let comment = match self.thumbnails.see(&comment.text) {
            Seen::Other => comment,
            Seen::Part => return,
            Seen::Whole(text) => &Comment { text, ..comment.clone() },
        };
        self.is_last = comment.key() != Some("progress");
        if !self.is_last {
            self.told.comment(comment, &self.clock);
        } else if self.said.len() <= self.most {
            let place = match (self.moved > 0, self.coded) {
                (true, _) => Place::Body,
                (false, true) => Place::Start,
                (false, false) => Place::Head,
            };
            self.said.push(Said { comment: comment.clone(), place });
        }
    }

    /// The comments against those of the design.
    fn compare(&self, seconds: f64, findings: &mut Findings) {
        let room = self.task.machine.controller.line_length;
        let mut wanted = Facts { task: self.task, chopped: self.chopped, seconds }.all().into_iter();
        for Said { comment, place } in &self.said {
            let next = wanted.next();
            let is_end = self.moved > 0 && comment.line > self.moved;
            let right = next.as_ref().is_some_and(|(wanted, wanted_place)| {
                let there = match wanted_place {
                    Place::Head => *place == Place::Head,
                    Place::Start => false,
                    Place::Body => *place == Place::Body && !is_end,
                    Place::End => is_end,
                };
                there && self.says(&comment.text, wanted, room)
            });
            if !right {
                let allowed = next.map_or("no further comment".to_owned(), |(wanted, _)| quote(&wanted));
                findings.add(FindingCode::OtherComment, comment.line, quote(&comment.text), allowed);
                return;
            }
        }
        if let Some((wanted, _)) = wanted.next() {
            findings.add(FindingCode::OtherComment, None, "nothing more said", quote(&wanted));
        }
    }

    /// Whether a comment says what is wanted, as far as a line has room for it.
    fn says(&self, found: &str, wanted: &str, room: usize) -> bool {
        if let Some(name) = wanted.strip_prefix("name: ") {
            return found.strip_prefix("name:").is_some_and(|found| is_name(found.trim(), name.trim(), room));
        }
        if let Some((found, wanted)) = behind(ESTIMATE, found, wanted) {
            let near = |found: f64, wanted: f64| (found - wanted).abs() <= 0.501 + self.clock.slack();
            return seconds(found).zip(seconds(wanted)).is_some_and(|(found, wanted)| near(found, wanted));
        }
        if let Some((found, wanted)) = behind(MAKER, found, wanted) {
            return without_version(found) == without_version(wanted);
        }
        let is_total = wanted.starts_with("total: ");
        let (mut found_words, mut wanted_words) = (found.split(' '), wanted.split(' '));
        loop {
            match (found_words.next(), wanted_words.next()) {
                (None, None) => return true,
                (Some(a), Some(b))
                    if a == b || self.is_same_figure(a, b, is_total) || is_name(a, b, room) => {}
                // Cut at the end of the line.
                (None, Some(_)) => return found.len() + 4 >= room,
                (Some(a), Some(b)) => {
                    return found.len() + 4 >= room && b.starts_with(a) && found_words.next().is_none();
                }
                (Some(_), None) => return false,
            }
        }
    }

    /// Whether both are the same word with the same number, to the tolerance of its kind.
    fn is_same_figure(&self, found: &str, wanted: &str, is_total: bool) -> bool {
        let number = |text: &str| text.parse::<f64>().ok().filter(|x| x.is_finite());
        let (word, found, wanted) = match (found.split_once('='), wanted.split_once('=')) {
            (Some((a, found)), Some((b, wanted))) if a == b => (a, found, wanted),
            (None, None) => ("", found, wanted),
            _ => return false,
        };
        let (Some(found), Some(wanted)) = (number(found), number(wanted)) else { return false };
        let allowed = match word {
            // That of a seam is exact but for its rounding; that of the job is added up.
            "time_s" if is_total => 0.501 + self.clock.slack(),
            "time_s" => 0.501,
            "length_mm" => LENGTH,
            _ => EXACT * wanted.abs().max(1.0),
        };
        (found - wanted).abs() <= allowed
    }
}

impl Judge for Comments<'_> {
    fn see(&mut self, line: &Line<'_>) {
        if line.is_motion() {
            self.moved = line.number;
        }
        self.coded = self.coded || is_code(line.text.trim());
        self.told.display(line);
        for event in line.events {
            match event {
                Event::Move(step) => {
                    self.told.step(step, &self.clock);
                    self.clock.step(step);
                }
                Event::Dwell(_) => self.chopped = true,
                Event::Comment(comment) => self.comment(comment),
                _ => {}
            }
        }
    }

    fn end(&mut self) -> Findings {
        if self.is_last {
            let _ = self.said.pop();
        }
        let mut findings = Findings::default();
        self.compare(self.clock.seconds, &mut findings);
        self.told.judge(&self.clock, self.chopped, &mut findings);
        findings
    }
}

/// What stands behind `prefix` in both.
fn behind<'t>(prefix: &str, found: &'t str, wanted: &'t str) -> Option<(&'t str, &'t str)> {
    found.strip_prefix(prefix).zip(wanted.strip_prefix(prefix))
}

/// What follows a version: digits and points; `None` if it begins with none.
fn without_version(text: &str) -> Option<&str> {
    let rest = text.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.');
    (rest.len() < text.len()).then_some(rest)
}

/// A time of days, hours, minutes and seconds, in this order, each at most once.
fn seconds(text: &str) -> Option<f64> {
    let mut units = [('d', 86400.0), ('h', 3600.0), ('m', 60.0), ('s', 1.0)].into_iter();
    let mut sum = 0.0;
    for word in text.split(' ') {
        let (_, unit) = units.find(|(unit, _)| word.ends_with(*unit))?;
        let number = word[..word.len() - 1].parse::<f64>().ok()?;
        sum += Some(number).filter(|x| x.is_finite() && *x >= 0.0)? * unit;
    }
    Some(sum)
}

/// Whether `found` is a name or another text of the user's, in which only what means nothing to a controller is left.
fn is_name(found: &str, wanted: &str, room: usize) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || " .,-_+=:/$".contains(c);
    let mut wanted = wanted.chars();
    let alike = |f: char, w: char| f == w || (f == '_' && (!plain(w) || w == '$'));
    let same = found.chars().all(|f| wanted.next().is_some_and(|w| alike(f, w)));
    same && (wanted.all(|c| c == ' ') || found.len() + 10 >= room)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_is_read_as_hosts_read_it() {
        assert_eq!(seconds("0d 5h 38m 22s"), Some(20302.0));
        assert_eq!(seconds("20302.25s"), Some(20302.25));
        for wrong in ["", "5", "5m 1h", "1h 1h", "-1s", "nans", "1s later"] {
            assert_eq!(seconds(wrong), None, "{wrong}");
        }
        assert_eq!(without_version("0.1.0 on 0000"), Some(" on 0000"));
        assert_eq!(without_version("Slicer on 0000"), None);
    }
}
