//! The choice of a model, and its limits of validity.

use crate::{case, design, gripper, paper, predict};
use stargrip_cam::forecast::model_selection::{hinge_model, limits_of_validity};
use stargrip_cam::mechanics::hinge::Level;
use stargrip_cam::spec::{ModelChoice, Spec, key};
use stargrip_cam::units::{BendingStiffness, Length, Pressure};

/// Residuals and ranges belong to the table, so the section by its name is the table, too.
#[test]
fn a_star_by_section_is_that_of_auto() {
    for points in 3..=7 {
        let auto = predict(&gripper(points)).first;
        let mut by_name = gripper(points);
        by_name.accuracy.model = ModelChoice::Section;
        let mut section = predict(&by_name).first;
        // A selection by name is not a warning.
        assert_eq!(section.evidence.choice, "section was requested");
        section.evidence.choice.clone_from(&auto.evidence.choice);
        assert_eq!(section, auto, "n = {points}");
        assert!(auto.model == "section" && auto.nonlinear.is_none());
    }
}

/// A star that no table covers is computed by the shell where that covers it.
#[test]
fn an_unknown_star_is_pointed_to_the_shell_where_that_covers_it() {
    let by_shell = |spec: &Spec| {
        let warnings = predict(spec).first.evidence.warnings;
        warnings
            .iter()
            .any(|warning| warning.text.contains("the model \"shell\" covers this star, and takes 1 to 10 s"))
    };
    assert!(!by_shell(&gripper(5)));
    let mut many = gripper(14);
    for star in &mut many.stars {
        (star.inner_radius, star.tube_width) = (Length(80.0), Length(15.0));
    }
    assert!(by_shell(&many));
    // Too thick for a thin shell.
    let mut thick = gripper(5);
    thick.fabric.thickness = Length(1.2);
    assert!(!by_shell(&thick));
}

/// Sharp hinges, tubes of several widths: the key that is refused is one of the fabric, and each way out works.
#[test]
fn fabric_out_of_range_is_refused_at_its_own_key_with_values_that_work() {
    let section = || {
        let mut spec = gripper(5);
        spec.accuracy.model = ModelChoice::Section;
        spec
    };
    let refusal = |spec: &Spec| {
        let fault = predict::predict(spec, &design(spec)).err()?;
        Some((fault.key, fault.remedy.unwrap_or_default()))
    };
    let mut soft = section();
    soft.fabric.poisson_ratio = 0.5;
    assert_eq!(
        refusal(&soft),
        Some((key::fabric::POISSON_RATIO, "a poisson_ratio from 0 to 0.49".to_owned()))
    );
    for thickness in [1.2, 0.05] {
        let mut spec = section();
        spec.fabric.thickness = Length(thickness);
        // At any pressure: the fabric is the binding reason.
        for pressure in [0.1, 37.0, 5000.0] {
            spec.load.as_mut().expect("a load").pressure = Some(Pressure(pressure));
            let (key, remedy) = refusal(&spec).expect("out of range");
            assert_eq!(key, key::fabric::THICKNESS);
            assert!(remedy.starts_with("a thickness from 0.09 to 0.9 mm, or a tube_width from "), "{remedy}");
        }
    }
    let mut measured = section();
    measured.fabric.bending_stiffness = Some(BendingStiffness(8.0));
    let (key, remedy) = refusal(&measured).expect("out of range");
    assert_eq!(key, key::fabric::BENDING_STIFFNESS);
    let most: f64 =
        remedy.split(" to ").nth(1).and_then(|rest| rest.split(' ').next()?.parse().ok()).expect(&remedy);
    measured.fabric.bending_stiffness = Some(BendingStiffness(most));
    assert!(refusal(&measured).is_none_or(|(key, _)| key == key::load::PRESSURE), "{:?}", refusal(&measured));
}

#[test]
fn limits_are_named_once_and_only_beyond_them() {
    let base = case(&paper(5));
    let said = |level, r_stars: [f64; 2], kilopascals: f64| {
        let mut case = base;
        case.pressure = Some(1e3 * kilopascals);
        (case.mechanism.tip_radius, case.mechanism.corner_radius) = (0.03 * r_stars[0], 0.03 * r_stars[1]);
        let model = hinge_model(level, &case.sheet, case.pressure, 0.03).expect("covered");
        limits_of_validity(model.as_ref(), &case)
    };
    let low = said(Level::Ring, [0.1; 2], 12.0);
    assert!(
        low.len() == 1 && low[0].starts_with("bendability 95") && low[0].contains("below 1000"),
        "{low:?}"
    );
    assert!(said(Level::Ring, [0.1; 2], 13.0)[0].contains("a limiting case that no gripper reaches"));
    let stretched = said(Level::Ring, [0.1; 2], 37.0);
    assert!(stretched.len() == 2 && stretched[1].starts_with("p W / Y is 0.029"), "{stretched:?}");
    // Two equal hinges are one warning, two that differ are two, and only the fit has them.
    let fit = |r_stars| said(Level::Fit, r_stars, 20.0).into_iter().skip(1).collect::<Vec<_>>();
    assert_eq!((fit([0.0, 0.0]).len(), fit([0.0, 20.0]).len()), (1, 2));
    assert_eq!(fit([0.1, 0.3]), ["the published target coiling was not given for R* = 0.3000"]);
    assert_eq!(fit([0.1, 20.0]), ["the published constants were not given for R* = 20.0000"]);
    // The section has none inside of its table of arms, and one beyond.
    assert!(said(Level::Section, [0.0; 2], 37.0).is_empty());
    assert!(said(Level::Section, [1.5; 2], 37.0)[0].contains("without arms"));
}
