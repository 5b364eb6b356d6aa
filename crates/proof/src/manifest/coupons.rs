//! The manifests of a directory of coupons and of a feed check.

use serde::{Deserialize, Serialize};

use crate::manifest::{ManifestFile, SealedPiece, Tool, json};

/// Content of `manifest.json` in a directory of coupons: the settings, and the files written.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CouponManifest {
    /// Name and version of the tool that wrote it.
    pub tool: Tool,
    /// Name of the spec.
    pub name: String,
    /// Settings and kinds of coupons: with spec and profile they determine all files.
    pub coupons: CouponChoice,
    /// All files beside the manifest and the table to fill in.
    pub files: Vec<ManifestFile>,
    /// Every program with its seams.
    pub pieces: Vec<SealedPiece>,
}

/// The settings of the strips, and the groups of coupons.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CouponChoice {
    /// Temperatures of the iron, or of the plates; none of a laser.
    #[serde(rename = "temperatures_C")]
    pub temperatures: Vec<f64>,
    /// Powers of a laser, parts of its full power; absent for an iron and a press.
    #[serde(rename = "powers_percent", default, skip_serializing_if = "Vec::is_empty")]
    pub powers: Vec<f64>,
    /// Speeds of the tool.
    #[serde(rename = "speeds_mm_s")]
    pub speeds: Vec<f64>,
    /// Heights of the tip in contact, or of a laser's focus.
    #[serde(rename = "heights_mm")]
    pub heights: Vec<f64>,
    /// Times of a press, s; absent for an iron.
    #[serde(rename = "times_s", default, skip_serializing_if = "Vec::is_empty")]
    pub times: Vec<f64>,
    /// Number of seals with each setting.
    pub repeats: usize,
    /// Kinds of coupons: "strips", "disc", "v-actuator", "burst".
    pub only: Vec<String>,
    /// Process by which they are sealed; absent for the one of `[seal]`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub process: Option<String>,
}

impl CouponManifest {
    /// The manifest as the bytes of `manifest.json`.
    pub fn to_json(&self) -> Vec<u8> {
        json(self)
    }
}

/// The suffix that turns the program's name into that of its manifest.
pub const FEED_CHECK_MANIFEST: &str = ".manifest.json";

/// Content of `feedcheck.gcode.manifest.json`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FeedCheckManifest {
    /// Name and version of the tool that wrote it.
    pub tool: Tool,
    /// Name of the spec.
    pub name: String,
    /// Text of the spec.
    pub spec: String,
    /// Text of the machine profile.
    pub machine: String,
    /// The program.
    pub files: Vec<ManifestFile>,
}

impl FeedCheckManifest {
    /// The manifest as bytes.
    pub fn to_json(&self) -> Vec<u8> {
        json(self)
    }
}
