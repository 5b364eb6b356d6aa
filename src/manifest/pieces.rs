//! Pieces and their seams, for all products: stars, drawn pieces and coupons.

use serde::{Deserialize, Serialize};

use crate::manifest::bill::thousandths;
use crate::plan::{Program, SeamReport};
use crate::shape::PieceName;

/// A piece with its seams.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SealedPiece {
    /// Its name: "star-1", "disc".
    pub name: String,
    /// The product: "star", "piece" of a drawing, or "coupon".
    pub kind: String,
    /// Time of its program without heating and pauses, s; absent without a program of its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_s: Option<f64>,
    /// Its seams, in the order of sealing.
    pub seams: Vec<SealedSeam>,
}

/// A seam of a piece.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SealedSeam {
    /// Its name: "inner"; for a coupon the name of its piece, "strip-7".
    pub name: String,
    /// Path in contact, overlap included, mm.
    pub length_mm: f64,
    /// Time in contact, ramps included, s.
    pub time_s: f64,
}

impl SealedSeam {
    /// The seam `report`, called `name`.
    fn new(name: String, report: &SeamReport) -> Self {
        Self { name, length_mm: thousandths(report.length), time_s: thousandths(report.time) }
    }
}

impl SealedPiece {
    /// The piece of the coupon `name`, sealed by `program`.
    pub fn coupon(name: &str, program: &Program) -> Self {
        let seam = |seam: &SeamReport| SealedSeam::new(seam.name.piece.word(), seam);
        Self {
            name: name.to_owned(),
            kind: "coupon".to_owned(),
            time_s: Some(thousandths(program.time)),
            seams: program.seams.iter().map(seam).collect(),
        }
    }

    /// The pieces that `programs` seal, in their order.
    pub(super) fn all(programs: &[Program]) -> Vec<Self> {
        let of_program = |program: &Program| {
            let of_piece = |piece: &PieceName| {
                let own = program.seams.iter().filter(|seam| seam.name.piece == *piece);
                let seams = own.map(|seam| SealedSeam::new(seam.name.seam.clone(), seam)).collect();
                Self { name: piece.word(), kind: piece.kind().to_owned(), time_s: None, seams }
            };
            program.pieces.iter().map(of_piece).collect::<Vec<_>>()
        };
        programs.iter().flat_map(of_program).collect()
    }
}
