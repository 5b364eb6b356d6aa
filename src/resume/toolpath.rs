//! The toolpath: a program's moves, with the iron's state and the time of each.
//!
//! It is read again for every use, and never stored: a chopped job has a million moves.

use crate::resume::ResumeFault;
use crate::resume::header::StatedProcess;
use crate::resume::record::Record;
use geom::Bounds;
use inflatable::numerics::last_holding;
use program::plan::{FastTool, TravelLimits};
use proof::verify::Phase;
use proof::verify::gcode::{BlindMove, Event, Interpreter, Move, each_line};
use spec::{LEAST_ACCELERATION, MOST_ACCELERATION};
use std::ops::Range;

/// Rounds of a search for an acceleration: each halves the logarithm of the range, down to a millionth.
const ROUNDS: u32 = 30;

/// One move.
#[derive(Clone, Copy, Debug)]
pub(super) struct TimedMove {
    pub(super) step: Move,
    pub(super) phase: Phase,
    /// Path in contact since the start of the seam's run, mm, at the start of the move.
    pub(super) along: f64,
    /// Time before it, s.
    pub(super) begins: f64,
    /// Time of the move, s: in contact its length over the seal's speed, because strokes and dwells keep that schedule; a laser brakes at
    /// bends. A travel speeds up and brakes.
    pub(super) seconds: f64,
    /// Time of the move if it had its speed at once, s.
    pub(super) even: f64,
    /// Whether a dwell follows it.
    pub(super) rests: bool,
    /// Index of the line that is the title of its seam.
    pub(super) title: Option<usize>,
}

impl TimedMove {
    /// Length seen from above, mm.
    pub(super) fn flat(&self) -> f64 {
        self.step.path.map_or(0.0, |path| path.length())
    }
}

/// A program without findings.
#[derive(Clone, Debug)]
pub(super) struct Toolpath<'a> {
    pub(super) text: &'a str,
    pub(super) record: &'a Record,
    /// Number of lines in the file.
    pub(super) lines: usize,
    /// Number of lines before the first heating, and up to and including it.
    pub(super) cold: usize,
    pub(super) hot: usize,
    /// The heatings: from the line of the comment to the line after which the iron is hot, counted from 0.
    heatings: Vec<Range<usize>>,
    /// Time for all of its moves, s, without the first travel.
    pub(super) seconds: f64,
    /// Time in contact and on ramps, s.
    pub(super) sealing: f64,
    /// Time of the waits for seams to cool, s.
    pub(super) cooling: f64,
    /// The acceleration of the travels, mm/s^2, as stated, or that with which they take the rest of the stated time; `None`: at speed at once.
    pub(super) acceleration: Option<f64>,
    /// Travels of the program, mm, as runs without a stop between two contacts. The first way is that from the sheet's corner, where every program leaves
    /// the iron.
    pub(super) travels: Vec<Vec<[f64; 3]>>,
    /// Time for all of it as stated in its header, with the accelerations of travels, s.
    pub(super) stated: Option<f64>,
    /// Time of the whole job as stated in the header of a program for its rest.
    pub(super) job: Option<f64>,
    /// Bounds of its moves.
    pub(super) reach: Bounds,
}

/// The way of a travel in the plane from the sheet's corner, mm; `None` for a move of another kind.
fn from_corner(travel: &BlindMove) -> Option<[f64; 3]> {
    let [Some(x), Some(y), _] = travel.to else { return None };
    Some([x, y, 0.0])
}

/// The way of `step`, mm.
fn way(step: &Move) -> [f64; 3] {
    let (start, end) = (step.from, step.to);
    [end.x - start.x, end.y - start.y, end.z - start.z]
}

