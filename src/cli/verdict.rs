//! What the gripper does with the object of `[load]`, in words and as JSON.

use serde_json::{Value, json};

use crate::forecast::prediction::StarPrediction;
use crate::forecast::ranges::shown::{known, rounded, with};
use crate::pipeline::Forecast;
use crate::spec::key;

/// The verdict in one sentence.
pub(super) fn in_words(forecast: &Forecast) -> String {
    let Some((load, prediction)) = forecast.spec.load.as_ref().zip(forecast.prediction.as_ref()) else {
        return "no verdict: the spec has no [load], so nobody has asked what it holds".to_owned();
    };
    let Some(verdict) = forecast.verdict() else {
        let missing = if load.pressure.is_none() { key::load::PRESSURE } else { key::load::OBJECT_RADIUS };
        return format!("no verdict: [load] does not say `{}`", missing.key());
    };
    let object = load.object_radius.map_or_else(String::new, |radius| format!(" of radius {radius}"));
    let pressure = load.pressure.map_or_else(String::new, |pressure| format!(" at {pressure}"));
    let payload = prediction.first.payload_kg.zip(prediction.first.ranges.payload_kg);
    let payload = payload.zip(load.friction).map_or_else(String::new, |((kg, range), friction)| {
        format!("; with a friction of {friction} it carries {}", with(kg, range, "kg"))
    });
    let why =
        if verdict.reasons.is_empty() { String::new() } else { format!(": {}", verdict.reasons.join("; ")) };
    format!("{}{object}{pressure}{payload}{why}", verdict.line())
}

/// How far it closes and at which pressure it bursts, each under its label.
pub(super) fn rows(forecast: &Forecast) -> Vec<(&'static str, String)> {
    let (Some(load), Some(prediction)) = (&forecast.spec.load, &forecast.prediction) else {
        return Vec::new();
    };
    let Some(pressure) = load.pressure else { return Vec::new() };
    let mut rows = Vec::new();
    let mut closings: Vec<String> = prediction.stars.iter().map(closing).collect();
    closings.dedup();
    rows.push(("closes", closings.join("; ")));
    let weakest = prediction.stars.iter().filter_map(|star| star.burst_pressure_kPa).reduce(f64::min);
    if let Some(burst) = weakest {
        let times = rounded(burst / pressure.0);
        rows.push((
            "bursts",
            format!("at {} kPa by the ring, range unknown; {times} times its pressure", rounded(burst)),
        ));
    }
    rows
}

/// The same for programs.
pub(super) fn json(forecast: &Forecast) -> Value {
    let holds = forecast.verdict().and_then(|verdict| verdict.holds.known());
    let refused: Vec<Value> = forecast
        .unfit()
        .iter()
        .map(|one| json!({ "code": one.code.to_string(), "found": one.found }))
        .collect();
    json!({ "holds": holds, "in_words": in_words(forecast), "unfit": refused })
}

fn closing(star: &StarPrediction) -> String {
    let Some([_, most]) = star.graspable_radius_mm else { return "unknown".to_owned() };
    let radius = known(star.final_radius_mm, star.ranges.final_radius_mm, "mm");
    format!("to a radius of {radius}; grasps objects of radii up to {} mm", rounded(most))
}
