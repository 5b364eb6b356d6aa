//! A picture of all seal strips of a grid: the place of each, its temperature and speed, and its cut.

use crate::emit::picture::{Anchor, Group, Pen, Picture, Text};
use crate::emit::preview::style::{BAND, CUT, FABRIC, LABEL, PAGE, Style, TEXT};
use geom::{Bounds, Path, Point, Vec2};
use program::text::{inert, shortened};
use spec::NAME_LENGTH;

/// One strip.
pub struct GridCell {
    /// The number on it.
    pub number: usize,
    /// The centre line of its seam.
    pub seam: Path,
    /// The specimen that is cut out of it.
    pub specimen: Bounds,
    /// Settings for sealing, a line each.
    pub words: Vec<String>,
}

/// All cells on one page at 1:1, as an SVG; `band` is the width of the seams, mm.
pub fn cells(title: &str, cells: &[GridCell], band: f64) -> String {
    // One size of letters fits the smallest cell. Fabric, seams and words are groups of their own, drawn in this
    // order.
    let areas = cells.iter().map(|cell| cell.specimen.union(cell.seam.bounds()));
    let bounds = areas.fold(Bounds::EMPTY, Bounds::union);
    let style = Style::new(bounds.width().max(bounds.height()));
    let size = cells.iter().map(|cell| fitting(cell, style)).fold(style.unit, f64::min);
    let (mut fabric, mut seams, mut words) = (Group::new("cut"), Group::new("seal"), Group::new("words"));
    for cell in cells {
        fabric.area(vec![Path::rectangle(&cell.specimen)], FABRIC);
        fabric.line(Path::rectangle(&cell.specimen), style.pen(CUT, 1.0));
        seams.line(cell.seam.clone(), Pen::new(BAND, band));
        let (left_edge, top) = (cell.specimen.min.x, cell.specimen.max.y);
        let number = Text::centered(
            Point::new(cell.specimen.center().x, top - 1.6 * size),
            1.6 * size,
            TEXT,
            cell.number.to_string(),
        );
        words.text(number);
        let mut place = Point::new(left_edge + 0.8 * size, top - 4.2 * size);
        for line in &cell.words {
            words.text(Text { at: place, size, anchor: Anchor::Start, ink: LABEL, content: inert(line, 40) });
            place = place - Vec2::new(0.0, 1.5 * size);
        }
    }
    let head = Point::new(bounds.min.x, bounds.max.y + 2.0 * style.unit);
    let content = format!("{}, seen from the iron's side, 1:1 in mm", shortened(title, NAME_LENGTH));
    let heading = Text { at: head, size: style.unit, anchor: Anchor::Start, ink: TEXT, content };
    let window = bounds.union(heading.bounds()).outset(2.0 * style.unit);
    words.text(heading);
    let mut page = Group::new("page");
    page.area(vec![Path::rectangle(&window)], PAGE);
    let groups = vec![page, fabric, seams, words];
    Picture { title: title.to_owned(), window, top: bounds.max.y, groups }.svg()
}

/// The size of type at which the words of `cell` fit on its specimen.
fn fitting(cell: &GridCell, style: Style) -> f64 {
    let width = |line: &String| Text::centered(Point::ORIGIN, 1.0, LABEL, line.clone()).width();
    let widest = cell.words.iter().map(width).fold(1.0, f64::max);
    style.unit.min(cell.specimen.width() / (widest + 1.6))
}
