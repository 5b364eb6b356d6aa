//! Quantities in the units of physics, and back.

use super::{Angle, BendingStiffness, Length, LineForce, Percent, Pressure};

impl Length {
    /// The length in m.
    pub fn metres(self) -> f64 {
        self.0 * 1e-3
    }

    /// A length given in m.
    pub fn from_metres(metres: f64) -> Self {
        Self(metres * 1e3)
    }
}

impl Pressure {
    /// The pressure in Pa.
    pub fn pascals(self) -> f64 {
        self.0 * 1e3
    }

    /// A pressure given in Pa.
    pub fn from_pascals(pascals: f64) -> Self {
        Self(pascals * 1e-3)
    }
}

impl LineForce {
    /// The force per length in N/m.
    pub fn newtons_per_metre(self) -> f64 {
        self.0 * 1e3
    }

    /// A force per length given in N/m.
    pub fn from_newtons_per_metre(newtons: f64) -> Self {
        Self(newtons * 1e-3)
    }
}

impl BendingStiffness {
    /// The stiffness in N m.
    pub fn newton_metres(self) -> f64 {
        self.0 * 1e-3
    }

    /// A stiffness given in N m.
    pub fn from_newton_metres(newton_metres: f64) -> Self {
        Self(newton_metres * 1e3)
    }
}

impl Angle {
    /// The angle in rad.
    pub fn rad(self) -> f64 {
        self.0.to_radians()
    }
}

impl Percent {
    /// The plain ratio, 0.1 for 10 %.
    pub fn ratio(self) -> f64 {
        self.0 / 100.0
    }
}
