//! The commands of the mechanics as a user runs them.

use crate::support::inputs::{ACTUATOR, GRIPPER};
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

pub(super) fn run(dir: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_stargrip-cam")).current_dir(dir).args(args).output().expect("it runs")
}

pub(super) fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

pub(super) fn folder() -> tempfile::TempDir {
    let dir = tempfile::tempdir().expect("a folder");
    fs::write(dir.path().join("spec.toml"), GRIPPER).expect("written");
    dir
}

#[test]
fn predict_prints_one_json_object() {
    let dir = folder();
    let output = run(dir.path(), &["predict", "spec.toml", "--json"]);
    assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), String::new()));
    let value: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(value["model"], "section");
    let fit = run(dir.path(), &["predict", "spec.toml", "--json", "--model", "fit"]);
    let value: serde_json::Value = serde_json::from_slice(&fit.stdout).expect("JSON");
    assert_eq!((value["model"].as_str(), value["lambda_t"]["tip"].as_f64()), (Some("fit"), Some(1.28)));
    let [brief, full] = [&["predict", "spec.toml"][..], &["predict", "spec.toml", "-v"]]
        .map(|args| text(&run(dir.path(), args).stdout));
    assert!(brief.contains("payload of the whole stack"));
    // Values of the model itself are details.
    for row in ["target coiling", "hinge stiffness", "tip angle at rest", "bendability"] {
        assert!(full.contains(row) && !brief.contains(row), "{row}: {brief}");
    }
}

/// The spec of the paper's star under pressure, with all lengths by `scale`.
fn scaled_star(scale: f64) -> String {
    let lengths = [50.0, 30.0, 0.3, 2.0, 8.0, 1.0].map(|length: f64| format!("\"{} mm\"", length * scale));
    let [radius, width, thickness, band, allowance, flap] = lengths;
    format!(
        "schema = 1\nname = \"small\"\n[star]\npoints = 5\ninner_radius = {radius}\ntube_width = {width}\ntip_angle = \"30 deg\"\n\
         [fabric]\nthickness = {thickness}\n[seal]\nband = {band}\nallowance = {allowance}\nhole_allowance = {flap}\n\
         [load]\npressure = \"37 kPa\"\n"
    )
}

/// The predicted final radius, mm, of the spec `name` in `dir`, and the warnings.
fn final_radius(dir: &Path, name: &str) -> (f64, String) {
    let output = run(dir, &["predict", name, "--json"]);
    assert_eq!(output.status.code(), Some(0), "{name}: {}", text(&output.stderr));
    let value: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    (value["final_radius_mm"].as_f64().expect("a radius"), text(&output.stderr))
}

/// A star too small for a hose, registration holes and a frame is predicted all the same: its mechanics do not depend on its size.
#[test]
fn a_star_that_is_too_small_to_be_made_is_predicted() {
    let dir = folder();
    fs::write(dir.path().join("large.toml"), scaled_star(1.0)).expect("written");
    fs::write(dir.path().join("small.toml"), scaled_star(0.02)).expect("written");
    let (large, no_warnings) = final_radius(dir.path(), "large.toml");
    let (small, warnings) = final_radius(dir.path(), "small.toml");
    assert!((small / large - 0.02).abs() < 1e-6, "{small} {large}");
    assert!(
        no_warnings.is_empty() && warnings.contains("`check` refuses this design"),
        "{no_warnings}{warnings}"
    );
    assert_eq!(run(dir.path(), &["check", "small.toml"]).status.code(), Some(1));
}

