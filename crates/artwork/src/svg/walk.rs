//! The walk through the tree: transforms, styles, references, names.

use std::collections::BTreeMap;

use roxmltree::{Document, Node, NodeId};

use super::document::{SvgSource, is_svg, names, shortened};
use super::paint::Paint;
use super::properties::{GEOMETRY, is_zero};
use super::style::{Cascade, ElementStyle};
use super::viewport::{Viewport, nested_viewport};
use super::{clip, conditions, path_data, shapes, transform};
use geom::Point;

use crate::affine::Affine;
use crate::collector::{Collector, ReadingStop};
use crate::{Place, Weight};

/// The text of the note on texts.
const TEXT: &str = "Text is not read. Convert it to paths to have its outlines.";

/// The state that an element inherits.
#[derive(Clone)]
struct ElementContext<'a> {
    map: Affine,
    viewport: Viewport,
    style: ElementStyle,
    /// Ids and labels of groups and references around, outermost first.
    names: Vec<&'a str>,
    /// Ids of the references around, each with " > " behind it.
    path: String,
    /// Targets of the references around.
    targets: Vec<NodeId>,
    depth: usize,
}

/// The state of the walk.
pub(super) struct SvgWalk<'s, 'a, 'd, 'c, 'o> {
    root: Node<'a, 'd>,
    source: &'s SvgSource,
    ids: BTreeMap<&'a str, Node<'a, 'd>>,
    out: &'c mut Collector<'o>,
}

impl<'s, 'a: 's, 'd: 's, 'c, 'o> SvgWalk<'s, 'a, 'd, 'c, 'o> {
    pub(super) fn new(
        document: &'a Document<'d>,
        source: &'s SvgSource,
        collector: &'c mut Collector<'o>,
    ) -> Self {
        let mut ids = BTreeMap::new();
        for node in document.root().descendants() {
            if let Some(id) = node.attribute("id") {
                let _ = ids.entry(id).or_insert(node);
            }
        }
        Self { root: document.root_element(), source, ids, out: collector }
    }

    /// Reads all elements; `map` leads from the root's user units to mm.
    pub(super) fn run(&mut self, map: &Affine, viewport: Viewport) -> Result<(), ReadingStop> {
        let context = ElementContext {
            map: *map,
            viewport,
            style: ElementStyle::INITIAL,
            names: Vec::new(),
            path: String::new(),
            targets: Vec::new(),
            depth: 0,
        };
        self.out.drawing.root = names(self.root).map(str::to_owned).collect();
        self.group(self.root, context, false)?;
        if self.source.sheet.is_exhausted() {
            let text = "Its style sheets have too many rules for so many elements.";
            self.out.refuse(Place::default(), text, "Save the drawing as plain SVG.");
        }
        Ok(())
    }

    /// Reads the children of a group, with the group's transform, style and names.
    fn group(
        &mut self,
        node: Node<'a, 'd>,
        context: ElementContext<'a>,
        only_first: bool,
    ) -> Result<(), ReadingStop> {
        self.deeper(node, &context)?;
        let Some(mut inner) = self.entered(node, context) else { return Ok(()) };
        inner.names.extend(names(node));
        inner.depth += 1;
        for child in node.children().filter(|child| is_svg(*child)) {
            let unmet = if only_first { conditions::unmet(child) } else { None };
            // A language depends on the reader, so its note is given.
            if unmet.is_none_or(|(name, _)| name == conditions::LANGUAGE) {
                self.element(child, &inner)?;
            }
            if only_first && unmet.is_none() && !conditions::is_unseen(child.tag_name().name()) {
                break;
            }
        }
        Ok(())
    }

    /// Stops where an element is in too many others.
    fn deeper(&mut self, node: Node<'a, 'd>, context: &ElementContext<'a>) -> Result<(), ReadingStop> {
        let limit = self.out.options.limits.depth;
        if context.depth < limit {
            return Ok(());
        }
        let text = format!("Groups and references are more than {limit} levels deep.");
        self.out.refuse(self.place(node, context), text, "Ungroup the drawing.");
        Err(ReadingStop)
    }

