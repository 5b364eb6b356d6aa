//! `predict`: converts the question, and calls the requested model.

use std::sync::Arc;

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stargrip_cam::cli::embedded;
use stargrip_cam::cli::embedded::{GripperAnswer, Loaded, StarQuestion};
use stargrip_cam::design::Refusals;
use stargrip_cam::forecast::predict::PredictFault;
use stargrip_cam::forecast::shell::sheet::ModelledSheet;
use stargrip_cam::forecast::shell::star::ShellRefusal;
use stargrip_cam::shell::cases::Watch;
use stargrip_cam::spec::{ModelChoice, ProductKind, key};

use crate::answer::of_gripper;
use crate::arguments;
use crate::faults::{of_design, of_failure, of_prediction};
use crate::mesh::Mesh;
use crate::options::refuse_unknown;
use crate::spec::Spec;
use crate::waiting::wait;

/// The reason why there is no prediction.
enum Refused {
    Design(Refusals),
    Model(ShellRefusal),
}

/// Predicts the behaviour of the gripper of `spec`: a Prediction of stars, or a DrawnPrediction with chambers.
///
/// model: "fit", "ring", "bvp", "section", "shell" or "auto"; default: the spec's own.
/// radii: also the force on round objects of these radii, "20 mm..40 mm/5".
/// fineness: of the shell's meshes: "coarse" (default for drawings), "medium" (default for stars) or "fine".
/// accuracy: the cheapest model with an error of at most this, "2 %"; without model and fineness.
/// progress: True shows a line with the progress; a callable gets the part that is done, 0 to 1, and a text.
///
/// Raises DesignError if there is no such gripper, PredictionError if the model has no answer, UsageError for wrong arguments.
#[pyfunction]
#[pyo3(
    signature = (spec, *, model = None, radii = None, fineness = None, accuracy = None, progress = None, **unknown),
    text_signature = "(spec, *, model=None, radii=None, fineness=None, accuracy=None, progress=None)"
)]
#[expect(clippy::too_many_arguments, reason = "keywords, of which a call names few")]
pub(crate) fn predict(
    py: Python<'_>,
    spec: &Spec,
    #[pyo3(from_py_with = arguments::model)] model: Option<String>,
    #[pyo3(from_py_with = arguments::radii)] radii: Option<String>,
    #[pyo3(from_py_with = arguments::fineness)] fineness: Option<String>,
    #[pyo3(from_py_with = arguments::accuracy)] accuracy: Option<String>,
    progress: Option<&Bound<'_, PyAny>>,
    unknown: Option<&Bound<'_, PyDict>>,
) -> PyResult<Py<PyAny>> {
    // A shell takes seconds: it is computed in a thread of its own, which reports its progress and can be interrupted. Models of hinges take
    // less than a millisecond.
    refuse_unknown("predict", &["model", "radii", "fineness", "accuracy", "progress"], unknown)?;
    let loaded = Arc::clone(&spec.given);
    let star_question =
        question(model.as_deref(), radii.as_deref(), fineness.as_deref(), accuracy.as_deref())
            .map_err(|failure| of_failure(py, &failure))?;
    let loaded_spec = &loaded.reading.spec;
    let has_shell_only = match loaded_spec.product() {
        ProductKind::Stars => false,
        ProductKind::Drawing => true,
    };
    let answered = if has_shell_only
        || star_question.accuracy.is_some()
        || star_question.model.unwrap_or(loaded_spec.accuracy.model) == ModelChoice::Shell
    {
        let loaded = Arc::clone(&loaded);
        wait(py, progress, move |line| {
            line.watched(star_question.detail.is_some(), |watch| answer(&loaded, &star_question, watch))
        })?
    } else {
        py.detach(|| answer(&loaded, &star_question, &Watch::default()))
    };
    let (answer, mesh) = answered.map_err(|refused| match refused {
        Refused::Design(refusals) => of_design(py, &loaded, refusals),
        Refused::Model(ShellRefusal::Fault(fault)) => of_prediction(py, &loaded, &fault),
        Refused::Model(ShellRefusal::Cancelled) => of_failure(py, &embedded::Failure::Interrupted),
    })?;
    of_gripper(py, loaded, answer, mesh)
}

/// Repeats the computation of `predict` `times` times, without Python: the reference of tests/overhead.py.
#[pyfunction]
pub(crate) fn repeat(py: Python<'_>, spec: &Spec, model: Option<&str>, times: u32) -> PyResult<()> {
    let star_question = question(model, None, None, None).map_err(|failure| of_failure(py, &failure))?;
    for _ in 0..times {
        let _ = std::hint::black_box(answer(&spec.given, &star_question, &Watch::default()));
    }
    Ok(())
}

/// The question as options of the command; a model alone needs no parsing.
fn question(
    model: Option<&str>,
    radii: Option<&str>,
    fineness: Option<&str>,
    accuracy: Option<&str>,
) -> Result<StarQuestion, embedded::Failure> {
    let model_choice = model.map(embedded::model);
    if radii.is_none() && fineness.is_none() && accuracy.is_none() && model_choice != Some(None) {
        return Ok(StarQuestion {
            model: model_choice.flatten(),
            radii: Vec::new(),
            detail: None,
            accuracy: None,
        });
    }
    let options =
        [("--model", model), ("--radii", radii), ("--fineness", fineness), ("--accuracy", accuracy)];
    let options = options.iter().filter_map(|(name, value)| Some(format!("{name}={}", (*value)?)));
    embedded::star_question(&options.collect::<Vec<_>>())
}

fn answer(
    loaded: &Loaded,
    star_question: &StarQuestion,
    watch: &Watch<'_>,
) -> Result<(GripperAnswer, Option<Mesh>), Refused> {
    let (spec, design, _) = star_question.designed(loaded).map_err(Refused::Design)?;
    if design.drawn_pieces().is_some() && !star_question.radii.is_empty() {
        let problem = "no model predicts the force of a drawn shape on an object: leave out radii".to_owned();
        let fault = PredictFault::new(key::drawing::FILE, problem);
        return Err(Refused::Model(ShellRefusal::Fault(fault)));
    }
    let (answer, shape) = star_question.answer((&spec, &design), watch).map_err(Refused::Model)?;
    Ok((answer, shape.map(|shape| Mesh { sheet: ModelledSheet::of_design(&design, shape) })))
}
