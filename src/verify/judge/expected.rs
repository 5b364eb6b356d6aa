//! The expected content of a build's files.

use crate::design::Design;
use crate::forecast::drawn::prediction::DrawnPrediction;
use crate::forecast::prediction::Prediction;
use crate::manifest::Manifest;
use crate::spec::{Machine, Spec};

/// Everything that the files of a build must agree with. None of it was read from them but the spec and the profile.
#[derive(Clone, Copy, Debug)]
pub struct Expected<'a> {
    /// The exact geometry.
    pub design: &'a Design,
    /// The spec.
    pub spec: &'a Spec,
    /// The machine.
    pub machine: &'a Machine,
    /// The prediction; `None` for a spec without a load.
    pub prediction: Option<&'a Prediction>,
    /// The prediction for a drawn piece; `None` for a spec without a load.
    pub drawn: Option<&'a DrawnPrediction>,
    /// The figures that the manifest should give; its list of files does not matter.
    pub manifest: &'a Manifest,
}
