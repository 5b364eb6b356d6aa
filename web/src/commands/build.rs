//! `build` and `verify`.

use serde_json::{Map, Value, json};
use stargrip_cam::answer::refused::finding_json;
use stargrip_cam::answer::{overview_json, proof, verdict};
use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::design::Refusals;
use stargrip_cam::forecast::drawn::Watch;
use stargrip_cam::manifest::ManifestFile;
use stargrip_cam::pipeline::{Built, Forecast, Planned, Sources, prove_files};
use stargrip_cam::spec::{ModelChoice, form_settings};
use stargrip_cam::verify::OutputFiles;

use crate::boundary::tell;
use crate::commands::faults::{listed, of_design, of_warnings};
use crate::commands::spec::Given;
use crate::message::Message;

/// Makes the requested files. They are proven unless `prove` is false, for a quick preview: then there is no manifest. A gripper that fails
/// its own load is shown, but its files are not returned, except with `anyway`.
///
/// # Errors
/// The answer without files, if the spec is refused.
pub(super) fn build(question: &Value, files: &[(String, Vec<u8>)]) -> Result<Message, Value> {
    let given = Given::of(question, files)?;
    let mut answer = json!({ "name": given.reading.spec.name, "settings": form_settings(&given.source) });
    let mut faults = listed(&given.reading.warnings);
    let forecast = match forecast(&given, question["quick"] == true) {
        Ok(forecast) => forecast,
        Err(refusals) => {
            faults.extend(of_design(&given, refusals));
            answer["faults"] = faults.into();
            return Err(answer);
        }
    };
    let sources = Sources { spec: &given.source.text, machine: &given.machine_text };
    faults.extend(of_warnings(&given, &forecast.warnings(sources)));
    answer["overview"] = overview(&forecast);
    let unfit = of_design(&given, forecast.unfit());
    let is_taken = unfit.is_empty() || question["anyway"] == true;
    answer["unfit"] = (!unfit.is_empty()).into();
    faults.extend(unfit);
    let built = forecast.build(sources, &request(question));
    let files = if question["prove"] == false || !is_taken {
        let shown = |kind: Kind| matches!(kind, Kind::PreviewSvg | Kind::Report);
        let files = built.artifacts.into_iter().filter(|file| is_taken || shown(file.output.kind));
        files.map(|file| (file.name, file.bytes)).collect()
    } else {
        proven(built, &mut faults, &mut answer)
    };
    answer["faults"] = faults.into();
    Ok(Message { json: answer, files })
}

/// The forecast of the gripper; if `is_quick`, without a shell model, which the spec may request.
fn forecast(given: &Given, is_quick: bool) -> Result<Forecast, Refusals> {
    let mut spec = given.reading.spec.clone();
    if is_quick && spec.accuracy.model == ModelChoice::Shell {
        spec.accuracy.model = ModelChoice::Auto;
    }
    let watch = Watch { progress: Some(&tell), ..Watch::default() };
    Planned::new(spec, given.machine.clone())?.forecast(&watch)
}

/// The files, if they agree with the design; if not, that is a fault of this program.
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
            faults.extend(findings.iter().map(finding_json));
            Vec::new()
        }
    }
}

/// The overview of `check --json`, and the verdict's rows.
fn overview(forecast: &Forecast) -> Value {
    let mut overview = overview_json(forecast, &forecast.precautions("spec.toml"));
    let rows = verdict::rows(forecast).into_iter().chain(verdict::of_drawing(forecast));
    overview["rows"] = rows.map(|(label, text)| json!([label, text])).collect();
    overview
}

/// The kinds of `only` and `with`.
fn request(question: &Value) -> KindRequest {
    let kinds = |name: &str| {
        let names = question[name].as_array().into_iter().flatten().filter_map(Value::as_str);
        names.filter_map(Kind::from_name).collect()
    };
    KindRequest { only: kinds("only"), with: kinds("with") }
}

/// Proves the files of a directory.
pub(super) fn verify(files: Vec<(String, Vec<u8>)>) -> Value {
    let files = files.into_iter().map(|(name, bytes)| (name.into(), bytes.into()));
    let mut files = OutputFiles { files: files.collect(), ..OutputFiles::default() };
    files.files.sort();
    serde_json::from_str(&proof::json(&prove_files(&files))).unwrap_or_default()
}
