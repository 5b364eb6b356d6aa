//! `predict`: converts the question, and calls the requested model.

use std::sync::Arc;

use pyo3::prelude::*;
use stargrip_cam::cli::embedded;
use stargrip_cam::cli::embedded::{Given, StarQuestion};
use stargrip_cam::design::{self, Refusals};
use stargrip_cam::forecast::drawn;
use stargrip_cam::forecast::predict as ask;
use stargrip_cam::forecast::predict::PredictFault;
use stargrip_cam::forecast::shell::Detail;
use stargrip_cam::forecast::shell::star::{self, ShellRefusal};
use stargrip_cam::shell::cases::{InflatedShape, Watch};
use stargrip_cam::spec::{ModelChoice, Spec as Read, key};
use stargrip_cam::units::Length;

use crate::answer::{Answer, Prediction};
use crate::arguments;
use crate::faults::{of_design, of_failure, of_prediction};
use crate::spec::Spec;
use crate::waiting::{Line, wait};

/// The reason why there is no prediction.
enum Refused {
    Design(Refusals),
    Fault(PredictFault),
    Cancelled,
}

impl From<ShellRefusal> for Refused {
    fn from(refusal: ShellRefusal) -> Self {
        match refusal {
            ShellRefusal::Cancelled => Self::Cancelled,
            ShellRefusal::Fault(fault) => Self::Fault(fault),
        }
    }
}

/// Predicts the behaviour of the gripper of `spec`.
///
/// model: "fit", "ring", "bvp", "section", "shell" or "auto"; default: the spec's own.
/// radii: also the force on round objects of these radii, "20 mm..40 mm/5".
/// fineness: of the shell's meshes: "coarse" (default for drawings), "medium" (default for stars) or "fine".
/// The answer about a drawing has its own keys, `chambers` among them: read it by to_dict().
/// progress: True shows a line with the progress; a callable gets the part that is done, 0 to 1, and a text.
///
/// Raises DesignError if there is no such gripper, PredictionError if the model has no answer, UsageError for wrong arguments.
#[pyfunction]
#[pyo3(signature = (spec, *, model = None, radii = None, fineness = None, progress = None))]
pub(crate) fn predict(
    py: Python<'_>,
    spec: &Spec,
    #[pyo3(from_py_with = arguments::model)] model: Option<String>,
    #[pyo3(from_py_with = arguments::radii)] radii: Option<String>,
    #[pyo3(from_py_with = arguments::fineness)] fineness: Option<String>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Prediction> {
    let given = Arc::clone(&spec.given);
    let asked = question(model.as_deref(), radii.as_deref(), fineness.as_deref())
        .map_err(|failure| of_failure(py, &failure))?;
    let model = asked.model.unwrap_or(given.reading.spec.accuracy.model);
    let answered = if given.reading.spec.drawing.is_some() {
        // A drawing is larger than a star.
        let asked =
            StarQuestion { detail: if fineness.is_none() { Detail::Coarse } else { asked.detail }, ..asked };
        let given = Arc::clone(&given);
        wait(py, progress, move |line| by_drawing(&given, &asked, line))?
    } else if model == ModelChoice::Shell {
        let given = Arc::clone(&given);
        wait(py, progress, move |line| by_shell(&given, &asked, line))?
    } else {
        py.detach(|| by_others(&given, &asked))
    };
    let (answer, shape) = answered.map_err(|refused| match refused {
        Refused::Design(refusals) => of_design(py, &given, refusals),
        Refused::Fault(fault) => of_prediction(py, &given, &fault),
        Refused::Cancelled => of_failure(py, &embedded::Failure::Interrupted),
    })?;
    Prediction::new(py, answer, shape)
}

/// Repeats the computation of `predict` `times` times, without Python: the reference of tests/overhead.py.
#[pyfunction]
pub(crate) fn repeat(py: Python<'_>, spec: &Spec, model: Option<&str>, times: u32) -> PyResult<()> {
    let asked = question(model, None, None).map_err(|failure| of_failure(py, &failure))?;
    for _ in 0..times {
        let _ = std::hint::black_box(by_others(&spec.given, &asked));
    }
    Ok(())
}

/// The question as options of the command; a model alone needs no parsing.
fn question(
    model: Option<&str>,
    radii: Option<&str>,
    fineness: Option<&str>,
) -> Result<StarQuestion, embedded::Failure> {
    let known = model.map(embedded::model);
    if radii.is_none() && fineness.is_none() && known != Some(None) {
        return Ok(StarQuestion { model: known.flatten(), radii: Vec::new(), detail: Detail::Medium });
    }
    let options = [("--model", model), ("--radii", radii), ("--fineness", fineness)];
    let options = options.iter().filter_map(|(name, value)| Some(format!("{name}={}", (*value)?)));
    embedded::star_question(&options.collect::<Vec<_>>())
}

/// The spec with the requested model, and its design.
fn designed(given: &Given, asked: &StarQuestion) -> Result<(Read, design::Design), Refused> {
    let mut spec = given.reading.spec.clone();
    if let Some(model) = asked.model {
        spec.accuracy.model = model;
    }
    let design = design::Design::new(&spec, &given.machine).map_err(Refused::Design)?;
    Ok((spec, design))
}

fn by_others(given: &Arc<Given>, asked: &StarQuestion) -> Result<(Answer, Option<InflatedShape>), Refused> {
    let (spec, design) = designed(given, asked)?;
    let mut prediction = ask::predict(&spec, &design).map_err(Refused::Fault)?;
    if !asked.radii.is_empty() {
        let radii: Vec<Length> = asked.radii.iter().copied().map(Length::from_metres).collect();
        ask::add_curve((&spec, &design), &radii, &mut prediction).map_err(Refused::Fault)?;
    }
    Ok((Answer::Star(Arc::clone(given), Box::new(prediction)), None))
}

fn by_drawing(
    given: &Arc<Given>,
    asked: &StarQuestion,
    line: &Line,
) -> Result<(Answer, Option<InflatedShape>), Refused> {
    let (spec, design) = designed(given, asked)?;
    let Some(piece) = design.drawn().filter(|_| asked.radii.is_empty()) else {
        let what = "no model predicts the force of a drawn shape on an object: leave out radii".to_owned();
        return Err(Refused::Fault(PredictFault { star: None, key: key::drawing::FILE, what, remedy: None }));
    };
    let tell = |part: f64, what: &str| line.tell(part, what);
    let watch = Watch { progress: Some(&tell), cancel: Arc::clone(&line.cancel) };
    let found = drawn::inflate(&spec, piece, asked.detail, &watch)?;
    let shape = InflatedShape::joined(&found.shapes);
    Ok((Answer::Drawn(Arc::clone(given), Box::new(found.prediction)), Some(shape)))
}

fn by_shell(
    given: &Arc<Given>,
    asked: &StarQuestion,
    line: &Line,
) -> Result<(Answer, Option<InflatedShape>), Refused> {
    let (spec, design) = designed(given, asked)?;
    let tell = |part: f64, what: &str| line.tell(part, what);
    let watch = Watch { progress: Some(&tell), cancel: Arc::clone(&line.cancel) };
    let (prediction, shape) = star::predict((&spec, &design), &asked.radii, asked.detail, &watch)?;
    Ok((Answer::Star(Arc::clone(given), Box::new(prediction)), Some(shape)))
}
