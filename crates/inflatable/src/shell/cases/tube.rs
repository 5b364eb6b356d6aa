//! The tube that every case is made of, its pressure, and the scales by which the shell computes.

use crate::numerics::spans;
use crate::shell::cases::fault::{Input, ShellFault};
use crate::shell::element::Fabric;
use crate::shell::solver::{Continuation, Stop};

/// A tube of fabric under pressure, SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tube {
    /// Flat width W, m.
    pub width: f64,
    /// Y, N/m, B, N m, and nu of one sheet.
    pub fabric: Fabric,
    /// Gauge pressure p, Pa.
    pub pressure: f64,
}

/// Least t/W of the tubes tested.
const THINNEST: f64 = 1e-4;
/// t/W beyond which the sheet is no thin shell.
const THICKEST: f64 = 0.03;
/// p W/Y beyond which strains are no longer small.
pub(crate) const MOST_STRETCHED: f64 = 0.1;
/// Largest 1/eps of the shells tested.
pub(crate) const MOST_BENDABLE: f64 = 5000.0;
/// Poisson's ratios that fabrics have.
const MOST_POISSON: f64 = 0.499;
/// Shear modulus by that of an isotropic sheet; the least one tested is 0.02.
const LEAST_SHEAR: f64 = 0.01;
const MOST_SHEAR: f64 = 10.0;
/// Least norm of residuals, by Y W: 1e-16 a force of order one, of a hundred thousand.
const FLOOR: f64 = 2e-13;

impl Tube {
    /// 1/eps = p W^3 / B.
    pub fn bendability(&self) -> f64 {
        self.pressure * self.width.powi(3) / self.fabric.bending
    }

    /// p W/Y.
    pub fn stretch(&self) -> f64 {
        self.pressure * self.width / self.fabric.stretch
    }

    /// t/W of an isotropic sheet with this bending and stretching stiffness.
    pub fn slenderness(&self) -> f64 {
        let Fabric { stretch, bending, poisson, .. } = self.fabric;
        (12.0 * (1.0 - poisson * poisson) * bending / stretch).sqrt() / self.width
    }

    /// # Errors
    /// If it is no tube, or one that a thin shell of small strains does not describe.
    pub(crate) fn check(&self) -> Result<(), ShellFault> {
        self.check_within(THINNEST, MOST_BENDABLE)
    }

    /// Checks the tube with other limits of t/W from below and of 1/eps from above.
    pub(crate) fn check_within(&self, thinnest: f64, most_bendable: f64) -> Result<(), ShellFault> {
        check_range(Input::Width, self.width, [1e-4, 10.0])?;
        check_range(Input::Poisson, self.fabric.poisson, [0.0, MOST_POISSON])?;
        check_range(Input::Stretching, self.fabric.stretch, [1e-3, 1e12])?;
        check_range(Input::Bending, self.fabric.bending, [1e-15, 1e9])?;
        check_range(Input::Shear, self.fabric.weave.shear, [LEAST_SHEAR, MOST_SHEAR])?;
        check_range(Input::Slenderness, self.slenderness(), [thinnest, THICKEST])?;
        let bendability = check_range(Input::Bendability, self.bendability(), [1.0, most_bendable]);
        let fault =
            bendability.and_then(|()| check_range(Input::Stretch, self.stretch(), [0.0, MOST_STRETCHED]));
        // Both are in proportion to the pressure.
        let minimum = self.pressure_at(1.0);
        let maximum = self.pressure_at(most_bendable).min(MOST_STRETCHED * self.fabric.stretch / self.width);
        if minimum < maximum {
            fault.map_err(|_| ShellFault::Pressure { found: self.pressure, least: minimum, most: maximum })
        } else {
            fault
        }
    }

    /// The pressure, Pa, at which 1/eps is `bendability`.
    fn pressure_at(&self, bendability: f64) -> f64 {
        bendability * self.fabric.bending / self.width.powi(3)
    }

    /// The fabric in the scales of the shell.
    pub fn scaled(&self) -> Fabric {
        let Fabric { stretch, bending, .. } = self.fabric;
        Fabric { stretch: 1.0, bending: bending / (stretch * self.width * self.width), ..self.fabric }
    }

    /// From 1/eps = 1 to its pressure.
    pub fn continuation(&self) -> Continuation {
        Continuation { first: self.scaled().bending, last: self.stretch(), floor: FLOOR }
    }

    /// The fault of a tube without an equilibrium at its pressure, where there was one before another input changed.
    pub fn stopped(&self, reason: Stop, triangles: usize) -> ShellFault {
        let bendability = self.bendability();
        if reason == Stop::Cancelled {
            ShellFault::Cancelled
        } else {
            ShellFault::Stopped { why: reason, at: bendability, last: bendability, triangles }
        }
    }

    /// One unit of energy, J; of moment and of stiffness against an angle too.
    pub fn energy(&self) -> f64 {
        self.fabric.stretch * self.width * self.width
    }
}

fn check_range(name: Input, value: f64, [minimum, maximum]: [f64; 2]) -> Result<(), ShellFault> {
    if spans(&(minimum..=maximum), value) {
        Ok(())
    } else {
        Err(ShellFault::Range { name, found: value, least: minimum, most: maximum })
    }
}
