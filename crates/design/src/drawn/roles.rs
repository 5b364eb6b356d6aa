//! Roles: the elements of a drawing by the roles of their layers.

use std::collections::{BTreeMap, BTreeSet};

use crate::drawn::faults::{found_at, unreadable};
use crate::drawn::layer_name::layer_names;
use crate::{Refusal, RefusalCode, Refusals};
use artwork::{Artwork, Element, Fault, Figure, NO_LENGTH, Note, Place, Weight};
use geom::{Path, Point};
use sealed::{DrawnCurve, DrawnPort, PortPlace, Sketch};
use spec::{DrawingSpec, DrawnPlace, LayerRole, key, nearest};

/// Names of elements that a message lists; the others are counted.
const LISTED: usize = 3;

/// The elements of `drawing` by the roles of `spec`.
pub(super) fn sketch(drawing: &Artwork, spec: &DrawingSpec) -> Sketch {
    let mut sketch = Sketch::default();
    let marked: BTreeSet<&str> =
        points_on_marks(drawing, spec).into_iter().map(|point| point.id.as_str()).collect();
    for element in &drawing.elements {
        let name = element.id.clone();
        let curves = match spec.role(element.names()) {
            Some(LayerRole::Port) => {
                if !marked.contains(element.id.as_str()) {
                    sketch.ports.push(DrawnPort { name, place: port(&element.figure) });
                }
                continue;
            }
            Some(LayerRole::Air) => &mut sketch.air,
            Some(LayerRole::Seam) => &mut sketch.seams,
            Some(LayerRole::Cut) => &mut sketch.cuts,
            Some(LayerRole::Hole) => &mut sketch.holes,
            Some(LayerRole::Valve) => &mut sketch.valves,
            None | Some(LayerRole::Ignore | LayerRole::Measure | LayerRole::Pull) => continue,
        };
        // A point is not a curve: it is left out with a note, or `refusals` names it.
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
pub(super) fn refusals(drawing: &Artwork, spec: &DrawingSpec) -> Refusals {
    let mut refusals: Refusals = without_role(drawing, spec).into_iter().collect();
    refusals.extend(unknown(drawing, spec));
    refusals.extend(drawing.notes.iter().filter_map(|note| lost_geometry(note, spec)));
    refusals.extend(drawing.faults.iter().filter_map(|fault| faulty(fault, spec)));
    let with_curves = names_of_curves(drawing, spec);
    let annotations = drawing.notes.iter().filter(|note| note.weight == Weight::Annotation);
    refusals.extend(
        annotations
            .flat_map(Note::places)
            .filter(|place| lacks_curves(place.names(), spec, &with_curves))
            .map(annotation),
    );
    let lonely = points(drawing, spec).filter(|element| lacks_curves(element.names(), spec, &with_curves));
    refusals.extend(lonely.map(|element| {
        let fault = format!("{} is a point, and its layer should have curves", element.id);
        let remedy = "draw the curves on that layer, or name it in `port` or `ignore`";
        Refusal::new(key::drawing::LAYERS, RefusalCode::LostGeometry, fault, remedy).drawn_at(place(element))
    }));
    refusals
}

/// The notes on a drawing: those of its reader, faults of what is ignored, and points that are left out.
pub(super) fn notes(drawing: &Artwork, spec: &DrawingSpec) -> Vec<String> {
    let mut notes: Vec<String> = drawing.notes.iter().map(ToString::to_string).collect();
    let ignored = drawing.faults.iter().filter(|fault| faulty(fault, spec).is_none());
    notes.extend(ignored.map(|fault| format!("{}: {} Its layer is ignored.", fault.place, fault.text)));
    notes.extend(overruled_colours(drawing, spec));
    let mut left_out: Vec<&Element> = points(drawing, spec).collect();
    left_out.extend(points_on_marks(drawing, spec));
    match left_out.len() {
        0 => {}
        1 => notes.push(format!("A point on a layer of curves is left out: {}.", left_out[0].id)),
        number => {
            notes.push(format!("{number} points on layers of curves are left out: {}.", listed(&left_out)));
        }
    }
    notes
}

/// The colours of an SVG that would give figures another role than their groups or their own names do, one note each.
fn overruled_colours(drawing: &Artwork, spec: &DrawingSpec) -> Vec<String> {
    let mut overruled: BTreeMap<(&str, &str), Vec<&Element>> = BTreeMap::new();
    for element in &drawing.elements {
        let Some((colour, colour_role)) = spec.entry(element.colour_name()) else { continue };
        let Some((name, role)) = spec.entry(element.names()).filter(|(_, role)| role != colour_role) else {
            continue;
        };
        if *role != LayerRole::Ignore {
            overruled.entry((name, colour)).or_default().push(element);
        }
    }
    let note = |((name, colour), elements): (&(&str, &str), &Vec<&Element>)| {
        format!("{}: The role of {name:?} counts, not that of the colour {colour:?}.", listed(elements))
    };
    overruled.iter().map(note).collect()
}

/// The points of the file with the role of a curve, as sketches and sewing patterns have them. A curve without length is none.
fn points<'d>(drawing: &'d Artwork, spec: &'d DrawingSpec) -> impl Iterator<Item = &'d Element> {
    // Programs write lines without length where a path closes: those are lost without loss.
    let without_length: BTreeSet<&str> = drawing
        .notes
        .iter()
        .filter(|note| note.text == NO_LENGTH)
        .filter_map(|note| note.place.element.as_deref())
        .collect();
    let is_curve = move |element: &&Element| {
        matches!(element.figure, Figure::Point(_))
            && !matches!(
                spec.role(element.names()),
                None | Some(LayerRole::Port | LayerRole::Measure | LayerRole::Pull | LayerRole::Ignore)
            )
            && !without_length.contains(element.id.as_str())
    };
    drawing.elements.iter().filter(is_curve)
}

/// The points that lie on a line of a port: CAD programs put one at each end and in the middle.
fn points_on_marks<'d>(drawing: &'d Artwork, spec: &DrawingSpec) -> Vec<&'d Element> {
    let of_ports =
        drawing.elements.iter().filter(|element| spec.role(element.names()) == Some(LayerRole::Port));
    let marks: Vec<&Path> = of_ports
        .clone()
        .filter_map(|element| match &element.figure {
            Figure::Path(path) => Some(path),
            Figure::Point(_) => None,
        })
        .collect();
    let is_on_mark = |element: &&Element| match &element.figure {
        Figure::Point(point) => marks.iter().any(|mark| mark.distance(*point) <= spec.join.0),
        Figure::Path(_) => false,
    };
    of_ports.filter(is_on_mark).collect()
}