    fn element(&mut self, node: Node<'a, 'd>, context: &ElementContext<'a>) -> Result<(), ReadingStop> {
        let first = self.out.drawing.elements.len();
        self.unclipped(node, context)?;
        self.clipped(node, context, first);
        Ok(())
    }

    /// Notes a clip that hides a part of an element, whose figures are those from number `first` on.
    fn clipped(&mut self, node: Node<'a, 'd>, context: &ElementContext<'a>, first: usize) {
        let cascade = self.cascade(node);
        let Some(value) = cascade.applied("clip-path") else { return };
        let find = |id: &str| self.ids.get(id).copied();
        let own_map = transform::declared(node, &cascade, context.viewport).ok();
        let map = own_map.map(|own_map| context.map.following(&own_map));
        let clip = map.and_then(|map| clip::declared(node, value, &map, context.viewport, find));
        if !clip.is_some_and(|clip| clip.covers(self.out.seen_elements(first))) {
            let text = clip::unapplied("clip-path", &shortened(value));
            self.out.note(Weight::Changed, self.place(node, context), text);
        }
    }

    fn unclipped(&mut self, node: Node<'a, 'd>, context: &ElementContext<'a>) -> Result<(), ReadingStop> {
        // Elements that are never drawn are passed over, hidden ones noted with the reason. The rest is a group, a
        // reference or a shape. Any other element is noted with its place, since something in the drawing is lost.
        self.out.visit()?;
        self.out.text(node.attributes().map(|attribute| 16 + attribute.value().len()).sum())?;
        let tag = node.tag_name().name();
        if conditions::is_unseen(tag) {
            return Ok(());
        }
        let cascade = self.cascade(node);
        let unmet = conditions::unmet(node).map(|(name, value)| format!("{name} \"{}\"", shortened(value)));
        let reason = if cascade.is("display", "none") {
            "display: none"
        } else if cascade.value("opacity").is_some_and(is_zero) {
            "opacity 0"
        } else {
            unmet.as_deref().unwrap_or_default()
        };
        if !reason.is_empty() {
            let text = format!("It is hidden ({reason}), and is left out.");
            self.out.note(Weight::Hidden, self.place(node, context), text);
            return Ok(());
        }
        match tag {
            "g" | "a" => self.group(node, context.clone(), false),
            "switch" => self.group(node, context.clone(), true),
            "svg" => self.nested(node, node, context),
            "use" => self.reference(node, context),
            _ if shapes::TAGS.contains(&tag) => self.shape(node, context),
            _ => {
                let text = match tag {
                    "text" => TEXT.to_owned(),
                    "image" => "Pictures are not read. Trace it to have outlines.".to_owned(),
                    "script" => "Scripts are not run.".to_owned(),
                    "animate" | "set" | "animateTransform" | "animateMotion" => {
                        "Animations are not run; the drawing is read as it starts.".to_owned()
                    }
                    _ => format!("Elements <{tag}> are not read; it is left out."),
                };
                let mut place = self.place(node, context);
                let coordinates = ["x", "y"]
                    .map(|name| node.attribute(name).and_then(|value| value.trim().parse::<f64>().ok()));
                if let [Some(x), Some(y)] = coordinates
                    && let Some(own_map) = self.transform(node, context)
                {
                    place.at = Some(context.map.following(&own_map).point(Point::new(x, y)))
                        .filter(|at| (at.x + at.y).is_finite());
                }
                if tag == "text" {
                    self.out.note_alike(Weight::Annotation, place, TEXT);
                } else {
                    self.out.note(Weight::Lost, place, text);
                }
                Ok(())
            }
        }
    }

    /// A nested `<svg>`, or a `<symbol>` or `<svg>` that `frame` (a `<use>`) refers to and may give a size.
    fn nested(
        &mut self,
        node: Node<'a, 'd>,
        frame: Node<'a, 'd>,
        context: &ElementContext<'a>,
    ) -> Result<(), ReadingStop> {
        match nested_viewport(node, frame, context.viewport) {
            Ok((map, viewport)) => {
                let Some(own_map) = self.transform(node, context) else { return Ok(()) };
                let map = context.map.following(&own_map).following(&map);
                self.group(node, ElementContext { map, viewport, ..context.clone() }, false)
            }
            Err(text) => {
                self.out.fault(self.place(node, context), text, "Correct the attribute.");
                Ok(())
            }
        }
    }