impl<'a> Toolpath<'a> {
    /// Reads a whole program; a finding is an error.
    pub(super) fn read(text: &'a str, record: &'a Record) -> Result<Self, ResumeFault> {
        let (mut lines, mut stated, mut job, mut fault) = (0, None, None, None);
        let (mut heatings, mut heat) = (Vec::new(), None);
        let mut approach = None;
        each_line(text.split_inclusive('\n'), record.dialect(), |line| {
            lines = line.number;
            let mut is_comment = false;
            for event in line.events {
                match event {
                    Event::Blind(travel) if approach.is_none() => approach = from_corner(travel),
                    Event::Finding(finding) if fault.is_none() => fault = Some(finding.clone()),
                    Event::Comment(comment) => {
                        is_comment = true;
                        match comment.key() {
                            // The operator arms a laser where an iron is heated.
                            Some("heat" | "beam") => heat = Some(line.number - 1),
                            Some("total") if heatings.is_empty() => stated = comment.number("time_s"),
                            Some("job") if heatings.is_empty() => job = comment.number("time_s"),
                            _ => {}
                        }
                    }
                    _ => {}
                }
            }
            // The last line of all has no text. A line that sets a heater by its name has no effect yet: the next one waits for it.
            if !is_comment && !line.text.is_empty() && !line.events.is_empty() {
                heatings.extend(heat.take().map(|start| start..line.number));
            }
        });
        if let Some(finding) = fault {
            return Err(ResumeFault::Damaged(finding));
        }
        let Some(Range { start: cold, end: hot }) = heatings.first().cloned() else {
            return Err(ResumeFault::NotOurs("heat"));
        };
        let (travels, reach) = (vec![Vec::from_iter(approach)], Bounds::EMPTY);
        let toolpath = Self {
            text,
            record,
            lines,
            cold,
            hot,
            heatings,
            seconds: 0.0,
            sealing: 0.0,
            cooling: 0.0,
            acceleration: record.stated_acceleration(),
            travels: Vec::new(),
            stated,
            job,
            reach,
        };
        Ok(toolpath.walked(travels))
    }

    /// This program with the time and the reach of its moves; `travels` has the ways before the first one.
    ///
    /// Times in contact and ways of travels come first. What the stated time leaves to the travels gives their acceleration, and with it the
    /// time of every move.
    fn walked(mut self, mut travels: Vec<Vec<[f64; 3]>>) -> Self {
        let mut is_sealing = false;
        let (mut ends, mut sealing, mut cooling, mut reach) = (0.0, 0.0, 0.0, Bounds::EMPTY);
        for step in self.moves() {
            cooling += step.begins - ends;
            ends = step.begins + step.seconds;
            reach = step.step.path.map_or(reach, |path| reach.union(path.bounds()));
            if step.phase != Phase::Clear {
                sealing += step.seconds;
                is_sealing = true;
                continue;
            }
            if std::mem::take(&mut is_sealing) {
                travels.push(Vec::new());
            }
            if let Some(run) = travels.last_mut() {
                run.push(way(&step.step));
            }
        }
        (self.seconds, self.sealing, self.cooling, self.travels, self.reach) =
            (ends, sealing, cooling, travels, reach);
        self.acceleration = self.acceleration.or_else(|| self.fitted_acceleration());
        if self.acceleration.is_some() {
            self.seconds = self.moves().last().map_or(0.0, |last| last.begins + last.seconds);
        }
        self
    }

    /// The acceleration, mm/s^2, with which the travels take what the stated time leaves to them; `None` if they take no longer than at speed
    /// at once.
    fn fitted_acceleration(&self) -> Option<f64> {
        let seconds = self.stated? - self.sealing - self.cooling;
        let is_quick = |acceleration: f64| self.travelling(Some(acceleration)) <= seconds;
        // From the largest acceleration on travels count as at speed at once.
        (self.travelling(Some(MOST_ACCELERATION)) < seconds)
            .then(|| last_holding(MOST_ACCELERATION, LEAST_ACCELERATION, ROUNDS, is_quick))
    }

    /// The lines of the heating that is in force in the line of index `line`.
    pub(super) fn heating_before(&self, line: usize) -> Range<usize> {
        let heating = self.heatings.iter().rfind(|heating| heating.end <= line);
        heating.or(self.heatings.first()).cloned().unwrap_or_default()
    }

    /// Time of its travels, s, where the controller accelerates them by `acceleration`, mm/s^2; `None`: at speed at once.
    pub(super) fn travelling(&self, acceleration: Option<f64>) -> f64 {
        let limits = self.limits(acceleration);
        self.travels.iter().map(|run| limits.seconds(run)).sum()
    }

    fn limits(&self, acceleration: Option<f64>) -> TravelLimits {
        let speed = self.record.process.travel_speed.0;
        let z = self.record.z_limits();
        TravelLimits { dialect: self.record.controller.dialect, speed, acceleration, z }
    }

    /// Time of the whole job, of which this program may be the rest, s, without its first travel.
    fn whole_time(&self) -> f64 {
        let job_time = self.job.zip(self.stated).map(|(job, stated)| job - stated + self.seconds);
        job_time.filter(|job_time| *job_time > 0.0).unwrap_or(self.seconds)
    }

    /// The time of this program, s, at which `share` of the whole job is over; the start of the program if it begins a little later.
    pub(super) fn time_at(&self, share: f64) -> f64 {
        // The end of both is the same, and a rest seals an overlap again.
        (self.seconds - (1.0 - share) * self.whole_time()).max(0.0)
    }

    /// The fraction of the whole job, 0 to 1, that is over at `time` of this program, s.
    pub(super) fn share_at(&self, time: f64) -> f64 {
        (1.0 - (self.seconds - time) / self.whole_time()).clamp(0.0, 1.0)
    }