/// The names in `spec` that give curves a role, or ports theirs.
fn names_of_curves<'s>(drawing: &Artwork, spec: &'s DrawingSpec) -> BTreeSet<&'s str> {
    let entries = drawing.elements.iter().filter_map(|element| {
        let (name, role) = spec.entry(element.names())?;
        let counts =
            matches!(element.figure, Figure::Path(_)) || matches!(role, LayerRole::Port | LayerRole::Measure);
        counts.then_some(name.as_str())
    });
    entries.collect()
}

/// Whether something with these `names` has no role, or has it by a name that gives none to a curve.
fn lacks_curves<'n>(
    names: impl Iterator<Item = &'n str>,
    spec: &DrawingSpec,
    with_curves: &BTreeSet<&str>,
) -> bool {
    match spec.entry(names) {
        None => true,
        Some((_, LayerRole::Ignore)) => false,
        Some((name, _)) => !with_curves.contains(name.as_str()),
    }
}

/// A text or a hatch on a layer that should have curves and has none.
fn annotation(place: &Place) -> Refusal {
    let fault = format!("{place}: a text, dimension or hatch is not read, and its layer has no curves");
    lost_at(place, fault, &format!("convert it to curves, or {}", to_ignore(place)))
}

/// A faulty element that is not to be ignored.
fn faulty(fault: &Fault, spec: &DrawingSpec) -> Option<Refusal> {
    let is_ignored = spec.role(fault.place.names()) == Some(LayerRole::Ignore);
    let refusal = unreadable(fault);
    let remedy = format!("{}; or {}", refusal.remedy, to_ignore(&fault.place));
    (!is_ignored).then_some(Refusal { remedy, ..refusal })
}

/// The advice to ignore what lies at `place`, by a name that it has.
fn to_ignore(place: &Place) -> String {
    match &place.element {
        Some(name) => format!("name {name:?} or its layer in `ignore`"),
        None => "name its layer in `ignore`".to_owned(),
    }
}

