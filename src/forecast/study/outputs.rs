//! What is said of each design: every column that a study can have of it.

use crate::forecast::candidate::{Answer, Candidate};
use crate::forecast::outcome::Outcome;
use crate::forecast::ranges::Interval;
use crate::spec::study::Wanted;
use crate::spec::{Fault, FaultCode, Faults, Source, nearest};
use crate::units::{Length, Pressure};

/// A design with its answer.
pub(super) struct Row<'a> {
    pub(super) point: &'a Candidate,
    pub(super) answer: &'a Answer,
    /// Whether what no model is needed for is said where none answers; the columns of `sweep --vary` never did.
    pub(super) all: bool,
}

/// A column of answers.
#[derive(Debug)]
pub(super) struct Output {
    pub(super) name: &'static str,
    pub(super) unit: Option<&'static str>,
    pub(super) about: &'static str,
    /// Whether `sweep --vary` has it, too: these columns and their order do not change.
    pub(super) plain: bool,
    pub(super) of: fn(&Row<'_>) -> Option<f64>,
}

type Of = fn(&Row<'_>) -> Option<f64>;

const fn plain(name: &'static str, unit: Option<&'static str>, about: &'static str, of: Of) -> Output {
    Output { name, unit, about, plain: true, of }
}

const fn more(name: &'static str, unit: Option<&'static str>, about: &'static str, of: Of) -> Output {
    Output { name, unit, about, plain: false, of }
}

impl Row<'_> {
    fn own(&self) -> Option<&Outcome> {
        self.answer.outcome.as_ref()
    }

    fn pressure(&self) -> Option<Pressure> {
        self.point.load.pressure
    }
}

fn mm(metres: f64) -> f64 {
    Length::from_metres(metres).0
}

fn low(range: Option<Interval>) -> Option<f64> {
    range.map(|[low, _]| low)
}

fn high(range: Option<Interval>) -> Option<f64> {
    range.map(|[_, high]| high)
}

fn radius(row: &Row<'_>) -> Option<Interval> {
    row.own()?.ranges.radius.map(|range| range.map(mm))
}

fn angle(row: &Row<'_>) -> Option<Interval> {
    row.own()?.ranges.angle.map(|range| range.map(f64::to_degrees))
}

fn contraction(row: &Row<'_>) -> Option<Interval> {
    row.own()?.contraction_range(&row.answer.case)
}

fn stiffness(row: &Row<'_>) -> Option<Interval> {
    // Without a pressure there is no stiffness, and no range of one.
    row.own().filter(|own| own.stiffness.is_some())?.ranges.stiffness
}

fn force(row: &Row<'_>) -> Option<Interval> {
    row.own()?.force_range
}

/// Every column, in order. Lengths mm, angles deg.
pub(super) const OUTPUTS: [Output; 33] = [
    plain("arm_length_mm", Some("mm"), "length of the straight arms", |row| Some(row.answer.star.l)),
    plain(
        "tip_equilibrium_angle_deg",
        Some("deg"),
        "angle of the tips at rest, not clamped where arms touch",
        |row| row.own().map(|own| own.rest.equilibrium.to_degrees()),
    ),
    plain("final_radius_mm", Some("mm"), "inner radius of the closed star", |row| {
        row.own().map(|own| mm(own.rest.radius))
    }),
    plain("contraction", None, "1 - final radius / inner radius", |row| row.own().map(|own| own.contraction)),
    plain("operating_pressure_kPa", Some("kPa"), "pressure of full actuation", |row| {
        Some(row.answer.operating_pressure.0)
    }),
    plain("radial_stiffness_N_per_m", Some("N/m"), "radial stiffness at rest", |row| row.own()?.stiffness),
    plain("object_force_N", Some("N"), "radial force on the object, of one star", |row| {
        row.own()?.object_force()
    }),
    plain("payload_kg", Some("kg"), "mass that friction holds, of the whole stack", |row| row.answer.payload),
    plain("burst_pressure_kPa", Some("kPa"), "pressure at which the seal peels", |row| {
        row.answer.burst.map(|p| p.0)
    }),
    // mm^2 to cm^2.
    plain("fabric_cm2", Some("cm^2"), "fabric of one star, both sheets, as cut", |row| {
        row.answer.fabric.map(|area| area / 100.0)
    }),
    plain("bendability", None, "1/eps: pressure over what bends the fabric", |row| {
        let case = &row.answer.case;
        let known =
            || case.pressure.filter(|_| row.all).map(|p| case.sheet.bendability(p, case.mechanism.width));
        row.own().map_or_else(known, |own| own.bendability)
    }),
    plain("stretch", None, "p W / Y: how far the fabric stretches", |row| {
        let case = &row.answer.case;
        let known = || case.pressure.filter(|_| row.all).map(|p| case.sheet.stretch(p, case.mechanism.width));
        row.own().map_or_else(known, |own| own.stretch)
    }),
    plain("burst_margin", None, "burst pressure over pressure", |row| {
        row.answer.burst.zip(row.pressure()).map(|(burst, pressure)| burst.0 / pressure.0)
    }),
    plain("widest_radius_mm", Some("mm"), "largest radius that the inflated star takes in", |row| {
        row.own().map(|own| mm(own.graspable[1]))
    }),
    plain("final_radius_lo_mm", Some("mm"), "least end of its range", |row| low(radius(row))),
    plain("final_radius_hi_mm", Some("mm"), "largest end of its range", |row| high(radius(row))),
    plain("object_force_lo_N", Some("N"), "least end of its range", |row| low(force(row))),
    plain("object_force_hi_N", Some("N"), "largest end of its range", |row| high(force(row))),
    plain("payload_lo_kg", Some("kg"), "least end of its range", |row| low(row.answer.payload_range)),
    plain("payload_hi_kg", Some("kg"), "largest end of its range", |row| high(row.answer.payload_range)),
    more("tip_equilibrium_angle_lo_deg", Some("deg"), "least end of its range", |row| low(angle(row))),
    more("tip_equilibrium_angle_hi_deg", Some("deg"), "largest end of its range", |row| high(angle(row))),
    more("contraction_lo", None, "least end of its range", |row| low(contraction(row))),
    more("contraction_hi", None, "largest end of its range", |row| high(contraction(row))),
    more("radial_stiffness_lo_N_per_m", Some("N/m"), "least end of its range", |row| low(stiffness(row))),
    more("radial_stiffness_hi_N_per_m", Some("N/m"), "largest end of its range", |row| high(stiffness(row))),
    more("preload_N", Some("N"), "radial force that is stored in a star that is pressed shut", |row| {
        row.own()?.preload
    }),
    more(
        "largest_opening_mm",
        Some("mm"),
        "inner radius at which the arms of the inflated star lock",
        |row| row.own().map(|own| mm(own.rest.widest.radius)),
    ),
    more("realised_tip_radius_mm", Some("mm"), "inner radius that the band makes of the tips", |row| {
        Some(mm(row.answer.case.realised.tip))
    }),
    more("realised_corner_radius_mm", Some("mm"), "inner radius that the band makes of the corners", |row| {
        Some(mm(row.answer.case.realised.corner))
    }),
    more("peak_opening_deg", Some("deg"), "angle of the tips where the arms lock", |row| {
        row.own().map(|own| own.rest.widest.angle.to_degrees())
    }),
    more("mass_g", Some("g"), "mass of one star's fabric", |row| {
        // kg/m^2 times mm^2 is 1e-3 g.
        row.point.fabric.areal_density.zip(row.answer.fabric).map(|(density, area)| density.0 * area * 1e-3)
    }),
    more("stars", None, "stars in the stack", |row| Some(f64::from(row.point.stars))),
];

/// The columns that are `wanted` in the study `source`, in that order.
pub(super) fn chosen(wanted: &[Wanted], source: &Source) -> Result<Vec<&'static Output>, Faults> {
    let mut faults = Vec::new();
    let mut found: Vec<&'static Output> = Vec::new();
    for Wanted { name, place } in wanted {
        let known = OUTPUTS.iter().find(|output| output.name == name);
        let fault = |code, label: &str| {
            Fault::error(code, place.clone(), format!("`outputs` names `{name}`")).label(label)
        };
        match known {
            Some(output) if found.iter().any(|other| other.name == output.name) => {
                faults.push(fault(FaultCode::TwoColumns, "it is named before").help("delete one of them"));
            }
            Some(output) => found.push(output),
            None => {
                let names = || OUTPUTS.iter().map(|output| output.name);
                let help = match nearest(name, names()) {
                    Some(near) => format!("did you mean \"{near}\"?"),
                    None => format!("columns are {}", names().collect::<Vec<_>>().join(", ")),
                };
                faults.push(fault(FaultCode::NoColumn, "no column has this name").help(help));
            }
        }
    }
    if faults.is_empty() { Ok(found) } else { Err(Faults::new(source, faults)) }
}
