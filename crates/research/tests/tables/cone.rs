//! The balance of the cone test against cases that are known in closed form.

use research::cone::Balance;

#[test]
fn the_two_balances_differ_by_twice_the_friction() {
    let ratio = |balance: Balance| balance.ratio(30.0_f64.to_radians(), 0.1).expect("slides");
    let (derived, published) = (ratio(Balance::Derived), ratio(Balance::Published));
    assert!((published - derived - 0.2).abs() < 1e-15);
    assert!((published - 1.491).abs() < 1e-3, "{published}");
}

#[test]
fn a_cone_without_friction_is_a_wedge() {
    for balance in [Balance::Derived, Balance::Published] {
        let ratio = balance.ratio(0.4, 0.0).expect("slides");
        assert!((ratio - 1.0 / 0.4_f64.tan()).abs() < 1e-15, "{balance:?}: {ratio}");
    }
}

/// The derived balance locks from gamma + 2 phi = 90 deg on, the published one from gamma + phi = 90 deg on.
#[test]
fn a_cone_locks_at_the_angle_of_its_friction() {
    for (balance, half_angle, friction_angle) in [
        (Balance::Derived, 30.0_f64, 30.0_f64),
        (Balance::Derived, 60.0, 15.0),
        (Balance::Published, 30.0, 60.0),
        (Balance::Published, 60.0, 30.0),
    ] {
        let (half_angle, friction) = (half_angle.to_radians(), friction_angle.to_radians().tan());
        let slides = balance.ratio(half_angle, friction - 1e-9);
        assert!(slides.is_some_and(|ratio| ratio > 0.0), "{balance:?}: {slides:?}");
        assert_eq!(balance.ratio(half_angle, friction + 1e-9), None, "{balance:?}");
    }
}
