//! Every reason for which a machine cannot run the programs.

use crate::design::Refusals;
use crate::plan::Program;
use crate::plan::job_size::too_large;
use crate::plan::keep_out::clamp_in_the_way;
use crate::plan::lowest_feed::{feed_floor, steep_ramp};
use crate::spec::{Machine, Spec};

/// Every reason for which `machine` cannot run the sealing programs, or the traces, as they are.
pub fn refusals(spec: &Spec, machine: &Machine, seals: &[Program], traces: &[Program]) -> Refusals {
    // What follows goes through all moves.
    if let Some(refusal) = too_large(spec, seals) {
        return refusal.into();
    }
    let mut refusals: Refusals = feed_floor(spec, machine, seals).into_iter().collect();
    refusals.extend(steep_ramp(spec, machine, seals));
    for zone in &machine.bench.keep_out {
        let found = clamp_in_the_way(spec, machine, seals, zone);
        refusals.extend(found.or_else(|| clamp_in_the_way(spec, machine, traces, zone)));
    }
    refusals
}
