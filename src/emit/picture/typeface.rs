//! The typeface that pictures are lettered with: printable ASCII of DejaVu Sans (templates/font).
//!
//! A PNG is drawn with it. An SVG requests it and falls back to others; all sans-serif faces in wide use are as wide or narrower,
//! so its widths are an upper limit of the room that a text needs.

use std::sync::OnceLock;

use ttf_parser::{GlyphId, OutlineBuilder, RawFace, Tag, cmap, glyf, head, hhea, hmtx, loca, maxp};
use zeno::{Command, Vector};

use geom::{Point, Vec2};
use program::number::single;

const FONT: &[u8] = include_bytes!("../../../templates/font/DejaVuSans-ASCII.ttf");

/// Width of a letter that the face does not have, by the type's size.
const UNKNOWN: f64 = 0.6;

/// The tables of the face that widths and outlines need. [`ttf_parser::Face`] would bring the readers of all others into the page.
struct Typeface {
    letters: cmap::Table<'static>,
    advances: hmtx::Table<'static>,
    outlines: glyf::Table<'static>,
    units_per_em: f64,
}

impl Typeface {
    fn read() -> Option<Self> {
        let face = RawFace::parse(FONT, 0).ok()?;
        let head = head::Table::parse(table(&face, *b"head")?)?;
        let count = maxp::Table::parse(table(&face, *b"maxp")?)?.number_of_glyphs;
        let metrics = hhea::Table::parse(table(&face, *b"hhea")?)?.number_of_metrics;
        let places = loca::Table::parse(count, head.index_to_location_format, table(&face, *b"loca")?)?;
        Some(Self {
            letters: cmap::Table::parse(table(&face, *b"cmap")?)?,
            advances: hmtx::Table::parse(metrics, count, table(&face, *b"hmtx")?)?,
            outlines: glyf::Table::parse(places, table(&face, *b"glyf")?)?,
            units_per_em: f64::from(head.units_per_em),
        })
    }

    fn glyph(&self, letter: char) -> Option<GlyphId> {
        let mut tables = self.letters.subtables.into_iter().filter(cmap::Subtable::is_unicode);
        tables.find_map(|table| table.glyph_index(u32::from(letter)))
    }

    /// Distance that the pen moves on after a letter, by the type's size.
    fn advance(&self, letter: char) -> f64 {
        let units = self.glyph(letter).and_then(|glyph| self.advances.advance(glyph));
        units.map_or(UNKNOWN, |units| f64::from(units) / self.units_per_em)
    }
}

/// The bytes of a table of `face`.
fn table(face: &RawFace<'static>, name: [u8; 4]) -> Option<&'static [u8]> {
    face.table(Tag::from_bytes(&name))
}

/// Width of `text`, by the type's size.
pub(super) fn width(text: &str) -> f64 {
    // Widths are requested thousands of times while labels are placed.
    static ADVANCES: OnceLock<[f64; 128]> = OnceLock::new();
    let advances = ADVANCES.get_or_init(|| {
        let letters = std::array::from_fn(|i| char::from(u8::try_from(i).unwrap_or(0)));
        Typeface::read().map_or([0.0; 128], |face| letters.map(|c| face.advance(c)))
    });
    text.chars().map(|c| advances.get(c as usize).copied().unwrap_or(UNKNOWN)).sum()
}

/// Traces the outlines of the letters of `text`, whose base line begins at `start`, in type of `size`; Y down.
pub(super) fn trace(text: &str, start: Point, size: f64) -> Vec<Command> {
    let mut path = Vec::new();
    let Some(face) = Typeface::read() else { return path };
    let mut distance = 0.0;
    for c in text.chars() {
        let mut letter =
            Letter { start, size, at: distance, scale: 1.0 / face.units_per_em, path: &mut path };
        let _ = face.glyph(c).and_then(|glyph| face.outlines.outline(glyph, &mut letter));
        distance += face.advance(c);
    }
    path
}

/// The outline of a letter, moved to its place and scaled.
struct Letter<'a> {
    start: Point,
    size: f64,
    /// Distance of the letter from the start, by the type's size.
    at: f64,
    scale: f64,
    path: &'a mut Vec<Command>,
}

impl Letter<'_> {
    fn place(&self, x: f32, y: f32) -> Vector {
        let (x, y) = (self.at + f64::from(x) * self.scale, f64::from(y) * self.scale);
        let p = self.start + Vec2::new(x, -y) * self.size;
        Vector::new(single(p.x), single(p.y))
    }
}

impl OutlineBuilder for Letter<'_> {
    fn move_to(&mut self, x: f32, y: f32) {
        let place = self.place(x, y);
        self.path.push(Command::MoveTo(place));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let place = self.place(x, y);
        self.path.push(Command::LineTo(place));
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let (control, place) = (self.place(x1, y1), self.place(x, y));
        self.path.push(Command::QuadTo(control, place));
    }

    /// The outlines of a TrueType face have none.
    fn curve_to(&mut self, _: f32, _: f32, _: f32, _: f32, x: f32, y: f32) {
        self.line_to(x, y);
    }

    fn close(&mut self) {
        self.path.push(Command::Close);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_letter_of_ascii_is_in_the_face() {
        let face = Typeface::read().expect("a face");
        for c in ' '..='~' {
            assert!(face.glyph(c).is_some(), "{c}");
        }
        assert!((width("iiii") - 4.0 * 569.0 / 2048.0).abs() < 1e-12, "{}", width("iiii"));
        assert_eq!(width(""), 0.0);
    }
}
