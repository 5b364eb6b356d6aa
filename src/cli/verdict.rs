//! What the gripper does with the object of `[load]`, in words and as JSON.

use serde_json::{Value, json};

use crate::cli::figure::figure;
use crate::forecast::prediction::{Prediction, StarPrediction};
use crate::pipeline::{Forecast, Verdict};
use crate::spec::Load;

/// The verdict in one sentence.
pub(super) fn in_words(forecast: &Forecast) -> String {
    let Some((load, prediction)) = forecast.spec.load.as_ref().zip(forecast.prediction.as_ref()) else {
        return "no verdict: the spec has no [load], so nobody has asked what it holds".to_owned();
    };
    match forecast.verdict() {
        Verdict::NotAsked(key) => format!("no verdict: [load] does not say `{}`", key.key()),
        Verdict::Unknown => "no verdict: no model knows the force on the object at this pressure".to_owned(),
        Verdict::DoesNotHold => {
            let why: Vec<String> = forecast.unfit().iter().map(|refusal| refusal.found.clone()).collect();
            format!("does not hold its object: {}", why.join("; "))
        }
        Verdict::Holds(stars) => holds(load, prediction, &stars),
    }
}

fn holds(load: &Load, prediction: &Prediction, stars: &[usize]) -> String {
    let all = prediction.stars.len();
    let who =
        if stars.len() == all { String::new() } else { format!("with {} of {all} stars ", stars.len()) };
    let held = stars.iter().filter_map(|number| prediction.stars.get(number - 1));
    let mut forces: Vec<String> = held.filter_map(force).collect();
    forces.dedup();
    let each = if forces.len() == 1 && stars.len() > 1 { " each" } else { "" };
    let object = load.object_radius.map_or_else(String::new, |radius| format!(" of radius {radius}"));
    let pressure = load.pressure.map_or_else(String::new, |pressure| format!(" at {pressure}"));
    let payload = payload(prediction).zip(load.friction).map_or_else(String::new, |(kg, friction)| {
        format!("; with a friction of {friction} it carries {kg}")
    });
    format!("holds {who}an object{object}{pressure} with {}{each}{payload}", forces.join(", "))
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
        let times = figure(burst / pressure.0, "times its pressure", None);
        rows.push(("bursts", format!("at {}, {times}", figure(burst, "kPa", None))));
    }
    rows
}

/// The same for programs.
pub(super) fn json(forecast: &Forecast) -> Value {
    let holds = match forecast.verdict() {
        Verdict::Holds(_) => Some(true),
        Verdict::DoesNotHold => Some(false),
        Verdict::NotAsked(_) | Verdict::Unknown => None,
    };
    let refused: Vec<Value> = forecast
        .unfit()
        .iter()
        .map(|one| json!({ "code": one.code.to_string(), "found": one.found }))
        .collect();
    json!({ "holds": holds, "in_words": in_words(forecast), "unfit": refused })
}

// Every predicted number of this room is put together below, so that its range has one place to come from.

fn force(star: &StarPrediction) -> Option<String> {
    star.object_force_N.map(|force| figure(force, "N", None))
}

fn payload(prediction: &Prediction) -> Option<String> {
    prediction.first.payload_kg.map(|kg| figure(kg, "kg", None))
}

fn closing(star: &StarPrediction) -> String {
    let [_, most] = star.graspable_radius_mm;
    let radius = figure(star.final_radius_mm, "mm", None);
    format!("to a radius of {radius}; grasps objects of radii from there to {}", figure(most, "mm", None))
}
