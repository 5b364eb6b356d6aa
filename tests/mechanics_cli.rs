//! The commands of the mechanics as a user runs them.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const SPEC: &str = r#"schema = 1
name = "paper gripper"
[fabric]
seal_strength = "3 N/mm"
areal_density = "0.3 kg/m^2"
[star]
points = 5
inner_radius = "50 mm"
tube_width = "30 mm"
tip_angle = "30 deg"
[stack]
count = 3
[load]
pressure = "37 kPa"
object_radius = "30 mm"
friction = 0.5
"#;

fn run(dir: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_stargrip-cam")).current_dir(dir).args(args).output().expect("it runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

fn folder() -> tempfile::TempDir {
    let dir = tempfile::tempdir().expect("a folder");
    fs::write(dir.path().join("spec.toml"), SPEC).expect("written");
    dir
}

#[test]
fn predict_prints_one_json_object() {
    let dir = folder();
    let output = run(dir.path(), &["predict", "spec.toml", "--json"]);
    assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), String::new()));
    let value: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(value["model"], "ring");
    let fit = run(dir.path(), &["predict", "spec.toml", "--json", "--model", "fit"]);
    let value: serde_json::Value = serde_json::from_slice(&fit.stdout).expect("JSON");
    assert_eq!((value["model"].as_str(), value["lambda_t"]["tip"].as_f64()), (Some("fit"), Some(1.28)));
    assert!(text(&run(dir.path(), &["predict", "spec.toml"]).stdout).contains("payload of the whole stack"));
}

#[test]
fn refusals_point_at_the_key_and_end_with_one() {
    let dir = folder();
    fs::write(dir.path().join("spec.toml"), SPEC.replace("points = 5", "points = 9")).expect("written");
    let output = run(dir.path(), &["predict", "spec.toml"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("spec.toml:7"), "{}", text(&output.stderr));
    assert_eq!(run(dir.path(), &["predict", "spec.toml", "--model", "x"]).status.code(), Some(2));
}

#[test]
fn parts_of_a_sweep_join_to_the_whole() {
    let dir = folder();
    let vary = ["--vary", "star.points=3..6/4", "--vary", "star.tube_width=20 mm..40 mm/11"];
    let sweep = |more: &[&str]| {
        let output = run(dir.path(), &[&["sweep", "spec.toml"], &vary[..], more].concat());
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        text(&output.stdout)
    };
    let whole = sweep(&[]);
    assert_eq!(whole.lines().count(), 45);
    assert_eq!(whole, ["1/3", "2/3", "3/3"].map(|part| sweep(&["--part", part, "--threads", "1"])).concat());
    for wrong in ["0/3", "4/3", "x"] {
        let output = run(dir.path(), &[&["sweep", "spec.toml"], &vary[..], &["--part", wrong]].concat());
        assert_eq!(output.status.code(), Some(2));
    }
}

#[test]
fn optimize_ends_in_a_spec_that_keeps_its_promise() {
    let dir = folder();
    let args = [
        "optimize",
        "spec.toml",
        "--goal",
        "fabric",
        "--payload",
        "0.8",
        "--grasp",
        "18 mm..50 mm",
        "--points",
        "4..7",
    ];
    let output = run(dir.path(), &args);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    fs::write(dir.path().join("best.toml"), &output.stdout).expect("written");
    assert_eq!(run(dir.path(), &["check", "best.toml"]).status.code(), Some(0));
    let predicted = run(dir.path(), &["predict", "best.toml", "--json", "--model", "ring"]);
    let value: serde_json::Value = serde_json::from_slice(&predicted.stdout).expect("JSON");
    assert!(
        value["payload_kg"].as_f64() >= Some(0.8) && value["final_radius_mm"].as_f64() <= Some(18.0),
        "{value}"
    );
    let impossible = run(dir.path(), &["optimize", "spec.toml", "--payload", "1000", "--points", "5"]);
    assert_eq!(impossible.status.code(), Some(1));
    assert!(text(&impossible.stderr).contains("no design meets"));
}

#[test]
fn a_cone_test_is_laid_over_the_prediction() {
    let dir = folder();
    fs::write(dir.path().join("test.csv"), "travel_mm,load_N\n0,0\n10,2.5\n").expect("written");
    let output = run(dir.path(), &["cone", "test.csv", "--spec", "spec.toml"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(
        text(&output.stdout)
            .starts_with("travel_mm,load_N,radius_mm,force_N,linear_N,nonlinear_N\n0,0,15.676")
    );
    let published =
        run(dir.path(), &["cone", "test.csv", "--contact-radius", "15 mm", "--balance", "published"]);
    assert!(text(&published.stdout).contains("3.727761"), "{}", text(&published.stdout));
    assert_eq!(run(dir.path(), &["cone", "test.csv"]).status.code(), Some(1));
}

/// A spec of the same star, for `sweep` and for `check`: fabric is that of both sheets, as it is cut.
#[test]
fn a_sweep_has_the_fabric_that_check_has() {
    let dir = folder();
    let sweep = run(dir.path(), &["sweep", "spec.toml", "--vary", "star.points=4,5"]);
    let table = text(&sweep.stdout);
    let column = table.lines().next().and_then(|head| head.split(',').position(|key| key == "fabric_cm2"));
    let column = column.expect("a column");
    for (row, points) in table.lines().skip(1).zip([4, 5]) {
        let fabric: f64 = row.split(',').nth(column).and_then(|cell| cell.parse().ok()).expect("a number");
        let spec = SPEC.replace("points = 5", &format!("points = {points}"));
        fs::write(dir.path().join("one.toml"), spec).expect("written");
        let check = text(&run(dir.path(), &["check", "one.toml"]).stdout);
        assert!(check.contains(&format!("fabric {fabric:.0} cm2 in both sheets")), "{fabric}: {check}");
    }
}

/// The object of the search must fit into the star when it is inflated, not only when it is flat.
#[test]
fn optimize_opens_as_far_as_it_promises() {
    let dir = folder();
    let args = ["optimize", "spec.toml", "--grasp", "30 mm..45 mm", "--points", "8", "--goal", "fabric"];
    let output = run(dir.path(), &args);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    fs::write(dir.path().join("best.toml"), &output.stdout).expect("written");
    let predicted = run(dir.path(), &["predict", "best.toml", "--json", "--model", "ring"]);
    let value: serde_json::Value = serde_json::from_slice(&predicted.stdout).expect("JSON");
    let range = &value["graspable_radius_mm"];
    assert!(range[0].as_f64() <= Some(30.0) && range[1].as_f64() >= Some(45.0), "{range}");
}
