//! `[drawing]`: a person's own drawing, and the roles of its layers.

use std::fmt;
use std::sync::Arc;

use crate::spec::FaultCode;
use crate::spec::allowed::Allowed;
use crate::spec::fault::{Fault, quoted};
use crate::spec::section::{Reader, Section};
use crate::spec::shape::Shape;
use crate::spec::unknown::nearest;
use crate::spec::value::{RawKind, RawValue};
use crate::units::Length;
use drawings::{Format, Unit};

/// `[drawing]`
#[derive(Clone, Debug, PartialEq)]
pub struct DrawingSpec {
    /// The file, relative to the spec.
    pub file: String,
    /// Unit of the file's numbers; `None`: the one that the file states.
    pub units: Option<Unit>,
    /// Ends of curves up to this far apart are joined.
    pub join: Length,
    /// Names of layers with their roles, in the order of the spec.
    pub layers: Vec<(String, LayerRole)>,
    /// What the file holds; `None` until it is read.
    pub content: Option<DrawingContent>,
}

/// The bytes of a drawing.
#[derive(Clone, PartialEq, Eq)]
pub struct DrawingContent(pub Arc<[u8]>);

/// The role of a layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayerRole {
    /// Edges of the air side.
    Air,
    /// Centre lines of bands.
    Seam,
    /// Where a hose goes in.
    Port,
    /// The cut.
    Cut,
    /// Holes.
    Hole,
    /// Nothing.
    Ignore,
}

impl LayerRole {
    /// All of them with the words that specs write.
    pub const ALL: [(&'static str, Self); 6] = [
        ("air", Self::Air),
        ("seam", Self::Seam),
        ("port", Self::Port),
        ("cut", Self::Cut),
        ("hole", Self::Hole),
        ("ignore", Self::Ignore),
    ];

    /// Its word.
    pub fn word(self) -> &'static str {
        Self::ALL.iter().find(|(_, own)| *own == self).map_or("", |(word, _)| word)
    }
}

/// The number of the bytes: they may be many.
impl fmt::Debug for DrawingContent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} bytes", self.0.len())
    }
}

impl DrawingSpec {
    /// Whether the file is a DXF; else it is an SVG.
    pub fn is_dxf(&self) -> bool {
        Format::of_name(&self.file) == Some(Format::Dxf)
    }

    /// What the published copy is called.
    pub fn published_name(&self) -> &'static str {
        if self.is_dxf() { "drawing.dxf" } else { "drawing.svg" }
    }

    /// The role of an element with these layers, innermost first: that of the first layer which has one.
    pub fn role(&self, layers: &[String]) -> Option<LayerRole> {
        layers
            .iter()
            .find_map(|layer| self.layers.iter().find(|(name, _)| name == layer))
            .map(|(_, role)| *role)
    }
}

/// Sections that describe stars, and what a drawing has instead.
const OF_STARS: [(&str, &str); 5] = [
    ("star", "the drawing is the shape"),
    ("stack", "drawn pieces are not stacked; `copies` in [sheet] makes several"),
    ("frame", "only stacked stars have a frame"),
    ("mask", "only stars are coated"),
    ("load", "no model predicts a drawn shape"),
];

/// The drawing; `None` if the section is not written.
pub(super) fn read(reader: &mut Reader<'_>) -> Option<DrawingSpec> {
    let drawing = read_section(&mut reader.section("drawing"));
    let _ = drawing.as_ref()?;
    for (section, remedy) in OF_STARS {
        if let Some(value) = reader.raw.root().get(section) {
            let message = format!("[{section}] beside [drawing]");
            let fault = Fault::error(FaultCode::Conflict, value.span.clone(), message)
                .label(remedy)
                .help(format!("delete [{section}], or [drawing]"));
            reader.faults.push(fault);
        }
    }
    let inlet = reader.raw.root().get("inlet").and_then(RawValue::as_table);
    let others = inlet.into_iter().flat_map(|table| &table.0).filter(|entry| entry.key != "tube_diameter");
    for entry in others {
        let message = format!("{} in [inlet] beside [drawing]", quoted(&entry.key));
        let fault = Fault::error(FaultCode::Conflict, entry.key_span.clone(), message)
            .label("the drawing shows where its ports are")
            .help("delete it; only `tube_diameter` counts here");
        reader.faults.push(fault);
    }
    drawing
}

fn read_section(s: &mut Section<'_, '_>) -> Option<DrawingSpec> {
    s.require_if(
        s.is_written(),
        &[("file", "\"outline.svg\""), ("layers", "{ air = [\"chamber\"], port = [\"inlet\"] }")],
    );
    let file = s.text("file").map(|(file, span)| {
        if Format::of_name(file).is_none() {
            let fault = Fault::error(FaultCode::OutOfRange, span, format!("`file` is {}", quoted(file)))
                .label("must end in .svg or .dxf")
                .help("export the drawing as SVG or as ASCII DXF");
            s.report(fault);
        }
        file.to_owned()
    });
    let units = s.choice("units", &Unit::named());
    let join = s.quantity("join", Allowed::closed(0.0, 10.0)).unwrap_or(Length(0.02));
    let layers = read_layers(s);
    s.is_written().then(|| DrawingSpec { file: file.unwrap_or_default(), units, join, layers, content: None })
}

/// The table of roles.
fn read_layers(s: &mut Section<'_, '_>) -> Vec<(String, LayerRole)> {
    let mut layers: Vec<(String, LayerRole)> = Vec::new();
    let Some(value) = s.take("layers", Shape::Lists(LayerRole::ALL.map(|(word, _)| word).to_vec())) else {
        return layers;
    };
    let wrong = |value: &RawValue, message: String, label: String| {
        Fault::error(FaultCode::WrongType, value.span.clone(), message).label(label)
    };
    let Some(table) = value.as_table() else {
        let label = "must be a section, [drawing.layers], with a list of layers for each role".to_owned();
        s.report(wrong(value, format!("`layers` is {}", value.in_words()), label));
        return layers;
    };
    for entry in &table.0 {
        let words = LayerRole::ALL.map(|(word, _)| word);
        let Some((_, role)) = LayerRole::ALL.iter().find(|(word, _)| *word == entry.key) else {
            let message = format!("unknown role {} in [drawing.layers]", quoted(&entry.key));
            let fault = Fault::error(FaultCode::UnknownKey, entry.key_span.clone(), message);
            let help = match nearest(&entry.key, words) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("roles are {}", words.join(", ")),
            };
            s.report(fault.label("no role has this name").help(help));
            continue;
        };
        let Some(list) = entry.value.as_list() else {
            let label = format!("must be a list of layers: {} = [\"name\"]", entry.key);
            s.report(wrong(&entry.value, format!("`{}` is {}", entry.key, entry.value.in_words()), label));
            continue;
        };
        for item in list {
            let RawKind::Text(name) = &item.kind else {
                let message = format!("a layer of `{}` is {}", entry.key, item.in_words());
                s.report(wrong(item, message, "must be a name in quotes".to_owned()));
                continue;
            };
            if let Some((_, other)) = layers.iter().find(|(known, _)| known == name) {
                let message =
                    format!("layer {} has two roles, {} and {}", quoted(name), other.word(), entry.key);
                let fault = Fault::error(FaultCode::Conflict, item.span.clone(), message);
                s.report(fault.label("a layer has one role").help("delete it from one of the lists"));
                continue;
            }
            layers.push((name.clone(), *role));
        }
    }
    layers
}
