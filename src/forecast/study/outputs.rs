//! The columns of every study: values by hinge models, and values that need no model.

use crate::forecast::outcome::Outcome;
use crate::forecast::ranges::Interval;
use crate::forecast::shell::request::Measurements;
use crate::forecast::star_answer::mm;
use crate::forecast::study::output::Of::{self, Any, Hinges};
use crate::forecast::study::output::{OutputColumn, StudyRow};

const fn plain(name: &'static str, unit: Option<&'static str>, about: &'static str, of: Of) -> OutputColumn {
    OutputColumn { name, unit, about, plain: true, of }
}

const fn more(name: &'static str, unit: Option<&'static str>, about: &'static str, of: Of) -> OutputColumn {
    OutputColumn { name, unit, about, plain: false, of }
}

fn low(range: Option<Interval>) -> Option<f64> {
    range.map(|[low, _]| low)
}

fn high(range: Option<Interval>) -> Option<f64> {
    range.map(|[_, high]| high)
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

/// Values by hinge models, and values that need no model, in order. Lengths mm, angles deg.
pub(super) const OUTPUTS: [OutputColumn; 33] = [
    plain("arm_length_mm", Some("mm"), "length of the straight arms", Any(|row| Some(row.answer.star.l))),
    plain(
        "tip_equilibrium_angle_deg",
        Some("deg"),
        "angle of the tips at rest, not clamped where arms touch",
        Any(|row| row.says(|own| Some(own.rest.equilibrium.to_degrees()), Measurements::equilibrium)),
    ),
    plain(
        "final_radius_mm",
        Some("mm"),
        "inner radius of the closed star",
        Any(|row| row.says(|own| Some(mm(own.rest.radius)), |shell| Some(shell.radius.value))),
    ),
    plain(
        "contraction",
        None,
        "1 - final radius / inner radius",
        Any(|row| row.says(|own| Some(own.contraction), |shell| Some(shell.contraction.value))),
    ),
    plain(
        "operating_pressure_kPa",
        Some("kPa"),
        "pressure of full actuation",
        Any(|row| Some(row.answer.operating_pressure.0)),
    ),
    plain(
        "radial_stiffness_N_per_m",
        Some("N/m"),
        "radial stiffness at rest",
        Any(|row| row.says(|own| own.stiffness, Measurements::known_stiffness)),
    ),
    plain(
        "object_force_N",
        Some("N"),
        "radial force on the object, of one star",
        Any(|row| row.says(Outcome::object_force, |shell| shell.object_force().map(|force| force.value))),
    ),
    plain(
        "payload_kg",
        Some("kg"),
        "mass that friction holds, of the whole stack",
        Any(|row| row.shell.map_or(row.answer.payload, |shell| row.held(shell.object_force()?.value))),
    ),
    plain(
        "burst_pressure_kPa",
        Some("kPa"),
        "pressure at which the seal peels",
        Hinges(|row| row.answer.burst.map(|p| p.0)),
    ),
    // mm^2 to cm^2.
    plain(
        "fabric_cm2",
        Some("cm^2"),
        "fabric of one star, both sheets, as cut",
        Any(|row| row.answer.fabric.map(|area| area / 100.0)),
    ),
    plain(
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
    plain(
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
    plain(
        "burst_margin",
        None,
        "burst pressure over pressure",
        Hinges(|row| {
            row.answer.burst.zip(row.point.load.pressure).map(|(burst, pressure)| burst.0 / pressure.0)
        }),
    ),
    plain(
        "widest_radius_mm",
        Some("mm"),
        "largest radius of an object that the inflated star can hold",
        Hinges(|row| row.own().map(|own| mm(own.graspable[1]))),
    ),
    plain("final_radius_lo_mm", Some("mm"), "least end of its range", Hinges(|row| low(radius(row)))),
    plain("final_radius_hi_mm", Some("mm"), "largest end of its range", Hinges(|row| high(radius(row)))),
    plain("object_force_lo_N", Some("N"), "least end of its range", Hinges(|row| low(force(row)))),
    plain("object_force_hi_N", Some("N"), "largest end of its range", Hinges(|row| high(force(row)))),
    plain("payload_lo_kg", Some("kg"), "least end of its range", Hinges(|row| low(row.answer.payload_range))),
    plain(
        "payload_hi_kg",
        Some("kg"),
        "largest end of its range",
        Hinges(|row| high(row.answer.payload_range)),
    ),
    more(
        "tip_equilibrium_angle_lo_deg",
        Some("deg"),
        "least end of its range",
        Hinges(|row| low(angle(row))),
    ),
    more(
        "tip_equilibrium_angle_hi_deg",
        Some("deg"),
        "largest end of its range",
        Hinges(|row| high(angle(row))),
    ),
    more("contraction_lo", None, "least end of its range", Hinges(|row| low(contraction(row)))),
    more("contraction_hi", None, "largest end of its range", Hinges(|row| high(contraction(row)))),
    more(
        "radial_stiffness_lo_N_per_m",
        Some("N/m"),
        "least end of its range",
        Hinges(|row| low(stiffness(row))),
    ),
    more(
        "radial_stiffness_hi_N_per_m",
        Some("N/m"),
        "largest end of its range",
        Hinges(|row| high(stiffness(row))),
    ),
    more(
        "preload_N",
        Some("N"),
        "radial force that is stored in a star whose arms touch and press on each other",
        Hinges(|row| row.own()?.preload),
    ),
    more(
        "largest_opening_mm",
        Some("mm"),
        "inner radius at which the arms of the inflated star lock",
        Hinges(|row| row.own().map(|own| mm(own.rest.widest.radius))),
    ),
    more(
        "realised_tip_radius_mm",
        Some("mm"),
        "inner radius that the band makes of the tips",
        Any(|row| Some(mm(row.answer.case.realised.tip))),
    ),
    more(
        "realised_corner_radius_mm",
        Some("mm"),
        "inner radius that the band makes of the corners",
        Any(|row| Some(mm(row.answer.case.realised.corner))),
    ),
    more(
        "peak_opening_deg",
        Some("deg"),
        "angle of the tips where the arms lock",
        Hinges(|row| row.own().map(|own| own.rest.widest.angle.to_degrees())),
    ),
    more(
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
    more("stars", None, "stars in the stack", Any(|row| Some(f64::from(row.point.stars)))),
];
