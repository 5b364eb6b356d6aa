//! Solids: plates for a 3-D printer, with the texts sunk into their faces, and the picture that shows how the pieces of a mask
//! belong together.
//!
//! The layer of labels has closed outlines here: the region inside is sunk, [`engraved_depth`](crate::engraved_depth)
//! deep.

use crate::engraving::{Spot, engraved};
use crate::joint::WALL;
use crate::{CutEdge, Drawing, Layer, Piece, Plate, Shape, StarAssembly, StarDesign, lettering};
use geom::{Isometry, Path, Point, Vec2};

/// Height of the numbers in the picture of all pieces, mm.
const NUMBER: f64 = 12.0;

impl Drawing {
    /// Piece number `piece`, from 0, of the mask that [`Drawing::mask`] shows, as it lies on the printer's bed.
    pub fn printed_mask(design: &StarAssembly, star: usize, mirrored: bool, piece: usize) -> Option<Self> {
        let part = design.part(design.stars.iter().find(|placed| placed.index == star)?);
        let this = part.pieces.list.get(piece)?;
        let motion = this.motion(mirrored);
        let one = !part.pieces.are_several();
        let place = |path: &Path| Shape::Path(motion.path(path));
        let windows = part.mask.windows.iter().filter(|_| this.tip.is_none());
        let holes = part.outline.registration.iter().filter(|hole| one || this.edge.encloses(hole.center));
        let holes = holes
            .map(|hole| Shape::Circle { center: motion.point(hole.center), radius: hole.diameter / 2.0 });
        let texts = mask_texts(star, mirrored, Some(piece + 1).filter(|_| !one));
        let spot = moved(&spot(part, this), &motion);
        Some(Self::around_axis(vec![
            (Layer::Label, engraved(&texts, &spot).into_iter().map(Shape::Path).collect()),
            (Layer::Registration, holes.collect()),
            (Layer::MaskWindow, windows.map(place).collect()),
            (Layer::MaskPlate, vec![place(&this.edge)]),
        ]))
    }

    /// A distinct plate of the frame as it is printed, its numbers sunk in, and a dash towards +X.
    pub fn printed_plate(design: &StarAssembly, plate: &Plate) -> Self {
        let frame = &design.frame;
        let middle = f64::midpoint(plate.opening, frame.radius);
        let spot = |center: Point, up: Vec2| {
            let posts = frame.posts.iter().map(|post| post.distance(center) - frame.post_diameter / 2.0);
            let strip = (frame.radius - plate.opening) / 2.0;
            Spot { middle: center, up, radius: posts.fold(strip, f64::min) - WALL }
        };
        let numbers: Vec<String> = plate.numbers.iter().map(ToString::to_string).collect();
        let texts = [
            vec![format!("PLATE {}", numbers.join(","))],
            vec!["PLATE".to_owned(), numbers.join(",")],
            numbers,
        ];
        let up = Vec2::new(0.0, 1.0);
        let mut marks = engraved(&texts, &spot(Point::new(0.0, middle), up));
        marks.extend(engraved(&[vec!["-".to_owned()]], &spot(Point::new(middle, 0.0), up)));
        let mut plain = Self::plate(design, plate, CutEdge::Part).layers;
        plain.retain(|(layer, _)| *layer != Layer::Label);
        plain.insert(0, (Layer::Label, marks.into_iter().map(Shape::Path).collect()));
        Self::around_axis(plain)
    }

    /// The mask that [`Drawing::mask`] shows, with the joints of its pieces and their numbers; `None` if it is one piece.
    pub fn pieces(design: &StarAssembly, star: usize, mirrored: bool) -> Option<Self> {
        let part = design.part(design.stars.iter().find(|placed| placed.index == star)?);
        if !part.pieces.are_several() {
            return None;
        }
        let motion = if mirrored { Isometry::mirror() } else { Isometry::IDENTITY };
        let mut numbers = Vec::new();
        for (number, piece) in (1_usize..).zip(&part.pieces.list) {
            let text = number.to_string();
            let middle = motion.point(spot(part, piece).middle);
            let shift = Vec2::new(lettering::width(&text, NUMBER), NUMBER) * 0.5;
            numbers.extend(lettering::lettered(&text, middle - shift, NUMBER));
        }
        let mut layers = Self::mask(design, star, mirrored, CutEdge::Part)?.layers;
        layers.retain(|(layer, _)| *layer != Layer::Label);
        layers.insert(0, (Layer::Label, Shape::figure(numbers).into_iter().collect()));
        let joints = part.pieces.joints.iter().map(|joint| Shape::Path(motion.path(joint)));
        layers.insert(1, (Layer::MaskJoint, joints.collect()));
        Some(Self::around_axis(layers))
    }
}

/// The free room for a text on a piece, in the star's frame.
fn spot(part: &StarDesign, piece: &Piece) -> Spot {
    piece.spot(&part.star, &part.outline, &part.mask)
}

fn moved(spot: &Spot, motion: &Isometry) -> Spot {
    let middle = motion.point(spot.middle);
    Spot { middle, up: motion.point(spot.middle + spot.up) - middle, ..*spot }
}

/// The texts that a piece of a mask may carry, from the longest to the shortest.
fn mask_texts(star: usize, mirrored: bool, piece: Option<usize>) -> Vec<Vec<String>> {
    let side: [&str; 2] = if mirrored { ["OTHER", "SIDE"] } else { ["THIS", "SIDE UP"] };
    let lines = |side: &[String]| {
        let number = piece.map(|piece| format!("PIECE {piece}"));
        [&[format!("STAR {star}")], side].concat().into_iter().chain(number).collect::<Vec<String>>()
    };
    let least = piece.unwrap_or(star).to_string();
    let short = piece.map_or_else(|| format!("STAR {star}"), |piece| format!("{star}-{piece}"));
    vec![lines(&[side.join(" ")]), lines(&side.map(str::to_owned)), vec![short], vec![least]]
}
