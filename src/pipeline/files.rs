//! From what is known of a gripper to its files: one arm for every subject and format.

use crate::artifact::{Artifact, Asked, Format, Output, Subject, outputs};
use crate::design::engraved_depth;
use crate::emit;
use crate::emit::Inflated;
use crate::forecast::charts::charts;
use crate::forecast::prediction::StarPrediction;
use crate::forecast::shut::shut;
use crate::manifest::{Manifest, ManifestFile};
use crate::pipeline::{Built, Forecast, Sources};
use crate::plan::Program;

impl Forecast {
    /// The files that are `asked` for.
    pub fn build(self, sources: Sources<'_>, asked: &Asked) -> Built {
        let mut artifacts = Vec::new();
        self.make(sources, asked, |artifact| artifacts.push(artifact));
        let entries = artifacts.iter().map(ManifestFile::of).collect();
        Built { manifest: self.manifest(entries, asked), forecast: self, artifacts }
    }

    /// Hands each of the files that are `asked` for to `take`, one after the other, as soon as it is made.
    pub(super) fn make(&self, sources: Sources<'_>, asked: &Asked, mut take: impl FnMut(Artifact)) {
        for output in outputs(&self.spec, self.machine.controller.dialect, &self.design, asked) {
            if let Some(bytes) = content(self, sources, &output) {
                take(Artifact::new(output, bytes));
            }
        }
    }

    /// The manifest that names `files`, those that were `asked` for.
    pub(super) fn manifest(&self, files: Vec<ManifestFile>, asked: &Asked) -> Manifest {
        let bill = Manifest::new(&self.spec, &self.design, &self.programs);
        bill.with_prediction(self.prediction.as_ref()).with_files(files, asked)
    }
}

/// The content of one file; `None` for what this gripper does not have.
fn content(forecast: &Forecast, sources: Sources<'_>, output: &Output) -> Option<Vec<u8>> {
    let text = match output.kind.subject() {
        Subject::Spec => sources.spec.to_owned(),
        Subject::Machine => sources.machine.to_owned(),
        Subject::Prediction => forecast.prediction.as_ref()?.to_json(),
        Subject::Scene => {
            return emit::scene(&forecast.spec, &forecast.design, &inflated(forecast));
        }
        Subject::Preview => return preview(forecast, output),
        Subject::Report => report(forecast, sources)?,
        Subject::Trace => program(forecast, &forecast.traces, output)?,
        Subject::Seal if output.kind.format() == Format::Gcode => {
            program(forecast, &forecast.programs, output)?
        }
        Subject::Seal | Subject::Outline | Subject::Mask | Subject::Pieces | Subject::Frame => {
            return drawing(forecast, output);
        }
    };
    Some(text.into_bytes())
}

/// Where each star comes to rest, bottom to top; nothing inflates without a pressure.
fn inflated(forecast: &Forecast) -> Vec<Inflated> {
    let pressure = forecast.spec.load.as_ref().and_then(|load| load.pressure);
    let prediction = forecast.prediction.as_ref().filter(|_| pressure.is_some());
    let rest = |star: &StarPrediction| {
        Some(Inflated {
            // Below 0 the arms touch.
            tip_angle: star.tip_equilibrium_angle_deg?.to_radians().max(0.0),
            inner_radius: star.final_radius_mm?,
        })
    };
    let stars = prediction.map(|prediction| prediction.stars.iter().map(rest).collect::<Option<_>>());
    stars.flatten().unwrap_or_default()
}

/// The picture of the output's sheet.
fn preview(forecast: &Forecast, output: &Output) -> Option<Vec<u8>> {
    let Forecast { spec, machine, design, programs, prediction, .. } = forecast;
    let object = spec.load.as_ref().and_then(|load| load.object_radius);
    let shut = prediction.as_ref().map_or(Vec::new(), |prediction| shut(design, prediction, object));
    let preview = emit::Preview { spec, machine, design, programs, shut: &shut };
    match output.kind.format() {
        Format::Png => preview.png(output.sheet?),
        _ => preview.svg(output.sheet?).map(String::into_bytes),
    }
}

/// All that is known of the gripper, on one page.
fn report(forecast: &Forecast, sources: Sources<'_>) -> Option<String> {
    let Forecast { spec, machine, design, programs, prediction, .. } = forecast;
    let charts = charts(spec, design);
    let scene = emit::scene(spec, design, &inflated(forecast))?;
    let bill = Manifest::new(spec, design, programs);
    Some(emit::report(&emit::Report {
        source: sources.spec,
        spec,
        machine,
        design,
        programs,
        prediction: prediction.as_ref(),
        charts: &charts,
        bill: &bill,
        scene: &scene,
    }))
}

/// The one of `programs` that is for the output's star, or its sheet.
fn program(forecast: &Forecast, programs: &[Program], output: &Output) -> Option<String> {
    let is_for = |program: &&Program| match output.star {
        Some(star) => program.stars == [star],
        None => Some(program.sheet) == output.sheet,
    };
    let program = programs.iter().find(is_for)?;
    Some(emit::gcode(&forecast.spec, &forecast.machine, program))
}

fn drawing(forecast: &Forecast, output: &Output) -> Option<Vec<u8>> {
    let spec = &forecast.spec;
    let drawing = output.drawing(&forecast.design)?;
    let title = output.title(&spec.name);
    Some(match output.kind.format() {
        Format::Svg => emit::svg(&title, &drawing, spec.accuracy.path, spec.cut.colours).into_bytes(),
        Format::Dxf => emit::dxf(&drawing, spec.accuracy.path, spec.cut.colours).into_bytes(),
        Format::Stl => {
            let thickness = output.thickness(spec);
            emit::stl(&output.solid_name(&spec.name), &drawing, thickness, engraved_depth(thickness))
        }
        Format::Pdf => emit::pdf(&title, &output.paper?.pages(&drawing, &output.caption())),
        Format::Toml | Format::Gcode | Format::Json | Format::Png | Format::Glb | Format::Html => {
            return None;
        }
    })
}
