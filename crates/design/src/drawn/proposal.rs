//! Layers of a drawing, each with the role that its name and its figures suggest.

use std::collections::{BTreeMap, BTreeSet};

use crate::drawn::layer_name::{Shared, layer_names};
use crate::drawn::loops::rings;
use crate::drawn::words::{is_page, is_valve, word_role};
use artwork::{Artwork, Element, Figure, Place, Weight};
use geom::{Bounds, BoxIndex, Enclosures, Path, Point, path_distance};
use spec::LayerRole;
use spec::units::count_text;

/// Lines across an edge that are longer are no marks, mm.
const LONGEST_MARK: f64 = 20.0;
/// Longest mark as a part of the larger side of all closed curves: the unit may be a guess.
const MARK_OF_ALL: f64 = 0.1;
/// Marks are shorter than this part of the larger side of all closed curves.
const MARK_AT_MOST: f64 = 0.4;
/// Longest figure that may be a speck beside an edge, mm.
const SPECK: f64 = 5.0;
/// Largest distance of a point for a port from an edge, mm: the flat width of the default hose of 4 mm.
const POINT_REACH: f64 = 2.0 * std::f64::consts::PI;
/// A point that lies farther than this part of a curve's smaller side from it is in its middle, as the centre of a hole is.
const MIDDLE: f64 = 0.2;
/// Ends of a mark lie at least this far from the edge, mm: a weld that ends on the edge is no mark.
const BESIDE_EDGE: f64 = 0.1;

/// A layer, or a single element, with a role and the reason for it.
pub(super) type RoleRow = (String, LayerRole, String);

/// A layer with its elements by number.
struct DrawnLayer<'d> {
    name: &'d str,
    elements: Vec<usize>,
    /// Number of elements that are closed or in a ring.
    closed: usize,
    /// Whether an outline that is open at a port is on it.
    has_neck: bool,
}

/// The layers of `drawing`, each with the role that its name and figures suggest, and the reason. Where all lies on one layer, colours
/// tell the figures apart.
///
/// Layers get roles one by one. If none is one of ports, short lines across an edge become ports by their own names; if none has edges
/// of air or seams, those of cuts do: nothing could be sealed otherwise.
pub(super) fn proposed(drawing: &Artwork, is_dxf: bool) -> Vec<RoleRow> {
    let edges = EdgePaths::new(drawing);
    let drawn_layers = layers(drawing, is_dxf, &edges);
    let mut rows: Vec<RoleRow> = drawn_layers
        .iter()
        .map(|layer| {
            let (role, reason) = suited(layer, drawn_layers.len() == 1, drawing, &edges);
            (layer.name.to_owned(), role, reason)
        })
        .collect();
    if rows.iter().all(|row| !matches!(row.1, LayerRole::Air | LayerRole::Seam)) {
        promote(&drawn_layers, &mut rows, drawing, &edges);
    }
    if rows.iter().all(|row| row.1 != LayerRole::Port) {
        let marks = single_marks(&drawn_layers, &rows, drawing, &edges);
        rows.extend(marks);
    }
    rows.extend(LeftOut::unread(drawing, is_dxf).into_iter().map(|left_out| {
        // An edge that is faulty must not be ignored in silence.
        let named = word_role(&left_out.layer).filter(|_| left_out.is_faulty).unwrap_or(LayerRole::Ignore);
        (left_out.layer, named, "nothing on it can be read".to_owned())
    }));
    rows
}

/// Width and height of all figures of `drawing` whose role in `rows` is not to be ignored, mm; of all figures if none has one.
pub(super) fn size(drawing: &Artwork, rows: &[RoleRow]) -> [f64; 2] {
    let roles: BTreeMap<&str, LayerRole> = rows.iter().map(|row| (row.0.as_str(), row.1)).collect();
    let elements = drawing.elements.iter();
    let with_role = bounds(
        elements
            .clone()
            .filter(|element| element.names().find_map(|name| roles.get(name)) != Some(&LayerRole::Ignore)),
    );
    let area = if with_role.width() < 0.0 { bounds(elements) } else { with_role };
    [area.width(), area.height()].map(|length| length.max(0.0))
}

/// The bounds of all paths among `elements`.
fn bounds<'a>(elements: impl Iterator<Item = &'a Element>) -> Bounds {
    let paths = elements.filter_map(|element| match &element.figure {
        Figure::Path(path) => Some(path),
        Figure::Point(_) => None,
    });
    paths.map(Path::bounds).fold(Bounds::EMPTY, Bounds::union)
}

