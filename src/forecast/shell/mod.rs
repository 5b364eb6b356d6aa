//! What the shell answers, with the keys of other predictions. It runs for seconds, so it is asked by name
//! only.
//!
//! [`request`] turns a star into the shell's question and its answer into numbers with mesh errors, [`star`]
//! asks for a spec's stars, [`actuator`] for a single hinge between two arms; [`result`] is the answer about
//! stars.

pub mod actuator;
pub mod request;
pub mod result;
pub mod star;

use inflatable::mechanics::strength::ElasticSheet;
use inflatable::shell::cases::Fineness;
use inflatable::shell::element::Fabric;

pub use crate::spec::Detail;

/// The name of the model.
pub const SHELL: &str = "shell";

impl Detail {
    /// The meshes it means.
    pub fn fineness(self) -> Fineness {
        match self {
            Self::Coarse => Fineness { cells: 3.0, cuts: 2 },
            Self::Medium => Fineness::default(),
            Self::Fine => Fineness { cells: 12.0, cuts: 3 },
        }
    }
}

/// The fabric of `sheet` as the shell takes it.
pub(in crate::forecast) fn fabric(sheet: &ElasticSheet) -> Fabric {
    Fabric {
        stretch: sheet.stretching_modulus(),
        bending: sheet.bending_modulus(),
        poisson: sheet.poisson_ratio,
    }
}
