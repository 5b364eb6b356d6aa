//! A proof as JSON and as text.

use serde_json::json;

use proof::artifact::Format;
use proof::verify::Proof;

/// Findings and measured deviations, as `verify --json` prints them.
pub fn json(proof: &Proof) -> String {
    let deviation: serde_json::Map<String, serde_json::Value> =
        proof.files.iter().map(|file| (file.path.clone(), json!(file.deviation))).collect();
    let proven: Vec<serde_json::Value> =
        proof.files.iter().map(|file| json!({ "path": file.path, "by": file.by })).collect();
    let json = json!({
        "findings": proof.findings,
        "deviation_mm": deviation,
        "proven": proven,
        "written_by": proof.written_by,
        "unproven": proof.unproven,
    });
    format!("{json:#}\n")
}

/// The number of compared files, and the bounds of their deviations.
pub fn scope(proof: &Proof) -> String {
    let file_count = proof.files.len();
    let measured = proof.files.iter().filter(|file| file.deviation.is_some()).count();
    // Solids approximate arcs by chords, with a tolerance of their own.
    let deviations: Vec<String> = [
        ("lines and arcs", largest_deviation(proof, false), 6),
        ("solids", largest_deviation(proof, true), 4),
    ]
    .into_iter()
    .filter_map(|(what, mm, digits)| mm.map(|mm| format!("{what} within {mm:.digits$} mm")))
    .collect();
    if deviations.is_empty() {
        return format!("none of {file_count} files has geometry that is compared; nothing was measured");
    }
    format!("{measured} of {file_count} files compared with the exact geometry: {}", deviations.join(", "))
}

/// The largest deviation of solids, or of all other files, mm.
fn largest_deviation(proof: &Proof, is_solid: bool) -> Option<f64> {
    let files = proof.files.iter().filter(|file| (file.output.kind.format() == Format::Stl) == is_solid);
    files.filter_map(|file| file.deviation).reduce(f64::max)
}
