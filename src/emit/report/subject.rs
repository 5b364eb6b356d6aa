//! The data of a report.

use crate::link::LinkCode;
use crate::manifest::Manifest;
use design::Design;
use forecast::charts::Charts;
use forecast::drawn::prediction::DrawnPrediction;
use forecast::prediction::Prediction;
use program::plan::Program;
use spec::{Machine, Spec};

/// The data of a report.
#[derive(Clone, Copy)]
pub struct Report<'a> {
    /// The spec as read.
    pub source: &'a str,
    /// The spec.
    pub spec: &'a Spec,
    /// The machine.
    pub machine: &'a Machine,
    /// The exact geometry.
    pub design: &'a Design,
    /// The sealing programs.
    pub programs: &'a [Program],
    /// The prediction for its stars; `None` for a spec without a load.
    pub prediction: Option<&'a Prediction>,
    /// The prediction for a drawn piece; `None` for a spec without a load.
    pub drawn: Option<&'a DrawnPrediction>,
    /// Predictions by pressure, object and number of points.
    pub charts: &'a [Charts],
    /// Precautions before sealing, the most pressing first: a code, and a sentence with commands in backticks.
    pub watch: &'a [(&'a str, &'a str)],
    /// The bill of materials; its files do not matter.
    pub bill: &'a Manifest,
    /// Everything in three dimensions, a GLB.
    pub scene: &'a [u8],
    /// The code of the link to the spec, if there shall be one.
    pub code: Option<&'a LinkCode>,
}
