//! A star inflated around its object against one that is opened by it.

use inflatable::shell::cases::{Fineness, FlatStar, Objects, Tube, Watch, star};
use inflatable::shell::element::Fabric;
use research::around::{ArmTouch, inflate_around};

#[test]
fn a_star_inflated_around_its_object_presses_as_one_that_is_opened() {
    // The paper's fabric.
    let (t, e, nu) = (0.3e-3_f64, 128e6, 0.39);
    let fabric = Fabric::isotropic(e * t, e * t.powi(3) / (12.0 * (1.0 - nu * nu)), nu);
    let tube = Tube { width: 0.03, fabric, pressure: 37e3 };
    let case = FlatStar::sharp(tube, 5, 0.05, 30.0_f64.to_radians());
    let watch = Watch::default();
    let fineness = |cuts| Fineness { cells: 2.0, cuts };
    let opened = star(&case, Objects::Radii(&[0.04]), fineness(2), &watch).expect("a shell").forces[0].1;
    // On the first of those meshes, and on the second, where points beside the apex touch.
    let on = |cuts, touch| inflate_around(&case, 0.04, touch, fineness(cuts), &watch).expect("a shell");
    let (slides, sticks) = (on(0, ArmTouch::Slides), on(1, ArmTouch::Sticks));
    assert!((slides.force.meshes[2] / opened.meshes[0] - 1.0).abs() < 1e-4, "{slides:?} {opened:?}");
    assert_eq!(slides.friction.meshes[2], 0.0);
    assert!(sticks.force.meshes[2] > 1.3 * opened.meshes[1], "{sticks:?} {opened:?}");
    assert!(sticks.friction.meshes[2] > 1.0, "{sticks:?}");
}
