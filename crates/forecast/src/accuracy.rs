//! The cheapest model that predicts a gripper with a requested accuracy: models are tried from the cheapest on, until the error that one states
//! is small enough.
//!
//! The **stated error** of a prediction is relative, the largest of what is requested: of stars the final radius and the force on the object,
//! of drawn chambers extents, height and volume. It is the farther end of a range, or a shell's mesh error. Meshes of a star may agree on
//! a wrong number, so its shells state at least their typical distance from the finest ones (docs/trade.md).

use crate::drawn::prediction::{ChamberPrediction, DrawnPrediction};
use crate::meshed::MeshedValue;
use crate::prediction::{Prediction, StarPrediction};
use crate::ranges::Interval;
use crate::ranges::shown::rounded;
use crate::shell::{Detail, least_errors};
use serde::Serialize;
use spec::units::Percent;
use std::fmt;

/// One tried model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ModelTrial {
    /// The model.
    pub model: &'static str,
    /// Fineness of a shell's meshes.
    pub fineness: Option<&'static str>,
    /// Its stated error; `None` where it has no answer, or states none.
    pub error: Option<f64>,
}

/// The search for a model with a requested accuracy.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AccuracySearch {
    /// The largest accepted relative error.
    pub requested: f64,
    /// Whether the answer states no larger error. Otherwise it is that of the least stated error.
    pub met: bool,
    /// The tried models.
    pub trials: Vec<ModelTrial>,
}

impl AccuracySearch {
    /// A search for `accuracy` without trials.
    pub fn new(accuracy: Percent) -> Self {
        Self { requested: accuracy.ratio(), met: false, trials: Vec::new() }
    }

    /// Adds the trial of `model` with meshes of `detail`, which states `error`, and whether that is small enough.
    pub fn record(&mut self, model: &'static str, detail: Option<Detail>, error: Option<f64>) -> bool {
        let fineness = detail.map(Detail::word);
        self.trials.push(ModelTrial { model, fineness, error });
        self.met = error.is_some_and(|error| error <= self.requested);
        self.met
    }

    /// The warning that no model states so small an error; `None` if one does.
    pub fn warning(&self) -> Option<String> {
        let least = self.trials.iter().filter_map(|trial| trial.error).reduce(f64::min);
        let least = least.map_or_else(|| "unknown".to_owned(), |least| format!("{} %", percent(least)));
        (!self.met).then(|| {
            format!(
                "no model states an error of at most {} %: the least is {least}",
                rounded(100.0 * self.requested)
            )
        })
    }
}

impl fmt::Display for AccuracySearch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "for an error of at most {} %:", rounded(100.0 * self.requested))?;
        for (i, trial) in self.trials.iter().enumerate() {
            let error =
                trial.error.map_or_else(|| "unknown".to_owned(), |error| format!("{} %", percent(error)));
            let fineness = trial.fineness.map_or_else(String::new, |fineness| format!(" {fineness}"));
            write!(f, "{} {}{fineness} {error}", if i > 0 { "," } else { "" }, trial.model)?;
        }
        Ok(())
    }
}

/// A relative error in percent, rounded up to a tenth.
fn percent(error: f64) -> String {
    rounded((1e3 * error - 1e-9).ceil() / 10.0)
}

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
    let of_force = |error: Option<f64>| force.map_or(Some(0.0), |_| error);
    let errors = if let Some((mesh, detail)) = star.evidence.mesh_errors.as_ref().zip(detail) {
        let least = least_errors(detail);
        let of_radius = (mesh.final_radius_mm / radius).max(least.radius);
        let error = force.zip(mesh.object_force_N).map(|(force, error)| (error / force).max(least.force));
        [Some(of_radius), of_force(error)]
    } else {
        let error = force.zip(ranges.object_force_N).map(|(force, range)| of_range(force, range));
        [ranges.final_radius_mm.map(|range| of_range(radius, range)), of_force(error)]
    };
    largest(errors.into_iter())
}

fn of_chamber(chamber: &ChamberPrediction) -> Option<f64> {
    let (extents, volume) = (chamber.extents_mm?, chamber.volume_mm3?);
    let height =
        chamber.height_mm.map(|height| MeshedValue { value: height.value, mesh_error: height.mesh_error })?;
    let values = [extents[0], extents[1], height, volume];
    let error = |k: usize| match chamber.ranges {
        Some(ranges) => {
            let ranges = [ranges.extents_mm[0], ranges.extents_mm[1], ranges.height_mm, ranges.volume_mm3];
            of_range(values[k].value, ranges[k])
        }
        None => values[k].mesh_error / values[k].value,
    };
    largest((0..values.len()).map(|k| Some(error(k))))
}

/// Distance of `value` from the farther end of its range, by itself.
fn of_range(value: f64, [low, high]: Interval) -> f64 {
    (high - value).max(value - low) / value
}

/// The largest of `errors`; `None` if one is unknown or not a number.
fn largest(mut errors: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    errors.try_fold(0.0_f64, |most, error| error.filter(|error| !error.is_nan()).map(|error| most.max(error)))
}
