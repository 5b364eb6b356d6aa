//! The cone test: a cone pressed down into the star opens it; its vertical load tells the radial force.
//!
//! At each corner the cone (half angle gamma, friction mu) pushes down with `P` and outwards with
//! `P (1 - mu tan(gamma)) / (mu + tan(gamma))`; the plate below carries P, and its friction mu P points
//! inwards, because the corner slides outwards. So the star's own force is
//!
//! ```text
//! F_s = [(1 - mu tan(gamma)) / (mu + tan(gamma)) - mu] P
//! ```
//!
//! The paper prints `+ mu`, which is the balance of a corner that slides inwards on the plate.

use super::fault::StarFault;

/// Which balance of forces reduces the test.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Balance {
    /// The plate's friction opposes the opening.
    #[default]
    Derived,
    /// As printed in the paper.
    Published,
}

/// The cone of a test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// Half the cone's angle gamma, rad, in (0, pi/2).
    pub half_angle: f64,
    /// Kinetic friction mu with cone and plate, 0 or more.
    pub friction: f64,
}

impl Cone {
    /// The cone, checked.
    ///
    /// # Errors
    /// If the angle or the friction is out of range, or friction locks the cone (`mu tan(gamma) >= 1`).
    pub fn new(half_angle: f64, friction: f64) -> Result<Self, StarFault> {
        let need = |holds: bool, symbol, found, allowed| {
            if holds { Ok(()) } else { Err(StarFault::Dimension { symbol, found, allowed }) }
        };
        let acute = half_angle > 0.0 && half_angle < std::f64::consts::FRAC_PI_2;
        need(acute, "gamma", half_angle, "above 0 and below pi/2 (in rad)")?;
        let slides = friction >= 0.0 && friction * half_angle.tan() < 1.0;
        need(slides, "mu", friction, "0 or more, and below 1 / tan(gamma)")?;
        Ok(Self { half_angle, friction })
    }

    /// Radial force per vertical load, F_s / P.
    pub fn ratio(&self, balance: Balance) -> f64 {
        let (tan, mu) = (self.half_angle.tan(), self.friction);
        let cone = (1.0 - mu * tan) / (mu + tan);
        match balance {
            Balance::Derived => cone - mu,
            Balance::Published => cone + mu,
        }
    }

    /// Radius (m) at which the corners touch the cone after a travel of `travel` (m) from first contact at `first` (m).
    pub fn radius(&self, first: f64, travel: f64) -> f64 {
        first + travel * self.half_angle.tan()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn balances_of_the_papers_cone() {
        let cone = Cone::new(30.0_f64.to_radians(), 0.1).expect("valid");
        let (derived, published) = (cone.ratio(Balance::Derived), cone.ratio(Balance::Published));
        assert!((published - derived - 0.2).abs() < 1e-15);
        assert!((published - 1.491).abs() < 1e-3, "{published}");
    }

    #[test]
    fn without_friction_it_is_a_wedge() {
        let cone = Cone::new(0.4, 0.0).expect("valid");
        for balance in [Balance::Derived, Balance::Published] {
            assert!((cone.ratio(balance) - 1.0 / 0.4_f64.tan()).abs() < 1e-15);
        }
        assert!((cone.radius(0.02, 0.01) - (0.02 + 0.01 * 0.4_f64.tan())).abs() < 1e-15);
    }

    #[test]
    fn a_cone_that_locks_is_refused() {
        assert!(
            Cone::new(0.5, 2.0).is_err()
                && Cone::new(0.5, -0.1).is_err()
                && Cone::new(0.5, f64::NAN).is_err()
        );
        assert!(Cone::new(0.0, 0.1).is_err() && Cone::new(1.6, 0.1).is_err());
    }
}
