//! The iron's speed in contact: as told, at a feed that the controller holds, or made of strokes and dwells.
//!
//! A **stroke** is a move that a dwell follows. Its schedule is the seal's speed: however it is chopped, a contact must
//! never be off its schedule by more than 0.2 % and a dwell's step, nor a stroke on its own.

use crate::plan::lowest_speed;
use crate::plan::move_time;
use crate::spec::FeedFloor;
use crate::verify::Findings;
use crate::verify::gcode::Move;
use crate::verify::gcode::MoveKind;
use crate::verify::gcode::Program;
use crate::verify::proof::Truth;

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
pub(super) fn check(
    truth: Truth<'_>,
    program: &Program,
    low: impl Fn(&Move) -> bool,
    findings: &mut Findings,
) {
    let (speed, motion) = (truth.spec.seal.speed.0, &truth.machine.motion);
    let may_chop = truth.spec.machine.feed_floor == FeedFloor::Chop;
    let longest = truth.spec.seal.band.0 / 10.0;
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
            findings.add("wrong-feed", step.line, "none", format!("F{}", speed * 60.0));
            continue;
        };
        while dwells.next_if(|dwell| dwell.line < step.line).is_some() {}
        let next = steps.peek().map_or(usize::MAX, |next| next.line);
        let mut rest = 0.0;
        let mut waits = false;
        while let Some(dwell) = dwells.next_if(|dwell| dwell.line < next) {
            rest += dwell.seconds;
            waits = true;
        }
        let as_told = (feed - speed).abs() <= ROUNDING * speed;
        let length = step.length();
        let before = schedule.spent - schedule.due;
        schedule.due += length / speed;
        if as_told && !waits {
            schedule.spent += length / feed;
        } else if may_chop && !as_told {
            schedule.spent += move_time(length, feed, motion.acceleration.map(|a| a.0)) + rest;
            if length > longest + 0.01 {
                let found = format!("a stroke of {length:.3} mm");
                findings.add("long-stroke", step.line, found, format!("at most {longest:.3} mm"));
            }
        } else {
            let found = if as_told { "a dwell in contact".to_owned() } else { format!("F{}", feed * 60.0) };
            findings.add("wrong-feed", step.line, found, format!("F{}", speed * 60.0));
            continue;
        }
        let off = schedule.spent - schedule.due;
        let quantum = truth.machine.dwell.step.0;
        let allowed = MEAN * schedule.due + 0.6 * quantum + 0.01;
        // One stroke alone may be early or late by a dwell's step.
        let alone = MEAN * length / speed + quantum + 0.015;
        if off.abs() > allowed || (off - before).abs() > alone {
            let found = format!("{off:+.3} s off the schedule of {speed} mm/s");
            findings.add("wrong-feed", step.line, found, format!("{allowed:.3} s"));
            schedule = Schedule::default();
        }
        let lowest = step.path.and_then(|path| lowest_speed(motion, &path, step.to.z - step.from.z));
        if let Some(lowest) = lowest.filter(|lowest| feed < lowest * (1.0 - ROUNDING)) {
            let found = format!("F{:.3}, which the controller runs at {:.3}", feed * 60.0, lowest * 60.0);
            findings.add("below-floor", step.line, found, format!("at least F{:.3}", lowest * 60.0));
        }
    }
}
