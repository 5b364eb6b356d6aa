//! Every reason for which a machine cannot run the programs.

use crate::design::Refusals;
use crate::plan::Program;
use crate::plan::job_size::too_long;
use crate::plan::keep_out::clamps_in_the_way;
use crate::plan::limits::contradictions;
use crate::plan::lowest_feed::feed_floor;
use crate::plan::ramps::too_steep;
use crate::spec::{Machine, Spec};

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
