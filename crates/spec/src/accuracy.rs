//! Required precision of outputs and predictions, and the model that predicts.

use crate::units::{Length, Percent};

/// Required precision of outputs and predictions.
#[derive(Clone, Debug, PartialEq)]
pub struct Accuracy {
    /// Largest deviation of an output from the exact geometry.
    pub path: Length,
    /// The model that predicts.
    pub model: ModelChoice,
    /// The error of the prediction that `auto` may accept.
    pub response: Percent,
}

crate::choices! {
    /// A level of fidelity of the mechanics.
    ModelChoice,
    /// The word of the level in specs and studies.
    word;
    /// Published constants.
    Fit: "fit",
    /// Exact membrane limit.
    Ring: "ring",
    /// Penalised boundary-value problem.
    Bvp: "bvp",
    /// Bending, stretch and hoop compression at the pressure.
    Section: "section",
    /// The whole sheet in triangles, with arms and contact.
    Shell: "shell",
    /// The cheapest that is accurate enough.
    Auto: "auto",
}

crate::choices! {
    /// Fineness of a shell's meshes, as a word.
    Detail,
    /// The word of the fineness in studies.
    word;
    /// For a first look: some 10,000 unknowns on the finest mesh of a V-actuator with arms of 4 W.
    Coarse: "coarse",
    /// For most ends: 67,000.
    Medium: "medium",
    /// For results in which mesh errors matter: 150,000.
    Fine: "fine",
}
