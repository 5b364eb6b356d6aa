//! `[drawing]`: a person's own drawing, and the roles of its layers.

use std::fmt;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

use crate::FaultCode;
use crate::allowed::Allowed;
use crate::fault::{Fault, quoted};
use crate::measure::{WrittenMeasure, read_measures};
use crate::section::{Reader, Section};
use crate::shape::ValueShape;
use crate::units::Length;
use crate::unknown::nearest;
use crate::value::{RawEntry, RawKind, RawValue};
use artwork::{Artwork, Format, Options, Unit};

/// The least width of a passage that makers report to inflate well, mm.
const LEAST_PASSAGE: f64 = 15.0;
/// Width of the flange around a valve's hole, mm: with a hole of 6 mm its rim has a diameter of 26 mm.
const FLANGE: f64 = 10.0;

/// `[drawing]`
#[derive(Clone, Debug, PartialEq)]
pub struct DrawingSpec {
    /// The file, relative to the spec.
    pub file: String,
    /// Unit of the file's numbers; `None`: the one that the file states.
    pub units: Option<Unit>,
    /// Ends of curves up to this far apart are joined.
    pub join: Length,
    /// A narrower passage of the air is warned of.
    pub passage: Length,
    /// Width of a valve's flange around its hole where its rim is not drawn.
    pub flange: Length,
    /// Names of layers with their roles, in the order of the spec.
    pub layers: Vec<(String, LayerRole)>,
    /// Names of layers, elements, roles or seams, each with the process by which its seams are made.
    pub processes: Vec<(String, String)>,
    /// What is measured after inflation, beside the figures of the role `measure`.
    pub measures: Vec<WrittenMeasure>,
    /// The content of the file; `None` until it is read.
    pub content: Option<DrawingContent>,
}

/// The bytes of a drawing.
#[derive(Clone)]
pub struct DrawingContent {
    bytes: Arc<[u8]>,
    /// The figures, once read, and the options with which they were read.
    read: Arc<OnceLock<(Options, ReadArtwork)>>,
}

/// A drawing that was read, or every reason for which it cannot be.
type ReadArtwork = Result<Arc<Artwork>, Vec<artwork::Fault>>;

impl DrawingContent {
    /// The content of a file.
    pub fn new(bytes: &[u8]) -> Self {
        Self { bytes: bytes.into(), read: Arc::default() }
    }

    /// The bytes of the file.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The drawing in these bytes of a file called `name`. It is read once for the first `options`.
    ///
    /// # Errors
    /// Every reason for which it cannot be read.
    pub fn read(&self, name: &str, options: &Options) -> ReadArtwork {
        let (options_read, read) = self.read.get_or_init(|| (*options, self.read_anew(name, options)));
        if options_read == options { read.clone() } else { self.read_anew(name, options) }
    }

    fn read_anew(&self, name: &str, options: &Options) -> ReadArtwork {
        artwork::read(name, &self.bytes, options).map(Arc::new)
    }
}

/// Contents are equal if their bytes are.
impl PartialEq for DrawingContent {
    fn eq(&self, other: &Self) -> bool {
        self.bytes == other.bytes
    }
}

crate::choices! {
    /// The role of a layer.
    LayerRole,
    /// The word of the role in a spec.
    word;
    /// Edges of the air side.
    Air: "air",
    /// Centre lines of bands.
    Seam: "seam",
    /// The opening for a hose.
    Port: "port",
    /// The cut.
    Cut: "cut",
    /// Holes.
    Hole: "hole",
    /// Holes of valves in one sheet, alone or with the rims of their flanges.
    Valve: "valve",
    /// Points and lines that are measured after inflation; nothing is made of them.
    Measure: "measure",
    /// Two straight lines along seams that rigid bars hold and pull at; nothing is made of them.
    Pull: "pull",
    /// No role: the figures are ignored.
    Ignore: "ignore",
}

/// The number of the bytes: they may be many.
impl fmt::Debug for DrawingContent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} bytes", self.bytes.len())
    }
}

impl DrawingSpec {
    /// Whether the file is a DXF; else it is an SVG.
    pub fn is_dxf(&self) -> bool {
        Format::of_name(&self.file) == Some(Format::Dxf)
    }

    /// The name of the file, without directories.
    pub fn file_name(&self) -> &str {
        self.file.rsplit(['/', '\\']).next().unwrap_or_default()
    }

