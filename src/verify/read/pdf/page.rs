//! The content of a PDF page.

use crate::verify::Drawing;
use inflatable::geom::Bounds;

/// One page of a PDF, in mm from its lower left corner.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PdfPage {
    /// Width and height.
    pub size: (f64, f64),
    /// The lines and curves, by marked content; those outside any are under "".
    pub drawing: Drawing,
    /// Layer, width in user units and grey of every stroke.
    pub strokes: Vec<(String, Option<f64>, Option<f64>)>,
    /// The operators that do not build paths, in order.
    pub operators: Vec<String>,
    /// The visible regions of every clipped layer.
    pub clips: Vec<(String, Bounds)>,
}