/// The layers in the order of the file.
fn layers<'d>(drawing: &'d Artwork, is_dxf: bool, edges: &EdgePaths) -> Vec<DrawnLayer<'d>> {
    let mut layers: Vec<DrawnLayer<'d>> = Vec::new();
    let mut places: BTreeMap<&str, usize> = BTreeMap::new();
    for (number, name) in layer_names(drawing, is_dxf).into_iter().enumerate() {
        let place = *places.entry(name).or_insert_with(|| {
            layers.push(DrawnLayer { name, elements: Vec::new(), closed: 0, has_neck: false });
            layers.len() - 1
        });
        layers[place].elements.push(number);
        let has_neck = edges.elements_with_necks.contains(&number);
        layers[place].has_neck |= has_neck;
        layers[place].closed += usize::from(edges.elements.contains(&number) && !has_neck);
    }
    layers
}

/// The role of a layer by its name and its figures, and the reason.
fn suited(
    layer: &DrawnLayer<'_>,
    is_alone: bool,
    drawing: &Artwork,
    edges: &EdgePaths,
) -> (LayerRole, String) {
    let (closed, number) = (layer.closed, layer.elements.len());
    let figures = format!("{}, {closed} closed", count_text(number, "figure"));
    // The only layer has the design, whatever its name is.
    let page = (is_page(layer.name) && number == 1).then_some(LayerRole::Ignore);
    if word_role(layer.name) == Some(LayerRole::Port)
        && is_valve(layer.name)
        && edges.surround(layer, drawing)
    {
        return (LayerRole::Valve, format!("by its name, in the face of a chamber; {figures}"));
    }
    let named = word_role(layer.name).or(page).filter(|role| !is_alone || *role != LayerRole::Ignore);
    let is_point = |number: &usize| matches!(drawing.elements[*number].figure, Figure::Point(_));
    match named {
        Some(LayerRole::Hole | LayerRole::Cut | LayerRole::Seam | LayerRole::Air)
            if layer.elements.iter().all(is_point) =>
        {
            (LayerRole::Ignore, format!("points, and its name is that of curves; {figures}"))
        }
        Some(role) => (role, format!("by its name; {figures}")),
        None if layer.name == "fill #ffffff" && !is_alone => {
            (LayerRole::Ignore, format!("a white background; {figures}"))
        }
        None if layer
            .elements
            .iter()
            .all(|number| edges.is_port(*number, &drawing.elements[*number].figure)) =>
        {
            (LayerRole::Port, format!("points or short lines across an edge; {figures}"))
        }
        None if closed > 0 => (LayerRole::Air, format!("closed curves; {figures}")),
        None if layer.has_neck => {
            (LayerRole::Air, format!("an outline that is open at a short line; {figures}"))
        }
        None if layer.elements.iter().all(is_point) => {
            (LayerRole::Ignore, format!("points off the edges; {figures}"))
        }
        None => (LayerRole::Seam, format!("open curves; {figures}")),
    }
}

