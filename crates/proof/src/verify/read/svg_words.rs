//! The elements and attributes that a drawing's SVG may hold. All others are findings: a style, a clip or a script can hide, move
//! or change the shapes that the attributes describe.

use roxmltree::{Document, Node};

use crate::verify::finding::quote;
use crate::verify::read::svg::line_of;
use crate::verify::{FindingCode, Findings};

/// The namespace without which a browser shows nothing.
const SVG: &str = "http://www.w3.org/2000/svg";

/// The namespace of Inkscape's attributes of layers.
const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";

/// Number of faults after which the rest of a file is not read.
const ENOUGH: usize = 20;

/// The values that an attribute may have.
#[derive(Clone, Copy)]
enum Says {
    /// A value that the reader of shapes reads, and refuses by rules of its own.
    Shape,
    /// Just this.
    Is(&'static str),
    /// The colour of the layer in whose group the element is.
    LayerColour,
    /// The name of that layer.
    Layer,
    /// Letters, digits and "-".
    Name,
}

/// An element: its name, its parents, its attributes.
type ElementRow = (&'static str, &'static [&'static str], &'static [(&'static str, Says)]);

/// The style of a drawing's lines: one pixel wide at any zoom, as thin as can be for a cutter.
macro_rules! hairline {
    ($($more:expr),*) => {
        &[
            $($more,)*
            ("stroke-width", Says::Is("1")),
            ("style", Says::Is("vector-effect:non-scaling-stroke;-inkscape-stroke:hairline")),
        ]
    };
}

/// A drawing for cutters: outlines without fill, as hairlines, in the colour of their layer.
const DRAWING: [ElementRow; 5] = [
    ("svg", &[""], &[("width", Says::Shape), ("height", Says::Shape), ("viewBox", Says::Shape)]),
    ("title", &["svg"], &[]),
    (
        "g",
        &["svg"],
        &[
            ("id", Says::Name),
            ("inkscape:groupmode", Says::Is("layer")),
            ("inkscape:label", Says::Layer),
            ("fill", Says::Is("none")),
            ("stroke", Says::LayerColour),
        ],
    ),
    ("path", &["g"], hairline!(("d", Says::Shape))),
    ("circle", &["g"], hairline!(("cx", Says::Shape), ("cy", Says::Shape), ("r", Says::Shape))),
];

/// Reports everything in `document` that a drawing may not hold, and a title that is not `title`; `colour` is that of a layer.
pub(in crate::verify) fn check(
    document: &Document<'_>,
    title: &str,
    colour: &dyn Fn(&str) -> Option<&'static str>,
    findings: &mut Findings,
) {
    // Text before the root may name an encoding, a style sheet, or a byte order.
    if !document.input_text().trim_ascii_start().starts_with("<svg") {
        findings.add_at(FindingCode::UnknownWord, 1, quote(document.input_text()), "<svg at the beginning");
    }
    let mut reader = WordReader { colour, faults: 0, findings };
    for node in document.root().descendants().skip(1) {
        if reader.faults >= ENOUGH {
            return;
        }
        reader.node(node);
    }
    let titles: Vec<&str> = document
        .descendants()
        .filter(|node| node.has_tag_name("title"))
        .map(|node| node.text().unwrap_or(""))
        .collect();
    if titles != [title] {
        findings.add(FindingCode::WrongTitle, quote(&titles.join(", ")), quote(title));
    }
}

struct WordReader<'a> {
    colour: &'a dyn Fn(&str) -> Option<&'static str>,
    faults: usize,
    findings: &'a mut Findings,
}

impl WordReader<'_> {
    fn refuse(&mut self, node: Node<'_, '_>, fault: &str, allowed: &str) {
        self.faults += 1;
        self.findings.add_at(FindingCode::UnknownWord, line_of(node), fault, allowed);
    }

    fn node(&mut self, node: Node<'_, '_>) {
        let parent = node.parent_element().map_or("", |parent| parent.tag_name().name());
        if node.is_text() {
            let blank = node.text().is_some_and(|text| text.trim_ascii().is_empty());
            if !blank && parent != "title" {
                self.refuse(node, &quote(node.text().unwrap_or("")), "nothing between elements");
            }
        } else if node.is_element() {
            self.element(node, parent);
        } else {
            // A comment has no effect, but an instruction may name a style sheet.
            self.refuse(node, "a comment or an instruction", "elements only");
        }
    }

    /// Compares an element and its attributes with the table of what a drawing has.
    ///
    /// The element must be in the table, in one of its parents and in the namespace of SVG. Each attribute must have a value
    /// that its row allows, and each attribute of the row must be there.
    fn element(&mut self, node: Node<'_, '_>, parent: &str) {
        let name = node.tag_name().name();
        let row = DRAWING.iter().find(|(known, ..)| *known == name);
        let Some((_, parents, attributes)) = row else {
            self.refuse(node, &format!("<{name}>"), "shapes of lines and arcs, in groups");
            return;
        };
        if !parents.contains(&parent) {
            let allowed = format!("<{name}> in {}", parents.join(" or "));
            self.refuse(node, &format!("<{name}> in <{parent}>"), &allowed);
        }
        if node.tag_name().namespace() != Some(SVG) {
            self.refuse(node, &format!("<{name}> of another namespace"), SVG);
        }
        let layer = node.attribute("id").unwrap_or("");
        for attribute in node.attributes() {
            let attribute_name = match attribute.namespace() {
                None => attribute.name().to_owned(),
                Some(INKSCAPE) => format!("inkscape:{}", attribute.name()),
                Some(other) => format!("{other}:{}", attribute.name()),
            };
            let value = attribute.value();
            let rule = attributes.iter().find(|(name, _)| *name == attribute_name);
            if !rule.is_some_and(|(_, rule)| self.fits(*rule, value, layer)) {
                let allowed = self.allowed(attributes, rule.map(|(_, rule)| *rule), layer);
                self.refuse(node, &format!("{attribute_name}={} on <{name}>", quote(value)), &allowed);
            }
        }
        let missing = attributes.iter().find(|(name, _)| match name.strip_prefix("inkscape:") {
            Some(name) => !node.has_attribute((INKSCAPE, name)),
            None => !node.has_attribute(*name),
        });
        if let Some((missing, _)) = missing {
            self.refuse(node, &format!("<{name}> without {missing}"), &format!("with {missing}"));
        }
    }

    fn fits(&self, rule: Says, value: &str, layer: &str) -> bool {
        match rule {
            Says::Shape => true,
            Says::Is(word) => value == word,
            Says::LayerColour => (self.colour)(layer) == Some(value),
            Says::Layer => value == layer,
            Says::Name => value.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'-'),
        }
    }

    fn allowed(&self, attributes: &[(&str, Says)], rule: Option<Says>, layer: &str) -> String {
        match rule {
            Some(Says::Is(word)) => word.to_owned(),
            Some(Says::LayerColour) => (self.colour)(layer).unwrap_or("a layer of the drawing").to_owned(),
            Some(Says::Layer) => layer.to_owned(),
            Some(Says::Name) => "letters, digits and -".to_owned(),
            Some(Says::Shape) | None => {
                attributes.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ")
            }
        }
    }
}
