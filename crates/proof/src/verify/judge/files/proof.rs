//! The proof: every file that the design must have, read back and compared with it.

use serde::Serialize;

use crate::artifact::{Format, KindRequest, Output, Subject, outputs};
use crate::manifest::{MANIFEST, Manifest, ManifestFile, sha256};
use crate::verify::judge::expected::Expected;
use crate::verify::judge::files::assembly::Assemblies;
use crate::verify::judge::files::figures::alike;
use crate::verify::judge::files::{drawings, figures, names, package, solid, welded};
use crate::verify::judge::task::{ProgramTask, ProgramWork};
use crate::verify::{Finding, FindingCode, Findings, OutputFiles};

/// The verifier's result for a directory.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Proof {
    /// Everything that is wrong.
    pub findings: Vec<Finding>,
    /// Every file that the design must have and that is there.
    pub files: Vec<FileProof>,
    /// The version that wrote the directory, if it is not this one: its files are read back, not compared.
    pub written_by: Option<String>,
    /// Files and figures of another version's directory that nothing proves: no reader judges them as a whole, and they
    /// differ from those of this version.
    pub unproven: Vec<String>,
}

impl Proof {
    /// Files that are equal to the byte to those that this version makes.
    pub fn equal(&self) -> usize {
        self.files.iter().filter(|file| file.by == Method::Bytes).count()
    }
}

/// Data of several files that must agree.
#[derive(Default)]
struct CrossChecks {
    seals: drawings::Seals,
    pieces: Assemblies,
}

/// The result for one file.
#[derive(Clone, Debug, PartialEq)]
pub struct FileProof {
    /// Name of the file in the directory.
    pub path: String,
    /// Kind and subject of the file.
    pub output: Output,
    /// The method by which it was checked.
    pub by: Method,
    /// SHA-256 of its content, lower-case hexadecimal.
    pub sha256: String,
    /// Largest deviation from the exact geometry either way, mm; `None` for a file without measured geometry.
    pub deviation: Option<f64>,
}

/// The method by which a file was checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Equal to the file that this version makes of the spec, and read back.
    Bytes,
    /// Read back and compared with the design.
    Reading,
    /// By its hash in the manifest only.
    Hash,
}

/// Reads every file back and compares it with the expected content.
pub fn prove(expected: &Expected<'_>, files: &OutputFiles<'_>) -> Proof {
    let mut proof = Proof::default();
    let manifest = names::read(files).map_err(|finding| proof.findings.push(finding)).ok();
    let request = manifest.as_ref().map_or(KindRequest::default(), Manifest::request);
    let output_list = outputs(expected.spec, expected.machine.controller.dialect, expected.design, &request);
    let entries = names::check(files, manifest.as_ref(), &output_list, &mut proof.findings);
    let mut cross = CrossChecks::default();
    for output in output_list {
        let path = output.name();
        let Some(bytes) = files.get(&path) else { continue };
        let mut findings = Findings::default();
        let hash = sha256(bytes);
        if let Some(entry) = entries.get(path.as_str()) {
            check_hash(entry, bytes, &hash, &mut findings);
        }
        let (method, deviation) = file(expected, &output, bytes, &mut cross, &mut findings);
        proof.findings.extend(findings.into_vec().into_iter().map(|finding| finding.in_file(&path)));
        proof.files.push(FileProof { path, output, by: method, sha256: hash, deviation });
    }
    let disagreements = cross.seals.disagreements(expected.spec.accuracy.path.0, &proof.findings);
    proof.findings.extend(disagreements);
    proof.findings.extend(cross.pieces.disagreements(expected.design));
    if let Some(manifest) = &manifest {
        proof.findings.extend(figures::against_design(expected, manifest));
        let text = files.get(MANIFEST).unwrap_or_default();
        proof.findings.extend(figures::check(text, manifest, expected.manifest));
    }
    proof
}

fn check_hash(entry: &ManifestFile, bytes: &[u8], sha256: &str, findings: &mut Findings) {
    if bytes.len() != entry.bytes {
        findings.add(FindingCode::Size, format!("{} bytes", bytes.len()), format!("{} bytes", entry.bytes));
    }
    if sha256 != entry.sha256 {
        findings.add(FindingCode::Hash, sha256, entry.sha256.clone());
    }
}

/// Reads one file and compares it; returns the method, and its deviation if it has geometry.
fn file(
    expected: &Expected<'_>,
    output: &Output,
    bytes: &[u8],
    cross: &mut CrossChecks,
    findings: &mut Findings,
) -> (Method, Option<f64>) {
    match (output.kind.subject(), output.kind.format()) {
        // All other files are compared with the directory's own drawing. Pictures, scenes and pages are proven by their bytes:
        // see `pipeline`.
        (Subject::Drawing, _) | (_, Format::Png | Format::Glb | Format::Pdf) => return (Method::Hash, None),
        (_, Format::Stl) => return solid(expected, output, bytes, cross, findings),
        (
            _,
            Format::Toml
            | Format::Gcode
            | Format::Package
            | Format::Svg
            | Format::Dxf
            | Format::Json
            | Format::Xml
            | Format::Html,
        ) => {}
    }
    let Some(text) = text_of(output, bytes, findings) else { return (Method::Reading, None) };
    match (output.kind.subject(), output.kind.format()) {
        (
            Subject::Spec
            | Subject::Machine
            | Subject::Drawing
            | Subject::PressPlan
            | Subject::Preview
            | Subject::Scene
            | Subject::Mjcf
            | Subject::Report,
            _,
        ) => (Method::Hash, None),
        (Subject::Prediction, _) => {
            prediction(expected, text, findings);
            (Method::Reading, None)
        }
        (Subject::Seal, Format::Gcode | Format::Package) => {
            sealing_program(expected, output, ProgramWork::Seal, text, findings)
        }
        (Subject::Trace, Format::Gcode | Format::Package) => {
            sealing_program(expected, output, ProgramWork::Trace, text, findings)
        }
        (Subject::Cut, Format::Gcode | Format::Package) => cut_program(expected, output, text, findings),
        // Every subject is named, so that a new one must be given its method of proof.
        (
            Subject::Seal
            | Subject::Trace
            | Subject::Cut
            | Subject::Outline
            | Subject::Mask
            | Subject::Pieces
            | Subject::Frame
            | Subject::Separator,
            _,
        ) => drawing(expected, output, text, cross, findings),
    }
}

