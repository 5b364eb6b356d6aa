//! A **picture**: a list of marks on a page, in the frame of the drawing. The writers of SVG and PNG share it.

mod png;
mod png_file;
mod svg;
mod typeface;

pub(super) use png_file::crc32;

use geom::{Bounds, Path, Point, Vec2};

/// Marks on a page, group by group, the later above the earlier.
pub(super) struct Picture {
    /// The title of the picture.
    pub(super) title: String,
    /// The part of the plane that is shown; millimetres, Y up.
    pub(super) window: Bounds,
    /// The height of the plane that becomes ordinate 0 of an SVG, whose Y runs down.
    pub(super) top: f64,
    /// The marks.
    pub(super) groups: Vec<Group>,
}

/// Marks that belong together.
pub(super) struct Group {
    /// Name of the group: letters, digits and `-`.
    name: String,
    marks: Vec<Mark>,
}

/// Something that is seen.
enum Mark {
    /// The region inside an odd number of these paths.
    Area { paths: Vec<Path>, ink: Colour },
    /// A line along a path.
    Line { path: Path, pen: Pen },
    /// A line of text.
    Text(Text),
}

/// A colour: red, green, blue.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct Colour(pub(super) u8, pub(super) u8, pub(super) u8);

/// The style of a line.
#[derive(Clone, Copy)]
pub(super) struct Pen {
    ink: Colour,
    /// Width of the line, mm.
    width: f64,
    /// Lengths of a dash and of a gap, mm; `None` for an unbroken line.
    dash: Option<[f64; 2]>,
}

/// The part of a text that is placed at its point.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    /// The beginning of the text.
    Start,
    /// The middle of the text.
    Middle,
    /// The end of the text.
    End,
}

/// A line of text.
#[derive(Clone)]
pub(super) struct Text {
    /// The place of its anchor on its base line.
    pub(super) at: Point,
    /// Size of the type, mm.
    pub(super) size: f64,
    /// The part of the text at this place.
    pub(super) anchor: Anchor,
    /// Colour of the characters.
    pub(super) ink: Colour,
    /// Characters: printable ASCII.
    pub(super) content: String,
}

/// Height of type above its base line, and depth below it, by its size.
const RISE: f64 = 0.76;
const FALL: f64 = 0.24;

impl Text {
    /// A text whose box has its middle at `center`.
    pub(super) fn centered(center: Point, size: f64, ink: Colour, content: impl Into<String>) -> Self {
        let text = Self { at: center, size, anchor: Anchor::Middle, ink, content: content.into() };
        text.centered_at(center)
    }

    /// The text with the middle of its box at `center`.
    pub(super) fn centered_at(self, center: Point) -> Self {
        Self { at: center - Vec2::new(0.0, 0.5 * (RISE - FALL) * self.size), anchor: Anchor::Middle, ..self }
    }

    /// The place of its first letter, for a text of this width.
    fn start(&self, width: f64) -> Point {
        let share = match self.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => 0.5,
            Anchor::End => 1.0,
        };
        self.at - Vec2::new(share * width, 0.0)
    }

    /// Width of the text, mm.
    pub(super) fn width(&self) -> f64 {
        typeface::width(&self.content) * self.size
    }

    /// Box of the text, in a face no wider than the one that pictures are measured with.
    pub(super) fn bounds(&self) -> Bounds {
        let width = self.width();
        let start = self.start(width);
        let (rise, fall) = (Vec2::new(width, RISE * self.size), Vec2::new(0.0, FALL * self.size));
        Bounds { min: start - fall, max: start + rise }
    }
}

impl Pen {
    /// An unbroken line.
    pub(super) fn new(ink: Colour, width: f64) -> Self {
        Self { ink, width, dash: None }
    }

    /// The pen with dashes.
    pub(super) fn dashed(self, dash: f64, gap: f64) -> Self {
        Self { dash: Some([dash, gap]), ..self }
    }
}

impl Group {
    /// A group without marks.
    pub(super) fn new(name: impl Into<String>) -> Self {
        Self { name: name.into(), marks: Vec::new() }
    }

    /// Fills the region inside an odd number of `paths`.
    pub(super) fn area(&mut self, paths: Vec<Path>, ink: Colour) {
        self.marks.push(Mark::Area { paths, ink });
    }

    /// Draws a line along `path`.
    pub(super) fn line(&mut self, path: Path, pen: Pen) {
        self.marks.push(Mark::Line { path, pen });
    }

    /// Writes `text`.
    pub(super) fn text(&mut self, text: Text) {
        self.marks.push(Mark::Text(text));
    }
}
