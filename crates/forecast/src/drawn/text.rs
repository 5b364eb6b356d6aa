//! The prediction of a drawn piece as a text for people: each number with its mesh error.

use crate::drawn::chamber_prediction::{ChamberPrediction, SecondShape};
use crate::drawn::measures::{MeasurePrediction, MeasuredQuantity};
use crate::drawn::prediction::DrawnPrediction;
use crate::drawn::pressures::PortPressure;
use crate::drawn::pull::PullPrediction;
use crate::interval::{Interval, scaled};
use crate::meshed::{MeshedPlace, MeshedValue};
use crate::ranges::shown::{self, line, listed};
use crate::shell::SHELL;
use spec::Spec;
use spec::units::Readable;
use std::fmt::Write;

/// A page about `prediction`; with the numbers of its meshes only if it `is_full`. The lines about the whole piece come first, then those of
/// each chamber, then a line for each quantity that is measured. A line whose value is unknown is left out.
pub fn text(spec: &Spec, prediction: &DrawnPrediction, is_full: bool) -> String {
    let mut page = format!("{}\n", spec.name);
    let (evidence, count) = (&prediction.evidence, prediction.chambers.len());
    let choice = evidence.accuracy.as_ref().map_or_else(|| evidence.choice.clone(), ToString::to_string);
    line(&mut page, "model", format!("{} ({choice})", prediction.model));
    for PortPressure { port, pressure_kPa } in prediction.pressures_kPa.iter().flatten() {
        line(&mut page, &format!("pressure at {port}"), format!("{} kPa", Readable(*pressure_kPa)));
    }
    line(&mut page, "mass of one piece", prediction.mass_g.map(|mass| format!("{} g", Readable(mass))));
    line(
        &mut page,
        "volume of all chambers",
        prediction.volume_mm3.filter(|_| count > 1).map(|volume| litres(volume, None)),
    );
    let burst = prediction.burst_pressure_kPa.zip(prediction.burst_range_kPa);
    let burst = burst.map(|(burst, range)| shown::with_limit(burst, range, "kPa", prediction.pressure_kPa));
    line(&mut page, "burst pressure", burst);
    line(&mut page, "burst margin", prediction.burst_margin.map(shown::rounded));
    for warning in &prediction.evidence.warnings {
        line(&mut page, "warning", warning.text.clone());
    }
    if spec.fabric.shear_modulus.is_none() && prediction.model == SHELL {
        let isotropic = "isotropic; a weave that is soft in shear inflates otherwise (docs/weave.md)";
        line(&mut page, "fabric", isotropic.to_owned());
    }
    for chamber in &prediction.chambers {
        let [x, y] = chamber.at_mm;
        let number = chamber.chamber;
        let _ = writeln!(page, "\nchamber {number} of {count}, around X {x:.1} Y {y:.1} mm:");
        of_chamber(&mut page, chamber, is_full);
    }
    if !prediction.measures.is_empty() {
        page.push_str("\nmeasures:\n");
    }
    for measure in &prediction.measures {
        of_measure(&mut page, measure);
    }
    if let Some(pull) = &prediction.pull {
        of_pull(&mut page, pull);
    }
    page
}

/// The pull at bars: blocked, free, under a mass, and at the strokes between.
fn of_pull(page: &mut String, pull: &PullPrediction) {
    let [first, second] = &pull.bars;
    let _ =
        writeln!(page, "\npull between {first} and {second}, flat {} mm apart:", Readable(pull.distance_mm));
    line(page, "blocked force", number(pull.blocked_force_N, None, "N"));
    let contraction = shown::rounded(1e2 * pull.free_stroke_mm.value / pull.distance_mm);
    line(page, "free stroke", format!("{}; {contraction} %", number(pull.free_stroke_mm, None, "mm")));
    let lifted = pull.lifted_mm.map_or_else(|| "not lifted".to_owned(), |stroke| number(stroke, None, "mm"));
    let hung = pull.mass_kg.map(|mass| format!("stroke under {} kg", Readable(mass)));
    if let Some(word) = hung {
        line(page, &word, lifted);
    }
    for [stroke, value, mesh_error] in pull.curve.iter().skip(1) {
        let force = MeshedValue { value: *value, mesh_error: *mesh_error };
        line(page, &format!("  force at {} mm", shown::rounded(*stroke)), number(force, None, "N"));
    }
}

