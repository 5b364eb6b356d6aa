//! The commands' answers as text and as JSON, for all front ends: terminal, Python, page. This module touches no file and no terminal.

pub mod codes;
mod duration;
pub mod new_gripper;
pub mod object;
pub mod proof;
pub mod quantity;
pub mod refused;
pub mod verdict;

use serde_json::{Value, json};

use crate::pipeline::{Forecast, Precaution};
use design::PressPlan;
use spec::Code;

pub use duration::{hours, processes_in_words, sealing_in_words, sealing_time};

/// The overview as JSON, without the time of day.
pub fn overview_json(forecast: &Forecast, list: &[Precaution]) -> Value {
    let area = forecast.machine.bench.work_area.map(|(x, y)| [x.0, y.0]);
    let sheets: Vec<[f64; 2]> =
        forecast.design.sheets.iter().map(|sheet| [sheet.width, sheet.height]).collect();
    let mut answer = json!({
        "name": forecast.spec.name,
        "stars": forecast.design.assembly().map_or(0, |assembly| assembly.stars.len()),
        "pieces": forecast.design.placed().len(),
        "verdict": verdict::json(forecast),
        "before_you_seal": list.iter().map(|one| &one.text).collect::<Vec<_>>(),
        "before_you_seal_codes": list.iter().map(|one| one.code.as_str()).collect::<Vec<_>>(),
        "warnings": forecast.design.warnings.iter().map(refused::warning_json).collect::<Vec<_>>(),
        "sealing_time_s": sealing_time(forecast),
        "sheets_mm": sheets,
        "work_area_mm": area,
        "drawing_notes": forecast.design.drawn_pieces().map(|drawn| &drawn.notes),
        "machine": forecast.machine.name,
        "prediction": match &forecast.drawn {
            Some(drawn) => json!(drawn.prediction),
            None => json!(forecast.prediction),
        },
    });
    if let Some(plan) = PressPlan::new(&forecast.spec, &forecast.design) {
        answer["press"] = press_json(&plan);
    }
    answer
}

/// The plan for a heat press as JSON.
pub fn press_json(plan: &PressPlan) -> Value {
    json!({
        "pressings": plan.pressings,
        "time_s": plan.seconds,
        "area_cm2": plan.area / 100.0,
        "force_N": plan.force,
        "settings": plan.settings,
        "instructions": plan.sections.iter().map(|section| json!({ "heading": section.heading, "lines": section.lines })).collect::<Vec<_>>(),
    })
}
