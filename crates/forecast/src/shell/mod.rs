//! Predictions by the shell, with the keys of other predictions. It takes seconds, so it must be selected by
//! name.
//!
//! [`request`] converts a star to the shell's inputs and its results to numbers with mesh errors, [`star`]
//! computes a spec's stars, [`actuator`] a single hinge between two arms; [`result`] formats the prediction of
//! stars.

pub mod actuator;
pub mod request;
pub mod result;
pub mod star;

use inflatable::mechanics::strength::ElasticSheet;
use inflatable::shell::cases::{Fineness, StarPart};
use inflatable::shell::element::{Fabric, Weave};

pub use spec::Detail;

/// The name of the model.
pub const SHELL: &str = "shell";

/// The meshes that `detail` means.
pub fn fineness(detail: Detail) -> Fineness {
    match detail {
        Detail::Coarse => Fineness { cells: 3.0, cuts: 2 },
        Detail::Medium => Fineness::default(),
        Detail::Fine => Fineness { cells: 12.0, cuts: 3 },
    }
}

/// The meshes that `detail` means for a star of which `part` is modelled: a whole one has 2 n times the triangles, so it gets larger ones.
/// Those of five points have up to 150,000, 200,000 and 350,000 unknowns.
pub fn fineness_of(part: StarPart, detail: Detail) -> Fineness {
    match (part, detail) {
        (StarPart::HalfSector, _) => fineness(detail),
        (StarPart::Whole, Detail::Coarse) => Fineness { cells: 3.0, cuts: 2 },
        (StarPart::Whole, Detail::Medium) => Fineness { cells: 6.0, cuts: 2 },
        (StarPart::Whole, Detail::Fine) => Fineness { cells: 8.0, cuts: 2 },
    }
}

/// The fabric of `sheet` with the weave `weave`, as the shell's input.
pub(crate) fn fabric(sheet: &ElasticSheet, weave: Weave) -> Fabric {
    Fabric::isotropic(sheet.stretching_modulus(), sheet.bending_modulus(), sheet.poisson_ratio).woven(weave)
}
