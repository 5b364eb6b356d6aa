//! How each layer looks, by which people and machines tell what to do with a line.

use crate::design::Layer;

/// How a layer looks in each format.
pub(in crate::verify) struct Look {
    /// Colour of the strokes in SVG.
    pub(in crate::verify) svg: &'static str,
    /// Colour in DXF, of AutoCAD's palette.
    pub(in crate::verify) dxf: &'static str,
    /// Width, mm, and grey of the strokes on paper.
    pub(in crate::verify) pen: (f64, f64),
}

/// The look of `layer`.
pub(in crate::verify) fn look(layer: Layer) -> Look {
    let (svg, dxf, pen) = match layer {
        Layer::SealInner => ("#0000ff", "5", (0.1, 0.0)),
        Layer::SealOuter => ("#008000", "3", (0.1, 0.0)),
        Layer::CutOutside | Layer::MaskPlate | Layer::FrameEdge => ("#ff0000", "1", (0.1, 0.0)),
        Layer::CutHole | Layer::MaskWindow | Layer::FrameOpening => ("#ff00ff", "6", (0.1, 0.0)),
        Layer::Registration | Layer::PostHole => ("#000000", "7", (0.1, 0.0)),
        Layer::Label => ("#00a0a0", "4", (0.25, 0.5)),
        Layer::PaperMark => ("#00a0a0", "4", (0.15, 0.0)),
    };
    Look { svg, dxf, pen }
}

/// A title as files hold it: 120 characters at most, and `_` for all but letters and digits of ASCII, blanks and `. , - _ + = : /`.
pub(in crate::verify) fn in_file(title: &str, most: usize) -> String {
    let known = |c: char| c.is_ascii_alphanumeric() || " .,-_+=:/".contains(c);
    title.chars().take(most).map(|c| if known(c) { c } else { '_' }).collect()
}
