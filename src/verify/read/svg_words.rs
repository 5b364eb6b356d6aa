//! Which elements and attributes an SVG may hold. Whatever is not in its table is a finding: a style, a clip or a script
//! can hide, move or change what every attribute that is read says.

use roxmltree::{Document, Node};

use crate::verify::finding::quote;
use crate::verify::read::number;
use crate::verify::{FindingCode, Findings};

/// The namespace without which a browser shows nothing.
const SVG: &str = "http://www.w3.org/2000/svg";

/// The namespace of what Inkscape says of layers.
const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";

/// Faults after which the rest of a file is not worth a look.
const ENOUGH: usize = 20;

/// What an attribute may say.
#[derive(Clone, Copy)]
enum Says {
    /// What the reader of shapes reads, and refuses by rules of its own.
    Shape,
    /// Just this.
    Is(&'static str),
    /// One of these.
    OneOf(&'static [&'static str]),
    /// The colour of the layer whose group it stands on.
    LayerColour,
    /// The name of that layer.
    Layer,
    /// "none", or "#" and six digits.
    Colour,
    /// A plain number that is not below 0.
    Size,
    /// Plain numbers.
    Numbers,
    /// Letters, digits and "-".
    Name,
}

/// An element: its name, where it may stand, its attributes.
type Row = (&'static str, &'static [&'static str], &'static [(&'static str, Says)]);

/// What an SVG of some purpose may say.
pub(in crate::verify) struct Words {
    rows: &'static [Row],
    /// Whether every attribute must stand there: what is not said has a default that is seldom the right one.
    all: bool,
}

/// How lines of a drawing look: one pixel wide at any zoom, as thin as can be for a cutter.
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
pub(in crate::verify) const DRAWING: Words = Words {
    rows: &[
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
    ],
    all: true,
};

/// How shapes of a picture look.
macro_rules! shown {
    ($($more:expr),*) => {
        &[
            $($more,)*
            ("fill", Says::Colour),
            ("fill-rule", Says::Is("evenodd")),
            ("stroke", Says::Colour),
            ("stroke-width", Says::Size),
            ("stroke-dasharray", Says::Numbers),
            ("stroke-linejoin", Says::Is("round")),
            ("stroke-linecap", Says::Is("round")),
        ]
    };
}

/// A picture for people: shapes, colours and words; nothing that runs, and nothing from elsewhere.
pub(in crate::verify) const PICTURE: Words = Words {
    rows: &[
        (
            "svg",
            &[""],
            &[
                ("width", Says::Shape),
                ("height", Says::Shape),
                ("viewBox", Says::Shape),
                ("style", Says::Is("max-width:100%;max-height:100%")),
            ],
        ),
        ("title", &["svg"], &[]),
        ("g", &["svg", "g"], &[("id", Says::Name)]),
        (
            "rect",
            &["g"],
            shown!(("x", Says::Size), ("y", Says::Size), ("width", Says::Size), ("height", Says::Size)),
        ),
        ("path", &["g"], shown!(("d", Says::Shape))),
        ("circle", &["g"], shown!(("cx", Says::Size), ("cy", Says::Size), ("r", Says::Size))),
        ("polygon", &["g"], shown!(("points", Says::Numbers))),
        (
            "text",
            &["g"],
            &[
                ("x", Says::Numbers),
                ("y", Says::Numbers),
                ("font-size", Says::Size),
                ("font-family", Says::Is("DejaVu Sans, Verdana, Arial, sans-serif")),
                ("text-anchor", Says::OneOf(&["start", "middle", "end"])),
                ("fill", Says::Colour),
            ],
        ),
    ],
    all: false,
};

/// Reports everything in `document` that is none of `words`, and a title that is not `title`; `colour` tells that of a layer.
pub(in crate::verify) fn check(
    document: &Document<'_>,
    words: &Words,
    title: &str,
    colour: &dyn Fn(&str) -> Option<&'static str>,
    findings: &mut Findings,
) {
    // What stands before the root may name an encoding, a style sheet, or a byte order.
    if !document.input_text().trim_ascii_start().starts_with("<svg") {
        findings.add(FindingCode::UnknownWord, 1, quote(document.input_text()), "<svg at the beginning");
    }
    let mut reader = Reader { words, colour, faults: 0, findings };
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
        findings.add(FindingCode::WrongTitle, None, quote(&titles.join(", ")), quote(title));
    }
}

struct Reader<'a> {
    words: &'a Words,
    colour: &'a dyn Fn(&str) -> Option<&'static str>,
    faults: usize,
    findings: &'a mut Findings,
}

impl Reader<'_> {
    fn refuse(&mut self, node: Node<'_, '_>, found: &str, allowed: &str) {
        self.faults += 1;
        let line = usize::try_from(node.document().text_pos_at(node.range().start).row).ok();
        self.findings.add(FindingCode::UnknownWord, line, found, allowed);
    }

    fn node(&mut self, node: Node<'_, '_>) {
        let inside = node.parent_element().map_or("", |parent| parent.tag_name().name());
        if node.is_text() {
            let blank = node.text().is_some_and(|text| text.trim_ascii().is_empty());
            if !blank && !matches!(inside, "title" | "text") {
                self.refuse(node, &quote(node.text().unwrap_or("")), "nothing between elements");
            }
        } else if node.is_element() {
            self.element(node, inside);
        } else {
            // A comment says nothing, but an instruction may name a style sheet.
            self.refuse(node, "a comment or an instruction", "elements only");
        }
    }

    fn element(&mut self, node: Node<'_, '_>, inside: &str) {
        let name = node.tag_name().name();
        let row = self.words.rows.iter().find(|(known, ..)| *known == name);
        let Some((_, parents, attributes)) = row else {
            self.refuse(node, &format!("<{name}>"), "shapes of lines and arcs, in groups");
            return;
        };
        if !parents.contains(&inside) {
            self.refuse(
                node,
                &format!("<{name}> in <{inside}>"),
                &format!("<{name}> in {}", parents.join(" or ")),
            );
        }
        if node.tag_name().namespace() != Some(SVG) {
            self.refuse(node, &format!("<{name}> of another namespace"), SVG);
        }
        let layer = node.attribute("id").unwrap_or("");
        for attribute in node.attributes() {
            let known = match attribute.namespace() {
                None => attribute.name().to_owned(),
                Some(INKSCAPE) => format!("inkscape:{}", attribute.name()),
                Some(other) => format!("{other}:{}", attribute.name()),
            };
            let value = attribute.value();
            let says = attributes.iter().find(|(name, _)| *name == known);
            if !says.is_some_and(|(_, says)| self.fits(*says, value, layer)) {
                let allowed = self.allowed(attributes, says.map(|(_, says)| *says), layer);
                self.refuse(node, &format!("{known}={} on <{name}>", quote(value)), &allowed);
            }
        }
        let says = |name: &str| match name.strip_prefix("inkscape:") {
            Some(name) => node.has_attribute((INKSCAPE, name)),
            None => node.has_attribute(name),
        };
        let missing = attributes.iter().find(|(name, _)| self.words.all && !says(name));
        if let Some((missing, _)) = missing {
            self.refuse(node, &format!("<{name}> without {missing}"), &format!("{missing} said"));
        }
    }

    fn fits(&self, says: Says, value: &str, layer: &str) -> bool {
        let number = |text: &str| number::value(text).is_some();
        match says {
            Says::Shape => true,
            Says::Is(word) => value == word,
            Says::OneOf(known) => known.contains(&value),
            Says::LayerColour => (self.colour)(layer) == Some(value),
            Says::Layer => value == layer,
            Says::Colour => {
                let digits = value
                    .strip_prefix('#')
                    .is_some_and(|hex| hex.len() == 6 && hex.bytes().all(|byte| byte.is_ascii_hexdigit()));
                value == "none" || digits
            }
            Says::Size => number::value(value).is_some_and(|x| x >= 0.0),
            Says::Numbers => value == "none" || value.split([' ', ',']).all(number),
            Says::Name => value.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'-'),
        }
    }

    fn allowed(&self, attributes: &[(&str, Says)], says: Option<Says>, layer: &str) -> String {
        match says {
            Some(Says::Is(word)) => word.to_owned(),
            Some(Says::OneOf(known)) => known.join(", "),
            Some(Says::LayerColour) => (self.colour)(layer).unwrap_or("a layer of the drawing").to_owned(),
            Some(Says::Layer) => layer.to_owned(),
            Some(Says::Colour) => "none, or # and six digits".to_owned(),
            Some(Says::Size) => "a number that is not below 0".to_owned(),
            Some(Says::Numbers) => "plain numbers".to_owned(),
            Some(Says::Name) => "letters, digits and -".to_owned(),
            Some(Says::Shape) | None => {
                attributes.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ")
            }
        }
    }
}