    /// The name of the published copy.
    pub fn published_name(&self) -> &'static str {
        if self.is_dxf() { "drawing.dxf" } else { "drawing.svg" }
    }

    /// The first of an element's `names`, innermost first, that has a role, with that role.
    pub fn entry<'n>(&self, names: impl IntoIterator<Item = &'n str>) -> Option<&(String, LayerRole)> {
        names.into_iter().find_map(|name| self.layers.iter().find(|(layer, _)| layer == name))
    }

    /// The role of an element with these `names`, innermost first.
    pub fn role<'n>(&self, names: impl IntoIterator<Item = &'n str>) -> Option<LayerRole> {
        self.entry(names).map(|(_, role)| *role)
    }
}

/// Sections that describe stars, and their replacements for a drawing.
const OF_STARS: [(&str, &str); 3] = [
    ("star", "the drawing is the shape"),
    ("stack", "drawn pieces are not stacked; `copies` in [sheet] makes several"),
    ("frame", "only stacked stars have a frame"),
];

/// The drawing; `None` if the section is not written.
pub(super) fn read(reader: &mut Reader<'_>) -> Option<DrawingSpec> {
    let drawing = read_section(&mut reader.section("drawing"));
    if drawing.is_none() {
        refuse_loads_of_drawings(reader);
        return None;
    }
    for (section, remedy) in OF_STARS {
        if let Some(value) = reader.raw.root().get(section) {
            let message = format!("[{section}] beside [drawing]");
            let fault = Fault::error(FaultCode::Conflict, value.span.clone(), message)
                .label(remedy)
                .help(format!("delete [{section}], or [drawing]"));
            reader.faults.push(fault);
        }
    }
    let inlet = ("the drawing shows where its ports are", "delete it; only `tube_diameter` counts here");
    refuse_unlike(reader, "inlet", |key| key == "tube_diameter", inlet);
    let load = (
        "no model predicts the force of a drawn shape on an object",
        "delete it; only `pressure`, `chambers`, `plates` and `mass` count here",
    );
    refuse_unlike(reader, "load", |key| ["pressure", "chambers", "plates", "mass"].contains(&key), load);
    let hole = (
        "only stars have a flap on the hole side",
        "delete it; the holes of a drawing are cut as they are drawn",
    );
    refuse_unlike(reader, "seal", |key| key != "hole_allowance", hole);
    separator(reader);
    drawing
}

/// A fault for each load of drawings beside a star: pressures of chambers, and plates.
fn refuse_loads_of_drawings(reader: &mut Reader<'_>) {
    let Some(load) = reader.raw.root().get("load").and_then(RawValue::as_table) else { return };
    for (key, label, help) in [
        ("chambers", "a star has one chamber", "delete it; `pressure` is the star's"),
        ("plates", "no model presses a star between plates", "delete it"),
    ] {
        let Some(value) = load.get(key) else { continue };
        let message = format!("`{key}` in [load] without [drawing]");
        let fault = Fault::error(FaultCode::Conflict, value.span.clone(), message);
        reader.faults.push(fault.label(label).help(help));
    }
}

/// A fault for each key of `section` that drawings do not have (`is_of_drawings`), with a label and a remedy.
fn refuse_unlike(
    reader: &mut Reader<'_>,
    section: &str,
    is_of_drawings: impl Fn(&str) -> bool,
    (label, help): (&str, &str),
) {
    let table = reader.raw.root().get(section).and_then(RawValue::as_table);
    for entry in table.into_iter().flat_map(|table| &table.0).filter(|own| !is_of_drawings(&own.key)) {
        let message = format!("{} in [{section}] beside [drawing]", quoted(&entry.key));
        let fault = Fault::error(FaultCode::Conflict, entry.key_span.clone(), message);
        reader.faults.push(fault.label(label).help(help));
    }
}

/// The mask of a drawn shape is a separator.
fn separator(reader: &mut Reader<'_>) {
    let Some(mask) = reader.raw.root().get("mask") else { return };
    let kind = mask.as_table().and_then(|table| table.get("kind"));
    if kind.is_none_or(|kind| kind.as_text() == Some("coating")) {
        let problem = "a coating mask beside [drawing]";
        let fault = Fault::error(FaultCode::Conflict, mask.span.clone(), problem)
            .label("only stars are coated")
            .help(
                "write kind = \"separator\" for paper between the sheets of a heat press, or delete [mask]",
            );
        reader.faults.push(fault);
        return;
    }
    let reason = ("a separator is as large as the air", "delete it; only `kind` and `creep` count here");
    refuse_unlike(reader, "mask", |key| ["kind", "creep"].contains(&key), reason);
}

