//! Studies by slow models: their rows equal single predictions.

use std::fs;

use super::{done, folder, refused};

/// The rows of a CSV: each a list of cells, by the names of their columns.
fn rows(csv: &str) -> (Vec<&str>, Vec<Vec<&str>>) {
    let mut lines = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
    (lines.next().expect("a header"), lines.collect())
}

/// The number in JSON under `path`, "evidence.mesh_errors.volume_mm3"; `None` for null.
fn number(json: &serde_json::Value, path: &str) -> Option<f64> {
    path.split('.').fold(json, |value, key| &value[key]).as_f64()
}

fn agree(csv: &str, row: usize, json: &serde_json::Value, pairs: &[(&str, &str)]) {
    let (names, rows) = rows(csv);
    for (column, path) in pairs {
        let at =
            names.iter().position(|name| name == column).unwrap_or_else(|| panic!("{column}: {names:?}"));
        let found: Option<f64> = rows[row][at].parse().ok();
        let said = number(json, path);
        // A table has nine digits.
        let close = found.zip(said).map_or(found == said, |(a, b)| (a - b).abs() <= 1e-8 * b.abs());
        assert!(close, "{column}: {found:?}, {path}: {said:?}");
    }
}

const BVP: &str = "schema = 1\nspec = \"spec.toml\"\nmodel = \"bvp\"\noutputs = [\"final_radius_mm\", \"radial_stiffness_N_per_m\"]\n\
                   [vary]\nstar.tip_angle = \"30 deg..40 deg/4\"\n";

#[test]
fn a_row_by_bvp_says_what_a_prediction_says() {
    let dir = folder(&BVP.replace("\"30 deg..40 deg/4\"", "[\"30 deg\"]"));
    let csv = done(dir.path(), &["sweep", "study.toml"]);
    let said = done(dir.path(), &["predict", "spec.toml", "--model", "bvp", "--json"]);
    let json = serde_json::from_str(&said).expect("one object");
    let same = ["final_radius_mm", "radial_stiffness_N_per_m"].map(|name| (name, name));
    agree(&csv, 0, &json, &same);
}

#[test]
fn slow_rows_are_in_order_and_alike_by_any_number_of_threads() {
    let dir = folder(BVP);
    let [whole, single] = [&[][..], &["--threads", "1"]]
        .map(|more| done(dir.path(), &[&["sweep", "study.toml"], more].concat()));
    assert_eq!(whole, single);
    let numbers: Vec<&str> = rows(&whole).1.iter().map(|row| row[0]).collect();
    assert_eq!(numbers, ["0", "1", "2", "3"]);
}

/// A star of thick fabric at little pressure, which takes few steps.
const QUICK: &str = r#"schema = 1
name = "quick"
[fabric]
thickness = "0.5 mm"
areal_density = "0.3 kg/m^2"
[star]
points = 3
inner_radius = "30 mm"
tube_width = "20 mm"
tip_angle = "40 deg"
tip_radius = "3 mm"
corner_radius = "3 mm"
[stack]
count = 2
[load]
pressure = "30 kPa"
object_radius = "26 mm"
object_height = "100 mm"
object_shape = "cylinder"
friction = 0.5
"#;

