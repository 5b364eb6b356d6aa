//! The manifest: a list of a build's files, for `verify` and for scripts.

mod bill;
mod coupons;
mod predicted;

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::artifact::{Artifact, Format, Kind, KindRequest, NGC, Output, OutputPart};
use design::{Alignment, Paper};
use geom::Point;

pub use bill::{ManifestMask, ManifestPiece, ManifestPlates, ManifestPosts};
pub use coupons::{CouponChoice, CouponManifest, FEED_CHECK_MANIFEST, FeedCheckManifest};
pub use predicted::{ManifestPrediction, ManifestStarPrediction};
pub use spec::digest::sha256;

/// The manifest's file name in an output directory.
pub const MANIFEST: &str = "manifest.json";

/// Content of `manifest.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Name and version of the tool that wrote it.
    pub tool: Tool,
    /// The design's name in the spec.
    pub name: String,
    /// All files beside the manifest.
    pub files: Vec<ManifestFile>,
    /// Every piece with its seams, in the order of the programs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pieces: Vec<SealedPiece>,
    /// Every star, bottom to top.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stars: Vec<ManifestStar>,
    /// The cut of every sheet on the machine; absent without a tool for it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cuts: Vec<ManifestCut>,
    /// The marks of a sheet that was found again, and whose programs these are; absent for a sheet where it was laid out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub aligned: Option<ManifestAlignment>,
    /// The frame's posts.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub posts: Vec<ManifestPosts>,
    /// The frame's plates.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub plates: Vec<ManifestPlates>,
    /// The coating masks.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub masks: Vec<ManifestMask>,
    /// Fabric of all pieces, both sheets of each.
    #[serde(default)]
    pub fabric_mm2: f64,
    /// Mass of the gripper, if the areal density is given: that of the whole stack, `stack_mass_g` of a prediction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass_g: Option<f64>,
    /// Prediction at the pressure of `[load]`; absent without one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub prediction: Option<ManifestPrediction>,
    /// The only requested kinds; absent if all default kinds were made.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub only: Vec<Kind>,
    /// The additional kinds that were requested; absent without any.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub with: Vec<Kind>,
}

/// Length and time of the cuts of one sheet.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ManifestCut {
    /// Number of the sheet.
    pub sheet: usize,
    /// Path of the cutting point, overlaps included, mm.
    pub length_mm: f64,
    /// Time of the program without heating and pauses, s.
    pub time_s: f64,
}

/// A sheet that was found again by its marks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ManifestAlignment {
    /// Number of the sheet.
    pub sheet: usize,
    /// The place of its first mark, mm.
    pub mark1: [f64; 2],
    /// The place of its second mark, mm.
    pub mark2: [f64; 2],
}

impl ManifestAlignment {
    /// The record of `alignment`.
    pub fn new(alignment: &Alignment) -> Self {
        let [mark1, mark2] = alignment.measured.map(|mark| [mark.x, mark.y]);
        Self { sheet: alignment.sheet, mark1, mark2 }
    }

    /// The places of its marks.
    pub fn measured(&self) -> [Point; 2] {
        [self.mark1, self.mark2].map(|[x, y]| Point::new(x, y))
    }
}

/// How a seam is made where it is not sealed once by the process of `[seal]`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SeamMaking {
    /// Name of its process; absent for the one of `[seal]`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub process: Option<String>,
    /// Number of passes along every line; absent for one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub passes: Option<u32>,
    /// Number of lines of its band; absent for one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lines: Option<u32>,
}

/// The program that wrote a manifest.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tool {
    /// Name of the program.
    pub name: String,
    /// Version of the program.
    pub version: String,
}

/// One file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ManifestFile {
    /// Name in the directory.
    pub path: String,
    /// Kind of the file.
    pub kind: Kind,
    /// Length in bytes.
    pub bytes: usize,
    /// SHA-256 of the content, lower-case hexadecimal.
    pub sha256: String,
    /// The sheet it belongs to.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sheet: Option<usize>,
    /// The star it belongs to.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub star: Option<usize>,
    /// The drawn piece that it belongs to, by its number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub copy: Option<usize>,
    /// The lowest plate of the frame that uses it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plate: Option<usize>,
    /// The number of its piece of a printed mask, from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub piece: Option<usize>,
    /// The sheet of paper whose separators it shows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub paper_sheet: Option<usize>,
    /// The paper that it is laid out for; absent for one page as large as the drawing needs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub paper: Option<Paper>,
    /// Whether it is mirrored, for the face that the iron does not touch.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub mirrored: bool,
    /// Whether it is for the sheet of fabric that has the valves.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub valves: bool,
}

