//! Elements, paths and lost geometry of a drawing that was read.

use artwork::{Artwork, Element, Figure, Weight};
use geom::{Path, Point};

pub(super) fn element<'d>(drawing: &'d Artwork, id: &str) -> &'d Element {
    let found = drawing.elements.iter().find(|element| element.id == id);
    found.unwrap_or_else(|| {
        panic!("no {id} in {:?}", drawing.elements.iter().map(|e| &e.id).collect::<Vec<_>>())
    })
}

pub(super) fn path<'d>(drawing: &'d Artwork, id: &str) -> &'d Path {
    match &element(drawing, id).figure {
        Figure::Path(path) => path,
        Figure::Point(point) => panic!("{id} is the point {point:?}"),
    }
}

pub(super) fn near(p: Point, x: f64, y: f64) -> bool {
    p.distance(Point::new(x, y)) < 1e-9
}

/// The texts of the notes on lost geometry, each with its element.
pub(super) fn lost(drawing: &Artwork) -> Vec<(String, String)> {
    let is_lost = |weight| matches!(weight, Weight::Lost | Weight::Changed | Weight::Annotation);
    let lost = drawing.notes.iter().filter(|note| is_lost(note.weight));
    lost.map(|note| (note.place.element.clone().unwrap_or_default(), note.text.clone())).collect()
}
