//! The page that a person reads, against the figures that a program reads.

use crate::{close, design, gripper, paper, predict};
use stargrip_cam::forecast::prediction::Prediction;
use stargrip_cam::forecast::report::text;
use stargrip_cam::spec::{KeyPath, Spec, key};
use stargrip_cam::units::{Length, LineForce, Percent, Pressure};

fn page(spec: &Spec) -> (Prediction, String) {
    let prediction = predict(spec);
    let text = text(spec, &prediction, true);
    (prediction, text)
}

/// The numbers of the line that begins with `what`.
fn numbers(page: &str, what: &str) -> Vec<f64> {
    let line = page.lines().find_map(|line| line.trim_start().strip_prefix(what)).expect("a line");
    line.split([' ', ',']).filter_map(|word| word.parse().ok()).collect()
}

#[test]
fn a_page_shows_the_predictions_figures_in_its_units() {
    let (prediction, page) = page(&paper(5));
    let star = &prediction.first;
    let stated = |value: Option<f64>| value.expect("asked for");
    let [least, most] = star.graspable_radius_mm.expect("a limit");
    let radius = stated(star.final_radius_mm);
    let hinges = star.hinge_stiffness_Nm.expect("a pressure");
    let lines: [(&str, Vec<f64>); 14] = [
        ("arm length", vec![star.arm_length_mm]),
        ("target coiling tip, corner", vec![stated(star.lambda_t.tip), stated(star.lambda_t.corner)]),
        ("tip angle at rest", vec![stated(star.tip_equilibrium_angle_deg)]),
        ("closes to, across", vec![2.0 * radius]),
        ("contraction", vec![100.0 * (1.0 - radius / 50.0)]),
        ("holds objects", vec![2.0 * least, 2.0 * most]),
        ("full actuation from", vec![star.operating_pressure_kPa]),
        ("hinge stiffness tip", vec![hinges.tip]),
        ("hinge stiffness corner", vec![hinges.corner]),
        ("radial stiffness", vec![stated(star.radial_stiffness_N_per_m)]),
        ("force on the object", vec![stated(star.object_force_N)]),
        ("burst pressure", vec![stated(star.burst_pressure_kPa)]),
        ("mass of the whole stack", vec![stated(prediction.stack_mass_g)]),
        ("payload of the whole stack", vec![stated(prediction.first.payload_kg)]),
    ];
    for (what, expected) in lines {
        let found = numbers(&page, what);
        assert_eq!(found.len(), expected.len(), "{what}");
        // Six digits are shown, and three of a value of unknown range.
        found.iter().zip(expected).for_each(|(found, expected)| close(*found, expected, 5e-3));
    }
    assert!(page.contains("\n3 equal stars, each:\n") && !page.contains("preload of arms"));
}

#[test]
fn a_size_is_as_exact_as_its_range_wherever_it_stands() {
    let (_, page) = page(&gripper(5));
    let (closed, held) = (numbers(&page, "closes to, across"), numbers(&page, "holds objects"));
    assert!((held[0] - closed[0]).abs() < 0.11, "{page}");
    // The range is millimetres wide.
    assert!(held.iter().all(|end| (10.0 * end).fract().abs() < 1e-9), "{page}");
}

#[test]
fn one_star_is_no_stack_and_stars_that_differ_stand_apart() {
    let mut single = paper(5);
    single.stars.truncate(1);
    let (_, alone) = page(&single);
    assert!(!alone.contains("equal stars") && !alone.contains("mass of the whole stack"), "{alone}");
    assert!(alone.contains("payload of the whole stack"));
    let mut pair = paper(5);
    pair.stars.truncate(2);
    assert!(page(&pair).1.contains("\n2 equal stars, each:\n"));
    pair.stars[1].inner_radius = Length(52.0);
    let (_, apart) = page(&pair);
    assert!(apart.contains("\nstar 1:\n") && apart.contains("\nstar 2:\n") && !apart.contains("equal"));
}

