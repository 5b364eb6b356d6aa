//! Roles: the elements of a drawing by the roles of their layers.

use std::collections::{BTreeMap, BTreeSet};

use crate::drawn::faults::found_at;
use crate::drawn::layer_name::layer_names;
use crate::{Refusal, RefusalCode, Refusals};
use artwork::{Drawing, Element, Figure, NO_LENGTH, Note, Weight};
use geom::Point;
use sealed::{DrawnCurve, DrawnPort, PortPlace, Sketch};
use spec::{DrawingSpec, DrawnPlace, LayerRole, key, nearest};

/// Names of elements that a message lists; the others are counted.
const LISTED: usize = 3;

/// The elements of `drawing` by the roles of `spec`.
pub(super) fn sketch(drawing: &Drawing, spec: &DrawingSpec) -> Sketch {
    let mut sketch = Sketch::default();
    for element in &drawing.elements {
        let name = element.id.clone();
        let curves = match spec.role(&element.layers) {
            Some(LayerRole::Port) => {
                sketch.ports.push(DrawnPort { name, place: port(&element.figure) });
                continue;
            }
            Some(LayerRole::Air) => &mut sketch.air,
            Some(LayerRole::Seam) => &mut sketch.seams,
            Some(LayerRole::Cut) => &mut sketch.cuts,
            Some(LayerRole::Hole) => &mut sketch.holes,
            None | Some(LayerRole::Ignore) => continue,
        };
        // A point is not a curve: `refusals` names it.
        if let Figure::Path(path) = &element.figure {
            curves.push(DrawnCurve { name, path: path.clone() });
        }
    }
    sketch
}

/// A port as drawn: a point, the middle of a closed mark, or the two ends of a line.
fn port(figure: &Figure) -> PortPlace {
    match figure {
        Figure::Point(at) => PortPlace::At(*at),
        Figure::Path(path) => match (path.closed, path.start(), path.end()) {
            (false, Some(start), Some(end)) => PortPlace::Across([start, end]),
            _ => PortPlace::At(path.bounds().center()),
        },
    }
}

/// Every element without a role, role without an element, and loss of geometry that is not to be ignored.
pub(super) fn refusals(drawing: &Drawing, spec: &DrawingSpec) -> Refusals {
    let mut refusals: Refusals = without_role(drawing, spec).into_iter().collect();
    refusals.extend(unknown(drawing, spec));
    refusals.extend(drawing.notes.iter().filter_map(|note| lost(note, spec)));
    let points = drawing.elements.iter().filter(|element| matches!(element.figure, Figure::Point(_)));
    // Programs write lines without length where a path closes: those are lost without loss.
    let nothing: BTreeSet<&str> = drawing
        .notes
        .iter()
        .filter(|note| note.text == NO_LENGTH)
        .filter_map(|note| note.place.element.as_deref())
        .collect();
    let is_curve = |element: &&Element| {
        !matches!(spec.role(&element.layers), None | Some(LayerRole::Port | LayerRole::Ignore))
            && !nothing.contains(element.id.as_str())
    };
    refusals.extend(points.filter(is_curve).map(|element| {
        let found = format!("{} is a point, and its layer is one of curves", element.id);
        let remedy = "only ports may be points: move it to another layer";
        Refusal::new(key::drawing::LAYERS, RefusalCode::LostGeometry, found, remedy).drawn_at(place(element))
    }));
    refusals
}

