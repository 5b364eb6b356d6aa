//! Lengths and times as the comments state them, against the moves.

use std::collections::HashMap;

use crate::resume::figures::comment;
use crate::resume::toolpath::{TimedMove, Toolpath};
use proof::verify::gcode::Comment;
use proof::verify::{Finding, FindingCode, Phase};
use spec::LEAST_ACCELERATION;

/// Rounding of coordinates and of a stated length, for each seam, mm.
const LENGTH: f64 = 0.02;
/// Rounding of a stated time, s.
const TIME: f64 = 0.6;
/// The most by which strokes and dwells leave the schedule of a contact, s.
const SCHEDULE: f64 = 5.0;
/// Tolerance of a stated time where the controller joins short moves, as a part of the time in contact.
const JOINED: f64 = 5e-3;
/// Rounding of a stated percentage, as a fraction.
const SHARE: f64 = 6e-4;
/// Where every axis has the travel speed, a way is faster by at most this: the diagonal of a cube.
const DIAGONAL: f64 = 1.733;

/// Moves of a seam, or of all of them.
#[derive(Clone, Copy, Debug, Default)]
struct WalkedSeam {
    /// Path in contact, mm.
    length: f64,
    /// The most by which chords are shorter than the arcs that they replace, mm.
    chords: f64,
    /// Time with ramps, s.
    seconds: f64,
}

impl WalkedSeam {
    fn add(&mut self, step: &TimedMove, tolerance: f64) {
        self.seconds += step.even;
        let flat = step.flat();
        if step.phase == Phase::Contact {
            self.length += flat;
        }
        // A chord c with the sagitta s is shorter than its arc by 8 s^2 / (3 c).
        self.chords += 3.0 * tolerance * tolerance / flat.max(tolerance);
    }
}

/// The first comment that does not state the lengths and times of the program, or the place in the whole job where it begins.
pub(super) fn first_fault(toolpath: &Toolpath<'_>) -> Option<Finding> {
    StatedFigures::new(toolpath).first_fault()
}

/// A program's moves and what its comments state about them.
struct StatedFigures<'a> {
    toolpath: &'a Toolpath<'a>,
    comments: Vec<Comment>,
    /// By the number of the seam in its title.
    seams: HashMap<u64, WalkedSeam>,
    all: WalkedSeam,
    contacts: f64,
    /// Least and largest time of the travels, s.
    travels: [f64; 2],
    /// Time before the first contact, s.
    ahead: f64,
}

impl<'a> StatedFigures<'a> {
    fn new(toolpath: &'a Toolpath<'a>) -> Self {
        let record = toolpath.record;
        let comments: Vec<Comment> = (1..)
            .zip(toolpath.text.lines())
            .filter_map(|(line, text)| Some(Comment::new(line, comment(record, text)?.text)))
            .filter(|comment| matches!(comment.key(), Some("length" | "seam" | "total" | "job" | "resume")))
            .collect();
        let titles: HashMap<usize, u64> = comments
            .iter()
            .filter(|comment| comment.key() == Some("seam"))
            .filter_map(|comment| Some((comment.line - 1, comment.number("seam")?.to_bits())))
            .collect();
        // The moves are added in their order, to the seam that their title announces and to the whole. A way without contact
        // takes a time between two ends.
        let mut figures = Self {
            toolpath,
            comments,
            seams: titles.values().map(|number| (*number, WalkedSeam::default())).collect(),
            all: WalkedSeam::default(),
            contacts: 0.0,
            travels: [0.0; 2],
            ahead: 0.0,
        };
        let acceleration = record.stated_acceleration().unwrap_or(LEAST_ACCELERATION);
        let mut last_step = None;
        for step in toolpath.moves() {
            if last_step.is_none() {
                // Every job begins at X0 Y0. The way from there is no move, because a program does not know where the iron is.
                let way = libm::hypot(step.step.from.x, step.step.from.y);
                figures.travels[1] += way / record.process.travel_speed.0 + starting(way, acceleration);
            }
            let begins = last_step.is_none_or(|phase| phase == Phase::Clear) && step.phase != Phase::Clear;
            last_step = Some(step.phase);
            if begins {
                figures.contacts += 1.0;
            }
            if step.phase == Phase::Clear {
                let [shortest, longest] = &mut figures.travels;
                *shortest += step.even / DIAGONAL;
                *longest += step.even + starting(step.step.length(), acceleration);
                continue;
            }
            if figures.all.length == 0.0 {
                figures.ahead = step.begins + if step.phase == Phase::Contact { 0.0 } else { step.seconds };
            }
            let number = step.title.and_then(|title| titles.get(&title));
            if let Some(seam) = number.and_then(|number| figures.seams.get_mut(number)) {
                seam.add(&step, record.path.0);
            }
            figures.all.add(&step, record.path.0);
        }
        figures
    }

