use super::*;
use crate::mechanics::hinge::Hinge;
use crate::mechanics::hinge::bvp::Bvp;
use crate::mechanics::hinge::fit::Fit;
use crate::mechanics::hinge::ring::Ring;
use crate::mechanics::star::tests::{flat, paper};
use std::f64::consts::PI;

#[test]
fn final_radii_of_the_papers_stars() {
    for (points, radius) in (3..).zip([27.8, 15.8, 14.7, 19.1, 24.9, 30.8]) {
        let star = paper(points);
        let inflated = Inflated::new(&star, &Fit, 1e4).expect("covered");
        let rest = inflated.rest().expect("solvable");
        assert!((rest.radius * 1e3 - radius).abs() < 0.05, "n = {points}: {}", rest.radius);
    }
}

#[test]
fn a_parabola_rests_where_the_closed_form_says() {
    for points in [3, 5, 7] {
        let star = flat(0.05, Mechanism { corner_radius: 0.001, ..paper(points) });
        let inflated = Inflated::new(&star, &Fit, 2e4).expect("covered");
        let (solved, closed) = (inflated.rest().expect("solvable"), inflated.linear_rest());
        let pairs = [
            (solved.equilibrium, closed.equilibrium),
            (solved.radius, closed.radius),
            (solved.stiffness, closed.stiffness),
            (solved.preload + 1.0, closed.preload + 1.0),
        ];
        for (a, b) in pairs {
            assert!((a / b - 1.0).abs() < 1e-9, "n = {points}: {a} {b}");
        }
    }
}

#[test]
fn linear_stiffness_is_the_published_formula_with_half_angles() {
    let star = paper(4);
    let inflated = Inflated::new(&star, &Fit, 2e4).expect("covered");
    let rest = inflated.linear_rest();
    let [tip, corner] = inflated.hinge_stiffness();
    let (sin, cos) = (0.5 * rest.angle).sin_cos();
    let lever = (PI / 4.0).sin() / (star.arm * cos - star.inflated_width() * sin);
    assert!((rest.stiffness / (4.0 * 4.0 * (tip + corner) * lever * lever) - 1.0).abs() < 1e-12);
}

#[test]
fn force_is_the_derivative_of_the_energy() {
    let star = paper(5);
    let inflated = Inflated::new(&star, &Ring, 37e3).expect("solvable");
    let rest = inflated.rest().expect("solvable");
    let energy = |phi: f64| {
        let part = |hinge: Hinge, phi: f64| {
            let volume = Ring.state(hinge.r_star, hinge.coiling(phi)).expect("solved").volume.expect("known");
            -37e3 * 5.0 * hinge.width.powi(3) * hinge.arc() * volume
        };
        part(star.tip(), phi) + part(star.corner(), phi + star.turn())
    };
    for rho in [0.02, 0.03, 0.04] {
        let step = 1e-6;
        let [low, high] = [rho - step, rho + step].map(|r| inflated.angle_at(r, &rest).expect("in reach"));
        let expected = (energy(high) - energy(low)) / (2.0 * step);
        let force = inflated.force(rho, &rest).expect("in reach");
        assert!((force / expected - 1.0).abs() < 1e-5, "rho {rho}: {force} {expected}");
    }
}

#[test]
fn stiffness_is_the_slope_of_the_force() {
    for (points, model) in [(5, &Ring as &dyn HingeModel), (7, &Ring), (4, &Fit), (7, &Fit)] {
        let star = paper(points);
        let inflated = Inflated::new(&star, model, 37e3).expect("solvable");
        let rest = inflated.rest().expect("solvable");
        let step = 1e-7;
        let rise = inflated.force(rest.radius + step, &rest).expect("in reach") - rest.preload;
        assert!((rise / step / rest.stiffness - 1.0).abs() < 1e-3, "n = {points}: {rise} {rest:?}");
    }
}

