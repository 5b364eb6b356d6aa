//! The proof: from the files of an output directory alone to a list of findings, best an empty one.
//!
//! The directory's own spec and machine profile say what should be there; the exact geometry is
//! computed from them anew, and every file is read back and compared with it.

use crate::artifact::Kind;
use crate::design::{Design, Drawing, MaskPlate, Paper};
use crate::forecast::predict::predict;
use crate::manifest::{MANIFEST, Manifest, ManifestFile, sha256};
use crate::spec;
use crate::spec::{Machine, Source, Spec};
use crate::verify::judge::expected::Expected;
use crate::verify::judge::files::{drawings, paper, solid};
use crate::verify::judge::job;
use crate::verify::judge::job::Job;
use crate::verify::{Finding, FindingCode, Findings, OutputFiles};

/// What the verifier has to say about a directory.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Proof {
    /// Everything that is wrong.
    pub findings: Vec<Finding>,
    /// Of every file with geometry: its largest deviation from the exact geometry either way, mm.
    pub deviations: Vec<(String, f64)>,
}

/// Proves a directory from its files alone.
pub fn prove_files(files: &OutputFiles<'_>) -> Proof {
    let mut refused = Findings::default();
    let text = |name: &'static str, findings: &mut Findings| -> Option<Source> {
        let Some(bytes) = files.get(name) else {
            findings.push(
                Finding::new(FindingCode::MissingFile, None, "no such file", "the file of the build")
                    .in_file(name),
            );
            return None;
        };
        let source = Source::from_bytes(name, bytes);
        source.map_err(|faults| findings.push(unreadable(name, &faults))).ok()
    };
    let spec = text("spec.toml", &mut refused).and_then(|source| {
        spec::read(&source).map_err(|faults| refused.push(unreadable("spec.toml", &faults))).ok()
    });
    let machine = text("machine.toml", &mut refused).and_then(|source| {
        spec::read_machine(&source).map_err(|faults| refused.push(unreadable("machine.toml", &faults))).ok()
    });
    let (Some(reading), Some(machine)) = (spec, machine) else {
        return Proof { findings: refused.into_vec(), deviations: Vec::new() };
    };
    match Design::new(&reading.spec, &machine) {
        Ok(design) => prove(&design, &reading.spec, &machine, files),
        Err(refusals) => {
            for refusal in refusals {
                refused.push(
                    Finding::new(refusal.code, None, refusal.found, refusal.remedy).in_file("spec.toml"),
                );
            }
            Proof { findings: refused.into_vec(), deviations: Vec::new() }
        }
    }
}

fn unreadable(name: &str, faults: &spec::Faults) -> Finding {
    let found = faults.list().first().map_or("faults", |fault| &fault.message).to_owned();
    Finding::new(FindingCode::Unreadable, None, found, "text that `check` accepts").in_file(name)
}

/// Proves the files of `files` against a design that is known.
pub fn prove(design: &Design, spec: &Spec, machine: &Machine, files: &OutputFiles<'_>) -> Proof {
    let truth = Expected { design, spec, machine };
    let mut proof = Proof::default();
    let Some(manifest) = files.get(MANIFEST).and_then(|bytes| serde_json::from_slice::<Manifest>(bytes).ok())
    else {
        let finding = Finding::new(
            FindingCode::Manifest,
            None,
            "no manifest that can be read",
            "the manifest of the build",
        );
        proof.findings.push(finding.in_file(MANIFEST));
        return proof;
    };
    names(files, &manifest, &mut proof);
    let mut seals = drawings::Seals::default();
    for entry in &manifest.files {
        let Some(bytes) = files.get(&entry.path) else { continue };
        let mut findings = Findings::default();
        check_hash(entry, bytes, &mut findings);
        let deviation = file(truth, entry, bytes, &mut seals, &mut findings);
        proof.deviations.extend(deviation.map(|mm| (entry.path.clone(), mm)));
        proof.findings.extend(findings.into_vec().into_iter().map(|finding| finding.in_file(&entry.path)));
    }
    proof.findings.extend(seals.disagreements(spec.accuracy.path.0));
    proof.findings.extend(job::manifest_figures(truth, &manifest));
    proof
}

/// Files that the manifest names and that are missing, and the other way round.
fn names(files: &OutputFiles<'_>, manifest: &Manifest, proof: &mut Proof) {
    let named = |name: &str| manifest.files.iter().any(|entry| entry.path == name);
    for required in ["spec.toml", "machine.toml"].into_iter().filter(|name| !named(name)) {
        proof.findings.push(
            Finding::new(FindingCode::Manifest, None, "does not name this file", "a file the build wrote")
                .in_file(required),
        );
    }
    for entry in manifest.files.iter().filter(|entry| files.get(&entry.path).is_none()) {
        let finding =
            Finding::new(FindingCode::MissingFile, None, "no such file", format!("{} bytes", entry.bytes));
        proof.findings.push(finding.in_file(&entry.path));
    }
    for (name, _) in files.files.iter().filter(|(name, _)| *name != MANIFEST && !named(name)) {
        let finding = Finding::new(
            FindingCode::UnnamedFile,
            None,
            "a file that the manifest does not name",
            "only what it names",
        );
        proof.findings.push(finding.in_file(name));
    }
}

