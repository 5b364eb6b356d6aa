//! The iron's speed in contact: as programmed, at a feed that the controller holds, or made of strokes and dwells.
//!
//! A **stroke** is a move that a dwell follows; moves without a dwell between them are one stroke to the controller, which
//! does not stop there. Its schedule is the seal's speed: however it is chopped, a contact must never be off its schedule
//! by more than 0.2 % and a dwell's step, nor a stroke on its own. Where the controller joins short moves, no dwell follows one.

use crate::verify::judge::Judge;
use crate::verify::judge::rules::{ContactCount, ContactRule, IronRules, Phase};
use crate::verify::judge::stroke::{StrokeRun, least_time, shortest_move, step_seconds};
use crate::verify::read::gcode::{Comment, Dwell, Move, MoveKind};
use crate::verify::{FindingCode, Findings};
use geom::Segment;

/// Largest relative error of the mean speed.
const MEAN: f64 = 0.002;
/// Slack on lengths and feeds, which are rounded in the file.
const ROUNDING: f64 = 1e-3;

/// Time due and time spent in one contact, s.
#[derive(Clone, Copy, Default)]
struct Schedule {
    due: f64,
    spent: f64,
    /// The run since the last stop, and the time counted for it.
    run: StrokeRun,
    counted: f64,
    /// The time due, and the delay of the iron, at the last stop, s.
    stop: (f64, f64),
}

/// Reports every move below travel height that is too fast or too slow.
pub(super) struct Paced<'a> {
    rules: &'a IronRules<'a>,
    count: ContactCount,
    /// The rules of the contact.
    rule: &'a ContactRule,
    schedule: Schedule,
    /// The move that is judged with the waits after it, and those so far, s.
    pending: Option<(Move, f64)>,
}

impl<'a> Paced<'a> {
    pub(super) fn new(rules: &'a IronRules<'a>) -> Self {
        let (count, rule) = (ContactCount::default(), &rules.default);
        Self { rules, count, rule, schedule: Schedule::default(), pending: None }
    }

    fn judge_pending(&mut self, findings: &mut Findings) {
        if let Some((step, rest)) = self.pending.take() {
            self.judge(&step, rest, findings);
        }
    }

    /// One move in contact, and the wait after it.
    fn judge(&mut self, step: &Move, rest: f64, findings: &mut Findings) {
        let speed = self.rule.seal.speed.0;
        let Some(feed) = step.feed.map(|feed| feed / 60.0) else {
            findings.add_at(FindingCode::WrongFeed, step.line, "none", format!("F{}", speed * 60.0));
            return;
        };
        self.schedule.due += step.length() / speed;
        let stopped = if (feed - speed).abs() <= ROUNDING * speed {
            self.schedule.spent += step.length() / feed + rest;
            true
        } else if self.rules.chops {
            let chop_feed = self.rules.motion.chop_speed(speed).unwrap_or(feed);
            if (feed - chop_feed).abs() > ROUNDING * chop_feed {
                let (fault, allowed) = (format!("F{}", feed * 60.0), format!("F{}", chop_feed * 60.0));
                findings.add_at(FindingCode::WrongFeed, step.line, fault, allowed);
            }
            self.stroke(step, feed, rest);
            if rest > 0.0 && self.schedule.run.is_short() {
                let allowed = format!("at least {} steps", self.rules.motion.min_move_steps);
                let fault = "a dwell after fewer steps than the controller makes at once";
                findings.add_at(FindingCode::ShortStroke, step.line, fault, allowed);
            }
            let longest = self.longest(feed);
            if step.length() > longest + 0.01 {
                let fault = format!("a stroke of {:.3} mm", step.length());
                let allowed = format!("at most {longest:.3} mm");
                findings.add_at(FindingCode::LongStroke, step.line, fault, allowed);
            }
            rest > 0.0
        } else {
            let (fault, allowed) = (format!("F{}", feed * 60.0), format!("F{}", speed * 60.0));
            findings.add_at(FindingCode::WrongFeed, step.line, fault, allowed);
            return;
        };
        // A move that the controller has not begun yet would seem late: it is judged together with the moves that it is joined
        // to.
        if self.rules.timed && (stopped || !self.schedule.run.is_short()) {
            self.on_time(step, stopped, findings);
        }
        if rest > 0.0 {
            (self.schedule.run, self.schedule.counted) = (StrokeRun::default(), 0.0);
        }
        let motion = self.rules.motion;
        let is_steady = (feed - speed).abs() <= ROUNDING * speed;
        let lowest_of = |way| if is_steady { motion.lowest_speed(way) } else { motion.lowest_stroke(way) };
        let lowest = step.path.and_then(|path| lowest_along(&path, step.to.z - step.from.z, lowest_of));
        if let Some(lowest) = lowest.filter(|lowest| feed < lowest * (1.0 - ROUNDING)) {
            let fault = format!("F{:.3}, which the controller runs at {:.3}", feed * 60.0, lowest * 60.0);
            let allowed = format!("at least F{:.3}", lowest * 60.0);
            findings.add_at(FindingCode::BelowFloor, step.line, fault, allowed);
        }
    }

