//! `build`, `verify` and `predict`.

use serde_json::{Map, Value, json};
use stargrip_cam::answer::{overview_json, proof, verdict};
use stargrip_cam::artifact::{Asked, Kind};
use stargrip_cam::design::Design;
use stargrip_cam::forecast::predict::predict as predicted;
use stargrip_cam::forecast::report;
use stargrip_cam::manifest::ManifestFile;
use stargrip_cam::pipeline::{Built, Forecast, Sources, no_prediction, prove_files};
use stargrip_cam::spec::{ModelChoice, settings};
use stargrip_cam::verify::OutputFiles;

use crate::commands::faults::{listed, of_design, of_findings, of_warnings};
use crate::commands::spec::Given;
use crate::commands::text;
use crate::message::Message;

/// Makes the files that are asked for. They are proven unless `prove` is false, which is for a quick look: then there is no manifest.
/// What the spec's own load refuses is shown, but not handed out, unless it is wanted `anyway`.
pub(super) fn build(question: &Value, files: &[(String, Vec<u8>)]) -> Message {
    let given = match Given::of(question, files) {
        Ok(given) => given,
        Err(faults) => return Message::of(json!({ "faults": faults })),
    };
    let mut answer = json!({ "name": given.reading.spec.name, "settings": settings(&given.source) });
    let mut faults = listed(&given.reading.warnings);
    let forecast = match Forecast::of(given.reading.spec.clone(), given.machine.clone()) {
        Ok(forecast) => forecast,
        Err(refusals) => {
            faults.extend(of_design(&given, refusals));
            answer["faults"] = faults.into();
            return Message::of(answer);
        }
    };
    faults.extend(of_warnings(&given, &forecast.design.warnings));
    answer["overview"] = overview(&forecast);
    let unfit = of_design(&given, forecast.unfit());
    let is_taken = unfit.is_empty() || question["anyway"] == true;
    answer["unfit"] = (!unfit.is_empty()).into();
    faults.extend(unfit);
    let sources = Sources { spec: &given.source.text, machine: &given.machine_text };
    let built = forecast.build(sources, &asked(question));
    let files = if question["prove"] == false || !is_taken {
        let shown = |kind: Kind| matches!(kind, Kind::PreviewSvg | Kind::Report);
        let files = built.artifacts.into_iter().filter(|file| is_taken || shown(file.output.kind));
        files.map(|file| (file.name, file.bytes)).collect()
    } else {
        proven(built, &mut faults, &mut answer)
    };
    answer["faults"] = faults.into();
    Message { json: answer, files }
}

/// The files, if they say what the design says; if not, that is a fault of this program.
fn proven(built: Built, faults: &mut Vec<Value>, answer: &mut Value) -> Vec<(String, Vec<u8>)> {
    match built.prove() {
        Ok(proven) => {
            let kind = |file: &ManifestFile| (file.path.clone(), json!(file.kind));
            answer["kinds"] = proven.built().manifest.files.iter().map(kind).collect::<Map<_, _>>().into();
            answer["proof"] = serde_json::from_str(&proof::json(proven.proof())).unwrap_or_default();
            answer["proven"] = proof::scope(proven.proof()).into();
            proven.built().files().map(|(name, bytes)| (name.to_owned(), bytes.into_owned())).collect()
        }
        Err(findings) => {
            faults.extend(of_findings(&findings));
            Vec::new()
        }
    }
}

/// The overview of `check --json`, and the verdict's rows.
fn overview(forecast: &Forecast) -> Value {
    let mut overview = overview_json(forecast, &forecast.precautions("spec.toml"));
    overview["rows"] =
        verdict::rows(forecast).into_iter().map(|(label, text)| json!([label, text])).collect();
    overview
}

/// The kinds of `only` and `with`.
fn asked(question: &Value) -> Asked {
    let kinds = |name: &str| {
        let names = question[name].as_array().into_iter().flatten().filter_map(Value::as_str);
        names.filter_map(Kind::from_name).collect()
    };
    Asked { only: kinds("only"), with: kinds("with") }
}

/// Proves the files of a directory.
pub(super) fn verify(files: Vec<(String, Vec<u8>)>) -> Value {
    let files = files.into_iter().map(|(name, bytes)| (name.into(), bytes.into()));
    let mut files = OutputFiles { files: files.collect() };
    files.files.sort();
    serde_json::from_str(&proof::json(&prove_files(&files))).unwrap_or_default()
}

/// Predicts with the spec's model, or the one that `model` names.
pub(super) fn predict(question: &Value, files: &[(String, Vec<u8>)]) -> Value {
    let given = match Given::of(question, files) {
        Ok(given) => given,
        Err(faults) => return json!({ "faults": faults }),
    };
    let mut spec = given.reading.spec.clone();
    if let Some(model) = text(question, "model").and_then(model) {
        spec.accuracy.model = model;
    }
    let design = match Design::new(&spec, &given.machine) {
        Ok(design) => design,
        Err(refusals) => return json!({ "faults": of_design(&given, refusals) }),
    };
    match predicted(&spec, &design) {
        Ok(prediction) => {
            json!({ "faults": listed(&given.reading.warnings), "text": report::text(&spec, &prediction), "prediction": prediction })
        }
        Err(fault) => json!({ "faults": of_design(&given, no_prediction(&fault).into()) }),
    }
}

/// The model of this name, as in a spec; the shell has no place here.
fn model(name: &str) -> Option<ModelChoice> {
    Some(match name {
        "fit" => ModelChoice::Fit,
        "ring" => ModelChoice::Ring,
        "bvp" => ModelChoice::Bvp,
        "section" => ModelChoice::Section,
        "auto" => ModelChoice::Auto,
        _ => return None,
    })
}
