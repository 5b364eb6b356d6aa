//! The bill of materials: parts to buy, to cut and to fill.

use design::{COATING_ASSUMES, MaskTiles, StarAssembly};
use proof::manifest::{ManifestMask, ManifestPiece, ManifestPlates, ManifestPosts};
use spec::Spec;

/// The posts of the frame.
pub(super) fn posts(design: &StarAssembly) -> Vec<ManifestPosts> {
    let (length, count) = (design.frame.post_length, design.frame.posts.len());
    vec![ManifestPosts { length_mm: thousandths(length), count }]
}

/// The plates of the frame, equal ones together.
pub(super) fn plates(design: &StarAssembly) -> Vec<ManifestPlates> {
    let (frame, stack) = (&design.frame, &design.stack);
    let alike = frame.plates.iter().map(|plate| ManifestPlates {
        plates: plate.numbers.clone(),
        heights_mm: plate.numbers.iter().map(|number| thousandths(stack.plates[number - 1])).collect(),
        opening_mm: thousandths(plate.opening),
        radius_mm: thousandths(frame.radius),
        thickness_mm: thousandths(frame.thickness),
        area_mm2: thousandths(frame.area(plate)),
    });
    alike.collect()
}

/// The masks of all distinct stars.
pub(super) fn masks(spec: &Spec, design: &StarAssembly) -> Vec<ManifestMask> {
    let first = design.firsts().map(|placed| {
        let part = design.part(placed);
        let area = part.mask.area(&part.outline);
        let alike = design.stars.iter().filter(|other| other.distinct == placed.distinct);
        ManifestMask {
            star: placed.index,
            stars: alike.map(|star| star.index).collect(),
            extent_mm: thousandths(part.mask.extent),
            window_mm2: thousandths(part.mask.window_area()),
            area_mm2: thousandths(area),
            volume_mm3: thousandths(area * spec.mask.thickness.0),
            coating_um: part.mask.coating_um().map(f64::round),
            coating_assumes: COATING_ASSUMES.to_owned(),
            pieces: if spec.mask.bed.is_some() { pieces(&part.tiles) } else { Vec::new() },
        }
    });
    first.collect()
}

/// The pieces of a printed mask.
fn pieces(mask: &MaskTiles) -> Vec<ManifestPiece> {
    let numbered = (1..).zip(&mask.tiles).map(|(piece, this)| ManifestPiece {
        piece,
        tip: this.tip,
        turn_deg: thousandths(this.turn.to_degrees()),
        size_mm: this.size.map(thousandths),
    });
    numbered.collect()
}

/// A number rounded to a thousandth: rounding errors of a sum must not change a file.
pub(super) fn thousandths(x: f64) -> f64 {
    (x * 1000.0).round() / 1000.0
}
