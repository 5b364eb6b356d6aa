//! The bill of materials: parts to buy, to cut and to fill.

use serde::{Deserialize, Serialize};

/// Posts of one length.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ManifestPosts {
    /// Length of a post.
    pub length_mm: f64,
    /// Number of equal parts.
    pub count: usize,
}

/// Equal plates of the frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ManifestPlates {
    /// Their positions in the stack, 1 = bottom.
    pub plates: Vec<usize>,
    /// Height of the middle of each plate above the bottom of the lowest one.
    pub heights_mm: Vec<f64>,
    /// Radius of the opening.
    pub opening_mm: f64,
    /// Radius of the plate.
    pub radius_mm: f64,
    /// Thickness of a plate.
    pub thickness_mm: f64,
    /// Area of one plate, opening and holes left out.
    pub area_mm2: f64,
}

/// The mask of one distinct star.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ManifestMask {
    /// The first star of the stack that uses it.
    pub star: usize,
    /// All stars that use it.
    pub stars: Vec<usize>,
    /// Length of a window along the gripping edge, from the apex of a corner.
    pub extent_mm: f64,
    /// Area of one window.
    pub window_mm2: f64,
    /// Area of the plate, windows and holes left out.
    pub area_mm2: f64,
    /// Material of a printed plate.
    pub volume_mm3: f64,
    /// Estimated thickness of the drained coating, from thin to thick.
    pub coating_um: [f64; 2],
    /// The assumptions of the estimate.
    pub coating_assumes: String,
    /// Pieces of the mask on the printer's bed in the spec; absent without a bed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pieces: Vec<ManifestPiece>,
}

/// One piece of a printed mask.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ManifestPiece {
    /// Number of the piece, from 1.
    pub piece: usize,
    /// The tip that was cut off; absent for the middle and for a mask in one piece.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tip: Option<u32>,
    /// Rotation of the piece about the star's axis, counterclockwise; in a mirrored mask clockwise.
    pub turn_deg: f64,
    /// Size of the piece on the bed, along X and Y.
    pub size_mm: [f64; 2],
}
