//! Which model answers, by errors that add up from known parts.

use crate::close;
use stargrip_cam::forecast::choice::{BVP_BETA, Question, choose, estimate, limits_of_validity, take};
use stargrip_cam::mechanics::hinge::Level;
use stargrip_cam::mechanics::hinge::fit::{TARGET_COILING, target_curvature};
use stargrip_cam::mechanics::hinge::ring::RingTable;
use stargrip_cam::mechanics::strength::limit_estimate;

const QUESTION: Question = Question { r_stars: [0.1, 0.3], bendability: None, stretch: 0.0, accepted: 0.05 };

fn table() -> RingTable {
    RingTable::new().expect("solved")
}

#[test]
fn the_fits_error_is_its_distance_from_the_ring_at_the_worse_hinge() {
    let table = table();
    let [mut coiling, mut stiffness] = [0.0_f64; 2];
    for r_star in QUESTION.r_stars {
        let exact = table.at(r_star).expect("in range");
        coiling = coiling.max((TARGET_COILING / exact.lambda_t - 1.0).abs());
        stiffness = stiffness.max((target_curvature(r_star) / exact.curvature - 1.0).abs());
    }
    let found = estimate(Level::Fit, &QUESTION, &table);
    close(found.coiling, coiling, 1e-12);
    close(found.stiffness, stiffness, 1e-12);
    let turned = Question { r_stars: [0.3, 0.1], ..QUESTION };
    assert_eq!(estimate(Level::Fit, &turned, &table), found);
}

#[test]
fn the_penalty_costs_a_known_gap() {
    let found = estimate(Level::Bvp, &QUESTION, &table());
    // ln(beta) / beta for 1000.
    close(found.coiling, 2.0 * 0.001 * BVP_BETA.ln(), 1e-12);
    close(found.stiffness, 7.0 * 0.001 * BVP_BETA.ln(), 1e-12);
}

#[test]
fn a_pressure_adds_the_finite_bendability_and_the_stretch() {
    let table = table();
    let asked = Question { bendability: Some(2000.0), stretch: 0.007, ..QUESTION };
    for level in [Level::Fit, Level::Ring, Level::Bvp] {
        let (own, whole) = (estimate(level, &QUESTION, &table), estimate(level, &asked, &table));
        let limit = limit_estimate(2000.0);
        close(whole.coiling, own.coiling + limit.coiling + 0.007, 1e-12);
        close(whole.stiffness, own.stiffness + limit.stiffness + 0.007, 1e-12);
    }
}

#[test]
fn what_is_accepted_is_accepted_to_the_last_bit() {
    let table = table();
    let fit = estimate(Level::Fit, &QUESTION, &table);
    let worst = fit.coiling.max(fit.stiffness);
    let with = |accepted| choose(&Question { accepted, ..QUESTION }, &table);
    assert_eq!((with(worst).level, with(worst).error), (Level::Fit, fit));
    assert_eq!(with(worst * (1.0 - 1e-12)).level, Level::Ring);
    assert!(with(worst).reason.contains(&format!("estimated error, {:.3} %,", 100.0 * worst)));
    let none = with(1e-13);
    assert_eq!((none.level, none.good_enough), (Level::Ring, false));
    assert!(take(Level::Fit, &Question { accepted: worst, ..QUESTION }, &table).good_enough);
    assert!(!take(Level::Fit, &Question { accepted: worst * (1.0 - 1e-12), ..QUESTION }, &table).good_enough);
}

#[test]
fn limits_are_named_once_and_only_beyond_them() {
    let said = |level, question: Question| limits_of_validity(level, &question);
    assert!(said(Level::Ring, Question { bendability: Some(1000.0), stretch: 0.02, ..QUESTION }).is_empty());
    let low = said(Level::Ring, Question { bendability: Some(999.0), ..QUESTION });
    assert!(low.len() == 1 && low[0].starts_with("bendability 999 is below 1000"), "{low:?}");
    let stretched = said(Level::Ring, Question { bendability: Some(1e4), stretch: 0.021, ..QUESTION });
    assert!(stretched.len() == 1 && stretched[0].starts_with("p W / Y is 0.021"), "{stretched:?}");
    // Two equal hinges are one warning, two that differ are two, and only the fit has them.
    let sharp = |r_stars| said(Level::Fit, Question { r_stars, ..QUESTION });
    assert_eq!((sharp([0.0, 0.0]).len(), sharp([0.0, 20.0]).len()), (1, 2));
    assert!(said(Level::Ring, Question { r_stars: [0.0, 20.0], ..QUESTION }).is_empty());
    // Stiffness was published over a range, the coiling for one R* only.
    assert_eq!(sharp([0.1, 0.3]), ["the published target coiling was not given for R* = 0.3000"]);
    assert_eq!(sharp([0.1, 20.0]), ["the published constants were not given for R* = 20.0000"]);
}
