//! Every key of a study sets what it sets in a spec.

use crate::study::{numbers, ring, study, sweep, vary, whole, words};
use crate::{PAPER, candidate, close, paper};
use stargrip_cam::mechanics::hinge::ring::RingTable;
use stargrip_cam::spec::Source;
use stargrip_cam::spec::study::Field;

#[test]
fn every_key_sets_its_own_value() {
    let texts = [
        ("star.points", "7", 7.0),
        ("star.inner_radius", "61 mm", 61.0),
        ("star.tube_width", "2.2 cm", 22.0),
        ("star.tip_angle", "33 deg", 33.0),
        ("star.tip_radius", "1.5 mm", 1.5),
        ("star.corner_radius", "2.5 mm", 2.5),
        ("fabric.thickness", "0.2 mm", 0.2),
        ("fabric.young_modulus", "90 MPa", 90e3),
        ("fabric.poisson_ratio", "0.3", 0.3),
        ("fabric.seal_strength", "2 N/mm", 2.0),
        ("load.pressure", "21 kPa", 21.0),
        ("load.object_radius", "31 mm", 31.0),
        ("load.friction", "0.7", 0.7),
    ];
    let base = candidate(&paper(5));
    for (i, (name, text, value)) in texts.into_iter().enumerate() {
        let point = sweep(&[&format!("{name} = {text}")]).design(0).expect("a spec");
        let (star, fabric, load) = (&point.star, &point.fabric, &point.load);
        let own = [
            f64::from(star.points),
            star.inner_radius.0,
            star.tube_width.0,
            star.tip_angle.0,
            star.tip_radius.0,
            star.corner_radius.0,
            fabric.thickness.0,
            fabric.young_modulus.0,
            fabric.poisson_ratio,
            fabric.seal_strength.expect("given").0,
            load.pressure.expect("given").0,
            load.object_radius.expect("given").0,
            load.friction.expect("given"),
        ];
        close(own[i], value, 1e-12);
        assert!(point != base, "{name}");
    }
}

/// The end of a spec for a laser, behind its [seal].
const LASER: &str =
    "power = \"8 %\"\nspeed = \"10 mm/s\"\ntip = \"0.5 mm\"\n[machine]\nprofile = \"grbl-laser\"\n";

/// Every key: written into the spec, against the key varied.
#[test]
fn any_key_of_the_spec_varies_and_means_what_it_means_there() {
    let table = RingTable::new().expect("solved");
    for name in Field::names() {
        let field = Field::find(&name).expect("a key");
        let value = match name.as_str() {
            "name" => "another",
            "machine.profile" => "grbl",
            "machine.program" => "sheet",
            "machine.feed_floor" => "chop",
            "cut.colours" => "ordered",
            "machine.marks" => "pause",
            "accuracy.model" => "fit",
            "mask.bed" => "220 mm x 210 mm",
            "mask.mirror" | "sheet.turn" | "inlet.none" => "true",
            "star.points" => "4",
            "frame.posts" => "5",
            "inlet.tip" | "seal.passes" | "stack.count" => "2",
            "fabric.poisson_ratio" | "load.friction" => "0.3",
            "load.friction_least" => "0.2",
            "load.friction_most" => "0.9",
            "accuracy.response" => "7 %",
            "accuracy.path" => "0.01 mm",
            "seal.temperature" => "190 C",
            "seal.speed" => "0.2 mm/s",
            "seal.height" => "-0.2 mm",
            "seal.lines" => "1",
            "seal.tip" => "0.8 mm",
            "seal.power" => "70 %",
            "seal.cool" => "5 s",
            "seal.pause" => "seam",
            "star.tip_angle" | "stack.rotation" => "35 deg",
            "fabric.young_modulus" => "90 MPa",
            "fabric.seal_strength" => "2 N/mm",
            "fabric.areal_density" => "0.2 kg/m^2",
            "fabric.bending_stiffness" => "0.3 N mm",
            "fabric.stretch_stiffness" => "40 N/mm",
            "fabric.shear_modulus" => "9 MPa",
            "fabric.warp" => "20 deg",
            "fabric.thickness" => "0.25 mm",
            "load.pressure" => "30 kPa",
            "load.mass" => "1 kg",
            "load.largest_force" => "9 N",
            "star.inner_radius" => "55 mm",
            "star.tube_width" => "28 mm",
            "load.object_radius" => "29 mm",
            "load.object_shape" => "ball",
            "build.link" => "https://example.org/page",
            _ => "3.5 mm",
        };
        let rest = if matches!(name.as_str(), "seal.power" | "seal.focus") { LASER } else { "" };
        let spec = Source::new("spec.toml", format!("{PAPER}{rest}"));
        let study = vary(&spec, &[&format!("{name}={value}")]).expect("one row");
        let varied = study.design(0).unwrap_or_else(|refused| panic!("{name}: {refused}"));
        let toml = field.toml(&field.parse(value).expect("in range"));
        let text = stargrip_cam::spec::edit::with_values(&spec, &[(field.key(), toml)]).expect("edited");
        let by_hand = stargrip_cam::spec::read(&Source::new("by hand", text)).expect("valid").spec;
        assert!(
            by_hand != stargrip_cam::spec::read(&spec).expect("valid").spec,
            "{name} is set to what it is"
        );
        assert_eq!(varied, candidate(&by_hand), "{name}");
        assert_eq!(varied.answer(&table), candidate(&by_hand).answer(&table), "{name}");
    }
}

