//! Reports against the design: what their block of figures says, and the scene in them.
//!
//! A page shows nothing but its block, so the block is held to what it was made from: the bill and the prediction figure by figure, the way
//! of the iron to the seams, the curves to the prediction where they meet it.

use serde_json::Value;

use crate::design::{Design, Side};
use crate::forecast::pose;
use crate::forecast::pose::Pose;
use crate::geom::{Path, Point};
use crate::verify::finding::quote;
use crate::verify::judge::expected::Expected;
use crate::verify::judge::files::figures::alike;
use crate::verify::judge::files::scene;
use crate::verify::judge::path::measure::Prepared;
use crate::verify::read::html::read_html;
use crate::verify::{FindingCode, Findings};

/// How far a corner of a drawn seam may lie beside it, mm: polylines for the eye, rounded to a hundredth.
const BESIDE: f64 = 0.05;
/// How much a drawn seam may be shorter than the seam, of its length.
const SHORTER: f64 = 1e-3;
/// How much a curve may be off the prediction where it meets it: it has six digits.
const ROUNDED: f64 = 1e-5;

/// Reads a report and compares it.
pub(in crate::verify) fn check(expected: &Expected<'_>, text: &str, findings: &mut Findings) {
    let page = match read_html(text) {
        Ok(page) => page,
        Err(found) => {
            return findings.add(FindingCode::BadHtml, None, found, "a page that only shows its figures");
        }
    };
    if page.title != expected.spec.name {
        findings.add(FindingCode::WrongTitle, None, quote(&page.title), quote(&expected.spec.name));
    }
    let mut bill = serde_json::to_value(expected.manifest).unwrap_or_default();
    if let Some(bill) = bill.as_object_mut() {
        for key in ["files", "only", "with", "tool", "prediction"] {
            let _ = bill.remove(key);
        }
    }
    let mut said = page.data["bill"].clone();
    let _ = said.as_object_mut().and_then(|said| said.remove("tool"));
    let prediction =
        expected.prediction.map(|right| serde_json::from_str(&right.to_json()).unwrap_or_default());
    let load = expected.spec.load.as_ref();
    let pressure = load.and_then(|load| load.pressure).map(|p| p.0);
    let object = load.and_then(|load| load.object_radius).map(|radius| radius.0);
    let pairs = [
        ("name", page.data["name"].clone(), expected.spec.name.as_str().into()),
        ("bill", said, bill),
        ("prediction", page.data["prediction"].clone(), prediction.unwrap_or(Value::Null)),
        ("load.pressure_kPa", page.data["load"]["pressure_kPa"].clone(), pressure.into()),
        ("load.object_radius_mm", page.data["load"]["object_radius_mm"].clone(), object.into()),
    ];
    for (what, found, right) in pairs {
        if !alike(&found, &right) {
            let found = format!("{what}: other figures than this spec gives");
            findings.add(
                FindingCode::OtherReport,
                None,
                found,
                "those of the manifest and of `predict --json`",
            );
        }
    }
    programs(expected, &page.data, findings);
    curves(expected, &page.data, findings);
    scene::check(expected, &page.scene, findings);
}

/// The seams of all programs are those of the design, and drawn where it has them.
fn programs(expected: &Expected<'_>, data: &Value, findings: &mut Findings) {
    let mut wrong =
        |found: String, allowed: String| findings.add(FindingCode::OtherReport, None, found, allowed);
    let mut sealed = 0;
    for program in list(&data["programs"]) {
        for step in list(&program["steps"]).iter().filter(|step| step["do"] == "seal") {
            let seam = step["seam"]
                .as_u64()
                .and_then(|seam| list(&program["seams"]).get(usize::try_from(seam).ok()?));
            let Some(seam) = seam else {
                return wrong("a seam without a number".to_owned(), "one".to_owned());
            };
            let named =
                format!("the {} loop of star {}", seam["loop"].as_str().unwrap_or_default(), seam["star"]);
            let Some(run) = run_of(expected.design, seam) else {
                return wrong(named, "a seam of the design".to_owned());
            };
            let figures = figures_of(expected, seam);
            if figures.is_none_or(|right| !alike(&right, seam)) {
                wrong(format!("{named}: other figures"), "those of the manifest".to_owned());
            }
            let Some(drawn) = corners(&step["path"]) else {
                return wrong(format!("{named}: no path"), "one".to_owned());
            };
            let targets: Vec<Prepared> = run.segments.iter().map(|segment| Prepared::new(*segment)).collect();
            let off = |point: &Point| {
                targets.iter().map(|target| target.distance(*point)).fold(f64::INFINITY, f64::min)
            };
            let worst = drawn.iter().map(off).fold(0.0, f64::max);
            let length: f64 = drawn.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
            if !(worst <= BESIDE && (length / run.length() - 1.0).abs() <= SHORTER) {
                let found = format!("{named}: drawn {length:.1} mm long, up to {worst:.3} mm beside it");
                wrong(found, format!("{:.1} mm, within {BESIDE} mm", run.length()));
            }
            sealed += 1;
        }
    }
    let seams = 2 * expected.design.stars.len();
    if sealed != seams {
        wrong(format!("{sealed} seams"), seams.to_string());
    }
}