    /// Counts the time of a stroke: a run goes on until a wait ends it.
    fn stroke(&mut self, step: &Move, feed: f64, rest: f64) {
        let (motion, schedule) = (self.rules.motion, &mut self.schedule);
        let [from, to] = [step.from, step.to].map(|at| [at.x, at.y, at.z]);
        schedule.run = schedule.run.and(motion, from, to, step.length());
        // A move that the controller has not begun takes no time yet.
        let seconds =
            if schedule.run.is_short() { schedule.counted } else { schedule.run.seconds(motion, feed) };
        schedule.spent += seconds - schedule.counted + rest;
        schedule.counted = seconds;
    }

    /// The longest stroke, mm: a tenth of the band, or the length that leaves time for the shortest dwell.
    fn longest(&self, feed: f64) -> f64 {
        let (seal, dwell_step) = (&self.rule.seal, self.rules.dwell_step);
        let shortest_time = self.start_and_stop(feed) + dwell_step;
        let spared = 1.0 / seal.speed.0 - 1.0 / feed;
        let length = if spared > 0.0 { shortest_time / spared } else { 0.0 };
        let length = length.max(seal.speed.0 * least_time(self.rules.motion, seal, feed));
        // Where two strokes that the controller makes do not fit, one is nearly as long as both.
        let stroke_length = length.max(2.0 * shortest_move(self.rules.motion));
        stroke_length.clamp(seal.band.0 / 10.0, seal.band.0 / 2.0)
    }

    /// Time that a run takes beside that of its length, s.
    fn start_and_stop(&self, feed: f64) -> f64 {
        let motion = self.rules.motion;
        motion.start_delay.0 + motion.acceleration.map_or(0.0, |a| feed / a.0)
    }

    /// Time by which a run that has not stopped may seem late, s: that of its start and its stop, and of one step. Positions are rounded
    /// to steps, so that a piece of a thousandth of a millimetre may be a whole step, which takes a tenth of a second from rest to rest;
    /// the controller runs on into the next piece, whose end is judged.
    fn unfinished(&self, feed: f64) -> f64 {
        self.start_and_stop(feed) + step_seconds(self.rules.motion, feed)
    }

    /// Reports a step that takes the contact off its schedule, or a run that is itself too early or too late. Until it
    /// has `stopped`, a run may be late by what it takes to start and to stop, and by a step.
    fn on_time(&mut self, step: &Move, stopped: bool, findings: &mut Findings) {
        let (speed, feed) = (self.rule.seal.speed.0, step.feed.unwrap_or(0.0) / 60.0);
        let Schedule { due, spent, stop, .. } = self.schedule;
        let error = spent - due;
        let quantum = self.rules.dwell_step;
        let allowed = MEAN * due + 0.6 * quantum + 0.01;
        // One run alone may be early or late by a dwell's step.
        let tolerance_of_stroke = MEAN * (due - stop.0) + quantum + 0.015;
        let lateness = if stopped { 0.0 } else { self.unfinished(feed) };
        let errors = [(error, allowed), (error - stop.1, tolerance_of_stroke)];
        if !errors.iter().all(|(error, most)| -most <= *error && *error <= most + lateness) {
            let fault = format!("{error:+.3} s off the schedule of {speed} mm/s");
            findings.add_at(FindingCode::WrongFeed, step.line, fault, format!("{allowed:.3} s"));
            self.schedule = Schedule::default();
        } else if stopped {
            self.schedule.stop = (due, error);
        }
    }
}

