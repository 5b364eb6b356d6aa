//! Predictions from specs: the keys that scripts rely on, the extremes, agreement with the design stage.

use crate::support::inputs::GRIPPER as PAPER;
use crate::support::keys;
use proptest::prelude::*;
use serde_json::Value;
use stargrip_cam::design::{Design, Refusals};
use stargrip_cam::forecast::predict;
use stargrip_cam::forecast::predict::PredictFault;
use stargrip_cam::forecast::prediction::{Prediction, StarPrediction};
use stargrip_cam::forecast::ranges::StarRanges;
use stargrip_cam::manifest::manifest_of;
use stargrip_cam::plan;
use stargrip_cam::spec::{Machine, ModelChoice, Source, Spec, builtin_machine, key, read, read_machine};
use stargrip_cam::units::{Length, Pressure};

pub(super) fn spec(text: &str) -> Spec {
    match read(&Source::new("test", text)) {
        Ok(reading) => reading.spec,
        Err(faults) => panic!("{faults}"),
    }
}

pub(super) fn machine() -> Machine {
    let profile = Source::new("generic", builtin_machine("generic").expect("built in"));
    read_machine(&profile).expect("valid")
}

pub(super) fn design(spec: &Spec) -> Result<Design, Refusals> {
    Design::new(spec, &machine())
}

/// The prediction of the design of `spec`.
pub(super) fn predict(spec: &Spec) -> Result<Prediction, PredictFault> {
    predict::predict(spec, &design(spec).expect("makeable"))
}

/// Every number in `value` that is not finite is null in JSON; collects the paths of the nulls.
fn nulls(path: &str, value: &Value, found: &mut Vec<String>) {
    match value {
        Value::Null => found.push(path.to_owned()),
        Value::Object(map) => map.iter().for_each(|(k, v)| nulls(&format!("{path}/{k}"), v, found)),
        Value::Array(list) => list.iter().for_each(|v| nulls(path, v, found)),
        _ => {}
    }
}

fn json(prediction: &Prediction) -> Value {
    serde_json::to_value(prediction).expect("serialises")
}

/// The numbers of the paper's gripper with the seal's strength, and between which values each is in the unit of its key: radians for
/// degrees, m for mm or N/m for N/mm lie outside.
const IN_UNITS: [(&str, f64, f64); 36] = [
    ("/lambda_t/tip", 1.0, 1.571),
    ("/lambda_t/corner", 1.0, 1.571),
    ("/d2v_dlambda2/tip", -0.7, -0.3),
    ("/d2v_dlambda2/corner", -0.7, -0.3),
    ("/arm_length_mm", 69.72, 69.73),
    ("/tip_target_angle_deg", -12.0, -4.0),
    ("/corner_target_angle_deg", 75.0, 85.0),
    ("/tip_equilibrium_angle_deg", 0.5, 3.0),
    ("/final_radius_mm", 16.0, 19.0),
    ("/contraction", 0.62, 0.68),
    ("/hinge_stiffness_Nm/tip", 0.1, 0.3),
    ("/hinge_stiffness_Nm/corner", 0.2, 0.5),
    ("/radial_stiffness_N_per_m", 500.0, 800.0),
    ("/preload_N", 0.0, 0.0),
    ("/graspable_radius_mm/0", 16.0, 19.0),
    ("/graspable_radius_mm/1", 47.0, 47.0),
    ("/hole_radius_mm", 47.0, 47.0),
    ("/object_radius_mm", 30.0, 30.0),
    ("/object_gap_mm", 17.0, 17.0),
    ("/object_force_N", 7.0, 15.0),
    ("/bendability", 2941.0, 2942.0),
    ("/operating_pressure_kPa", 10.0, 15.0),
    ("/realised_radius_mm/tip", 1.0, 1.0),
    ("/seal_load/tip", 3.0, 5.0),
    ("/seal_pull_N_per_mm", 3.3, 5.3),
    ("/burst_pressure_kPa", 19.0, 33.0),
    ("/mass_g", 26.0, 27.0),
    ("/stack_mass_g", 78.0, 81.0),
    ("/payload_kg", 1.2, 2.3),
    ("/stretch", 0.0289, 0.029),
    ("/burst_margin", 0.5, 0.9),
    ("/ranges/final_radius_mm/0", 16.0, 17.7),
    ("/ranges/final_radius_mm/1", 17.6, 19.0),
    ("/ranges/object_force_N/0", 7.0, 11.2),
    ("/ranges/object_force_N/1", 11.1, 17.0),
    ("/evidence/hinge_width/tip", 0.637, 1.0),
];

