//! The response of a star beyond its hinges and rigid arms: a **correction** with few numbers, from stars computed as shells.
//!
//! At its pressure a hinge stays wider than a cylinder, and arms keep that width at their ends: half the tip's and half the corner's
//! between the centres of their arcs. Short bends are all end, and nearly as narrow as arms:
//!
//! ```text
//! w = W' + (w_section - W') tanh(alpha_0 / 0.469)        W' = 2 W / pi
//! ```
//!
//! Fabric that stretches makes the whole star larger. A round corner's rim lies further out than its coiling gives, as does that of a
//! corner that turns little. The radius grows by
//!
//! ```text
//! W / sin(pi/n) [-0.0461 + 0.0917 R_e/W + 1.092 p W / Y - 0.0096 ln(p W^3 / (1000 B)) + 0.0703 sin(pi/n) - 0.015 alpha_0e]
//! ```
//!
//! Hinges are stiffer opened than closed. In a star tips are held open by corners that are held shut, so that it rests further in than
//! linear hinges would; the more fabric stretches, the less. At the angle d beyond its rest a hinge of stiffness C pulls as
//!
//! ```text
//! M = C d (1 + c d)        c = 1.424 exp(-20.8 p W / Y)
//! ```
//!
//! Arms of an inflated tube of radius W / pi bend as beams of E I = pi (W/pi)^3 Y = W^3 Y / pi^2, which no constant was fitted to: hinges of
//! stiffness C between arms that are longer than the 4 W of their table pull as if they had `1/C' = 1/C + (l - 4 W) / (E I)`. Arms narrow
//! between their hinges, so those of a tip touch only where they are turned beyond parallel. A corner also has a compliance of its own,
//! with a lever of about W: where rho moves by s with phi_i, the star's stiffness is that of its hinges times
//!
//! ```text
//! s^2 / (s^2 + (0.42 W / sin(pi/n))^2) exp(-0.598 + 0.073 l/W + 18.7 t/W + 6.07 p W / Y)
//! ```
//!
//! The force on a round object is given by [`Grasp`](super::grasp::Grasp). What shells give beyond all of these are the
//! [`Residuals`](super::residuals).

use crate::mechanics::star::Mechanism;
use crate::mechanics::star::residuals::{OPENINGS, Ratios, Residuals};
use std::f64::consts::{FRAC_2_PI, PI};
use std::sync::LazyLock;

/// Response of an inflated star beyond its hinges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Correction {
    /// Inflated width over W between the centres of a tip's and a corner's arc.
    pub width: f64,
    /// Shift of a corner's inner rim away from the axis of its sector, over W; times 1 / sin(pi/n) in radius.
    pub rim_offset: f64,
    /// Angle of the tips at which the arms touch, rad, 0 or less.
    pub contact_angle: f64,
    /// By which part a hinge is stiffer with each rad that it is opened, and softer with each that it is closed.
    pub hinge_nonlinearity: f64,
    /// Turn of an arm's ends under a moment of p W^3, rad, beyond the one in the hinges' table; below 0 for short arms.
    pub arm_compliance: f64,
    /// Radial stiffness over the one from hinges and levers.
    pub stiffness_factor: f64,
    /// Whether corners are compliant where the object pushes.
    pub corner_compliance: bool,
    /// By how much the equilibrium lies further open than that of the hinges, rad.
    pub angle_offset: f64,
    /// Logarithm of the force on an object over that of the force law, at the [`OPENINGS`].
    pub force_beyond: [f64; OPENINGS.len()],
}

/// No correction: tubes as wide as cylinders, rigid arms that touch when they are parallel.
impl Default for Correction {
    fn default() -> Self {
        Self {
            width: FRAC_2_PI,
            rim_offset: 0.0,
            contact_angle: 0.0,
            hinge_nonlinearity: 0.0,
            arm_compliance: 0.0,
            stiffness_factor: 1.0,
            corner_compliance: false,
            angle_offset: 0.0,
            force_beyond: [0.0; OPENINGS.len()],
        }
    }
}

