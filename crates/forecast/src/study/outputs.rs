//! The columns of answers: values by hinge models, values that need no model, and values by shells alone.

use crate::interval::Interval;
use crate::outcome::Outcome;
use crate::shell::request::Measurements;
use crate::star_answer::mm;
use crate::study::output::{Of, OutputColumn, RangeOf, StudyRow, ValueOf};

const fn column_of_any(name: &'static str, meaning: &'static str, value: ValueOf) -> OutputColumn {
    OutputColumn { name, about: meaning, of: Of::Any(value) }
}

const fn hinges(name: &'static str, meaning: &'static str, value: ValueOf) -> OutputColumn {
    OutputColumn { name, about: meaning, of: Of::Hinges(value) }
}

const fn low(name: &'static str, range: RangeOf) -> OutputColumn {
    OutputColumn { name, about: "least end of its range", of: Of::Low(range) }
}

const fn high(name: &'static str, range: RangeOf) -> OutputColumn {
    OutputColumn { name, about: "largest end of its range", of: Of::High(range) }
}

const fn measured(name: &'static str, meaning: &'static str, value: ValueOf) -> OutputColumn {
    OutputColumn { name, about: meaning, of: Of::Shell(value) }
}

const fn open(name: &'static str, value: ValueOf) -> OutputColumn {
    measured(name, "its mesh error", value)
}

fn radius(row: &StudyRow<'_>) -> Option<Interval> {
    row.outcome()?.ranges.radius.map(|range| range.map(mm))
}

fn angle(row: &StudyRow<'_>) -> Option<Interval> {
    row.outcome()?.ranges.angle.map(|range| range.map(f64::to_degrees))
}

fn contraction(row: &StudyRow<'_>) -> Option<Interval> {
    row.outcome()?.contraction_range(&row.answer.case)
}

fn stiffness(row: &StudyRow<'_>) -> Option<Interval> {
    // Without a pressure there is no stiffness, and no range of one.
    row.outcome().filter(|outcome| outcome.stiffness.is_some())?.ranges.stiffness
}

fn force(row: &StudyRow<'_>) -> Option<Interval> {
    row.outcome()?.force_range
}

fn payload(row: &StudyRow<'_>) -> Option<Interval> {
    row.answer.payload_range
}

/// Values by hinge models, and values that need no model, in order. Lengths mm, angles deg. `sweep --vary` has these columns alone: they and
/// their order do not change.
pub(super) const PLAIN: [OutputColumn; 20] = [
    column_of_any("arm_length_mm", "length of the straight arms", |row| Some(row.answer.star.l)),
    column_of_any(
        "tip_equilibrium_angle_deg",
        "angle of the tips at rest, not clamped where arms touch",
        |row| row.value(|outcome| Some(outcome.rest.equilibrium.to_degrees()), Measurements::equilibrium),
    ),
    column_of_any("final_radius_mm", "inner radius of the closed star", |row| {
        row.value(|outcome| Some(mm(outcome.rest.radius)), |shell| Some(shell.radius.value))
    }),
    column_of_any("contraction", "1 - final radius / inner radius", |row| {
        row.value(|outcome| Some(outcome.contraction), |shell| Some(shell.contraction.value))
    }),
    column_of_any("operating_pressure_kPa", "pressure of full actuation", |row| {
        Some(row.answer.operating_pressure.0)
    }),
    column_of_any("radial_stiffness_N_per_m", "radial stiffness at rest", |row| {
        row.value(|outcome| outcome.stiffness, Measurements::known_stiffness)
    }),
    column_of_any("object_force_N", "radial force on the object, of one star", |row| {
        row.value(Outcome::object_force, |shell| shell.object_force().map(|force| force.value))
    }),
    column_of_any("payload_kg", "mass that friction holds, of the whole stack", |row| {
        row.shell.map_or(row.answer.payload, |shell| row.payload(shell.object_force()?.value))
    }),
    hinges("burst_pressure_kPa", "pressure at which the seal peels", |row| row.answer.burst.map(|p| p.0)),
    // mm^2 to cm^2.
    column_of_any("fabric_cm2", "fabric of one star, both sheets, as cut", |row| {
        row.answer.fabric.map(|area| area / 100.0)
    }),
    column_of_any("bendability", "1/eps: pressure over bending stiffness", |row| {
        row.at_pressure()?.bendability()
    }),
    column_of_any("stretch", "p W / Y: how far the fabric stretches", |row| row.at_pressure()?.stretch()),
    hinges("burst_margin", "burst pressure over pressure", |row| {
        row.answer.burst.zip(row.point.load.pressure).map(|(burst, pressure)| burst.0 / pressure.0)
    }),
    hinges("widest_radius_mm", "largest radius of an object that the inflated star can hold", |row| {
        row.outcome().map(|outcome| mm(outcome.graspable[1]))
    }),
    low("final_radius_lo_mm", radius),
    high("final_radius_hi_mm", radius),
    low("object_force_lo_N", force),
    high("object_force_hi_N", force),
    low("payload_lo_kg", payload),
    high("payload_hi_kg", payload),
];

