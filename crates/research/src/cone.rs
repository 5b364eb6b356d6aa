//! The cone test: a cone pressed down into the star opens it, and its vertical load gives the radial force.
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
//!
//! Where a balance leaves no force outwards the cone **locks**: by the derived one from `mu = (1 - sin(gamma)) / cos(gamma)` on,
//! because the plate's friction then bears all that the cone pushes; by the paper's from `mu = 1 / tan(gamma)` on.

/// The balance of forces that reduces the test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Balance {
    /// The plate's friction opposes the opening.
    Derived,
    /// As printed in the paper.
    Published,
}

impl Balance {
    /// Radial force of the star per vertical load, F_s / P, of a cone of half the angle `half_angle` (rad, in (0, pi/2)) and the kinetic
    /// friction `friction` with cone and plate; `None` where the cone locks.
    pub fn ratio(self, half_angle: f64, friction: f64) -> Option<f64> {
        let tan = libm::tan(half_angle);
        let outwards = (1.0 - friction * tan) / (friction + tan);
        let ratio = match self {
            Self::Derived => outwards - friction,
            Self::Published => outwards + friction,
        };
        (friction < self.locking_friction(half_angle)).then_some(ratio)
    }

    /// The least friction at which a cone of half the angle `half_angle` (rad) locks.
    ///
    /// With `mu = tan(phi)` the cone pushes outwards with `P / tan(gamma + phi)`. This is `mu P` where `gamma + 2 phi` is a
    /// right angle, and 0 where `gamma + phi` is.
    pub fn locking_friction(self, half_angle: f64) -> f64 {
        match self {
            Self::Derived => (1.0 - libm::sin(half_angle)) / libm::cos(half_angle),
            Self::Published => 1.0 / libm::tan(half_angle),
        }
    }
}
