//! A laser in place of an iron: its own refusals, and what protects the people around it.

use crate::plan::Program;
use crate::plan::process_refusal::of_process;
use crate::plan::program::distinct_processes;
use design::{Refusal, RefusalCode, Refusals};
use spec::{Controller, Dialect, LaserDrive, Machine, Spec, key};

/// What every program of a laser says, and every command before it. Each fits into a comment of the shortest line.
pub const LASER_SAFETY: [&str; 3] = [
    "goggles for the wavelength on, for everybody in the room",
    "enclosure closed, fumes drawn off, never alone: it sets fire",
    "no PVC and no vinyl: their fumes are toxic and corrode",
];

/// The settings on which a program for the laser `drive` of `controller` relies, each a short line.
pub fn laser_settings(controller: &Controller, drive: LaserDrive) -> [String; 2] {
    let LaserDrive { full_power } = drive;
    if controller.dialect == Dialect::FluidNc {
        return [
            "a Laser spindle in the configuration, for M4".to_owned(),
            format!("S{full_power} at the end of its speed_map, full power"),
        ];
    }
    [
        "$32=1, laser mode: no beam in G0 and at rest".to_owned(),
        format!("$30={full_power}, the S of full power"),
    ]
}

/// The refusal of a laser for a spec of an iron, or of an iron for a spec with `power`; `None` if both agree.
pub fn no_laser(spec: &Spec, machine: &Machine) -> Option<Refusal> {
    let fault = match (machine.controller.laser, spec.seal.power) {
        (Some(_), None) => format!("{} is a laser, and [seal] has no `power`", machine.name),
        (None, Some(power)) => format!("`power` in [seal] is {power}, and {} is no laser", machine.name),
        (Some(_), Some(_)) | (None, None) => return None,
    };
    let remedy =
        "write a profile with tool = \"laser\" in [machine], and `power` and `tip` in [seal]; or neither";
    Some(Refusal::new(key::machine::PROFILE, RefusalCode::NoLaser, fault, remedy))
}

/// A refusal for each process whose focus is not below the height of travels: the laser would go up to weld.
pub(super) fn high_focus(spec: &Spec, machine: &Machine, programs: &[Program]) -> Refusals {
    let travel = machine.process.heights.travel;
    let mut refusals = Refusals::new();
    for process in distinct_processes(programs) {
        let focus = process.seal.contact(&machine.process);
        if machine.controller.laser.is_none() || focus.0 < travel.0 {
            continue;
        }
        let key = if process.is_default() { key::seal::FOCUS } else { key::process::FOCUS };
        let fault = format!("the focus is {focus} above the sheet, and travels are {travel} above it");
        let remedy = "must be lower than `travel` in [heights] of the profile: raise that, or lower `focus`";
        refusals.push(of_process(spec, process, Refusal::new(key, RefusalCode::HighFocus, fault, remedy)));
    }
    refusals
}
