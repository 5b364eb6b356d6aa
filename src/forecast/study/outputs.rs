//! The columns of answers: values by hinge models, values that need no model, and values by shells alone.

use crate::forecast::outcome::Outcome;
use crate::forecast::ranges::Interval;
use crate::forecast::shell::request::Measurements;
use crate::forecast::star_answer::mm;
use crate::forecast::study::output::Of::{self, Any, High, Hinges, Low};
use crate::forecast::study::output::{OutputColumn, RangeOf, StudyRow};

const fn column(name: &'static str, unit: Option<&'static str>, about: &'static str, of: Of) -> OutputColumn {
    OutputColumn { name, unit, about, of }
}

const fn low(name: &'static str, unit: Option<&'static str>, range: RangeOf) -> OutputColumn {
    column(name, unit, "least end of its range", Low(range))
}

const fn high(name: &'static str, unit: Option<&'static str>, range: RangeOf) -> OutputColumn {
    column(name, unit, "largest end of its range", High(range))
}

fn radius(row: &StudyRow<'_>) -> Option<Interval> {
    row.own()?.ranges.radius.map(|range| range.map(mm))
}

fn angle(row: &StudyRow<'_>) -> Option<Interval> {
    row.own()?.ranges.angle.map(|range| range.map(f64::to_degrees))
}

fn contraction(row: &StudyRow<'_>) -> Option<Interval> {
    row.own()?.contraction_range(&row.answer.case)
}

fn stiffness(row: &StudyRow<'_>) -> Option<Interval> {
    // Without a pressure there is no stiffness, and no range of one.
    row.own().filter(|own| own.stiffness.is_some())?.ranges.stiffness
}

fn force(row: &StudyRow<'_>) -> Option<Interval> {
    row.own()?.force_range
}

fn payload(row: &StudyRow<'_>) -> Option<Interval> {
    row.answer.payload_range
}

/// Values by hinge models, and values that need no model, in order. Lengths mm, angles deg. `sweep --vary` has these columns alone: they and
/// their order do not change.
pub(super) const PLAIN: [OutputColumn; 20] = [
    column("arm_length_mm", Some("mm"), "length of the straight arms", Any(|row| Some(row.answer.star.l))),
    column(
        "tip_equilibrium_angle_deg",
        Some("deg"),
        "angle of the tips at rest, not clamped where arms touch",
        Any(|row| row.says(|own| Some(own.rest.equilibrium.to_degrees()), Measurements::equilibrium)),
    ),
    column(
        "final_radius_mm",
        Some("mm"),
        "inner radius of the closed star",
        Any(|row| row.says(|own| Some(mm(own.rest.radius)), |shell| Some(shell.radius.value))),
    ),
    column(
        "contraction",
        None,
        "1 - final radius / inner radius",
        Any(|row| row.says(|own| Some(own.contraction), |shell| Some(shell.contraction.value))),
    ),
    column(
        "operating_pressure_kPa",
        Some("kPa"),
        "pressure of full actuation",
        Any(|row| Some(row.answer.operating_pressure.0)),
    ),
    column(
        "radial_stiffness_N_per_m",
        Some("N/m"),
        "radial stiffness at rest",
        Any(|row| row.says(|own| own.stiffness, Measurements::known_stiffness)),
    ),
    column(
        "object_force_N",
        Some("N"),
        "radial force on the object, of one star",
        Any(|row| row.says(Outcome::object_force, |shell| shell.object_force().map(|force| force.value))),
    ),
    column(
        "payload_kg",
        Some("kg"),
        "mass that friction holds, of the whole stack",
        Any(|row| row.shell.map_or(row.answer.payload, |shell| row.held(shell.object_force()?.value))),
    ),
    column(
        "burst_pressure_kPa",
        Some("kPa"),
        "pressure at which the seal peels",
        Hinges(|row| row.answer.burst.map(|p| p.0)),
    ),
    // mm^2 to cm^2.
    column(
        "fabric_cm2",
        Some("cm^2"),
        "fabric of one star, both sheets, as cut",
        Any(|row| row.answer.fabric.map(|area| area / 100.0)),
    ),
    column(
        "bendability",
        None,
        "1/eps: pressure over bending stiffness",
        Any(|row| {
            let case = &row.answer.case;
            let known =
                || case.pressure.filter(|_| row.all).map(|p| case.sheet.bendability(p, case.mechanism.width));
            row.own().map_or_else(known, |own| own.bendability)
        }),
    ),
    column(
        "stretch",
        None,
        "p W / Y: how far the fabric stretches",
        Any(|row| {
            let case = &row.answer.case;
            let known =
                || case.pressure.filter(|_| row.all).map(|p| case.sheet.stretch(p, case.mechanism.width));
            row.own().map_or_else(known, |own| own.stretch)
        }),
    ),
    column(
        "burst_margin",
        None,
        "burst pressure over pressure",
        Hinges(|row| {
            row.answer.burst.zip(row.point.load.pressure).map(|(burst, pressure)| burst.0 / pressure.0)
        }),
    ),
    column(
        "widest_radius_mm",
        Some("mm"),
        "largest radius of an object that the inflated star can hold",
        Hinges(|row| row.own().map(|own| mm(own.graspable[1]))),
    ),
    low("final_radius_lo_mm", Some("mm"), radius),
    high("final_radius_hi_mm", Some("mm"), radius),
    low("object_force_lo_N", Some("N"), force),
    high("object_force_hi_N", Some("N"), force),
    low("payload_lo_kg", Some("kg"), payload),
    high("payload_hi_kg", Some("kg"), payload),
];

