//! The prediction as a text for people: values, assumptions and warnings.

use crate::interval::{Interval, scaled};
use crate::outcome::Grip;
use crate::prediction::{FabricStretch, ForceAt, Prediction, StarPrediction, groups_of_equals};
use crate::pressures::PressureRow;
use crate::ranges::shown::{self, line, listed};
use crate::shell::SHELL;
use crate::shell::result::{self, payload_mesh_error};
use crate::warning::WarningCode;
use inflatable::mechanics::hinge::Level;
use spec::Spec;
use spec::units::{Readable, tenths_up};
use std::fmt::Write;

/// Least 1/eps at which shells of a fabric soft in shear close less than isotropic ones (docs/weave.md).
const LEAST_OPENED: f64 = 1500.0;

/// The fabric assumed for all numbers where a spec gives no shear modulus, and the effect of a weave on `stars`.
fn isotropic(stars: &[StarPrediction]) -> String {
    let is_opened =
        |star: &StarPrediction| star.bendability.is_some_and(|bendability| bendability >= LEAST_OPENED);
    let effect = if stars.iter().all(is_opened) { "closes less" } else { "changes radius and force" };
    format!("all numbers are for isotropic fabric; a weave that is soft in shear {effect} (docs/weave.md)")
}

/// A page about `prediction`; with the values of its model, such as coiling and stiffness of hinges, only if it `is_full`.
pub fn text(spec: &Spec, prediction: &Prediction, is_full: bool) -> String {
    // Equal stars are printed once, with their numbers above. Lines about the whole stack follow, then the verdict
    // with its reasons.
    let mut page = format!("{}\n", spec.name);
    let pressure = spec.load.as_ref().and_then(|load| load.pressure).map(|pressure| pressure.0);
    let groups = groups_of_equals(&prediction.stars);
    for (star, numbers) in &groups {
        let _ = match (groups.len(), &numbers[..]) {
            (1, [_]) => Ok(()),
            (1, all) => writeln!(page, "\n{} equal stars, each:", all.len()),
            (_, [number]) => writeln!(page, "\nstar {number}:"),
            _ => writeln!(page, "\nstars {}:", listed(numbers)),
        };
        star_text(&mut page, star, pressure, is_full);
    }
    if let Some(mass) = prediction.stack_mass_g.filter(|_| prediction.stars.len() > 1) {
        let _ = writeln!(page, "\nmass of the whole stack         {} g", Readable(mass));
    }
    if let Some(payload) = prediction.first.payload_kg {
        let text = match prediction.first.ranges.payload_kg {
            Some(range) => {
                let mass = spec.load.as_ref().and_then(|load| load.mass).map(|mass| mass.0);
                shown::payload(payload, range, mass)
            }
            None if prediction.first.model == SHELL => {
                let open =
                    prediction.stars.iter().filter_map(payload_mesh_error).reduce(|sum, one| sum + one);
                open.map_or(format!("{} kg", Readable(payload)), |open| shown::meshed(payload, open, "kg"))
            }
            None if prediction.first.model == Level::Section.name() => "unknown".to_owned(),
            None => shown::or_unknown(payload, None, "kg"),
        };
        let _ = writeln!(page, "\npayload of the whole stack      {text}");
    }
    if spec.fabric.shear_modulus.is_none() {
        let _ = writeln!(page, "\n{}", isotropic(&prediction.stars));
    }
    if let Some(verdict) = &prediction.verdict {
        let _ = writeln!(page, "\nverdict: {}", verdict.line());
        for reason in verdict.reasons.iter().chain(&verdict.remarks()) {
            let _ = writeln!(page, "  {reason}");
        }
    }
    page
}

