//! The prediction as a text for people: values, assumptions and warnings.

use crate::forecast::outcome::Grip;
use crate::forecast::prediction::{ForceAt, Hinges, Prediction, StarPrediction, distinct};
use crate::forecast::pressures::PressureRow;
use crate::forecast::ranges::shown::{self, line, listed};
use crate::forecast::ranges::{Interval, scaled};
use crate::forecast::shell::SHELL;
use crate::forecast::shell::result::{self, payload_mesh_error};
use crate::spec::Spec;
use crate::units::Readable;
use inflatable::mechanics::hinge::Level;
use std::fmt::Write;

/// The fabric assumed for all numbers where a spec gives no shear modulus.
pub const ISOTROPIC: &str =
    "all numbers are for isotropic fabric; a weave that is soft in shear closes less (docs/weave.md)";

/// A page about `prediction`.
pub fn text(spec: &Spec, prediction: &Prediction) -> String {
    let mut out = format!("{}\n", spec.name);
    let pressure = spec.load.as_ref().and_then(|load| load.pressure).map(|pressure| pressure.0);
    let distinct = distinct(&prediction.stars);
    for (star, numbers) in &distinct {
        let _ = match (distinct.len(), &numbers[..]) {
            (1, [_]) => Ok(()),
            (1, all) => writeln!(out, "\n{} equal stars, each:", all.len()),
            (_, [number]) => writeln!(out, "\nstar {number}:"),
            _ => writeln!(out, "\nstars {}:", listed(numbers)),
        };
        star_text(&mut out, star, pressure);
    }
    if let Some(mass) = prediction.stack_mass_g.filter(|_| prediction.stars.len() > 1) {
        let _ = writeln!(out, "\nmass of the whole stack         {} g", Readable(mass));
    }
    if let Some(payload) = prediction.first.payload_kg {
        let text = match prediction.first.ranges.payload_kg {
            Some(range) => {
                let mass = spec.load.as_ref().and_then(|load| load.mass).map(|mass| mass.0);
                shown::with_limit(payload, range, "kg", mass)
            }
            None if prediction.first.model == SHELL => {
                let open =
                    prediction.stars.iter().filter_map(payload_mesh_error).reduce(|sum, one| sum + one);
                open.map_or(format!("{} kg", Readable(payload)), |open| shown::meshed(payload, open, "kg"))
            }
            None if prediction.first.model == Level::Section.name() => "unknown".to_owned(),
            None => shown::or_unknown(payload, None, "kg"),
        };
        let _ = writeln!(out, "\npayload of the whole stack      {text}");
    }
    if spec.fabric.shear_modulus.is_none() {
        let _ = writeln!(out, "\n{ISOTROPIC}");
    }
    if let Some(verdict) = &prediction.verdict {
        let _ = writeln!(out, "\nverdict: {}", verdict.line());
        for reason in verdict.reasons.iter().chain(&verdict.one_star()).chain(&verdict.assumed_in_words()) {
            let _ = writeln!(out, "  {reason}");
        }
    }
    out
}