#[test]
fn every_number_has_the_sign_and_the_unit_of_its_key() {
    let value = json(&predict(&spec(PAPER)).expect("predictable"));
    for (path, low, high) in IN_UNITS {
        let found =
            value.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("no number: {path}"));
        assert!((low - 1e-9..=high + 1e-9).contains(&found), "{path} is {found}, not {low} to {high}");
    }
    // The seal is too weak for this pressure, and the answer has a code for it.
    let words = ["/model", "/seal_pull_at", "/ranges_of", "/verdict/holds", "/verdict/code"];
    let said = words.map(|path| value.pointer(path).and_then(Value::as_str).unwrap_or_default());
    assert_eq!(said, ["section", "tips", "shell", "no", "bursts"]);
    assert_eq!(value["evidence"]["warnings"].as_array().map(Vec::len), Some(1));
    assert_eq!(value["stars"].as_array().map(Vec::len), Some(3));
}

/// With and without a load, by every model of hinges: the answer agrees with `keys`.
#[test]
fn every_key_has_its_meaning() {
    let bare = PAPER.split("[load]").next().unwrap_or_default();
    let models =
        [ModelChoice::Auto, ModelChoice::Fit, ModelChoice::Ring, ModelChoice::Bvp, ModelChoice::Section];
    for (text, model) in [PAPER, bare].iter().flat_map(|text| models.map(|model| (text, model))) {
        let mut spec = spec(text);
        spec.accuracy.model = model;
        let Ok(prediction) = predict(&spec) else { continue };
        let found = keys::misfits(&json(&prediction), Prediction::KEYS);
        assert_eq!(found, Vec::<String>::new(), "{model:?}");
    }
}

#[test]
fn what_is_not_asked_for_is_null() {
    let bare = PAPER.split("[load]").next().unwrap_or_default().replace("seal_strength = \"3 N/mm\"", "");
    let value = json(&predict(&spec(&bare)).expect("predictable"));
    let depends = [
        "hinge_stiffness_Nm",
        "radial_stiffness_N_per_m",
        "bendability",
        "burst_pressure_kPa",
        "payload_kg",
        "final_radius_mm",
        "contraction",
        "tip_equilibrium_angle_deg",
        "graspable_radius_mm",
    ];
    for key in depends {
        assert!(value[key].is_null(), "{key}");
    }
    assert!(
        value["lambda_t"]["tip"].is_null()
            && value["arm_length_mm"].is_number()
            && value["mass_g"].is_number()
    );
    let rows = value["pressures"].as_array().expect("a table");
    assert!(rows.len() > 8 && rows.iter().filter(|row| row["best"] == true).count() == 1, "{rows:?}");
    // A limit selected by name gives the same answer at any pressure.
    let mut limit = spec(&bare);
    limit.accuracy.model = ModelChoice::Ring;
    let value = json(&predict(&limit).expect("predictable"));
    assert!(value["final_radius_mm"].is_number() && value.get("pressures").is_none());
    assert!(value["ranges"]["final_radius_mm"].is_null() && value["hinge_stiffness_Nm"].is_null());
}

