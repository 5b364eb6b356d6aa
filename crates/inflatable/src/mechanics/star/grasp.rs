//! How hard a star at its pressure presses on a round object that opens it, from stars that shells were opened of.
//!
//! K moves a corner's section as a whole; an object meets the corner's rim. Shells press on it harder than K times the opening, the more
//! so the stiffer the corner is against its pressure, `kappa = K / (n p W)`, and the further it is opened, until arms bend before they
//! lock. Corners of kappa 2 and more that turn little press less: as if behind a second spring, which is softer the smaller the object
//! is and the less the corner turns, so as a patch of contact is smaller. Two springs one behind the other, then:
//!
//! ```text
//! F = F_0 + K o S        o = rho - rho_f
//! 1/S = exp(-0.714 + 0.23 alpha_0e - 0.505 alpha_0e o/W) kappa^-0.145 + kappa exp(-0.604 - 1.839 alpha_0e) (rho/W)^-0.484
//! ```
//!
//! where F_0 is what presses arms that touch, alpha_0e the corner's flat arc, and o/W counts up to 0.9.

use crate::mechanics::star::Mechanism;

/// Openings by W over which the force grows: as far as shells were opened.
const OPENED: f64 = 0.9;
/// Logarithm of how much stiffer the rim is than the section: always, by each rad of the corner's arc, by each of ln kappa, and by
/// each rad and W of opening. This and all below by least squares over the stars of docs/ranges.md that were opened.
const RIM: [f64; 4] = [0.714, -0.23, 0.145, 0.505];
/// Logarithm of how the second spring gives way, by 1 / (n p W): always, by each rad of the corner's arc, and by ln(rho/W).
const PATCH: [f64; 3] = [-0.604, -1.839, -0.484];

/// A star that is opened by a round object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grasp {
    /// W, m.
    width: f64,
    /// Flat arc of a corner, rad.
    arc: f64,
    /// Radial stiffness K at rest, N per m.
    stiffness: f64,
    /// Stiffness of a corner over p W.
    kappa: f64,
}

impl Grasp {
    /// Of `star` with the radial stiffness `stiffness` (N per m) at rest, at the gauge pressure `pressure` (Pa, above 0).
    pub fn new(star: &Mechanism, stiffness: f64, pressure: f64) -> Self {
        let kappa = stiffness / (f64::from(star.points) * pressure * star.width);
        Self { width: star.width, arc: star.corner().arc(), stiffness, kappa }
    }

    /// Radial force (N, all corners together) on an object of radius `rho` (m), if it is met from the radius `from` (m) on.
    pub fn force(&self, rho: f64, from: f64) -> f64 {
        let opening = (rho - from).max(0.0);
        self.stiffness * opening * self.secant(opening / self.width, rho / self.width)
    }

    /// S, of an opening and an object's radius, both by W.
    fn secant(&self, opening: f64, rho: f64) -> f64 {
        let Self { arc, kappa, .. } = self;
        let [always, by_arc, by_kappa, locks] = RIM;
        let rim = always + (by_arc + locks * opening.min(OPENED)) * arc + by_kappa * libm::log(*kappa);
        let [at_first, of_arc, of_object] = PATCH;
        let patch = at_first + of_arc * arc + of_object * libm::log(rho);
        1.0 / (libm::exp(-rim) + kappa * libm::exp(patch))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRASP: Grasp = Grasp { width: 0.03, arc: 1.0, stiffness: 600.0, kappa: 0.1 };

    #[test]
    fn objects_meet_more_force_the_further_they_open_until_arms_bend() {
        let secant = |opening| GRASP.secant(opening, 1.0);
        assert!(secant(0.0) > 1.0 && secant(0.4) > secant(0.1) + 0.15);
        assert_eq!(secant(1.8), secant(OPENED));
        let force = |rho: f64| GRASP.force(rho, 0.02);
        assert!(force(0.02) == 0.0 && force(0.01) == 0.0);
        assert!((force(0.026) / (600.0 * 0.006 * GRASP.secant(0.2, 0.026 / 0.03)) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_stiff_corner_yields_by_its_second_spring() {
        // However stiff it is: not more than the second spring bears.
        let stiff = |kappa: f64| kappa * Grasp { kappa, ..GRASP }.secant(0.2, 1.0);
        let most = (-PATCH[0] - PATCH[1]).exp();
        assert!(stiff(1.0) < stiff(10.0) && stiff(10.0) < stiff(1e4) && stiff(1e4) < most);
        assert!(stiff(1e6) > 0.95 * most);
        let thin = Grasp { kappa: 5.0, ..GRASP };
        assert!(thin.secant(0.2, 0.3) < 0.8 * thin.secant(0.2, 1.0));
    }

    #[test]
    fn no_stiffness_is_no_force() {
        assert_eq!(Grasp { stiffness: 0.0, kappa: 0.0, ..GRASP }.force(0.03, 0.02), 0.0);
    }
}
