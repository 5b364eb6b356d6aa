//! The subject of a preview.

use crate::link::LinkCode;
use design::Design;
use forecast::pose::PosedStar;
use program::plan::Program;
use spec::{Machine, Spec};

/// The data of a preview.
#[derive(Clone, Copy)]
pub struct Preview<'a> {
    /// The spec.
    pub spec: &'a Spec,
    /// The machine.
    pub machine: &'a Machine,
    /// The exact geometry.
    pub design: &'a Design,
    /// The sealing programs.
    pub programs: &'a [Program],
    /// Every star as it is predicted to close, bottom first; none without a prediction.
    pub shut: &'a [PosedStar],
    /// The code of the link to the spec, if there shall be one.
    pub code: Option<&'a LinkCode>,
}
