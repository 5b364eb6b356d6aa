//! Every reason for which a machine cannot run the programs.

use crate::plan::Program;
use crate::plan::job_size::too_long;
use crate::plan::keep_out::clamps_in_the_way;
use crate::plan::lowest_feed::feed_floor;
use crate::plan::ramps::too_steep;
use design::{Refusal, RefusalCode, Refusals};
use spec::units::Speed;
use spec::{Machine, SealProcess, Spec, key};

/// Every reason for which `machine` cannot run the sealing programs, or the traces, as they are.
pub fn refusals(spec: &Spec, machine: &Machine, seals: &[Program], traces: &[Program]) -> Refusals {
    // The checks below go through all moves.
    if let Some(refusal) = too_long(spec, seals) {
        return refusal.into();
    }
    let mut refusals: Refusals = feed_floor(spec, machine, seals).into_iter().collect();
    refusals.extend(deep_contacts(spec, machine, seals));
    refusals.extend(contradictions(spec, machine, seals));
    refusals.extend(too_steep(spec, machine, seals));
    refusals.extend(clamps_in_the_way(spec, machine, seals, traces));
    refusals
}

/// A refusal for each process that presses a tip without a spring into the bed.
fn deep_contacts(spec: &Spec, machine: &Machine, programs: &[Program]) -> Refusals {
    let (lowest, mut names) = (machine.process.lowest_contact(), Vec::new());
    let mut refusals = Refusals::new();
    for process in programs.iter().flat_map(|program| &program.processes).map(|paced| &paced.process) {
        let Some(height) = process.seal.height.filter(|height| *height < lowest) else { continue };
        if names.contains(&&process.name) {
            continue;
        }
        names.push(&process.name);
        let key = if process.is_default() { key::seal::HEIGHT } else { key::process::HEIGHT };
        let fault = format!(
            "the height in contact is {height}, and the tip of the profile {} has no spring",
            machine.name
        );
        let remedy = format!(
            "must be at least {lowest}; or `spring_loaded = true` in the profile, if the tip has one"
        );
        refusals.push(of_process(spec, process, Refusal::new(key, RefusalCode::DeepContact, fault, remedy)));
    }
    refusals
}

/// `refusal` of a spec whose `[seal]` is `process`, as one of the process in `spec`.
pub(super) fn of_process(spec: &Spec, process: &SealProcess, refusal: Refusal) -> Refusal {
    let place = spec.processes.iter().position(|own| own.name == process.name);
    let Some(place) = place else { return refusal };
    let key = match refusal.key {
        key::seal::SPEED => key::process::SPEED,
        key => key,
    };
    Refusal {
        key: key.of_process(place),
        found: format!("process {}: {}", process.name, refusal.found),
        ..refusal
    }
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
    let processes = programs.iter().flat_map(|program| &program.processes);
    let fastest = processes.map(|paced| paced.process.seal.speed.0).fold(spec.seal.speed.0, f64::max);
    if let Some(top) = limits.top_speed.filter(|top| top.0 < fastest) {
        refuse(
            format!("`start` of the profile limits moves to {top}, the seal's speed is {}", Speed(fastest)),
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
