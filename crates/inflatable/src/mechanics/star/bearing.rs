//! The weight that a star **bears**: by friction on the slope of its object, until its arms fold out of their plane.
//!
//! **Slope.** A corner presses on the object with the radial force F. Where the surface leans inwards by theta above the widest part, the
//! normal force N and the friction mu N balance
//!
//! ```text
//! F = N (cos theta + mu sin theta)        V = N (mu cos theta - sin theta)        V = F tan(atan mu - theta)
//! ```
//!
//! with the weight V that the corner bears. Below the widest part theta is negative, and the corner bears more.
//!
//! **Arms.** An inflated tube of radius r = W / pi wrinkles under the bending moment M_w = pi p r^3 / 2, at which the pressure's axial tension
//! p r / 2 is used up on one side, and folds at 2 M_w, where the whole axial force p pi r^2 acts at the other side (Comer and Levy, 1963). The
//! weight on n corners is borne by 2 n arms. An arm leaves its corner at half the corner's angle phi_e against the ray, and the plate below
//! supports it from the edge of its round opening R on. From an object of radius rho to there it is
//!
//! ```text
//! e = sqrt(R^2 - rho^2 sin^2(phi_e/2)) - rho cos(phi_e/2)
//! ```
//!
//! long; a straight edge would be (R - rho) / cos(phi_e/2) away, which is 8 % more at usual corners and twice as much at those of three points.
//! So the arms wrinkle under the weight 2 n M_w / e. The corner that two arms share stiffens them: with the torsional stiffness of a solid tube
//! the moment at the plate is smaller by sin^2(phi_e/2) / 2. That is left out, because a fabric tube has an unknown part of it.

use crate::mechanics::star::Mechanism;
use std::f64::consts::PI;

/// The folding moment over the wrinkling moment.
pub const FOLDING: f64 = 2.0;
/// Largest angle of the force that a corner below the widest part bears against its radial force, rad: tan of it is 5.7. Steeper surfaces rest on
/// the arms rather than slide, and without a limit a corner without force would bear any weight.
const STEEPEST: f64 = 80.0 * PI / 180.0;

/// Weight over radial force on a surface that leans inwards by `slope` (rad, from -pi/2 to pi/2; below 0 it leans outwards) with `friction`.
/// It rises with friction and falls with the slope. Below 0 the star pushes the object down.
pub fn lift(friction: f64, slope: f64) -> f64 {
    if slope == 0.0 {
        return friction;
    }
    let angle = libm::atan(friction);
    libm::tan((angle - slope).min(STEEPEST.max(angle)))
}

/// Bending moment, N m, under which a tube of flat width `width` (m) at the gauge pressure `pressure` (Pa) wrinkles.
pub fn wrinkling_moment(pressure: f64, width: f64) -> f64 {
    0.5 * PI * pressure * (width / PI).powi(3)
}

impl Mechanism {
    /// Length of an arm, m, from an object of radius `rho` (m) to the edge of a round `opening` (radius, m); 0 if the object is as wide. The
    /// hinges' coiling is that at the tip angle `rest`, rad.
    pub fn overhang(&self, rho: f64, opening: f64, rest: f64) -> f64 {
        if rho >= opening {
            return 0.0;
        }
        let (across, along) = libm::sincos(0.5 * (self.tip_angle_at(rho, rest) + self.turn()));
        let to_edge = (opening * opening - (rho * across).powi(2)).max(0.0).sqrt();
        (to_edge - rho * along).max(0.0)
    }

    /// Weight on all corners together, N, under which arms at the gauge pressure `pressure` (Pa) wrinkle where they leave a plate with a round
    /// `opening` (radius, m), if they hold an object of radius `rho` (m); infinite on an object as wide as that. `rest` as of
    /// [`Mechanism::overhang`].
    pub fn wrinkling_weight(&self, pressure: f64, [rho, opening]: [f64; 2], rest: f64) -> f64 {
        2.0 * f64::from(self.points) * wrinkling_moment(pressure, self.width)
            / self.overhang(rho, opening, rest)
    }

