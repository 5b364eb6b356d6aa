//! Pages of a ring and of strips: nothing is lost, no page is wasted.

use super::*;
use std::f64::consts::TAU;

/// A ring on paper much smaller than it.
fn ring() -> Drawing {
    let layers = [(Layer::FrameOpening, 300.0), (Layer::FrameEdge, 420.0)]
        .map(|(layer, radius)| (layer, vec![Shape::Circle { center: Point::ORIGIN, radius }]))
        .to_vec();
    Drawing { origin: Origin::Axis(Point::new(-421.0, -421.0)), width: 842.0, height: 842.0, layers }
}

#[test]
fn no_line_is_lost_with_the_pages_that_are_left_out() {
    let drawing = ring();
    for paper in [Paper::A4, Paper::Letter] {
        let grid = paper.cut(&drawing);
        let tiles = grid.tiles(&drawing);
        let total = grid.columns * grid.rows;
        let count = f64::from(u32::try_from(tiles.len()).expect("few"));
        assert!(count < total, "{paper:?}: {count} of {total}");
        for i in 0..3600 {
            let direction = TAU * f64::from(i) / 3600.0;
            for radius in [300.0, 420.0] {
                let p = Point::polar(radius, direction);
                let holders = tiles.iter().filter(|tile| tile.own.contains(p)).count();
                assert!(holders >= 1 && tiles.iter().any(|tile| tile.shown.contains(p)), "{paper:?} {p:?}");
            }
        }
        // The axis lies in the opening, where there is nothing to print, unless its page shows some of the ring.
        let around_axis = |tile: &&Tile| tile.own.contains(Point::ORIGIN);
        assert!(tiles.iter().filter(around_axis).all(|tile| shows(&drawing, &tile.own)));
    }
}

#[test]
fn several_pages_come_top_row_first_behind_their_overview() {
    let pages = Paper::A4.pages(&ring(), "RING");
    let names: Vec<&str> = pages.iter().map(|page| page.name.as_str()).collect();
    assert_eq!(names[0], "OVERVIEW");
    let mut sorted = names[1..].to_vec();
    sorted.sort_unstable();
    assert_eq!(names[1..], sorted);
    // The axis is below the window of the first row, above that of the last.
    let opening = |page: &Page| page.drawing.layers[0].1[0].bounds().center();
    let with_opening = |page: &&Page| !page.drawing.layers[0].1.is_empty();
    let first = pages[1..].iter().find(with_opening).expect("a page");
    let last = pages[1..].iter().rev().find(with_opening).expect("a page");
    assert!(opening(first).y < first.window.min.y && opening(last).y > last.window.max.y);
    assert_eq!(Paper::Large.pages(&ring(), "RING").len(), 1);
}

/// A strip that needs two pages on upright A4 needs one that lies, wherever it lies on its sheet.
#[test]
fn paper_is_turned_and_moved_where_that_saves_pages() {
    let strip = |width: f64, x: f64, y: f64| {
        let edge = Bounds { min: Point::new(x, y), max: Point::new(x + width, y + 100.0) };
        let layers = vec![(Layer::CutOutside, vec![Shape::Figure(vec![Path::rectangle(&edge)])])];
        Drawing { origin: Origin::LowerLeft, width: 700.0, height: 400.0, layers }
    };
    for (width, x, y, pages, is_turned) in
        [(242.0, 15.0, 12.0, 1, true), (242.0, 333.0, 171.0, 1, true), (150.0, 100.0, 200.0, 1, false)]
    {
        let pages_of = Paper::A4.pages(&strip(width, x, y), "STRIP");
        assert_eq!(pages_of.len(), pages, "{width} {x} {y}");
        assert_eq!(pages_of[0].drawing.width > pages_of[0].drawing.height, is_turned, "{width} {x} {y}");
    }
}

/// The overlap and the number of the pages of a part that is `width` wide.
fn overlap_and_tiles(width: f64) -> (f64, usize) {
    let edge = Bounds { min: Point::new(10.0, 10.0), max: Point::new(10.0 + width, 180.0) };
    let layers = vec![(Layer::CutOutside, vec![Shape::Figure(vec![Path::rectangle(&edge)])])];
    let drawing = Drawing { origin: Origin::LowerLeft, width: 363.0, height: 196.0, layers };
    let grid = Paper::A4.cut(&drawing);
    (grid.overlap, grid.tiles(&drawing).len())
}

/// Two upright pages show 341.2 mm of a part with the ordinary overlap, 343.2 mm with the least one.
#[test]
fn pages_overlap_by_less_where_that_saves_one() {
    assert_eq!(overlap_and_tiles(341.1), (OVERLAP, 2));
    assert_eq!(overlap_and_tiles(342.1), (LEAST_OVERLAP, 2));
    let (overlap, tiles) = overlap_and_tiles(343.3);
    assert!(overlap == OVERLAP && tiles > 2, "{overlap} {tiles}");
}

#[test]
fn nothing_stands_where_printers_leave_white() {
    for paper in Paper::ALL {
        for page in paper.pages(&ring(), "FRAME PLATE 1") {
            let (w, h) = (page.drawing.width, page.drawing.height);
            let paper = Bounds { min: Point::ORIGIN, max: Point::new(w, h) };
            let marks = page.drawing.layers.iter().filter(|(layer, _)| *layer == Layer::PaperMark);
            for shape in marks.flat_map(|(_, shapes)| shapes) {
                let bounds = shape.bounds().union(page.window);
                let printable = paper.outset(-WHITE + 1e-9);
                assert!(
                    printable.contains(bounds.min) && printable.contains(bounds.max),
                    "{bounds:?} of {w} x {h}"
                );
            }
        }
    }
}