#[test]
fn a_star_that_is_pressed_shut_says_so_with_its_preload() {
    let shut = "the arms touch before the hinges reach their rest angle, and press on each other";
    for (points, expected) in [(5, false), (8, true)] {
        let (prediction, page) = page(&paper(points));
        let star = &prediction.first;
        let angle = star.tip_equilibrium_angle_deg.expect("a limit");
        assert_eq!(angle <= 0.0, expected);
        assert_eq!(star.preload_N.expect("a pressure") > 0.0, expected);
        assert_eq!(page.contains("preload of arms"), expected);
        assert_eq!(star.evidence.warnings.iter().any(|warning| warning.text == shut), expected);
        // Arms do not go through each other, whatever the hinges would do.
        close(numbers(&page, "tip angle at rest")[0], angle.max(0.0), 5e-3);
    }
}

#[test]
fn without_a_pressure_there_is_a_table_of_pressures_with_the_best_marked() {
    let mut spec = gripper(5);
    spec.load.as_mut().expect("given").pressure = None;
    // The best pressure is one that the seal surely withstands.
    spec.fabric.seal_strength = Some(LineForce(20.0));
    let (prediction, page) = page(&spec);
    assert!(!page.contains("error") && !page.contains("payload of this star"), "{page}");
    let rows = prediction.first.pressures.expect("a table");
    assert!(rows.len() > 8 && rows.windows(2).all(|pair| pair[0].pressure_kPa < pair[1].pressure_kPa));
    for row in &rows {
        let [low, high] = row.radius_range_mm.expect("known");
        assert!(low <= row.final_radius_mm && row.final_radius_mm <= high && row.stretch < 0.1);
        // Its row agrees with a spec of this pressure.
        let mut one = gripper(5);
        one.load.as_mut().expect("given").pressure = Some(Pressure(row.pressure_kPa));
        let star = predict(&one).first;
        assert_eq!(
            (Some(row.final_radius_mm), row.object_force_N),
            (star.final_radius_mm, star.object_force_N)
        );
        assert_eq!(Some([low, high]), star.ranges.final_radius_mm);
    }
    assert_eq!(page.matches("<- best").count(), 1);
}

/// The asymmetric hinges are warned of from the accepted error on, and the warning gives their effect.
#[test]
fn own_hinges_are_warned_of_beyond_the_accepted_error() {
    for points in 3..=8 {
        let spec = paper(points);
        let star = predict(&spec).first;
        let own = star.nonlinear.expect("the ring has them").final_radius_mm;
        let off = (own / star.final_radius_mm.expect("a limit") - 1.0).abs();
        let warned = star.evidence.warnings.iter().any(|warning| warning.text.contains("asymmetric hinges"));
        assert_eq!(warned, off > spec.accuracy.response.ratio(), "n = {points}: {off}");
    }
}

#[test]
fn a_range_wider_than_what_is_accepted_is_warned_of() {
    let warned = |percent: f64| {
        let mut spec = gripper(5);
        spec.accuracy.response = Percent(percent);
        predict(&spec)
            .first
            .evidence
            .warnings
            .iter()
            .any(|warning| warning.text.contains("more than the accepted"))
    };
    assert!(warned(0.001) && !warned(90.0));
}

#[test]
fn closing_the_tips_of_a_proper_star_does_not_widen_it() {
    for points in 3..=7 {
        let warnings = predict(&paper(points)).first.evidence.warnings;
        assert!(
            !warnings.iter().any(|warning| warning.text.contains("widens the star")),
            "{points}: {warnings:?}"
        );
    }
}

/// A spec that was changed after its design was made: the fault of a model names the star and the value.
#[test]
fn a_fault_names_the_star_and_the_key() {
    type Change = fn(&mut Spec);
    let faults: [(Change, KeyPath); 4] = [
        (|spec| spec.fabric.young_modulus.0 = 0.0, key::fabric::YOUNG_MODULUS),
        (|spec| spec.fabric.poisson_ratio = 0.7, key::fabric::POISSON_RATIO),
        (|spec| spec.fabric.thickness.0 = 0.0, key::fabric::THICKNESS),
        (|spec| spec.load.as_mut().expect("given").pressure = Some(Pressure(-1.0)), key::load::PRESSURE),
    ];
    for (change, key) in faults {
        let mut spec = paper(5);
        let design = design(&spec);
        change(&mut spec);
        let fault = predict::predict(&spec, &design).expect_err("refused");
        assert_eq!((fault.star, fault.key), (Some(1), key));
        assert_eq!(fault.to_string(), format!("star 1: {key}: {}", fault.what));
    }
}
