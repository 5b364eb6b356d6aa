//! The programs to judge: those of a spec for a machine, as text.

use stargrip_cam::coupon::{CouponGroup, StripGrid, coupons};
use stargrip_cam::emit;
use stargrip_cam::pipeline::Planned;
use stargrip_cam::plan::feed_checks;
use stargrip_cam::spec::{Bench, Machine, Source, Spec, builtin_machine, read, read_machine};
use stargrip_cam::units::{Length, Speed, Temperature};

use super::controller::{Board, Motors};
use super::marlin::Version;

/// A program with its name.
pub(crate) type Named = (String, String);

/// Every dialect with a profile, and whether its controller has a lowest step rate.
pub(crate) use crate::{PROFILES as DIALECTS, all_profiles, chop_section, has_floor};

/// The built-in profile, on a machine with these motors.
pub(crate) fn machine(dialect: &str, motors: Motors) -> Machine {
    adapted(builtin_machine(dialect).expect("built in"), has_floor(dialect), motors)
}

/// The profile of Marlin, adapted to a board as its comments advise.
pub(crate) fn machine_of_marlin(motors: Motors, board: Board) -> Machine {
    let mut text = builtin_machine("marlin").expect("built in").to_owned();
    let mut replace = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    };
    if board.bits == 32 {
        replace("min_step_rate = 32", "min_step_rate = 1");
    }
    if board.version == Version::Newest {
        replace("first_step_rate = 120", "first_step_rate = \"none\"");
    }
    adapted(&text, true, motors)
}

/// The profile of an Ender-3 with Marlin of this version.
pub(crate) fn machine_of_ender(motors: Motors, version: Version) -> Machine {
    let text = builtin_machine("ender").expect("built in");
    let rate = if version == Version::Two { "120" } else { "\"none\"" };
    let profile = text.replace("first_step_rate = 120", &format!("first_step_rate = {rate}"));
    adapted(&profile, true, motors)
}

fn adapted(text: &str, has_floor: bool, motors: Motors) -> Machine {
    let lines = text.lines().map(|line| {
        let key = line.split(' ').next().unwrap_or_default();
        match key {
            "x_steps_per_mm" | "y_steps_per_mm" if has_floor => {
                format!("{key} = {}", motors.steps_per_mm)
            }
            "z_steps_per_mm" if has_floor => format!("{key} = {}", motors.steps_per_mm.max(400.0)),
            "acceleration" => format!("{key} = \"{} mm/s^2\"", motors.acceleration),
            _ => line.to_owned(),
        }
    });
    let text = lines.collect::<Vec<_>>().join("\n");
    let machine = read_machine(&Source::new("machine", &text)).unwrap_or_else(|faults| panic!("{faults}"));
    // Some designs are larger than the bed of a printer.
    Machine { bench: Bench::default(), ..machine }
}

/// The spec `text`, chopped where the controller needs it.
pub(crate) fn spec(dialect: &str, text: &str) -> Spec {
    read(&Source::new("spec", format!("{text}\n{}", chop_section(dialect))))
        .unwrap_or_else(|faults| panic!("{faults}"))
        .spec
}

/// The sealing programs, and the traces.
pub(crate) fn seals(spec: &Spec, machine: &Machine) -> (Vec<Named>, Vec<Named>) {
    let planned =
        Planned::new(spec.clone(), machine.clone()).unwrap_or_else(|refusals| panic!("{refusals:?}"));
    let named = |kind: &str, programs: &[stargrip_cam::plan::Program]| {
        let text = |program| emit::gcode(spec, machine, program);
        programs.iter().map(|program| (format!("{kind} {:?}", program.numbers()), text(program))).collect()
    };
    (named("seal", &planned.programs), named("trace", &planned.traces))
}

pub(crate) fn feed_check(spec: &Spec, machine: &Machine) -> Named {
    let text = emit::feed_check(spec, machine, &feed_checks(spec, machine));
    // Its total begins above the sheet's corner, whose place it does not state.
    let lines = text.lines().filter(|line| !line.starts_with("; total:"));
    ("feedcheck".to_owned(), lines.collect::<Vec<_>>().join("\n"))
}

/// Strips at three speeds, and the other coupons.
pub(crate) fn coupon_programs(spec: &Spec, machine: &Machine) -> Vec<Named> {
    let grid = StripGrid {
        temperatures: vec![Temperature(200.0)],
        powers: Vec::new(),
        speeds: vec![Speed(0.1), Speed(0.2), Speed(0.5)],
        heights: vec![Length(-0.3)],
        repeats: 3,
    };
    let set = coupons(spec, machine, &grid, &CouponGroup::NAMES.map(|(_, group)| group))
        .unwrap_or_else(|refusals| panic!("{refusals:?}"));
    set.into_iter().map(|coupon| (coupon.name.clone(), coupon.gcode())).collect()
}
