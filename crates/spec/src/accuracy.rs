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

/// A level of fidelity of the mechanics.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModelChoice {
    /// Published constants.
    Fit,
    /// Exact membrane limit.
    Ring,
    /// Penalised boundary-value problem.
    Bvp,
    /// Bending, stretch and hoop compression at the pressure.
    Section,
    /// The whole sheet in triangles, with arms and contact.
    Shell,
    /// The cheapest that is accurate enough.
    Auto,
}

impl ModelChoice {
    /// All of them, with the words that specs and studies write.
    pub const ALL: [(&str, Self); 6] = [
        ("fit", Self::Fit),
        ("ring", Self::Ring),
        ("bvp", Self::Bvp),
        ("section", Self::Section),
        ("shell", Self::Shell),
        ("auto", Self::Auto),
    ];
}

/// Fineness of a shell's meshes, as a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// For a first look: some 10,000 unknowns on the finest mesh of a V-actuator with arms of 4 W.
    Coarse,
    /// For most ends: 67,000.
    Medium,
    /// For results in which mesh errors matter: 150,000.
    Fine,
}

impl Detail {
    /// All of them, with the words that studies write.
    pub const ALL: [(&str, Self); 3] =
        [("coarse", Self::Coarse), ("medium", Self::Medium), ("fine", Self::Fine)];

    /// The word for it.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Coarse => "coarse",
            Self::Medium => "medium",
            Self::Fine => "fine",
        }
    }
}
