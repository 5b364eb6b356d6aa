//! The evidence for a prediction: the model, its numerical errors, and what was found about the seal and the object.

use crate::case::Hinges;
use crate::interval::Interval;
use crate::model_search::AccuracySearch;
use crate::seal_load::Bursting;
use crate::warning::PredictionWarning;
use serde::Serialize;

/// The evidence for an answer.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct ModelEvidence {
    /// Reason for the choice of this model.
    pub choice: String,
    /// The search for a model with the accuracy that was requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<AccuracySearch>,
    /// The measured properties of the fabric, if there are any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fabric: Option<&'static str>,
    /// The model's use of `shear_modulus`, if it is given; without it every model assumes isotropic fabric.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub weave: Option<&'static str>,
    /// Largest residual of the model's equations.
    pub residual: f64,
    /// Newton steps.
    pub iterations: u32,
    /// Estimated relative error of V_bar against the exact solution of the model's own equations; the shell
    /// has mesh errors.
    pub numerical_error: Option<f64>,
    /// Unknowns of each mesh of the shell, coarse to fine.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unknowns: Option<Vec<usize>>,
    /// Stretch p W / Y of the fabric.
    pub stretch: Option<f64>,
    /// Inflated width of the hinges over W; the arms' is 2/pi.
    pub hinge_width: Hinges<Option<f64>>,
    /// Mesh error of each of the shell's numbers, in its unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh_errors: Option<MeshErrors>,
    /// Least inner radius at which the seal surely holds, mm; `None` if it does already, no radius is known to be enough, or it is unknown.
    pub safe_radius_mm: Option<f64>,
    /// The largest pressure, kPa, at which seals that burst surely hold, and the gripper meets its load; `None` if there is none.
    #[serde(skip)]
    pub safe_pressure_kPa: Option<f64>,
    /// Limits of a model's validity that are exceeded, and other warnings for the user.
    pub warnings: Vec<PredictionWarning>,
    /// Whether the seal bursts; `None` if its strength or the pressure is unknown.
    #[serde(skip)]
    pub bursting: Option<Bursting>,
    /// The least and the largest radius, mm, of an object on which the star surely presses. `None` where there is none, or if it surely
    /// presses on its own object.
    #[serde(skip)]
    pub surely_held_mm: Option<Interval>,
}

/// Mesh errors: the difference of the last two meshes, or the extrapolation's change if it is larger.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct MeshErrors {
    /// Error of the final radius.
    pub final_radius_mm: f64,
    /// Error of the contraction.
    pub contraction: f64,
    /// Error of the tips' angle.
    pub tip_angle_deg: f64,
    /// Error of the radial stiffness.
    pub radial_stiffness_N_per_m: f64,
    /// Error of the force between arms.
    pub arm_contact_N: f64,
    /// Error of the area of contact.
    pub arm_contact_mm2: f64,
    /// Error of the volume.
    pub volume_mm3: f64,
    /// Error of the pull on the seal.
    pub seal_pull_N_per_mm: f64,
    /// Error of the force on the object.
    pub object_force_N: Option<f64>,
    /// Error of each force of the curve, N.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_curve: Option<Vec<f64>>,
}
