//! The centre lines of the bands before they are seams, with the edges and mouths that they belong to.

use crate::AirSide;
use crate::mouth::Mouth;
use geom::Path;

/// A band's centre line before it is a seam.
#[derive(Clone, Debug)]
pub(super) struct Line {
    pub path: Path,
    /// The names of the drawn curves that it comes from.
    pub names: Vec<String>,
    pub kind: LineUse,
    /// Whether its start and end lie on another band.
    pub joined: [bool; 2],
}

/// The purpose of a centre line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum LineUse {
    /// An open weld that ends in the air.
    Weld,
    /// A wall between chambers.
    Wall,
    /// The edge of an island.
    Island,
    /// The outer edge of the air.
    Outer,
}

/// Centre lines, the closed ones before ports open them, the closed edges that the cut follows (with their distance from it),
/// mouths, and the region that the lines enclose.
#[derive(Default)]
pub(super) struct Layout {
    pub lines: Vec<Line>,
    pub closed: Vec<Path>,
    pub edges: Vec<(Path, f64)>,
    pub mouths: Vec<Mouth>,
    pub air: AirSide,
}
