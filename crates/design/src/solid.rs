//! Solids: plates for a 3-D printer, without texts, and the picture that shows how the pieces of a mask belong together.

use crate::{CutEdge, Drawing, Layer, Plate, Shape, StarAssembly, lettering};
use geom::{Isometry, Vec2};

/// Height of the numbers in the picture of all pieces, mm.
const NUMBER: f64 = 12.0;

impl Drawing {
    /// Piece number `piece`, from 0, of the mask that [`Drawing::mask`] shows, as it lies on the printer's bed.
    pub fn printed_mask(design: &StarAssembly, star: usize, mirrored: bool, piece: usize) -> Option<Self> {
        let part = design.part(design.stars.iter().find(|placed| placed.index == star)?);
        let tile = part.tiles.tiles.get(piece)?;
        let motion = tile.motion(mirrored);
        let is_single = !part.tiles.are_several();
        let windows = part.mask.windows.iter().filter(|_| tile.tip.is_none());
        let holes =
            part.outline.registration.iter().filter(|hole| is_single || tile.edge.encloses(hole.center));
        let holes = holes
            .map(|hole| Shape::Circle { center: motion.point(hole.center), radius: hole.diameter / 2.0 });
        Some(Self::around_axis(vec![
            (Layer::Registration, holes.collect()),
            (Layer::MaskWindow, windows.map(|window| Shape::moved_path(window, &motion)).collect()),
            (Layer::MaskPlate, vec![Shape::moved_path(&tile.edge, &motion)]),
        ]))
    }

    /// A distinct plate of the frame as it is printed.
    pub fn printed_plate(design: &StarAssembly, plate: &Plate) -> Self {
        let mut layers = Self::plate(design, plate, CutEdge::Part).layers;
        layers.retain(|(layer, _)| *layer != Layer::Label);
        Self::around_axis(layers)
    }

    /// The mask that [`Drawing::mask`] shows, with the joints of its pieces and their numbers; `None` if it is one piece.
    pub fn pieces(design: &StarAssembly, star: usize, mirrored: bool) -> Option<Self> {
        let part = design.part(design.stars.iter().find(|placed| placed.index == star)?);
        if !part.tiles.are_several() {
            return None;
        }
        let motion = if mirrored { Isometry::mirror() } else { Isometry::IDENTITY };
        let mut numbers = Vec::new();
        for (number, piece) in (1_usize..).zip(&part.tiles.tiles) {
            let text = number.to_string();
            let middle = motion.point(piece.roomiest_point(&part.star, &part.outline, &part.mask));
            let shift = Vec2::new(lettering::width(&text, NUMBER), NUMBER) * 0.5;
            numbers.extend(lettering::lettered(&text, middle - shift, NUMBER));
        }
        let mut layers = Self::mask(design, star, mirrored, CutEdge::Part)?.layers;
        layers.retain(|(layer, _)| *layer != Layer::Label);
        layers.insert(0, (Layer::Label, Shape::figure(numbers).into_iter().collect()));
        let joints = part.tiles.joints.iter().map(|joint| Shape::Path(motion.path(joint)));
        layers.insert(1, (Layer::MaskJoint, joints.collect()));
        Some(Self::around_axis(layers))
    }
}