/// Arc from which on a hinge has much of its own width, rad; this and all below by least squares over stars computed as shells.
const OWN_WIDTH: f64 = 0.469;
/// Room between the inner rims of a tip's parallel arms besides the coiled hinge's hole, over W.
const ROOM: f64 = 0.0212;
/// By how much the inner rim lies further out, over W / sin(pi/n): always, and by each R_e/W, p W / Y, ln(1/eps / 1000), sin(pi/n), and rad
/// of the corner's arc.
const OUT: [f64; 6] = [-0.0461, 0.0917, 1.092, -0.0096, 0.0703, -0.015];
/// 1/eps over which that was taken.
pub const BENDABILITY: [f64; 2] = [100.0, 5000.0];
/// Arms of the hinges' table, by W.
pub const TABLE_ARM: f64 = 4.0;
/// Arms from which on they are no shorter, by W.
const SHORT_ARM: f64 = 2.0;
/// Least part of 1/C that is left where short arms stiffen hinges.
const LEAST_LEFT: f64 = 0.3;
/// Lever of a corner's own compliance, over W / sin(pi/n).
const LEVER: f64 = 0.42;
/// Logarithm of the stiffness over that of hinges and levers: always, and by each l/W, t/W and p W / Y.
const FIRM: [f64; 4] = [-0.598, 0.073, 18.7, 6.07];
/// Relative increase of a hinge's stiffness on opening, per rad, in fabric that hardly stretches; and the rate of its exponential decrease
/// with p W / Y.
const CURVED: [f64; 2] = [1.424, 20.8];

impl Correction {
    /// The correction of `star` with `ratios`, whose hinges, if they were endless, would be `width` W wide when inflated.
    pub fn new(star: &Mechanism, width: f64, ratios: Ratios) -> Self {
        Self::trend(star, width, ratios).with_residuals(&Residuals::new(star, ratios))
    }

    /// The closed forms alone, without what shells give beyond them.
    pub fn trend(star: &Mechanism, width: f64, ratios: Ratios) -> Self {
        let Ratios { thickness, stretch, bendability } = ratios;
        let [tip, corner] = [star.tip(), star.corner()]
            .map(|hinge| FRAC_2_PI + (width - FRAC_2_PI) * libm::tanh(hinge.arc() / OWN_WIDTH));
        let width = 0.5 * (tip + corner);
        let long = star.arm / star.width;
        // A coiled tip keeps the length of its inner arc, between parallel arms nearly as much as between touching ones.
        let hole = star.tip_radius * star.tip().arc() / PI + ROOM * star.width;
        let sector = star.sector_sine();
        let [least_bendability, greatest_bendability] = BENDABILITY;
        let log_bendability = libm::log(bendability.clamp(least_bendability, greatest_bendability) / 1000.0);
        let counts = [1.0, star.corner().r_star, stretch, log_bendability, sector, star.corner().arc()];
        let outward: f64 = OUT.iter().zip(counts).map(|(each, count)| each * count).sum();
        let [curved, fades] = CURVED;
        let [firm, by_arm, by_thickness, by_stretch] = FIRM;
        Self {
            width,
            rim_offset: (width - corner) * sector + outward,
            contact_angle: -2.0 * libm::atan2(hole, star.arm),
            hinge_nonlinearity: curved * libm::exp(-fades * stretch),
            arm_compliance: PI * PI * stretch * (long.max(SHORT_ARM) - TABLE_ARM),
            stiffness_factor: libm::exp(
                firm + by_arm * long + by_thickness * thickness + by_stretch * stretch,
            ),
            corner_compliance: true,
            ..Self::default()
        }
    }

    /// The correction with `residuals`.
    #[must_use]
    pub fn with_residuals(self, residuals: &Residuals) -> Self {
        let Residuals { angle, radius, stiffness, force } = *residuals;
        Self {
            angle_offset: angle,
            rim_offset: self.rim_offset + radius,
            stiffness_factor: self.stiffness_factor * libm::exp(stiffness),
            // The residual of the force counts from the stiffness of the closed form.
            force_beyond: force.map(|force| force - stiffness),
            ..self
        }
    }

    /// The equilibrium of two hinges that pull against each other, rad, as the tips' angle. Inputs are the angle at which each rests alone
    /// and its stiffness. To first order in the nonlinearity.
    pub fn balance(&self, [tip, corner]: [f64; 2], [c_tip, c_corner]: [f64; 2]) -> f64 {
        let part = c_tip / (c_tip + c_corner);
        let linear = part * tip + (1.0 - part) * corner;
        linear
            - self.hinge_nonlinearity
                * (part * (linear - tip).powi(2) + (1.0 - part) * (linear - corner).powi(2))
    }

    /// Logarithm of the force on an object that opens the star by `opening` W over that of the force law: straight between the [`OPENINGS`]
    /// in their logarithm, and constant beyond them.
    pub(super) fn force_beyond(&self, opening: f64) -> f64 {
        /// Logarithms of the ratios of neighbouring openings, for designs in millions.
        static STEPS: LazyLock<[f64; 2]> = LazyLock::new(|| {
            let [smallest, middle, largest] = OPENINGS;
            [libm::log(middle / smallest), libm::log(largest / middle)]
        });
        let [smallest, middle, largest] = OPENINGS;
        let [a, b, c] = self.force_beyond;
        let (start, step, [low, high]) = match opening {
            _ if opening <= smallest => return a,
            _ if opening <= middle => (smallest, STEPS[0], [a, b]),
            _ if opening < largest => (middle, STEPS[1], [b, c]),
            _ => return c,
        };
        low + (high - low) * libm::log(opening / start) / step
    }