#[test]
fn a_value_of_unknown_range_has_three_digits() {
    let said = text(&run(folder().path(), &["predict", "spec.toml", "--model", "fit"]).stdout);
    let unknown = said.lines().filter_map(|line| line.strip_suffix(", range unknown"));
    let digits = |line: &str| {
        line.chars()
            .rev()
            .skip_while(|c| !c.is_ascii_digit())
            .take_while(|c| "0123456789.".contains(*c))
            .count()
    };
    let most = unknown.map(digits).max().expect("values");
    assert!(most <= 6, "{said}");
    let hinge = [
        "actuator",
        "--tube-width",
        "20 mm",
        "--radius",
        "10 mm",
        "--arm-length",
        "180 mm",
        "--angle",
        "90 deg",
    ];
    let said = text(&run(folder().path(), &[&hinge[..], &["--pressure", "20 kPa"]].concat()).stdout);
    assert!(said.contains("ranges are unknown: no shell like this"), "{said}");
}

#[test]
fn refusals_point_at_the_key_and_end_with_one() {
    let dir = folder();
    fs::write(dir.path().join("spec.toml"), GRIPPER.replace("points = 5", "points = 9")).expect("written");
    let output = run(dir.path(), &["predict", "spec.toml"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("spec.toml:7"), "{}", text(&output.stderr));
    assert_eq!(run(dir.path(), &["predict", "spec.toml", "--model", "x"]).status.code(), Some(2));
}

/// A spec of the same star, for `sweep` and for `check`: the fabric is that of both sheets, as cut.
#[test]
fn a_sweep_has_the_fabric_that_check_has() {
    let dir = folder();
    let sweep = run(dir.path(), &["sweep", "spec.toml", "--vary", "star.points=4,5"]);
    let table = text(&sweep.stdout);
    let column = table.lines().next().and_then(|head| head.split(',').position(|key| key == "fabric_cm2"));
    let column = column.expect("a column");
    for (row, points) in table.lines().skip(1).zip([4, 5]) {
        let fabric: f64 = row.split(',').nth(column).and_then(|cell| cell.parse().ok()).expect("a number");
        let spec = GRIPPER.replace("points = 5", &format!("points = {points}"));
        fs::write(dir.path().join("one.toml"), spec).expect("written");
        let check = text(&run(dir.path(), &["check", "-v", "--anyway", "one.toml"]).stdout);
        assert!(check.contains(&format!("fabric {fabric:.0} cm2 in both sheets")), "{fabric}: {check}");
    }
}

fn actuator(more: &[&str]) -> Output {
    run(folder().path(), &[&ACTUATOR, more].concat())
}

#[test]
fn an_actuator_is_answered_by_every_model_of_its_hinge() {
    let mut before = f64::MAX;
    for model in ["section", "fit", "ring", "bvp"] {
        let output = actuator(&["--model", model, "--angles", "44 deg..60 deg/3", "--json"]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        let json: serde_json::Value = serde_json::from_str(&text(&output.stdout)).expect("one object");
        assert_eq!(json["model"], model);
        let number = |key: &str| json[key].as_f64().unwrap_or_else(|| panic!("{key}: {json}"));
        assert!(
            (number("bendability") / 329.0 - 1.0).abs() < 0.01 && (number("stretch") - 0.00729).abs() < 1e-4
        );
        assert!((number("coiling") - (180.0 - number("angle_deg")) / 120.0).abs() < 1e-12);
        assert!(json["volume_mm3"].is_null() && json["ranges"]["moment"].is_null());
        // Limit models have no ranges. The shell gives 36.35 deg and 0.0783 N m here (docs/models.md).
        let range = |key: &str| {
            serde_json::from_value::<Option<[f64; 2]>>(json["ranges"][key].clone()).expect("two ends")
        };
        for (key, shell) in [("angle_deg", 36.35), ("stiffness_Nm", 0.0783), ("coiling", 1.1971)] {
            let within = range(key)
                .map(|[low, high]| (low..=high).contains(&shell) && (low..=high).contains(&number(key)));
            assert_eq!(within, (model == "section").then_some(true), "{key}: {json}");
        }
        let moments: Vec<[f64; 2]> = serde_json::from_value(json["moment"].clone()).expect("pairs");
        assert!(moments.len() == 3 && (moments[2][0] - 60.0).abs() < 1e-9, "{moments:?}");
        // Beyond its rest angle an opening moment holds it. The membrane's moment is nearly constant below the onset, the section's grows.
        assert!(moments[0][0] > number("angle_deg") && moments[0][1] > 0.0, "{moments:?}");
        let growth = if model == "section" { 1.5 } else { 0.99 };
        assert!(moments.is_sorted_by(|a, b| b[1] > growth * a[1]), "{moments:?}");
        // At 14 kPa the limit models give softer hinges than `section`.
        assert!(number("stiffness_Nm") < 0.7 * before, "{json}");
        before = if model == "section" { number("stiffness_Nm") } else { before };
        // `section` models arms here; the limit models warn.
        let warnings = json["evidence"]["warnings"].as_array().expect("a list");
        assert_eq!(warnings.is_empty(), model == "section", "{warnings:?}");
    }
    let auto = actuator(&["--json"]);
    let json: serde_json::Value = serde_json::from_str(&text(&auto.stdout)).expect("one object");
    assert_eq!(json["model"], "section");
    assert!(json.get("moment").is_none());
    assert!(text(&actuator(&[]).stdout).contains("angle at rest"));
}

#[test]
fn an_actuator_that_no_model_covers_is_refused_in_words() {
    let soft = |pressure: &str| {
        let mut args = ACTUATOR.to_vec();
        args[10] = pressure;
        let output = run(folder().path(), &[&args[..], &["--young-modulus", "1 MPa"]].concat());
        (output.status.code(), text(&output.stderr))
    };
    let (code, said) = soft("14 MPa");
    let ends: Vec<&str> = said.split(' ').filter(|word| word.parse::<f64>().is_ok()).collect();
    let [_, least, most] = ends[..] else { panic!("{said}") };
    assert_eq!(code, Some(1), "{said}");
    for (number, code) in [(least, 0), (most, 0), ("1e-6", 1), ("1000", 1)] {
        assert_eq!(soft(&format!("{number} kPa")).0, Some(code), "{number} of {said}");
    }
    let unknown = actuator(&["--model", "shells"]);
    assert!(unknown.status.code() == Some(2) && text(&unknown.stderr).contains("section"));
    assert_eq!(actuator(&["--angles", "40 deg..60 deg"]).status.code(), Some(2));
}

#[test]
fn predict_takes_the_section_only_with_a_pressure() {
    let dir = folder();
    let output = run(dir.path(), &["predict", "spec.toml", "--model", "section", "--json"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let json: serde_json::Value = serde_json::from_str(&text(&output.stdout)).expect("one object");
    assert_eq!(json["model"], "section");
    let lambda = json["lambda_t"]["tip"].as_f64().expect("a number");
    assert!(lambda > 1.1 && lambda < 1.3 && json["lambda_c"]["tip"].is_null(), "{json}");
    let warnings = json["evidence"]["warnings"].to_string();
    assert!(!warnings.contains("without arms") && !warnings.contains("membrane's own"), "{warnings}");
    // 150 deg of arc coil by lambda, and the arms add a few degrees.
    let added = 180.0 - json["tip_target_angle_deg"].as_f64().expect("a number") - 150.0 * lambda;
    assert!((2.0..14.0).contains(&added), "{added}");
    let thin = GRIPPER.replace("[fabric]", "[fabric]\nthickness = \"0.1 mm\"").replace("37 kPa", "3 kPa");
    fs::write(dir.path().join("thin.toml"), thin).expect("written");
    let thin = run(dir.path(), &["predict", "thin.toml", "--model", "section"]);
    assert!(text(&thin.stdout).contains("without arms"), "{}", text(&thin.stdout));
    fs::write(dir.path().join("spec.toml"), GRIPPER.split("[load]").next().expect("text")).expect("written");
    let refused = run(dir.path(), &["predict", "spec.toml", "--model", "section"]);
    assert!(refused.status.code() == Some(1) && text(&refused.stderr).contains("needs a pressure"));
}
