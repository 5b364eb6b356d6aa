//! Every reason for which a machine cannot run the programs.

use crate::plan::Program;
use crate::plan::job_size::too_long;
use crate::plan::keep_out::clamps_in_the_way;
use crate::plan::lowest_feed::feed_floor;
use crate::plan::ramps::too_steep;
use design::{Refusal, RefusalCode, Refusals};
use spec::{Machine, Spec, key};

/// Every reason for which `machine` cannot run the sealing programs, or the traces, as they are.
pub fn refusals(spec: &Spec, machine: &Machine, seals: &[Program], traces: &[Program]) -> Refusals {
    // The checks below go through all moves.
    if let Some(refusal) = too_long(spec, seals) {
        return refusal.into();
    }
    let mut refusals: Refusals = feed_floor(spec, machine, seals).into_iter().collect();
    refusals.extend(contradictions(spec, machine, seals));
    refusals.extend(too_steep(spec, machine, seals));
    refusals.extend(clamps_in_the_way(spec, machine, seals, traces));
    refusals
}

/// A longer time without a move than any job has, s: a day.
const DAY: f64 = 86400.0;

/// Every limit in the profile's `start` that contradicts the seal's speed or the time of `programs`.
pub(super) fn contradictions(spec: &Spec, machine: &Machine, programs: &[Program]) -> Refusals {
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
