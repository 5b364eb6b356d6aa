//! The shell model as a user runs it, on coarse meshes: keys, refusals, the cache, and the state after an interruption.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use crate::support::inputs::ACTUATOR;
use stargrip_cam::forecast::actuator::ActuatorPrediction;
use stargrip_cam::forecast::prediction::Prediction;

use crate::support::keys;

const SPEC: &str = r#"schema = 1
name = "a star for the shell"
[fabric]
areal_density = "0.3 kg/m^2"
[star]
points = 5
inner_radius = "50 mm"
tube_width = "30 mm"
tip_angle = "40 deg"
tip_radius = "3 mm"
corner_radius = "3 mm"
[load]
pressure = "20 kPa"
object_radius = "36 mm"
friction = 0.5
"#;

/// Options for an answer in seconds.
const COARSE: [&str; 4] = ["--model", "shell", "--fineness", "coarse"];

fn command(dir: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_stargrip-cam"));
    let _ = command.current_dir(dir).env("XDG_CACHE_HOME", dir.join("cache"));
    command
}

fn run(dir: &Path, args: &[&str]) -> Output {
    command(dir).args(args).output().expect("it runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

fn json(output: &Output) -> serde_json::Value {
    assert!(output.status.success(), "{}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("one object")
}

fn folder() -> tempfile::TempDir {
    let dir = tempfile::tempdir().expect("a folder");
    fs::write(dir.path().join("spec.toml"), SPEC).expect("written");
    dir
}

/// Files in the cache.
fn kept(dir: &Path) -> Vec<std::path::PathBuf> {
    let entries = fs::read_dir(dir.join("cache/stargrip-cam"));
    entries.map_or(Vec::new(), |entries| entries.map(|entry| entry.expect("an entry").path()).collect())
}

#[test]
fn an_actuator_is_a_shell_with_its_mesh_errors() {
    let dir = folder();
    let args = [&ACTUATOR[..], &COARSE, &["--angles", "40 deg..50 deg/2", "--json"]].concat();
    let first = run(dir.path(), &args);
    let prediction = json(&first);
    assert!(prediction["model"] == "shell" && prediction["ranges"]["angle_deg"].is_null(), "{prediction}");
    assert_eq!(keys::misfits(&prediction, &[ActuatorPrediction::KEYS]), Vec::<String>::new());
    let number = |key: &str| prediction[key].as_f64().unwrap_or_else(|| panic!("{key}: {prediction}"));
    let error = |key: &str| {
        prediction["evidence"]["mesh_errors"][key].as_f64().unwrap_or_else(|| panic!("{key}: {prediction}"))
    };
    // Results of the finest meshes so far, with their errors, and of CalculiX (docs/models.md).
    for (key, known, open) in
        [("angle_deg", 36.3, 0.3), ("volume_mm3", 21_730.0, 20.0), ("stiffness_Nm", 0.078, 0.002)]
    {
        assert!(
            (number(key) - known).abs() <= error(key) + open && error(key) < 0.1 * known,
            "{key}: {prediction}"
        );
    }
    assert!((number("coiling") - (180.0 - number("angle_deg")) / 120.0).abs() < 1e-12);
    // Held open, its moment follows its stiffness, and grows faster at larger opening.
    let moments: Vec<[f64; 2]> = serde_json::from_value(prediction["moment"].clone()).expect("pairs");
    for [angle, moment] in &moments {
        let linear = number("stiffness_Nm") * (angle - number("angle_deg")).to_radians();
        assert!((0.8..1.8).contains(&(moment / linear)), "{angle}: {moment} {linear}");
    }
    assert_eq!(prediction["evidence"]["mesh_errors"]["moment_Nm"].as_array().map(Vec::len), Some(2));
    assert_eq!(prediction["evidence"]["unknowns"].as_array().map(Vec::len), Some(3));

    // The answer is stored, and the stored answer is printed; a damaged one is computed again.
    let [file] = &kept(dir.path())[..] else { panic!("{:?}", kept(dir.path())) };
    let whole = fs::read(file).expect("kept");
    fs::write(file, &whole[..whole.len() / 2]).expect("torn");
    assert_eq!(run(dir.path(), &args).stdout, first.stdout);
    assert_eq!(fs::read(file).expect("kept"), whole);
    let said = text(&run(dir.path(), &args[..args.len() - 1]).stdout);
    assert!(said.contains("mesh error") && said.contains("volume"), "{said}");
    assert_eq!(kept(dir.path()).len(), 1, "text and JSON are one answer");
    assert_eq!(run(dir.path(), &[&args[..], &["--no-cache"]].concat()).stdout, first.stdout);
}

#[test]
fn its_sheet_is_a_vtu_file() {
    let dir = folder();
    let args = [&ACTUATOR[..], &COARSE, &["--vtu", "sheet.vtu"]].concat();
    assert!(run(dir.path(), &args).status.success());
    let file = dir.path().join("sheet.vtu");
    let first = fs::read_to_string(&file).expect("written");
    for name in ["stretch", "tension, N/m", "curvature, 1/m", "flat, mm"] {
        assert!(first.contains(&format!("Name=\"{name}\"")), "{name}");
    }
    // It is replaced, and a file of another kind is not.
    assert!(run(dir.path(), &args).status.success());
    let refused = run(dir.path(), &[&ACTUATOR[..], &COARSE, &["--vtu", "spec.toml"]].concat());
    assert!(
        refused.status.code() == Some(1)
            && text(&refused.stderr).contains("spec.toml exists and is not a VTU file")
    );
    for option in ["--csv", "--svg"] {
        let refused = run(dir.path(), &["trade", option, "spec.toml"]);
        assert!(
            refused.status.code() == Some(1) && text(&refused.stderr).contains("spec.toml exists and is not")
        );
    }
    assert_eq!(fs::read_to_string(dir.path().join("spec.toml")).expect("it"), SPEC);
    fs::remove_file(&file).expect("removed");
    assert!(run(dir.path(), &args).status.success());
    assert_eq!(fs::read_to_string(&file).expect("written again"), first);
    let nowhere = run(dir.path(), &[&ACTUATOR[..], &COARSE, &["--vtu", "no/such/folder.vtu"]].concat());
    assert!(nowhere.status.code() == Some(1) && text(&nowhere.stderr).contains("cannot write"));
    let ring = [&ACTUATOR[..], &["--model", "ring", "--vtu", "sheet.vtu"]].concat();
    assert_eq!(run(dir.path(), &ring).status.code(), Some(2));
}

#[test]
fn its_body_is_a_closed_solid() {
    let dir = folder();
    let args = [&ACTUATOR[..], &COARSE, &["--stl", "body.stl", "--obj", "body.obj"]].concat();
    assert!(run(dir.path(), &args).status.success());
    let files = ["body.stl", "body.obj"].map(|name| dir.path().join(name));
    let [stl, obj] = files.each_ref().map(|file| fs::read(file).expect("written"));
    // Each edge has two triangles, so there are three edges for two of them.
    let triangles = (stl.len() - 84) / 50;
    let lines = String::from_utf8(obj.clone()).expect("text");
    let counts =
        ["f ", "v ", "g seam", "g "].map(|word| lines.lines().filter(|line| line.starts_with(word)).count());
    // The second is Euler's number of a sphere.
    assert_eq!(counts, [triangles, 2 + triangles * 3 / 2 - triangles, 1, 3]);
    // From the cache, and over their own kind alone.
    fs::remove_file(dir.path().join("body.stl")).expect("removed");
    assert!(run(dir.path(), &args).status.success());
    assert_eq!(files.each_ref().map(|file| fs::read(file).expect("written")), [stl, obj]);
    for (option, file) in [("--stl", "spec.toml"), ("--obj", "body.stl"), ("--stl", "body.obj")] {
        let refusal = run(dir.path(), &[&ACTUATOR[..], &COARSE, &[option, file]].concat());
        assert!(
            refusal.status.code() == Some(1) && text(&refusal.stderr).contains("file of an inflated body"),
            "{option} {file}: {}",
            text(&refusal.stderr)
        );
    }
}

#[test]
fn a_star_is_a_shell_with_its_mesh_errors() {
    let dir = folder();
    let args = ["predict", "spec.toml", "--model", "shell", "--fineness", "coarse"];
    let prediction = json(&run(dir.path(), &[&args[..], &["--radii", "38 mm", "--json"]].concat()));
    assert_eq!(keys::misfits(&prediction, Prediction::KEYS), Vec::<String>::new());
    let number = |key: &str| prediction[key].as_f64().unwrap_or_else(|| panic!("{key}: {prediction}"));
    assert!(prediction["model"] == "shell" && prediction["lambda_t"]["tip"].is_null(), "{prediction}");
    assert!((25.0..35.0).contains(&number("final_radius_mm")), "{prediction}");
    assert!((number("contraction") - 1.0 + number("final_radius_mm") / 50.0).abs() < 1e-12);
    assert!((number("payload_kg") - 0.5 * number("object_force_N") / 9.806_65).abs() < 1e-9);
    let [least, most] =
        [0, 1].map(|end| prediction["object_force_friction_N"][end].as_f64().expect("a force"));
    assert!((least + most - 2.0 * number("object_force_N")).abs() < 1e-9 && least <= most, "{prediction}");
    let curve = prediction["force_curve"].as_array().expect("a list");
    assert!(
        curve.len() == 1
            && curve[0][1].as_f64() > prediction["object_force_N"].as_f64()
            && curve[0][2].is_null()
    );
    let errors = &prediction["evidence"]["mesh_errors"];
    for key in
        ["final_radius_mm", "radial_stiffness_N_per_m", "volume_mm3", "object_force_N", "seal_pull_N_per_mm"]
    {
        assert!(errors[key].as_f64().is_some_and(|error| error > 0.0), "{key}: {errors}");
    }
    let [x, y] = [0, 1].map(|c| prediction["seal_tension"]["at_mm"][c].as_f64().expect("a place"));
    assert!(number("seal_pull_N_per_mm") > 0.0 && prediction["seal_pull_at_mm"].is_array(), "{prediction}");
    assert!(number("mass_g") > 0.0 && (49.0..200.0).contains(&x.hypot(y)), "{prediction}");
    assert_eq!(prediction["stars"].as_array().map(Vec::len), Some(1));
    assert_eq!(prediction["stars"][0]["final_radius_mm"], prediction["final_radius_mm"]);
}

/// The model that `predict --accuracy` selects for the spec in `dir`, and the search that led to it.
fn search(dir: &Path, accuracy: &str) -> (serde_json::Value, serde_json::Value) {
    let answer = json(&run(dir, &["predict", "spec.toml", "--accuracy", accuracy, "--json"]));
    (answer["model"].clone(), answer["evidence"]["accuracy"].clone())
}

#[test]
fn an_accuracy_selects_the_cheapest_model_that_states_it() {
    let dir = folder();
    let (model, evidence) = search(dir.path(), "90 %");
    assert!(model == "section" && evidence["met"] == true, "{evidence}");
    assert_eq!(evidence["trials"].as_array().map(Vec::len), Some(1), "no shell is computed: {evidence}");
    let error = evidence["trials"][0]["error"].as_f64().expect("a range");
    assert!((0.05..0.9).contains(&error), "{evidence}");
    // The table does not reach these arms; the shell has no force to state.
    let long_arms = SPEC
        .replace("points = 5", "points = 11")
        .replace("50 mm", "400 mm")
        .replace("= \"40 deg\"", "= \"10 deg\"");
    let (free, _) = long_arms.split_once("object_radius").expect("an object");
    fs::write(dir.path().join("spec.toml"), free).expect("written");
    let (model, evidence) = search(dir.path(), "30 %");
    assert!(model == "shell" && evidence["met"] == true, "{evidence}");
    let trials = evidence["trials"].as_array().expect("a list");
    assert!(trials.len() == 2 && trials[0]["error"].is_null(), "{evidence}");
    assert!(trials[1]["fineness"] == "coarse" && trials[1]["error"].as_f64() >= Some(0.05), "{evidence}");
    // Without a pressure there is no error to compare.
    fs::write(dir.path().join("spec.toml"), free.split_once("[load]").expect("a load").0).expect("written");
    let refused = run(dir.path(), &["predict", "spec.toml", "--accuracy", "30 %"]);
    assert!(refused.status.code() == Some(1) && text(&refused.stderr).contains("set `pressure` in [load]"));
    for options in [["--model", "ring"], ["--fineness", "coarse"], ["--accuracy", "0 %"]] {
        let mut args = vec!["predict", "spec.toml", "--accuracy", "30 %"];
        args.extend(options);
        assert_eq!(run(dir.path(), &args).status.code(), Some(2), "{options:?}");
    }
}

#[test]
fn what_no_shell_answers_is_refused_in_words() {
    let dir = folder();
    let predict = |from: &str, to: &str| {
        fs::write(dir.path().join("other.toml"), SPEC.replace(from, to)).expect("written");
        let output = run(dir.path(), &["predict", "other.toml", "--model", "shell", "--fineness", "coarse"]);
        assert_eq!((output.status.code(), output.stdout.len()), (Some(1), 0));
        text(&output.stderr)
    };
    let without = predict("pressure = \"20 kPa\"", "");
    assert!(without.contains("needs a pressure"), "{without}");
    let pressed = predict("20 kPa", "400 kPa");
    assert!(pressed.contains("a pressure from") && pressed.contains("other.toml:13"), "{pressed}");
    let pointed = predict("points = 5\ninner_radius = \"50 mm\"", "points = 18\ninner_radius = \"400 mm\"");
    assert!(pointed.contains("3 to 16"), "{pointed}");
    let mut short = ACTUATOR;
    short[6] = "30 mm";
    let short = run(dir.path(), &[&short[..], &COARSE].concat());
    assert!(short.status.code() == Some(1) && text(&short.stderr).contains("the arms' length by W"));
    assert!(kept(dir.path()).is_empty(), "refusals are not kept");
    let fine = run(dir.path(), &["predict", "spec.toml", "--vtu", "sheet.vtu"]);
    assert_eq!(fine.status.code(), Some(2));
}

#[test]
fn a_fabric_that_no_shell_describes_is_refused_at_its_key_with_its_values() {
    let dir = folder();
    let drawing = "schema = 1\nname = \"pillow\"\n[drawing]\nfile = \"pillow.svg\"\n[drawing.layers]\nair = [\"air\"]\n\
                   port = [\"port\"]\n[fabric]\nareal_density = \"0.3 kg/m^2\"\n[load]\npressure = \"20 kPa\"\n";
    fs::write(dir.path().join("pillow.svg"), islands(1)).expect("written");
    // The star's tube is 30 mm wide, the widest circle of the pillow between its edge and the island 20 mm or so: t/W is 0.1 or more.
    for (spec, fabric, key, values) in [
        (SPEC, "poisson_ratio = 0.5", "poisson_ratio = 0.5", "a poisson_ratio from 0 to 0.499"),
        (drawing, "poisson_ratio = 0.5", "poisson_ratio = 0.5", "a poisson_ratio from 0 to 0.499"),
        (SPEC, "thickness = \"3 mm\"", "thickness = \"3 mm\"", "a thickness from 0.003 to 0.9 mm"),
        (drawing, "thickness = \"3 mm\"", "thickness = \"3 mm\"", "a thickness from 0.00"),
        // By Y and B of a sheet of 3 mm, 128 MPa and nu = 0.39: Y is 384 N/mm, and B 339.6 N mm.
        (
            SPEC,
            "thickness = \"3 mm\"\nstretch_stiffness = \"384 N/mm\"",
            "stretch_stiffness =",
            "a stretch_stiffness from 4266.67 to ",
        ),
        (SPEC, "thickness = \"3 mm\"\nbending_stiffness = \"340 N mm\"", "bending_stiffness =", " to 30.5"),
    ] {
        let spec = spec.replace("[fabric]\n", &format!("[fabric]\n{fabric}\n"));
        fs::write(dir.path().join("spec.toml"), spec).expect("written");
        let prediction = run(dir.path(), &[&["predict", "spec.toml"][..], &COARSE].concat());
        let message = text(&prediction.stderr);
        assert_eq!(prediction.status.code(), Some(1), "{fabric}: {message}");
        assert!(message.contains("[no-prediction]") && message.contains(values), "{fabric}: {message}");
        assert!(
            message.lines().any(|line| line.contains(" | ") && line.contains(key)),
            "{fabric}: {message}"
        );
    }
}

/// A square pillow with `rows` times `rows` islands, 24 mm apart.
fn islands(rows: u32) -> String {
    let side = 24 * rows + 24;
    let circles: Vec<String> = (0..rows * rows)
        .map(|number| [number / rows, number % rows].map(|place| 42 + 24 * place))
        .map(|[x, y]| format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"4\"/>"))
        .collect();
    let circles = circles.concat();
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"300mm\" height=\"300mm\" viewBox=\"0 0 300 300\">\
         <g id=\"air\" fill=\"none\" stroke=\"black\"><rect x=\"20\" y=\"20\" width=\"{side}\" height=\"{side}\"/>{circles}</g>\
         <g id=\"port\" stroke=\"red\"><path d=\"M16 50h8\"/></g></svg>"
    )
}

#[test]
fn a_large_shell_is_refused_before_it_is_computed() {
    let dir = folder();
    let spec = "schema = 1\nname = \"islands\"\n[drawing]\nfile = \"islands.svg\"\n[drawing.layers]\nair = [\"air\"]\n\
                port = [\"port\"]\n[load]\npressure = \"10 kPa\"\n[accuracy]\nmodel = \"shell\"\n";
    fs::write(dir.path().join("spec.toml"), spec).expect("written");
    fs::write(dir.path().join("islands.svg"), islands(6)).expect("written");
    for (command, option) in [
        (&["check", "spec.toml"][..], "`--anyway` computes it"),
        (&["build", "spec.toml", "-o", "out"], "`--anyway` computes it"),
        (&["predict", "spec.toml"], "--model shell --fineness coarse` computes it"),
        (&["predict", "spec.toml", "--accuracy", "5 %"], "--model shell --fineness coarse` computes it"),
    ] {
        let refused = run(dir.path(), command);
        let message = text(&refused.stderr);
        assert_eq!(refused.status.code(), Some(1), "{command:?}: {message}");
        for words in ["[large-shell]", "unknowns and ", "; at most 2 min are computed unasked", option] {
            assert!(message.contains(words), "{command:?}: {message}");
        }
    }
    assert!(!dir.path().join("out").exists());
    // `auto` leaves the shell out, of any size.
    fs::write(dir.path().join("spec.toml"), spec.replace("\"shell\"", "\"auto\"")).expect("written");
    assert_eq!(run(dir.path(), &["check", "spec.toml"]).status.code(), Some(0));
}

#[test]
fn many_different_stars_are_refused_before_they_are_computed() {
    let dir = folder();
    let stars: Vec<String> = (2..=30)
        .map(|index| format!("[[stack.star]]\nindex = {index}\ninner_radius = \"50.{index:02} mm\"\n"))
        .collect();
    let stars = stars.concat();
    let spec = format!("{SPEC}[stack]\ncount = 30\npitch = \"30 mm\"\n{stars}");
    fs::write(dir.path().join("spec.toml"), spec).expect("written");
    let prediction = run(dir.path(), &["predict", "spec.toml", "--model", "shell"]);
    let message = text(&prediction.stderr);
    assert_eq!(prediction.status.code(), Some(1), "{message}");
    for words in
        ["[large-shell]", "30 different stars", "; at most 10 min are computed", "--fineness coarse`"]
    {
        assert!(message.contains(words), "{message}");
    }
}

#[test]
fn a_build_leaves_the_shell_out_and_says_so() {
    let dir = folder();
    fs::write(dir.path().join("spec.toml"), format!("{SPEC}[accuracy]\nmodel = \"shell\"\n"))
        .expect("written");
    let built = run(dir.path(), &["build", "spec.toml", "-o", "out", "--only", "prediction"]);
    assert!(built.status.success(), "{}", text(&built.stderr));
    let files: Vec<_> = fs::read_dir(dir.path().join("out")).expect("built").collect();
    let prediction = files.into_iter().map(|file| file.expect("a file").path());
    let prediction = prediction.into_iter().find(|path| path.to_string_lossy().contains("prediction"));
    let text = fs::read_to_string(prediction.expect("one")).expect("text");
    assert!(text.contains("`predict` with the model \\\"shell\\\""), "{text}");
}

#[cfg(unix)]
#[test]
fn an_interruption_leaves_nothing() {
    use std::time::{Duration, Instant};
    let dir = folder();
    let child = command(dir.path())
        .args([&ACTUATOR[..], &["--model", "shell", "--fineness", "fine", "--vtu", "sheet.vtu"]].concat())
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("it runs");
    std::thread::sleep(Duration::from_millis(1500));
    let told = Instant::now();
    let kill = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill");
    assert!(kill.success());
    let output = child.wait_with_output().expect("it ends");
    assert!(told.elapsed() < Duration::from_secs(60), "one Newton step, not the whole");
    assert_eq!(output.status.code(), Some(130), "{}", text(&output.stderr));
    assert!(output.stdout.is_empty() && text(&output.stderr).contains("stopped"), "{}", text(&output.stderr));
    assert!(kept(dir.path()).is_empty() && !dir.path().join("sheet.vtu").exists());
}
