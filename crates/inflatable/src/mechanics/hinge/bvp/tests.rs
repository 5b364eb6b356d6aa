//! The penalised problem against the exact ring, and against itself on finer meshes.

use super::*;
use crate::mechanics::hinge::bvp::path::follow;
use crate::mechanics::hinge::ring::Ring;
use crate::mechanics::hinge::seal_load;
use crate::numerics::collocation::solve_on_mesh;

#[test]
fn it_tends_to_the_ring_like_the_logarithm_of_beta_over_beta() {
    for (r_star, lambda) in [(0.0, 1.0), (0.0, 1.28), (0.1, 1.45), (1.0, 1.28), (10.0, 1.5)] {
        let exact = Ring.state(r_star, lambda).expect("solved");
        let gaps = [1e2, 1e3, 1e4, 1e5].map(|beta| {
            let state = Bvp::new(beta, 1e-6).state(r_star, lambda).expect("solved");
            let gap = (state.volume.unwrap_or(f64::NAN) - exact.volume.unwrap_or(f64::NAN)) / (1.0 + r_star);
            gap.abs() * beta / beta.ln()
        });
        // One constant for three decades: the last within a factor of three of the others, and below 1.
        println!("R* {r_star}, lambda {lambda}: |gap| beta / ln(beta) = {gaps:.3?}");
        assert!(gaps.iter().all(|g| *g < 1.0 && (1.0 / 3.0..3.0).contains(&(g / gaps[2]))), "{gaps:?}");
    }
}

#[test]
fn its_target_tends_to_the_rings() {
    for r_star in [0.0, 0.1, 2.0] {
        let exact = Ring.target(r_star).expect("solved");
        for (beta, allowed) in [(1e3, 0.03), (1e4, 0.005)] {
            let state = Bvp::new(beta, 1e-5).target(r_star).expect("solved");
            assert!(
                (state.lambda - exact.lambda).abs() < allowed,
                "R* {r_star}: {} {}",
                state.lambda,
                exact.lambda
            );
            assert!(
                (state.curvature / exact.curvature - 1.0).abs() < 10.0 * allowed,
                "R* {r_star}, beta {beta}"
            );
            if r_star > 0.0 {
                let k = [&state, &exact].map(|s| seal_load(r_star, s).unwrap_or(f64::NAN));
                assert!((k[0] / k[1] - 1.0).abs() < 15.0 * allowed, "R* {r_star}, beta {beta}: {k:?}");
            }
        }
    }
}

#[test]
fn its_discretisation_has_the_fourth_order() {
    for (r_star, lambda) in [(0.1, 1.28), (10.0, 1.4)] {
        let end = follow(r_star, lambda, 1000.0, 1e-4).expect("solved");
        let mut profile = end.solution.profile;
        let mut volumes = Vec::new();
        for _ in 0..4 {
            profile = profile.halved(&end.section);
            profile = solve_on_mesh(&end.section, profile).expect("solved").profile;
            volumes.push(profile.integral(&end.section, |s, y| end.section.volume_density(s, y)));
        }
        let steps: Vec<f64> = volumes.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
        let orders: Vec<f64> = steps.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect();
        assert!(orders.iter().all(|order| (3.7..4.5).contains(order)), "R* {r_star}: {volumes:?} {orders:?}");
    }
}

#[test]
fn it_fails_nowhere_in_the_papers_range() {
    let bvp = Bvp::new(1000.0, 1e-4);
    for r_star in [0.0, 1e-3, 0.03, 0.3, 3.0, 30.0, 100.0] {
        for lambda in [0.8, 1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 2.0, 3.0] {
            let state = bvp.state(r_star, lambda);
            assert!(state.is_ok_and(|s| s.effort.residual <= 1e-4), "R* {r_star}, lambda {lambda}");
        }
    }
}

#[test]
fn the_bare_volume_exceeds_the_potential_by_the_penalty() {
    let bvp = Bvp::default();
    let (bare, state) = (bvp.bare_volume(0.1, 1.28).expect("solved"), bvp.state(0.1, 1.28).expect("solved"));
    let penalty = bare - state.volume.expect("known");
    assert!(penalty > 0.0 && penalty < 3.0 / bvp.beta(), "{penalty}");
}

#[test]
fn parameters_are_brought_into_range() {
    assert_eq!(Bvp::new(1e9, 0.0), Bvp::new(MOST_BETA, 1e-7));
    assert_eq!(Bvp::new(f64::NAN, f64::NAN), Bvp::new(LEAST_BETA, 1e-7));
}

#[test]
fn beyond_what_rounding_allows_it_refuses() {
    for r_star in [0.0, 0.1, 10.0, 100.0] {
        assert!(Bvp::new(1e6, 1e-6).state(r_star, 1.28).is_ok(), "R* {r_star}");
    }
    let fault = follow(1000.0, 1.0, 1e7, 1e-6).expect_err("u is known to 1e-13 of R*, times beta");
    assert!(matches!(fault, CollocationFault::TooFine { .. } | CollocationFault::Diverged), "{fault:?}");
}