/// Every quantity of a model has the range of a shell's values, and lies in it.
#[test]
fn at_a_pressure_everything_has_its_range() {
    for points in 3..=7 {
        let mut spec = spec(&PAPER.replace("[load]", "[seal]\nband = \"1 mm\"\n[load]"));
        spec.stars.iter_mut().for_each(|star| star.points = points);
        let value = json(&predict(&spec).expect("predictable"));
        assert_eq!(value["model"], "section");
        let within = |found: &Value, range: &Value, key: &str| {
            let [low, high] =
                [0, 1].map(|end| range[end].as_f64().unwrap_or_else(|| panic!("{key}: {range}")));
            let found = found.as_f64().expect("a number");
            assert!(low <= found && found <= high && low < high, "n = {points}, {key}: {found} in {range}");
        };
        for key in ["final_radius_mm", "contraction"] {
            within(&value[key], &value["ranges"][key], key);
        }
        if points < 6 {
            // A band of 1 mm makes hinges sharper than any whose pull was computed as a shell.
            assert!(value["ranges"]["seal_pull_N_per_mm"].is_null(), "n = {points}");
            let mut wider = spec.clone();
            wider.seal.band = Length(2.0);
            let value = json(&predict(&wider).expect("predictable"));
            for key in ["seal_pull_N_per_mm", "burst_pressure_kPa"] {
                within(&value[key], &value["ranges"][key], key);
            }
        }
        for hinge in ["tip", "corner"] {
            let key = "hinge_stiffness_Nm";
            within(&value[key][hinge], &value["ranges"][key][hinge], key);
        }
        let shut = value["preload_N"].as_f64() > Some(0.0);
        assert_eq!(value["ranges"]["radial_stiffness_N_per_m"].is_null(), shut, "n = {points}");
        let [radius, contraction] = ["final_radius_mm", "contraction"].map(|key| &value["ranges"][key]);
        let close =
            (contraction[0].as_f64().expect("low") - 1.0 + radius[1].as_f64().expect("high") / 50.0).abs();
        assert!(close < 1e-12);
    }
}

#[test]
fn where_no_model_covers_a_star_nothing_is_said_of_it() {
    let mut soft = spec(PAPER);
    soft.load.as_mut().expect("given").pressure = Some(Pressure(400.0));
    let prediction = predict(&soft).expect("an answer");
    let star = &prediction.first;
    // The pressure at which its seal bursts does not depend on the pressure of the load.
    let burst_only =
        StarRanges { burst_pressure_kPa: star.ranges.burst_pressure_kPa, ..StarRanges::default() };
    assert_eq!((star.final_radius_mm, star.object_force_N, star.ranges), (None, None, burst_only));
    let warnings = &star.evidence.warnings;
    assert!(
        warnings[0].text.contains("section does not cover") && warnings[0].text.contains("allowed is"),
        "{warnings:?}"
    );
    let page = stargrip_cam::forecast::report::text(&soft, &prediction, true);
    assert!(page.contains("closes to, across             unknown\n"), "{page}");
}

/// A star that closes to 2 mm of the axis has flaps of 4 mm, which meet there.
#[test]
fn the_edge_of_a_flap_is_never_beyond_the_axis() {
    let star =
        "[star]\npoints = 3\ninner_radius = \"13.6 mm\"\ntube_width = \"13 mm\"\ntip_angle = \"15 deg\"\n";
    let radii = "tip_radius = \"2 mm\"\ncorner_radius = \"2 mm\"\n";
    let marble = spec(&format!("schema = 1\nname = \"x\"\n{star}{radii}[load]\npressure = \"58.3 kPa\"\n"));
    let prediction = predict(&marble).expect("predicted");
    assert!(prediction.first.final_radius_mm.is_some_and(|radius| radius < 2.5));
    assert_eq!(prediction.first.flap_edge_radius_mm, Some(0.0));
}

/// A coarse shell of this star, whose arms touch while it is empty, presses with 21 +- 3 N (docs/ranges.md).
#[test]
fn arms_that_touch_have_a_force_once_an_object_separates_them() {
    let text = include_str!("../../designs/basketball.toml");
    let load = "\n[load]\npressure = \"7 kPa\"\nobject_radius = \"120 mm\"\n";
    let star = predict(&spec(&format!("{text}{load}"))).expect("predicted").stars.remove(0);
    let force = star.object_force_N.expect("a force");
    let [low, high] = star.ranges.object_force_N.expect("a range");
    assert!((force / 21.0 - 1.0).abs() < 0.25 && low < 16.0 && high > 24.0, "{low} {force} {high}");
    assert!(star.radial_stiffness_N_per_m.is_none() && star.preload_N.is_none());
}

