//! The iron's speed in contact: as told, at a feed that the controller holds, or made of strokes and dwells.
//!
//! A **stroke** is a move that a dwell follows. Its schedule is the seal's speed: however it is chopped, a contact must
//! never be off its schedule by more than 0.2 % and a dwell's step, nor a stroke on its own.

use crate::geom::Segment;
use crate::spec::{FeedFloor, Motion};
use crate::verify::judge::expected::Expected;
use crate::verify::read::gcode::{Move, MoveKind, Program};
use crate::verify::{FindingCode, Findings};

/// How far the mean speed may be off.
const MEAN: f64 = 0.002;
/// Slack on lengths and feeds, which are rounded in the file.
const ROUNDING: f64 = 1e-3;

/// What the iron owes and has spent in one contact, s.
#[derive(Default)]
struct Schedule {
    due: f64,
    spent: f64,
}

/// Reports every move below travel height (told by `low`) that is too fast or too slow.
pub(in crate::verify) fn check(
    expected: &Expected<'_>,
    program: &Program,
    low: impl Fn(&Move) -> bool,
    findings: &mut Findings,
) {
    let (speed, motion) = (expected.spec.seal.speed.0, &expected.machine.motion);
    let may_chop = expected.spec.machine.feed_floor == FeedFloor::Chop;
    let longest = expected.spec.seal.band.0 / 10.0;
    let mut dwells = program.dwells.iter().peekable();
    let mut schedule = Schedule::default();
    let mut steps = program.moves.iter().peekable();
    while let Some(step) = steps.next() {
        if !low(step) {
            schedule = Schedule::default();
            continue;
        }
        if step.kind == MoveKind::Rapid {
            // Reported with the heat: there is no feed to judge.
            continue;
        }
        let Some(feed) = step.feed.map(|feed| feed / 60.0) else {
            findings.add(FindingCode::WrongFeed, step.line, "none", format!("F{}", speed * 60.0));
            continue;
        };
        while dwells.next_if(|dwell| dwell.line < step.line).is_some() {}
        let next = steps.peek().map_or(usize::MAX, |next| next.line);
        let mut rest = 0.0;
        while let Some(dwell) = dwells.next_if(|dwell| dwell.line < next) {
            rest += dwell.seconds;
        }
        let as_told = (feed - speed).abs() <= ROUNDING * speed;
        let length = step.length();
        let before = schedule.spent - schedule.due;
        schedule.due += length / speed;
        if as_told {
            // A short wait is no fault of speed; how long it may be, the rest is judged by.
            schedule.spent += length / feed;
        } else if may_chop {
            schedule.spent += move_time(length, feed, motion.acceleration.map(|a| a.0)) + rest;
            if length > longest + 0.01 {
                let found = format!("a stroke of {length:.3} mm");
                findings.add(FindingCode::LongStroke, step.line, found, format!("at most {longest:.3} mm"));
            }
        } else {
            let (found, allowed) = (format!("F{}", feed * 60.0), format!("F{}", speed * 60.0));
            findings.add(FindingCode::WrongFeed, step.line, found, allowed);
            continue;
        }
        let off = schedule.spent - schedule.due;
        let quantum = expected.machine.controller.dwell.step.0;
        let allowed = MEAN * schedule.due + 0.6 * quantum + 0.01;
        // One stroke alone may be early or late by a dwell's step.
        let alone = MEAN * length / speed + quantum + 0.015;
        if off.abs() > allowed || (off - before).abs() > alone {
            let found = format!("{off:+.3} s off the schedule of {speed} mm/s");
            findings.add(FindingCode::WrongFeed, step.line, found, format!("{allowed:.3} s"));
            schedule = Schedule::default();
        }
        let lowest = step.path.and_then(|path| lowest_speed(motion, &path, step.to.z - step.from.z));
        if let Some(lowest) = lowest.filter(|lowest| feed < lowest * (1.0 - ROUNDING)) {
            let found = format!("F{:.3}, which the controller runs at {:.3}", feed * 60.0, lowest * 60.0);
            findings.add(
                FindingCode::BelowFloor,
                step.line,
                found,
                format!("at least F{:.3}", lowest * 60.0),
            );
        }
    }
}

/// Time from rest to rest, s: the controller speeds up, and slows down, as fast as it may.
fn move_time(length: f64, speed: f64, acceleration: Option<f64>) -> f64 {
    let Some(a) = acceleration else { return length / speed };
    // Half the way is for speeding up, if the speed is not reached before.
    let reached = speed.min((a * length).sqrt());
    let flat = length - reached * reached / a;
    2.0 * reached / a + flat / reached
}

/// The lowest speed that the controller holds all along `path`, looked at in seventeen places of it.
fn lowest_speed(motion: &Motion, path: &Segment, rise: f64) -> Option<f64> {
    let length = path.length();
    let at = |t: f64| {
        let u = path.tangent(t);
        motion.lowest_speed([u.x * length, u.y * length, rise])
    };
    (0..=16).map(|i| at(f64::from(i) / 16.0)).try_fold(0.0, |worst: f64, lowest| Some(worst.max(lowest?)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Line, Point};
    use crate::spec::StepRate;

    fn close(found: f64, expected: f64) {
        assert!((found / expected - 1.0).abs() < 1e-12, "{found}, expected {expected}");
    }

    /// From rest to rest: L / v + v / a where the speed is reached, 2 sqrt(L / a) where it is not.
    #[test]
    fn a_stroke_takes_what_speeding_up_leaves_it() {
        close(move_time(10.0, 4.0, None), 2.5);
        close(move_time(10.0, 4.0, Some(8.0)), 2.5 + 0.5);
        close(move_time(0.5, 4.0, Some(8.0)), 2.0 * (0.5_f64 / 8.0).sqrt());
        // Just reached: both at once.
        close(move_time(2.0, 4.0, Some(8.0)), 1.0);
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
        let found = |rise: f64| lowest_speed(&motion, &line, rise).expect("known");
        close(found(3.0), 30.52 * 5.0 / 1200.0);
        close(found(-3.0), found(3.0));
        // Level, it is X: 80 x 4 cos 30 times in 4 mm, more often than Y.
        close(found(0.0), 30.52 / (80.0 * 30_f64.to_radians().cos()));
    }
}
