//! Pieces where they lie on sheets.

use crate::design::placement::Placement;
use crate::shape::PieceName;
use inflatable::geom::Isometry;

/// One piece on its sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedPart {
    /// The kind of piece: "star".
    pub kind: &'static str,
    /// Number of the piece; of the stars of a stack 1 = bottom.
    pub index: usize,
    /// Index of the distinct piece, from 0.
    pub distinct: usize,
    /// Number of its sheet, from 1.
    pub sheet: usize,
    /// From the piece's frame to the sheet's.
    pub placement: Isometry,
}

impl PlacedPart {
    /// Its name: star 2.
    pub fn name(&self) -> PieceName {
        PieceName::numbered(self.kind, self.index)
    }

    /// Pieces of one `kind`, numbered from 1, of which each is one of the distinct ones and has its place.
    pub(super) fn all(kind: &'static str, which: &[usize], places: Vec<Placement>) -> Vec<Self> {
        let placed = which.iter().zip(places).zip(1..);
        placed
            .map(|((&distinct, (sheet, placement)), index)| Self { kind, index, distinct, sheet, placement })
            .collect()
    }
}
