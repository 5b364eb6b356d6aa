//! Woven fabric: as stiff along the warp as along the weft, and of any stiffness against shear between them.
//!
//! In the axes of warp and weft an isotropic sheet and a woven one with the same Y, B and nu differ by the shear alone. Both energies are
//! quadratic in it, so a woven sheet is the isotropic one and, per area,
//!
//! (s - 1) [S gamma^2 + B (1 - nu) (2 tau)^2 / 2] / 2,
//!
//! with s = G / G_0, G_0 = E / [2 (1 + nu)], S = G_0 t = Y / [2 (1 + nu)], the angle of shear gamma = 2 E_12 and the twist tau = kappa_12
//! in those axes. B (1 - nu)/2 = G_0 t^3 / 12 is the stiffness against twist, D_66 of a plate. Jones, "Mechanics of composite materials"
//! (1999), sections 2.3 and 4.2.

use crate::shell::element::Fabric;

/// The weave of a sheet of fabric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weave {
    /// Shear modulus between warp and weft by that of an isotropic sheet, E / [2 (1 + nu)]; above 0.
    pub shear: f64,
    /// Angle of the warp against the flat sheet's first axis, rad, counterclockwise.
    pub warp: f64,
}

impl Weave {
    /// No weave: the same in all directions.
    pub const ISOTROPIC: Self = Self { shear: 1.0, warp: 0.0 };

    /// Whether the sheet is the same in all directions.
    pub fn is_isotropic(self) -> bool {
        self.shear == 1.0
    }

    /// Whether a mirror on a line at the angle `line` (rad) to the first axis leaves the weave as it is: the warp lies at a multiple of 45
    /// deg to it.
    pub fn is_mirrored_at(self, line: f64) -> bool {
        let eighths = (self.warp - line) / std::f64::consts::FRAC_PI_4;
        self.is_isotropic() || (eighths - eighths.round()).abs() < 1e-9
    }

    /// What the weave adds, by the change of the stiffness against shear that s - 1 makes.
    fn adds(self, stiffness: impl Fn(f64) -> f64) -> Option<[[f64; 3]; 3]> {
        if self.is_isotropic() {
            return None;
        }
        // gamma by E11, E22, 2 E12: the slope of the angle of shear between warp and weft by the strain in the flat sheet's axes.
        let (sine, cosine) = libm::sincos(2.0 * self.warp);
        let (row, added) = ([-sine, sine, cosine], stiffness(self.shear - 1.0));
        Some(row.map(|a| row.map(|b| added * a * b)))
    }
}

/// The contribution of the weave to the stress of an isotropic sheet, by E11, E22, 2 E12: `None` if there is none.
pub(super) fn membrane(fabric: Fabric) -> Option<[[f64; 3]; 3]> {
    fabric.weave.adds(|shear| shear * fabric.stretch / (2.0 * (1.0 + fabric.poisson)))
}

/// The contribution of the weave to the moments of an isotropic sheet, by kappa_11, kappa_22, 2 kappa_12: `None` if there is none.
pub(super) fn bending(fabric: Fabric) -> Option<[[f64; 3]; 3]> {
    fabric.weave.adds(|shear| shear * fabric.bending * (1.0 - fabric.poisson) / 2.0)
}
