//! A seam: the centre line of a band, and how the iron enters and leaves it; the shapes that seams make, as they lie on a sheet.

use crate::{PieceName, SeamName};
use geom::{Bounds, Isometry, Path, Point};

/// The purpose of a seam.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// An edge of a chamber.
    Boundary,
    /// A band that encloses nothing, such as a strip for a peel test.
    Weld,
}

/// One seam: the centre line of a band.
#[derive(Clone, Debug, PartialEq)]
pub struct Seam {
    /// The name among the seams of the piece; empty for the only one.
    pub name: String,
    /// The purpose.
    pub role: Role,
    /// The band's centre line from where the sealing starts: closed, or open from end to end.
    pub center_line: Path,
    /// Path covered twice where a closed line meets its start, mm; 0 for an open one.
    pub overlap: f64,
}

impl Seam {
    /// The only seam of a piece: an open line that encloses nothing.
    pub fn weld(center_line: Path) -> Self {
        Self { name: String::new(), role: Role::Weld, center_line, overlap: 0.0 }
    }

    /// The path in contact: the center line, and its overlap again.
    pub fn run(&self) -> Path {
        if self.center_line.closed {
            self.center_line.part(0.0, self.center_line.length() + self.overlap)
        } else {
            self.center_line.clone()
        }
    }

    /// The path of `length` on which the iron goes down before the run: along the loop, or straight on before an open end.
    pub fn lead_in(&self, length: f64) -> Path {
        if self.center_line.closed {
            return self.center_line.part(-length, 0.0);
        }
        straight_in(&self.center_line, length)
    }

    /// The path of `length` on which the iron goes up after the run.
    pub fn lead_out(&self, length: f64) -> Path {
        if self.center_line.closed {
            return self.center_line.part(self.overlap, self.overlap + length);
        }
        straight_in(&self.center_line.reversed(), length).reversed()
    }
}

/// The straight way of `length` that ends where the open `path` begins.
fn straight_in(path: &Path, length: f64) -> Path {
    // Shorter segments may be rounding of a drawing: they give no direction.
    let direction = path.segments.iter().find(|segment| segment.length() > 0.01).or(path.segments.first());
    let (Some(start), Some(first)) = (path.start(), direction) else { return Path::default() };
    let tangent = first.tangent(0.0);
    Path::polyline(&[start - tangent * length, start])
}

/// The opening for a hose: between the two ends of an open seam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Port {
    /// The middle of its mouth.
    pub at: Point,
    /// Flat width between the bands that the hose needs, mm.
    pub width: f64,
}

/// A valve in the face of a chamber, in one of the two sheets. Both paths are closed and counterclockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Valve {
    /// The hole in the sheet.
    pub hole: Path,
    /// The outer edge of the flange, which is sealed to the sheet around the hole.
    pub rim: Path,
}

/// Two equal sheets, sealed and cut.
#[derive(Clone, Debug, PartialEq)]
pub struct SealedShape {
    /// The seams in the order in which they are sealed.
    pub seams: Vec<Seam>,
    /// Width of the bands, mm.
    pub band: f64,
    /// The cut around it; `None` for a piece that the user cuts out.
    pub cut: Option<Path>,
    /// The ports.
    pub ports: Vec<Port>,
    /// The valves in its upper sheet.
    pub valves: Vec<Valve>,
}

impl SealedShape {
    /// The seam called `name`.
    pub fn seam(&self, name: &str) -> Option<&Seam> {
        self.seams.iter().find(|seam| seam.name == name)
    }

    /// The box of all centre lines.
    pub fn seam_bounds(&self) -> Bounds {
        self.seams.iter().map(|seam| seam.center_line.bounds()).fold(Bounds::EMPTY, Bounds::union)
    }

    /// The shape, moved by `motion`.
    #[must_use]
    pub fn moved(&self, motion: Isometry) -> Self {
        let valve = |valve: &Valve| Valve { hole: motion.path(&valve.hole), rim: motion.path(&valve.rim) };
        let seam = |seam: &Seam| Seam { center_line: motion.path(&seam.center_line), ..seam.clone() };
        Self {
            seams: self.seams.iter().map(seam).collect(),
            band: self.band,
            cut: self.cut.as_ref().map(|cut| motion.path(cut)),
            ports: self.ports.iter().map(|port| Port { at: motion.point(port.at), ..*port }).collect(),
            valves: self.valves.iter().map(valve).collect(),
        }
    }
}

/// A piece on a sheet.
#[derive(Clone, Debug)]
pub struct PlacedPiece<'a> {
    /// The name.
    pub name: PieceName,
    /// The seams, the cut and the ports.
    pub shape: &'a SealedShape,
    /// From the shape's frame to the sheet's.
    pub placement: Isometry,
}

/// One seam in the sheet's frame, with the iron's way to it and from it.
#[derive(Clone, Debug, PartialEq)]
pub struct LaidSeam {
    /// The name.
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
        let [lead_in, run, lead_out] =
            [seam.lead_in(ramp), seam.run(), seam.lead_out(ramp)].map(|path| placement.path(&path));
        Self {
            name: SeamName { piece: piece.clone(), seam: seam.name.clone() },
            lead_in,
            run,
            lead_out,
            once: seam.center_line.length(),
            overlap: seam.overlap,
        }
    }

    /// Way down, seam and way up.
    pub fn paths(&self) -> [&Path; 3] {
        [&self.lead_in, &self.run, &self.lead_out]
    }
}

/// The seams of `pieces` in the order of sealing, with ways down and up of `ramp` mm.
pub fn laid_seams(pieces: &[PlacedPiece<'_>], ramp: f64) -> Vec<LaidSeam> {
    let mut seams = Vec::new();
    for piece in pieces {
        let piece_seams = piece.shape.seams.iter();
        seams.extend(piece_seams.map(|seam| LaidSeam::new(&piece.name, seam, piece.placement, ramp)));
    }
    seams
}

/// The rectangle around the cuts of `pieces` and around all that the iron does to the fabric along `seams`: what a trace shows
/// first.
pub fn frame(pieces: &[PlacedPiece<'_>], seams: &[LaidSeam]) -> Path {
    let cuts =
        pieces.iter().filter_map(|piece| Some(piece.placement.path(piece.shape.cut.as_ref()?).bounds()));
    let half_band = pieces.first().map_or(0.0, |piece| piece.shape.band / 2.0);
    let touched = seams.iter().flat_map(LaidSeam::paths).map(|path| path.bounds().outset(half_band));
    Path::rectangle(&cuts.chain(touched).fold(Bounds::EMPTY, Bounds::union))
}