/// What is predicted of `star` at `pressure`, kPa.
fn star_text(out: &mut String, star: &StarPrediction, pressure: Option<f64>) {
    if star.evidence.mesh_errors.is_some() {
        return result::star_text(out, star);
    }
    let pair = |of: Hinges<Option<f64>>| of.tip.zip(of.corner);
    // The reason why no model applies is printed with the warnings.
    let why = Some(&star.evidence.choice).filter(|choice| !star.evidence.warnings.contains(choice));
    line(out, "model", why.map_or(star.model.to_owned(), |why| format!("{} ({why})", star.model)));
    line(out, "arm length", show(star.arm_length_mm, "mm"));
    // A limit is selected by name: its number is printed, and its error is unknown.
    let is_limit = star.model != Level::Section.name();
    if let Some((tip, corner)) = pair(star.lambda_t) {
        let digits =
            |lambda: f64| if is_limit { Readable(lambda).to_string() } else { format!("{lambda:.3}") };
        line(out, "target coiling tip, corner", format!("{}, {}", digits(tip), digits(corner)));
    }
    let unknown = |value: f64, unit: &str| {
        if is_limit { shown::or_unknown(value, None, unit) } else { "unknown".to_owned() }
    };
    for (what, value, range, unit) in quantities(star) {
        let text = match (value, range) {
            (Some(value), Some(range)) => shown::with(value, range, unit),
            (Some(value), None) => unknown(value, unit),
            (None, _) if is_asked(star, what) && !is_limit => "unknown".to_owned(),
            (None, _) => continue,
        };
        line(out, what, text);
    }
    for (what, value) in grip_rows(star) {
        line(out, what, value);
    }
    let of_the_seal = [
        ("largest pull on the seal", star.seal_pull_N_per_mm, star.ranges.seal_pull_N_per_mm, "N/mm"),
        ("burst pressure", star.burst_pressure_kPa, star.ranges.burst_pressure_kPa, "kPa"),
    ];
    for (what, value, range, unit) in of_the_seal {
        let limit = pressure.filter(|_| unit == "kPa");
        let text = value.map(|value| match range {
            Some(range) => shown::with_limit(value, range, unit, limit),
            None => shown::or_unknown(value, None, unit),
        });
        line(out, what, text);
    }
    line(out, "full actuation from", show(star.operating_pressure_kPa, "kPa"));
    line(out, "bendability", star.bendability.map(|bendability| show(bendability, "")));
    let stretch = star.stretch.ratio().map(|stretch| show(100.0 * stretch, "%"));
    line(out, "stretch of the fabric p W / Y", stretch);
    line(out, "preload of arms", star.preload_N.filter(|f| *f > 0.0).map(|force| show(force, "N")));
    line(out, "burst margin", star.burst_margin.map(|margin| show(margin, "")));
    line(out, "mass", star.mass_g.map(|mass| show(mass, "g")));
    for ForceAt(radius, force, low, high) in star.force_curve.iter().flatten() {
        let range = low.zip(*high).map(|(low, high)| [low, high]);
        let is_held = star.graspable_radius_mm.is_none_or(|[least, most]| (least..=most).contains(radius));
        let text = match (*force, range) {
            (None, _) if !is_held => "not held".to_owned(),
            (Some(force), Some(range)) => shown::with(force, range, "N"),
            (Some(force), None) => unknown(force, "N"),
            (None, _) => "unknown".to_owned(),
        };
        line(out, &format!("force at {} mm", Readable(*radius)), text);
    }
    for warning in &star.evidence.warnings {
        line(out, "warning", warning.clone());
    }
    pressure_table(out, star.pressures.as_deref().unwrap_or_default());
}

fn show(value: f64, unit: &str) -> String {
    format!("{} {unit}", Readable(value)).trim_end().to_owned()
}

/// The objects that fit the star, and what its flap adds: labels and values.
fn grip_rows(star: &StarPrediction) -> Vec<(&'static str, String)> {
    let Some([least, most]) = star.graspable_radius_mm else { return Vec::new() };
    // The second value has no better range than the first.
    let end = |radius: f64| match star.ranges.final_radius_mm {
        Some(range) => shown::as_exact_as(2.0 * radius, scaled(range, 2.0), "mm"),
        None => format!("{} mm", shown::rounded(2.0 * radius)),
    };
    let mut rows = vec![
        ("holds objects", format!("{} to {} across", end(least).trim_end_matches(" mm"), end(most))),
        ("cut hole, across", show(2.0 * star.hole_radius_mm, "mm")),
    ];
    if let Some(radius) = star.flap_edge_radius_mm {
        rows.push(("flap's edge touches objects", format!("from {} across", end(radius))));
    }
    if let Some(force) = star.flap_force_N.filter(|force| *force > 0.0) {
        let range = star.ranges.object_force_N;
        let unknown = || format!("{} N", shown::rounded(force));
        let force = range.map_or_else(unknown, |range| shown::as_exact_as(force, range, "N"));
        let load = star.flap_load_N_per_mm.map(|load| format!("; it folds at {load:.2} N per mm of contact"));
        rows.push(("force if the flap holds", format!("up to {force}{}", load.unwrap_or_default())));
    }
    if let Some(gap) = star.object_gap_mm {
        rows.push(("room around the object", show(gap, "mm")));
    }
    rows
}

