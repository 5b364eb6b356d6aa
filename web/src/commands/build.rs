//! `build` and `verify`.

use serde_json::{Map, Value, json};
use stargrip_cam::answer::refused::finding_json;
use stargrip_cam::answer::{overview_json, proof, verdict};
use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::design::Refusals;
use stargrip_cam::forecast::drawn::Watch;
use stargrip_cam::manifest::ManifestFile;
use stargrip_cam::pipeline::{
    Built, Forecast, Interface, Planned, Sources, no_requested_programs, prove_files,
};
use stargrip_cam::spec::{ModelChoice, form_settings};
use stargrip_cam::verify::OutputFiles;

use crate::commands::faults::{listed, of_design, of_warnings};
use crate::commands::picture;
use crate::commands::predict::model;
use crate::commands::spec::Given;
use crate::message::Message;
use crate::question::{Tell, text};

/// Makes the requested files. They are proven unless `prove` is false, for a quick preview: then there is no manifest. A gripper that fails
/// its own load is shown, but its files are not returned, except with `anyway`.
///
/// # Errors
/// The answer without files, if the spec is refused.
pub(super) fn build(question: &Value, files: &[(String, Vec<u8>)], tell: Tell) -> Result<Message, Value> {
    let loaded = Given::read(question, files)?;
    let build_request = request(question);
    no_requested_programs(&loaded.reading.spec, &loaded.machine, &build_request)
        .map_err(|refusals| refused_design(&loaded, refusals))?;
    let (forecast, mut answer, mut faults) =
        judged(&loaded, text(question, "model").and_then(model), Some(tell))?;
    let sources = Sources { spec: &loaded.source.text, machine: &loaded.machine_text };
    let is_taken = answer["unfit"] == false || question["anyway"] == true;
    let built = forecast.build(sources, &build_request);
    let files = if question["prove"] == false || !is_taken {
        let files = built.artifacts.into_iter().filter(|file| is_taken || is_shown(file.output.kind));
        files.map(|file| (file.name, file.bytes)).collect()
    } else {
        proven(built, &mut faults, &mut answer)
    };
    answer["faults"] = faults.into();
    Ok(Message { json: answer, files })
}

/// The overview with a picture, quickly: without a file and without a shell. A drawing is shown by the roles of its layers, too, also if the
/// spec is refused because of it.
///
/// # Errors
/// The answer without an overview, if the spec is refused.
pub(super) fn look(question: &Value, files: &[(String, Vec<u8>)]) -> Result<Value, Value> {
    let loaded = Given::read(question, files)?;
    let drawing = picture::drawing(&loaded.reading.spec);
    match judged(&loaded, None, None) {
        Ok((forecast, mut answer, faults)) => {
            answer["faults"] = faults.into();
            answer["sheets"] = picture::sheets(&forecast);
            answer["drawing"] = drawing;
            Ok(answer)
        }
        Err(mut answer) => {
            answer["drawing"] = drawing;
            Err(answer)
        }
    }
}

/// An answer with the name and the settings of the spec.
fn named(loaded: &Given) -> Value {
    json!({ "name": loaded.reading.spec.name, "settings": form_settings(&loaded.source) })
}

/// The answer without an overview about a design that is refused.
fn refused_design(loaded: &Given, refusals: Refusals) -> Value {
    let mut faults = listed(&loaded.reading.warnings);
    faults.extend(of_design(&loaded.source, &loaded.reading, refusals));
    let mut answer = named(loaded);
    answer["faults"] = faults.into();
    answer
}

/// The forecast, the answer with name, settings and overview, and the faults found so far.
///
/// # Errors
/// The answer without an overview, if the design is refused.
fn judged(
    loaded: &Given,
    model: Option<ModelChoice>,
    tell: Option<Tell>,
) -> Result<(Forecast, Value, Vec<Value>), Value> {
    let Given { source, reading, .. } = loaded;
    let forecast = predicted(loaded, model, tell).map_err(|refusals| refused_design(loaded, refusals))?;
    let mut answer = named(loaded);
    let mut faults = listed(&reading.warnings);
    let sources = Sources { spec: &source.text, machine: &loaded.machine_text };
    faults.extend(of_warnings(source, reading, &forecast.warnings(sources)));
    answer["overview"] = overview(&forecast);
    let unfit = of_design(source, reading, forecast.unfit());
    answer["unfit"] = (!unfit.is_empty()).into();
    faults.extend(unfit);
    Ok((forecast, answer, faults))
}

/// The forecast of the gripper by the spec's model or `model`, whose progress `tell` receives; without `tell` it leaves out a shell model, which takes seconds.
fn predicted(loaded: &Given, model: Option<ModelChoice>, tell: Option<Tell>) -> Result<Forecast, Refusals> {
    let mut spec = loaded.reading.spec.clone();
    if let Some(model) = model {
        spec.accuracy.model = model;
    }
    if tell.is_none() && spec.accuracy.model == ModelChoice::Shell {
        spec.accuracy.model = ModelChoice::Auto;
    }
    let progress = |part: f64, what: &str| {
        if let Some(tell) = tell {
            tell(part, what);
        }
    };
    let watch = Watch { progress: Some(&progress), ..Watch::default() };
    Planned::new(spec, loaded.machine.clone())?.forecast(&watch)
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
    let mut overview = overview_json(forecast, &forecast.precautions(Interface::Page));
    // The page computes the shell of a drawing when it is asked to: where it was not, there is nothing to tell.
    let of_drawing = verdict::of_drawing(forecast).into_iter().filter(|(label, _)| *label != "predicts");
    let rows = verdict::rows(forecast).into_iter().chain(of_drawing);
    overview["rows"] = rows.map(|(label, text)| json!([label, text])).collect();
    overview
}

/// The kinds of `only` and `with`.
fn request(question: &Value) -> KindRequest {
    KindRequest { only: kinds(question, "only"), with: kinds(question, "with") }
}

/// The kinds of files in the list `name` of `question`.
fn kinds(question: &Value, name: &str) -> Vec<Kind> {
    let names = question[name].as_array().into_iter().flatten().filter_map(Value::as_str);
    names.filter_map(Kind::from_name).collect()
}

/// Whether the page shows this kind of file where nothing is proven.
fn is_shown(kind: Kind) -> bool {
    matches!(kind, Kind::PreviewSvg | Kind::Report)
}

/// Proves the files of a directory.
pub(super) fn verify(files: Vec<(String, Vec<u8>)>) -> Value {
    serde_json::from_str(&proof::json(&prove_files(&directory(files)))).unwrap_or_default()
}

/// The directory of `files`, in the order of their names.
pub(super) fn directory(files: Vec<(String, Vec<u8>)>) -> OutputFiles<'static> {
    let mut directory: OutputFiles<'_> = files.into_iter().collect();
    directory.files.sort();
    directory
}