/// Reads a solid and compares it.
fn solid(
    expected: &Expected<'_>,
    output: &Output,
    bytes: &[u8],
    cross: &mut CrossChecks,
    findings: &mut Findings,
) -> (Method, Option<f64>) {
    let Some(drawing) = output.drawing(expected.design) else { return (Method::Hash, None) };
    let name = output.solid_name(&expected.spec.name);
    let Some((name, thickness)) = name.zip(output.thickness(expected.spec)) else {
        return (Method::Hash, None);
    };
    let (facets, deviation) = solid::check(bytes, &drawing, &name, thickness, findings);
    cross.pieces.add(output, facets);
    (Method::Reading, Some(deviation))
}

/// Reads a program that seals or traces, and compares it.
fn sealing_program(
    expected: &Expected<'_>,
    output: &Output,
    work: ProgramWork,
    text: &str,
    findings: &mut Findings,
) -> (Method, Option<f64>) {
    let parts = (expected.spec, expected.machine, expected.design);
    let sheet = output.part.sheet().unwrap_or(0);
    let task = ProgramTask::of_pieces(parts, work, sheet, output.part.sealed());
    (Method::Reading, task.map(|task| task.check(text, findings)))
}

/// Reads a program that cuts, and compares it.
fn cut_program(
    expected: &Expected<'_>,
    output: &Output,
    text: &str,
    findings: &mut Findings,
) -> (Method, Option<f64>) {
    let Some(process) = expected.spec.cut.program else { return (Method::Hash, None) };
    let cut_spec = expected.spec.cut_by(&process);
    let sheet = output.part.sheet().unwrap_or(0);
    let task = ProgramTask::of_cut(&cut_spec, expected.machine, expected.design, process.tool, sheet);
    (Method::Reading, task.map(|task| task.check(text, findings)))
}

/// Reads a drawing and compares it. On paper the sheets must also weld as the design says, and seams are kept to be compared with those of the
/// sheet's other files.
fn drawing(
    expected: &Expected<'_>,
    output: &Output,
    text: &str,
    cross: &mut CrossChecks,
    findings: &mut Findings,
) -> (Method, Option<f64>) {
    let Some(exact) = output.drawing(expected.design) else { return (Method::Hash, None) };
    let tolerance = expected.spec.accuracy.path.0;
    let title = output.title(&expected.spec.name);
    let read_drawing = match output.kind.format() {
        Format::Svg => drawings::read_page(text, &exact, &title, expected.spec, findings),
        Format::Toml
        | Format::Gcode
        | Format::Package
        | Format::Dxf
        | Format::Pdf
        | Format::Stl
        | Format::Json
        | Format::Png
        | Format::Glb
        | Format::Xml
        | Format::Html => drawings::read_plan(text, &exact, expected.spec, findings),
    };
    let deviation = drawings::compare(&read_drawing, &exact, tolerance, findings);
    if let Some(paper) = output.part.paper() {
        welded::check(expected, &read_drawing, paper, findings);
    }
    if let (Subject::Seal, Some(sheet)) = (output.kind.subject(), output.part.sheet()) {
        cross.seals.add(sheet, &output.name(), &read_drawing);
    }
    (Method::Reading, Some(deviation))
}

/// The text of a file, or the program in a package; `None`, with a finding, if there is none.
fn text_of<'a>(output: &Output, bytes: &'a [u8], findings: &mut Findings) -> Option<&'a str> {
    if output.kind.format() == Format::Package {
        return package::program_in(bytes, findings);
    }
    let text = std::str::from_utf8(bytes);
    text.map_err(|_| findings.add(FindingCode::NotText, "bytes that are not UTF-8", "text")).ok()
}

/// The prediction made anew, against the one that was written.
fn prediction(expected: &Expected<'_>, text: &str, findings: &mut Findings) {
    let Some(right) = expected.prediction else {
        findings.add(FindingCode::Prediction, "a prediction", "none: this spec has no prediction");
        return;
    };
    // The same program gives the same bytes; another build of it may differ in the last digits.
    let [numbers, right_numbers] =
        [text, right].map(|text| serde_json::from_str::<serde_json::Value>(text).ok());
    if !numbers.zip(right_numbers).is_some_and(|(found, allowed)| alike(&found, &allowed)) {
        let problem = "other numbers than this spec gives";
        findings.add(FindingCode::Prediction, problem, "the prediction of the same spec");
    }
}
