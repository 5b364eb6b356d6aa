//! Stars of woven fabric: which weaves the planes of symmetry of a star leave as they are.

use super::tests::tube;
use super::*;
use crate::shell::element::Weave;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

#[test]
fn half_a_sector_stands_for_a_star_of_four_points_woven_along_its_planes() {
    for (warp, points, is_symmetric) in [
        (0.0, 4, true),
        (FRAC_PI_4, 4, true),
        (-FRAC_PI_2, 4, true),
        (0.3, 4, false),
        (0.0, 5, false),
        (FRAC_PI_4, 8, false),
    ] {
        let star = |shear: f64| {
            let mut woven_tube = tube(0.03, 500.0);
            woven_tube.fabric = woven_tube.fabric.woven(Weave { shear, warp });
            FlatStar::sharp(woven_tube, points, 0.04, 0.9)
        };
        assert_eq!(star(0.3).is_symmetric(), is_symmetric, "{points} {warp}");
        assert!(star(1.0).is_symmetric(), "{points} {warp}");
    }
}
