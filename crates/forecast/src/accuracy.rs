//! The cheapest model that predicts a gripper with a requested accuracy: models are tried from the cheapest on, until the error that one states
//! is small enough.
//!
//! The **stated error** of a prediction is relative, the largest of what is requested: of stars the final radius and the force on the object,
//! of drawn chambers extents, height and volume. It is the farther end of a range, or a shell's mesh error. Meshes of a star may agree on
//! a wrong number, so its shells state at least their typical distance from the finest ones (docs/trade.md).

use crate::drawn::chamber_prediction::ChamberPrediction;
use crate::drawn::prediction::DrawnPrediction;
use crate::interval::relative_error;
use crate::meshed::MeshedPlace;
use crate::prediction::{Prediction, StarPrediction};
use crate::shell::{Detail, least_errors};

/// The stated error of `prediction`, by shells with meshes of `detail`; `None` where one of the requested numbers has none.
pub fn of_stars(prediction: &Prediction, detail: Option<Detail>) -> Option<f64> {
    largest(prediction.stars.iter().map(|star| of_star(star, detail)))
}

/// The stated error of `prediction`; `None` without the shell.
pub fn of_drawing(prediction: &DrawnPrediction) -> Option<f64> {
    largest(prediction.chambers.iter().map(of_chamber))
}

fn of_star(star: &StarPrediction, detail: Option<Detail>) -> Option<f64> {
    let (radius, ranges) = (star.final_radius_mm?, &star.ranges);
    let force = star.object_force_N.filter(|force| *force > 0.0);
    let [radius_error, force_error] = if let Some((mesh, detail)) =
        star.evidence.mesh_errors.as_ref().zip(detail)
    {
        let smallest_errors = least_errors(detail);
        let of_radius = (mesh.final_radius_mm / radius).max(smallest_errors.radius);
        let error =
            force.zip(mesh.object_force_N).map(|(force, error)| (error / force).max(smallest_errors.force));
        [Some(of_radius), error]
    } else {
        let error = force.zip(ranges.object_force_N).map(|(force, range)| relative_error(force, range));
        [ranges.final_radius_mm.map(|range| relative_error(radius, range)), error]
    };
    // A force that is 0 or not predicted has no error.
    largest([radius_error, force.map_or(Some(0.0), |_| force_error)].into_iter())
}

fn of_chamber(chamber: &ChamberPrediction) -> Option<f64> {
    let (extents, volume) = (chamber.extents_mm?, chamber.volume_mm3?);
    let height = chamber.height_mm.map(MeshedPlace::number)?;
    let values = [extents[0], extents[1], height, volume];
    let errors = match chamber.ranges {
        Some(ranges) => {
            let ranges = [ranges.extents_mm[0], ranges.extents_mm[1], ranges.height_mm, ranges.volume_mm3];
            std::array::from_fn(|k| relative_error(values[k].value, ranges[k]))
        }
        None => values.map(|value| value.mesh_error / value.value),
    };
    largest(errors.into_iter().map(Some))
}

/// The largest of `errors`; `None` if one is unknown or not a number.
fn largest(mut errors: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    errors.try_fold(0.0_f64, |most, error| error.filter(|error| !error.is_nan()).map(|error| most.max(error)))
}
