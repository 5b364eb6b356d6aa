//! Drawings: what lies on one sheet, layer by layer. Writers write them, the verifier compares files with them.

use crate::design::Design;
use crate::design::Side;
use crate::geom::Isometry;
use crate::geom::Path;
use crate::geom::Point;

/// Exact geometry in a frame whose origin is the lower left corner.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// Extent along X.
    pub width: f64,
    /// Extent along Y.
    pub height: f64,
    /// What is drawn, in order: (layer, shapes).
    pub layers: Vec<(Layer, Vec<Shape>)>,
}

/// What a shape is for. Names are part of every file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layer {
    /// Centre line of the seam around the hole.
    SealInner,
    /// Centre line of the seam outside.
    SealOuter,
    /// The cut around the part.
    CutOutside,
    /// The cut around the hole.
    CutHole,
    /// Registration holes.
    Registration,
}

impl Layer {
    /// The layer's name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::SealInner => "seal-inner",
            Self::SealOuter => "seal-outer",
            Self::CutOutside => "cut-outside",
            Self::CutHole => "cut-hole",
            Self::Registration => "registration",
        }
    }
}

/// One thing on a layer.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A path, open or closed.
    Path(Path),
    /// A full circle.
    Circle {
        /// Its centre.
        center: Point,
        /// Its radius.
        radius: f64,
    },
}

impl Drawing {
    /// The centre lines of all seams on sheet `sheet`.
    pub fn seals(design: &Design, sheet: usize) -> Option<Self> {
        let seam = |layer: Layer, side: Side| {
            let shapes = design.on_sheet(sheet).flat_map(|placed| {
                let seams = design.part(placed).seams.iter().filter(move |seam| seam.side == side);
                seams.map(|seam| Shape::Path(placed.placement.path(&seam.center_line)))
            });
            (layer, shapes.collect())
        };
        Self::on(
            design,
            sheet,
            vec![seam(Layer::SealInner, Side::Hole), seam(Layer::SealOuter, Side::Outside)],
        )
    }

    /// The cuts of all stars on sheet `sheet`, holes first, so that no part moves before its holes are made.
    pub fn outlines(design: &Design, sheet: usize) -> Option<Self> {
        let (mut holes, mut inside, mut outside) = (Vec::new(), Vec::new(), Vec::new());
        for placed in design.on_sheet(sheet) {
            let outline = &design.part(placed).outline;
            let place = |path: &Path| Shape::Path(placed.placement.path(path));
            holes.extend(
                outline.registration.iter().map(|hole| circle(&placed.placement, hole.center, hole.diameter)),
            );
            inside.push(place(&outline.hole));
            outside.push(place(&outline.outside));
        }
        let layers =
            vec![(Layer::Registration, holes), (Layer::CutHole, inside), (Layer::CutOutside, outside)];
        Self::on(design, sheet, layers)
    }

    fn on(design: &Design, sheet: usize, layers: Vec<(Layer, Vec<Shape>)>) -> Option<Self> {
        let layout = design.sheets.iter().find(|layout| layout.index == sheet)?;
        Some(Self { width: layout.width, height: layout.height, layers })
    }
}

fn circle(placement: &Isometry, center: Point, diameter: f64) -> Shape {
    Shape::Circle { center: placement.point(center), radius: diameter / 2.0 }
}
