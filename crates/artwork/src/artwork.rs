//! Artwork, a drawing of a user that was read: elements, and notes on details that were resolved or left out.

use geom::{Path, Point};

use crate::Unit;

/// The figures of a file, in mm with y up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Artwork {
    /// All visible figures in the order of the file.
    pub elements: Vec<Element>,
    /// Notes on details that were resolved, ambiguous or left out, in the order of the file.
    pub notes: Vec<Note>,
    /// Faults of single elements and groups, which are left out. A caller should refuse them unless their layers are ignored.
    pub faults: Vec<Fault>,
    /// The names of the file as a whole: id and label of the root of an SVG. Every element has them last.
    pub root: Vec<String>,
    /// Length of one unit of the file (of the SVG's view box), mm, > 0.
    pub unit_mm: f64,
    /// The unit that was taken since the file states none, if [`crate::Options::assume`] allows it.
    pub assumed: Option<AssumedUnit>,
}

/// A unit of lengths that a file does not state.
#[derive(Clone, Debug, PartialEq)]
pub struct AssumedUnit {
    /// The unit.
    pub unit: Unit,
    /// The reason for which the file's own is not known, a sentence.
    pub reason: String,
}

/// One figure of a drawing: a subpath of an SVG path, or an entity of a DXF file.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    /// The SVG id, or "path at line 12", and if it is not the first element there "path at line 12, column 40"; the type and handle of a DXF entity ("LINE 2F"). Copies have the chain of
    /// their references before it ("use1 > path3"), further subpaths a number behind it ("path3#2").
    pub id: String,
    /// The names of levels by which a role may be given to the element beside its id, innermost first and each once.
    ///
    /// SVG: its own id and label, its stroke as "#rrggbb" (without a stroke: its fill as "fill #rrggbb"), then ids and
    /// labels of the groups and references around it. DXF: the colour of its own as "#rrggbb" or "color 1", its layer,
    /// then the layers of the blocks around it; an entity on layer 0 in a block has the layer of the block alone.
    pub layers: Vec<String>,
    /// Number of names in `layers` that are its own, at least one for a DXF. SVG: id, label and colour. DXF: colour and layer.
    pub own_names: usize,
    /// Number in `layers` of the colour of an SVG's figure. Each of them has one, so it gives a role only where no other name does; a colour
    /// that a DXF entity has of its own is an exception from its layer, and none of these.
    pub colour: Option<usize>,
    /// Geometry of the element.
    pub figure: Figure,
    /// Line of the file, from 1.
    pub line: Option<usize>,
}

/// The geometry of an element, mm.
#[derive(Clone, Debug, PartialEq)]
pub enum Figure {
    /// A chain of lines and arcs, open or closed; it has at least one segment, and none of length 0.
    Path(Path),
    /// A DXF POINT, or an SVG figure without length.
    Point(Point),
}

/// A remark on an element or on the whole file that does not prevent reading.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// Whether geometry that can be seen in the drawing is missing in the elements.
    pub weight: Weight,
    /// The place to which it applies.
    pub place: Place,
    /// Further places to which it applies.
    pub others: Vec<Place>,
    /// The finding, one sentence in plain English.
    pub text: String,
}

/// Effect of a note on the geometry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weight {
    /// The elements have all visible geometry.
    Information,
    /// The drawing hides geometry, which the elements leave out.
    Hidden,
    /// A text, a dimension, a hatch or a construction line is left out. A caller should refuse it where its layer should have curves and
    /// has none.
    Annotation,
    /// An element is read, but not as the drawing shows it. A caller should refuse it unless its layer is ignored.
    Changed,
    /// Something visible is missing. A caller should refuse it unless its layer is ignored.
    Lost,
}

/// A reason for which a file is not read.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// The place.
    pub place: Place,
    /// The finding and the allowed values, one sentence.
    pub text: String,
    /// The step that corrects it, one sentence.
    pub remedy: String,
}

impl Fault {
    /// A fault that ends reading.
    pub(crate) fn single(place: Place, text: impl Into<String>, remedy: &str) -> Vec<Self> {
        vec![Self { place, text: text.into(), remedy: remedy.into() }]
    }
}

/// A place in a file; empty for the file as a whole.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Place {
    /// The element's id, as in [`Element::id`].
    pub element: Option<String>,
    /// Layers of the element, as in [`Element::layers`].
    pub layers: Vec<String>,
    /// Number of its own names among them, as in [`Element::own_names`].
    pub own_names: usize,
    /// Number of its colour among them, as in [`Element::colour`].
    pub colour: Option<usize>,
    /// Line of the file, from 1.
    pub line: Option<usize>,
    /// A point of the element, mm; `None` if unknown.
    pub at: Option<Point>,
}

impl Place {
    /// A line of the file.
    pub(crate) fn line(line: usize) -> Self {
        Self { line: Some(line), ..Self::default() }
    }

    /// Whether it is the file as a whole.
    pub fn is_file(&self) -> bool {
        self.element.is_none() && self.line.is_none() && self.at.is_none()
    }
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match (&self.element, self.line) {
            (Some(id), Some(line)) if !id.contains(&format!("at line {line}")) => {
                write!(f, "{id} (line {line})")?;
            }
            (Some(id), _) => write!(f, "{id}")?,
            (None, Some(line)) => write!(f, "line {line}")?,
            (None, None) => write!(f, "file")?,
        }
        if let Some(point) = self.at {
            write!(f, " at ({:.3}, {:.3}) mm", point.x, point.y)?;
        }
        Ok(())
    }
}

impl std::fmt::Display for Fault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {} {}", self.place, self.text, self.remedy)
    }
}

impl std::fmt::Display for Note {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.others.len() {
            _ if self.place.is_file() => f.write_str(&self.text),
            0 => write!(f, "{}: {}", self.place, self.text),
            more => write!(f, "{} and {more} more: {}", self.place, self.text),
        }
    }
}

impl Element {
    /// All names by which a role may be given, innermost first: the id, then the layers, and last the colour of an SVG's figure.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.id.as_str()).chain(colour_last(&self.layers, self.colour))
    }

    /// The colour of an SVG's figure, as the name of a layer.
    pub fn colour_name(&self) -> Option<&str> {
        self.layers.get(self.colour?).map(String::as_str)
    }
}

impl Place {
    /// All names by which a role may be given to what lies there, as [`Element::names`].
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.element.as_deref().into_iter().chain(colour_last(&self.layers, self.colour))
    }
}

/// The names in `layers`, in their order but for that of number `colour`, which is the last.
fn colour_last(layers: &[String], colour: Option<usize>) -> impl Iterator<Item = &str> {
    let other_names = layers.iter().enumerate().filter(move |(number, _)| Some(*number) != colour);
    let last = colour.and_then(|number| layers.get(number));
    other_names.map(|(_, name)| name.as_str()).chain(last.map(String::as_str))
}

impl Note {
    /// All places to which it applies.
    pub fn places(&self) -> impl Iterator<Item = &Place> {
        std::iter::once(&self.place).chain(&self.others)
    }
}
