//! Settings of a reader: tolerance, unit, limits.

/// Settings of a reader.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Largest distance of Beziers, ellipses and splines from their arcs, mm; 1e-6 to 10. Lines and circular arcs are exact.
    pub tolerance: f64,
    /// Unit of the file's numbers. `None` takes the unit from the file. A unit given here overrides the file, with a note.
    pub unit: Option<Unit>,
    /// Whether a file without a unit is read with the most likely one, which [`crate::Artwork::assumed`] has; else it is refused.
    pub assume: bool,
    /// Whether a curve that ends where it begins is closed, though the file leaves it open.
    pub closes: bool,
    /// Upper bounds of work and memory.
    pub limits: Limits,
}

impl Options {
    /// Options with a tolerance in mm, the file's own unit, and the default limits.
    pub fn new(tolerance: f64) -> Self {
        Self { tolerance, unit: None, assume: false, closes: true, limits: Limits::default() }
    }
}

/// Upper bounds of work and memory. A file beyond one of them is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Size of the file, bytes.
    pub bytes: usize,
    /// Nodes and entities that are visited, references and arrays resolved.
    pub visits: usize,
    /// Segments of all elements together.
    pub segments: usize,
    /// Text that is read or copied while references are resolved, bytes.
    pub text: usize,
    /// Groups, references or blocks inside one another.
    pub depth: usize,
}

impl Default for Limits {
    /// 64 MB, 500,000 nodes, 100,000 segments, 128 MB of resolved text, 64 levels.
    fn default() -> Self {
        Self { bytes: 64 << 20, visits: 500_000, segments: 100_000, text: 128 << 20, depth: 64 }
    }
}

/// A unit of length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names define the units")]
pub enum Unit {
    Micrometre,
    Millimetre,
    Centimetre,
    Decimetre,
    Metre,
    Mil,
    Inch,
    Foot,
    Yard,
    /// 1/72 in.
    Point,
    /// 1/96 in, as CSS defines it.
    Pixel,
    /// 1/90 in, the pixel of Inkscape before 0.92.
    OldPixel,
}

impl Unit {
    /// All units with their names and lengths in mm.
    const TABLE: [(Self, &'static str, f64); 12] = [
        (Self::Micrometre, "um", 1e-3),
        (Self::Millimetre, "mm", 1.0),
        (Self::Centimetre, "cm", 10.0),
        (Self::Decimetre, "dm", 100.0),
        (Self::Metre, "m", 1000.0),
        (Self::Mil, "mil", 0.0254),
        (Self::Inch, "in", 25.4),
        (Self::Foot, "ft", 304.8),
        (Self::Yard, "yd", 914.4),
        (Self::Point, "pt", 25.4 / 72.0),
        (Self::Pixel, "px", 25.4 / 96.0),
        (Self::OldPixel, "px90", 25.4 / 90.0),
    ];

    /// The unit of this name: um, mm, cm, dm, m, mil, in, ft, yd, pt, px or px90.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::TABLE.iter().find(|row| row.1 == name).map(|row| row.0)
    }

    /// All units with their names.
    pub fn named() -> [(&'static str, Self); 12] {
        Self::TABLE.map(|(unit, name, _)| (name, unit))
    }

    /// The names that [`Unit::from_name`] takes.
    pub fn names() -> impl Iterator<Item = &'static str> {
        Self::TABLE.iter().map(|row| row.1)
    }

    /// Name of the unit.
    pub fn name(self) -> &'static str {
        self.row().1
    }

    /// Length of the unit, mm.
    pub fn millimetres(self) -> f64 {
        self.row().2
    }

    fn row(self) -> &'static (Self, &'static str, f64) {
        &Self::TABLE[self as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_unit_has_its_own_row() {
        for (unit, name, length) in Unit::TABLE {
            assert_eq!((unit.name(), unit.millimetres()), (name, length));
            assert_eq!(Unit::from_name(name), Some(unit));
        }
        assert_eq!(Unit::from_name("furlong"), None);
    }
}
