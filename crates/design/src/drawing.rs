//! Drawings: the content of one sheet, or the cut of one plate, layer by layer. Writers write them, the verifier compares files
//! with them.

use std::borrow::Cow;
use std::f64::consts::TAU;

use crate::{
    Circle, CutEdge, Design, DrawnPiece, FlatPiece, Plate, Product, Side, StarAssembly, label, lettering,
};
use geom::{Arc, Bounds, Isometry, Path, Point};

/// Exact geometry on a page.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// The origin of the drawing's frame.
    pub origin: Origin,
    /// Extent along X.
    pub width: f64,
    /// Extent along Y.
    pub height: f64,
    /// The content, in order: (layer, shapes).
    pub layers: Vec<(Layer, Vec<Shape>)>,
}

/// The place of a drawing's origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Origin {
    /// At the page's lower left corner.
    LowerLeft,
    /// On the star's axis, or where a drawing has it; the page's lower left corner lies at this point.
    Axis(Point),
}

/// The purpose of a shape. Names are part of every file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layer {
    /// Centre lines of all seams of a piece other than a star.
    Seal,
    /// Centre line of the seam around the hole.
    SealInner,
    /// Centre line of the seam outside.
    SealOuter,
    /// The cut around the part.
    CutOutside,
    /// The cut around the hole.
    CutHole,
    /// The holes of valves, in one sheet of fabric only.
    CutValve,
    /// Registration holes.
    Registration,
    /// Text on a part, which is written and not cut.
    Label,
    /// The openings of a mask.
    MaskWindow,
    /// The edge of a mask.
    MaskPlate,
    /// The openings of a separator.
    SeparatorWindow,
    /// The edge of a separator.
    SeparatorEdge,
    /// The joint of two pieces of a printed mask.
    MaskJoint,
    /// The holes for the frame's posts.
    PostHole,
    /// The opening of a frame's plate.
    FrameOpening,
    /// The edge of a frame's plate.
    FrameEdge,
    /// Crop and registration marks, ruler, check square and page name on paper.
    PaperMark,
}

impl Layer {
    /// The layer's name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Seal => "seal",
            Self::SealInner => "seal-inner",
            Self::SealOuter => "seal-outer",
            Self::CutOutside => "cut-outside",
            Self::CutHole => "cut-hole",
            Self::CutValve => "cut-valve",
            Self::Registration => "registration",
            Self::Label => "label",
            Self::MaskWindow => "mask-window",
            Self::MaskPlate => "mask-plate",
            Self::SeparatorWindow => "separator-window",
            Self::SeparatorEdge => "separator-edge",
            Self::MaskJoint => "mask-joint",
            Self::PostHole => "post-hole",
            Self::FrameOpening => "frame-opening",
            Self::FrameEdge => "frame-edge",
            Self::PaperMark => "paper-mark",
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
        /// Centre of the circle.
        center: Point,
        /// Radius of the circle.
        radius: f64,
    },
    /// Paths that make one mark, such as the strokes of a label.
    Figure(Vec<Path>),
}

impl Shape {
    /// `path` moved by `motion`.
    pub(super) fn moved_path(path: &Path, motion: &Isometry) -> Self {
        Self::Path(motion.path(path))
    }

    /// The paths as one mark; `None` without paths.
    pub fn figure(paths: Vec<Path>) -> Option<Self> {
        (!paths.is_empty()).then_some(Self::Figure(paths))
    }

    /// The paths of the shape, pen down to pen up; a circle is one whole turn.
    pub fn paths(&self) -> Cow<'_, [Path]> {
        match self {
            Self::Path(path) => std::slice::from_ref(path).into(),
            Self::Circle { center, radius } => {
                vec![Path::closed(vec![Arc::new(*center, *radius, 0.0, TAU).into()])].into()
            }
            Self::Figure(paths) => paths.as_slice().into(),
        }
    }

    /// The shape without the paths of a figure that lie outside `window`; `None` if the whole shape does.
    pub fn clipped(self, window: &Bounds) -> Option<Self> {
        match self {
            Self::Figure(mut paths) => {
                paths.retain(|path| path.bounds().overlaps(window));
                Self::figure(paths)
            }
            shape => shape.bounds().overlaps(window).then_some(shape),
        }
    }

    /// Smallest axis-parallel box around the shape.
    pub fn bounds(&self) -> Bounds {
        match self {
            Self::Path(path) => path.bounds(),
            Self::Circle { center, radius } => Bounds::of_points([*center]).outset(*radius),
            Self::Figure(paths) => paths.iter().map(Path::bounds).fold(Bounds::EMPTY, Bounds::union),
        }
    }

    /// The image of the shape.
    pub fn moved(&self, motion: &Isometry) -> Self {
        match self {
            Self::Path(path) => Self::Path(motion.path(path)),
            Self::Circle { center, radius } => {
                Self::Circle { center: motion.point(*center), radius: *radius }
            }
            Self::Figure(paths) => Self::Figure(paths.iter().map(|path| motion.path(path)).collect()),
        }
    }
}

