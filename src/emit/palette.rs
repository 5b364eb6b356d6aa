//! The colour of each layer in drawings for cutters: laser programs choose by it what to cut, to engrave, and when.
//!
//! The colours are the six pure ones, which both SVG and DXF have. Red cuts everywhere; black never does, for it is a picture to
//! be engraved.

use design::Layer;
use spec::Colours;

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
    // In one colour all cuts are red, and nothing else is. In an ordered cut holes for posts and registration are blue, other holes
    // and windows magenta, outsides red.
    match (layer, colours) {
        (Layer::Seal | Layer::SealInner, Colours::One | Colours::Ordered)
        | (Layer::Label | Layer::PaperMark, Colours::One)
        | (Layer::Registration | Layer::PostHole, Colours::Ordered) => BLUE,
        (Layer::SealOuter | Layer::MaskJoint, Colours::One | Colours::Ordered) => GREEN,
        (Layer::Label | Layer::PaperMark, Colours::Ordered) => CYAN,
        (
            Layer::CutHole
            | Layer::CutValve
            | Layer::MaskWindow
            | Layer::SeparatorWindow
            | Layer::FrameOpening,
            Colours::Ordered,
        ) => MAGENTA,
        (
            Layer::CutOutside | Layer::MaskPlate | Layer::SeparatorEdge | Layer::FrameEdge,
            Colours::One | Colours::Ordered,
        )
        | (
            Layer::CutHole
            | Layer::CutValve
            | Layer::MaskWindow
            | Layer::SeparatorWindow
            | Layer::FrameOpening
            | Layer::Registration
            | Layer::PostHole,
            Colours::One,
        ) => RED,
    }
}

/// A surface of a scene, in the order of [`SURFACES`].
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum SceneSurface {
    Fabric,
    Tube,
    InnerBand,
    OuterBand,
    Cut,
    Mask,
    Plate,
    Post,
    Object,
    Measure,
}

/// The surfaces of scenes, in the order of the materials of stars, which all but the last may have. For each its name, its colour (as screens have it, red, green,
/// blue) and its opacity: below 1, surfaces behind it shine through. Fabric and tube are as in the preview, bands in colours that can be
/// distinguished.
pub(super) const SURFACES: [(SceneSurface, &str, [u8; 3], f64); 10] = [
    (SceneSurface::Fabric, "fabric", [0xdf, 0xe6, 0xee], 1.0),
    (SceneSurface::Tube, "tube", [0x9c, 0xc3, 0xe6], 1.0),
    (SceneSurface::InnerBand, "inner band", [0xe8, 0xa3, 0x3d], 1.0),
    (SceneSurface::OuterBand, "outer band", [0xd1, 0x49, 0x5b], 1.0),
    (SceneSurface::Cut, "cut", [0xc0, 0x00, 0x00], 1.0),
    (SceneSurface::Mask, "mask", [0x7f, 0xb0, 0x69], 1.0),
    (SceneSurface::Plate, "plate", [0xb0, 0xb0, 0xb0], 0.35),
    (SceneSurface::Post, "post", [0x60, 0x60, 0x60], 1.0),
    (SceneSurface::Object, "object", [0xf3, 0xdd, 0xb4], 1.0),
    (SceneSurface::Measure, "measure", [0x7b, 0x3f, 0xa0], 1.0),
];
/// Number of surfaces that a scene of stars may have.
pub(super) const STAR_SURFACES: usize = SURFACES.len() - 1;

/// A colour as lights add up: red, green, blue by IEC 61966-2-1, to four decimals.
pub(super) fn linear(color: [u8; 3]) -> [f64; 3] {
    color.map(|byte| {
        let share = f64::from(byte) / 255.0;
        let light = if share <= 0.04045 { share / 12.92 } else { libm::pow((share + 0.055) / 1.055, 2.4) };
        (light * 1e4).round() / 1e4
    })
}
