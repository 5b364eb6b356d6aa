//! The parts of a page on which a drawing has something.

use crate::{Drawing, Layer, Shape};
use geom::{Bounds, Path, path_intersections};

/// Room around what is drawn, mm: a line on the edge of a page is not printed.
const ROOM: f64 = 1.0;

/// The box of what is drawn, labels left out, with some room around it.
pub(super) fn extent(drawing: &Drawing) -> Bounds {
    let parts = drawing.layers.iter().filter(|(layer, _)| *layer != Layer::Label);
    let shapes = parts.flat_map(|(_, shapes)| shapes);
    shapes.map(Shape::bounds).fold(Bounds::EMPTY, Bounds::union).outset(ROOM)
}

/// Whether a line of the part crosses `cell`, or the part fills it. Every closed path except labels is an edge of it.
pub(super) fn shows(drawing: &Drawing, cell: &Bounds) -> bool {
    let frame = Path::rectangle(cell);
    let mut enclosing = 0;
    for (_, shapes) in drawing.layers.iter().filter(|(layer, _)| *layer != Layer::Label) {
        for path in shapes.iter().flat_map(|shape| shape.paths().into_owned()) {
            let starts_inside = path.start().is_some_and(|start| cell.contains(start));
            if starts_inside || !path_intersections(&path, &frame).is_empty() {
                return true;
            }
            enclosing += usize::from(path.closed && path.encloses(cell.center()));
        }
    }
    !enclosing.is_multiple_of(2)
}