/// Length and time of one star's seams.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ManifestStar {
    /// Number of the star, 1 = bottom.
    pub index: usize,
    /// Number of its sheet.
    pub sheet: usize,
    /// Path of the iron in contact, overlaps included, mm.
    pub seam_mm: f64,
    /// Time of the iron in contact, ramps included, s.
    pub time_s: f64,
    /// Radius around the axis that the hole-side flap leaves free.
    #[serde(default)]
    pub clear_radius_mm: f64,
    /// Fabric of both sheets.
    #[serde(default)]
    pub fabric_mm2: f64,
    /// Mass of the star, if the areal density is given: `mass_g` of this star in a prediction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass_g: Option<f64>,
    /// The star's seams, loop by loop.
    pub seams: Vec<ManifestSeam>,
}

/// Length and time of one seam.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ManifestSeam {
    /// "inner" or "outer".
    #[serde(rename = "loop")]
    pub loop_name: String,
    /// Path in contact, overlap included, mm.
    pub length_mm: f64,
    /// Path covered twice, mm.
    pub overlap_mm: f64,
    /// Time in contact, ramps included, s.
    pub time_s: f64,
    /// The process that makes it, and how often.
    #[serde(flatten)]
    pub making: SeamMaking,
}

impl Tool {
    /// This program, in this version.
    pub fn current() -> Self {
        Self { name: spec::PROGRAM.to_owned(), version: env!("CARGO_PKG_VERSION").to_owned() }
    }
}

impl Manifest {
    /// The requested kinds.
    pub fn request(&self) -> KindRequest {
        KindRequest { only: self.only.clone(), with: self.with.clone() }
    }

    /// The manifest as the bytes of `manifest.json`.
    pub fn to_json(&self) -> Vec<u8> {
        json(self)
    }
}

/// A manifest, whose fields can all be written as JSON, as the bytes of its file.
fn json(manifest: &impl Serialize) -> Vec<u8> {
    let mut json = serde_json::to_vec_pretty(manifest).expect("plain data");
    json.push(b'\n');
    json
}

impl ManifestFile {
    /// The entry of one artifact.
    pub fn new(artifact: &Artifact) -> Self {
        Self::with_hash(artifact, sha256(&artifact.bytes))
    }

    /// The entry of one artifact, with a hash of the content that has been computed already.
    pub fn with_hash(artifact: &Artifact, sha256: String) -> Self {
        let Output { kind, part, tile, paper, mirrored, valves, .. } = artifact.output;
        Self {
            path: artifact.name.clone(),
            kind,
            bytes: artifact.bytes.len(),
            sha256,
            sheet: part.sheet(),
            star: part.star(),
            copy: part.piece(),
            plate: part.plate(),
            piece: tile,
            paper_sheet: part.paper(),
            paper: paper.filter(|paper| paper.name().is_some()),
            mirrored,
            valves,
        }
    }

    /// The file's kind and part, from its entry.
    pub fn output(&self) -> Output {
        let Self { kind, sheet, star, copy, plate, piece: tile, paper, mirrored, valves, .. } = *self;
        let part = match (self.paper_sheet, star, copy, plate, sheet) {
            (Some(paper), ..) => OutputPart::Paper(paper),
            (None, Some(star), ..) => OutputPart::Star { star, sheet },
            (None, None, Some(piece), ..) => OutputPart::Piece { piece, sheet },
            (None, None, None, Some(plate), _) => OutputPart::Plate(plate),
            (None, None, None, None, Some(sheet)) => OutputPart::Sheet(sheet),
            (None, None, None, None, None) => OutputPart::Design,
        };
        let is_printed = kind.format() == Format::Pdf && kind != Kind::PressPlan;
        let paper = if is_printed { paper.or(Some(Paper::Large)) } else { paper };
        let ngc = Path::new(&self.path).extension().is_some_and(|ending| ending == NGC);
        Output { kind, part, tile, paper, mirrored, valves, ngc }
    }
}

/// A piece with its seams.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SealedPiece {
    /// Name of the piece: "star-1", "disc".
    pub name: String,
    /// The product: "star", "piece" of a drawing, or "coupon".
    pub kind: String,
    /// Time of its program without heating and pauses, s; absent without a program of its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_s: Option<f64>,
    /// Seams of the piece, in the order of sealing.
    pub seams: Vec<SealedSeam>,
}

/// A seam of a piece.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SealedSeam {
    /// Name of the seam: "inner"; for a coupon the name of its piece, "strip-7".
    pub name: String,
    /// Path in contact, overlap included, mm.
    pub length_mm: f64,
    /// Time in contact, ramps included, s.
    pub time_s: f64,
    /// The process that makes it, and how often.
    #[serde(flatten)]
    pub making: SeamMaking,
}