/// Elements without a role, by the layer that would give them one.
fn without_role(drawing: &Drawing, spec: &DrawingSpec) -> Vec<Refusal> {
    let mut by_layer: BTreeMap<&str, Vec<&Element>> = BTreeMap::new();
    let names = layer_names(drawing, spec.is_dxf());
    let elements = drawing.elements.iter().zip(names);
    for (element, name) in elements.filter(|(element, _)| spec.role(&element.layers).is_none()) {
        by_layer.entry(name).or_default().push(element);
    }
    let refusal = |(layer, elements): (&str, Vec<&Element>)| {
        let first = elements[0];
        let at = middle(first);
        let found = found_at(&format!("layer {layer:?} has no role: {}, first", listed(&elements)), at);
        let words: Vec<&str> = spec.layers.iter().map(|(name, _)| name.as_str()).collect();
        let near = nearest(layer, words).map_or(String::new(), |near| format!("; did you mean {near:?}?"));
        let remedy = format!("name it in one of the lists of [drawing.layers], or in `ignore`{near}");
        let elements = elements.iter().map(|element| element.id.clone()).collect();
        let place = DrawnPlace { elements, at: Some([at.x, at.y]) };
        Refusal::new(key::drawing::LAYERS, RefusalCode::LayerWithoutRole, found, remedy).drawn_at(place)
    };
    by_layer.into_iter().map(refusal).collect()
}

/// Names in the spec that no layer of the drawing has.
fn unknown(drawing: &Drawing, spec: &DrawingSpec) -> Vec<Refusal> {
    let of_elements = drawing.elements.iter().flat_map(|element| &element.layers);
    let of_notes = drawing.notes.iter().flat_map(|note| &note.place.layers);
    let known: Vec<&str> = of_elements.chain(of_notes).map(String::as_str).collect();
    let missing = spec.layers.iter().filter(|(name, _)| !known.contains(&name.as_str()));
    let mut layers: Vec<&str> = Vec::new();
    for name in layer_names(drawing, spec.is_dxf()) {
        if !layers.contains(&name) {
            layers.push(name);
        }
    }
    let refusal = |(name, _): &(String, LayerRole)| {
        let found = format!("the drawing has no layer {name:?}");
        let remedy = match nearest(name, known.iter().copied()) {
            Some(near) => format!("did you mean {near:?}?"),
            None if layers.is_empty() => {
                "it has no layer with anything on it: draw the edges of the air".to_owned()
            }
            None => {
                let layers: Vec<String> = layers.iter().map(|name| format!("{name:?}")).collect();
                format!("its layers are {}", layers.join(", "))
            }
        };
        Refusal::new(key::drawing::LAYERS, RefusalCode::UnknownLayer, found, remedy)
    };
    missing.map(refusal).collect()
}

/// Geometry that the drawing shows and that could not be read.
fn lost(note: &Note, spec: &DrawingSpec) -> Option<Refusal> {
    let ignored = spec.role(&note.place.layers) == Some(LayerRole::Ignore);
    if !matches!(note.weight, Weight::Lost | Weight::Changed) || ignored {
        return None;
    }
    let elements = note.place.element.iter().cloned().collect();
    let place = DrawnPlace { elements, at: note.place.at.map(|at| [at.x, at.y]) };
    let remedy = match note.place.element {
        Some(_) if note.weight == Weight::Changed => {
            "flatten it, or remove its clip, mask or marker, so that its outline alone shows what is to be made"
        }
        Some(_) if note.place.layers.is_empty() => "convert it to a path, or remove it",
        Some(_) => "convert it to a path, remove it, or name its layer in `ignore`",
        None => "remove it, or save the drawing as plain SVG",
    };
    let found = note.to_string().trim_end_matches('.').to_owned();
    Some(Refusal::new(key::drawing::LAYERS, RefusalCode::LostGeometry, found, remedy).drawn_at(place))
}

/// "path1, path2, path3 and 4 more".
fn listed(elements: &[&Element]) -> String {
    let names: Vec<&str> = elements.iter().take(LISTED).map(|element| element.id.as_str()).collect();
    match elements.len().saturating_sub(LISTED) {
        0 => names.join(", "),
        more => format!("{} and {more} more", names.join(", ")),
    }
}

fn place(element: &Element) -> DrawnPlace {
    let at = middle(element);
    DrawnPlace { elements: vec![element.id.clone()], at: Some([at.x, at.y]) }
}

/// A point of an element.
fn middle(element: &Element) -> Point {
    match &element.figure {
        Figure::Point(at) => *at,
        Figure::Path(path) => path.start().unwrap_or(Point::ORIGIN),
    }
}
