//! The colour of each layer in drawings for cutters: laser programs choose by it what to cut, to engrave, and when.
//!
//! The colours are the six pure ones, which both SVG and DXF have. Red cuts everywhere; black never does, for it is a picture to
//! be engraved.

use crate::design::Layer;
use crate::spec::Colours;

/// A colour in the notations of the file formats.
pub(super) struct LayerColour {
    /// In SVG.
    pub(super) svg: &'static str,
    /// In DXF, by its index in AutoCAD's palette.
    pub(super) dxf: &'static str,
}

const RED: LayerColour = LayerColour { svg: "#ff0000", dxf: "1" };
const GREEN: LayerColour = LayerColour { svg: "#00ff00", dxf: "3" };
const CYAN: LayerColour = LayerColour { svg: "#00ffff", dxf: "4" };
const BLUE: LayerColour = LayerColour { svg: "#0000ff", dxf: "5" };
const MAGENTA: LayerColour = LayerColour { svg: "#ff00ff", dxf: "6" };

/// The colour of `layer`.
pub(super) fn ink(layer: Layer, colours: Colours) -> LayerColour {
    match (layer, colours) {
        (Layer::Seal | Layer::SealInner, _)
        | (Layer::Label | Layer::PaperMark, Colours::One)
        | (Layer::Registration | Layer::PostHole, Colours::Ordered) => BLUE,
        (Layer::SealOuter | Layer::MaskJoint, _) => GREEN,
        (Layer::Label | Layer::PaperMark, Colours::Ordered) => CYAN,
        (Layer::CutHole | Layer::MaskWindow | Layer::FrameOpening, Colours::Ordered) => MAGENTA,
        _ => RED,
    }
}

/// A surface of a scene.
pub(super) struct SurfaceColour {
    /// Its name in the file.
    pub(super) name: &'static str,
    /// Its colour as screens have it, red, green, blue.
    pub(super) color: [u8; 3],
    /// Its opacity: below 1, surfaces behind it shine through.
    pub(super) cover: f64,
}

/// The surfaces of a scene: fabric and tube as in the preview, bands in colours that can be distinguished.
pub(super) const SURFACES: [SurfaceColour; 9] = [
    SurfaceColour { name: "fabric", color: [0xdf, 0xe6, 0xee], cover: 1.0 },
    SurfaceColour { name: "tube", color: [0x9c, 0xc3, 0xe6], cover: 1.0 },
    SurfaceColour { name: "inner band", color: [0xe8, 0xa3, 0x3d], cover: 1.0 },
    SurfaceColour { name: "outer band", color: [0xd1, 0x49, 0x5b], cover: 1.0 },
    SurfaceColour { name: "cut", color: [0xc0, 0x00, 0x00], cover: 1.0 },
    SurfaceColour { name: "mask", color: [0x7f, 0xb0, 0x69], cover: 1.0 },
    SurfaceColour { name: "plate", color: [0xb0, 0xb0, 0xb0], cover: 0.35 },
    SurfaceColour { name: "post", color: [0x60, 0x60, 0x60], cover: 1.0 },
    SurfaceColour { name: "object", color: [0xf3, 0xdd, 0xb4], cover: 1.0 },
];

/// A surface's colour as lights add up: red, green, blue by IEC 61966-2-1, to four decimals, and how much of it is seen.
pub(super) fn linear(surface: &SurfaceColour) -> [f64; 4] {
    let [r, g, b] = surface.color.map(|byte| {
        let share = f64::from(byte) / 255.0;
        let light = if share <= 0.04045 { share / 12.92 } else { libm::pow((share + 0.055) / 1.055, 2.4) };
        (light * 1e4).round() / 1e4
    });
    [r, g, b, surface.cover]
}
