//! A single hinge between two arms.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stargrip_cam::cli::embedded::{ActuatorQuestion, actuator_keywords, actuator_question};
use stargrip_cam::forecast::actuator::actuate;
use stargrip_cam::forecast::shell::actuator as by_shell;
use stargrip_cam::forecast::shell::sheet::ModelledSheet;
use stargrip_cam::shell::cases::ShellFault;

use crate::answer::ActuatorPrediction;
use crate::faults::{of_failure, plain};
use crate::mesh::Mesh;
use crate::options::options;
use crate::waiting::wait;

/// Predicts what a V-actuator does: two arms, one hinge, sealed ends. The keywords are the options of the command `actuator`;
/// quantities are strings with a unit. The first five are required.
///
/// tube_width: flat width of the tube.
/// radius: inner radius of the flat hinge.
/// arm_length: straight length from the hinge's end to the sealed end.
/// angle: flat angle between the arms.
/// pressure: gauge pressure.
/// thickness, young_modulus, poisson_ratio: of the fabric; default: those of a spec.
/// model: "fit", "ring", "bvp", "section", "shell" or "auto", which is section.
/// angles: also the moment that holds the hinge at each of these angles, "30 deg..90 deg/7".
/// fineness: of the shell's meshes: "coarse", "medium" (default) or "fine".
/// progress: True shows a line with the progress; a callable gets the part that is done, 0 to 1, and a text.
///
/// Raises PredictionError if the model has no answer, UsageError for wrong arguments.
#[pyfunction]
#[pyo3(
    signature = (*, progress = None, **question),
    text_signature = "(*, tube_width, radius, arm_length, angle, pressure, thickness=None, young_modulus=None, poisson_ratio=None, \
                      model=None, angles=None, fineness=None, progress=None)"
)]
pub(crate) fn actuator(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    question: Option<&Bound<'_, PyDict>>,
) -> PyResult<ActuatorPrediction> {
    let checked_question = actuator_question(&options("actuator", &actuator_keywords(), question)?)
        .map_err(|failure| of_failure(py, &failure))?;
    let ActuatorQuestion { actuator, angles, level, detail } = checked_question;
    if let Some(level) = level {
        let answer = py.detach(|| actuate(&actuator, level, &angles));
        return ActuatorPrediction::new(py, answer.map_err(|fault| refused(py, &fault))?, None);
    }
    let computed_answer = wait(py, progress, move |line| {
        line.watched(true, |watch| by_shell::actuate(&actuator, &angles, detail, watch))
    })?;
    let (answer, shape) = computed_answer.map_err(|fault: ShellFault| refused(py, &fault))?;
    ActuatorPrediction::new(py, answer, Some(Mesh { sheet: ModelledSheet::of_actuator(shape) }))
}

/// The exception for a prediction that cannot be made because of `fault`.
fn refused(py: Python<'_>, fault: &impl ToString) -> PyErr {
    plain(py, "PredictionError", "no-prediction", &fault.to_string())
}