    /// One move after the other.
    pub(super) fn moves(&self) -> impl Iterator<Item = TimedMove> {
        let mut interpreter = Interpreter::new(self.record.dialect());
        let (mut events, mut title, mut last) = (Vec::new(), None, None::<TimedMove>);
        let mut stated = self.record.process_of(None);
        // The wait for a seam to cool, s, and whether a comment announces it.
        let (mut wait, mut cools) = (0.0, false);
        // A laser on its way along a seam.
        let mut laser: Option<FastTool> = None;
        let mut lines = self.text.split_inclusive('\n').enumerate();
        std::iter::from_fn(move || {
            for (i, line) in lines.by_ref() {
                interpreter.feed(line, &mut events);
                let mut share = None;
                for event in events.drain(..) {
                    match event {
                        Event::Comment(comment) if comment.key() == Some("seam") => {
                            title = Some(i);
                            stated = self.record.process_of(Some(&comment));
                        }
                        Event::Comment(comment) if comment.key() == Some("cool") => cools = true,
                        Event::Dwell(dwell) if cools => (wait, cools) = (dwell.seconds, false),
                        // A line has one move at the most, which is passed on after its dwells.
                        Event::Move(step) => {
                            let timed = self.timed(step, last.as_ref(), stated);
                            let braking_time = self.lost_at_bend(&timed, stated, &mut laser);
                            let stop = if timed.phase == Phase::Clear { braking_time } else { 0.0 };
                            let begins = timed.begins + std::mem::take(&mut wait) + stop;
                            let seconds = timed.seconds + braking_time - stop;
                            share = last.replace(TimedMove { begins, seconds, title, ..timed });
                        }
                        Event::Dwell(dwell) => {
                            if let Some(last) = &mut last {
                                last.rests |= dwell.seconds > 0.0;
                            }
                        }
                        _ => {}
                    }
                }
                if share.is_some() {
                    return share;
                }
            }
            last.take()
        })
    }

    /// Time that a laser loses at the beginning of `step`, s, where it bends, starts or has stopped; `laser` is its state before it.
    fn lost_at_bend(&self, step: &TimedMove, stated: &StatedProcess, laser: &mut Option<FastTool>) -> f64 {
        let Some(acceleration) = self.record.bend_acceleration() else { return 0.0 };
        let Some(path) = step.step.path.filter(|_| step.phase != Phase::Clear) else {
            return laser.take().map_or(0.0, FastTool::stop);
        };
        let rise = step.step.to.z - step.step.from.z;
        let tool = FastTool::following(&path, rise, stated.seal.speed.0, acceleration);
        tool.loss(&path, rise, laser.replace(tool))
    }

    fn timed(&self, step: Move, last_move: Option<&TimedMove>, stated: &StatedProcess) -> TimedMove {
        let record = self.record;
        let (travel, contact) = (record.process.heights.travel.0, stated.contact(&record.process).0);
        let phase = Phase::new(&step, travel, contact);
        let distance = last_move
            .filter(|b| matches!(b.phase, Phase::Contact | Phase::Up) && phase != Phase::Down)
            .map_or(0.0, |b| b.along + if b.phase == Phase::Contact { b.step.length() } else { 0.0 });
        let begins = last_move.map_or(0.0, |b| b.begins + b.seconds);
        let even = match step.feed {
            _ if phase != Phase::Clear => step.length() / stated.seal.speed.0,
            Some(feed) => step.length() / feed * 60.0,
            None => step.length() / record.process.travel_speed.0,
        };
        let seconds = match self.acceleration {
            Some(_) if phase == Phase::Clear => {
                let limits = self.limits(self.acceleration);
                // Between two travels the iron may not stop.
                let joined = last_move.filter(|b| b.phase == Phase::Clear).map(|b| way(&b.step));
                match joined {
                    Some(last) => limits.seconds(&[last, way(&step)]) - limits.seconds(&[last]),
                    None => limits.seconds(&[way(&step)]),
                }
            }
            _ => even,
        };
        let distance = if phase == Phase::Clear { 0.0 } else { distance };
        TimedMove { step, phase, along: distance, begins, seconds, even, rests: false, title: None }
    }

    /// The line of this index.
    pub(super) fn line(&self, index: usize) -> Option<&'a str> {
        self.text.lines().nth(index)
    }

    /// Index of the first line after `line` (from 1) that is not a dwell.
    pub(super) fn line_after_dwells(&self, line: usize) -> usize {
        let dwells = self.text.lines().skip(line).take_while(|text| text.starts_with("G4"));
        line + dwells.count()
    }
}
