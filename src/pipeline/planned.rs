//! The first state: a gripper with its geometry and programs.

use crate::airtight;
use design::{Design, Refusal, Refusals};
use forecast::predict::PredictFault;
use program::plan;
use program::plan::Program;
use spec::{Machine, Spec};

/// A gripper that the machine can seal.
#[derive(Clone, Debug)]
pub struct Planned {
    /// The parsed spec.
    pub spec: Spec,
    /// The machine profile.
    pub machine: Machine,
    /// The exact geometry.
    pub design: Design,
    /// The sealing programs.
    pub programs: Vec<Program>,
    /// The trace programs.
    pub traces: Vec<Program>,
}

/// The programs of `design`, in which the inlet is the only opening for air.
pub(super) fn planned(spec: Spec, machine: Machine, design: Design) -> Result<Planned, Refusals> {
    airtight::leaks(&spec, &machine, &design).or(())?;
    // The size is checked before the programs are made: they may exceed the memory.
    let too_many: Refusals = plan::too_many_moves(&spec, &machine, &design).into_iter().collect();
    too_many.or(())?;
    let programs = plan::seal_programs(&spec, &machine, &design);
    let traces = plan::trace_programs(&spec, &machine, &design);
    let mut refusals = plan::refusals(&spec, &machine, &programs, &traces);
    refusals.extend(plan::pressed_beyond(&machine, &design));
    refusals.or(Planned { spec, machine, design, programs, traces })
}

/// A failed prediction, as a refusal at the key that causes it.
pub fn no_prediction(fault: &PredictFault) -> Refusal {
    let key = fault.star.map_or(fault.key, |star| fault.key.of_star(star));
    let remedy = fault.remedy.clone().unwrap_or_else(|| "needed for a prediction".to_owned());
    Refusal::new(key, fault.code, fault.what.clone(), remedy)
}
