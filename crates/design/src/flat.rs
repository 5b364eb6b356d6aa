//! The flat piece of every product: seams, tube, cut and fabric.

use crate::{Circle, CutEdge, DrawnCut, DrawnPiece, PaperSeparator, SHEETS, SeamLines, StarDesign};
use geom::{Path, Point};
use sealed::SealedShape;
use spec::{Fabric, Spec};

/// One piece in its own frame, whatever it belongs to.
#[derive(Clone, Copy, Debug)]
pub enum FlatPiece<'a> {
    /// A star.
    Star(&'a StarDesign),
    /// A piece by a drawing.
    Drawn(&'a DrawnPiece),
}

/// The lines along which a piece is cut, closed and counterclockwise.
#[derive(Clone, Debug)]
pub struct PieceCut<'a> {
    /// Around the piece.
    pub outside: &'a Path,
    /// Out of the piece.
    pub inside: &'a [Path],
    /// Out of the sheet with the valves.
    pub valves: &'a [Path],
    /// Round holes, as drawn.
    pub holes: &'a [Circle],
    /// Width of the cut for which the lines are; 0 for the piece's own edges, mm.
    pub kerf: f64,
}

impl<'a> FlatPiece<'a> {
    /// Seams, cut and ports of the piece.
    pub fn shape(self) -> &'a SealedShape {
        match self {
            Self::Star(star) => &star.shape,
            Self::Drawn(piece) => &piece.shape,
        }
    }

    /// The sealing of its seams, in their order.
    pub fn seam_lines(self) -> &'a [SeamLines] {
        match self {
            Self::Star(star) => &star.seam_lines,
            Self::Drawn(piece) => &piece.seam_lines,
        }
    }

    /// Length of all seams as they are made by `spec`, mm. An iron goes along each line of a seam in every pass, and along a part of a
    /// loop twice; a press makes each centre line once.
    pub fn sealed_length(self, spec: &Spec) -> f64 {
        if spec.press.is_some() {
            return self.shape().seams.iter().map(|seam| seam.center_line.length()).sum();
        }
        let of_seam = |seam: &SeamLines| -> f64 {
            let length: f64 = seam.lines.iter().map(|line| line.run().length()).sum();
            f64::from(spec.process(&seam.process).seal.passes) * length
        };
        self.seam_lines().iter().map(of_seam).sum()
    }

    /// The edges of the air as the iron makes them, those inside others first.
    pub fn tube(self) -> &'a [Path] {
        match self {
            Self::Star(star) => &star.realised_edges,
            Self::Drawn(piece) => &piece.edges,
        }
    }

    /// The edges of air as the spec or the drawing gives them.
    pub fn edges(self) -> &'a [Path] {
        match self {
            Self::Star(star) => &star.edges,
            Self::Drawn(piece) => &piece.edges,
        }
    }

    /// The cut lines.
    pub fn cut(self, edge: CutEdge) -> PieceCut<'a> {
        match self {
            Self::Star(star) => {
                let (outside, hole, kerf) = match edge {
                    CutEdge::Part => (&star.outline.outside, &star.outline.hole, 0.0),
                    CutEdge::Tool => (&star.cut.outside, &star.cut.hole, star.cut.kerf),
                };
                let holes = &star.outline.registration;
                PieceCut { outside, inside: std::slice::from_ref(hole), valves: &[], holes, kerf }
            }
            Self::Drawn(piece) => {
                let DrawnCut { outside, inside, valves, kerf } = match edge {
                    CutEdge::Part => &piece.part,
                    CutEdge::Tool => &piece.tool,
                };
                PieceCut { outside, inside, valves, holes: &piece.registration, kerf: *kerf }
            }
        }
    }

    /// The paper that keeps its air from welding in a heat press, if the spec has one.
    pub fn separator(self) -> Option<&'a PaperSeparator> {
        match self {
            Self::Star(star) => star.separator.as_ref(),
            Self::Drawn(piece) => piece.separator.as_ref(),
        }
    }

    /// Fabric of the piece, both sheets, mm^2.
    pub fn fabric(self) -> f64 {
        match self {
            Self::Star(star) => star.fabric(),
            Self::Drawn(piece) => {
                let DrawnCut { outside, inside, valves, .. } = &piece.part;
                SHEETS * (outside.area().abs() - total_area(inside)) - total_area(valves)
            }
        }
    }

    /// Mass of the fabric, both sheets, g; `None` where its areal density is unknown.
    pub fn mass(self, fabric: &Fabric) -> Option<f64> {
        // 1 kg/m^2 is 1e-3 g/mm^2.
        fabric.areal_density.map(|density| density.0 * 1e-3 * self.fabric())
    }

    /// The point by which pieces are sorted.
    pub fn middle(self) -> Point {
        match self {
            Self::Star(_) => Point::ORIGIN,
            Self::Drawn(piece) => piece.part.outside.bounds().center(),
        }
    }

    /// Width of the tube, mm: the measure for sizes of marks and labels.
    pub fn tube_width(self) -> f64 {
        match self {
            Self::Star(star) => star.star.w,
            Self::Drawn(piece) => piece.label_width(),
        }
    }
}

/// Area of all `holes`, mm^2.
fn total_area(holes: &[Path]) -> f64 {
    holes.iter().map(|hole| hole.area().abs()).sum()
}