/// The table of pressures, if there are any.
fn pressure_table(out: &mut String, rows: &[PressureRow]) {
    let held = rows.iter().any(|row| row.object_force_N.is_some());
    if !rows.is_empty() {
        let force = if held { "force on the object       " } else { "" };
        let _ = writeln!(
            out,
            "\n  at the pressure        final radius              {force}stretch   burst margin"
        );
    }
    for row in rows {
        pressure_text(out, row, held);
    }
    if let Some(best) = rows.iter().position(|row| row.best) {
        let most = if held { "the largest lower end of the force's range" } else { "the least final radius" };
        let end = if best + 1 == rows.len() { "; higher pressures have no prediction" } else { "" };
        let _ = writeln!(out, "  best: {most}, without bursting{end}");
    }
}

/// Radial force on the object.
const FORCE: &str = "force on the object";
/// The share of a stack's payload.
const PAYLOAD: &str = "payload of this star";

/// Whether the spec requires `what`, so that the report lists it also when unknown.
fn is_asked(star: &StarPrediction, what: &str) -> bool {
    match what {
        FORCE => star.hold == Some(Grip::Untried),
        PAYLOAD => false,
        _ => star.bendability.is_some(),
    }
}

/// The quantities that have ranges: name, value, range and unit of each.
fn quantities(star: &StarPrediction) -> [(&'static str, Option<f64>, Option<Interval>, &'static str); 8] {
    let ranges = &star.ranges;
    let percent = |range: Interval| scaled(range, 100.0);
    let stiffness = star.hinge_stiffness_Nm.map(|c| (c.tip, c.corner)).unzip();
    let shut =
        star.tip_equilibrium_angle_deg.map(|angle| angle.max(star.correction.contact_angle.to_degrees()));
    [
        ("final radius", star.final_radius_mm, ranges.final_radius_mm, "mm"),
        ("contraction", star.contraction.map(|c| 100.0 * c), ranges.contraction.map(percent), "%"),
        ("tip angle at rest", shut, ranges.tip_equilibrium_angle_deg, "deg"),
        ("hinge stiffness tip", stiffness.0, ranges.hinge_stiffness_Nm.tip, "N m/rad"),
        ("hinge stiffness corner", stiffness.1, ranges.hinge_stiffness_Nm.corner, "N m/rad"),
        ("radial stiffness", star.radial_stiffness_N_per_m, ranges.radial_stiffness_N_per_m, "N/m"),
        (FORCE, star.object_force_N, ranges.object_force_N, "N"),
        (PAYLOAD, star.payload_kg, ranges.payload_kg, "kg"),
    ]
}

/// `row`, with a force where some row has one: `held`.
fn pressure_text(out: &mut String, row: &PressureRow, held: bool) {
    let known = || format!("{:26}", shown::known(row.object_force_N, row.force_range_N, "N"));
    let force = if held { known() } else { String::new() };
    let note = match (row.best, row.tried) {
        (true, _) => "   <- best",
        (_, false) => "   outside the validated range",
        _ => "",
    };
    let _ = writeln!(
        out,
        "  {:8} kPa           {:26}{force}{:5.1} %   {}{note}",
        Readable(row.pressure_kPa).to_string(),
        shown::known(Some(row.final_radius_mm), row.radius_range_mm, "mm"),
        100.0 * row.stretch,
        row.burst_margin.map_or("unknown".to_owned(), |margin| format!("{margin:.2}")),
    );
}