/// The predictions of `star` at `pressure`, kPa.
fn star_text(page: &mut String, star: &StarPrediction, pressure: Option<f64>, is_full: bool) {
    if star.evidence.mesh_errors.is_some() {
        return result::star_text(page, star, is_full);
    }
    // The reason why no model applies is printed with the warnings.
    let search = star.evidence.accuracy.as_ref().map(ToString::to_string);
    let has_no_model = star.evidence.warnings.iter().any(|warning| warning.code == WarningCode::NoModel);
    let choice = Some(&star.evidence.choice).filter(|_| !has_no_model);
    let reason = search.as_ref().or(choice);
    line(page, "model", reason.map_or(star.model.to_owned(), |reason| format!("{} ({reason})", star.model)));
    line(page, "arm length", show(star.arm_length_mm, "mm"));
    // A limit is selected by name: its number is printed, and its error is unknown.
    let is_limit = star.model != Level::Section.name();
    if let Some((tip, corner)) = star.lambda_t.tip.zip(star.lambda_t.corner).filter(|_| is_full) {
        let [tip, corner] = [tip, corner]
            .map(|lambda| if is_limit { Readable(lambda).to_string() } else { format!("{lambda:.3}") });
        line(page, "target coiling tip, corner", format!("{tip}, {corner}"));
    }
    // What the spec requires is listed also when unknown.
    let mut quantity =
        |what: &str, value: Option<f64>, range: Option<Interval>, unit: &str, is_asked: bool| {
            let text = match value.zip(range) {
                Some((value, range)) => Some(shown::with_range(value, range, unit)),
                None if is_asked && !is_limit => Some("unknown".to_owned()),
                None => value.map(|value| without_range(value, unit, is_limit)),
            };
            line(page, what, text);
        };
    let (ranges, is_asked) = (&star.ranges, star.bendability.is_some());
    let percent = |range: Interval| scaled(range, 100.0);
    let stiffness = star.hinge_stiffness_Nm.map(|c| (c.tip, c.corner)).unzip();
    let shut =
        star.tip_equilibrium_angle_deg.map(|angle| angle.max(star.correction.contact_angle.to_degrees()));
    let contraction = star.contraction.map(|c| 100.0 * c);
    let (radial, of_hinges) = (star.radial_stiffness_N_per_m, &ranges.hinge_stiffness_Nm);
    let closed_range = ranges.final_radius_mm.map(|range| scaled(range, 2.0));
    quantity(
        "closes to, across",
        star.final_radius_mm.map(|radius| 2.0 * radius),
        closed_range,
        "mm",
        is_asked,
    );
    quantity("contraction", contraction, ranges.contraction.map(percent), "%", is_asked);
    if is_full {
        quantity("tip angle at rest", shut, ranges.tip_equilibrium_angle_deg, "deg", is_asked);
        quantity("hinge stiffness tip", stiffness.0, of_hinges.tip, "N m/rad", is_asked);
        quantity("hinge stiffness corner", stiffness.1, of_hinges.corner, "N m/rad", is_asked);
    }
    quantity("radial stiffness", radial, ranges.radial_stiffness_N_per_m, "N/m", is_asked);
    let is_untried = star.hold == Some(Grip::Untried);
    quantity("force on the object", star.object_force_N, ranges.object_force_N, "N", is_untried);
    line(page, "payload of this star", star.payload_kg.map(|kg| star_payload(star, kg, is_limit)));
    grip_lines(page, star);
    seal_lines(page, star, pressure);
    lines_without_range(page, star, is_full);
    force_lines(page, star, is_limit);
    for warning in &star.evidence.warnings {
        line(page, "warning", warning.text.clone());
    }
    pressure_table(page, star.pressures.as_deref().unwrap_or_default());
}

/// Numbers of `star` that have no range; its bendability only if the page `is_full`.
fn lines_without_range(page: &mut String, star: &StarPrediction, is_full: bool) {
    line(page, "full actuation from", show(star.operating_pressure_kPa, "kPa"));
    let bendability = star.bendability.filter(|_| is_full);
    line(page, "bendability", bendability.map(|bendability| show(bendability, "")));
    let stretch = star.stretch.and_then(FabricStretch::ratio).map(|stretch| show(100.0 * stretch, "%"));
    line(page, "stretch of the fabric", stretch);
    line(page, "preload of arms", star.preload_N.filter(|f| *f > 0.0).map(|force| show(force, "N")));
    line(page, "burst margin", star.burst_margin.map(|margin| show(margin, "")));
    line(page, "mass", star.mass_g.map(|mass| show(mass, "g")));
}

/// A value without a range: that of a limit, whose error is unknown, else none.
fn without_range(value: f64, unit: &str, is_limit: bool) -> String {
    if is_limit { shown::or_unknown(value, None, unit) } else { "unknown".to_owned() }
}

/// The payload `kg` of `star` with its range, if it has one.
fn star_payload(star: &StarPrediction, kg: f64, is_limit: bool) -> String {
    match star.ranges.payload_kg {
        Some(range) => shown::payload(kg, range, None),
        None => without_range(kg, "kg", is_limit),
    }
}

/// The pull on the seal, and the pressure at which the seal bursts, beside `pressure`, kPa.
fn seal_lines(page: &mut String, star: &StarPrediction, pressure: Option<f64>) {
    let ranges = &star.ranges;
    let pull = star.seal_pull_N_per_mm.map(|pull| shown::or_unknown(pull, ranges.seal_pull_N_per_mm, "N/mm"));
    line(page, "largest pull on the seal", pull);
    let burst = star.burst_pressure_kPa.map(|burst| match ranges.burst_pressure_kPa {
        Some(range) => shown::with_limit(burst, range, "kPa", pressure),
        None => shown::or_unknown(burst, None, "kPa"),
    });
    line(page, "burst pressure", burst);
}

