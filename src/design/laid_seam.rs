//! A seam where it lies on its sheet: what a program seals, and what the verifier follows.

use std::fmt;

use crate::design::seam::{straight_in, straight_out};
use crate::design::{Design, PlacedStar, Seam, Side};
use crate::geom::Path;

/// The name of a seam.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SeamName {
    /// A loop of a star.
    Star {
        /// Number of the star.
        star: usize,
        /// Which loop.
        side: Side,
    },
    /// The only seam of a piece that is no star: "disc", "strip-7".
    Piece(String),
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

impl SeamName {
    /// The name as words of a structured comment: "star=1 loop=outer", "piece=disc".
    pub fn facts(&self) -> String {
        match self {
            Self::Star { star, side } => format!("star={star} loop={}", side.loop_name()),
            Self::Piece(name) => format!("piece={name}"),
        }
    }

    /// Number of the star that it is a seam of.
    pub fn star(&self) -> Option<usize> {
        match self {
            Self::Star { star, .. } => Some(*star),
            Self::Piece(_) => None,
        }
    }

    /// Name of the piece that it is the seam of, if that is no star.
    pub fn piece(&self) -> Option<&str> {
        match self {
            Self::Star { .. } => None,
            Self::Piece(name) => Some(name),
        }
    }
}

/// In words: "outer loop of star 1", "seam of disc".
impl fmt::Display for SeamName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Star { star, side } => write!(f, "{} loop of star {star}", side.loop_name()),
            Self::Piece(name) => write!(f, "seam of {name}"),
        }
    }
}

impl LaidSeam {
    /// A seam of the star `placed`, with ways down and up of `ramp` mm.
    fn of_star(placed: &PlacedStar, seam: &Seam, ramp: f64) -> Self {
        let place = |path: Path| placed.placement.path(&path);
        Self {
            name: SeamName::Star { star: placed.index, side: seam.side },
            lead_in: place(seam.lead_in(ramp)),
            run: place(seam.run()),
            lead_out: place(seam.lead_out(ramp)),
            once: seam.center_line.length(),
            overlap: seam.overlap,
        }
    }

    /// The open seam `run` of the piece `name`, with ways down and up of `ramp` mm, straight on at both ends.
    pub fn open(name: String, run: Path, ramp: f64) -> Self {
        let (lead_in, lead_out) = (straight_in(&run, ramp), straight_out(&run, ramp));
        let once = run.length();
        Self { name: SeamName::Piece(name), lead_in, run, lead_out, once, overlap: 0.0 }
    }
}

impl Design {
    /// The seams of `stars` in the order of sealing, with ways down and up of `ramp` mm.
    pub fn laid_seams(&self, stars: &[&PlacedStar], ramp: f64) -> Vec<LaidSeam> {
        let of_star = |placed: &&PlacedStar| {
            let seams = self.part(placed).seams.iter();
            seams.map(|seam| LaidSeam::of_star(placed, seam, ramp)).collect::<Vec<_>>()
        };
        stars.iter().flat_map(of_star).collect()
    }
}