#[test]
fn a_row_by_the_shell_says_what_a_prediction_says() {
    let study = "schema = 1\nspec = \"spec.toml\"\nfineness = \"coarse\"\n[vary]\naccuracy.model = [\"section\", \"shell\"]\n";
    let dir = folder(study);
    let at = dir.path();
    fs::write(at.join("spec.toml"), QUICK).expect("written");
    let csv = done(at, &["table", "study.toml"]);
    let (names, found) = rows(&csv);
    let of = |row: usize, name: &str| found[row][names.iter().position(|own| *own == name).expect(name)];
    assert_eq!((of(0, "accuracy.model"), of(1, "accuracy.model")), ("section", "shell"));
    // Each row has the values of its model.
    for name in ["final_radius_mesh_error_mm", "volume_mm3", "payload_mesh_error_kg"] {
        assert!(of(0, name).is_empty() && !of(1, name).is_empty(), "{name}: {csv}");
    }
    for name in ["widest_radius_mm", "largest_opening_mm"] {
        assert!(!of(0, name).is_empty() && of(1, name).is_empty(), "{name}: {csv}");
    }
    let args = ["predict", "spec.toml", "--model", "shell", "--fineness", "coarse", "--no-cache", "--json"];
    let json = serde_json::from_str(&done(at, &args)).expect("one object");
    agree(
        &csv,
        1,
        &json,
        &[
            ("arm_length_mm", "arm_length_mm"),
            ("tip_equilibrium_angle_deg", "tip_equilibrium_angle_deg"),
            ("tip_angle_deg", "tip_angle_deg"),
            ("final_radius_mm", "final_radius_mm"),
            ("contraction", "contraction"),
            ("operating_pressure_kPa", "operating_pressure_kPa"),
            ("radial_stiffness_N_per_m", "radial_stiffness_N_per_m"),
            ("object_force_N", "object_force_N"),
            ("payload_kg", "payload_kg"),
            ("bendability", "bendability"),
            ("stretch", "evidence.stretch"),
            ("mass_g", "mass_g"),
            ("volume_mm3", "volume_mm3"),
            ("arm_contact_N", "arm_contact_N"),
            ("arm_contact_mm2", "arm_contact_mm2"),
            ("seal_tension_N_per_mm", "seal_tension.value"),
            ("seal_tension_mesh_error_N_per_mm", "seal_tension.mesh_error"),
            ("largest_stretch", "stretch.value"),
            ("largest_stretch_mesh_error", "stretch.mesh_error"),
            ("seal_pull_N_per_mm", "seal_pull_N_per_mm"),
            ("seal_pull_mesh_error_N_per_mm", "evidence.mesh_errors.seal_pull_N_per_mm"),
            ("final_radius_mesh_error_mm", "evidence.mesh_errors.final_radius_mm"),
            ("contraction_mesh_error", "evidence.mesh_errors.contraction"),
            ("tip_angle_mesh_error_deg", "evidence.mesh_errors.tip_angle_deg"),
            ("radial_stiffness_mesh_error_N_per_m", "evidence.mesh_errors.radial_stiffness_N_per_m"),
            ("object_force_mesh_error_N", "evidence.mesh_errors.object_force_N"),
            ("volume_mesh_error_mm3", "evidence.mesh_errors.volume_mm3"),
            ("arm_contact_mesh_error_N", "evidence.mesh_errors.arm_contact_N"),
            ("arm_contact_mesh_error_mm2", "evidence.mesh_errors.arm_contact_mm2"),
        ],
    );
    // mu F / g of two stars, with standard gravity.
    let force: f64 = of(1, "object_force_mesh_error_N").parse().expect("a number");
    let payload: f64 = of(1, "payload_mesh_error_kg").parse().expect("a number");
    assert!((payload - 2.0 * 0.5 * force / 9.80665).abs() < 1e-6 * payload, "{payload} {force}");
}

#[test]
fn what_a_shell_refuses_is_said_in_its_row() {
    let study = "schema = 1\nspec = \"spec.toml\"\nmodel = \"shell\"\n[vary]\nstar.points = [17, 40]\n";
    let dir = folder(study);
    fs::write(dir.path().join("spec.toml"), QUICK.replace("30 mm", "300 mm")).expect("written");
    let csv = done(dir.path(), &["sweep", "study.toml"]);
    let last =
        |row: usize| csv.lines().nth(row).expect("a row").split_once("no-prediction,").expect("its code").1;
    let said = "\"star.points: 17 points, and shells of stars are computed with 3 to 16\"";
    assert_eq!((last(1), last(2).replace("40", "17").as_str()), (said, said));
}

#[test]
fn a_table_of_a_study_is_its_sweep() {
    let dir = folder(super::STUDY);
    let at = dir.path();
    let table = done(at, &["table", "study.toml", "--units"]);
    assert_eq!(table, done(at, &["sweep", "study.toml", "--units"]));
    let said = refused(at, &["table", "stduy.toml"], 1);
    assert!(said.contains("stduy.toml") && !at.join("stduy.toml").exists(), "{said}");
}