    fn reference(&mut self, node: Node<'a, 'd>, context: &ElementContext<'a>) -> Result<(), ReadingStop> {
        // References into other files are noted, and circles of references refused. The target is read as if it stood
        // here, with the reference's transform and names around its own.
        self.deeper(node, context)?;
        let href =
            node.attributes().find(|attribute| attribute.name() == "href").map_or("", |a| a.value().trim());
        let place = self.place(node, context);
        let Some(target) = href.strip_prefix('#').and_then(|id| self.ids.get(id).copied()) else {
            let target = shortened(href);
            let text = if href.starts_with('#') || href.is_empty() {
                format!("It refers to \"{target}\", which is not in the file.")
            } else {
                format!("It refers to another file (\"{target}\"), which is not read.")
            };
            self.out.note(Weight::Lost, place, text);
            return Ok(());
        };
        if context.targets.contains(&target.id()) {
            self.out.fault(place, format!("It refers to itself by \"{href}\"."), "Remove the reference.");
            return Ok(());
        }
        let shift = match context.viewport.shift(node) {
            Ok(shift) => shift,
            Err(text) => {
                self.out.fault(place, text, "Correct the attribute.");
                return Ok(());
            }
        };
        let Some(mut inner) = self.entered(node, context.clone()) else { return Ok(()) };
        inner.map = inner.map.following(&shift);
        inner.names.extend(names(node));
        inner.path = format!("{} > ", place.element.unwrap_or_default());
        inner.targets.push(target.id());
        inner.depth += 1;
        self.out.text(inner.path.len())?;
        match target.tag_name().name() {
            "symbol" | "svg" => self.nested(target, node, &inner),
            _ => self.element(target, &inner),
        }
    }

    fn shape(&mut self, node: Node<'a, 'd>, context: &ElementContext<'a>) -> Result<(), ReadingStop> {
        // The element's names from the innermost to the outermost are its layers: id, label, colour, then those of its
        // groups. Each chain of its outline becomes an element of the drawing. Unseen ones are marked, because nobody
        // sees what they mean.
        let Some(inner) = self.entered(node, context.clone()) else { return Ok(()) };
        let mut place = self.place(node, context);
        let mut own_names: Vec<&str> = names(node).collect();
        own_names.reverse(); // the id comes before the label
        let colour = inner.style.layer();
        let outer_names = context.names.iter().rev().copied();
        let mut layers: Vec<String> = Vec::new();
        let number = own_names.len() + usize::from(colour.is_some());
        for (depth, name) in own_names.into_iter().chain(colour.as_deref()).chain(outer_names).enumerate() {
            if !layers.iter().any(|known| known == name) {
                layers.push(name.to_owned());
            }
            if depth + 1 == number {
                place.own_names = layers.len();
            }
        }
        place.colour = layers.iter().position(|name| Some(name) == colour.as_ref());
        place.layers = layers;
        if !inner.style.visible {
            self.out.note(Weight::Hidden, place, "It is hidden (visibility), and is left out.");
            return Ok(());
        }
        self.remarks(&inner.style, &place);
        let is_unseen = inner.style.is_unseen();
        let chains = match shapes::chains(node, inner.viewport) {
            Ok(chains) => chains,
            Err(text) => {
                self.out.fault(place, text, "Correct or remove the element.");
                return Ok(());
            }
        };
        if chains.is_empty() {
            self.out.note(Weight::Information, place.clone(), "It has no geometry.");
        }
        let id = place.element.clone().unwrap_or_default();
        let names: usize = place.layers.iter().map(|name| 24 + name.len()).sum();
        for (i, chain) in chains.iter().enumerate() {
            self.out.text(names + id.len())?;
            let element = if i == 0 { id.clone() } else { format!("{id}#{}", i + 1) };
            let place = Place { element: Some(element), ..place.clone() };
            let full_turn = path_data::full_turn(chain);
            if full_turn.is_some() {
                let text = "Its two half arcs have rounded ends; they are read as one full turn.";
                self.out.note(Weight::Information, place.clone(), text);
            }
            let first = self.out.drawing.elements.len();
            self.out.chain(place.clone(), &inner.map, full_turn.as_ref().unwrap_or(chain))?;
            if is_unseen && self.out.drawing.elements.len() > first {
                self.out.mark_unseen(place);
            }
        }
        Ok(())
    }

