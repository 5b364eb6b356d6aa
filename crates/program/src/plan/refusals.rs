//! Every reason for which a machine cannot run the programs.

use crate::plan::job_size::too_long;
use crate::plan::keep_out::clamps_in_the_way;
use crate::plan::laser::high_focus;
use crate::plan::lowest_feed::feed_floor;
use crate::plan::process_refusal::of_process;
use crate::plan::program::{distinct_processes, lowest_contact};
use crate::plan::ramps::too_steep;
use crate::plan::{Program, Purpose};
use design::{Refusal, RefusalCode, Refusals};
use spec::units::{Length, Speed};
use spec::{Machine, Service, Spec, key};

/// Every reason for which `machine` cannot run the sealing programs, or the traces, as they are.
pub fn refusals(spec: &Spec, machine: &Machine, seals: &[Program], traces: &[Program]) -> Refusals {
    // The checks below go through all moves.
    if let Some(refusal) = too_long(spec, seals) {
        return refusal.into();
    }
    let mut refusals: Refusals = feed_floor(spec, machine, seals).into_iter().collect();
    refusals.extend(deep_contacts(spec, machine, seals));
    refusals.extend(high_focus(spec, machine, seals));
    refusals.extend(clamped_contacts(machine, seals));
    refusals.extend(contradictions(spec, machine, seals));
    refusals.extend(too_steep(spec, machine, seals));
    refusals.extend(clamps_in_the_way(spec, machine, seals, traces));
    refusals
}

/// A refusal for each process that presses a tip without a spring into the bed.
fn deep_contacts(spec: &Spec, machine: &Machine, programs: &[Program]) -> Refusals {
    let lowest = machine.process.lowest_contact();
    let mut refusals = Refusals::new();
    for process in distinct_processes(programs) {
        let Some(height) = process.seal.height.filter(|height| *height < lowest) else { continue };
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

/// A refusal if the lowest contact is below the zero of a machine that homes and then clamps Z to 0: the iron would not press, and
/// nothing would tell.
fn clamped_contacts(machine: &Machine, programs: &[Program]) -> Option<Refusal> {
    let (dialect, script) = (machine.controller.dialect, &machine.script);
    let is_free = script.services.contains(&Service::EndstopsOff);
    if !script.homes() || is_free || !Service::can_free_endstops(dialect) {
        return None;
    }
    let lowest = machine.controller.place.surface.0 + lowest_contact(machine, programs)?.0;
    // Heights are whole micrometres.
    if lowest > -1e-6 {
        return None;
    }
    let fault = format!(
        "the machine homes, and the contact is at its Z {}, which {} lifts to 0",
        Length(lowest),
        dialect.title()
    );
    let remedy = "`start` of the profile must turn the soft endstops off after G28 (M211 S0; RepRapFirmware M564 S0; Bambu M211 X0 Y0 \
                  Z0), or `surface` must be higher";
    Some(Refusal::new(key::machine::PROFILE, RefusalCode::ClampedContact, fault, remedy))
}

/// The task of the operator of `machine` whose programs count in the coordinates of a machine that homes, and do not home it: an axis
/// that is not homed goes elsewhere, and may press the tip into the bed.
pub fn homing_by_hand(machine: &Machine) -> Option<&'static str> {
    let is_homed = machine.script.homes() || machine.controller.place.is_origin();
    (!is_homed).then_some("X, Y and Z homed first: the program does not home them")
}

/// A longer time without a move than any job has, s: a day.
const DAY: f64 = 86400.0;

/// Every limit in the profile's `start` that contradicts the seal's speed or the time of `programs`.
pub(super) fn contradictions(spec: &Spec, machine: &Machine, programs: &[Program]) -> Refusals {
    let limits = &machine.script.limits;
    let mut refusals = Refusals::new();
    let processes = programs.iter().flat_map(|program| &program.processes);
    let fastest = processes.map(|paced| paced.process.seal.speed.0).fold(spec.seal.speed.0, f64::max);
    let is_cut = programs.iter().any(|program| program.purpose == Purpose::Cut);
    let work = if is_cut { "cut" } else { "seal" };
    if let Some(top) = limits.top_speed.filter(|top| top.0 < fastest) {
        refusals.push(beyond_limit(
            format!("`start` of the profile limits moves to {top}, the {work}'s speed is {}", Speed(fastest)),
            format!("VELOCITY must be at least the {work}'s speed: change that line"),
        ));
    }
    let longest = programs.iter().map(|program| program.time).fold(0.0, f64::max).min(DAY);
    if let Some(timeout) = limits.idle_timeout.filter(|timeout| timeout.0 < longest) {
        refusals.push(beyond_limit(
            format!("`start` of the profile switches the heater off after {timeout} without a move"),
            format!("TIMEOUT must be at least the program's time, {longest:.0} s: change that line"),
        ));
    }
    refusals
}

fn beyond_limit(fault: String, remedy: String) -> Refusal {
    Refusal::new(key::machine::PROFILE, RefusalCode::ProfileLimit, fault, remedy)
}
