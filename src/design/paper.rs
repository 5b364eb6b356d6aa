//! Paper: a drawing at 1:1 on one large page, or on pages of a printer's size to be taped together.
//!
//! On tiles neighbouring pages show a strip of the same drawing, the **overlap**; in its middle both carry the same
//! **registration crosses**. Cut one page along its crop marks, lay cross on cross, tape. Every page has its name
//! (row, column), a ruler of 100 mm and a check square of 20 mm to be measured before anything is cut.

use serde::{Deserialize, Serialize};

use crate::design::{Drawing, Layer, Origin, Shape, lettering};
use crate::geom::{Bounds, Isometry, Line, Path, Point, Vec2};

/// Strip along the border that printers leave white, mm; 5 mm is common, some need 8.
const WHITE: f64 = 10.0;
/// Height of the strip with ruler, square and name, mm.
const FOOT: f64 = 28.0;
/// What neighbouring tiles share, mm: room for tape and for the crosses.
const OVERLAP: f64 = 10.0;
/// Least width of a large page: ruler, square and name stand side by side.
const LEAST_WIDTH: f64 = 200.0;
/// Most tiles that are written: nobody tapes more than a hundred pages.
const MOST_TILES: f64 = 100.0;

/// Largest page, mm: beyond it a PDF's single precision no longer tells 0.001 mm apart, and no plotter has such paper.
const LARGEST: f64 = 10_000.0;

/// A size of paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Paper {
    /// One page as large as the drawing needs.
    Large,
    /// Tiles on A4, 210 x 297 mm.
    A4,
    /// Tiles on US Letter, 215.9 x 279.4 mm.
    Letter,
}

/// One page at 1:1.
#[derive(Clone, Debug, PartialEq)]
pub struct Page {
    /// "A1" for row A, column 1; rows count from the bottom.
    pub name: String,
    /// The part of the page on which the drawing shows; marks may stand outside.
    pub window: Bounds,
    /// What is on it, in mm from its lower left corner. Shapes run on outside the window, where they are clipped.
    pub drawing: Drawing,
}

impl Paper {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Large, Self::A4, Self::Letter];

    /// Its name in file names and in the manifest; the large page has none.
    pub fn name(self) -> Option<&'static str> {
        match self {
            Self::Large => None,
            Self::A4 => Some("a4"),
            Self::Letter => Some("letter"),
        }
    }

    /// Whether `drawing` can be printed on it: on no more tiles than anyone tapes together, on no page larger than 10 m.
    pub fn takes(self, drawing: &Drawing) -> bool {
        let cut = self.cut(drawing);
        cut.columns * cut.rows <= MOST_TILES && cut.width.max(cut.height) <= LARGEST
    }

    /// The pages on which `drawing` is printed, row by row from the lower left; `caption` names it on every page.
    ///
    /// None if it cannot be printed, see [`Paper::takes`].
    pub fn pages(self, drawing: &Drawing, caption: &str) -> Vec<Page> {
        if !self.takes(drawing) {
            return Vec::new();
        }
        let grid = TileGrid { caption, ..self.cut(drawing) };
        let TileGrid { columns, rows, .. } = grid;
        let mut pages = Vec::new();
        let (mut row, mut letter) = (0.0, 'A');
        while row < rows {
            let mut column = 0.0;
            while column < columns {
                pages.push(grid.page(drawing, row, column, &format!("{letter}{}", column + 1.0)));
                column += 1.0;
            }
            row += 1.0;
            letter = char::from_u32(u32::from(letter) + 1).unwrap_or('Z');
        }
        pages
    }

    /// How `drawing` is cut into pages without a caption.
    fn cut(self, drawing: &Drawing) -> TileGrid<'static> {
        let (width, height) = match self {
            Self::Large => {
                let width = (drawing.width + 2.0 * WHITE).max(LEAST_WIDTH);
                (width, drawing.height + 2.0 * WHITE + FOOT)
            }
            Self::A4 => (210.0, 297.0),
            Self::Letter => (215.9, 279.4),
        };
        let corner = Point::new(WHITE, WHITE + FOOT);
        let window = Bounds { min: corner, max: Point::new(width - WHITE, height - WHITE) };
        let steps = Vec2::new(window.width() - OVERLAP, window.height() - OVERLAP);
        let count = |extent: f64, step: f64| ((extent - OVERLAP) / step - 1e-9).ceil().max(1.0);
        let (columns, rows) = match self {
            Self::Large => (1.0, 1.0),
            _ => (count(drawing.width, steps.x), count(drawing.height, steps.y)),
        };
        TileGrid { width, height, window, steps, columns, rows, caption: "" }
    }
}