    /// The stiffness of a hinge between the star's arms, from that of the table's hinge; both over p W^3.
    pub fn stiffness_between_arms(&self, stiffness: f64) -> f64 {
        stiffness / (1.0 + stiffness * self.arm_compliance).max(LEAST_LEFT)
    }

    /// The radial stiffness of `star` over that of its hinges between rigid arms, where the radius grows by `slope` (m per rad) with the
    /// tips' angle.
    pub(super) fn softness(&self, star: &Mechanism, slope: f64) -> f64 {
        if !self.corner_compliance {
            return 1.0;
        }
        let lever = LEVER * star.width / star.sector_sine();
        self.stiffness_factor * slope * slope / (slope * slope + lever * lever)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::star::tests::{flat, paper};

    const RATIOS: Ratios = Ratios { thickness: 0.01, stretch: 0.01, bendability: 1000.0 };

    fn corrected(star: Mechanism) -> Mechanism {
        Mechanism { correction: Correction::trend(&star, 0.8, RATIOS), ..star }
    }

    fn softness(star: &Mechanism) -> f64 {
        star.correction.softness(star, star.radius(0.1).slope)
    }

    #[test]
    fn hinges_are_wider_than_cylinders_and_short_ones_less() {
        let corrections: Vec<Correction> = (3..=8).map(|n| corrected(paper(n)).correction).collect();
        // Sharp corners at 1/eps = 1000.
        let outward_of = |n: u32| {
            let sector = (PI / f64::from(n)).sin();
            OUT[0] + OUT[2] * RATIOS.stretch + OUT[4] * sector + OUT[5] * paper(n).corner().arc()
        };
        assert!(corrections.iter().all(|one| one.width > FRAC_2_PI && one.width < 0.8));
        assert!((3..).zip(&corrections).all(|(n, one)| one.rim_offset > outward_of(n)));
        assert!(
            corrections
                .windows(2)
                .all(|pair| pair[1].width > pair[0].width && pair[1].rim_offset < pair[0].rim_offset)
        );
        // A corner that hardly turns is as narrow as an arm.
        let star = corrected(Mechanism { tip_angle: 59.9_f64.to_radians(), ..paper(3) });
        let outward = outward_of(3) + OUT[5] * (star.corner().arc() - paper(3).corner().arc());
        let corner = star.correction.width - (star.correction.rim_offset - outward) / (PI / 3.0).sin();
        assert!((corner - FRAC_2_PI).abs() < 1e-3, "{corner}");
    }

    #[test]
    fn short_arms_are_soft() {
        let softness_of = |n| softness(&corrected(paper(n)));
        assert!((3..8).all(|n| softness_of(n + 1) < softness_of(n)));
        assert!(softness_of(8) > 0.0 && softness_of(8) < 0.1 && softness_of(3) > 0.9 && softness_of(3) < 1.1);
        assert_eq!(softness(&paper(8)), 1.0);
    }

    #[test]
    fn hinges_that_curve_balance_where_their_moments_do() {
        // Newton's method on C_i d (1 + c d) + C_e e (1 + c e), d = phi - one, e = phi - other.
        let (first, other, weights) = (0.3, 0.42, [1.0, 1.3]);
        for curved in [0.0, 0.5, 1.4] {
            let moment = |phi: f64| {
                let pull = |c: f64, d: f64| [c * d * (1.0 + curved * d), c * (1.0 + 2.0 * curved * d)];
                let [a, b] = [pull(weights[0], phi - first), pull(weights[1], phi - other)];
                [a[0] + b[0], a[1] + b[1]]
            };
            let root = (0..20).fold(0.36, |phi, _| phi - moment(phi)[0] / moment(phi)[1]);
            let balanced = Correction { hinge_nonlinearity: curved, ..Correction::default() }
                .balance([first, other], weights);
            assert!((balanced - root).abs() < 0.1 * curved * 0.06_f64.powi(2) + 1e-15, "{balanced} {root}");
        }
        let curved =
            |stretch| Correction::trend(&paper(5), 0.8, Ratios { stretch, ..RATIOS }).hinge_nonlinearity;
        assert!(curved(0.0) == CURVED[0] && curved(0.05) < 0.4 * curved(0.0));
    }

    #[test]
    fn long_arms_take_from_stiff_hinges_what_theory_says() {
        // A tube of radius W / pi: its wall's area times r^2 / 2, times E.
        let (w, stretch) = (0.03, 4e4);
        let r = w / PI;
        let rigidity = PI * r.powi(3) * stretch;
        let star = Mechanism { arm: 6.0 * w, ..paper(4) };
        let scale = RATIOS.stretch * stretch * w * w;
        let bends = Correction::trend(&star, 0.8, RATIOS).arm_compliance;
        assert!((bends / scale - 2.0 * w / rigidity).abs() < 1e-12 * bends / scale);
        let correction = corrected(star).correction;
        assert!(
            correction.stiffness_between_arms(2.0) < 2.0
                && (1.0 / correction.stiffness_between_arms(2.0) - 0.5 - bends).abs() < 1e-12
        );
        // Shorter arms than the table's stiffen, and never turn a hinge around.
        let short = Correction::trend(&paper(7), 0.8, Ratios { stretch: 0.1, ..RATIOS });
        assert!(
            short.arm_compliance < 0.0
                && short.stiffness_between_arms(0.3) > 0.3
                && short.stiffness_between_arms(1e3) > 0.0
        );
        assert_eq!(Correction::default().stiffness_between_arms(2.0), 2.0);
    }

    #[test]
    fn fabric_that_stretches_and_round_corners_make_a_star_larger() {
        let rim = |ratios, corner_radius| {
            let star = Mechanism { corner_radius, ..paper(5) };
            Correction::trend(&star, 0.8, ratios).rim_offset
        };
        let plain = rim(RATIOS, 0.0);
        assert!(rim(Ratios { stretch: 0.05, ..RATIOS }, 0.0) > plain + 0.03);
        assert!(rim(RATIOS, 0.006) > plain + 0.01);
        assert!(rim(Ratios { bendability: 5000.0, ..RATIOS }, 0.0) < plain);
        assert!(rim(Ratios { bendability: 0.0, ..RATIOS }, 0.0).is_finite());
    }

    #[test]
    fn round_tips_let_arms_come_closer_than_parallel() {
        let touch =
            |tip_radius| corrected(flat(0.05, Mechanism { tip_radius, ..paper(5) })).correction.contact_angle;
        assert!(touch(0.004) < touch(0.0) - 0.05 && touch(0.0) < 0.0 && touch(0.004) > -0.2);
        assert_eq!(Correction::default().contact_angle, 0.0);
    }

    #[test]
    fn it_moves_the_rim_and_scales_with_the_star() {
        let star = paper(5);
        let moved = Mechanism { correction: Correction { rim_offset: 0.1, ..Correction::default() }, ..star };
        let expected = 0.1 * star.width / (PI / 5.0).sin();
        assert!((moved.radius(0.2).value - star.radius(0.2).value - expected).abs() < 1e-15);
        assert_eq!(moved.radius(0.2).slope, star.radius(0.2).slope);
        let unscaled = corrected(star);
        let two = corrected(Mechanism { arm: 2.0 * star.arm, width: 2.0 * star.width, ..star });
        assert!((two.radius(0.1).value / unscaled.radius(0.1).value - 2.0).abs() < 1e-12);
        assert!((softness(&two) - softness(&unscaled)).abs() < 1e-12);
        assert!((two.correction.contact_angle - unscaled.correction.contact_angle).abs() < 1e-12);
    }

    #[test]
    fn residuals_move_angle_rim_and_stiffness_and_the_force_between_the_openings() {
        let trend = Correction::trend(&paper(5), 0.8, RATIOS);
        let residuals = Residuals { angle: 0.01, radius: 0.02, stiffness: 0.1, force: [0.1, 0.3, 0.0] };
        let corrected_trend = trend.with_residuals(&residuals);
        assert!(
            (corrected_trend.rim_offset - trend.rim_offset - 0.02).abs() < 1e-15
                && corrected_trend.angle_offset == 0.01
        );
        assert!((corrected_trend.stiffness_factor / trend.stiffness_factor - libm::exp(0.1)).abs() < 1e-15);
        // The stiffness is in the force already.
        let force = |opening: f64| corrected_trend.force_beyond(opening) + 0.1;
        for (opening, expected) in [(0.0, 0.1), (0.15, 0.1), (0.45, 0.3), (0.9, 0.0), (5.0, 0.0)] {
            assert!((force(opening) - expected).abs() < 1e-12, "{opening}");
        }
        assert!((force((0.15_f64 * 0.45).sqrt()) - 0.2).abs() < 1e-12);
        assert_eq!(trend.with_residuals(&Residuals::default()), trend);
        assert_eq!(
            Correction::new(&paper(5), 0.8, RATIOS),
            trend.with_residuals(&Residuals::new(&paper(5), RATIOS))
        );
    }
}