#[test]
fn a_star_pressed_shut_has_a_preload() {
    for points in [6, 8] {
        let star = paper(points);
        let rest = Inflated::new(&star, &Ring, 37e3).and_then(|i| i.rest()).expect("solvable");
        assert!(rest.equilibrium < 0.0 && rest.angle == 0.0 && rest.preload > 0.0, "{rest:?}");
        let contact = star.inflated_width() * (1.0 / (PI / f64::from(points)).sin() - 1.0);
        assert!((rest.radius - contact).abs() < 1e-15);
    }
}

#[test]
fn ring_and_penalised_star_agree() {
    let star = flat(0.05, Mechanism { tip_radius: 0.003, corner_radius: 0.003, ..paper(5) });
    let bvp = Bvp::new(1e4, 1e-4);
    let [exact, penalised] = [&Ring as &dyn HingeModel, &bvp]
        .map(|model| Inflated::new(&star, model, 37e3).and_then(|i| i.rest()).expect("solvable"));
    assert!((exact.equilibrium - penalised.equilibrium).abs() < 0.02, "{exact:?} {penalised:?}");
    assert!((exact.radius / penalised.radius - 1.0).abs() < 0.05);
}

#[test]
fn size_and_pressure_scale_as_published() {
    // All lengths by eta: K -> K eta at the same pressure; at p / eta^3: K / eta^2; at p / eta: K.
    let rest = |eta: f64, pressure: f64| {
        let unscaled = paper(4);
        let star = Mechanism { arm: eta * unscaled.arm, width: eta * unscaled.width, ..unscaled };
        Inflated::new(&star, &Ring, pressure).and_then(|i| i.rest()).expect("solvable")
    };
    let unscaled_rest = rest(1.0, 2e4);
    for eta in [0.02_f64, 3.0, 2000.0] {
        for power in [0, 1, 3] {
            let scaled = rest(eta, 2e4 / eta.powi(power));
            assert!((scaled.stiffness / (unscaled_rest.stiffness * eta.powi(1 - power)) - 1.0).abs() < 1e-9);
            assert!((scaled.radius / (unscaled_rest.radius * eta) - 1.0).abs() < 1e-9);
        }
    }
}

#[test]
fn what_cannot_be_reached_is_refused() {
    let star = paper(5);
    let inflated = Inflated::new(&star, &Ring, 37e3).expect("solvable");
    let rest = inflated.rest().expect("solvable");
    let refused = |rho: f64| matches!(inflated.force(rho, &rest), Err(StarFault::Radius { .. }));
    assert!(refused(0.001) && refused(f64::NAN) && refused(2.0 * rest.widest.radius));
    assert!(Inflated::new(&star, &Ring, -1.0).is_err() && Inflated::new(&star, &Ring, f64::NAN).is_err());
}

#[test]
fn every_radius_up_to_the_widest_has_a_force_and_none_beyond() {
    // With seven points rho(phi) falls again before the corner is straight: 47.0 mm there, 48.3 mm at its largest.
    let star = paper(7);
    let inflated = Inflated::new(&star, &Fit, 37e3).expect("covered");
    let rest = inflated.linear_rest();
    let straight = star.radius(0.999_999 * (PI - star.turn())).value;
    assert!(straight < 0.0471 && rest.widest.radius > 0.0482, "{straight} {rest:?}");
    let mut previous = 0.0;
    for rho in [0.03, 0.04, 0.0471, 0.048, rest.widest.radius - 1e-6] {
        let phi = inflated.angle_at(rho, &rest).expect("in reach");
        assert!((star.radius(phi).value - rho).abs() < 1e-12 && phi <= rest.widest.angle);
        let force = inflated.linear_force(rho, &rest).expect("in reach");
        assert!(force > previous, "{rho}: {force} {previous}");
        previous = force;
    }
    let fault = inflated.linear_force(rest.widest.radius + 1e-6, &rest).expect_err("out of reach");
    assert!(fault.to_string().contains("reaches only from"), "{fault}");
}
