//! The radial force of a star at its pressure on a round object that opens it.
//!
//! Arms are rigid and hinges nonlinear, see [correction](super::correction): the moment of a hinge of stiffness C at the angle d
//! beyond its rest is `C d (1 + c d)`. A tip rests at d_i and a corner at d_e when the star rests at phi_0. Both turn by D when an object
//! opens it, and their moments grow by
//!
//! ```text
//! k(D) D = C_i [1 + 2 c d_i + c D] D + C_e [1 + 2 c d_e + c D] D
//! ```
//!
//! By virtual work one corner presses with `F = k(D) D / rho'(phi_0 + D)`. The corner also yields where it is pressed, like a hinge of
//! stiffness k(0) on a lever of mu W, in series with the hinges. The object that opens the star by o turns the hinges by the D at which
//!
//! ```text
//! o = rho(phi_0 + D) - rho(phi_0) + F (mu W / sin(pi/n))^2 / k(0)
//! ```
//!
//! The right side rises with D to infinity at the widest opening, where rho' = 0, so there is one D for each o. The force grows over its
//! own tangent `k(0) / [rho'(phi_0)^2 + (mu W / sin(pi/n))^2]` at o = 0 by a factor, and with the radial stiffness K of the star
//!
//! ```text
//! F_star = a K o S(o)        S(o) = F [rho'(phi_0)^2 + (mu W / sin(pi/n))^2] / [k(0) o]        S(0) = 1
//! ```
//!
//! Arms that touch keep phi_0 at contact, and an object separates them at once. So o, K and rho' are those of phi_0 at which the hinges
//! alone would rest, where the arms would cross. The fit has three constants: `RIM` a, `LEVER` mu and `CURVED`, the c above over that of the
//! correction. They come from 189 forces of the stars of the sets `fit`, `range`, `paper` and `test` 1 to 180 by least squares of the
//! logarithm of force over K o, both of the shell: 11.5 % rms. On stars 181 to 240, which were not used, it is 11.6 %. The 189 are of
//! shells whose arms do not touch, on an object no wider than the flat star, with less than a quarter left open by the meshes. For 158 of them
//! there is a prediction with a range to compare (docs/ranges.md).

use crate::mechanics::star::Mechanism;

/// a: the rim of a corner is stiffer than K, which is the stiffness against a load on the whole section, by this factor.
const RIM: f64 = 1.171;
/// mu: lever of a corner's compliance where the object presses, over W / sin(pi/n).
const LEVER: f64 = 0.2287;
/// Curvature of a hinge under an object over that in the correction: c is 2.149 exp(-20.8 p W / Y) here.
const CURVED: f64 = 1.509;
/// Least part of the hinges' stiffness that is left at rest. No star of the fit has less than 0.5; it keeps a search's odd stars finite.
const LEAST_LEFT: f64 = 0.2;
/// The opening is met to this part of it.
const TOLERANCE: f64 = 1e-9;
/// Steps after which the angle is taken as it is: bisection alone needs 30.
const STEPS: usize = 60;

/// A star that is opened by a round object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grasp {
    star: Mechanism,
    /// Angle of the tips at rest, rad, and how far the star opens beyond it at most.
    angles: [f64; 2],
    /// Radial stiffness K at rest, N per m.
    stiffness: f64,
    /// c k' / k(0), per rad: `k(D) = k(0) (1 + growth D)`.
    growth: f64,
    /// Radius and slope at rest, m and m per rad.
    rest: [f64; 2],
    /// `(mu W / sin(pi/n))^2`, m^2.
    lever: f64,
}

/// Two hinges at rest in a star: tip and corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HingePair {
    /// Stiffnesses C_i and C_e, N m per rad.
    pub stiffness: [f64; 2],
    /// The tips' angle at which each would rest by itself, rad.
    pub target: [f64; 2],
}

impl Grasp {
    /// The grasp of `star` with `hinges`, which rests at the tips' angle `angle` (rad) with the radial stiffness `stiffness` (N per m) and
    /// opens to the angle `widest` (rad) at most.
    pub fn new(star: &Mechanism, hinges: HingePair, [angle, widest]: [f64; 2], stiffness: f64) -> Self {
        let c = CURVED * star.correction.hinge_nonlinearity;
        let HingePair { stiffness: [tip, corner], target: [of_tip, of_corner] } = hinges;
        let pull = tip * (1.0 + 2.0 * c * (angle - of_tip)) + corner * (1.0 + 2.0 * c * (angle - of_corner));
        let total = tip + corner;
        let lever = LEVER * star.width / star.sector_sine();
        let arms = star.radius(angle);
        Self {
            star: *star,
            angles: [angle, (widest - angle).max(0.0)],
            stiffness,
            growth: c * total / pull.max(LEAST_LEFT * total),
            rest: [arms.value, arms.slope],
            lever: lever * lever,
        }
    }

    /// Radius from which on the star presses, m: where its hinges alone would rest.
    pub fn free_radius(&self) -> f64 {
        self.rest[0]
    }

    /// The star's tube width W, m.
    pub fn width(&self) -> f64 {
        self.star.width
    }

    /// Radial force (N, all corners together) on an object of radius `rho`, m.
    pub fn force(&self, rho: f64) -> f64 {
        self.force_from(rho, self.free_radius())
    }

    /// Radial force (N, all corners together) on an object of radius `rho` (m), if it is met from the radius `contact_radius` (m) on.
    pub fn force_from(&self, rho: f64, contact_radius: f64) -> f64 {
        let opening = (rho - contact_radius).max(0.0);
        let by_shells = libm::exp(self.star.correction.force_beyond(opening / self.star.width));
        RIM * self.stiffness * opening * self.secant(opening) * by_shells
    }

