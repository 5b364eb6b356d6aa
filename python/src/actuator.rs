//! A single hinge between two arms.

use std::sync::Arc;

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stargrip_cam::cli::embedded::{ActuatorQuestion, actuator_question};
use stargrip_cam::forecast::actuator::actuate;
use stargrip_cam::forecast::by_shell;
use stargrip_cam::shell::cases::{ShellFault, Watch};

use crate::faults::{of_failure, plain};
use crate::options::options;
use crate::prediction::ActuatorPrediction;
use crate::waiting::wait;

/// What a V-actuator does: two arms, one hinge, sealed ends. The keywords are the options of the command `actuator`, quantities as
/// strings: tube_width, radius, arm_length, angle and pressure are needed; thickness, young_modulus, poisson_ratio, model, angles
/// ("30 deg..90 deg/7") and fineness are not.
#[pyfunction]
#[pyo3(signature = (*, progress = None, **question))]
pub(crate) fn actuator(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    question: Option<&Bound<'_, PyDict>>,
) -> PyResult<ActuatorPrediction> {
    let asked = actuator_question(&options(question)?).map_err(|failure| of_failure(py, &failure))?;
    let ActuatorQuestion { actuator, angles, level, detail } = asked;
    let refused = |text: String| plain(py, "PredictionError", "no-prediction", &text);
    if let Some(level) = level {
        let answer = py.detach(|| actuate(&actuator, level, &angles));
        return ActuatorPrediction::new(py, answer.map_err(|fault| refused(fault.to_string()))?, None);
    }
    let found = wait(py, progress, move |line| {
        let tell = |part: f64, what: &str| line.tell(part, what);
        let watch = Watch { progress: Some(&tell), cancel: Arc::clone(&line.cancel) };
        by_shell::actuate(&actuator, &angles, detail, &watch)
    })?;
    let (answer, shape) = found.map_err(|fault: ShellFault| refused(fault.to_string()))?;
    ActuatorPrediction::new(py, answer, Some(shape))
}
