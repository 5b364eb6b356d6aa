//! The overview: the first of several pages, the whole drawing made small, with the pages that show it.

use crate::paper::{Page, Tile, TileGrid, foot_point};
use crate::{Drawing, Layer, Shape, lettering};
use geom::{Arc, Bounds, Line, Path, Point, Segment, Vec2};

/// Height of a page's name in the overview, by the smaller side of its part.
const NAME: f64 = 0.2;

impl TileGrid<'_> {
    /// The overview of these `tiles` of `drawing`.
    ///
    /// The drawing, without its labels, and the tiles are scaled to the page's window. Each tile is a rectangle with its name
    /// in the middle; how to print and tape is written in the foot.
    pub(super) fn overview(&self, drawing: &Drawing, tiles: &[Tile]) -> Page {
        let corner = drawing.corner();
        let extent = Bounds { min: corner, max: corner + Vec2::new(drawing.width, drawing.height) };
        let union = tiles.iter().map(|tile| tile.shown).fold(extent, Bounds::union);
        let scale = (self.window.width() / union.width()).min(self.window.height() / union.height());
        let shift = self.window.center() - Point::ORIGIN;
        let small = Scaled { scale, shift: shift - (union.center() - Point::ORIGIN) * scale };
        let mut layers: Vec<(Layer, Vec<Shape>)> = drawing
            .layers
            .iter()
            .filter(|(layer, _)| *layer != Layer::Label)
            .map(|(layer, shapes)| (*layer, shapes.iter().map(|shape| small.shape(shape)).collect()))
            .collect();
        let mut marks: Vec<Path> = Vec::new();
        for tile in tiles {
            marks.push(small.path(&Path::rectangle(&tile.own)));
            let height = NAME * scale * tile.own.width().min(tile.own.height());
            let middle = small.point(tile.own.center());
            let shift = Vec2::new(lettering::width(&tile.name, height), height) * 0.5;
            marks.extend(lettering::lettered(&tile.name, middle - shift, height));
        }
        let count = format!("OVERVIEW, NOT TO SCALE: {} PAGES ON {}", tiles.len(), self.paper_name());
        let lines = [
            (self.caption, 20.0, 3.0),
            (&count, 14.0, 3.0),
            ("PRINT AT 100 PER CENT, MEASURE RULER AND SQUARE", 8.0, 2.5),
            ("OF TWO NEIGHBOURS CUT ONE ALONG ITS MARKS, LAY CROSS ON CROSS, TAPE", 2.0, 2.5),
        ];
        for (text, y, height) in lines {
            marks.extend(lettering::lettered(text, foot_point(0.0, y), height));
        }
        layers.push((Layer::PaperMark, vec![Shape::Figure(marks)]));
        self.framed_page("OVERVIEW", layers)
    }
}

/// Everything smaller by `scale`, then moved by `shift`.
pub(super) struct Scaled {
    pub(super) scale: f64,
    pub(super) shift: Vec2,
}

impl Scaled {
    pub(super) fn point(&self, p: Point) -> Point {
        Point::ORIGIN + (p - Point::ORIGIN) * self.scale + self.shift
    }

    pub(super) fn path(&self, path: &Path) -> Path {
        let segment = |segment: &Segment| -> Segment {
            match segment {
                Segment::Line(line) => Line::new(self.point(line.start), self.point(line.end)).into(),
                Segment::Arc(arc) => {
                    let (center, radius) = (self.point(arc.center), arc.radius * self.scale);
                    Arc { center, radius, ..*arc }.into()
                }
            }
        };
        Path { segments: path.segments.iter().map(segment).collect(), closed: path.closed }
    }

    fn shape(&self, shape: &Shape) -> Shape {
        match shape {
            Shape::Path(path) => Shape::Path(self.path(path)),
            Shape::Circle { center, radius } => {
                Shape::Circle { center: self.point(*center), radius: radius * self.scale }
            }
            Shape::Figure(paths) => Shape::Figure(paths.iter().map(|path| self.path(path)).collect()),
        }
    }
}