/// What the iron covers of the seam that is named, on its sheet.
fn run_of(design: &Design, seam: &Value) -> Option<Path> {
    let placed = design.stars.iter().find(|star| seam["star"] == star.index)?;
    let side = [Side::Hole, Side::Outside].into_iter().find(|side| seam["loop"] == side.loop_name())?;
    let own = design.part(placed).seams.iter().find(|own| own.side == side)?;
    Some(placed.placement.path(&own.run()))
}

/// What the manifest says of the seam that is named.
fn figures_of(expected: &Expected<'_>, seam: &Value) -> Option<Value> {
    let star = expected.manifest.stars.iter().find(|star| seam["star"] == star.index)?;
    let own = star.seams.iter().find(|own| seam["loop"] == own.loop_name)?;
    let mut right = serde_json::to_value(own).ok()?;
    right["star"] = star.index.into();
    Some(right)
}

/// Where the curves meet the prediction they say the same.
fn curves(expected: &Expected<'_>, data: &Value, findings: &mut Findings) {
    let load = expected.spec.load.as_ref();
    let Some((prediction, own)) = expected.prediction.zip(load.and_then(|load| load.pressure)) else {
        return;
    };
    let (found, right) = (list(&data["charts"]).len(), expected.design.firsts().count());
    if found != right {
        findings.add(FindingCode::OtherReport, None, format!("curves of {found} stars"), right.to_string());
    }
    let inflated = pose::inflated(expected.spec, expected.design, Some(prediction));
    for chart in list(&data["charts"]) {
        let star = chart["star"].as_u64().and_then(|star| usize::try_from(star).ok()?.checked_sub(1));
        let Some(right) = star.and_then(|star| prediction.stars.get(star)) else {
            return findings.add(
                FindingCode::OtherReport,
                None,
                "curves of no star",
                "those of the design's",
            );
        };
        let right = serde_json::to_value(right).unwrap_or_default();
        let row = list(&chart["by_pressure"]).iter().find(|row| near(&row["pressure_kPa"], &own.0.into()));
        // What is unknown is not drawn, and what is known is.
        let pose = star
            .and_then(|star| inflated.get(star))
            .map(|star| serde_json::to_value(Pose::of(star)).unwrap_or_default());
        let same = match row {
            None => right["final_radius_mm"].is_null(),
            Some(row) => {
                near(&row["final_radius_mm"], &right["final_radius_mm"])
                    && near(&row["object_force_N"], &right["object_force_N"])
                    && pose.is_none_or(|pose| {
                        pose.as_object().is_some_and(|pose| {
                            pose.iter().all(|(key, value)| beside(&row["pose"][key], value))
                        })
                    })
            }
        };
        if !same {
            let found = format!("star {}: curves that miss the prediction", chart["star"]);
            findings.add(FindingCode::OtherReport, None, found, format!("{} mm", right["final_radius_mm"]));
        }
    }
}

/// Whether two numbers are the same but for rounding, or two other values are equal.
fn near(a: &Value, b: &Value) -> bool {
    match (a.as_f64(), b.as_f64()) {
        (Some(a), Some(b)) => (a - b).abs() <= ROUNDED * b.abs().max(1e-3),
        _ => a == b,
    }
}

/// Whether two lengths, mm, or angles, deg, of a pose are the same to the eye.
fn beside(a: &Value, b: &Value) -> bool {
    a.as_f64().zip(b.as_f64()).is_some_and(|(a, b)| (a - b).abs() <= BESIDE)
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

/// The corners of a polyline, mm: hundredths, each a step from the one before.
fn corners(path: &Value) -> Option<Vec<Point>> {
    let steps: Option<Vec<f64>> = path.as_array()?.iter().map(Value::as_f64).collect();
    let mut at = Point::ORIGIN;
    let corner = |step: &[f64]| {
        at = Point::new(at.x + step[0], at.y + step[1]);
        Point::new(at.x / 100.0, at.y / 100.0)
    };
    Some(steps?.chunks_exact(2).map(corner).collect())
}
