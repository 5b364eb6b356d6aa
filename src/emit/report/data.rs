//! The block of figures: everything that the page's scripts show, in one JSON object.

use serde_json::{Value, json};

use crate::emit::report::job::{parts, programs, sheets, thousandths};
use crate::emit::report::subject::Report;
use design::{Design, PressPlan, StarDesign};
use forecast::case::Case;
use forecast::drawn::HOW;
use forecast::drawn::prediction::DrawnPrediction;
use forecast::pose::{Pose, PosedStar};
use forecast::prediction::Prediction;
use forecast::seal_load::{SealLoad, seal_loads};
use forecast::tone::Tone;
use forecast::verdict::Verdict;
use program::plan::process_times;
use spec::{Load, Machine, Setting, Source, drawing_settings, settings};

/// Decimals that are kept of curves: for the eye, and few enough to be the same on every machine.
const DIGITS: i32 = 6;

/// All figures of a report.
pub(super) fn data(report: &Report<'_>) -> Value {
    let Report { spec, design, bill, prediction, .. } = report;
    let assembly = design.assembly();
    let mut bill = serde_json::to_value(bill).unwrap_or_default();
    // The manifest itself lists the files; this page is one of them.
    if let Some(bill) = bill.as_object_mut() {
        for key in ["files", "only", "with"] {
            let _ = bill.remove(key);
        }
    }
    let mut data = json!({
        "name": spec.name,
        "bill": bill,
        "prediction": prediction,
        "remarks": prediction.and_then(|all| all.verdict.as_ref()).map_or_else(Vec::new, Verdict::remarks),
        "load": spec.load.as_ref().map(load),
        "tone": tone(report),
        "settings": own_settings(report),
        "machine": machine(report.machine),
        "seal": {
            "temperature": spec.seal.heat_in_words(), "speed": spec.seal.speed.to_string(),
            "band_mm": spec.seal.band.0, "overlap_mm": spec.seal.overlap.0,
        },
        "stack": assembly.map(|assembly| json!({
            "height_mm": thousandths(assembly.stack.height),
            "stars_mm": assembly.stack.stars.iter().copied().map(thousandths).collect::<Vec<_>>(),
            "turns_deg": assembly.stack.turns.iter().map(|turn| thousandths(turn.to_degrees())).collect::<Vec<_>>(),
        })),
        "post_diameter_mm": assembly.map(|assembly| assembly.frame.post_diameter),
        "hose": spec.inlet.as_ref().map(|inlet| json!({ "diameter_mm": inlet.tube_diameter.0, "length_mm": inlet.length.0 })),
        "watch": report.watch.iter().map(|(code, text)| json!({ "code": code, "text": text })).collect::<Vec<_>>(),
        "notes": design.warnings.iter().map(|warning| format!("{}; {}", warning.found, warning.remedy)).collect::<Vec<_>>(),
        "parts": parts(report),
        "loads": loads(report),
        "flat": stars(design).iter().map(|part| short(&json!(Pose::new(&PosedStar::flat(&part.star))))).collect::<Vec<_>>(),
        "sheets": sheets(report),
        "programs": programs(report),
        "charts": report.charts.iter().map(|charts| short(&json!(charts))).collect::<Vec<_>>(),
    });
    if let Some(figures) = data.as_object_mut() {
        figures.extend(processes(report));
    }
    // Only a drawing's page has these.
    if design.drawn_pieces().is_some() {
        data["drawing"] = json!({ "prediction": report.drawn, "how": HOW });
    }
    // Only the page for a press has these: temperature and pressure stand where an iron has temperature and speed.
    if let Some((press, plan)) = spec.press.as_ref().zip(PressPlan::new(spec, design)) {
        data["press"] = json!({ "words": plan.in_words(press) });
        data["seal"]["temperature"] = json!(press.temperature.to_string());
        data["seal"]["speed"] = json!(press.pressure_in_bar());
    }
    data
}

