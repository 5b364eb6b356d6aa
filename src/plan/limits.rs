//! Limits that lines of the profile set: the seal's speed and the job's time must fit into them.

use crate::design::{Refusal, RefusalCode, Refusals};
use crate::plan::Program;
use crate::spec::{Machine, Spec, key};

/// A longer time without a move than any job has, s: a day.
const DAY: f64 = 86400.0;

/// Every limit in the profile's `start` that contradicts the seal's speed or the time of `programs`.
pub fn contradictions(spec: &Spec, machine: &Machine, programs: &[Program]) -> Refusals {
    let limits = &machine.script.limits;
    let mut refusals = Refusals::new();
    let mut refuse = |found: String, remedy: String| {
        refusals.push(Refusal::new(key::machine::PROFILE, RefusalCode::ProfileLimit, found, remedy));
    };
    if let Some(top) = limits.top_speed.filter(|top| top.0 < spec.seal.speed.0) {
        refuse(
            format!("`start` of the profile limits moves to {top}, the seal's speed is {}", spec.seal.speed),
            "VELOCITY must be at least the seal's speed: change that line".to_owned(),
        );
    }
    let longest = programs.iter().map(|program| program.time).fold(0.0, f64::max).min(DAY);
    if let Some(timeout) = limits.idle_timeout.filter(|timeout| timeout.0 < longest) {
        refuse(
            format!("`start` of the profile switches the heater off after {timeout} without a move"),
            format!("TIMEOUT must be at least the program's time, {longest:.0} s: change that line"),
        );
    }
    refusals
}