fn read_section(s: &mut Section<'_, '_>) -> Option<DrawingSpec> {
    // Every key is read even if another one is wrong, so that one reading reports all faults. The file has no content yet: who
    // reads the spec finds it.
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
    let join = s.length("join", Allowed::closed(0.0, 10.0), 0.02);
    let passage = s.length("passage", Allowed::closed(0.0, 1000.0), LEAST_PASSAGE);
    let flange = s.length("flange", Allowed::closed(0.1, 1000.0), FLANGE);
    let layers = read_layers(s);
    let processes = read_seam_processes(s);
    let measures = read_measures(s);
    s.is_written().then(|| DrawingSpec {
        file: file.unwrap_or_default(),
        units,
        join,
        passage,
        flange,
        layers,
        processes,
        measures,
        content: None,
    })
}

/// The table of roles: layers, each with its role, in the order of the text.
///
/// Each role has a list of layers. A wrong role, list or name is reported and left out, so that one reading reports all of
/// them. A layer that has a role already keeps it.
fn read_layers(s: &mut Section<'_, '_>) -> Vec<(String, LayerRole)> {
    let mut layers: Vec<(String, LayerRole)> = Vec::new();
    let Some(value) = s.take("layers", ValueShape::Lists(LayerRole::WORDS.to_vec())) else {
        return layers;
    };
    let Some(table) = value.as_table() else {
        let label = "must be a section, [drawing.layers], with a list of layers for each role".to_owned();
        s.report(wrong_type(value, format!("`layers` is {}", value.in_words()), label));
        return layers;
    };
    for entry in &table.0 {
        let words = LayerRole::WORDS;
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
        for (name, span) in listed_names(s, entry) {
            if let Some((_, other)) = layers.iter().find(|(known, _)| *known == name) {
                let message =
                    format!("layer {} has two roles, {} and {}", quoted(&name), other.word(), entry.key);
                let fault = Fault::error(FaultCode::Conflict, span, message);
                s.report(fault.label("a layer has one role").help("delete it from one of the lists"));
                continue;
            }
            layers.push((name, *role));
        }
    }
    layers
}

/// The names in the list of `entry`, each with its place. Anything else is reported and left out.
fn listed_names(s: &mut Section<'_, '_>, entry: &RawEntry) -> Vec<(String, Range<usize>)> {
    let Some(list) = entry.value.as_list() else {
        let label = format!("must be a list of layers: {} = [\"name\"]", entry.key);
        let message = format!("`{}` is {}", entry.key, entry.value.in_words());
        s.report(wrong_type(&entry.value, message, label));
        return Vec::new();
    };
    let mut names = Vec::new();
    for item in list {
        match &item.kind {
            RawKind::Text(name) => names.push((name.clone(), item.span.clone())),
            RawKind::Number(_) | RawKind::Truth(_) | RawKind::Date | RawKind::List(_) | RawKind::Table(_) => {
                let message = format!("a layer of `{}` is {}", entry.key, item.in_words());
                s.report(wrong_type(item, message, "must be a name in quotes".to_owned()));
            }
        }
    }
    names
}

/// The table of processes: names of layers, elements, roles or seams, each with the process of its seams, in the order of the text.
fn read_seam_processes(s: &mut Section<'_, '_>) -> Vec<(String, String)> {
    let mut processes: Vec<(String, String)> = Vec::new();
    let Some(value) = s.take("process", ValueShape::NamedLists) else { return processes };
    let Some(table) = value.as_table() else {
        let label = "must be a section, [drawing.process], with a list of names for each process".to_owned();
        s.report(wrong_type(value, format!("`process` is {}", value.in_words()), label));
        return processes;
    };
    for entry in &table.0 {
        for (name, span) in listed_names(s, entry) {
            if let Some((_, other)) = processes.iter().find(|(known, _)| *known == name) {
                let message = format!(
                    "{} has two processes, {} and {}",
                    quoted(&name),
                    quoted(other),
                    quoted(&entry.key)
                );
                let fault = Fault::error(FaultCode::Conflict, span, message);
                s.report(fault.label("a seam has one process").help("delete it from one of the lists"));
                continue;
            }
            processes.push((name, entry.key.clone()));
        }
    }
    processes
}

fn wrong_type(value: &RawValue, message: String, label: String) -> Fault {
    Fault::error(FaultCode::WrongType, value.span.clone(), message).label(label)
}
