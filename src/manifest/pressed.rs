//! What a press makes: stars and pieces with their seams, without programs.

use crate::manifest::bill::thousandths;
use design::{Design, FlatPiece, PlacedPart, StarAssembly};
use proof::manifest::{ManifestSeam, ManifestStar, SealedPiece, SealedSeam, SeamMaking};
use sealed::Seam;
use spec::{Press, Spec};

/// Every piece of `design`, whose seams `press` makes in one pressing.
pub(super) fn pieces(press: &Press, design: &Design) -> Vec<SealedPiece> {
    let seam = |seam: &Seam| SealedSeam {
        name: seam.name.clone(),
        length_mm: thousandths(seam.center_line.length()),
        time_s: thousandths(press.time.0),
        making: SeamMaking::default(),
    };
    let piece = |placed: &PlacedPart| SealedPiece {
        name: placed.name().word(),
        kind: placed.name().kind().to_owned(),
        time_s: None,
        seams: design.part(placed).shape().seams.iter().map(seam).collect(),
    };
    design.placed().iter().map(piece).collect()
}

/// The stars of `assembly`, bottom to top. All seams of a star are made at the same time.
pub(super) fn stars(spec: &Spec, press: &Press, assembly: &StarAssembly) -> Vec<ManifestStar> {
    let time = thousandths(press.time.0);
    let seam = |seam: &Seam| ManifestSeam {
        loop_name: seam.name.clone(),
        length_mm: thousandths(seam.center_line.length()),
        overlap_mm: 0.0,
        time_s: time,
        making: SeamMaking::default(),
    };
    let star = |placed: &PlacedPart| {
        let part = assembly.part(placed);
        let seams: Vec<ManifestSeam> = part.shape.seams.iter().map(seam).collect();
        ManifestStar {
            index: placed.index,
            sheet: placed.sheet,
            seam_mm: thousandths(seams.iter().map(|seam| seam.length_mm).sum()),
            time_s: time,
            clear_radius_mm: thousandths(part.clear_radius()),
            fabric_mm2: thousandths(part.fabric()),
            mass_g: FlatPiece::Star(part).mass(&spec.fabric).map(thousandths),
            seams,
        }
    };
    assembly.stars.iter().map(star).collect()
}