    /// S of an opening, m.
    fn secant(&self, opening: f64) -> f64 {
        let [_, max_turn] = self.angles;
        let [_, slope] = self.rest;
        let tangent = slope * slope + self.lever;
        // A star that does not open by rigid arms yields at its corners alone.
        if !(opening > 0.0 && max_turn > 0.0 && slope > 0.0) {
            return 1.0;
        }
        let [mut low, mut high] = [0.0, max_turn];
        let mut turned = (opening * slope / tangent).min(0.5 * max_turn);
        let [mut force, mut reached_opening] = [0.0, opening];
        for _ in 0..STEPS {
            let rises;
            (reached_opening, rises, force) = self.opened_by(turned);
            let remaining = opening - reached_opening;
            if remaining.abs() <= TOLERANCE * opening {
                break;
            }
            if remaining > 0.0 {
                low = turned;
            } else {
                high = turned;
            }
            let next = turned + remaining / rises;
            turned = if next > low && next < high { next } else { 0.5 * (low + high) };
        }
        // Where corners are straight before the arms lock, the last secant is extended.
        force * tangent / reached_opening
    }

    /// The opening, m, at which the corners have turned by `turned`, rad, with its derivative, and the force over k(0).
    fn opened_by(&self, turned: f64) -> (f64, f64, f64) {
        let open = self.star.radius(self.angles[0] + turned);
        let [radius, _] = self.rest;
        let moment = turned * (1.0 + self.growth * turned);
        let force = moment / open.slope;
        let steeper = (1.0 + 2.0 * self.growth * turned - force * open.curvature) / open.slope;
        (open.value - radius + force * self.lever, open.slope + steeper * self.lever, force)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::star::Correction;
    use crate::mechanics::star::tests::paper;

    const HINGES: HingePair = HingePair { stiffness: [0.19, 0.34], target: [0.2, -0.1] };

    fn grasp(points: u32, curved: f64) -> Grasp {
        let star = Mechanism {
            correction: Correction { hinge_nonlinearity: curved, ..Correction::default() },
            ..paper(points)
        };
        Grasp::new(&star, HINGES, [0.03, star.widest(0.03).angle], 600.0)
    }

    #[test]
    fn the_first_force_is_that_of_the_stiffness() {
        for points in 3..=8 {
            let single_grasp = grasp(points, 0.8);
            let first = single_grasp.force_from(0.02 + 1e-9, 0.02) / 1e-9;
            assert!((first / (RIM * 600.0) - 1.0).abs() < 1e-4, "{points}: {first}");
            assert!(single_grasp.force_from(0.02, 0.02) == 0.0 && single_grasp.force_from(0.01, 0.02) == 0.0);
        }
    }

    #[test]
    fn force_and_opening_meet_both_equations() {
        // F by k(D) D / rho' at the D that a dense grid finds for the opening.
        let (single_grasp, star) = (grasp(5, 0.8), paper(5));
        let (k, opening) = (1.0, 0.012);
        let force = |turned: f64| {
            k * turned * (1.0 + single_grasp.growth * turned) / star.radius(0.03 + turned).slope
        };
        let opened = |turned: f64| {
            star.radius(0.03 + turned).value - star.radius(0.03).value
                + force(turned) * single_grasp.lever / k
        };
        let turned = (1..200_000).map(|i| 3e-6 * f64::from(i)).find(|turned| opened(*turned) >= opening);
        let expected = force(turned.expect("it opens so far"))
            * (single_grasp.rest[1].powi(2) + single_grasp.lever)
            / opening;
        assert!(
            (single_grasp.secant(opening) / expected - 1.0).abs() < 1e-4,
            "{} {expected}",
            single_grasp.secant(opening)
        );
    }

    #[test]
    fn forces_grow_with_the_opening_as_far_as_arms_lock_and_beyond() {
        for (points, curved) in (3..=8).flat_map(|points| [0.0, 0.3, 1.4].map(|curved| (points, curved))) {
            let single_grasp = grasp(points, curved);
            let mut previous = 0.0;
            for step in 1..=2000 {
                let force = single_grasp.force_from(0.02 + 1e-4 * f64::from(step), 0.02);
                assert!(
                    force > previous && force.is_finite(),
                    "{points} {curved} {step}: {previous} {force}"
                );
                previous = force;
            }
        }
        assert!(grasp(5, 1.4).secant(0.01) > grasp(5, 0.0).secant(0.01));
    }

    #[test]
    fn a_star_that_cannot_open_or_has_no_stiffness_has_a_finite_force() {
        let star = paper(8);
        let locked = Grasp::new(&star, HINGES, [1.4, 1.4], 600.0);
        assert!((locked.force_from(0.03, 0.02) / (RIM * 600.0 * 0.01) - 1.0).abs() < 1e-12);
        assert_eq!(Grasp { stiffness: 0.0, ..locked }.force_from(0.03, 0.02), 0.0);
        // Hinges that pull against each other more than they hold.
        let wild = HingePair { target: [2.0; 2], ..HINGES };
        let nonlinear = Correction { hinge_nonlinearity: 1.4, ..Correction::default() };
        let wild = Grasp::new(&Mechanism { correction: nonlinear, ..star }, wild, [0.0, 0.5], 600.0);
        assert!(wild.force_from(0.03, 0.02) > 0.0 && wild.force_from(0.03, 0.02).is_finite());
    }
}