/// Further values of the same kinds, in order.
pub(super) const MORE: [OutputColumn; 13] = [
    low("tip_equilibrium_angle_lo_deg", angle),
    high("tip_equilibrium_angle_hi_deg", angle),
    low("contraction_lo", contraction),
    high("contraction_hi", contraction),
    low("radial_stiffness_lo_N_per_m", stiffness),
    high("radial_stiffness_hi_N_per_m", stiffness),
    hinges(
        "preload_N",
        "radial force that is stored in a star whose arms touch and press on each other",
        |row| row.outcome()?.preload,
    ),
    hinges("largest_opening_mm", "inner radius at which the arms of the inflated star lock", |row| {
        row.outcome().map(|outcome| mm(outcome.rest.widest.radius))
    }),
    column_of_any("realised_tip_radius_mm", "inner radius that the band makes of the tips", |row| {
        Some(mm(row.answer.case.realised.tip))
    }),
    column_of_any("realised_corner_radius_mm", "inner radius that the band makes of the corners", |row| {
        Some(mm(row.answer.case.realised.corner))
    }),
    hinges("peak_opening_deg", "angle of the tips where the arms lock", |row| {
        row.outcome().map(|outcome| outcome.rest.widest.angle.to_degrees())
    }),
    column_of_any("mass_g", "mass of one star's fabric", |row| {
        // kg/m^2 times mm^2 is 1e-3 g.
        row.point.fabric.areal_density.zip(row.answer.fabric).map(|(density, area)| density.0 * area * 1e-3)
    }),
    column_of_any("stars", "stars in the stack", |row| Some(f64::from(row.point.stars))),
];

/// Values by shells alone, in order.
pub(super) const SHELL_OUTPUTS: [OutputColumn; 19] = [
    measured("tip_angle_deg", "angle of the tips between their arms' lines", |row| {
        Some(row.shell?.tip_angle.value)
    }),
    measured("volume_mm3", "volume of one star", |row| Some(row.shell?.volume.value)),
    measured("arm_contact_N", "force with which the arms of a tip press on each other", |row| {
        Some(row.shell?.contact.value)
    }),
    measured("arm_contact_mm2", "flat area of an arm's sheet that touches", |row| {
        Some(row.shell?.contact_area.value)
    }),
    measured("seal_tension_N_per_mm", "largest tension of the fabric at the rim", |row| {
        Some(row.shell?.seal_tension()[0])
    }),
    measured("largest_stretch", "largest principal stretch of the sheet", |row| {
        Some(row.shell?.extremes.stretch.value)
    }),
    open("final_radius_mesh_error_mm", |row| Some(row.shell?.radius.error)),
    open("contraction_mesh_error", |row| Some(row.shell?.contraction.error)),
    open("tip_angle_mesh_error_deg", |row| Some(row.shell?.tip_angle.error)),
    open("radial_stiffness_mesh_error_N_per_m", |row| Some(row.shell?.stiffness.error)),
    open("object_force_mesh_error_N", |row| Some(row.shell?.object_force()?.error)),
    open("payload_mesh_error_kg", |row| row.payload(row.shell?.object_force()?.error)),
    open("volume_mesh_error_mm3", |row| Some(row.shell?.volume.error)),
    open("arm_contact_mesh_error_N", |row| Some(row.shell?.contact.error)),
    open("arm_contact_mesh_error_mm2", |row| Some(row.shell?.contact_area.error)),
    open("seal_tension_mesh_error_N_per_mm", |row| Some(row.shell?.seal_tension()[1])),
    open("largest_stretch_mesh_error", |row| Some(row.shell?.extremes.stretch.error)),
    measured("seal_pull_N_per_mm", "largest pull on the seal", |row| {
        Some(1e-3 * row.shell?.extremes.seal_pull.value)
    }),
    open("seal_pull_mesh_error_N_per_mm", |row| Some(1e-3 * row.shell?.extremes.seal_pull.error)),
];
