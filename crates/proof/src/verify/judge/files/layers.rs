//! The style of each layer, by which people and machines choose the action for a line.

use design::Layer;
use spec::Colours;

/// The style of a layer on a screen.
pub(super) struct LayerStyle {
    /// Colour of the strokes in SVG.
    pub(super) svg: &'static str,
    /// Colour in DXF, of AutoCAD's palette.
    pub(super) dxf: &'static str,
}

/// The look of `layer` where all cuts have one colour, or each its own.
pub(super) fn look(layer: Layer, colours: Colours) -> LayerStyle {
    const BLUE: (&str, &str) = ("#0000ff", "5");
    const CYAN: (&str, &str) = ("#00ffff", "4");
    const GREEN: (&str, &str) = ("#00ff00", "3");
    const MAGENTA: (&str, &str) = ("#ff00ff", "6");
    const RED: (&str, &str) = ("#ff0000", "1");
    let (single, ordered) = match layer {
        Layer::Seal | Layer::SealInner => (BLUE, BLUE),
        Layer::SealOuter | Layer::MaskJoint => (GREEN, GREEN),
        Layer::CutOutside | Layer::MaskPlate | Layer::SeparatorEdge | Layer::FrameEdge => (RED, RED),
        Layer::CutHole
        | Layer::CutValve
        | Layer::MaskWindow
        | Layer::SeparatorWindow
        | Layer::FrameOpening => (RED, MAGENTA),
        Layer::Registration | Layer::PostHole => (RED, BLUE),
        Layer::Label | Layer::PaperMark => (BLUE, CYAN),
    };
    let (svg, dxf) = if colours == Colours::One { single } else { ordered };
    LayerStyle { svg, dxf }
}

/// A title as files hold it: 120 characters at most, and `_` for all but letters and digits of ASCII, blanks and `. , - _ + = : /`.
pub(super) fn in_file(title: &str, limit: usize) -> String {
    title.chars().take(limit).map(|c| if is_plain(c) { c } else { '_' }).collect()
}

fn is_plain(c: char) -> bool {
    c.is_ascii_alphanumeric() || " .,-_+=:/".contains(c)
}
