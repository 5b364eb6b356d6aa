//! What a page of a PDF says.

use crate::verify::Drawing;
use inflatable::geom::Bounds;

/// One page of a PDF, in mm from its lower left corner.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PdfPage {
    /// Width and height.
    pub size: (f64, f64),
    /// What is drawn, by marked content; outside any it stands under "".
    pub drawing: Drawing,
    /// Layer, width in user units and grey of every stroke.
    pub strokes: Vec<(String, Option<f64>, Option<f64>)>,
    /// The operators that are no parts of paths, in order.
    pub operators: Vec<String>,
    /// Of every layer that is clipped the regions that stay visible.
    pub clips: Vec<(String, Bounds)>,
}
