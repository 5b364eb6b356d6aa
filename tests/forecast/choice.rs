//! The choice of a model, and its limits of validity.

use crate::{case, gripper, paper, predict};
use stargrip_cam::forecast::model_selection::{hinge_model, limits_of_validity};
use stargrip_cam::mechanics::hinge::Level;
use stargrip_cam::spec::ModelChoice;

#[test]
fn auto_takes_the_section_at_a_pressure_and_says_what_the_solver_says() {
    for points in 3..=7 {
        let auto = predict(&gripper(points)).first;
        let mut asked = gripper(points);
        asked.accuracy.model = ModelChoice::Section;
        let solved = predict(&asked).first;
        assert_eq!((auto.model, solved.model), ("section", "section"));
        let [fast, slow] = [&auto, &solved].map(|star| star.final_radius_mm.expect("at a pressure"));
        assert!((fast / slow - 1.0).abs() < 0.03, "n = {points}: {fast} {slow}");
        // A selection by name is not a warning.
        assert!(solved.evidence.choice.contains("requested"));
        assert!(solved.evidence.warnings.iter().all(|warning| !warning.contains("requested")));
        assert!(auto.nonlinear.is_none() && solved.nonlinear.is_none());
    }
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