/// The refusal of geometry that is missing at `place`.
fn lost_at(place: &Place, fault: String, remedy: &str) -> Refusal {
    let elements = place.element.iter().cloned().collect();
    let drawn_place = DrawnPlace { elements, at: place.at.map(|at| [at.x, at.y]) };
    Refusal::new(key::drawing::LAYERS, RefusalCode::LostGeometry, fault, remedy).drawn_at(drawn_place)
}

/// Elements without a role, by the layer that would give them one.
fn without_role(drawing: &Artwork, spec: &DrawingSpec) -> Vec<Refusal> {
    let mut by_layer: BTreeMap<&str, Vec<&Element>> = BTreeMap::new();
    let names = layer_names(drawing, spec.is_dxf());
    let elements = drawing.elements.iter().zip(names);
    for (element, name) in elements.filter(|(element, _)| spec.role(element.names()).is_none()) {
        by_layer.entry(name).or_default().push(element);
    }
    let refusal = |(layer, elements): (&str, Vec<&Element>)| {
        let first = elements[0];
        let center = middle(first);
        let fault = found_at(&format!("layer {layer:?} has no role: {}, first", listed(&elements)), center);
        let words: Vec<&str> = spec.layers.iter().map(|(name, _)| name.as_str()).collect();
        let hint = nearest(layer, words).map_or(String::new(), |hint| format!("; did you mean {hint:?}?"));
        let remedy = format!("name it in one of the lists of [drawing.layers], or in `ignore`{hint}");
        let elements = elements.iter().map(|element| element.id.clone()).collect();
        let place = DrawnPlace { elements, at: Some([center.x, center.y]) };
        Refusal::new(key::drawing::LAYERS, RefusalCode::LayerWithoutRole, fault, remedy).drawn_at(place)
    };
    by_layer.into_iter().map(refusal).collect()
}

/// Names in the spec that no layer of the drawing has.
fn unknown(drawing: &Artwork, spec: &DrawingSpec) -> Vec<Refusal> {
    let of_elements = drawing.elements.iter().flat_map(Element::names);
    let of_notes = drawing.notes.iter().flat_map(Note::places).flat_map(Place::names);
    let of_faults = drawing.faults.iter().flat_map(|fault| fault.place.names());
    let names: BTreeSet<&str> = of_elements.chain(of_notes).chain(of_faults).collect();
    let missing = spec.layers.iter().filter(|(name, _)| !names.contains(name.as_str()));
    let mut layers: Vec<&str> = Vec::new();
    for name in layer_names(drawing, spec.is_dxf()) {
        if !layers.contains(&name) {
            layers.push(name);
        }
    }
    let refusal = |(name, _): &(String, LayerRole)| {
        let fault = format!("the drawing has no layer {name:?}");
        let remedy = match nearest(name, names.iter().copied()) {
            Some(near) => format!("did you mean {near:?}?"),
            None if layers.is_empty() => {
                "it has no layer with anything on it: draw the edges of the air".to_owned()
            }
            None => {
                let layers: Vec<String> = layers.iter().map(|name| format!("{name:?}")).collect();
                format!("its layers are {}", layers.join(", "))
            }
        };
        Refusal::new(key::drawing::LAYERS, RefusalCode::UnknownLayer, fault, remedy)
    };
    missing.map(refusal).collect()
}

/// Geometry that the drawing shows and that could not be read.
fn lost_geometry(note: &Note, spec: &DrawingSpec) -> Option<Refusal> {
    let ignored = spec.role(note.place.names()) == Some(LayerRole::Ignore);
    if !matches!(note.weight, Weight::Lost | Weight::Changed) || ignored {
        return None;
    }
    let remedy = match note.place.element {
        Some(_) if note.weight == Weight::Changed => {
            "flatten it, or remove its clip or mask, so that its outline alone shows what is to be made"
                .to_owned()
        }
        Some(_) => format!("convert it to a path, remove it, or {}", to_ignore(&note.place)),
        None => "remove it, or save the drawing as plain SVG".to_owned(),
    };
    Some(lost_at(&note.place, note.to_string().trim_end_matches('.').to_owned(), &remedy))
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
    let center = middle(element);
    DrawnPlace { elements: vec![element.id.clone()], at: Some([center.x, center.y]) }
}

/// A point of an element.
fn middle(element: &Element) -> Point {
    match &element.figure {
        Figure::Point(at) => *at,
        Figure::Path(path) => path.start().unwrap_or(Point::ORIGIN),
    }
}
