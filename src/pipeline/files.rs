//! Makes the files of a forecast gripper: one match arm for every subject and format.

use crate::emit;
use crate::manifest::{Manifest, ManifestFile, manifest_of};
use crate::pipeline::{Built, Forecast, Interface, Sources};
use design::PressPlan;
use forecast::charts::charts;
use forecast::pose::{self, PosedStar};
use program::plan::Program;
use proof::artifact::{Artifact, Format, KindRequest, Output, Subject, outputs};
use spec::Code;

/// The spec's name in the commands of a report, which lies beside it.
const SPEC: &str = "spec.toml";

impl Forecast {
    /// Makes the requested files.
    ///
    /// The kinds in the spec's `[build]` are included, unless `request` names the only kinds.
    pub fn build(self, sources: Sources<'_>, request: &KindRequest) -> Built {
        let request = request.clone().of_spec(&self.spec);
        let mut artifacts = Vec::new();
        self.make(sources, &request, |artifact| artifacts.push(artifact));
        let entries = artifacts.iter().map(ManifestFile::new).collect();
        Built { manifest: self.manifest(entries, &request), forecast: self, artifacts }
    }

    /// Makes the requested files one after the other, and passes each to `take` at once.
    pub(super) fn make(&self, sources: Sources<'_>, request: &KindRequest, mut take: impl FnMut(Artifact)) {
        for output in outputs(&self.spec, self.machine.controller.dialect, &self.design, request) {
            if let Some(bytes) = content(self, sources, &output) {
                take(Artifact::new(output, bytes));
            }
        }
    }

    /// The manifest of `files`, which `request` selects.
    pub(super) fn manifest(&self, files: Vec<ManifestFile>, request: &KindRequest) -> Manifest {
        let bill =
            manifest_of(&self.spec, &self.design, &self.programs, &self.cuts, self.prediction.as_ref());
        Manifest { files, only: request.only.clone(), with: request.with.clone(), ..bill }
    }
}

/// The content of one file; `None` if the gripper has none of this kind.
fn content(forecast: &Forecast, sources: Sources<'_>, output: &Output) -> Option<Vec<u8>> {
    // The subject decides who writes the file. Texts become bytes at the end; all others return their bytes at once.
    // Drawings are left to their format.
    let text = match output.kind.subject() {
        Subject::Spec => sources.spec.to_owned(),
        Subject::Machine => sources.machine.to_owned(),
        Subject::Drawing => {
            let content = forecast.spec.drawing.as_ref()?.content.as_ref()?;
            return Some(content.bytes().to_vec());
        }
        Subject::Prediction => match &forecast.drawn {
            Some(drawn) => drawn.prediction.to_json(),
            None => forecast.prediction.as_ref()?.to_json(),
        },
        Subject::Scene => return scene(forecast),
        Subject::Mjcf => {
            emit::mjcf(&forecast.spec, forecast.design.assembly()?, forecast.prediction.as_ref()?)
        }
        Subject::Preview => return preview(forecast, sources, output),
        Subject::Report => report(forecast, sources)?,
        Subject::Seal | Subject::Trace | Subject::Cut if output.kind.is_program() => {
            let program = program_of(forecast, output)?;
            let text = if output.kind.subject() == Subject::Cut {
                let cut_spec = forecast.spec.cut_by(&forecast.spec.cut.program?);
                emit::gcode(&cut_spec, &forecast.machine, program)
            } else {
                emit::gcode(&forecast.spec, &forecast.machine, program)
            };
            if output.kind.format() == Format::Package {
                return emit::package(&text, program.time);
            }
            text
        }
        Subject::PressPlan => {
            let plan = PressPlan::new(&forecast.spec, &forecast.design)?;
            let page = plan.page(&forecast.spec.name, &forecast.design);
            return Some(emit::pdf(&output.title(&forecast.spec.name), &[page]));
        }
        Subject::Seal
        | Subject::Trace
        | Subject::Cut
        | Subject::Outline
        | Subject::Mask
        | Subject::Pieces
        | Subject::Frame
        | Subject::Separator => return drawing(forecast, output),
    };
    Some(text.into_bytes())
}

