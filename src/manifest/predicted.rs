//! The prediction of a gripper in short: the values of `predict --json` that belong to a bill of its files.

use serde::{Deserialize, Serialize};

use crate::forecast::prediction::{FabricStretch, Prediction, StarPrediction};
use crate::forecast::ranges::Interval;

/// The gripper at the pressure of `[load]`. The values equal those in `prediction.json`, without rounding; null if unknown.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(non_snake_case, reason = "keys contain units in their usual spelling")]
pub struct ManifestPrediction {
    /// Whether it holds the object; null if uncertain, or without an object.
    pub holds: Option<bool>,
    /// Mass that friction holds, for the whole stack.
    pub payload_kg: Option<f64>,
    /// Its range.
    pub payload_range_kg: Option<Interval>,
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
    /// Its range.
    pub final_radius_range_mm: Option<Interval>,
    /// Range of radii that it can hold; the second is its largest opening.
    pub graspable_radius_mm: Option<Interval>,
    /// Radial stiffness at rest.
    pub radial_stiffness_N_per_m: Option<f64>,
    /// Its range.
    pub radial_stiffness_range_N_per_m: Option<Interval>,
    /// Radial force on the object.
    pub object_force_N: Option<f64>,
    /// Its range.
    pub object_force_range_N: Option<Interval>,
    /// Bendability 1/eps.
    pub bendability: Option<f64>,
    /// Stretch p W / Y of the fabric.
    pub stretch: Option<f64>,
    /// Burst pressure over the pressure.
    pub burst_margin: Option<f64>,
}

impl ManifestPrediction {
    /// The summary of `prediction`.
    pub fn of(prediction: &Prediction) -> Self {
        Self {
            holds: prediction.verdict.as_ref().and_then(|verdict| verdict.holds.known()),
            payload_kg: prediction.first.payload_kg,
            payload_range_kg: prediction.first.ranges.payload_kg,
            stars: prediction.stars.iter().map(ManifestStarPrediction::of).collect(),
        }
    }
}

impl ManifestStarPrediction {
    fn of(star: &StarPrediction) -> Self {
        let ranges = &star.ranges;
        Self {
            model: star.model.to_owned(),
            final_radius_mm: star.final_radius_mm,
            final_radius_range_mm: ranges.final_radius_mm,
            graspable_radius_mm: star.graspable_radius_mm,
            radial_stiffness_N_per_m: star.radial_stiffness_N_per_m,
            radial_stiffness_range_N_per_m: ranges.radial_stiffness_N_per_m,
            object_force_N: star.object_force_N,
            object_force_range_N: ranges.object_force_N,
            bendability: star.bendability,
            stretch: star.stretch.and_then(FabricStretch::ratio),
            burst_margin: star.burst_margin,
        }
    }
}
