//! What a star does beyond its hinges and rigid arms: a **correction** with four numbers, from stars computed as shells.
//!
//! At its pressure a hinge stays wider than a cylinder, and arms keep that width at their ends: half the tip's and half the corner's
//! between the centres of their arcs. Short bends are all end, and nearly as narrow as arms:
//!
//! ```text
//! w = W' + (w_section - W') tanh(alpha_0 / 1.57)        W' = 2 W / pi
//! ```
//!
//! Arms narrow between their hinges, so those of a tip touch only where they are turned beyond parallel. And a corner gives way
//! by itself, as if on a lever of about W of its own: where rho moves by s with phi_i, the star's stiffness is that of its hinges times
//! `s^2 / (s^2 + (0.53 W / sin(pi/n))^2)`.
//!
//! A round object meets a corner at its rim, which is stiffer than the section moved as a whole, and the more so the further it is opened;
//! and arms bend before they lock. So the force grows with the opening `o` = rho - rho_f as
//!
//! ```text
//! F = F_0 + K o (1.2 + 1.35 o/W)
//! ```
//!
//! where F_0 is what presses arms that touch, and o/W counts up to 0.45.
//!
//! Thin sheets close a star further than the table of their arms says, long arms more than short ones:
//! by `1.40 deg (0.01 W / t)^2 l / (l + W)`.

use crate::mechanics::star::Mechanism;
use std::f64::consts::{FRAC_2_PI, PI};

/// What inflation does to a star beyond its hinges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Correction {
    /// Inflated width over W between the centres of a tip's and a corner's arc.
    pub width: f64,
    /// How much further from the axis of a corner's sector its inner rim lies, over W; times 1 / sin(pi/n) in radius.
    pub rim: f64,
    /// Angle of the tips at which the arms touch, rad, 0 or less.
    pub touch: f64,
    /// By how much further the tips close than their hinges and the corners' say, rad.
    pub closer: f64,
    /// Whether corners give way where the object pushes.
    pub gives: bool,
}

/// None: tubes as wide as cylinders, arms rigid, and touching when they are parallel.
impl Default for Correction {
    fn default() -> Self {
        Self { width: FRAC_2_PI, rim: 0.0, touch: 0.0, closer: 0.0, gives: false }
    }
}

/// Arc from which on a hinge has much of its own width, rad; this and the three below by least squares over the stars of the first set.
const OWN_WIDTH: f64 = 1.57;
/// Room between the inner rims of a tip's parallel arms besides the coiled hinge's hole, over W.
const ROOM: f64 = 0.041;
/// On which lever a corner gives way by itself, over W / sin(pi/n).
const LEVER: f64 = 0.53;
/// How much further tips close, rad, with long arms of t/W = 0.01.
const CLOSER: f64 = 0.0245;
/// See [`CLOSER`].
const THIN: f64 = 0.01;

/// The force that opens a star over its stiffness at rest times the opening: at first, and by how much more with each W.
const SECANT: [f64; 2] = [1.2, 1.35];
/// Openings by W over which the force grows so: as far as shells were opened.
pub const OPENED: f64 = 0.45;

impl Correction {
    /// Force that opens a star by `opening` W, over its stiffness at rest times that; 1 without a correction.
    pub fn secant(&self, opening: f64) -> f64 {
        let [first, more] = SECANT;
        if self.gives { first + more * opening.clamp(0.0, OPENED) } else { 1.0 }
    }

    /// Of the star `star` of fabric of thickness t/W = `thickness`, whose hinges, if they were endless, would be `width` W wide when
    /// inflated.
    pub fn new(star: &Mechanism, width: f64, thickness: f64) -> Self {
        let own = |arc: f64| FRAC_2_PI + (width - FRAC_2_PI) * (arc / OWN_WIDTH).tanh();
        let (tip, corner) = (own(star.tip().arc()), own(star.corner().arc()));
        let width = 0.5 * (tip + corner);
        // A coiled tip keeps the length of its inner arc, between parallel arms nearly as much as between touching ones.
        let hole = star.tip_radius * star.tip().arc() / PI + ROOM * star.width;
        let rim = (width - corner) * (0.5 * star.turn()).sin();
        let closer = CLOSER * (THIN / thickness).powi(2) * star.arm / (star.arm + star.width);
        Self { width, rim, touch: -2.0 * hole.atan2(star.arm), closer, gives: true }
    }

