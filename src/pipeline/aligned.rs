//! Programs for a sheet that was taken off and found again by its marks: those of a published build, turned and shifted.

use crate::manifest::{MANIFEST, Manifest};
use crate::pipeline::directory::sources_of;
use crate::pipeline::proven::prove_files;
use crate::pipeline::{AlignedFault, Planned, Proven, Sources};
use forecast::drawn::Watch;
use geom::{Point, Vec2};
use proof::artifact::{Kind, KindRequest};
use proof::verify::OutputFiles;

/// The kinds that are turned with the sheet.
const PROGRAMS: [Kind; 6] =
    [Kind::TraceGcode, Kind::Trace3mf, Kind::SealGcode, Kind::Seal3mf, Kind::CutGcode, Kind::Cut3mf];

/// The build whose programs are those of the published `files`, turned and shifted to a sheet whose marks were found at `measured`.
///
/// # Errors
/// If the files are not proven, or the sheet cannot be aligned: see [`AlignedFault`].
pub fn align(
    files: &OutputFiles<'_>,
    sheet: Option<usize>,
    measured: [Point; 2],
) -> Result<Proven, AlignedFault> {
    let proof = prove_files(files);
    if let Some(finding) = proof.findings.first() {
        return Err(AlignedFault::NotABuild(finding.to_string()));
    }
    let manifest = files.get(MANIFEST).and_then(|bytes| serde_json::from_slice::<Manifest>(bytes).ok());
    let (Some(manifest), None, Some(spec), Some(machine)) =
        (manifest, proof.written_by, text_of(files, "spec.toml"), text_of(files, "machine.toml"))
    else {
        return Err(AlignedFault::NotABuild("another version, or another command, wrote it".to_owned()));
    };
    if manifest.aligned.is_some() {
        return Err(AlignedFault::Twice);
    }
    let kinds = PROGRAMS.into_iter().filter(|kind| manifest.files.iter().any(|file| file.kind == *kind));
    let kinds: Vec<Kind> = kinds.collect();
    if kinds.is_empty() {
        return Err(AlignedFault::NoPrograms);
    }
    let (reading, profile) = sources_of(files).map_err(|findings| {
        AlignedFault::NotABuild(findings.first().map_or_else(String::new, ToString::to_string))
    })?;
    // The machine shows its own coordinates, and the sheet may have a place in them.
    let [x, y, _] = profile.controller.place.shift();
    let measured = measured.map(|mark| mark - Vec2::new(x, y));
    let planned = Planned::aligned(reading.spec, profile, sheet, measured)?;
    let forecast = planned.forecast(&Watch::default()).map_err(AlignedFault::Refused)?;
    let built = forecast.build(Sources { spec, machine }, &KindRequest::exactly(&kinds));
    built.prove().map_err(AlignedFault::Unproven)
}

/// The text of the file `name` among `files`.
fn text_of<'f>(files: &'f OutputFiles<'_>, name: &str) -> Option<&'f str> {
    files.get(name).and_then(|bytes| std::str::from_utf8(bytes).ok())
}