#[test]
fn the_fit_gives_the_papers_final_radii() {
    for (points, radius) in (3..).zip([27.8, 15.8, 14.7, 19.1, 24.9, 30.8]) {
        // Eight points leave room for a narrow band only.
        let mut spec = spec(&PAPER.replace("[load]", "[seal]\nband = \"1 mm\"\n[load]"));
        spec.accuracy.model = ModelChoice::Fit;
        spec.stars.iter_mut().for_each(|star| star.points = points);
        let prediction = predict(&spec).expect("feasible");
        assert!((prediction.first.final_radius_mm.expect("a limit") - radius).abs() < 0.05, "n = {points}");
        assert_eq!(prediction.first.model, "fit");
    }
}

#[test]
fn all_models_answer_and_agree() {
    let answer = |model| {
        let mut spec = spec(PAPER);
        spec.accuracy.model = model;
        predict(&spec).expect("predictable").first
    };
    let [fit, ring, bvp] = [ModelChoice::Fit, ModelChoice::Ring, ModelChoice::Bvp].map(answer);
    let tip = |of: &StarPrediction| of.lambda_t.tip.expect("a limit");
    assert!((tip(&ring) - tip(&bvp)).abs() < 0.02 && (tip(&ring) - tip(&fit)).abs() < 0.02);
    let radius = |of: &StarPrediction| of.final_radius_mm.expect("a limit");
    assert!((radius(&ring) / radius(&bvp) - 1.0).abs() < 0.15);
    // A limit has no range; the seal's ranges do not depend on the model.
    let StarRanges { seal_pull_N_per_mm, burst_pressure_kPa, .. } = ring.ranges;
    assert!(seal_pull_N_per_mm.is_some() && burst_pressure_kPa.is_some());
    let of_the_seal = StarRanges { seal_pull_N_per_mm, burst_pressure_kPa, ..StarRanges::default() };
    assert_eq!([fit.ranges, ring.ranges, bvp.ranges], [of_the_seal; 3]);
    assert!(fit.nonlinear.is_none() && ring.nonlinear.is_some() && bvp.nonlinear.is_some());
    assert!(!fit.evidence.warnings.is_empty(), "the published coiling does not cover R* = 0");
}

#[test]
fn refusals_name_the_key() {
    let refused = |change: fn(&mut Spec)| {
        let (mut spec, design) = (spec(PAPER), design(&spec(PAPER)).expect("makeable"));
        change(&mut spec);
        predict::predict(&spec, &design).expect_err("refused")
    };
    assert_eq!(refused(|s| s.fabric.young_modulus = Pressure(0.0)).key, key::fabric::YOUNG_MODULUS);
}