    /// The radial stiffness of `star` at the tips' angle `phi` (rad) over that of its hinges between rigid arms.
    pub fn softness(&self, star: &Mechanism, phi: f64) -> f64 {
        if !self.gives {
            return 1.0;
        }
        let own = LEVER * star.width / (0.5 * star.turn()).sin();
        let slope = star.radius(phi).slope;
        slope * slope / (slope * slope + own * own)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::star::tests::{flat, paper};

    fn corrected(star: Mechanism) -> Mechanism {
        Mechanism { correction: Correction::new(&star, 0.8, 0.01), ..star }
    }

    #[test]
    fn hinges_are_wider_than_cylinders_and_short_ones_less() {
        let all: Vec<Correction> = (3..=8).map(|n| corrected(paper(n)).correction).collect();
        assert!(all.iter().all(|one| one.width > FRAC_2_PI && one.width < 0.8 && one.rim > 0.0));
        assert!(all.windows(2).all(|pair| pair[1].width > pair[0].width && pair[1].rim < pair[0].rim));
        // A corner that hardly turns is as narrow as an arm.
        let star = corrected(Mechanism { tip_angle: 59.9_f64.to_radians(), ..paper(3) });
        let corner = star.correction.width - star.correction.rim / (PI / 3.0).sin();
        assert!((corner - FRAC_2_PI).abs() < 1e-3, "{corner}");
    }

    #[test]
    fn short_arms_are_soft() {
        let softness = |n| {
            let star = corrected(paper(n));
            star.correction.softness(&star, 0.1)
        };
        assert!((3..8).all(|n| softness(n + 1) < softness(n)));
        assert!(softness(8) > 0.0 && softness(8) < 0.1 && softness(3) > 0.9 && softness(3) < 1.0);
        assert_eq!(Correction::default().softness(&paper(8), 0.1), 1.0);
    }

    #[test]
    fn objects_meet_more_force_the_further_they_open() {
        let correction = corrected(paper(5)).correction;
        assert!(correction.secant(0.0) > 1.0 && correction.secant(0.4) > correction.secant(0.1) + 0.2);
        assert_eq!(correction.secant(0.8), correction.secant(OPENED));
        assert_eq!(Correction::default().secant(0.4), 1.0);
    }

    #[test]
    fn thin_sheets_and_long_arms_close_further() {
        let closer = |n, thickness| Correction::new(&paper(n), 0.8, thickness).closer.to_degrees();
        assert!(closer(3, 0.01) > 1.1 && closer(3, 0.03) < 0.15 && closer(8, 0.01) < 0.3);
        assert_eq!(Correction::default().closer, 0.0);
    }

    #[test]
    fn round_tips_let_arms_come_closer_than_parallel() {
        let touch = |tip_radius| corrected(flat(0.05, Mechanism { tip_radius, ..paper(5) })).correction.touch;
        assert!(touch(0.004) < touch(0.0) - 0.05 && touch(0.0) < 0.0 && touch(0.004) > -0.2);
        assert_eq!(Correction::default().touch, 0.0);
    }

    #[test]
    fn it_moves_the_rim_and_scales_with_the_star() {
        let star = paper(5);
        let moved = Mechanism { correction: Correction { rim: 0.1, ..Correction::default() }, ..star };
        let expected = 0.1 * star.width / (PI / 5.0).sin();
        assert!((moved.radius(0.2).value - star.radius(0.2).value - expected).abs() < 1e-15);
        assert_eq!(moved.radius(0.2).slope, star.radius(0.2).slope);
        let one = corrected(star);
        let two = corrected(Mechanism { arm: 2.0 * star.arm, width: 2.0 * star.width, ..star });
        assert!((two.radius(0.1).value / one.radius(0.1).value - 2.0).abs() < 1e-12);
        assert!((two.correction.softness(&two, 0.1) - one.correction.softness(&one, 0.1)).abs() < 1e-12);
        assert!((two.correction.touch - one.correction.touch).abs() < 1e-12);
    }
}
