//! Paper: a drawing at 1:1 on one large page, or on pages of a printer's size to be taped together.
//!
//! On tiles neighbouring pages show a strip of the same drawing, the **overlap**; in its middle both carry the same
//! **registration crosses**. Cut one page along its crop marks, lay cross on cross, tape. Every page has its name
//! (row, column; the top row is A), its paper, a ruler of 100 mm and a check square of 20 mm to be measured before anything is
//! cut. The first page is an overview of all others; tiles on which nothing of the part lies are left out.

use serde::{Deserialize, Serialize};

use crate::coverage::{extent, shows};
use crate::{Drawing, Layer, Origin, Shape, lettering};
use geom::{Bounds, Isometry, Path, Point, Vec2};

/// Strip along the border that printers leave white, mm: 3 to 6 mm are common, some inkjets need half an inch at the bottom,
/// and a page may go in either way up.
const WHITE: f64 = 12.7;
/// From the white strip to the window, mm: room for crop marks.
const MARKS: f64 = 4.0;
/// Height of the strip with ruler, square and name, mm.
const FOOT: f64 = 28.0;
/// Overlap of neighbouring tiles, mm: room for tape and for the crosses, and the least one, where it saves pages.
const OVERLAP: f64 = 10.0;
const LEAST_OVERLAP: f64 = 8.0;
/// Least width of a large page: ruler, square and name side by side.
const LEAST_WIDTH: f64 = 215.0;
/// Most tiles that are written: more than a hundred pages are not taped together.
const MOST_TILES: f64 = 100.0;

/// Largest page, mm: beyond it a PDF's single precision cannot express 0.001 mm, and no plotter has such paper.
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
    /// "A1" for row A, column 1; rows count from the top. "OVERVIEW" for the first of several.
    pub name: String,
    /// The part of the page on which the drawing shows; marks may be outside.
    pub window: Bounds,
    /// The shapes on it, in mm from its lower left corner. Shapes run on outside the window, where they are clipped.
    pub drawing: Drawing,
}

impl Paper {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Large, Self::A4, Self::Letter];

    /// Name of the paper in file names and in the manifest; the large page has none.
    pub fn name(self) -> Option<&'static str> {
        match self {
            Self::Large => None,
            Self::A4 => Some("a4"),
            Self::Letter => Some("letter"),
        }
    }

    /// Width and height of what one page shows of a drawing, mm; of a large page as much as the drawing has.
    pub fn window(self) -> [f64; 2] {
        let empty_drawing =
            Drawing { origin: Origin::LowerLeft, width: 0.0, height: 0.0, layers: Vec::new() };
        let area = Bounds { min: Point::ORIGIN, max: Point::ORIGIN };
        let window = self.grid(&empty_drawing, area, false, OVERLAP).window;
        [window.width(), window.height()]
    }

    /// What a drawing would need on it that is not written.
    pub fn excess(self) -> String {
        match self {
            Self::Large => format!("a page of more than {} m", LARGEST / 1000.0),
            Self::A4 | Self::Letter => format!("more than {MOST_TILES} pages"),
        }
    }

    /// Whether `drawing` can be printed on it: on at most 100 tiles, and on no page larger than 10 m.
    pub fn has_room_for(self, drawing: &Drawing) -> bool {
        // Of several grids a printable one has the fewest pages, see [`TileGrid::page_count`]: they need not be counted.
        self.upright(drawing).is_printable() || self.alternatives(drawing).iter().any(TileGrid::is_printable)
    }

    /// The pages on which `drawing` is printed, row by row from the upper left; `caption` names it on every page. Where they are
    /// several, an overview comes first.
    ///
    /// Empty if it cannot be printed, see [`Paper::has_room_for`].
    pub fn pages(self, drawing: &Drawing, caption: &str) -> Vec<Page> {
        let grid = TileGrid { caption, ..self.cut(drawing) };
        if !grid.is_printable() {
            return Vec::new();
        }
        let tiles = grid.tiles(drawing);
        let grid = TileGrid { alone: tiles.len() == 1, ..grid };
        let overview = (tiles.len() > 1).then(|| grid.overview(drawing, &tiles));
        overview.into_iter().chain(tiles.iter().map(|tile| grid.page(drawing, tile))).collect()
    }

    /// The pages of `drawing` without a caption: on paper that stands or lies, from the drawing's corner or from that of what is drawn, with an
    /// ordinary or a small overlap, as it takes the fewest pages. Of equals the first is taken.
    fn cut(self, drawing: &Drawing) -> TileGrid<'static> {
        let upright = self.upright(drawing);
        if upright.columns * upright.rows <= 1.0 {
            return upright;
        }
        let (mut best, mut fewest) = (upright.page_count(drawing), upright);
        for grid in self.alternatives(drawing) {
            let count = grid.page_count(drawing);
            if count < best {
                (best, fewest) = (count, grid);
            }
        }
        fewest
    }

    /// The grid of paper that stands, from the drawing's corner, with an ordinary overlap.
    fn upright(self, drawing: &Drawing) -> TileGrid<'static> {
        self.grid(drawing, sheet_area(drawing), false, OVERLAP)
    }

    /// All other grids, in the order of preference.
    fn alternatives(self, drawing: &Drawing) -> [TileGrid<'static>; 5] {
        let part = extent(drawing);
        [
            self.grid(drawing, sheet_area(drawing), true, OVERLAP),
            self.grid(drawing, part, false, OVERLAP),
            self.grid(drawing, part, true, OVERLAP),
            self.grid(drawing, part, false, LEAST_OVERLAP),
            self.grid(drawing, part, true, LEAST_OVERLAP),
        ]
    }

    /// The division of the part `extent` of a drawing into pages; `is_turned` turns the paper.
    ///
    /// The window is what a printer prints without marks and foot. Neighbours overlap, so each page after the first adds a
    /// window less the `overlap`. The large page grows with the drawing instead.
    fn grid(self, drawing: &Drawing, extent: Bounds, is_turned: bool, overlap: f64) -> TileGrid<'static> {
        let (width, height) = match self {
            Self::Large => {
                let border = 2.0 * (WHITE + MARKS);
                ((drawing.width + border).max(LEAST_WIDTH), drawing.height + border - MARKS + FOOT)
            }
            Self::A4 => (210.0, 297.0),
            Self::Letter => (215.9, 279.4),
        };
        let (width, height) = if is_turned { (height, width) } else { (width, height) };
        let border = WHITE + MARKS;
        let corner = Point::new(border, WHITE + FOOT);
        let window = Bounds { min: corner, max: Point::new(width - border, height - border) };
        let steps = Vec2::new(window.width() - overlap, window.height() - overlap);
        let (columns, rows) = match self {
            Self::Large => (1.0, 1.0),
            _ => (
                tiles_along(extent.width(), steps.x, overlap),
                tiles_along(extent.height(), steps.y, overlap),
            ),
        };
        TileGrid {
            paper: self,
            corner: extent.min,
            width,
            height,
            window,
            overlap,
            steps,
            columns,
            rows,
            alone: false,
            caption: "",
        }
    }
}