    /// Angle of the tips, rad, at the inner radius `rho` (m): exact for hinges of inner radius 0, otherwise with their coiling at the tip angle
    /// `rest`, rad. That of the widest opening beyond it.
    fn tip_angle_at(&self, rho: f64, rest: f64) -> f64 {
        let tip = self.tip_radius * self.tip().arc() / (PI - rest);
        let corner = self.corner_radius * self.corner().arc() / (PI - (rest + self.turn()));
        let width = self.inflated_width();
        let half_chord = width + tip + corner;
        let rim = self.correction.rim_offset * self.width;
        // l sin(phi/2) + (w + r_i + r_e) cos(phi/2)
        let reach = (rho + width + corner) * self.sector_sine() - rim;
        let amplitude = libm::hypot(self.arm, half_chord);
        let phase = libm::atan2(half_chord, self.arm);
        2.0 * (libm::asin((reach / amplitude).clamp(-1.0, 1.0)) - phase)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::star::tests::{flat, paper};
    use proptest::prelude::*;

    #[test]
    fn the_angle_at_a_radius_has_that_radius() {
        for star in (3..=8).map(paper) {
            for phi in [0.0, 0.1, 0.3] {
                let rho = star.radius(phi).value;
                assert!((star.tip_angle_at(rho, 0.0) - phi).abs() < 1e-9, "{star:?} {phi}");
            }
        }
        let round = flat(0.05, Mechanism { tip_radius: 0.002, corner_radius: 0.004, ..paper(5) });
        for phi in [0.1, 0.3, 0.5] {
            let rho = round.radius(phi).value;
            assert!((round.tip_angle_at(rho, 0.2) - phi).abs() < 0.02, "{phi}");
        }
    }

    /// A straight edge, or a small corner's angle, is what the circle tends to.
    #[test]
    fn the_overhang_is_the_way_to_the_edge() {
        let star = paper(5);
        let rho = star.radius(0.2).value;
        let half = 0.5 * (0.2 + star.turn());
        for gap in [1e-4, 5e-3, 2e-2] {
            let overhang = star.overhang(rho, rho + gap, 0.2);
            let end = libm::hypot(rho + overhang * libm::cos(half), overhang * libm::sin(half));
            assert!((end - rho - gap).abs() < 1e-12, "{gap}");
            let straight = gap / libm::cos(half);
            assert!(overhang < straight && (gap > 1e-3 || overhang > 0.99 * straight), "{gap}");
        }
        assert_eq!(star.overhang(rho, 0.9 * rho, 0.2), 0.0);
        assert!(star.wrinkling_weight(1e3, [rho, rho], 0.2).is_infinite());
    }

    /// 37 kPa in a tube of 30 mm: r = 9.55 mm, M_w = 50.6 N mm.
    #[test]
    fn the_wrinkling_moment_is_that_of_comer_and_levy() {
        let (pressure, radius) = (37e3, 0.03 / PI);
        let by_stress = pressure * radius / 2.0 * PI * radius * radius;
        assert!((wrinkling_moment(pressure, 0.03) / by_stress - 1.0).abs() < 1e-12);
        assert!((wrinkling_moment(pressure, 0.03) - 0.0506).abs() < 1e-4);
    }

    proptest! {
        #[test]
        fn a_corner_bears_more_with_friction_and_less_on_a_slope(
            friction in 0.01..5.0_f64, slope in -1.57..1.57_f64, step in 1e-6..1e-4_f64,
        ) {
            let lift_here = lift(friction, slope);
            prop_assert!(lift(friction + step, slope) >= lift_here);
            prop_assert!(lift(friction, slope + step) <= lift_here);
            // Continuous, also at the limit and at the widest part.
            prop_assert!((lift(friction, slope + step) - lift_here).abs() < 60.0 * step * (1.0 + lift_here * lift_here));
            // Equal corners above and below the widest part bear at least as much as two at it.
            let is_self_locking = f64::max(friction, 5.6) > 2.0 * friction + 1.0 / friction;
            prop_assert!(!is_self_locking || lift_here + lift(friction, -slope) >= 2.0 * friction * (1.0 - 1e-12));
        }

        #[test]
        fn arms_bear_more_with_pressure_and_with_a_wider_object(
            points in 3..9_u32, phi in 0.02..0.4_f64, pressure in 1e3..6e4_f64, gap in 1e-3..2e-2_f64,
        ) {
            let star = paper(points);
            let rho = star.radius(phi).value;
            let weight = |pressure: f64, rho: f64| star.wrinkling_weight(pressure, [rho, rho.max(0.02) + gap], 0.1);
            let lightest = weight(pressure, rho);
            prop_assert!(lightest > 0.0 && weight(1.01 * pressure, rho) > lightest);
            let wider = star.wrinkling_weight(pressure, [rho + 1e-9, rho.max(0.02) + gap], 0.1);
            prop_assert!((wider / lightest - 1.0).abs() < 1e-4);
        }
    }
}
