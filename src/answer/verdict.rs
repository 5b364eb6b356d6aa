//! The verdict on the object of `[load]`, as text and as JSON.

use serde_json::{Value, json};

use crate::answer::duration::sealing_in_words;
use crate::pipeline::{FirstLoop, Forecast};
use design::CutEdge;
use forecast::drawn::chamber_prediction::ChamberPrediction;
use forecast::interval::scaled;
use forecast::prediction::{Prediction, StarPrediction, groups_of_equals};
use forecast::ranges::shown::{self, or_unknown, rounded, with_limit};
use forecast::tone::Tone;
use forecast::verdict::of_stars;
use spec::key;
use spec::units::{Length, Pressure};

/// The verdict in one sentence.
pub fn in_words(forecast: &Forecast) -> String {
    if forecast.design.drawn_pieces().is_some() {
        return sealable(forecast);
    }
    let Some((load, prediction)) = forecast.spec.load.as_ref().zip(forecast.prediction.as_ref()) else {
        return "no verdict: add a [load] section that describes the object".to_owned();
    };
    let Some(verdict) = forecast.verdict() else {
        let missing = if load.pressure.is_none() { key::load::PRESSURE } else { key::load::OBJECT_DIAMETER };
        return format!("no verdict: [load] has no `{}`", missing.key());
    };
    let diameter_text = |radius: Length| format!(", {} across,", Length(2.0 * radius.0));
    let object = load.object_radius.map_or_else(String::new, diameter_text);
    let pressure = load.pressure.map_or_else(String::new, at_pressure);
    let payload = prediction.first.payload_kg.zip(prediction.first.ranges.payload_kg);
    let mass = load.mass.map(|mass| mass.0);
    let payload = payload.zip(load.friction).map_or_else(String::new, |((kg, range), friction)| {
        let friction_range = load.friction_range().filter(|[lowest, highest]| lowest < highest);
        let range_text =
            friction_range.map_or_else(String::new, |[lowest, highest]| format!(", {lowest} to {highest},"));
        format!("; with a friction of {friction}{range_text} it carries {}", shown::payload(kg, range, mass))
    });
    let reasons =
        if verdict.reasons.is_empty() { String::new() } else { format!(": {}", verdict.reasons.join("; ")) };
    let remarks: String = verdict.remarks().into_iter().flat_map(|text| ["; ".to_owned(), text]).collect();
    format!("{}{object}{pressure}{payload}{remarks}{reasons}", verdict.line())
}

/// The words for a pressure, with as many digits as a person compares.
fn at_pressure(pressure: Pressure) -> String {
    format!(" at {} kPa", rounded(pressure.0))
}

/// What can be made of a drawing: the seams and the size of a piece, the time of all programs.
fn sealable(forecast: &Forecast) -> String {
    let placed = forecast.design.placed();
    let Some(part) = placed.first().map(|placed| forecast.design.part(placed)) else { return String::new() };
    let copies = if placed.len() > 1 { format!("{} pieces of ", placed.len()) } else { String::new() };
    let seams = part.shape().seams.len();
    let seams = format!("{seams} seam{}", if seams == 1 { "" } else { "s" });
    let size = part.cut(CutEdge::Part).outside.bounds();
    let sizes = inflated_sizes(forecast);
    let has_pressure = forecast.spec.load.as_ref().is_some_and(|load| load.pressure.is_some());
    let inflate = if has_pressure { "" } else { "; set a `pressure` in [load] to inflate it" };
    let time = sealing_in_words(forecast);
    let making = format!("{copies}{seams}, {time}, {:.0} x {:.0} mm", size.width(), size.height());
    if sizes.is_empty() {
        return format!("can be sealed: {making}{inflate}");
    }
    let pressure = forecast.spec.load.as_ref().and_then(|load| load.pressure);
    let pressure_text = pressure.map_or_else(String::new, at_pressure);
    let burst = forecast.drawn.as_ref().and_then(|drawn| drawn.prediction.burst_pressure_kPa);
    let strength = if burst.is_none() { "; the burst pressure is unknown" } else { "" };
    format!("inflates {}{pressure_text}{strength}; {making}", sizes.join("; "))
}

/// The inflated size of each chamber where it is known.
fn inflated_sizes(forecast: &Forecast) -> Vec<String> {
    forecast.drawn.iter().flat_map(|drawn| &drawn.prediction.chambers).filter_map(inflated_size).collect()
}

/// Contraction and burst pressure, each under its label.
pub fn rows(forecast: &Forecast) -> Vec<(&'static str, String)> {
    let (Some(load), Some(prediction)) = (&forecast.spec.load, &forecast.prediction) else {
        return Vec::new();
    };
    let Some(pressure) = load.pressure else { return Vec::new() };
    let mut rows = Vec::new();
    let groups = groups_of_equals(prediction.stars.iter().map(closing));
    let is_alone = groups.len() == 1;
    let closings = groups.iter().map(|(text, stars)| {
        let text = format!("{text}{}", room(stars.iter().filter_map(|star| prediction.stars.get(star - 1))));
        if is_alone { text } else { of_stars(stars, &text) }
    });
    let closings: Vec<String> = closings.collect();
    let fabric = if forecast.spec.fabric.shear_modulus.is_none() { "; for isotropic fabric" } else { "" };
    rows.push(("closes", format!("{}{fabric}", closings.join("; "))));
    let bursting = prediction
        .stars
        .iter()
        .filter_map(|star| Some((star.burst_pressure_kPa?, star.ranges.burst_pressure_kPa)));
    if let Some((burst, range)) = bursting.min_by(|a, b| a.0.total_cmp(&b.0)) {
        let with_range = |range| with_limit(burst, range, "kPa", Some(pressure.0));
        let burst_text = range.map_or_else(|| or_unknown(burst, None, "kPa"), with_range);
        rows.push(("bursts", format!("at {burst_text}; {} times its pressure", rounded(burst / pressure.0))));
        if let Some(FirstLoop { name, process }) = forecast.first_loop() {
            rows.push(("opens", format!("the {name} first (process {process})")));
        }
    }
    rows
}