fn load(load: &Load) -> Value {
    json!({
        "pressure_kPa": load.pressure.map(|p| p.0),
        "object_radius_mm": load.object_radius.map(|radius| radius.0),
        "friction": load.friction,
        "friction_least": load.friction_least,
        "friction_most": load.friction_most,
        "mass_kg": load.mass.map(|mass| mass.0),
        "largest_force_N": load.largest_force.map(|force| force.0),
    })
}

/// The processes in the order of sealing; none where every seam is sealed once by that of `[seal]`.
fn processes(report: &Report<'_>) -> Option<(String, Value)> {
    let processes: Vec<Value> = process_times(report.programs)
        .into_iter()
        .map(|time| {
            json!({
                "name": time.process.name, "temperature": time.process.seal.heat_in_words(),
                "speed": time.process.seal.speed.to_string(), "time_s": thousandths(time.seconds),
            })
        })
        .collect();
    (!processes.is_empty()).then(|| ("processes".to_owned(), json!(processes)))
}

/// The distinct stars.
fn stars(design: &Design) -> &[StarDesign] {
    design.assembly().map_or(&[], |assembly| &assembly.distinct)
}

/// The settings of the product that the spec describes.
fn own_settings(report: &Report<'_>) -> Vec<Setting> {
    let source = Source::new("spec.toml", report.source);
    if report.design.drawn_pieces().is_some() { drawing_settings(&source) } else { settings(&source) }
}

/// The tone of the verdict.
fn tone(report: &Report<'_>) -> Tone {
    let drawn_tone = report.drawn.map(DrawnPrediction::tone);
    drawn_tone.or(report.prediction.map(Prediction::tone)).unwrap_or(Tone::Plain)
}

fn machine(machine: &Machine) -> Value {
    let clamps = machine.bench.keep_out.iter().map(|clamp| {
        json!({ "name": clamp.name, "x_mm": clamp.x.0, "y_mm": clamp.y.0, "width_mm": clamp.width.0, "depth_mm": clamp.depth.0 })
    });
    json!({
        "name": machine.name,
        "description": machine.description,
        "requires": machine.script.requires,
        "heats_itself": machine.controller.heating.is_by_program(),
        "work_area_mm": machine.bench.work_area.map(|(x, y)| [x.0, y.0]),
        "clamps": clamps.collect::<Vec<_>>(),
    })
}

/// The seal load of each distinct star.
fn loads(report: &Report<'_>) -> Vec<Value> {
    let of_star = |part: &StarDesign| {
        let case = Case::of_part(report.spec, part).ok()?;
        let load = |load: &SealLoad| {
            json!({
                "place": load.place,
                "radius_mm": load.radius.map(|radius| radius.0),
                "factor": load.factor,
                "load_N_per_mm": load.load.map(|load| load.0),
                "burst_kPa": load.burst.map(|burst| burst.0),
                "margin": load.margin,
                "weakness": load.weakness(),
            })
        };
        Some(short(&json!(seal_loads(report.spec, &case, part).iter().map(load).collect::<Vec<_>>())))
    };
    stars(report.design).iter().filter_map(of_star).collect()
}

/// The value with its numbers cut to [`DIGITS`] significant digits.
fn short(value: &Value) -> Value {
    match value {
        Value::Number(number) if number.is_f64() => {
            number.as_f64().map_or(Value::Null, |x| json!(significant(x)))
        }
        Value::Array(list) => list.iter().map(short).collect(),
        Value::Object(map) => map
            .iter()
            .map(|(key, value)| (key.clone(), short(value)))
            .collect::<serde_json::Map<_, _>>()
            .into(),
        other => other.clone(),
    }
}

fn significant(x: f64) -> f64 {
    if x == 0.0 || !x.is_finite() {
        return 0.0;
    }
    #[expect(clippy::cast_possible_truncation, reason = "a logarithm of a finite number")]
    let size = libm::log10(x.abs()).floor() as i32;
    let scale = 10_f64.powi(DIGITS - 1 - size);
    (x * scale).round() / scale
}