    /// Notes paints that name no layer, and dashes.
    fn remarks(&mut self, style: &ElementStyle, place: &Place) {
        let [stroke, fill] = style.visible_paints();
        let text = match (stroke, fill) {
            (Paint::Other, _) => "Its stroke has no colour that is read, so it names no layer.",
            (Paint::None, Paint::Other) => "Its fill has no colour that is read, so it names no layer.",
            (stroke, _) if style.dashed && stroke != Paint::None => {
                "Its stroke is dashed; it is read as an unbroken line."
            }
            _ => return,
        };
        self.out.note(Weight::Information, place.clone(), text);
    }

    /// The context inside an element: its transform and style; `None` with a fault recorded.
    fn entered(&mut self, node: Node<'a, 'd>, context: ElementContext<'a>) -> Option<ElementContext<'a>> {
        let cascade = self.cascade(node);
        let style = context.style.inherited(&cascade);
        let is_frame = matches!(node.tag_name().name(), "svg" | "symbol");
        let changed = GEOMETRY
            .iter()
            .find(|name| !is_frame && cascade.styled(name).is_some_and(|value| value != "none"));
        if let Some(name) = changed {
            let text = format!("Its style sets \"{name}\", which is read as an attribute only.");
            let remedy = "Apply the transform in the drawing program, or save as plain SVG 1.1.";
            self.out.fault(self.place(node, &context), text, remedy);
            return None;
        }
        for name in ["mask", "filter", "marker", "marker-start", "marker-mid", "marker-end"] {
            let Some(value) = cascade.applied(name) else { continue };
            let short = shortened(value);
            let (weight, text) = match name {
                "mask" => (Weight::Changed, clip::unapplied(name, &short)),
                "filter" => (Weight::Information, format!("The filter {short} is not applied.")),
                // Arrow heads and dots decorate a line, which stays what it is.
                _ => (Weight::Information, format!("The markers {short} are not read.")),
            };
            self.out.note(weight, self.place(node, &context), text);
        }
        // A nested frame has its transform applied before its view box, in `nested`.
        let is_nested = is_frame && node.id() != self.root.id();
        let map = if is_nested { Affine::IDENTITY } else { self.transform(node, &context)? };
        Some(ElementContext { map: context.map.following(&map), style, ..context })
    }

    /// The transform of an element; `None` with a fault recorded.
    fn transform(&mut self, node: Node<'a, 'd>, context: &ElementContext<'a>) -> Option<Affine> {
        match transform::declared(node, &self.cascade(node), context.viewport) {
            Ok(map) => Some(map),
            Err(text) => {
                self.out.fault(self.place(node, context), text, "Correct or remove it.");
                None
            }
        }
    }

    fn cascade(&self, node: Node<'a, 'd>) -> Cascade<'a, 'd> {
        Cascade::new(&self.source.sheet, node)
    }

    /// Id, layers and line of an element.
    fn place(&self, node: Node<'a, 'd>, context: &ElementContext<'a>) -> Place {
        let line = self.source.line(node);
        let own_id = match node.attribute("id").filter(|id| !id.is_empty()) {
            Some(id) => id.to_owned(),
            None => format!("{} at {}", node.tag_name().name(), self.source.place_in_words(node)),
        };
        let mut layers: Vec<&str> = names(node).collect();
        layers.reverse();
        let own_names = layers.len();
        layers.extend(context.names.iter().rev());
        Place {
            element: Some(format!("{}{own_id}", context.path)),
            layers: layers.into_iter().map(str::to_owned).collect(),
            own_names,
            colour: None,
            line: Some(line),
            at: None,
        }
    }
}
