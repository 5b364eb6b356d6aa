//! What a star does beyond its hinges and rigid arms: a **correction** with six numbers, from stars computed as shells.
//!
//! A hinge's own width at its pressure is that of the arms too. The inner rim of a corner that hardly turns lies further out than a
//! coiled annulus would have it, and that of one that turns far further in. Round tips let arms come closer than parallel before they
//! touch. And arms give way where the object pushes, so that short ones lever less than rigid ones would.

use crate::mechanics::star::Mechanism;
use std::f64::consts::FRAC_2_PI;

/// What inflation does to a star beyond its hinges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Correction {
    /// Inflated width over W, of arms and hinges alike.
    pub width: f64,
    /// How much further from the axis of a corner's sector its inner rim lies, over W; times 1 / sin(pi/n) in radius.
    pub rim: f64,
    /// Angle of the tips at which the arms touch, rad, 0 or less.
    pub touch: f64,
    /// Whether arms give way where the object pushes.
    pub gives: bool,
}

/// None: tubes as wide as cylinders, arms rigid, and touching when they are parallel.
impl Default for Correction {
    fn default() -> Self {
        Self { width: FRAC_2_PI, rim: 0.0, touch: 0.0, gives: false }
    }
}

/// `rim` of a sharp corner without arc, its slopes by the corner's arc (rad) and by R_e*: least squares over the stars of the first set.
const RIM: [f64; 3] = [0.0426, -0.0426, 0.1178];
/// Stiffness of a star with arms so long that what follows does not matter, over that of its hinges: least squares of logarithms.
const STIFFER: f64 = 1.725;
/// By how much the lever of an arm is longer than the arm, over W, and the tube wider than it is: the same.
const LEVER: [f64; 2] = [1.184, 0.503];

impl Correction {
    /// Of the star `star` whose hinges are `width` W wide when inflated.
    pub fn new(star: &Mechanism, width: f64) -> Self {
        let [least, by_arc, by_radius] = RIM;
        let corner = star.corner();
        let rim = least + by_arc * corner.arc() + by_radius * corner.r_star;
        // A coiled tip keeps the length of its inner arc, between parallel arms nearly as much as between touching ones.
        let coiled = star.tip_radius * star.tip().arc() / std::f64::consts::PI;
        Self { width, rim, touch: -2.0 * coiled.atan2(star.arm), gives: true }
    }

    /// The radial stiffness of `star` at the tips' angle `phi` (rad) over that of its hinges between rigid arms.
    pub fn softness(&self, star: &Mechanism, phi: f64) -> f64 {
        if !self.gives {
            return 1.0;
        }
        let [longer, wider] = LEVER;
        let (sin, cos) = (0.5 * phi).sin_cos();
        let lever = (star.arm + longer * star.width) * cos - (self.width + wider) * star.width * sin;
        let rigid = 2.0 * (0.5 * star.turn()).sin() * star.radius(phi).slope;
        // Arms so short that closing widens the star have no lever, and no star like them was computed.
        STIFFER * (rigid / lever.max(0.1 * star.width)).powi(2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::star::tests::{flat, paper};

    #[test]
    fn short_arms_are_soft_and_corners_that_turn_far_reach_inwards() {
        let of = |n| (paper(n), Correction::new(&paper(n), 0.8));
        let softness = |n| of(n).1.softness(&of(n).0, 0.1);
        assert!((3..8).all(|n| softness(n + 1) < softness(n) && of(n + 1).1.rim < of(n).1.rim));
        assert!(softness(8) > 0.0 && softness(3) < STIFFER);
        assert_eq!(Correction::default().softness(&paper(8), 0.1), 1.0);
    }

    #[test]
    fn round_tips_let_arms_come_closer_than_parallel() {
        let round = flat(0.05, Mechanism { tip_radius: 0.004, ..paper(5) });
        let touch = Correction::new(&round, 0.8).touch;
        assert!(touch < -0.05 && touch > -0.15, "{touch}");
        assert_eq!(Correction::new(&paper(5), 0.8).touch, 0.0);
    }

    #[test]
    fn it_moves_the_rim_and_scales_with_the_star() {
        let star = paper(5);
        let moved = Mechanism { correction: Correction { rim: 0.1, ..Correction::default() }, ..star };
        let expected = 0.1 * star.width / (std::f64::consts::PI / 5.0).sin();
        assert!((moved.radius(0.2).value - star.radius(0.2).value - expected).abs() < 1e-15);
        assert_eq!(moved.radius(0.2).slope, star.radius(0.2).slope);
    }
}
