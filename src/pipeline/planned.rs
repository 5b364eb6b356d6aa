//! The first state: a gripper with its geometry and programs.

use crate::airtight;
use design::{Design, Refusal, RefusalCode, Refusals};
use forecast::predict::PredictFault;
use program::plan;
use program::plan::{Program, Step};
use proof::artifact::{Format, Kind, KindRequest, has_mjcf, takes_packages};
use spec::{Machine, SealingTool, Spec, key};

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
    /// The programs that cut the sheets after the seal.
    pub cuts: Vec<Program>,
}

/// The programs of `design`, in which the inlet is the only opening for air.
pub(super) fn planned(spec: Spec, machine: Machine, design: Design) -> Result<Planned, Refusals> {
    airtight::leaks(&spec, &machine, &design).or_value(())?;
    if machine.tool == SealingTool::Press || spec.press.is_some() {
        return pressed(spec, machine, design);
    }
    let other_tool: Refusals = plan::no_laser(&spec, &machine).into_iter().collect();
    other_tool.or_value(())?;
    // The size is checked before the programs are made: they may exceed the memory.
    let too_many: Refusals = plan::too_many_moves(&spec, &machine, &design).into_iter().collect();
    too_many.or_value(())?;
    let without_marks: Refusals = plan::no_marks(&spec, &design).into_iter().collect();
    without_marks.or_value(())?;
    let programs = plan::seal_programs(&spec, &machine, &design);
    let traces = plan::trace_programs(&spec, &machine, &design);
    let mut refusals = plan::refusals(&spec, &machine, &programs, &traces);
    refusals.extend(plan::pressed_beyond(&spec, &machine, &design));
    let cuts = plan::cut_programs(&spec, &machine, &design);
    refusals.extend(plan::cut_refusals(&spec, &machine, &design, &programs, &cuts));
    if let Some(alignment) = design.alignment {
        let remedy = "lay the sheet nearer to its place";
        let programs = programs.iter().chain(&traces).filter(|program| program.sheet == alignment.sheet);
        let steps: Vec<Step> = programs.flat_map(|program| program.steps.clone()).collect();
        refusals.extend(plan::refusal_beyond(&machine, "the moved sheet", &steps, remedy));
    }
    refusals.or_value(Planned { spec, machine, design, programs, traces, cuts })
}

/// A design that a press seals without programs.
fn pressed(spec: Spec, machine: Machine, design: Design) -> Result<Planned, Refusals> {
    let is_press = machine.tool == SealingTool::Press;
    let refusal = (is_press != spec.press.is_some()).then(|| {
        let problem = if is_press {
            format!("{} is a heat press, and the spec has no [press]", machine.name)
        } else {
            format!("the spec has [press], and {} is no heat press", machine.name)
        };
        let remedy = "write profile = \"press\" in [machine], and the section [press]";
        Refusal::new(key::machine::PROFILE, RefusalCode::NoPress, problem, remedy)
    });
    let refusals: Refusals = refusal.into_iter().collect();
    refusals.or_value(Planned {
        spec,
        machine,
        design,
        programs: Vec::new(),
        traces: Vec::new(),
        cuts: Vec::new(),
    })
}

/// The refusal of `subject`, which is made of programs, for a press that runs none; `None` for a machine with an iron.
pub fn no_programs(spec: &Spec, subject: &str) -> Option<Refusal> {
    let _ = spec.press.as_ref()?;
    let problem = format!("{subject} needs a program, and a heat press runs none");
    let remedy = "ask for separator-svg, outline-svg or press-plan, or name a machine with an iron";
    Some(Refusal::new(key::machine::PROFILE, RefusalCode::NoPrograms, problem, remedy))
}

/// The refusal of `kind`, a package, for a machine that takes none; `None` for one that does, and for other kinds.
fn no_package(machine: &Machine, kind: Kind) -> Option<Refusal> {
    let dialect = machine.controller.dialect;
    if kind.format() != Format::Package || takes_packages(dialect) {
        return None;
    }
    let problem = format!("{kind} is for Bambu Lab's printers; {} reads plain G-code", dialect.title());
    let remedy = "ask for seal-gcode, trace-gcode or cut-gcode, or name profile = \"bambu\" in [machine]";
    Some(Refusal::new(key::machine::PROFILE, RefusalCode::NoPackage, problem, remedy))
}

/// The refusal of a model for MuJoCo, for a spec without stars at a pressure; `None` for one with.
fn no_mjcf(spec: &Spec) -> Option<Refusal> {
    if has_mjcf(spec) {
        return None;
    }
    let problem = "mjcf is the model of stars at their pressure";
    let remedy = "set `pressure` in [load]; a [drawing] has no such model";
    Some(Refusal::new(key::load::PRESSURE, RefusalCode::NoPrediction, problem, remedy))
}

/// Refuses a model for MuJoCo that `spec` does not have, and the first program that `request` names and `machine` does not run: any for a press,
/// a package for most machines.
///
/// # Errors
/// The refusal, if the request names such a file.
pub fn no_requested_programs(spec: &Spec, machine: &Machine, request: &KindRequest) -> Result<(), Refusals> {
    let mut programs = request.only.iter().chain(&request.with).filter(|kind| kind.is_program());
    let refusal =
        programs.find_map(|kind| no_programs(spec, kind.name()).or_else(|| no_package(machine, *kind)));
    let is_model_requested =
        request.clone().of_spec(spec).with.contains(&Kind::Mjcf) || request.only.contains(&Kind::Mjcf);
    let refusal = refusal.or_else(|| no_mjcf(spec).filter(|_| is_model_requested));
    refusal.into_iter().collect::<Refusals>().or_value(())
}

/// A failed prediction, as a refusal at the key that causes it.
pub fn no_prediction(fault: &PredictFault) -> Refusal {
    let key = fault.star.map_or(fault.key, |star| fault.key.of_star(star));
    let remedy = fault.remedy.clone().unwrap_or_else(|| "needed for a prediction".to_owned());
    Refusal::new(key, fault.code, fault.what.clone(), remedy)
}