fn check_hash(entry: &ManifestFile, bytes: &[u8], findings: &mut Findings) {
    if bytes.len() != entry.bytes {
        findings.add(
            FindingCode::Size,
            None,
            format!("{} bytes", bytes.len()),
            format!("{} bytes", entry.bytes),
        );
    }
    let hash = sha256(bytes);
    if hash != entry.sha256 {
        findings.add(FindingCode::Hash, None, hash, entry.sha256.clone());
    }
}

/// Compares one file with the exact geometry; its deviation, if it has geometry.
fn file(
    truth: Expected<'_>,
    entry: &ManifestFile,
    bytes: &[u8],
    seals: &mut drawings::Seals,
    findings: &mut Findings,
) -> Option<f64> {
    let Some(kind) = Kind::from_name(&entry.kind) else {
        findings.add(FindingCode::UnknownKind, None, entry.kind.clone(), "a kind of this tool");
        return None;
    };
    if kind == Kind::MaskPdf || kind == Kind::MaskStl {
        return binary(truth, entry, kind, bytes, findings);
    }
    let Ok(text) = std::str::from_utf8(bytes) else {
        findings.add(FindingCode::NotText, None, "bytes that are not UTF-8", "text");
        return None;
    };
    let sheet = entry.sheet.unwrap_or(0);
    let drawing = match kind {
        Kind::Prediction => {
            prediction(truth, text, findings);
            return None;
        }
        Kind::Spec | Kind::Machine | Kind::PreviewSvg | Kind::MaskPdf | Kind::MaskStl => return None,
        Kind::SealGcode | Kind::TraceGcode => {
            let Some(job) = Job::new(truth, kind == Kind::SealGcode, sheet, entry.star) else {
                no_such_part(entry, findings);
                return None;
            };
            return Some(job.check(text, findings));
        }
        Kind::SealSvg | Kind::SealDxf => Drawing::seals(truth.design, sheet),
        Kind::OutlineSvg | Kind::OutlineDxf => Drawing::outlines(truth.design, sheet),
        Kind::MaskSvg | Kind::MaskDxf => {
            entry.star.and_then(|star| Drawing::mask(truth.design, star, entry.mirrored))
        }
        Kind::FrameSvg | Kind::FrameDxf => {
            let plates = &truth.design.frame.plates;
            let plate = plates.iter().find(|plate| plate.numbers.first() == entry.plate.as_ref());
            plate.map(|plate| Drawing::plate(truth.design, plate))
        }
    };
    let Some(drawing) = drawing else {
        no_such_part(entry, findings);
        return None;
    };
    let found = match kind {
        Kind::SealSvg | Kind::OutlineSvg | Kind::MaskSvg | Kind::FrameSvg => {
            drawings::read_page(text, &drawing, findings)
        }
        _ => drawings::read_plan(text, findings),
    };
    let deviation = drawings::compare(&found, &drawing, truth.spec.accuracy.path.0, findings);
    if matches!(kind, Kind::SealSvg | Kind::SealDxf) {
        seals.add(sheet, &entry.path, &found);
    }
    Some(deviation)
}

fn binary(
    truth: Expected<'_>,
    entry: &ManifestFile,
    kind: Kind,
    bytes: &[u8],
    findings: &mut Findings,
) -> Option<f64> {
    let star = entry.star.unwrap_or(0);
    let drawing = Drawing::mask(truth.design, star, entry.mirrored);
    let (Some(drawing), Some(paper)) = (drawing, Paper::from_name(entry.paper.as_deref())) else {
        no_such_part(entry, findings);
        return None;
    };
    if kind == Kind::MaskStl {
        return Some(solid::check(bytes, &drawing, truth.spec.mask.thickness.0, findings));
    }
    let pages = paper.pages(&drawing, &MaskPlate::caption(star, entry.mirrored));
    Some(paper::check(bytes, &pages, findings))
}

fn no_such_part(entry: &ManifestFile, findings: &mut Findings) {
    let found = format!(
        "sheet {:?}, star {:?}, plate {:?}, paper {:?}",
        entry.sheet, entry.star, entry.plate, entry.paper
    );
    findings.add(FindingCode::Manifest, None, found, "a part of the design");
}

/// The prediction made anew, against the one that was written.
fn prediction(truth: Expected<'_>, text: &str, findings: &mut Findings) {
    let Ok(right) = predict(truth.spec) else {
        findings.add(FindingCode::Prediction, None, "a prediction", "none: this spec has no prediction");
        return;
    };
    // The same program gives the same bytes; another build of it may differ in the last digits.
    let numbers = |text: &str| serde_json::from_str::<serde_json::Value>(text).ok();
    let same = match (numbers(text), numbers(&right.to_json())) {
        (Some(found), Some(allowed)) => alike(&found, &allowed),
        _ => false,
    };
    if !same {
        findings.add(
            FindingCode::Prediction,
            None,
            "other figures than this spec gives",
            "what `predict --json` prints",
        );
    }
}

/// Whether two JSON values say the same, numbers to one in 10^9.
fn alike(a: &serde_json::Value, b: &serde_json::Value) -> bool {
    use serde_json::Value;
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => match (a.as_f64(), b.as_f64()) {
            (Some(a), Some(b)) => (a - b).abs() <= 1e-9 * a.abs().max(b.abs()).max(1e-9),
            _ => false,
        },
        (Value::Array(a), Value::Array(b)) => a.len() == b.len() && a.iter().zip(b).all(|(a, b)| alike(a, b)),
        (Value::Object(a), Value::Object(b)) => {
            a.len() == b.len() && a.iter().all(|(key, a)| b.get(key).is_some_and(|b| alike(a, b)))
        }
        _ => a == b,
    }
}
