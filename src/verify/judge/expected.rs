//! What the files of a build are compared with.

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
    /// What was asked for.
    pub spec: &'a Spec,
    /// What it is made on.
    pub machine: &'a Machine,
    /// What it will do; `None` for a spec without a load.
    pub prediction: Option<&'a Prediction>,
    /// What a drawn piece will do; `None` for a spec without a load.
    pub drawn: Option<&'a DrawnPrediction>,
    /// The figures that the manifest should give; its list of files does not matter.
    pub manifest: &'a Manifest,
}