    fn first_fault(&self) -> Option<Finding> {
        self.comments.iter().find_map(|comment| {
            let allowed = match comment.key()? {
                "total" => self.wrong_total(comment),
                "job" => self.wrong_job(),
                "resume" => None,
                _ => self.wrong_seam(comment),
            }?;
            Some(Finding::in_line(FindingCode::OtherComment, comment.line, comment.text.clone(), allowed))
        })
    }

    /// What a comment about a seam should state.
    fn wrong_seam(&self, comment: &Comment) -> Option<String> {
        let Some(walked) = self.seams.get(&comment.number("seam")?.to_bits()) else {
            return Some("a seam that the program has".to_owned());
        };
        let time = walked.chords / self.speed() + TIME + LENGTH / self.speed();
        wrong_length(comment, walked, 1.0)
            .or_else(|| wrong_time(comment, [walked.seconds - time, walked.seconds + time]))
    }

    /// What the comment about the whole program should state.
    fn wrong_total(&self, comment: &Comment) -> Option<String> {
        let (walked, contacts) = (&self.all, self.contacts.max(1.0));
        let sealing = self.toolpath.sealing;
        let tolerance = (walked.chords + LENGTH * contacts) / self.speed() + SCHEDULE * contacts;
        let tolerance =
            if self.toolpath.record.joins_moves() { tolerance + JOINED * sealing } else { tolerance };
        let [shortest, longest] = self.travels.map(|travels| sealing + travels);
        // The accelerations of a rest are those of the whole job; its time is proven with the job's.
        let longest = if self.toolpath.job.is_some() { f64::INFINITY } else { longest + tolerance };
        wrong_length(comment, walked, contacts)
            .or_else(|| wrong_time(comment, [shortest - tolerance, longest]))
    }

    /// What the comment about the whole job should state, of which this program is the rest.
    fn wrong_job(&self) -> Option<String> {
        let note = self.comments.iter().find(|comment| comment.key() == Some("resume"));
        let Some((overlap, percent)) =
            note.and_then(|note| note.number("overlap_mm").zip(note.number("percent")))
        else {
            return Some("a comment \"resume: ... overlap_mm=... percent=...\" beside it".to_owned());
        };
        let heights = &self.toolpath.record.process.heights;
        // The job may have stopped on the way up, after the seam.
        let record = self.toolpath.record;
        let contacts = record.all_processes().map(|stated| stated.contact(&record.process).0);
        let contact_height = contacts.fold(heights.contact.0, f64::min);
        let rise = libm::hypot(record.process.ramp.0, heights.travel.0 - contact_height);
        let contact = self.ahead + overlap / self.speed();
        let first = if overlap > 0.0 { contact } else { 0.0 };
        let [low, high] = [first - SCHEDULE, contact + rise / self.speed() + SCHEDULE]
            .map(|time| self.toolpath.share_at(time));
        let is_there = (low - SHARE..=high + SHARE).contains(&(percent / 100.0));
        (!is_there)
            .then(|| format!("a time with which {percent} % of the job are over where this program begins"))
    }

    /// The speed of the slowest seams, mm/s.
    fn speed(&self) -> f64 {
        let speeds = self.toolpath.record.all_processes().map(|stated| stated.seal.speed.0);
        speeds.fold(f64::INFINITY, f64::min)
    }
}

/// The time that `way`, mm, from rest to rest takes at most beyond that at full speed, s.
fn starting(way: f64, acceleration: f64) -> f64 {
    2.0 * (way / acceleration).sqrt()
}

/// The length that was walked instead of a stated one, for so many `seams`.
fn wrong_length(comment: &Comment, walked: &WalkedSeam, seams: f64) -> Option<String> {
    let excess = comment.number("length_mm")? - walked.length;
    let is_there = (-LENGTH * seams..=LENGTH * seams + walked.chords).contains(&excess);
    (!is_there).then(|| format!("length_mm={:.3}", walked.length))
}

/// The possible times instead of a stated one, s.
fn wrong_time(comment: &Comment, [shortest, longest]: [f64; 2]) -> Option<String> {
    let time = comment.number("time_s")?;
    let most_in_words = if longest.is_finite() { format!(" to {longest:.0}") } else { " or more".to_owned() };
    (!(shortest..=longest).contains(&time)).then(|| format!("time_s={shortest:.0}{most_in_words}"))
}
