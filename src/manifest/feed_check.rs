//! The manifest of a feed check, which is a single file: the manifest contains the spec and the profile.

use serde::{Deserialize, Serialize};

use crate::manifest::{ManifestFile, Tool};

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
        // Plain data can always be written.
        let mut json = serde_json::to_vec_pretty(self).unwrap_or_default();
        json.push(b'\n');
        json
    }
}