/// Gives cuts the role of air, with the holes in them, where no layer has air or seams; where there is no cut, the first layer with
/// closed curves.
fn promote(layers: &[DrawnLayer<'_>], rows: &mut [RoleRow], drawing: &Artwork, edges: &EdgePaths) {
    let order = [LayerRole::Cut, LayerRole::Port, LayerRole::Hole, LayerRole::Ignore];
    let best_role = order
        .into_iter()
        .find(|role| layers.iter().zip(rows.iter()).any(|(layer, row)| has_closed_curves(layer, row, *role)));
    let Some(best_role) = best_role else { return };
    for place in 0..layers.len() {
        let is_inside = |number: &usize| {
            let start = match &drawing.elements[*number].figure {
                Figure::Path(path) => path.start(),
                Figure::Point(at) => Some(*at),
            };
            start.is_some_and(|start| !edges.enclosures.enclosing(start).is_empty())
        };
        let is_hole_in_air = best_role == LayerRole::Cut
            && has_closed_curves(&layers[place], &rows[place], LayerRole::Hole)
            && layers[place].elements.iter().any(is_inside);
        if has_closed_curves(&layers[place], &rows[place], best_role) || is_hole_in_air {
            rows[place].1 = LayerRole::Air;
            rows[place].2 = format!("closed curves, and no other layer has edges of air; {}", rows[place].2);
        }
    }
}

/// Whether `layer`, whose row is `row`, has closed curves other than a white background, and `role`.
fn has_closed_curves(layer: &DrawnLayer<'_>, row: &RoleRow, role: LayerRole) -> bool {
    row.1 == role && layer.closed > 0 && layer.name != "fill #ffffff"
}

/// Short lines across an edge on layers of curves, as ports by their own names.
fn single_marks(
    layers: &[DrawnLayer<'_>],
    rows: &[RoleRow],
    drawing: &Artwork,
    edges: &EdgePaths,
) -> Vec<RoleRow> {
    let of_curves =
        layers.iter().zip(rows).filter(|(_, row)| matches!(row.1, LayerRole::Air | LayerRole::Seam));
    let elements =
        of_curves.flat_map(|(layer, _)| &layer.elements).map(|number| (*number, &drawing.elements[*number]));
    let marks = elements.filter(|(number, element)| edges.is_mark(*number, &element.figure));
    marks
        .map(|(number, element)| {
            let layer =
                layers.iter().find(|layer| layer.elements.contains(&number)).map_or("", |layer| layer.name);
            let reason = format!("a short line across an edge, among the figures of {layer:?}");
            (element.id.clone(), LayerRole::Port, reason)
        })
        .collect()
}

/// The closed curves of a drawing.
struct EdgePaths {
    paths: Vec<Path>,
    boxes: BoxIndex,
    enclosures: Enclosures,
    /// The elements that make them, by number.
    elements: BTreeSet<usize>,
    /// The elements of outlines that are open at a port.
    elements_with_necks: BTreeSet<usize>,
    /// The elements that make each of them.
    elements_of_paths: Vec<Vec<usize>>,
    /// The larger side of all of them, mm.
    size: f64,
}

impl EdgePaths {
    /// The closed curves of `drawing`, as far as they are long enough for an edge.
    fn new(drawing: &Artwork) -> Self {
        let closed_rings = rings(drawing);
        let with_necks = closed_rings.iter().filter(|ring| ring.has_neck);
        let elements_with_necks = with_necks.flat_map(|ring| &ring.elements).copied().collect();
        let (paths, elements_of_paths): (Vec<Path>, Vec<Vec<usize>>) =
            closed_rings.into_iter().map(|ring| (ring.path, ring.elements)).unzip();
        let elements = elements_of_paths.iter().flatten().copied().collect();
        let bounds = paths.iter().fold(Bounds::EMPTY, |all, path| all.union(path.bounds()));
        let enclosures = Enclosures::new(&paths);
        let boxes = BoxIndex::new(paths.iter().map(Path::bounds));
        Self {
            paths,
            boxes,
            enclosures,
            elements,
            elements_with_necks,
            elements_of_paths,
            size: bounds.width().max(bounds.height()).max(0.0),
        }
    }

    /// Whether all figures of a layer are closed curves within an edge of another layer, and off it.
    fn surround(&self, layer: &DrawnLayer<'_>, drawing: &Artwork) -> bool {
        let mut figures = layer.elements.iter().map(|number| &drawing.elements[*number].figure);
        layer.closed == layer.elements.len() && figures.all(|figure| self.has_within(figure, layer))
    }

    /// Whether a figure of `layer` lies within an edge of another layer, and off it.
    fn has_within(&self, figure: &Figure, layer: &DrawnLayer<'_>) -> bool {
        let Figure::Path(path) = figure else { return false };
        let Some(start) = path.start() else { return false };
        self.enclosures.enclosing(start).into_iter().any(|edge| {
            let is_of_layer =
                self.elements_of_paths[edge].iter().any(|number| layer.elements.contains(number));
            !is_of_layer && path_distance(&self.paths[edge], path) > path.length() / 1000.0
        })
    }

    /// The length up to which a line may be a mark, mm.
    fn longest_mark(&self) -> f64 {
        LONGEST_MARK.max(MARK_OF_ALL * self.size).min(MARK_AT_MOST * self.size)
    }

    fn distance(&self, point: Point) -> f64 {
        self.boxes.least_distance(point, |number| self.paths[number].distance(point))
    }

    /// Whether a figure may be one for a port: a point or a speck at an edge, or a short line of which one end is in a closed curve
    /// that the other is not in.
    fn is_port(&self, number: usize, figure: &Figure) -> bool {
        let reach = POINT_REACH.min(MARK_OF_ALL * self.size);
        match figure {
            Figure::Point(at) => self.is_at_edge(*at, reach),
            Figure::Path(path) => {
                let is_speck = path.length() < SPECK.min(MARK_OF_ALL * self.size);
                self.crosses(path)
                    || is_speck && path.start().is_some_and(|start| self.near_others(number, start, reach))
            }
        }
    }

    /// Whether a point lies within `reach` of an edge, and not in the middle of a hole.
    fn is_at_edge(&self, point: Point, reach: f64) -> bool {
        let zone = Bounds { min: point, max: point }.outset(reach);
        let distances = self.boxes.overlapping(&zone).into_iter().map(|n| (n, self.paths[n].distance(point)));
        let nearest = distances.min_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, distance)| *distance <= reach);
        nearest.is_some_and(|(number, distance)| {
            let bounds = self.paths[number].bounds();
            let is_middle = distance > MIDDLE * bounds.width().min(bounds.height());
            !(is_middle && self.enclosures.enclosing(point).contains(&number))
        })
    }

    /// Whether a closed curve that element `number` is not a part of lies within `reach` of a point.
    fn near_others(&self, number: usize, point: Point, reach: f64) -> bool {
        if !self.elements.contains(&number) {
            return self.distance(point) <= reach;
        }
        // A speck that is closed is its own edge; another one must be longer.
        let zone = Bounds { min: point, max: point }.outset(reach);
        self.boxes.any_overlapping(&zone, |other| {
            self.paths[other].length() > SPECK && self.paths[other].distance(point) <= reach
        })
    }

    /// Whether a figure on a layer of curves is certainly a mark for a port: a short line through an edge that ends beside it.
    fn is_mark(&self, number: usize, figure: &Figure) -> bool {
        let Figure::Path(path) = figure else { return false };
        let ends = path.start().zip(path.end());
        !self.elements.contains(&number)
            && self.crosses(path)
            && ends.is_some_and(|(a, b)| self.distance(a).min(self.distance(b)) >= BESIDE_EDGE)
    }

    /// Whether an open curve is short and leads from the inside of an edge to its outside.
    fn crosses(&self, path: &Path) -> bool {
        let ends =
            path.start().zip(path.end()).filter(|_| !path.closed && path.length() <= self.longest_mark());
        ends.is_some_and(|(a, b)| self.enclosures.enclosing(a).len() != self.enclosures.enclosing(b).len())
    }
}

