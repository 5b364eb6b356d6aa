//! The judge: compares the moves of programs with the comments of the old one, by the verifier's own rules, and with the profile's limits.

use crate::resume::header::StatedProcess;
use crate::resume::record::Record;
use geom::Bounds;
use proof::verify::{Finding, FindingCode, judge_iron};
use spec::units::Speed;
use spec::{Limits, limits_set_by};

/// The first move of a program that breaks the rules of the old one, or leaves its `reach`.
pub(super) fn first_fault(record: &Record, text: &str, reach: &Bounds) -> Option<Finding> {
    // An arc of a file passes its own ends within the tolerance.
    let reach = &reach.outset(record.path.0);
    let lines = text.split_inclusive('\n');
    judge_iron(&record.rules(text), reach, &record.controller, lines).into_iter().next()
}

/// Tolerance of rounded numbers in a file, as a fraction.
const SLACK: f64 = 1e-6;
/// Longest time without a move in any job, s: a day.
const DAY: f64 = 86400.0;

/// The first line before the first move whose limits contradict the seal, the travels or the `seconds` of the program.
pub(super) fn contradiction(record: &Record, text: &str, seconds: f64) -> Option<Finding> {
    // Settings after the first move do not come from a profile; the judge of programs refuses them all.
    let mut head = text.lines().zip(1..).take_while(|(line, _)| !line.starts_with("G0"));
    head.find_map(|(line, number)| {
        let allowed = wrong(record, limits_set_by(line, &record.controller)?, seconds)?;
        Some(Finding::in_line(FindingCode::ProfileLine, number, line, allowed))
    })
}

/// The required value instead of `set`, if `set` contradicts the program.
fn wrong(record: &Record, set: Limits, seconds: f64) -> Option<String> {
    let feeds: Vec<f64> = record.all_processes().map(StatedProcess::feed).collect();
    let contact = feeds.iter().copied().fold(f64::INFINITY, f64::min);
    let acceleration = record.stated_acceleration();
    let fastest = feeds.into_iter().fold(record.process.travel_speed.0, f64::max);
    let longest = seconds.min(DAY);
    match (set, acceleration) {
        (Limits { lowest_speed: Some(lowest), .. }, _) if lowest.0 > contact * (1.0 + SLACK) => {
            Some(format!("a lowest speed of at most {}", Speed(contact)))
        }
        (Limits { top_speed: Some(top), .. }, _) if top.0 < fastest * (1.0 - SLACK) => {
            Some(format!("a top speed of at least {}", Speed(fastest)))
        }
        (Limits { acceleration: Some(found), .. }, Some(a)) if (found.0 - a).abs() > SLACK * a => {
            Some(format!("an acceleration of {a} mm/s^2"))
        }
        (Limits { idle_timeout: Some(timeout), .. }, _) if timeout.0 < longest => {
            Some(format!("at least {longest:.0} s"))
        }
        _ => None,
    }
}
