//! Predictions of objects: what a star holds, what enters it, and what is said of it.

use crate::prediction::{design, machine, predict, spec};
use crate::support::inputs::GRIPPER as PAPER;
use stargrip_cam::forecast::predict;
use stargrip_cam::forecast::prediction::Prediction;
use stargrip_cam::spec::{ModelChoice, Spec, key};
use stargrip_cam::units::{Length, LineForce, Pressure};

/// With `points` points and an object of `radius` mm.
fn holding(points: u32, radius: f64) -> Prediction {
    let mut spec =
        spec(&PAPER.replace("[load]", "[seal]\nband = \"1 mm\"\nhole_allowance = \"0 mm\"\n[load]"));
    spec.accuracy.model = ModelChoice::Ring;
    spec.stars.iter_mut().for_each(|star| star.points = points);
    spec.load.as_mut().expect("given").object_radius = Some(Length(radius));
    predict(&spec).expect("predictable")
}

#[test]
fn an_inflated_star_holds_no_more_than_it_opens_to() {
    let warned = |prediction: &Prediction, words: &str| {
        prediction.first.evidence.warnings.iter().any(|warning| warning.text.contains(words))
    };
    let [least, most] = holding(8, 20.0).first.graspable_radius_mm.expect("a limit");
    assert!((least - 31.0).abs() < 0.5 && (most - 33.5).abs() < 0.05, "{least} {most}");
    // The cut hole, less 1 mm of band.
    assert_eq!(holding(5, 30.0).first.graspable_radius_mm.expect("a limit")[1], 49.0);
    // Seven points open to 48.3 mm, and less beyond.
    for radius in [47.0, 47.5, 48.0, 48.2] {
        assert!(holding(7, radius).first.object_force_N > holding(7, radius - 1.0).first.object_force_N);
    }
    assert!(warned(&holding(7, 48.2), "the arms lock there, and the predicted force grows without bound"));
    assert!(!warned(&holding(7, 40.0), "lock"));
    let beyond = holding(7, 49.0);
    assert_eq!((beyond.first.object_force_N, beyond.first.payload_kg), (None, None));
    assert!(warned(&beyond, "wider than the inflated star opens, 9"), "{:?}", beyond.first.evidence.warnings);
    assert!(warned(&holding(7, 51.0), "wider than the cut hole, 98.00 mm across"));
}

#[test]
fn arms_shorter_than_half_a_width_are_warned_of() {
    let warned = |points| {
        let warnings = holding(points, 40.0).first.evidence.warnings;
        warnings.iter().any(|warning| warning.text.contains("less than half the tube's width"))
    };
    assert!(warned(8) && !warned(7));
}

/// `check` and `predict` name the same radius, and that radius holds.
#[test]
fn a_radius_that_would_hold_is_the_same_everywhere_and_holds() {
    for (kilopascals, helps) in [(9.8, true), (12.0, true), (20.0, false), (50.0, false), (104.0, false)] {
        let mut spec = spec(PAPER);
        spec.fabric.seal_strength = Some(LineForce(1.0));
        spec.load.as_mut().expect("given").pressure = Some(Pressure(kilopascals));
        let design_of = |spec: &Spec| design(spec).expect("makeable");
        let design = design_of(&spec);
        let report = stargrip_cam::airtight::report(&spec, &machine(), &design);
        let prediction = predict::predict(&spec, &design).expect("predictable").first;
        let safe = prediction.evidence.safe_radius_mm;
        assert_eq!(safe.is_some(), helps, "{kilopascals} kPa");
        let advice = safe.map_or("no radius of such a star is known to be enough".to_owned(), |mm| {
            format!("a radius of {} would hold", Length(mm))
        });
        let said = |list: &[String]| list.iter().any(|text| text.contains(&advice));
        let weak: Vec<String> = report.pieces[0]
            .loads
            .iter()
            .filter_map(stargrip_cam::forecast::seal_load::SealLoad::weakness)
            .collect();
        let warnings: Vec<String> =
            prediction.evidence.warnings.iter().map(|warning| warning.text.clone()).collect();
        assert!(said(&weak) && said(&warnings), "{advice}: {report:?}");
        assert_eq!(report.pieces[0].loads[0].safe_radius.map(|radius| radius.0), safe);
        let Some(safe) = safe.filter(|mm| *mm < 5.0) else { continue };
        for star in &mut spec.stars {
            (star.tip_radius, star.corner_radius) = (Length(safe), Length(safe));
        }
        let report = stargrip_cam::airtight::report(&spec, &machine(), &design_of(&spec));
        assert!(
            report.pieces[0].loads.iter().all(|load| load.margin >= Some(1.0) && load.weakness().is_none()),
            "{report:?}"
        );
    }
}