impl Drawing {
    /// The centre lines of all seams on sheet `sheet`.
    pub fn seals(design: &Design, sheet: usize) -> Option<Self> {
        let layers = match design.product {
            Product::Stars(_) => vec![
                (Layer::SealInner, center_lines(design, sheet, Some(Side::Hole))),
                (Layer::SealOuter, center_lines(design, sheet, Some(Side::Outside))),
            ],
            Product::Drawing(_) => vec![(Layer::Seal, center_lines(design, sheet, None))],
        };
        Self::of_sheet(design, sheet, layers)
    }

    /// The outlines of all pieces on sheet `sheet`, holes first, so that no part moves before its holes are made.
    pub fn outlines(design: &Design, sheet: usize, edge: CutEdge) -> Option<Self> {
        let (mut labels, mut holes, mut inside, mut outside) =
            (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for placed in design.on_sheet(sheet) {
            let part = design.part(placed);
            labels.extend(Shape::figure(match part {
                FlatPiece::Star(star) => label::on_outline(star, placed),
                FlatPiece::Drawn(piece) => label::on_piece(piece, placed),
            }));
            let cut = part.cut(edge);
            holes.extend(registration(cut.holes, &placed.placement, cut.kerf));
            inside.extend(cut.inside.iter().map(|path| Shape::moved_path(path, &placed.placement)));
            outside.push(Shape::moved_path(cut.outside, &placed.placement));
        }
        let layers = vec![
            (Layer::Label, labels),
            (Layer::Registration, holes),
            (Layer::CutHole, inside),
            (Layer::CutOutside, outside),
        ];
        Self::of_sheet(design, sheet, layers)
    }

    /// The outlines of the sheet of fabric that has the valves: as [`Self::outlines`], with the holes of the valves. `None` without valves.
    pub fn valve_outlines(design: &Design, sheet: usize, edge: CutEdge) -> Option<Self> {
        let mut holes = Vec::new();
        for placed in design.on_sheet(sheet) {
            let of_piece = design.part(placed).cut(edge).valves.iter();
            holes.extend(of_piece.map(|hole| Shape::Path(placed.placement.path(hole))));
        }
        if holes.is_empty() {
            return None;
        }
        let mut drawing = Self::outlines(design, sheet, edge)?;
        let last = drawing.layers.len() - 1;
        drawing.layers.insert(last, (Layer::CutValve, holes));
        Some(drawing)
    }

    /// The mask of the distinct star to which star number `star` belongs, turned over for its other face if `mirrored`.
    pub fn mask(design: &StarAssembly, star: usize, mirrored: bool, edge: CutEdge) -> Option<Self> {
        let part = design.part(design.stars.iter().find(|placed| placed.index == star)?);
        let mask = &part.mask;
        let motion = if mirrored { Isometry::mirror() } else { Isometry::IDENTITY };
        let (plate, windows, kerf) = match edge {
            CutEdge::Part => (&mask.plate, &mask.windows, 0.0),
            CutEdge::Tool => (&part.cut.plate, &part.cut.windows, part.cut.kerf),
        };
        let labels = Shape::figure(label::on_mask(part, mask, star, mirrored));
        Some(Self::around_axis(vec![
            (Layer::Label, labels.into_iter().collect()),
            (Layer::Registration, registration(&part.outline.registration, &motion, kerf).collect()),
            (Layer::MaskWindow, windows.iter().map(|window| Shape::moved_path(window, &motion)).collect()),
            (Layer::MaskPlate, vec![Shape::moved_path(plate, &motion)]),
        ]))
    }

    /// The separator of a drawn piece, in the drawing's own frame; `None` if the spec has none.
    pub fn separator(piece: &DrawnPiece, edge: CutEdge) -> Option<Self> {
        let separator = piece.separator.as_ref()?;
        let paths = if edge == CutEdge::Tool { &separator.tool } else { &separator.part };
        Some(Self::around_axis(vec![
            (Layer::MaskWindow, paths.windows.iter().cloned().map(Shape::Path).collect()),
            (Layer::MaskPlate, paths.pieces.iter().cloned().map(Shape::Path).collect()),
        ]))
    }

    /// The separators on sheet of paper number `paper`, each with its piece's registration holes; `None` if there is no such sheet.
    pub fn separators(design: &Design, paper: usize, edge: CutEdge) -> Option<Self> {
        let sheet = design.papers.iter().find(|sheet| sheet.index == paper)?;
        let (mut labels, mut holes, mut windows, mut edges) =
            (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for separator in &sheet.separators {
            let placed = design.placed().iter().find(|placed| placed.index == separator.piece)?;
            let (part, motion) = (design.part(placed), &separator.placement);
            let Some(paper) = part.separator() else { continue };
            let paths = if edge == CutEdge::Tool { &paper.tool } else { &paper.part };
            let cut = part.cut(edge);
            labels.extend(Shape::figure(paper.labels(placed).iter().map(|path| motion.path(path)).collect()));
            holes.extend(registration(cut.holes, motion, cut.kerf));
            windows.extend(paths.windows.iter().map(|path| Shape::Path(motion.path(path))));
            edges.extend(paths.pieces.iter().map(|path| Shape::Path(motion.path(path))));
        }
        let layers = vec![
            (Layer::Label, labels),
            (Layer::Registration, holes),
            (Layer::SeparatorWindow, windows),
            (Layer::SeparatorEdge, edges),
        ];
        Some(Self { origin: Origin::LowerLeft, width: sheet.width, height: sheet.height, layers })
    }

    /// A distinct plate of the frame.
    pub fn plate(design: &StarAssembly, plate: &Plate, edge: CutEdge) -> Self {
        let frame = &design.frame;
        let half_kerf = if edge == CutEdge::Tool { frame.kerf / 2.0 } else { 0.0 };
        let posts = frame.posts.iter().map(|post| circle(*post, frame.post_diameter / 2.0 - half_kerf));
        Self::around_axis(vec![
            (Layer::Label, Shape::figure(plate_label(frame.radius, plate)).into_iter().collect()),
            (Layer::PostHole, posts.collect()),
            (Layer::FrameOpening, vec![circle(Point::ORIGIN, plate.opening - half_kerf)]),
            (Layer::FrameEdge, vec![circle(Point::ORIGIN, frame.radius + half_kerf)]),
        ])
    }

    /// A drawing around the axis, as large as its content.
    pub(super) fn around_axis(layers: Vec<(Layer, Vec<Shape>)>) -> Self {
        let shapes = layers.iter().flat_map(|(_, shapes)| shapes);
        let bounds = shapes.map(Shape::bounds).fold(Bounds::EMPTY, Bounds::union);
        // Whole millimetres read well in a file and lose nothing.
        let corner = Point::new(bounds.min.x.floor() - 1.0, bounds.min.y.floor() - 1.0);
        let (width, height) = (bounds.max.x.ceil() + 1.0 - corner.x, bounds.max.y.ceil() + 1.0 - corner.y);
        Self { origin: Origin::Axis(corner), width, height, layers }
    }

    /// The page's lower left corner in the drawing's own coordinates.
    pub fn corner(&self) -> Point {
        match self.origin {
            Origin::LowerLeft => Point::ORIGIN,
            Origin::Axis(corner) => corner,
        }
    }

    fn of_sheet(design: &Design, sheet: usize, layers: Vec<(Layer, Vec<Shape>)>) -> Option<Self> {
        let layout = design.sheets.iter().find(|layout| layout.index == sheet)?;
        Some(Self { origin: Origin::LowerLeft, width: layout.width, height: layout.height, layers })
    }
}

/// The centre lines of the seams on sheet `sheet`: those of one side of all stars, or all.
fn center_lines(design: &Design, sheet: usize, side: Option<Side>) -> Vec<Shape> {
    let shapes = design.on_sheet(sheet).flat_map(|placed| {
        let seams = design.part(placed).shape().seams.iter();
        let seams = seams.filter(move |seam| side.is_none_or(|side| seam.name == side.loop_name()));
        seams.map(|seam| Shape::moved_path(&seam.center_line, &placed.placement))
    });
    shapes.collect()
}

fn circle(center: Point, radius: f64) -> Shape {
    Shape::Circle { center, radius }
}

/// The registration holes of a part, as a tool with this kerf cuts them.
fn registration(holes: &[Circle], motion: &Isometry, kerf: f64) -> impl Iterator<Item = Shape> {
    holes.iter().map(move |hole| Shape::Circle {
        center: motion.point(hole.center),
        radius: (hole.diameter - kerf) / 2.0,
    })
}

/// Numbers of a plate and a tick at its +X, written in the strip that carries the posts.
fn plate_label(radius: f64, plate: &Plate) -> Vec<Path> {
    let numbers: Vec<String> = plate.numbers.iter().map(ToString::to_string).collect();
    let text = format!("PLATE {}", numbers.join(","));
    // At most a quarter of the way around, and no higher than the strip outside the opening allows.
    let strip = radius - plate.opening;
    let height = (1.5 * radius / lettering::width(&text, 1.0)).min(0.1 * strip).min(5.0);
    let middle = plate.opening + 0.2 * strip;
    let mut strokes =
        lettering::circular_text(&text, Point::ORIGIN, middle, std::f64::consts::FRAC_PI_2, height);
    strokes.push(Path::polyline(&[Point::new(middle - height, 0.0), Point::new(middle + height, 0.0)]));
    strokes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_figure_only_what_is_in_the_window_is_shown() {
        let stroke = |x: f64| Path::polyline(&[Point::new(x, 0.0), Point::new(x + 1.0, 0.0)]);
        let window = Bounds { min: Point::new(-0.5, -0.5), max: Point::new(4.0, 4.0) };
        let figure = |places: &[f64]| Shape::Figure(places.iter().map(|x| stroke(*x)).collect());
        assert_eq!(figure(&[0.0, 3.0, 6.0]).clipped(&window), Some(figure(&[0.0, 3.0])));
        assert_eq!(figure(&[6.0]).clipped(&window), None);
        assert_eq!(Shape::figure(Vec::new()), None);
    }
}
