//! The prediction of a gripper in short.

use forecast::prediction::{FabricStretch, Prediction, StarPrediction};
use proof::manifest::{ManifestPrediction, ManifestStarPrediction};

/// The summary of `prediction`.
pub(super) fn summary(prediction: &Prediction) -> ManifestPrediction {
    ManifestPrediction {
        holds: prediction.verdict.as_ref().and_then(|verdict| verdict.holds.as_bool()),
        payload_kg: prediction.first.payload_kg,
        payload_range_kg: prediction.first.ranges.payload_kg,
        stars: prediction.stars.iter().map(star_summary).collect(),
    }
}

/// The summary of `star`.
fn star_summary(star: &StarPrediction) -> ManifestStarPrediction {
    let ranges = &star.ranges;
    ManifestStarPrediction {
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