/// The gripper in three dimensions, as a GLB file.
fn scene(forecast: &Forecast) -> Option<Vec<u8>> {
    let Forecast { spec, design, .. } = forecast;
    match design.drawn_pieces() {
        Some(pieces) => {
            let surfaces = forecast.drawn.as_ref().map_or(&[][..], |drawn| &drawn.surfaces);
            emit::drawn_scene(spec, design, pieces, surfaces)
        }
        None => emit::scene(spec, design, &inflated(forecast)),
    }
}

/// The inflated stars, bottom to top; empty if their contraction is unknown.
fn inflated(forecast: &Forecast) -> Vec<PosedStar> {
    pose::inflated(&forecast.spec, &forecast.design, forecast.prediction.as_ref())
}

/// The picture of the output's sheet.
fn preview(forecast: &Forecast, sources: Sources<'_>, output: &Output) -> Option<Vec<u8>> {
    let Forecast { spec, machine, design, programs, .. } = forecast;
    let shut = inflated(forecast);
    let code = sources.code(spec);
    let preview = emit::Preview { spec, machine, design, programs, shut: &shut, code: code.as_ref() };
    match output.kind.format() {
        Format::Png => preview.png(output.part.sheet()?),
        Format::Svg => preview.svg(output.part.sheet()?).map(String::into_bytes),
        Format::Toml
        | Format::Gcode
        | Format::Package
        | Format::Dxf
        | Format::Pdf
        | Format::Stl
        | Format::Json
        | Format::Glb
        | Format::Xml
        | Format::Html => None,
    }
}

/// The report of the gripper: all results on one page.
fn report(forecast: &Forecast, sources: Sources<'_>) -> Option<String> {
    let Forecast { spec, machine, design, programs, prediction, .. } = forecast;
    let chart_list = charts(spec, design);
    let glb = scene(forecast)?;
    // The page does not list the cuts.
    let bill = manifest_of(spec, design, programs, &[], None);
    let precautions = forecast.precautions(Interface::Command(SPEC));
    let watch: Vec<(&str, &str)> =
        precautions.iter().map(|one| (one.code.as_str(), one.text.as_str())).collect();
    Some(emit::report(&emit::Report {
        source: sources.spec,
        spec,
        machine,
        design,
        programs,
        prediction: prediction.as_ref(),
        drawn: forecast.drawn.as_ref().map(|drawn| &drawn.prediction),
        charts: &chart_list,
        watch: &watch,
        bill: &bill,
        scene: &glb,
        code: sources.code(spec).as_ref(),
    }))
}

/// The program for the output's piece, or for its sheet.
fn program_of<'f>(forecast: &'f Forecast, output: &Output) -> Option<&'f Program> {
    let programs = match output.kind.subject() {
        Subject::Trace => &forecast.traces,
        Subject::Cut => &forecast.cuts,
        Subject::Seal => &forecast.programs,
        Subject::Spec
        | Subject::Machine
        | Subject::Drawing
        | Subject::Prediction
        | Subject::Scene
        | Subject::Preview
        | Subject::Report
        | Subject::PressPlan
        | Subject::Outline
        | Subject::Mask
        | Subject::Pieces
        | Subject::Frame
        | Subject::Separator
        | Subject::Mjcf => return None,
    };
    let is_for = |program: &&Program| match output.part.sealed() {
        Some(number) => program.numbers() == [number],
        None => Some(program.sheet) == output.part.sheet(),
    };
    programs.iter().find(is_for)
}

fn drawing(forecast: &Forecast, output: &Output) -> Option<Vec<u8>> {
    let spec = &forecast.spec;
    let drawing = output.drawing(&forecast.design)?;
    let title = output.title(&spec.name);
    Some(match output.kind.format() {
        Format::Svg => emit::svg(&title, &drawing, spec.accuracy.path, spec.cut.colours).into_bytes(),
        Format::Dxf => emit::dxf(&drawing, spec.accuracy.path, spec.cut.colours).into_bytes(),
        Format::Stl => emit::stl(&output.solid_name(&spec.name)?, &drawing, output.thickness(spec)?),
        Format::Pdf => emit::pdf(&title, &output.paper?.pages(&drawing, &output.caption()?)),
        Format::Toml
        | Format::Gcode
        | Format::Package
        | Format::Json
        | Format::Png
        | Format::Glb
        | Format::Xml
        | Format::Html => return None,
    })
}
