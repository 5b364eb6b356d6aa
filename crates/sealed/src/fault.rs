//! Repairs, warnings and faults of a sketch, each with names, a place and values: the **notes** that a pass returns beside its result.

use std::fmt;
use std::ops::AddAssign;

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
    /// The kind.
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
    /// A fault at `place` without curves and without values: the finding and its remedy.
    pub(crate) fn new(
        code: ShapeCode,
        place: Point,
        finding: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self {
            code,
            names: Vec::new(),
            place,
            found: f64::NAN,
            allowed: f64::NAN,
            what: finding.into(),
            remedy: remedy.into(),
        }
    }
}

/// "found at (12.000, 40.000): remedy".
impl fmt::Display for ShapeFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { place, what: finding, remedy, .. } = self;
        write!(f, "{finding} at ({:.3}, {:.3}): {remedy}", place.x, place.y)
    }
}

/// Names in a message, "'a' and 'b'": those that are not empty, each once.
pub(crate) struct Quoted<'a>(pub &'a [String]);

impl fmt::Display for Quoted<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(names) = self;
        let numbered = names.iter().enumerate().filter(|(_, name)| !name.is_empty());
        let distinct: Vec<&String> =
            numbered.filter(|(i, name)| !names[..*i].contains(name)).map(|(_, name)| name).collect();
        match distinct.as_slice() {
            [] => f.write_str("a curve"),
            [name] => write!(f, "'{name}'"),
            [first, second] => write!(f, "'{first}' and '{second}'"),
            [first, second, rest @ ..] => write!(f, "'{first}', '{second}' and {} more", rest.len()),
        }
    }
}

/// A name in a message: "'a'", or "a curve" where it is empty.
pub(crate) fn quoted(name: &String) -> Quoted<'_> {
    Quoted(std::slice::from_ref(name))
}

/// Curves and ports as the two sides of a place; along a curve there is a `word`, such as "band".
pub(crate) fn flank_text(curves: &[String], ports: &[String], word: &str) -> String {
    match (curves, ports) {
        (curves, []) => format!("the {word}s of {}", Quoted(curves)),
        ([], [port]) => format!("the channel of port {}", quoted(port)),
        ([], ports) => format!("the channels of ports {}", Quoted(ports)),
        (curves, ports) => {
            format!("the channel of port {} and the {word} of {}", Quoted(ports), Quoted(curves))
        }
    }
}

/// The names of the curves `sources`, of which `names` has all.
pub(crate) fn named(sources: &[usize], names: &[String]) -> Vec<String> {
    sources.iter().filter_map(|source| names.get(*source).cloned()).collect()
}

/// Too many curves lie on or near each other for them to be compared; a place among them.
pub(crate) struct Crowd(pub Point);

/// Repairs, warnings and faults in the order in which they are found.
#[derive(Default)]
pub(crate) struct SealingNotes {
    pub repairs: Vec<Repair>,
    pub warnings: Vec<ShapeWarning>,
    pub faults: Vec<ShapeFault>,
}

/// The result of a pass, with its notes.
pub(crate) type Noted<T> = (T, SealingNotes);

impl AddAssign for SealingNotes {
    /// Adds later notes.
    fn add_assign(&mut self, notes: Self) {
        self.repairs.extend(notes.repairs);
        self.warnings.extend(notes.warnings);
        self.faults.extend(notes.faults);
    }
}

impl SealingNotes {
    /// The result of a comparison; nothing, with a fault, where too many curves lie near each other.
    pub(crate) fn unless_crowded<T: Default>(&mut self, comparison: Result<T, Crowd>) -> T {
        comparison.unwrap_or_else(|Crowd(place)| {
            let finding = "too many curves lie on or near each other";
            let remedy = "remove copies and hatches, or put them on an ignored layer";
            self.faults.push(ShapeFault::new(ShapeCode::Crowded, place, finding, remedy));
            T::default()
        })
    }

    /// Notes that a gap of `gap` mm between the curves `names` was closed.
    pub(crate) fn gap_closed(&mut self, names: Vec<String>, place: Point, gap: f64) {
        let gap = if gap < 1e-4 { "less than 0.0001".to_owned() } else { format!("{gap:.4}") };
        let finding = format!("gap of {gap} mm in {} closed", Quoted(&names));
        self.repairs.push(Repair { names, place, what: finding });
    }
}
