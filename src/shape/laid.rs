//! Pieces and seams in their places on a sheet: the seams that a program seals, and that the verifier follows.

use crate::shape::{PieceName, SealedShape, Seam, SeamName};
use inflatable::geom::{Bounds, Isometry, Line, Path, Point};

/// A piece on a sheet.
#[derive(Clone, Debug)]
pub struct PlacedPiece<'a> {
    /// Its name.
    pub name: PieceName,
    /// Its seams, cut and ports.
    pub shape: &'a SealedShape,
    /// From the shape's frame to the sheet's.
    pub placement: Isometry,
}

/// One seam in the sheet's frame, with the iron's way to it and from it.
#[derive(Clone, Debug, PartialEq)]
pub struct LaidSeam {
    /// Its name.
    pub name: SeamName,
    /// The way down.
    pub lead_in: Path,
    /// The way in contact, overlap included.
    pub run: Path,
    /// The way up.
    pub lead_out: Path,
    /// Length of the centre line, the overlap counted once, mm.
    pub once: f64,
    /// Path covered twice, mm.
    pub overlap: f64,
}

impl LaidSeam {
    /// `seam` of `piece`, moved by `placement`, with ways down and up of `ramp` mm.
    pub fn new(piece: &PieceName, seam: &Seam, placement: Isometry, ramp: f64) -> Self {
        let place = |path: Path| placement.path(&path);
        Self {
            name: SeamName { piece: piece.clone(), seam: seam.name.clone() },
            lead_in: place(seam.lead_in(ramp)),
            run: place(seam.run()),
            lead_out: place(seam.lead_out(ramp)),
            once: seam.center_line.length(),
            overlap: seam.overlap,
        }
    }

    /// Way down, seam and way up.
    pub fn paths(&self) -> [&Path; 3] {
        [&self.lead_in, &self.run, &self.lead_out]
    }
}

impl PlacedPiece<'_> {
    /// Its seams in the order of sealing, with ways down and up of `ramp` mm.
    fn laid_seams(&self, ramp: f64) -> impl Iterator<Item = LaidSeam> {
        self.shape.seams.iter().map(move |seam| LaidSeam::new(&self.name, seam, self.placement, ramp))
    }
}

/// The seams of `pieces` in the order of sealing, with ways down and up of `ramp` mm.
pub fn laid_seams(pieces: &[PlacedPiece<'_>], ramp: f64) -> Vec<LaidSeam> {
    pieces.iter().flat_map(|piece| piece.laid_seams(ramp)).collect()
}

/// The rectangle around the cuts of `pieces` and around all that the iron does to the fabric along `seams`: what a trace shows
/// first.
pub fn frame(pieces: &[PlacedPiece<'_>], seams: &[LaidSeam]) -> Path {
    let cuts =
        pieces.iter().filter_map(|piece| Some(piece.placement.path(piece.shape.cut.as_ref()?).bounds()));
    let half_band = pieces.first().map_or(0.0, |piece| piece.shape.band / 2.0);
    let touched = seams.iter().flat_map(LaidSeam::paths).map(|path| path.bounds().grown(half_band));
    let Bounds { min, max } = cuts.chain(touched).fold(Bounds::EMPTY, Bounds::union);
    let corners = [min, Point::new(max.x, min.y), max, Point::new(min.x, max.y), min];
    Path::closed(corners.windows(2).map(|ends| Line::new(ends[0], ends[1]).into()).collect())
}
