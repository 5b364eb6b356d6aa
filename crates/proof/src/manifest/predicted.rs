//! The prediction of a gripper in short: the values of `predict --json` that belong to a bill of its files.

use serde::{Deserialize, Serialize};

/// The gripper at the pressure of `[load]`. The values equal those in `prediction.json`, without rounding; null if unknown.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct ManifestPrediction {
    /// Whether it holds the object; null if uncertain, or without an object.
    pub holds: Option<bool>,
    /// Mass that friction holds, for the whole stack.
    pub payload_kg: Option<f64>,
    /// Range of `payload_kg`.
    pub payload_range_kg: Option<[f64; 2]>,
    /// All stars, bottom first.
    pub stars: Vec<ManifestStarPrediction>,
}

/// One star.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct ManifestStarPrediction {
    /// The model that answered.
    pub model: String,
    /// Final inner radius.
    pub final_radius_mm: Option<f64>,
    /// Range of `final_radius_mm`.
    pub final_radius_range_mm: Option<[f64; 2]>,
    /// Range of radii that it can hold; the second is its largest opening.
    pub graspable_radius_mm: Option<[f64; 2]>,
    /// Radial stiffness at rest.
    pub radial_stiffness_N_per_m: Option<f64>,
    /// Range of `radial_stiffness_N_per_m`.
    pub radial_stiffness_range_N_per_m: Option<[f64; 2]>,
    /// Radial force on the object.
    pub object_force_N: Option<f64>,
    /// Range of `object_force_N`.
    pub object_force_range_N: Option<[f64; 2]>,
    /// Bendability 1/eps.
    pub bendability: Option<f64>,
    /// Stretch p W / Y of the fabric.
    pub stretch: Option<f64>,
    /// Burst pressure over the pressure.
    pub burst_margin: Option<f64>,
}
