//! Repairs, warnings and faults of a sketch: each with names, a place and numbers.

use std::fmt;

use geom::Point;

/// A small error of a drawing that was mended.
#[derive(Clone, Debug, PartialEq)]
pub struct Repair {
    /// The curves.
    pub names: Vec<String>,
    /// The place.
    pub place: Point,
    /// The error and its repair.
    pub what: String,
}

/// The kind of a fault or a warning of a sketch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ShapeCode {
    /// A coordinate is not finite.
    NotFinite,
    /// Too many curves on or near each other.
    Crowded,
    /// Two ends are too far apart to be joined.
    Gap,
    /// A curve ends in the open.
    DanglingEnd,
    /// Two curves cross or touch.
    Crossing,
    /// A curve inside an island.
    NestedIsland,
    /// A wall without air on its sides.
    WallOutside,
    /// No room for a band between two edges.
    NoRoom,
    /// Bands overlap.
    BandsOverlap,
    /// The channel of a port meets a band or an edge, or no cut.
    ChannelOverlap,
    /// A tube narrower than two bands.
    NarrowTube,
    /// A passage narrower than the least passage.
    NarrowPassage,
    /// A hinge sharper than the iron is round.
    SharpCorner,
    /// A chamber without a port.
    NoPort,
    /// A port that no edge is near to.
    LostPort,
    /// An edge too short for the port.
    PortTooWide,
    /// Several outlines, or none.
    Outlines,
    /// A cut or a hole in a band, in the air, or across another cut.
    CutInBand,
    /// A valve outside of the air, or with its flange over a band or another valve.
    MisplacedValve,
    /// Little fabric between a hole and another cut.
    ThinWeb,
    /// A way for air other than a port.
    Leak,
    /// The drawing is empty.
    Empty,
}

/// A fault or warning about a shape: the finding, its place, the limit, and the remedy.
#[derive(Clone, Debug, PartialEq)]
pub struct ShapeFault {
    /// Its kind.
    pub code: ShapeCode,
    /// The curves.
    pub names: Vec<String>,
    /// The place.
    pub place: Point,
    /// The value found, mm or a count; NaN where the fault has no value.
    pub found: f64,
    /// The value allowed, in the same unit; NaN where the fault has no value.
    pub allowed: f64,
    /// The finding.
    pub what: String,
    /// The remedy.
    pub remedy: String,
}

/// A place that may fail or differ from the drawing. The shape can be made.
pub type ShapeWarning = ShapeFault;

impl ShapeFault {
    /// A fault of the curves `names` at `place`: the finding and its remedy, and the values found and allowed.
    pub(super) fn new(
        code: ShapeCode,
        names: &[String],
        place: Point,
        (what, remedy): (impl Into<String>, impl Into<String>),
        [found, allowed]: [f64; 2],
    ) -> Self {
        let (names, what, remedy) = (names.to_vec(), what.into(), remedy.into());
        Self { code, names, place, found, allowed, what, remedy }
    }
}

/// "found at (12.000, 40.000): remedy".
impl fmt::Display for ShapeFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { place, what, remedy, .. } = self;
        write!(f, "{what} at ({:.3}, {:.3}): {remedy}", place.x, place.y)
    }
}

/// "'a' and 'b'": the names that are not empty, each once.
pub(super) fn quoted(names: &[String]) -> String {
    let numbered = names.iter().enumerate().filter(|(_, name)| !name.is_empty());
    let known: Vec<&String> =
        numbered.filter(|(i, name)| !names[..*i].contains(name)).map(|(_, name)| name).collect();
    match known.as_slice() {
        [] => "a curve".to_owned(),
        [one] => format!("'{one}'"),
        [one, two] => format!("'{one}' and '{two}'"),
        [one, two, rest @ ..] => format!("'{one}', '{two}' and {} more", rest.len()),
    }
}