impl Judge for Paced<'_> {
    fn step(&mut self, step: &Move, findings: &mut Findings) {
        self.judge_pending(findings);
        let phase;
        (phase, self.rule) = self.rules.follow(&mut self.count, step);
        if phase == Phase::Clear {
            self.schedule = Schedule::default();
        } else if step.kind == MoveKind::Feed {
            self.pending = Some((*step, 0.0));
        }
        // A rapid there is reported with the heat: there is no feed to judge.
    }

    /// The wait for a seam to cool is none of its last stroke.
    fn comment(&mut self, comment: &Comment, findings: &mut Findings) {
        if comment.key() == Some("cool") {
            self.judge_pending(findings);
        }
    }

    fn dwell(&mut self, dwell: &Dwell, _: &mut Findings) {
        if let Some((_, rest)) = &mut self.pending {
            *rest += dwell.seconds;
        }
    }

    fn end(&mut self, findings: &mut Findings) {
        self.judge_pending(findings);
    }
}

/// The lowest speed that the controller holds all along `path`, on an arc looked at in seventeen places of it; `lowest_of` is
/// that of a displacement.
fn lowest_along(path: &Segment, rise: f64, lowest_of: impl Fn([f64; 3]) -> Option<f64>) -> Option<f64> {
    let length = path.length();
    let places = if matches!(path, Segment::Line(_)) { 0 } else { 16 };
    (0..=places)
        .map(|i| path.tangent(f64::from(i) / 16.0))
        .map(|tangent| lowest_of([tangent.x * length, tangent.y * length, rise]))
        .try_fold(0.0, |worst: f64, lowest| Some(worst.max(lowest?)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::judge::stroke::stroke_seconds;
    use geom::{Line, Point};
    use spec::units::Acceleration;
    use spec::{Motion, StepRate};

    fn close(actual: f64, expected: f64) {
        assert!((actual / expected - 1.0).abs() < 1e-12, "{actual}, expected {expected}");
    }

    /// From rest to rest: L / v + v / a where the speed is reached, 2 sqrt(L / a) where it is not.
    #[test]
    fn a_stroke_takes_what_speeding_up_leaves_it() {
        let seconds = |length: f64, acceleration: Option<f64>| {
            let acceleration = acceleration.map(Acceleration);
            let motion = Motion { acceleration, ..Motion::UNKNOWN };
            stroke_seconds(&motion, [0.0; 3], [length, 0.0, 0.0], 4.0)
        };
        close(seconds(10.0, None), 2.5);
        close(seconds(10.0, Some(8.0)), 2.5 + 0.5);
        close(seconds(0.5, Some(8.0)), 2.0 * (0.5_f64 / 8.0).sqrt());
        // Just reached: both at once.
        close(seconds(2.0, Some(8.0)), 1.0);
    }

    /// 30.52 steps/s at the least: along a way of (4 cos 30, 4 sin 30, 3) mm Z steps most often, 400 x 3 times in 5 mm.
    #[test]
    fn a_climb_counts_with_its_length() {
        let motion = Motion {
            steps_per_mm: Some([80.0, 100.0, 400.0]),
            step_rate: StepRate::AtLeast(30.52),
            ..Motion::UNKNOWN
        };
        let line: Segment = Line::new(Point::ORIGIN, Point::polar(4.0, 30_f64.to_radians())).into();
        let lowest = |rise: f64| lowest_along(&line, rise, |way| motion.lowest_speed(way)).expect("known");
        close(lowest(3.0), 30.52 * 5.0 / 1200.0);
        close(lowest(-3.0), lowest(3.0));
        // Level, it is X: 80 x 4 cos 30 times in 4 mm, more often than Y.
        close(lowest(0.0), 30.52 / (80.0 * 30_f64.to_radians().cos()));
    }
}
