//! Predictions against closed forms, scaling laws, and figures calculated independently.

mod choice;
mod drawn;
mod held_sizes;
mod measures;
mod objects;
mod optimize;
mod outcome;
mod page;
mod prediction;
mod pull;
mod ranges;
mod seal_load;
mod study;
mod study_keys;
#[path = "../support/mod.rs"]
mod support;
mod trade;
mod verdict;
mod weave;

use stargrip_cam::design::{Design, Star};
use stargrip_cam::forecast::candidate::Candidate;
use stargrip_cam::forecast::case::Case;
use stargrip_cam::forecast::predict;
use stargrip_cam::forecast::prediction::Prediction;
use stargrip_cam::spec::{ModelChoice, Source, Spec, builtin_machine, read, read_machine};

/// The paper's star, 3 of them, with all optional inputs.
const PAPER: &str = concat!(include_str!("../support/gripper.toml"), "[seal]\nband = \"1 mm\"\n");

/// The paper's gripper with `points` points, as the membrane's limit sees it.
fn paper(points: u32) -> Spec {
    let mut spec = gripper(points);
    spec.accuracy.model = ModelChoice::Ring;
    spec
}

/// The spec of a gripper at its pressure.
fn gripper(points: u32) -> Spec {
    let mut spec = read(&Source::new("test", PAPER)).expect("valid").spec;
    spec.stars.iter_mut().for_each(|star| star.points = points);
    spec
}

fn case(spec: &Spec) -> Case {
    Case::of_star(spec, &Star::new(&spec.stars[0]).expect("makeable")).expect("valid")
}

fn candidate(spec: &Spec) -> Candidate {
    Candidate::from_spec(spec).expect("a star")
}

fn design(spec: &Spec) -> Design {
    let profile = Source::new("generic", builtin_machine("generic").expect("built in"));
    Design::new(spec, &read_machine(&profile).expect("valid")).expect("makeable")
}

fn predict(spec: &Spec) -> Prediction {
    predict::predict(spec, &design(spec)).expect("predictable")
}

/// Asserts that `found` is `expected` to `relative`.
#[track_caller]
fn close(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found}, expected {expected}");
}

/// The conversion from the spec's units to SI: each value is written out.
#[test]
fn a_case_is_the_spec_in_si_units() {
    let mut spec = paper(5);
    (spec.stars[0].tip_radius.0, spec.stars[0].corner_radius.0) = (2.0, 3.0);
    let case = case(&spec);
    let star = Star::new(&spec.stars[0]).expect("makeable");
    let pairs = [
        (case.mechanism.width, 0.03),
        (case.mechanism.tip_radius, 0.002),
        (case.mechanism.corner_radius, 0.003),
        (case.mechanism.tip_angle, 30_f64.to_radians()),
        (case.mechanism.arm, star.l * 1e-3),
        (case.inner_radius, 0.05),
        // The band, 1 mm wide, is narrower than either radius: both are made as specified.
        (case.realised.tip, 0.002),
        (case.realised.corner, 0.003),
        (case.peel.tip.expect("given"), 3e3),
        (case.peel.corner.expect("given"), 3e3),
        (case.pressure.expect("given"), 37e3),
        (case.object.expect("given"), 0.03),
        (case.friction.expect("given"), 0.5),
    ];
    for (found, expected) in pairs {
        close(found, expected, 1e-12);
    }
    assert_eq!(case.mechanism.points, 5);
}

/// p_op = 10^3 B / W^3 with B = E t^3 / [12 (1 - nu^2)].
#[test]
fn full_actuation_needs_the_published_pressure() {
    let spec = paper(5);
    let fabric = &spec.fabric;
    let (t, e) = (fabric.thickness.0 * 1e-3, fabric.young_modulus.0 * 1e3);
    let bending = e * t.powi(3) / (12.0 * (1.0 - fabric.poisson_ratio.powi(2)));
    let expected = 1e3 * bending / 0.03_f64.powi(3);
    close(case(&spec).operating_pressure(), expected, 1e-12);
    let prediction = predict(&spec).first;
    close(prediction.operating_pressure_kPa, expected * 1e-3, 1e-12);
    close(prediction.bendability.expect("a pressure"), 37e3 * 0.03_f64.powi(3) / bending, 1e-12);
    close(prediction.evidence.stretch.expect("a pressure"), 37e3 * 0.03 / (e * t), 1e-12);
}