/// Predicted values of a drawn piece, each under its label; empty without a load.
pub fn of_drawing(forecast: &Forecast) -> Vec<(&'static str, String)> {
    let Some(drawn_forecast) = &forecast.drawn else { return Vec::new() };
    let prediction = &drawn_forecast.prediction;
    let sizes = inflated_sizes(forecast);
    if sizes.is_empty() {
        return vec![("predicts", format!("no inflated size: {}", prediction.evidence.choice))];
    }
    let pressure = forecast.spec.load.as_ref().and_then(|load| load.pressure);
    let pressure_text = pressure.map_or_else(String::new, at_pressure);
    let mut rows = vec![("inflates", format!("{}{pressure_text}", sizes.join("; ")))];
    if let Some((burst, range)) = prediction.burst_pressure_kPa.zip(prediction.burst_range_kPa) {
        let times = prediction
            .burst_margin
            .map_or_else(String::new, |margin| format!("; {} times its pressure", rounded(margin)));
        let limit = pressure.map(|pressure| pressure.0);
        rows.push(("bursts", format!("at {}{times}", with_limit(burst, range, "kPa", limit))));
    }
    if let Some(first) = &prediction.bursts_first {
        let pressure = with_limit(first.pressure_kPa, first.range, "kPa", None);
        rows.push(("opens", format!("{} first (process {}), at {pressure}", first.place(), first.process)));
    }
    rows
}

/// The JSON answer.
pub fn json(forecast: &Forecast) -> Value {
    let verdict = forecast.verdict();
    let is_held = verdict.as_ref().and_then(|verdict| verdict.holds.as_bool());
    let refused: Vec<Value> = forecast
        .unfit()
        .iter()
        .map(|one| {
            let (code, key) = (one.code.to_string(), one.key.to_string());
            json!({ "code": code, "key": key, "found": one.found, "remedy": one.remedy })
        })
        .collect();
    let code = verdict.and_then(|verdict| verdict.code);
    let tone = if refused.is_empty() { tone(forecast) } else { Tone::Bad };
    json!({ "holds": is_held, "code": code, "tone": tone, "in_words": in_words(forecast), "unfit": refused })
}

/// The tone of the predictions.
fn tone(forecast: &Forecast) -> Tone {
    let drawn_tone = forecast.drawn.as_ref().map(|drawn| drawn.prediction.tone());
    drawn_tone.or(forecast.prediction.as_ref().map(Prediction::tone)).unwrap_or(Tone::Plain)
}

/// Extents and height of the inflated `chamber`; `None` without the shell.
fn inflated_size(chamber: &ChamberPrediction) -> Option<String> {
    let ([along_x, along_y], height) = (chamber.extents_mm?, chamber.height_mm?);
    let [x, y, z] = [along_x.value, along_y.value, height.value].map(rounded);
    let range = chamber.ranges.map_or_else(String::new, |ranges| {
        format!(" (height {})", with_limit(height.value, ranges.height_mm, "mm", None))
    });
    Some(format!("to {x} x {y} x {z} mm{range}"))
}

/// The room that `stars`, which close equally, leave around the object on its way in; empty without an object that fits.
fn room<'a>(stars: impl Iterator<Item = &'a StarPrediction>) -> String {
    let gaps: Vec<f64> = stars.filter_map(|star| star.object_gap_mm).filter(|gap| *gap >= 0.0).collect();
    let [smallest, largest] = [f64::min, f64::max].map(|end| gaps.iter().copied().reduce(end).map(rounded));
    match smallest.zip(largest) {
        None => String::new(),
        Some((smallest, largest)) if smallest == largest => {
            format!(", {smallest} mm of room around the object")
        }
        Some((smallest, largest)) => format!(", {smallest} to {largest} mm of room around the object"),
    }
}

/// The sizes between which `star` opens and closes, and its hole; without the room around the object, which differs along a stack.
fn closing(star: &StarPrediction) -> String {
    let hole = format!("the cut hole is {} mm across", rounded(2.0 * star.hole_radius_mm));
    let Some([_, largest_radius]) = star.graspable_radius_mm else { return format!("unknown; {hole}") };
    let object = star.object_radius_mm.map(|radius| 2.0 * radius);
    let closed_width = star.final_radius_mm.zip(star.ranges.final_radius_mm).map_or_else(
        || "unknown".to_owned(),
        |(radius, range)| with_limit(2.0 * radius, scaled(range, 2.0), "mm", object),
    );
    format!(
        "to {closed_width} across; takes objects up to {} mm across; {hole}",
        rounded(2.0 * largest_radius)
    )
}