/// The area of a drawing, with or without anything in it.
fn sheet_area(drawing: &Drawing) -> Bounds {
    let corner = drawing.corner();
    Bounds { min: corner, max: corner + Vec2::new(drawing.width, drawing.height) }
}

fn tiles_along(extent: f64, step: f64, overlap: f64) -> f64 {
    ((extent - overlap) / step - 1e-9).ceil().max(1.0)
}

/// The division of a drawing into pages.
pub(super) struct TileGrid<'a> {
    paper: Paper,
    /// Where the lowest tile at the left begins, in the drawing.
    corner: Point,
    pub(super) width: f64,
    pub(super) height: f64,
    pub(super) window: Bounds,
    /// Of neighbours, mm.
    overlap: f64,
    steps: Vec2,
    columns: f64,
    rows: f64,
    /// Whether only one of its tiles is a page: the others are empty.
    alone: bool,
    pub(super) caption: &'a str,
}

/// One page of a grid.
pub(super) struct Tile {
    /// "A1"
    pub(super) name: String,
    /// The part of the drawing that it shows.
    pub(super) shown: Bounds,
    /// The part that only it shows, to the middle of every overlap.
    pub(super) own: Bounds,
}

impl TileGrid<'_> {
    /// Whether its tiles are not too many and its pages not too large.
    fn is_printable(&self) -> bool {
        self.columns * self.rows <= MOST_TILES && self.width.max(self.height) <= LARGEST
    }

    /// The number of tiles on which something of the part lies; the largest number if the grid has too many.
    fn page_count(&self, drawing: &Drawing) -> usize {
        if self.columns * self.rows > MOST_TILES { usize::MAX } else { self.tiles(drawing).len() }
    }

    /// The tiles on which something of the part lies, top row first.
    fn tiles(&self, drawing: &Drawing) -> Vec<Tile> {
        let mut tiles = Vec::new();
        let (mut row, mut letter) = (self.rows - 1.0, 'A');
        while row >= 0.0 {
            let mut column = 0.0;
            while column < self.columns {
                let shift = Vec2::new(column * self.steps.x, row * self.steps.y);
                let min = self.corner + shift;
                let seen_area = Bounds { min, max: min + (self.window.max - self.window.min) };
                let (right, top) = (column + 1.0 < self.columns, row + 1.0 < self.rows);
                let low = Vec2::new(self.half_overlap(column > 0.0), self.half_overlap(row > 0.0));
                let high = Vec2::new(self.half_overlap(right), self.half_overlap(top));
                let own_area = Bounds { min: seen_area.min + low, max: seen_area.max - high };
                if shows(drawing, &own_area) {
                    tiles.push(Tile {
                        name: format!("{letter}{}", column + 1.0),
                        shown: seen_area,
                        own: own_area,
                    });
                }
                column += 1.0;
            }
            row -= 1.0;
            letter = char::from_u32(u32::from(letter) + 1).unwrap_or('Z');
        }
        tiles
    }

    /// Half the overlap with a neighbour, if there is one.
    fn half_overlap(&self, has_neighbour: bool) -> f64 {
        if has_neighbour { self.overlap / 2.0 } else { 0.0 }
    }

    fn page(&self, drawing: &Drawing, tile: &Tile) -> Page {
        let motion = Isometry::translation(self.window.min - tile.shown.min);
        let mut layers: Vec<(Layer, Vec<Shape>)> = drawing
            .layers
            .iter()
            .map(|(layer, shapes)| {
                let moved = shapes.iter().map(|shape| shape.moved(&motion));
                (*layer, moved.filter_map(|shape| shape.clipped(&self.window)).collect())
            })
            .collect();
        layers.push((Layer::PaperMark, vec![Shape::Figure(self.marks(&tile.name))]));
        self.framed_page(&tile.name, layers)
    }

    /// A page of this paper.
    pub(super) fn framed_page(&self, name: &str, layers: Vec<(Layer, Vec<Shape>)>) -> Page {
        let (width, height) = (self.width, self.height);
        Page {
            name: name.to_owned(),
            window: self.window,
            drawing: Drawing { origin: Origin::LowerLeft, width, height, layers },
        }
    }

    /// The name of the paper on its pages.
    pub(super) fn paper_name(&self) -> String {
        self.paper.name().map_or("ONE LARGE PAGE".to_owned(), str::to_uppercase)
    }

    fn marks(&self, name: &str) -> Vec<Path> {
        let mut strokes = Vec::new();
        let w = &self.window;
        let corners = [
            (w.min, Vec2::new(1.0, 1.0)),
            (Point::new(w.max.x, w.min.y), Vec2::new(-1.0, 1.0)),
            (w.max, Vec2::new(-1.0, -1.0)),
            (Point::new(w.min.x, w.max.y), Vec2::new(1.0, -1.0)),
        ];
        for (corner, inwards) in corners {
            // A millimetre clear of the window.
            let (x, y) = (Vec2::new(inwards.x, 0.0), Vec2::new(0.0, inwards.y));
            strokes.push(Path::polyline(&[corner - x * 1.0, corner - x * MARKS]));
            strokes.push(Path::polyline(&[corner - y * 1.0, corner - y * MARKS]));
            if self.columns * self.rows > 1.0 && !self.alone {
                let middle = corner + inwards * (self.overlap / 2.0);
                for arm in [Vec2::new(3.0, 0.0), Vec2::new(0.0, 3.0)] {
                    strokes.push(Path::polyline(&[middle - arm, middle + arm]));
                }
            }
        }
        self.foot(name, &mut strokes);
        strokes
    }

    /// Ruler, check square and name.
    fn foot(&self, name: &str, strokes: &mut Vec<Path>) {
        strokes.push(Path::polyline(&[foot_point(0.0, 2.0), foot_point(100.0, 2.0)]));
        for centimetre in 0_u32..=10 {
            let x = 10.0 * f64::from(centimetre);
            let tall = if centimetre.is_multiple_of(5) { 5.0 } else { 3.0 };
            strokes.push(Path::polyline(&[foot_point(x, 2.0), foot_point(x, 2.0 + tall)]));
        }
        strokes.extend(lettering::lettered("100 MM", foot_point(76.0, 6.0), 2.5));
        strokes.push(Path::rectangle(&Bounds { min: foot_point(110.0, 0.0), max: foot_point(130.0, 20.0) }));
        strokes.extend(lettering::lettered("20 MM", foot_point(112.5, 9.0), 2.5));
        let (columns, rows, paper) = (self.columns, self.rows, self.paper_name());
        let page = match self.paper {
            Paper::Large => paper,
            _ if self.alone => format!("ONE PAGE ON {paper}"),
            _ => format!("PAGE {name} OF {rows} X {columns} ON {paper}"),
        };
        strokes.extend(lettering::lettered(&page, foot_point(0.0, 14.0), 3.0));
        strokes.extend(lettering::lettered(self.caption, foot_point(0.0, 20.0), 3.0));
        strokes.extend(lettering::lettered("PRINT AT 100 PER CENT", foot_point(134.0, 9.0), 2.0));
    }
}

/// A point of the foot, from the lower left corner of the area that every printer prints.
pub(super) fn foot_point(x: f64, y: f64) -> Point {
    Point::new(WHITE + x, WHITE + y)
}

#[cfg(test)]
mod tests;