/// Keys of a process vary as all others: the burst pressure follows the weaker loop, and each row is the spec as written by hand.
#[test]
fn keys_of_a_process_vary_and_mean_what_they_mean_in_a_spec() {
    // The inner loop is sealed by a process.
    let star = PAPER.replace("[stack]\n", "inner_process = \"weak\"\n[stack]\n");
    let text = format!("{star}[process.weak]\nspeed = \"2 mm/s\"\n");
    let spec = Source::new("spec.toml", text.as_str());
    let axes = ["process.weak.strength=1 N/mm,2 N/mm", "process.weak.passes=1,2"];
    let study = vary(&spec, &axes).expect("four rows");
    assert_eq!(study.columns()[1].name, "process.weak.strength_N_per_mm");
    let batch = whole(&study);
    let burst = numbers(&study, &batch, "burst_pressure_kPa");
    assert!(burst[2] > 1.5 * burst[0] && burst[0] == burst[1], "{burst:?}");
    let keys = [
        ("temperature", "\"170 C\""),
        ("speed", "\"3 mm/s\""),
        ("height", "\"-0.1 mm\""),
        ("passes", "3"),
        ("lines", "1"),
        ("overlap", "\"4 mm\""),
        ("cool", "\"5 s\""),
        ("pause", "\"seam\""),
        ("strength", "\"1 N/mm\""),
    ];
    for (key, toml) in keys {
        let study =
            vary(&spec, &[&format!("process.weak.{key}={}", toml.trim_matches('"'))]).expect("one row");
        let head =
            text.replace("speed = \"2 mm/s\"\n", if key == "speed" { "" } else { "speed = \"2 mm/s\"\n" });
        let by_hand = head.replace("[process.weak]\n", &format!("[process.weak]\n{key} = {toml}\n"));
        let by_hand = stargrip_cam::spec::read(&Source::new("by hand", by_hand)).expect("valid").spec;
        assert_eq!(study.design(0), Ok(candidate(&by_hand)), "{key}");
    }
    let refusal = vary(&spec, &["process.weka.speed=1 mm/s"]).expect_err("refused");
    assert_eq!(refusal, "`process.weka.speed`: the spec has no process `weka`; did you mean `weak`?");
    let refusal = vary(&ring(), &["process.weak.speed=1 mm/s"]).expect_err("refused");
    assert!(refusal.ends_with("write its section in the spec, [process.weak]"), "{refusal}");
}

#[test]
fn rows_go_on_together_and_combine_with_what_varies() {
    let study = study(
        "[rows]\nstar.points = [4, 6]\nstar.tip_angle = [\"40 deg\", \"30 deg\"]\n\
         [vary]\nload.pressure = \"10 kPa..30 kPa/3\"\nmask.mirror = [true, false]\n",
    );
    let batch = whole(&study);
    assert_eq!(numbers(&study, &batch, "row"), [0., 1., 2., 3., 4., 5., 6., 7., 8., 9., 10., 11.]);
    assert_eq!(numbers(&study, &batch, "star.points"), [4., 4., 4., 4., 4., 4., 6., 6., 6., 6., 6., 6.]);
    assert_eq!(numbers(&study, &batch, "star.tip_angle_deg")[5..7], [40.0, 30.0]);
    assert_eq!(numbers(&study, &batch, "load.pressure_kPa")[..5], [10.0, 10.0, 20.0, 20.0, 30.0]);
    let mirrored = words(&study, &batch, "mask.mirror");
    assert_eq!(mirrored[..2], [Some("true".to_owned()), Some("false".to_owned())]);
    // A key that the prediction does not use changes no value.
    let radius = numbers(&study, &batch, "final_radius_mm");
    assert!(radius.chunks(2).all(|pair| pair[0] == pair[1]) && radius[0] != radius[2], "{radius:?}");
}
