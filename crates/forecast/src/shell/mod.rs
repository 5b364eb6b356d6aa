//! Predictions by the shell, with the keys of other predictions. It takes seconds, so it must be selected by
//! name.
//!
//! [`request`] converts a star to the shell's inputs and its results to numbers with mesh errors, [`star`]
//! computes a spec's stars, [`actuator`] a single hinge between two arms; [`result`] formats the prediction of
//! stars; [`sheet`] has what makes a whole body of a modelled sheet; `work` bounds the time that a computation takes.

pub mod actuator;
pub mod request;
pub mod result;
pub mod sheet;
pub mod star;
pub(crate) mod work;

use crate::case::Case;
use inflatable::mechanics::strength::ElasticSheet;
use inflatable::shell::cases::{Fineness, FlatStar, Margin, Tube};
use inflatable::shell::element::{Fabric, Weave};

pub use spec::Detail;

/// The name of the model.
pub const SHELL: &str = "shell";

/// The least relative errors that shells of a fineness state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeastErrors {
    /// Of the final radius.
    pub radius: f64,
    /// Of the force on an object.
    pub force: f64,
}

/// The least errors that shells of stars with meshes of `detail` state: the largest root mean square against the finest shells of the paper's
/// stars, of three pressures (docs/trade.md). Those of `fine` are the finest.
pub fn least_errors(detail: Detail) -> LeastErrors {
    match detail {
        Detail::Coarse => LeastErrors { radius: 0.05, force: 0.5 },
        Detail::Medium => LeastErrors { radius: 0.025, force: 0.17 },
        Detail::Fine => LeastErrors { radius: 0.0, force: 0.0 },
    }
}

/// The meshes that `detail` means.
pub fn fineness(detail: Detail) -> Fineness {
    match detail {
        Detail::Coarse => Fineness { cells: 3.0, cuts: 2 },
        Detail::Medium => Fineness::default(),
        Detail::Fine => Fineness { cells: 12.0, cuts: 3 },
    }
}

/// Points with which shells of stars are computed.
const MOST_POINTS: u32 = 16;

/// The star of `case`, of fabric with the weave `weave`, at `pressure`, Pa, as the shell's input.
fn flat_star(case: &Case, weave: Weave, pressure: f64) -> FlatStar {
    FlatStar {
        tube: Tube { width: case.mechanism.width, fabric: fabric(&case.sheet, weave), pressure },
        points: case.mechanism.points,
        inner_radius: case.inner_radius,
        tip_angle: case.mechanism.tip_angle,
        tip_radius: case.mechanism.tip_radius,
        corner_radius: case.mechanism.corner_radius,
        band: case.band,
        margin: Margin::NONE,
    }
}

/// The model that computes the star of `case`, of fabric with the weave `weave`, as a shell, and the time that it takes; `None` where
/// shells do not cover the star.
pub(crate) fn by_shell(case: &Case, weave: Weave) -> Option<String> {
    let star = flat_star(case, weave, case.pressure?);
    if star.points > MOST_POINTS || !star.is_symmetric() || star.check().is_err() {
        return None;
    }
    let text = "the model \"shell\" covers this star, and takes 1 to 10 s on coarse meshes";
    Some(text.to_owned())
}

/// The fabric of `sheet` with the weave `weave`, as the shell's input.
pub(crate) fn fabric(sheet: &ElasticSheet, weave: Weave) -> Fabric {
    Fabric::isotropic(sheet.stretching_modulus(), sheet.bending_modulus(), sheet.poisson_ratio).woven(weave)
}
