//! The energy of one triangle of the sheet: **membrane** (stretch in its plane), **bending** (how it and its neighbours
//! turn against each other) and the **volume** below it; each with its gradient and Hessian in closed form.
//!
//! Corners are numbered 0, 1, 2 counterclockwise; edge `i` lies opposite to corner `i` and runs from corner `i + 1` to
//! corner `i + 2`. The three corners have nine coordinates: coordinate `3 k + c` is component `c` of corner `k`.
//!
//! Formulas are homogeneous, so any consistent units are valid. `shell::cases` defines its units.

pub mod bending;
pub mod fold;
pub mod membrane;
pub(crate) mod vector;
pub mod volume;
mod weave;

pub use weave::Weave;

/// Elastic constants of the sheet, per unit of its flat area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fabric {
    /// Y = E t: force a unit of length.
    pub stretch: f64,
    /// B = E t^3 / (12 (1 - nu^2)): a moment a unit of length times a length.
    pub bending: f64,
    /// Poisson's ratio nu; of woven fabric along warp and weft.
    pub poisson: f64,
    /// Weave of the fabric.
    pub weave: Weave,
}

impl Fabric {
    /// Fabric that is the same in all directions.
    pub const fn isotropic(stretch: f64, bending: f64, poisson: f64) -> Self {
        Self { stretch, bending, poisson, weave: Weave::ISOTROPIC }
    }

    /// This fabric with the weave `weave`.
    #[must_use]
    pub const fn woven(self, weave: Weave) -> Self {
        Self { weave, ..self }
    }
}

/// Second derivatives by the nine coordinates of a triangle's corners.
pub type Square = [[f64; 9]; 9];

/// The corner that follows `k`.
pub(crate) const NEXT: [usize; 3] = [1, 2, 0];
/// The corner before `k`.
pub(crate) const LAST: [usize; 3] = [2, 0, 1];