#[test]
fn too_small_an_object_is_not_held_and_too_large_a_one_does_not_enter() {
    let with = |radius| {
        let mut spec = spec(PAPER);
        spec.load.as_mut().expect("given").object_radius = Some(Length(radius));
        predict(&spec).expect("predictable").first
    };
    assert_eq!(with(5.0).payload_kg, Some(0.0));
    assert_eq!(with(51.0).payload_kg, None);
    assert!(with(20.0).payload_kg < with(40.0).payload_kg);
}

/// Half a kilopascal is far below the validated domain: the model's numbers are not valid there.
#[test]
fn of_a_star_of_which_nothing_is_known_nothing_is_said() {
    let mut weak = spec(PAPER);
    weak.load.as_mut().expect("given").pressure = Some(Pressure(0.5));
    let prediction = predict(&weak).expect("an answer");
    let star = &prediction.first;
    assert_eq!((star.final_radius_mm, star.graspable_radius_mm), (None, None));
    assert_eq!((star.object_force_N, star.payload_kg, star.radial_stiffness_N_per_m), (None, None, None));
    assert!(star.evidence.choice.contains("bendability is 39.7"), "{}", star.evidence.choice);
    let verdict = prediction.verdict.as_ref().expect("there is an object");
    assert_eq!((verdict.holds.as_bool(), verdict.force_N), (None, None));
}

/// The page reports each unknown once, and no line ends in a blank.
#[test]
fn a_page_says_nothing_twice() {
    let mut unsure = spec(PAPER);
    unsure.accuracy.response = stargrip_cam::units::Percent(1.0);
    let prediction = predict(&unsure).expect("an answer");
    let page = stargrip_cam::forecast::report::text(&unsure, &prediction, true);
    assert_eq!(page.matches("more than the accepted 1 %").count(), 1, "{page}");
    assert!(page.lines().all(|line| line == line.trim_end()), "{page}");
}

#[test]
fn ranges_that_are_as_wide_as_usual_are_not_warned_of() {
    let warned = |radius: f64| {
        let mut spec = spec(PAPER);
        spec.stars.iter_mut().for_each(|star| star.tip_radius = Length(radius * star.tube_width.0));
        let found = predict(&spec).expect("predictable").first.evidence.warnings;
        found.iter().any(|warning| warning.text.contains("times as wide"))
    };
    assert_eq!([0.3, 0.3001, 0.33].map(warned), [false, false, true]);
}

#[test]
fn the_pressures_that_are_named_have_a_prediction() {
    let mut named = 0;
    for (points, width, thickness, pressure) in
        [(5, 30.0, 0.3, 9000.0), (8, 15.0, 0.4, 9000.0), (6, 20.0, 0.5, 0.1), (5, 30.0, 0.1, 9000.0)]
    {
        let with = |pressure: f64| {
            let mut spec = spec(PAPER);
            spec.accuracy.model = ModelChoice::Section;
            spec.fabric.thickness = Length(thickness);
            spec.load.as_mut().expect("given").pressure = Some(Pressure(pressure));
            for star in &mut spec.stars {
                (star.points, star.tube_width) = (points, Length(width));
            }
            predict(&spec)
        };
        let fault = with(pressure).expect_err("far from every pressure");
        assert_eq!(fault.key, key::load::PRESSURE, "{fault}");
        let Some(remedy) = fault.remedy else { continue };
        for pressure in remedy.split(' ').filter_map(|word| word.parse().ok()) {
            assert!(with(pressure).is_ok_and(|found| found.first.final_radius_mm.is_some()), "{remedy}");
            named += 1;
        }
    }
    assert!(named >= 4, "{named}");
}
