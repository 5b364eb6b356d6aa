//! `predict`: the prediction of a gripper, by any model, the shell included.

use serde_json::{Value, json};
use stargrip_cam::design::{Design, Refusals};
use stargrip_cam::forecast::drawn::Watch;
use stargrip_cam::forecast::predict::predict as predicted;
use stargrip_cam::forecast::shell::star::ShellRefusal;
use stargrip_cam::forecast::shell::{Detail, star};
use stargrip_cam::forecast::{drawn, report};
use stargrip_cam::pipeline::no_prediction;
use stargrip_cam::spec::{ModelChoice, Spec};

use crate::commands::faults::{listed, of_design};
use crate::commands::spec::Given;
use crate::question::{Tell, text, wrong};

/// Meshes of shells in a page: seconds of work.
const DETAIL: Detail = Detail::Coarse;

/// Predicts with the spec's model, or the one that `model` names. A drawing is predicted by the shell.
///
/// # Errors
/// The answer with the faults.
pub(super) fn predict(question: &Value, files: &[(String, Vec<u8>)], tell: Tell) -> Result<Value, Value> {
    let loaded = Given::read(question, files)?;
    let mut spec = loaded.reading.spec.clone();
    if let Some(model) = text(question, "model").and_then(model) {
        spec.accuracy.model = model;
    }
    let refused =
        |refusals: Refusals| json!({ "faults": of_design(&loaded.source, &loaded.reading, refusals) });
    let design = Design::new(&spec, &loaded.machine).map_err(refused)?;
    let (text, prediction) = answer(&spec, &design, tell).map_err(|refusal| match refusal {
        ShellRefusal::Fault(fault) => refused(no_prediction(&fault).into()),
        // The page stops a shell by ending its worker.
        ShellRefusal::Cancelled => wrong("the shell was stopped"),
    })?;
    Ok(json!({ "faults": listed(&loaded.reading.warnings), "text": text, "prediction": prediction }))
}

/// The prediction as text and as JSON.
fn answer(spec: &Spec, design: &Design, tell: Tell) -> Result<(String, Value), ShellRefusal> {
    let watch = Watch { progress: Some(&tell), ..Watch::default() };
    if let Some(pieces) = design.drawn_pieces() {
        let prediction = drawn::inflate(spec, pieces, DETAIL, &watch)?.prediction;
        return Ok((drawn::text::text(spec, &prediction, false), json!(prediction)));
    }
    let prediction = if spec.accuracy.model == ModelChoice::Shell {
        star::predict(spec, design, &[], DETAIL, &watch)?.0
    } else {
        predicted(spec, design).map_err(ShellRefusal::Fault)?
    };
    Ok((report::text(spec, &prediction, false), json!(prediction)))
}

/// The model of this name, as in a spec.
pub(super) fn model(name: &str) -> Option<ModelChoice> {
    ModelChoice::ALL.iter().find(|(word, _)| *word == name).map(|(_, model)| *model)
}
