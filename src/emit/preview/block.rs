//! The text below the picture: blocks of lines, side by side as far as there is room, with a swatch before a line that explains a
//! colour.

use crate::emit::picture::{Anchor, Colour, Group, Pen, Text};
use crate::emit::preview::style::{CODE, Style, TEXT, circle, straight};
use crate::link::LinkCode;
use geom::{Bounds, Path, Point, Vec2};

/// Lines under a heading, and a QR code under the lines.
pub(super) struct Block<'a> {
    heading: String,
    lines: Vec<(Option<Swatch>, String)>,
    code: Option<&'a LinkCode>,
}

/// The mark that a line explains.
#[derive(Clone, Copy)]
pub(super) enum Swatch {
    /// An area.
    Area(Colour),
    /// A line.
    Line(Pen),
    /// A dot.
    Dot(Colour),
    /// A length at the picture's scale, mm.
    Scale(f64),
}

/// From line to line, by the type's size.
const STEP: f64 = 1.6;
/// Indent of lines that begin with a blank, by the type's size.
const INDENT: f64 = 1.2;
/// Between blocks, by the type's size.
const GAP: f64 = 3.0;
/// Side of a module of a code, by the type's size: three pixels and a half of a PNG.
const MODULE: f64 = 0.3;

impl<'a> Block<'a> {
    pub(super) fn new(heading: impl Into<String>) -> Self {
        Self { heading: heading.into(), lines: Vec::new(), code: None }
    }

    pub(super) fn say(&mut self, line: impl Into<String>) {
        self.lines.push((None, line.into()));
    }

    pub(super) fn explain(&mut self, swatch: Swatch, line: impl Into<String>) {
        self.lines.push((Some(swatch), line.into()));
    }

    /// With the QR code of a link.
    pub(super) fn with_code(self, code: &'a LinkCode) -> Self {
        Self { code: Some(code), ..self }
    }

    fn texts(&self, corner: Point, style: Style) -> impl Iterator<Item = (Option<Swatch>, Text)> {
        let head = (1.15 * style.unit, 0.0, None, &self.heading);
        let rest = self.lines.iter().map(move |(swatch, line)| {
            (style.unit, swatch.map_or(0.0, |swatch| swatch.width(style)), *swatch, line)
        });
        let mut down = 0.0;
        std::iter::once(head).chain(rest).map(move |(size, indent, swatch, content)| {
            down += STEP * style.unit;
            // SVG shows no blanks at a line's beginning.
            let words = content.trim_start();
            let blanks = if words.len() < content.len() { INDENT * style.unit } else { 0.0 };
            let place = corner + Vec2::new(indent + blanks, -down);
            (swatch, Text { at: place, size, anchor: Anchor::Start, ink: TEXT, content: words.to_owned() })
        })
    }

    pub(super) fn width(&self, style: Style) -> f64 {
        let right = |(_, text): (_, Text)| text.bounds().max.x;
        self.texts(Point::ORIGIN, style).map(right).fold(self.code_side(style), f64::max)
    }

    fn height(&self, style: Style) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "a few lines")]
        let lines = 1.0 + self.lines.len() as f64;
        lines * STEP * style.unit + self.code_side(style)
    }

    /// Side of the code with its quiet zone; 0 without a code.
    fn code_side(&self, style: Style) -> f64 {
        self.code.map_or(0.0, |code| MODULE * style.unit * f64::from(code.side()))
    }

    fn draw(&self, group: &mut Group, corner: Point, style: Style) {
        for (swatch, text) in self.texts(corner, style) {
            if let Some(swatch) = swatch {
                swatch.draw(group, Point::new(corner.x, text.at.y + 0.3 * style.unit), style);
            }
            group.text(text);
        }
        if let Some(code) = self.code {
            let corner = corner - Vec2::new(0.0, self.height(style) - self.code_side(style));
            let run = |[x, y, length]: [i32; 3]| {
                let [min, max] = [(x, y + 1), (x + length, y)]
                    .map(|(x, y)| corner + Vec2::new(f64::from(x), -f64::from(y)) * (MODULE * style.unit));
                Path::rectangle(&Bounds { min, max })
            };
            group.area(code.runs().into_iter().map(run).collect(), CODE);
        }
    }
}

impl Swatch {
    /// Room before its line, mm.
    fn width(self, style: Style) -> f64 {
        match self {
            Self::Scale(length) => length + 0.8 * style.unit,
            _ => 3.6 * style.unit,
        }
    }

    /// Draws it, from `left_end` to the right.
    fn draw(self, group: &mut Group, left_end: Point, style: Style) {
        let (unit, right) = (style.unit, Vec2::new(1.0, 0.0));
        let half_height = Vec2::new(0.0, 0.4 * unit);
        match self {
            Self::Area(ink) => {
                let area = Bounds {
                    min: left_end - half_height,
                    max: left_end + right * (2.8 * unit) + half_height,
                };
                group.area(vec![Path::rectangle(&area)], ink);
                group.line(Path::rectangle(&area), style.pen(TEXT, 0.6));
            }
            Self::Line(pen) => group.line(straight(left_end, left_end + right * (2.8 * unit)), pen),
            Self::Dot(ink) => group.area(vec![circle(left_end + right * (1.4 * unit), 0.4 * unit)], ink),
            Self::Scale(length) => {
                let (from, to) = (left_end, left_end + right * length);
                for (a, b) in [
                    (from, to),
                    (from - half_height, from + half_height),
                    (to - half_height, to + half_height),
                ] {
                    group.line(straight(a, b), style.pen(TEXT, 1.5));
                }
            }
        }
    }
}

/// Draws the blocks from the upper left corner `corner`, each as high as there is room and then as far left, none reaching beyond `width` that
/// need not; their height.
pub(super) fn flow(group: &mut Group, blocks: &[Block<'_>], corner: Point, width: f64, style: Style) -> f64 {
    // Left, right with the gap, and foot of each block that is drawn.
    let mut placed: Vec<[f64; 3]> = Vec::new();
    for block in blocks {
        let wide = block.width(style);
        let top = |left: f64| {
            let feet_above = placed
                .iter()
                .filter(|[other, right, _]| left < *right && *other < left + wide + GAP * style.unit);
            feet_above.map(|[_, _, foot]| foot + style.unit).fold(0.0, f64::max)
        };
        let lefts =
            placed.iter().flat_map(|[left, right, _]| [*left, *right]).filter(|left| left + wide <= width);
        let (left, down) = lefts.map(|left| (left, top(left))).fold((0.0, top(0.0)), |best, next| {
            if (next.1, next.0) < (best.1, best.0) { next } else { best }
        });
        block.draw(group, corner + Vec2::new(left, -down), style);
        placed.push([left, left + wide + GAP * style.unit, down + block.height(style)]);
    }
    placed.iter().map(|[_, _, foot]| *foot).fold(0.0, f64::max)
}