/// Further values of the same kinds, in order.
pub(super) const MORE: [OutputColumn; 13] = [
    low("tip_equilibrium_angle_lo_deg", Some("deg"), angle),
    high("tip_equilibrium_angle_hi_deg", Some("deg"), angle),
    low("contraction_lo", None, contraction),
    high("contraction_hi", None, contraction),
    low("radial_stiffness_lo_N_per_m", Some("N/m"), stiffness),
    high("radial_stiffness_hi_N_per_m", Some("N/m"), stiffness),
    column(
        "preload_N",
        Some("N"),
        "radial force that is stored in a star whose arms touch and press on each other",
        Hinges(|row| row.own()?.preload),
    ),
    column(
        "largest_opening_mm",
        Some("mm"),
        "inner radius at which the arms of the inflated star lock",
        Hinges(|row| row.own().map(|own| mm(own.rest.widest.radius))),
    ),
    column(
        "realised_tip_radius_mm",
        Some("mm"),
        "inner radius that the band makes of the tips",
        Any(|row| Some(mm(row.answer.case.realised.tip))),
    ),
    column(
        "realised_corner_radius_mm",
        Some("mm"),
        "inner radius that the band makes of the corners",
        Any(|row| Some(mm(row.answer.case.realised.corner))),
    ),
    column(
        "peak_opening_deg",
        Some("deg"),
        "angle of the tips where the arms lock",
        Hinges(|row| row.own().map(|own| own.rest.widest.angle.to_degrees())),
    ),
    column(
        "mass_g",
        Some("g"),
        "mass of one star's fabric",
        Any(|row| {
            // kg/m^2 times mm^2 is 1e-3 g.
            row.point
                .fabric
                .areal_density
                .zip(row.answer.fabric)
                .map(|(density, area)| density.0 * area * 1e-3)
        }),
    ),
    column("stars", None, "stars in the stack", Any(|row| Some(f64::from(row.point.stars)))),
];

/// Description of a mesh error's column.
const MESH_ERROR: &str = "its mesh error";

const fn measured(
    name: &'static str,
    unit: Option<&'static str>,
    about: &'static str,
    of: fn(&StudyRow<'_>, &Measurements) -> Option<f64>,
) -> OutputColumn {
    OutputColumn { name, unit, about, of: Of::Shell(of) }
}

const fn open(
    name: &'static str,
    unit: Option<&'static str>,
    of: fn(&StudyRow<'_>, &Measurements) -> Option<f64>,
) -> OutputColumn {
    measured(name, unit, MESH_ERROR, of)
}

/// Values by shells alone, in order.
pub(super) const SHELL_OUTPUTS: [OutputColumn; 19] = [
    measured("tip_angle_deg", Some("deg"), "angle of the tips between their arms' lines", |_, shell| {
        Some(shell.tip_angle.value)
    }),
    measured("volume_mm3", Some("mm^3"), "volume of one star", |_, shell| Some(shell.volume.value)),
    measured(
        "arm_contact_N",
        Some("N"),
        "force with which the arms of a tip press on each other",
        |_, shell| Some(shell.contact.value),
    ),
    measured("arm_contact_mm2", Some("mm^2"), "flat area of an arm's sheet that touches", |_, shell| {
        Some(shell.contact_area.value)
    }),
    measured(
        "seal_tension_N_per_mm",
        Some("N/mm"),
        "largest tension of the fabric at the rim",
        |_, shell| Some(shell.seal_tension()[0]),
    ),
    measured("largest_stretch", None, "largest principal stretch of the sheet", |_, shell| {
        Some(shell.extremes.stretch)
    }),
    open("final_radius_mesh_error_mm", Some("mm"), |_, shell| Some(shell.radius.error)),
    open("contraction_mesh_error", None, |_, shell| Some(shell.contraction.error)),
    open("tip_angle_mesh_error_deg", Some("deg"), |_, shell| Some(shell.tip_angle.error)),
    open("radial_stiffness_mesh_error_N_per_m", Some("N/m"), |_, shell| Some(shell.stiffness.error)),
    open("object_force_mesh_error_N", Some("N"), |_, shell| Some(shell.object_force()?.error)),
    open("payload_mesh_error_kg", Some("kg"), |row, shell| row.held(shell.object_force()?.error)),
    open("volume_mesh_error_mm3", Some("mm^3"), |_, shell| Some(shell.volume.error)),
    open("arm_contact_mesh_error_N", Some("N"), |_, shell| Some(shell.contact.error)),
    open("arm_contact_mesh_error_mm2", Some("mm^2"), |_, shell| Some(shell.contact_area.error)),
    open("seal_tension_mesh_error_N_per_mm", Some("N/mm"), |_, shell| Some(shell.seal_tension()[1])),
    open("largest_stretch_mesh_error", None, |_, shell| Some(shell.extremes.stretch_error)),
    measured("seal_pull_N_per_mm", Some("N/mm"), "largest pull on the seal", |_, shell| {
        Some(1e-3 * shell.extremes.seal_pull)
    }),
    open("seal_pull_mesh_error_N_per_mm", Some("N/mm"), |_, shell| {
        Some(1e-3 * shell.extremes.seal_pull_error)
    }),
];
