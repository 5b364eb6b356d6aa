//! Every stage by name: spec -> design -> plan -> text -> artifacts -> proof.

mod parts;

use crate::artifact::{Artifact, Kind, Variant};
use crate::design::{Design, Drawing, Refusal, RefusalCode, Refusals};
use crate::emit;
use crate::forecast::predict::{PredictFault, predict};
use crate::forecast::prediction::Prediction;
use crate::manifest::{MANIFEST, Manifest};
use crate::plan;
use crate::plan::Program;
use crate::spec::{Machine, ProgramScope, Spec};
use crate::verify::OutputFiles;

/// Everything that a build makes, in memory.
#[derive(Clone, Debug)]
pub struct Build {
    /// The exact geometry.
    pub design: Design,
    /// The sealing programs.
    pub programs: Vec<Program>,
    /// The trace programs.
    pub traces: Vec<Program>,
    /// What the gripper will do; `None` if the spec has no load, or nobody wants to know.
    pub prediction: Option<Prediction>,
    /// The files, without the manifest.
    pub artifacts: Vec<Artifact>,
    /// The manifest of the files.
    pub manifest: Manifest,
}

/// The texts that a build was made from; they are published with it, so that it can be proven from its directory alone.
#[derive(Clone, Copy, Debug)]
pub struct Sources<'a> {
    /// The spec as read.
    pub spec: &'a str,
    /// The machine profile as resolved.
    pub machine: &'a str,
}

/// Builds `spec` for `machine`. Only the kinds in `only` are made (spec and machine always); empty means all.
///
/// # Errors
/// Every reason for which there is no such gripper.
pub fn build(spec: &Spec, machine: &Machine, sources: Sources<'_>, only: &[Kind]) -> Result<Build, Refusals> {
    let design = Design::new(spec, machine)?;
    let programs = plan::seal_programs(spec, machine, &design);
    let traces = plan::trace_programs(spec, machine, &design);
    plan::refusals(spec, machine, &programs, &traces).or(())?;
    let mut artifacts = artifacts(spec, machine, sources, only, &design, &programs, &traces);
    let prediction = predicted(spec, only)?;
    artifacts.extend(prediction.as_ref().map(prediction_file));
    let manifest = Manifest::new(spec, &design, &artifacts, &programs);
    Ok(Build { design, programs, traces, prediction, artifacts, manifest })
}

impl Build {
    /// The files as the verifier sees them.
    pub fn output_files(&self) -> OutputFiles<'_> {
        OutputFiles { files: self.files().map(|(name, bytes)| (name.into(), bytes)).collect() }
    }

    /// All files with their names, the manifest last.
    pub fn files(&self) -> impl Iterator<Item = (&str, std::borrow::Cow<'_, [u8]>)> {
        let artifacts = self.artifacts.iter().map(|a| (a.name.as_str(), a.bytes.as_slice().into()));
        artifacts.chain(std::iter::once((MANIFEST, self.manifest.to_json().into())))
    }
}

/// The prediction for a spec with a load; without one nothing is solved.
fn predicted(spec: &Spec, only: &[Kind]) -> Result<Option<Prediction>, Refusals> {
    if spec.load.is_none() || !(only.is_empty() || only.contains(&Kind::Prediction)) {
        return Ok(None);
    }
    predict(spec).map(Some).map_err(|fault| no_prediction(&fault).into())
}

/// A prediction that cannot be made, as a refusal at the key that stands in its way.
pub fn no_prediction(fault: &PredictFault) -> Refusal {
    let key = fault.star.map_or(fault.key, |star| fault.key.of_star(star));
    Refusal::new(key, RefusalCode::NoPrediction, fault.what.clone(), "needed for a prediction".to_owned())
}

fn prediction_file(prediction: &Prediction) -> Artifact {
    Artifact {
        name: "prediction.json".to_owned(),
        kind: Kind::Prediction,
        sheet: None,
        star: None,
        variant: Variant::default(),
        bytes: prediction.to_json().into_bytes(),
    }
}

fn artifacts(
    spec: &Spec,
    machine: &Machine,
    sources: Sources<'_>,
    only: &[Kind],
    design: &Design,
    programs: &[Program],
    traces: &[Program],
) -> Vec<Artifact> {
    let wanted = |kind: Kind| only.is_empty() || only.contains(&kind);
    let mut out = Vec::new();
    let mut add = |name: String, kind, sheet, star, text: String| {
        let variant = Variant::default();
        out.push(Artifact { name, kind, sheet, star, variant, bytes: text.into_bytes() });
    };
    add("spec.toml".to_owned(), Kind::Spec, None, None, sources.spec.to_owned());
    add("machine.toml".to_owned(), Kind::Machine, None, None, sources.machine.to_owned());
    for (kind, word, list) in [(Kind::SealGcode, "seal", programs), (Kind::TraceGcode, "trace", traces)] {
        for program in list.iter().filter(|_| wanted(kind)) {
            let star = program.stars.first().copied().filter(|_| spec.machine.program == ProgramScope::Star);
            let subject = star.map_or(format!("sheet-{}", program.sheet), |star| format!("star-{star}"));
            let text = emit::gcode(spec, machine, program);
            add(format!("{subject}-{word}.gcode"), kind, Some(program.sheet), star, text);
        }
    }
    let path = spec.accuracy.path;
    for sheet in design.sheets.iter().map(|sheet| sheet.index) {
        let file = |what: &str| format!("sheet-{sheet}-{what}");
        let drawings = [
            ("seal", Drawing::seals(design, sheet), Kind::SealSvg, Kind::SealDxf),
            ("outline", Drawing::outlines(design, sheet), Kind::OutlineSvg, Kind::OutlineDxf),
        ];
        for (what, drawing, svg, dxf) in drawings {
            let Some(drawing) = drawing else { continue };
            if wanted(svg) {
                let title = format!("{what}, sheet {sheet}: {}", spec.name);
                add(file(&format!("{what}.svg")), svg, Some(sheet), None, emit::svg(&title, &drawing, path));
            }
            if wanted(dxf) {
                add(file(&format!("{what}.dxf")), dxf, Some(sheet), None, emit::dxf(&drawing, path));
            }
        }
        if wanted(Kind::PreviewSvg)
            && let Some(picture) = emit::preview(spec, design, programs, sheet)
        {
            add(file("preview.svg"), Kind::PreviewSvg, Some(sheet), None, picture);
        }
    }
    parts::masks(spec, design, &wanted, &mut out);
    parts::plates(spec, design, &wanted, &mut out);
    out
}
