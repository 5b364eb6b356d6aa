//! Laws that every model of the hinge must obey, written once and instantiated for each.

use crate::mechanics::hinge::bvp::Bvp;
use crate::mechanics::hinge::fit::Fit;
use crate::mechanics::hinge::ring::Ring;
use crate::mechanics::hinge::{Hinge, HingeModel, HingeState};

/// R* at which the laws are tested; the first is the paper's own star.
const R_STARS: [f64; 7] = [0.0, 0.01, 0.1, 0.5, 2.0, 10.0, 100.0];

fn state(model: &dyn HingeModel, r_star: f64, lambda: f64) -> HingeState {
    model.state(r_star, lambda).unwrap_or_else(|fault| panic!("R* {r_star}, lambda {lambda}: {fault}"))
}

fn target(model: &dyn HingeModel, r_star: f64) -> HingeState {
    model.target(r_star).unwrap_or_else(|fault| panic!("R* {r_star}: {fault}"))
}

/// The target is where the moment vanishes, it overcoils, and it is stable.
fn target_is_a_stable_rest(model: &dyn HingeModel, tolerance: f64) {
    for r_star in R_STARS {
        let rest = target(model, r_star);
        assert!(rest.lambda > 1.2 && rest.lambda < 1.4, "R* {r_star}: {}", rest.lambda);
        assert!(rest.slope.abs() <= tolerance * (1.0 + r_star), "R* {r_star}: {}", rest.slope);
        assert!(rest.curvature < -0.3, "R* {r_star}: {}", rest.curvature);
        let hinge = Hinge { r_star, width: 0.02, rest_angle: 1.0 };
        assert!(hinge.moment(1e4, &state(model, r_star, rest.lambda - 0.02)) < 0.0, "open hinges close");
        assert!(hinge.moment(1e4, &state(model, r_star, rest.lambda + 0.02)) > 0.0, "closed hinges open");
        assert!(hinge.stiffness(1e4, &rest) > 0.0);
    }
}

/// V_bar' and V_bar'' are the derivatives of V_bar and V_bar', by central differences.
fn slopes_are_derivatives(model: &dyn HingeModel, step: f64, tolerance: f64) {
    for r_star in R_STARS {
        let onset = model.onset(r_star).expect("in range").unwrap_or(0.0);
        for lambda in [1.0, 1.09, 1.28, 1.34, 1.45] {
            if (lambda - onset).abs() <= 2.0 * step {
                continue;
            }
            let [below, center, above] = [-step, 0.0, step].map(|d| state(model, r_star, lambda + d));
            let scale = 1.0 + r_star;
            if let (Some(low), Some(high)) = (below.volume, above.volume) {
                let slope = (high - low) / (2.0 * step);
                assert!(
                    (slope - center.slope).abs() < tolerance * scale,
                    "R* {r_star}, lambda {lambda}: V' {slope} {}",
                    center.slope
                );
            }
            let curvature = (above.slope - below.slope) / (2.0 * step);
            let error = (curvature - center.curvature).abs();
            assert!(
                error < tolerance * scale,
                "R* {r_star}, lambda {lambda}: V'' {curvature} {}",
                center.curvature
            );
        }
    }
}

/// Every number is finite over the range of lambda that the paper uses.
fn everything_is_finite(model: &dyn HingeModel) {
    for r_star in R_STARS {
        for i in 0..=10 {
            let hinge_state = state(model, r_star, 1.0 + 0.05 * f64::from(i));
            let edges = hinge_state.edges.map_or([0.0; 4], |e| [e.tension, e.angle, e.width, e.rim_force]);
            let effort = [hinge_state.effort.residual, hinge_state.effort.error];
            let numbers = [
                hinge_state.lambda,
                hinge_state.volume.unwrap_or(0.0),
                hinge_state.slope,
                hinge_state.curvature,
            ];
            assert!(numbers.iter().chain(&edges).chain(&effort).all(|x| x.is_finite()), "{hinge_state:?}");
        }
    }
}

/// A hinge, ten times as large at a thousandth of the pressure, has the same moment and stiffness.
fn moments_scale_with_pressure_and_volume(model: &dyn HingeModel) {
    let (small, large) = (0.02, 0.2);
    let hinge_state = state(model, 0.1, 1.2);
    let hinge = |width| Hinge { r_star: 0.1, width, rest_angle: 1.0 };
    let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
    close(hinge(small).moment(1e4, &hinge_state), hinge(large).moment(10.0, &hinge_state));
    close(hinge(small).stiffness(1e4, &hinge_state), hinge(large).stiffness(10.0, &hinge_state));
}

/// Invalid hinges are refused.
fn nonsense_is_refused(model: &dyn HingeModel) {
    for r_star in [-1e-9, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(
            model.state(r_star, 1.2).is_err()
                && model.target(r_star).is_err()
                && model.onset(r_star).is_err()
        );
    }
    for lambda in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(model.state(0.1, lambda).is_err());
    }
}

/// A hinge is stiffer when it is opened than when it is closed, by the same angle, as long as the cone
/// exists; below its onset the opening moment is nearly constant.
fn opening_is_stiffer_than_closing(model: &dyn HingeModel) {
    for r_star in R_STARS {
        let rest = target(model, r_star).lambda;
        let step = 0.8 * (rest - model.onset(r_star).expect("in range").expect("has an onset"));
        let opened = state(model, r_star, rest - step).slope;
        let closed = -state(model, r_star, rest + step).slope;
        assert!(opened > closed && closed > 0.0, "R* {r_star}: {opened} {closed}");
    }
}

macro_rules! laws {
    ($($name:ident: $model:expr, $rest:expr, $step:expr, $slopes:expr;)+) => {$(
        mod $name {
            use super::*;
            #[test]
            fn target_is_a_stable_rest() { super::target_is_a_stable_rest(&$model, $rest); }
            #[test]
            fn slopes_are_derivatives() { super::slopes_are_derivatives(&$model, $step, $slopes); }
            #[test]
            fn everything_is_finite() { super::everything_is_finite(&$model); }
            #[test]
            fn moments_scale_with_pressure_and_volume() { super::moments_scale_with_pressure_and_volume(&$model); }
            #[test]
            fn nonsense_is_refused() { super::nonsense_is_refused(&$model); }
        }
    )+};
}

laws! {
    fit: Fit, 1e-15, 1e-4, 1e-9;
    ring: Ring, 1e-12, 1e-4, 2e-6;
    bvp: Bvp::new(300.0, 1e-5), 1e-7, 5e-4, 2e-3;
}

#[test]
fn the_ring_is_stiffer_when_opened() {
    opening_is_stiffer_than_closing(&Ring);
}