/// How a drawing is cut into pages.
struct TileGrid<'a> {
    width: f64,
    height: f64,
    window: Bounds,
    steps: Vec2,
    columns: f64,
    rows: f64,
    caption: &'a str,
}

impl TileGrid<'_> {
    fn page(&self, drawing: &Drawing, row: f64, column: f64, name: &str) -> Page {
        let shown = Vec2::new(column * self.steps.x, row * self.steps.y);
        let shift = (self.window.min - drawing.corner()) - shown;
        let motion = Isometry::translation(shift);
        let mut layers: Vec<(Layer, Vec<Shape>)> = drawing
            .layers
            .iter()
            .map(|(layer, shapes)| {
                let moved = shapes.iter().map(|shape| shape.moved(&motion));
                (*layer, moved.filter_map(|shape| shape.shown(&self.window)).collect())
            })
            .collect();
        layers.push((Layer::PaperMark, vec![Shape::Figure(self.marks(name))]));
        let (width, height) = (self.width, self.height);
        Page {
            name: name.to_owned(),
            window: self.window,
            drawing: Drawing { origin: Origin::LowerLeft, width, height, layers },
        }
    }

    fn marks(&self, name: &str) -> Vec<Path> {
        let mut out = Vec::new();
        let w = &self.window;
        let corners = [
            (w.min, Vec2::new(1.0, 1.0)),
            (Point::new(w.max.x, w.min.y), Vec2::new(-1.0, 1.0)),
            (w.max, Vec2::new(-1.0, -1.0)),
            (Point::new(w.min.x, w.max.y), Vec2::new(1.0, -1.0)),
        ];
        for (corner, inwards) in corners {
            // Crop marks stand in the white strip, a millimetre clear of the window.
            let (x, y) = (Vec2::new(inwards.x, 0.0), Vec2::new(0.0, inwards.y));
            out.push(stroke(&[corner - x * 1.0, corner - x * 5.0]));
            out.push(stroke(&[corner - y * 1.0, corner - y * 5.0]));
            if self.columns * self.rows > 1.0 {
                let middle = corner + inwards * (OVERLAP / 2.0);
                for arm in [Vec2::new(3.0, 0.0), Vec2::new(0.0, 3.0)] {
                    out.push(stroke(&[middle - arm, middle + arm]));
                }
            }
        }
        self.foot(name, &mut out);
        out
    }

    /// Ruler, check square and name.
    fn foot(&self, name: &str, out: &mut Vec<Path>) {
        let at = |x: f64, y: f64| Point::new(WHITE + x, WHITE + y);
        out.push(stroke(&[at(0.0, 2.0), at(100.0, 2.0)]));
        for centimetre in 0_u32..=10 {
            let x = 10.0 * f64::from(centimetre);
            let tall = if centimetre.is_multiple_of(5) { 5.0 } else { 3.0 };
            out.push(stroke(&[at(x, 2.0), at(x, 2.0 + tall)]));
        }
        out.extend(lettering::lettered("100 MM", at(76.0, 6.0), 2.5));
        let (a, b) = (at(110.0, 0.0), at(130.0, 20.0));
        let corners = [a, Point::new(b.x, a.y), b, Point::new(a.x, b.y), a];
        out.push(Path::closed(corners.windows(2).map(|ends| Line::new(ends[0], ends[1]).into()).collect()));
        out.extend(lettering::lettered("20 MM", at(112.5, 9.0), 2.5));
        let (columns, rows) = (self.columns, self.rows);
        let page = format!("PAGE {name} OF {columns} X {rows}");
        out.extend(lettering::lettered(&page, at(0.0, 14.0), 3.0));
        out.extend(lettering::lettered(self.caption, at(0.0, 20.0), 3.0));
        out.extend(lettering::lettered("PRINT AT 100 PER CENT", at(134.0, 9.0), 2.0));
    }
}

fn stroke(points: &[Point]) -> Path {
    Path::open(points.windows(2).map(|ends| Line::new(ends[0], ends[1]).into()).collect())
}
