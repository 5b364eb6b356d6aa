//! A piece by a person's own drawing, in the drawing's frame.

use crate::design::PlacedPart;
use crate::shape::SealedShape;
use inflatable::geom::Path;

/// A passage narrower than this is warned of, mm: the least that makers report to inflate well.
const LEAST_PASSAGE: f64 = 15.0;

/// A drawn piece, and its copies on sheets.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnPiece {
    /// Seams, cut and ports.
    pub shape: SealedShape,
    /// The edges of the air as drawn.
    pub edges: Vec<Path>,
    /// Regions that hold the air, to the middle of the bands around them.
    pub tube: Vec<Path>,
    /// The piece's own edges.
    pub part: DrawnCut,
    /// The lines that a tool follows to cut it.
    pub tool: DrawnCut,
    /// Width of the narrowest passage, mm; `None` where none is narrower than 15 mm.
    pub passage: Option<f64>,
    /// What was resolved or mended as the drawing was read, a sentence each.
    pub notes: Vec<String>,
    /// Its copies where they lie.
    pub copies: Vec<PlacedPart>,
}

/// Where a drawn piece is cut, closed and counterclockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnCut {
    /// Around the piece.
    pub outside: Path,
    /// Out of the piece.
    pub inside: Vec<Path>,
    /// Width of the cut, mm.
    pub kerf: f64,
}

impl DrawnPiece {
    /// Width of the tube by which labels are sized, mm.
    pub fn label_width(&self) -> f64 {
        self.passage.unwrap_or(LEAST_PASSAGE)
    }
}
