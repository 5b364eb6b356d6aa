//! Layers of a drawing, each with the role that its name and its figures suggest.

use std::collections::BTreeSet;

use crate::drawn::layer_name::{Shared, layer_names};
use crate::drawn::words::{is_page, word_role};
use artwork::{Drawing, Figure, Place, Weight};
use geom::{Bounds, Enclosures};
use spec::LayerRole;
use spec::units::counted;

/// Lines across an edge that are longer are no marks, mm.
const LONGEST_MARK: f64 = 20.0;
/// The same by the larger side of all closed curves: the unit may be a guess.
const MARK_OF_ALL: f64 = 0.1;

/// The layers of `drawing`, each with the role that its name and figures suggest, and the reason. Where all lies on one layer, colours
/// tell the figures apart.
pub(super) fn proposed(drawing: &Drawing, is_dxf: bool) -> Vec<(String, LayerRole, String)> {
    let closed = drawing.elements.iter().filter_map(|element| match &element.figure {
        Figure::Path(path) if path.closed => Some(path),
        _ => None,
    });
    let all = closed.clone().fold(Bounds::EMPTY, |all, path| all.union(path.bounds()));
    let longest = LONGEST_MARK.max(MARK_OF_ALL * all.width().max(all.height()));
    let enclosures = Enclosures::new(closed);
    let mut by_layer: Vec<(&str, Vec<&Figure>)> = Vec::new();
    for (element, layer) in drawing.elements.iter().zip(layer_names(drawing, is_dxf)) {
        match by_layer.iter_mut().find(|(known, _)| *known == layer) {
            Some((_, figures)) => figures.push(&element.figure),
            None => by_layer.push((layer, vec![&element.figure])),
        }
    }
    let is_alone = by_layer.len() == 1;
    let mut out: Vec<(String, LayerRole, String)> = Vec::new();
    for (layer, own) in by_layer {
        let closed = own.iter().filter(|figure| matches!(figure, Figure::Path(path) if path.closed)).count();
        let number = own.len();
        let figures = format!("{}, {closed} closed", counted(number, "figure"));
        // The only layer has the design, whatever its name is.
        let page = (is_page(layer) && number == 1).then_some(LayerRole::Ignore);
        let named = word_role(layer).or(page).filter(|role| !is_alone || *role != LayerRole::Ignore);
        let (role, reason) = match named {
            Some(role) => (role, format!("by its name; {figures}")),
            None if layer == "fill #ffffff" => (LayerRole::Ignore, format!("a white background; {figures}")),
            None if own.iter().all(|figure| is_port(figure, &enclosures, longest)) => {
                (LayerRole::Port, format!("points or short lines across an edge; {figures}"))
            }
            None if closed > 0 => (LayerRole::Air, format!("closed curves; {figures}")),
            None => (LayerRole::Seam, format!("open curves; {figures}")),
        };
        out.push((layer.to_owned(), role, reason));
    }
    let unread =
        |left_out: LeftOut| (left_out.layer, LayerRole::Ignore, "nothing on it can be read".to_owned());
    out.extend(LeftOut::of(drawing, is_dxf, Weight::Lost).into_iter().map(unread));
    out
}

/// A layer of which nothing is read.
pub(super) struct LeftOut {
    /// Its name.
    pub layer: String,
    /// The text of the note on its first element.
    pub text: String,
}

impl LeftOut {
    /// The layers of which nothing is read, as notes of this `weight` tell.
    pub(super) fn of(drawing: &Drawing, is_dxf: bool, weight: Weight) -> Vec<Self> {
        let shared = Shared::of(drawing);
        let layers = drawing.elements.iter().flat_map(|element| &element.layers);
        let read: BTreeSet<&str> = layers.map(String::as_str).collect();
        let mut out: Vec<Self> = Vec::new();
        for note in drawing.notes.iter().filter(|note| note.weight == weight) {
            let Some(layer) = layer_of(&note.place, is_dxf, &shared) else { continue };
            if !read.contains(layer) && !out.iter().any(|known| known.layer == layer) {
                out.push(Self { layer: layer.to_owned(), text: note.text.clone() });
            }
        }
        out
    }
}

/// The layer of a note's element.
fn layer_of<'a>(place: &'a Place, is_dxf: bool, shared: &Shared<'_>) -> Option<&'a str> {
    if is_dxf {
        return place.layers.get(place.own_names.checked_sub(1)?).map(String::as_str);
    }
    let mut names = place.layers.iter().rev().map(String::as_str);
    names.find(|name| !shared.has(name))
}

/// Whether a figure is a mark for a port: a point, a speck, or a line up to `longest` with one end in a closed curve that the other is
/// not in.
fn is_port(figure: &Figure, closed: &Enclosures, longest: f64) -> bool {
    let Figure::Path(path) = figure else { return true };
    let ends = path.start().zip(path.end()).filter(|_| !path.closed && path.length() <= longest);
    path.length() < 5.0 || ends.is_some_and(|(a, b)| closed.around(a).len() != closed.around(b).len())
}
