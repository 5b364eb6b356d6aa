//! The sheet that a shell modelled, with what makes the whole body of it.

use design::{Design, PlacedPart};
use inflatable::shell::cases::{BodySeam, InflatedShape, Symmetry};
use sealed::Seam;

/// The modelled sheet, and how it is repeated in the whole body.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelledSheet {
    /// The sheet at rest under pressure, on its finest mesh.
    pub shape: InflatedShape,
    /// How it is repeated in the whole body.
    pub symmetry: Symmetry,
    /// The seams of the whole body; empty for a V-actuator.
    pub seams: Vec<BodySeam>,
}

impl ModelledSheet {
    /// The sheet `shape` of `design`: of a star with the first one's symmetry and seams, of a drawing with all seams.
    pub fn of_design(design: &Design, shape: InflatedShape) -> Self {
        let limit = if design.assembly().is_some() { 1 } else { usize::MAX };
        let pieces: Vec<&PlacedPart> = design.firsts().take(limit).collect();
        let is_alone = pieces.len() == 1;
        let seams = pieces.iter().flat_map(|piece| {
            let seams = design.part(piece).shape().seams.iter();
            seams.map(move |seam| BodySeam {
                name: seam_name(piece, seam, is_alone),
                center_line: seam.center_line.clone(),
            })
        });
        let symmetry = match design.assembly().and_then(|assembly| assembly.distinct.first()) {
            Some(star) => Symmetry::of_star(star.star.n, &shape),
            None => Symmetry::Sheets,
        };
        Self { seams: seams.collect(), symmetry, shape }
    }

    /// The sheet `shape` of a V-actuator.
    pub fn of_actuator(shape: InflatedShape) -> Self {
        Self { shape, symmetry: Symmetry::Mirror, seams: Vec::new() }
    }
}

/// The name of a seam, with that of its piece unless the piece `is_alone`.
fn seam_name(piece: &PlacedPart, seam: &Seam, is_alone: bool) -> String {
    let name = if seam.name.is_empty() { "seam" } else { &seam.name };
    if is_alone { name.to_owned() } else { format!("{} {name}", piece.name()) }
}