/// One figure under one name: manifest, prediction and the exact outline.
#[test]
fn masses_of_manifest_and_prediction_are_the_same() {
    for (points, radius) in [(5, 0.0), (4, 0.0), (5, 3.0), (6, 1.0)] {
        let mut spec = spec(PAPER);
        for star in &mut spec.stars {
            star.points = points;
            (star.tip_radius.0, star.corner_radius.0) = (radius, radius);
        }
        // A stack of stars that differ.
        spec.stars[2].inner_radius = Length(48.0);
        let design = design(&spec).expect("makeable");
        let programs = plan::seal_programs(&spec, &machine(), &design);
        let manifest = manifest_of(&spec, &design, &programs, &[], None);
        let prediction = predict::predict(&spec, &design).expect("predictable");
        let printed = |mass: Option<f64>| format!("{:.3}", mass.expect("density is given"));
        for (listed, predicted) in manifest.stars.iter().zip(&prediction.stars) {
            assert_eq!(printed(listed.mass_g), printed(predicted.mass_g), "n = {points}, R = {radius}");
        }
        assert_eq!(prediction.first.mass_g, prediction.stars[0].mass_g);
        let (listed, predicted) = (manifest.mass_g.expect("given"), prediction.stack_mass_g.expect("given"));
        assert!((listed - predicted).abs() < 2e-3, "three roundings to a thousandth: {listed} {predicted}");
        let exact: f64 = design
            .assembly()
            .expect("stars")
            .stars
            .iter()
            .map(|star| 2.0 * design.assembly().expect("stars").part(star).outline.area() * 0.3e-3)
            .sum();
        assert!((predicted / exact - 1.0).abs() < 1e-12, "{predicted} {exact}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    /// Sizes from 1 mm to 100 m, pressures from 1 Pa to 1 MPa, any angle, up to 64 points: an answer whose numbers are
    /// all finite, or a refusal.
    #[test]
    fn no_extreme_yields_a_number_that_is_none(
        points in 3_u32..=64,
        size in -0.0_f64..5.0,
        width in 0.001_f64..2.0,
        angle in prop_oneof![1e-6_f64..1.0, 1.0..179.0, 179.0..179.999_999],
        r_i in prop_oneof![Just(0.0), 1e-9_f64..10.0],
        r_e in prop_oneof![Just(0.0), 1e-9_f64..10.0],
        pressure in -3.0_f64..3.0,
        object in 0.0_f64..1.2,
        fit in any::<bool>(),
    ) {
        let mut spec = spec(PAPER);
        spec.accuracy.model = if fit { ModelChoice::Fit } else { ModelChoice::Ring };
        let rho = 10_f64.powf(size);
        spec.stars.truncate(1);
        let star = &mut spec.stars[0];
        star.points = points;
        star.inner_radius.0 = rho;
        star.tube_width.0 = width * rho;
        star.tip_angle.0 = angle;
        star.tip_radius.0 = r_i * width * rho;
        star.corner_radius.0 = r_e * width * rho;
        let load = spec.load.as_mut().expect("given");
        load.pressure = Some(Pressure(10_f64.powf(pressure)));
        load.object_radius = Some(Length(object * rho));
        // No flaps, holes or inlet that would keep most of these stars from being made.
        spec.inlet = None;
        spec.sheet.hole_diameter = Length(0.0);
        spec.seal.band = Length(1e-3 * width * rho);
        (spec.seal.allowance, spec.seal.hole_allowance) = (Length(0.0), Length(0.0));
        let Ok(design) = design(&spec) else { return Ok(()) };
        if let Ok(prediction) = predict::predict(&spec, &design) {
            let mut found = Vec::new();
            nulls("", &json(&prediction), &mut found);
            // Values that may be absent: those that the fit does not give, and those that the object or the seal make impossible.
            let allowed = [
                "lambda_c", "nonlinear", "hinge_width", "safe_radius_mm", "payload_kg", "object_force_N", "flap_force_N", "arm_wrinkling_kg",
                "arm_folding_kg", "ranges",
                "verdict",
            ];
            found.retain(|path| !allowed.iter().any(|key| path.contains(key)));
            prop_assert!(found.is_empty(), "{found:?}");
            let radius = prediction.first.final_radius_mm.expect("a limit");
            prop_assert!(radius > 0.0 && radius.is_finite());
        }
    }
}

/// A tube of a thousandth of a millimetre, which is not realistic: its mask's outline has points that are nearly one.
#[test]
fn a_tube_of_a_micrometre_is_answered_or_refused() {
    let mut spec = spec(PAPER);
    spec.stars.truncate(1);
    let star = &mut spec.stars[0];
    (star.points, star.tip_angle.0) = (61, 173.989_984_353_496_77);
    (star.inner_radius.0, star.tube_width.0) = (1.0, 0.001);
    spec.accuracy.model = ModelChoice::Ring;
    spec.inlet = None;
    spec.sheet.hole_diameter = Length(0.0);
    spec.seal.band = Length(1e-6);
    (spec.seal.allowance, spec.seal.hole_allowance) = (Length(0.0), Length(0.0));
    if let Ok(design) = design(&spec) {
        assert!(predict::predict(&spec, &design).is_ok());
    }
}