/// A line for each quantity of a measure: flat, and inflated with its mesh error.
fn of_measure(page: &mut String, measure: &MeasurePrediction) {
    for (word, unit, MeasuredQuantity { flat, inflated, range, .. }) in measure.quantities() {
        let flat = format!("flat {} {unit}", shown::rounded(flat));
        let value =
            inflated.map_or(flat.clone(), |inflated| format!("{}; {flat}", number(inflated, range, unit)));
        let reference =
            measure.angle_to.as_ref().filter(|_| word == "angle").map(|name| format!(" to {name}"));
        line(page, &format!("{}, {word}{}", measure.measure, reference.unwrap_or_default()), value);
    }
}

fn of_chamber(page: &mut String, chamber: &ChamberPrediction, is_full: bool) {
    // Lines without a value are left out, as of a chamber that was not inflated. With `is_full` the numbers of the
    // model follow.
    let [x, y] = chamber.flat_extents_mm.map(Readable);
    line(page, "flat", format!("{x} x {y} mm, {} mm^2", Readable(chamber.flat_area_mm2)));
    line(page, "largest circle in it", format!("{} mm across", shown::rounded(chamber.width_mm)));
    let ranges = chamber.ranges;
    let [along_x, along_y] = ranges.map(|ranges| ranges.extents_mm).map_or([None; 2], |ends| ends.map(Some));
    line(page, "inflated, along x", chamber.extents_mm.map(|[x, _]| number(x, along_x, "mm")));
    line(page, "inflated, along y", chamber.extents_mm.map(|[_, y]| number(y, along_y, "mm")));
    line(page, "height", place(chamber.height_mm, ranges.map(|ranges| ranges.height_mm), "mm"));
    let pull = place(chamber.seal_pull_N_per_mm, ranges.map(|ranges| ranges.seal_pull_N_per_mm), "N/mm");
    line(page, "largest pull on the seal", pull);
    for seam in chamber.seams.iter().filter(|seams| seams.len() > 1).flatten() {
        let pull = seam.pull_N_per_mm;
        line(page, &format!("  {}", seam.seam), place(Some(pull), chamber.pull_range(pull), "N/mm"));
    }
    line(
        page,
        "volume",
        chamber.volume_mm3.map(|volume| litres(volume, ranges.map(|ranges| ranges.volume_mm3))),
    );
    line(page, "second stable shape", chamber.second_shape.map(second));
    line(
        page,
        "force on each plate",
        chamber.plates.map(|plates| number(plates.force_N, plates.force_range_N, "N")),
    );
    line(page, "contact area", chamber.plates.map(|plates| number(plates.contact_area_mm2, None, "mm^2")));
    line(page, "largest stretch", place(chamber.largest_stretch, None, ""));
    line(page, "largest tension", place(chamber.largest_tension_N_per_mm, None, "N/mm"));
    let plane_text = chamber.plane_eigenvalue.zip(chamber.plane).map(|(value, plane)| {
        let word = plane.answer();
        if !is_full {
            return word.to_owned();
        }
        format!("{word}: lowest eigenvalue {} p/W", number(value, None, ""))
    });
    line(page, "stays in its plane", plane_text);
    if !is_full {
        return;
    }
    let wrinkles = chamber.wrinkles.map_or(String::new(), |how| format!(", wrinkles {how}"));
    line(page, "bendability", chamber.bendability.map(|number| shown::rounded(number) + &wrinkles));
    line(page, "unknowns of meshes", chamber.unknowns.as_deref().map(listed));
}

/// Height, extents and volume of a second shape in words.
fn second(
    SecondShape { height_mm, extents_mm: [x, y], volume_mm3, more_energy_mJ, .. }: SecondShape,
) -> String {
    let [height, x, y] = [height_mm.value, x.value, y.value].map(shown::rounded);
    let volume = shown::rounded(1e-3 * volume_mm3.value);
    let energy = shown::rounded(more_energy_mJ.value);
    format!("{height} mm high, {x} x {y} mm, {volume} cm^3, with {energy} mJ more energy")
}

/// `value` with its range, which contains the mesh error; without a range with its mesh error.
fn number(value: MeshedValue, range: Option<Interval>, unit: &str) -> String {
    match range {
        Some(range) => shown::with_range(value.value, range, unit),
        None => shown::meshed(value.value, value.mesh_error, unit),
    }
}

fn litres(volume: MeshedValue, range: Option<Interval>) -> String {
    let MeshedValue { value, mesh_error } = volume;
    let volume = MeshedValue { value: 1e-3 * value, mesh_error: 1e-3 * mesh_error };
    number(volume, range.map(|range| scaled(range, 1e-3)), "cm^3")
}

fn place(value: Option<MeshedPlace>, range: Option<Interval>, unit: &str) -> Option<String> {
    let MeshedPlace { value, mesh_error, at_mm: [x, y] } = value?;
    Some(format!("{}, at X {x:.1} Y {y:.1} mm", number(MeshedValue { value, mesh_error }, range, unit)))
}