/// The forces on the objects of the requested radii, by their widths as all of the page.
fn force_lines(page: &mut String, star: &StarPrediction, is_limit: bool) {
    for ForceAt { radius, force, low, high } in star.force_curve.iter().flatten() {
        let range = low.zip(*high).map(|(low, high)| [low, high]);
        let is_held = star.graspable_radius_mm.is_none_or(|[least, most]| (least..=most).contains(radius));
        let text = match (*force, range) {
            (None, _) if !is_held => "not held".to_owned(),
            (Some(force), Some(range)) => shown::with_range(force, range, "N"),
            (Some(force), None) => without_range(force, "N", is_limit),
            (None, _) => "unknown".to_owned(),
        };
        line(page, &format!("force on {} mm across", Readable(2.0 * radius)), text);
    }
}

fn show(value: f64, unit: &str) -> String {
    format!("{} {unit}", shown::rounded(value)).trim_end().to_owned()
}

/// The objects that fit the star, and what its flap adds.
fn grip_lines(page: &mut String, star: &StarPrediction) {
    let Some([smallest, largest]) = star.graspable_radius_mm else { return };
    // The second value has no better range than the first.
    let [smallest, largest] = [smallest, largest].map(|radius| diameter(radius, star));
    line(page, "holds objects", format!("{} to {largest} across", smallest.trim_end_matches(" mm")));
    line(page, "cut hole, across", show(2.0 * star.hole_radius_mm, "mm"));
    let edge = star.flap_edge_radius_mm.map(|radius| format!("from {} across", diameter(radius, star)));
    line(page, "flap's edge touches objects", edge);
    let force = star.flap_force_N.filter(|force| *force > 0.0).map(|force| {
        // The upper end, as in the verdict.
        let largest = star
            .ranges
            .flap_force_N
            .map_or_else(|| shown::rounded(force), |[_, most]| format!("{:.1}", tenths_up(most)));
        let load = star.flap_load_N_per_mm.map(|load| format!("; it folds at {load:.2} N per mm of contact"));
        format!("up to {largest} N{}", load.unwrap_or_default())
    });
    line(page, "force if the flap holds", force);
    let bending = star.arm_wrinkling_kg.zip(star.arm_folding_kg);
    let bending = bending.map(|(wrinkling, folding)| {
        let [wrinkling, folding] = [wrinkling, folding].map(shown::rounded);
        format!("wrinkle under {wrinkling} kg on this star, fold under {folding} kg")
    });
    line(page, "arms beside the plates", bending);
    line(page, "room around the object", star.object_gap_mm.map(|gap| show(gap, "mm")));
}

/// Twice `radius` in mm, with as many digits as the final radius of `star` has.
fn diameter(radius: f64, star: &StarPrediction) -> String {
    match star.ranges.final_radius_mm {
        Some(range) => shown::as_exact_as(2.0 * radius, scaled(range, 2.0), "mm"),
        None => format!("{} mm", shown::rounded(2.0 * radius)),
    }
}

/// The table of pressures, if there are any.
fn pressure_table(page: &mut String, rows: &[PressureRow]) {
    let has_force = rows.iter().any(|row| row.object_force_N.is_some());
    if !rows.is_empty() {
        let force = if has_force { "force on the object       " } else { "" };
        let _ = writeln!(
            page,
            "\n  at the pressure        closes to, across         {force}stretch   burst margin"
        );
    }
    for row in rows {
        pressure_text(page, row, has_force);
    }
    if let Some(best) = rows.iter().position(|row| row.best) {
        let criterion =
            if has_force { "the largest lower end of the force's range" } else { "the least closed width" };
        let end = if best + 1 == rows.len() { "; higher pressures have no prediction" } else { "" };
        let _ = writeln!(page, "  best: {criterion}, without bursting{end}");
    }
}

/// `row`, with a force where some row has one: `has_force`.
fn pressure_text(page: &mut String, row: &PressureRow, has_force: bool) {
    let force = if has_force {
        format!("{:26}", shown::optional_with_range(row.object_force_N, row.force_range_N, "N"))
    } else {
        String::new()
    };
    let note = match (row.best, row.tried) {
        (true, _) => "   <- best",
        (_, false) => "   outside the validated range",
        _ => "",
    };
    let _ = writeln!(
        page,
        "  {:8} kPa           {:26}{force}{:5.1} %   {}{note}",
        Readable(row.pressure_kPa).to_string(),
        shown::optional_with_range(
            Some(2.0 * row.final_radius_mm),
            row.radius_range_mm.map(|range| scaled(range, 2.0)),
            "mm"
        ),
        100.0 * row.stretch,
        row.burst_margin.map_or("unknown".to_owned(), |margin| format!("{margin:.2}")),
    );
}