/// A layer of which nothing is read.
pub(super) struct LeftOut {
    /// Name of the layer.
    pub layer: String,
    /// The text of the note on its first element.
    pub text: String,
    /// Whether the file has a fault there.
    pub is_faulty: bool,
}

impl LeftOut {
    /// The layers that the drawing hides.
    pub(super) fn hidden(drawing: &Artwork, is_dxf: bool) -> Vec<Self> {
        let notes = drawing.notes.iter().filter(|note| note.weight == Weight::Hidden);
        let places = notes.flat_map(|note| note.places().map(|place| (place, note.text.as_str())));
        Self::new(drawing, is_dxf, places)
    }

    /// The layers with figures of which none can be read.
    pub(super) fn unread(drawing: &Artwork, is_dxf: bool) -> Vec<Self> {
        let notes =
            drawing.notes.iter().filter(|note| matches!(note.weight, Weight::Lost | Weight::Annotation));
        let of_notes = notes.flat_map(|note| note.places().map(|place| (place, note.text.as_str())));
        let mut unread = Self::new(drawing, is_dxf, of_notes);
        let of_faults = drawing.faults.iter().map(|fault| (&fault.place, fault.text.as_str()));
        for faulty in Self::new(drawing, is_dxf, of_faults) {
            unread.retain(|left_out| left_out.layer != faulty.layer);
            unread.push(Self { is_faulty: true, ..faulty });
        }
        unread
    }

    /// The layers of these places, each with the text on what lies there, that no element has.
    fn new<'d>(
        drawing: &Artwork,
        is_dxf: bool,
        places: impl Iterator<Item = (&'d Place, &'d str)>,
    ) -> Vec<Self> {
        let shared = Shared::new(drawing);
        let layers = drawing.elements.iter().flat_map(|element| &element.layers);
        let read: BTreeSet<&str> = layers.map(String::as_str).collect();
        let mut layers: Vec<Self> = Vec::new();
        for (place, text) in places {
            let Some(layer) = layer_of(place, is_dxf, &shared) else { continue };
            if !read.contains(layer) && !layers.iter().any(|known| known.layer == layer) {
                layers.push(Self { layer: layer.to_owned(), text: text.to_owned(), is_faulty: false });
            }
        }
        layers
    }
}

/// The layer of a note's element.
fn layer_of<'a>(place: &'a Place, is_dxf: bool, shared: &Shared<'_>) -> Option<&'a str> {
    if is_dxf {
        return place.layers.get(place.own_names.checked_sub(1)?).map(String::as_str);
    }
    let mut names = place.layers.iter().rev().map(String::as_str);
    names.find(|name| !shared.is_shared(name)).or(place.element.as_deref())
}
