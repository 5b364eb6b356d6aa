//! Programs for a sheet that was taken off and found again by its marks: those of a published build, turned and shifted.

use std::fmt;

use crate::manifest::{MANIFEST, Manifest};
use crate::pipeline::directory::sources_of;
use crate::pipeline::proven::prove_files;
use crate::pipeline::{Planned, Proven, Sources, planned, refused};
use design::{AlignmentFault, Design, Refusals};
use forecast::drawn::Watch;
use geom::{Point, Vec2};
use proof::artifact::{Kind, KindRequest};
use proof::verify::{Finding, OutputFiles};
use spec::{Machine, Spec};

/// The kinds that are turned with the sheet.
const PROGRAMS: [Kind; 3] = [Kind::TraceGcode, Kind::SealGcode, Kind::CutGcode];

/// The reason for which a sheet that was found again has no programs.
#[derive(Clone, Debug, PartialEq)]
pub enum AlignedFault {
    /// The directory is no build of this version as it was published.
    NotABuild(String),
    /// The directory has programs for a sheet that was found again.
    Twice,
    /// The directory has no programs.
    NoPrograms,
    /// There are several sheets, this many, and none is named.
    WhichSheet(usize),
    /// The marks do not fit the sheet.
    Marks(AlignmentFault),
    /// The machine cannot run the programs there.
    Refused(Refusals),
    /// The programs would be wrong: a fault of this program.
    Unproven(Vec<Finding>),
}

impl fmt::Display for AlignedFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotABuild(fault) => {
                write!(f, "this is not a build as `build` of this version publishes it: {fault}")
            }
            Self::Twice => {
                f.write_str("its sheet was aligned already: align the build from which it was made")
            }
            Self::NoPrograms => {
                f.write_str("it has no programs: build it with seal-gcode, trace-gcode or cut-gcode")
            }
            Self::WhichSheet(number) => {
                write!(
                    f,
                    "it has {number} sheets: name the one that lies on the machine, --sheet 1 to --sheet {number}"
                )
            }
            Self::Marks(fault) => write!(f, "{fault}"),
            Self::Refused(refusals) => write!(f, "{refusals}"),
            Self::Unproven(findings) => {
                let first = findings.first().map_or_else(String::new, ToString::to_string);
                write!(f, "the programs were not written, because they would be wrong: {first}")
            }
        }
    }
}

impl Planned {
    /// The programs for a sheet, the only one if none is named, whose marks were found at `measured`.
    ///
    /// # Errors
    /// All reasons of [`Self::new`], or why the sheet cannot be aligned.
    pub fn aligned(
        spec: Spec,
        machine: Machine,
        sheet: Option<usize>,
        measured: [Point; 2],
    ) -> Result<Self, AlignedFault> {
        let design = Design::new(&spec, &machine)
            .map_err(|refusals| AlignedFault::Refused(refused::refused(&spec, &machine, refusals)))?;
        let number = design.sheets.len();
        let sheet = sheet.or((number == 1).then_some(1)).ok_or(AlignedFault::WhichSheet(number))?;
        let alignment = design.alignment(sheet, measured).map_err(AlignedFault::Marks)?;
        planned::planned(spec, machine, design.aligned(&alignment)).map_err(AlignedFault::Refused)
    }
}

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
    let text = |name| files.get(name).and_then(|bytes| std::str::from_utf8(bytes).ok());
    let manifest = files.get(MANIFEST).and_then(|bytes| serde_json::from_slice::<Manifest>(bytes).ok());
    let (Some(manifest), None, Some(spec), Some(machine)) =
        (manifest, proof.written_by, text("spec.toml"), text("machine.toml"))
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
