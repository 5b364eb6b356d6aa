//! The manifest's figures and names against those of the design, every one of them.

use serde_json::Value;

use crate::manifest::{MANIFEST, Manifest};
use crate::verify::finding::quote;
use crate::verify::judge::expected::Expected;
use crate::verify::{Finding, FindingCode};
use design::{FlatPiece, StarAssembly};
use spec::Spec;

/// Reports every value in the text of the manifest `manifest` that differs from `right`, whose list of files is not compared.
pub(super) fn check(text: &[u8], manifest: &Manifest, right: &Manifest) -> Vec<Finding> {
    // The list of files and their kinds is judged by their names; another version may have written them.
    let tool = crate::manifest::Tool { version: manifest.tool.version.clone(), ..right.tool.clone() };
    let Manifest { files, only: only_kinds, with: with_kinds, .. } = manifest.clone();
    // The predictions of another version are not judged here; `prediction.json` is judged by itself.
    let is_same_version = manifest.tool.version == right.tool.version;
    let prediction = if is_same_version { right.prediction.clone() } else { manifest.prediction.clone() };
    // Older versions wrote no pieces.
    let pieces =
        if is_same_version || !manifest.pieces.is_empty() { right.pieces.clone() } else { Vec::new() };
    let right =
        Manifest { tool, files, pieces, prediction, only: only_kinds, with: with_kinds, ..right.clone() };
    let mut findings = Vec::new();
    if let (Ok(actual), Ok(right)) = (serde_json::from_slice::<Value>(text), serde_json::to_value(&right)) {
        compare("", Some(&actual), Some(&right), &mut findings);
    }
    findings
}

/// A finding about the manifest.
pub(super) fn wrong(fault: impl Into<String>, allowed: impl Into<String>) -> Finding {
    Finding::new(FindingCode::Manifest, fault, allowed).in_file(MANIFEST)
}

/// Compares two values at `place`.
fn compare(place: &str, actual: Option<&Value>, right: Option<&Value>, findings: &mut Vec<Finding>) {
    match (actual, right) {
        (Some(Value::Object(a)), Some(Value::Object(b))) => {
            let keys = b.keys().chain(a.keys().filter(|key| !b.contains_key(*key)));
            for key in keys {
                let dot = if place.is_empty() { "" } else { "." };
                compare(&format!("{place}{dot}{key}"), a.get(key), b.get(key), findings);
            }
        }
        (Some(Value::Array(a)), Some(Value::Array(b))) => {
            for i in 0..a.len().max(b.len()) {
                compare(&format!("{place}[{i}]"), a.get(i), b.get(i), findings);
            }
        }
        (Some(Value::Number(a)), Some(Value::Number(b))) if a.as_f64() == b.as_f64() => {}
        (a, b) if a == b => {}
        (a, b) => {
            findings.push(wrong(format!("{place}: {}", value_text(a)), value_text(b)));
        }
    }
}

fn value_text(value: Option<&Value>) -> String {
    value.map_or("nothing".to_owned(), |value| quote(&value.to_string()))
}

/// Reports the figures that are not those of the exact geometry, whatever the writer of manifests makes of it.
pub(super) fn against_design(expected: &Expected<'_>, manifest: &Manifest) -> Vec<Finding> {
    let mut findings = Vec::new();
    for placed in expected.design.placed() {
        let part = expected.design.part(placed);
        let (name, seams) = (placed.name(), &part.shape().seams);
        let seam_mm = part.sealed_length(expected.spec);
        // Older versions wrote no pieces.
        if let Some(piece) = manifest.pieces.iter().find(|piece| piece.name == name.word()) {
            let length: f64 = piece.seams.iter().map(|seam| seam.length_mm).sum();
            // Each length is written in whole micrometres.
            let slack = 0.001 * f64::from(10 + u32::try_from(seams.len()).unwrap_or(u32::MAX - 10));
            if (length - seam_mm).abs() > slack || piece.seams.len() != seams.len() {
                let fault = format!("{name}: {length} mm in {} seams", piece.seams.len());
                findings.push(wrong(fault, format!("{seam_mm:.3} mm in {}", seams.len())));
            }
        } else if expected.design.assembly().is_none() {
            findings.push(wrong(format!("no {name}"), "every piece of the design"));
        }
    }
    if let Some(assembly) = expected.design.assembly() {
        findings.extend(against_assembly(expected.spec, assembly, manifest));
    }
    findings
}

/// Compares with the design the figures that only a gripper of stars has.
///
/// Each star is found by its number and must have its seams' length, its sheet and its clear radius. Posts and plates are
/// counted, since the manifest lists equal ones together.
fn against_assembly(spec: &Spec, design: &StarAssembly, manifest: &Manifest) -> Vec<Finding> {
    let mut findings = Vec::new();
    for placed in &design.stars {
        let seam_mm = FlatPiece::Star(design.part(placed)).sealed_length(spec);
        match manifest.stars.iter().find(|star| star.index == placed.index) {
            Some(star) if (star.seam_mm - seam_mm).abs() <= 0.01 && star.sheet == placed.sheet => {
                let clear = design.part(placed).clear_radius();
                if (star.clear_radius_mm - clear).abs() > 0.001 {
                    let fault = format!("star {}: a clear radius of {} mm", star.index, star.clear_radius_mm);
                    findings.push(wrong(fault, format!("{clear:.3} mm")));
                }
            }
            Some(star) => findings.push(wrong(
                format!("star {}: {} mm of seam on sheet {}", star.index, star.seam_mm, star.sheet),
                format!("{seam_mm:.3} mm on sheet {}", placed.sheet),
            )),
            None => findings.push(wrong(format!("no star {}", placed.index), "every star of the design")),
        }
    }
    let frame = &design.frame;
    let posts: usize = manifest.posts.iter().map(|posts| posts.count).sum();
    let lengths = manifest.posts.iter().map(|posts| (posts.length_mm - frame.post_length).abs());
    if posts != frame.posts.len() || lengths.fold(0.0, f64::max) > 0.001 {
        let allowed = format!("{} of {:.3} mm", frame.posts.len(), frame.post_length);
        findings.push(wrong(format!("posts {:?}", manifest.posts), allowed));
    }
    let plates: usize = manifest.plates.iter().map(|plates| plates.plates.len()).sum();
    if plates != design.stars.len() + 1 {
        findings.push(wrong(format!("{plates} plates"), format!("{}", design.stars.len() + 1)));
    }
    findings
}

/// Whether two JSON values are equal, numbers to one in 10^9.
pub(super) fn alike(a: &Value, b: &Value) -> bool {
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
