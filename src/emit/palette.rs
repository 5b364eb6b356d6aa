//! The colour of each layer in drawings for cutters: laser programs tell by it what to cut, to engrave, and when.
//!
//! One of the six that are pure, which SVG and DXF both can say. Red cuts everywhere; black never does, for it is a
//! picture to be engraved.

use crate::design::Layer;
use crate::spec::Colours;

/// A colour as files say it.
pub(super) struct Ink {
    /// In SVG.
    pub(super) svg: &'static str,
    /// In DXF, by its index in AutoCAD's palette.
    pub(super) dxf: &'static str,
}

const RED: Ink = Ink { svg: "#ff0000", dxf: "1" };
const GREEN: Ink = Ink { svg: "#00ff00", dxf: "3" };
const CYAN: Ink = Ink { svg: "#00ffff", dxf: "4" };
const BLUE: Ink = Ink { svg: "#0000ff", dxf: "5" };
const MAGENTA: Ink = Ink { svg: "#ff00ff", dxf: "6" };

/// The colour of `layer`.
pub(super) fn ink(layer: Layer, colours: Colours) -> Ink {
    match (layer, colours) {
        (Layer::SealInner, _)
        | (Layer::Label | Layer::PaperMark, Colours::One)
        | (Layer::Registration | Layer::PostHole, Colours::Ordered) => BLUE,
        (Layer::SealOuter | Layer::MaskJoint, _) => GREEN,
        (Layer::Label | Layer::PaperMark, Colours::Ordered) => CYAN,
        (Layer::CutHole | Layer::MaskWindow | Layer::FrameOpening, Colours::Ordered) => MAGENTA,
        _ => RED,
    }
}
