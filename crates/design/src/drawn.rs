//! A piece by a person's own drawing, in the drawing's frame.
//!
//! The file's **elements** get **roles** by their layers; what has a role becomes a **sketch**, and that a sealed shape. Every
//! element without a role, every role without an element, and every fault of the shape is a refusal with names and a place.

mod clearance;
mod cut;
mod faults;
mod inner;
mod label;
mod layer_name;
mod loops;
mod marks;
mod measure;
mod own_seal;
mod pieces;
mod process;
mod proposal;
mod roles;
mod words;

use std::fmt::Write;
use std::sync::Arc;

pub use cut::DrawnCut;
pub use label::DrawnLabels;
pub use measure::{Measure, MeasureForm};
pub use pieces::DrawnPieces;

use crate::drawn::clearance::Clearance;
use crate::drawn::inner::within_air;
use crate::drawn::layer_name::layer_names;
use crate::drawn::process::{SeamProcesses, process_entry};
use crate::drawn::proposal::LeftOut;
use crate::star_seam::MOUTH_OVERRUN;
use crate::{Circle, PaperSeparator, Refusal, RefusalCode, Refusals, SeamLines, Warning};
use artwork::{Artwork, Fault, Figure, Format, Options, Place, Unit};
use geom::{Bounds, Path};
use sealed::{Rules, SealedShape, Sealing, Seam, ShapeCode, Sketch, sealed_shape};
use spec::units::Readable;
use spec::{DrawingSpec, LayerRole, Spec, key};

/// Width of the tube by which labels are sized where no passage is narrow, mm.
const LABEL_WIDTH: f64 = 15.0;

/// Faults of elements that are listed where nothing else was read.
const LISTED_FAULTS: usize = 100;
/// Larger sides of drawings for which the unit is not asked, mm.
const USUAL_SIZES: std::ops::RangeInclusive<f64> = 10.0..=3000.0;

/// A drawn piece.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnPiece {
    /// Seams, cut and ports.
    pub shape: SealedShape,
    /// The sealing of its seams, in their order.
    pub seam_lines: Vec<SeamLines>,
    /// The edges of the air as drawn, with the channels of ports as far as the cut, for pictures.
    pub edges: Vec<Path>,
    /// The boundary of the air, closed, without the channels of ports: the region that inflates.
    pub air: Vec<Path>,
    /// Walls and welds by their centre lines, as far as they lie in the air.
    pub inner: Vec<Path>,
    /// The piece's own edges.
    pub part: DrawnCut,
    /// The lines that a tool follows to cut it.
    pub tool: DrawnCut,
    /// The registration holes: three, so placed that the piece fits in one position only; or none.
    pub registration: Vec<Circle>,
    /// The texts on it, which are written and not cut.
    pub labels: DrawnLabels,
    /// The paper that keeps the air from welding, if the spec has it.
    pub separator: Option<PaperSeparator>,
    /// Width of the narrowest passage, mm; `None` where none is narrower than `least_passage`.
    pub passage: Option<f64>,
    /// A narrower passage is warned of, mm.
    pub least_passage: f64,
}

impl DrawnPiece {
    /// Whether two regions of its air are so near to each other that their seams share a band, or lie within a band's width of each other.
    pub fn shares_a_band(&self) -> bool {
        inner::share_a_band(&self.air, self.shape.band)
    }

    /// The piece that `sketch` of `spec` shows, with the `processes` of its seams, the warnings about it, and the repairs.
    ///
    /// # Errors
    /// Every reason for which it cannot be made.
    fn new(
        spec: &Spec,
        drawing: &DrawingSpec,
        sketch: &Sketch,
        processes: &mut SeamProcesses<'_>,
    ) -> Result<(Self, Vec<Warning>, Vec<String>), Refusals> {
        let sealing_rules = rules(spec, drawing);
        let sealing = sealed_shape(sketch, &sealing_rules);
        let Sealing { mut shape, air, inner, holes, repairs, warnings: warned } =
            sealing.map_err(|faults| faults.iter().map(faults::refusal).collect::<Refusals>())?;
        let inner = inner.iter().flat_map(|path| within_air(path, air.closed(), drawing.join.0)).collect();
        let repairs = repairs.iter().map(|repair| faults::found_at(&repair.what, repair.place)).collect();
        let narrow = warned.iter().filter(|warning| warning.code == ShapeCode::NarrowPassage);
        let passage = narrow.map(|warning| warning.found).reduce(f64::min);
        let mut warnings: Vec<Warning> = warned.iter().map(faults::refusal).collect();
        let part = DrawnCut::new(&shape, &holes)?;
        let (allowance, diameter) = (sealing_rules.allowance, spec.sheet.hole_diameter.0);
        let room = Clearance::new(&shape, &air, &part);
        let registration = marks::registration(&shape, &part, &room, allowance, diameter);
        if registration.is_empty() && diameter > 0.0 {
            warnings.push(marks::no_room(diameter));
        }
        let tool = part.for_tool(spec.cut.kerf.0, &registration)?;
        let labels = label::labels(&shape, &room, &registration, allowance);
        let separator = PaperSeparator::new(spec, &shape, &air)?;
        let seam_lines = sealed_seams(spec, &mut shape.seams, processes)?;
        let edges = air.edges_to_mouths(shape.band);
        let air = air.closed().to_vec();
        let piece = Self {
            shape,
            seam_lines,
            edges,
            air,
            inner,
            part,
            tool,
            registration,
            labels,
            separator,
            passage,
            least_passage: sealing_rules.least_passage,
        };
        Ok((piece, warnings, repairs))
    }

    /// Width of the tube by which labels are sized, mm.
    pub fn label_width(&self) -> f64 {
        self.passage.unwrap_or(LABEL_WIDTH)
    }
}

/// The sealing of `seams` by their `processes`, and their overlaps, which a process may change.
fn sealed_seams(
    spec: &Spec,
    seams: &mut [Seam],
    processes: &mut SeamProcesses<'_>,
) -> Result<Vec<SeamLines>, Refusals> {
    let mut refusals = Refusals::new();
    let mut sealed = Vec::new();
    for seam in seams {
        let Some(name) = refusals.keep(processes.of_seam(seam)) else { continue };
        let process = spec.process(&name);
        if seam.center_line.closed && !process.is_default() {
            seam.overlap = process.seal.overlap.0.min(0.5 * seam.center_line.length());
        }
        sealed.extend(refusals.keep(SeamLines::new(seam, &process)));
    }
    refusals.or_value(sealed)
}

/// The rules by which a sketch becomes a shape.
fn rules(spec: &Spec, drawing: &DrawingSpec) -> Rules {
    let hose = spec.inlet.as_ref().map_or(0.0, |inlet| inlet.tube_diameter.0);
    let band = spec.seal.band.0;
    let star_port =
        read(spec, drawing).ok().and_then(|artwork| own_seal::port_width(&artwork, drawing, band));
    Rules {
        band: spec.seal.band.0,
        allowance: spec.seal.allowance.0,
        join: drawing.join.0,
        overlap: spec.seal.overlap.0,
        // A hose of diameter d lies flat in a channel half as wide as its circumference.
        port_width: star_port.filter(|width| *width > 0.0).unwrap_or(std::f64::consts::FRAC_PI_2 * hose),
        overrun: MOUTH_OVERRUN,
        least_passage: drawing.passage.0,
        flange: drawing.flange.0,
    }
}

/// The drawing of `spec` as it was read.
fn read(spec: &Spec, drawing: &DrawingSpec) -> Result<Arc<Artwork>, Refusals> {
    let Some(content) = &drawing.content else {
        let problem = format!("the drawing {:?} was not read", drawing.file);
        let remedy = "it must lie beside the spec";
        return Err(Refusal::new(key::drawing::FILE, RefusalCode::DrawingUnread, problem, remedy).into());
    };
    let options = Options { unit: drawing.units, ..Options::new(0.5 * spec.accuracy.path.0) };
    content.read(&drawing.file, &options).map_err(|faults| faults.iter().map(faults::unreadable).collect())
}

/// Layers of a file with roles that suit them.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerProposal {
    /// Every layer with a role and the reason for it, in the order of the file.
    pub layers: Vec<(String, LayerRole, String)>,
    /// Width and height of all figures with a role, mm.
    pub size: [f64; 2],
    /// The unit of its numbers that the spec must give; `None` if the file states it.
    pub unit: Option<Unit>,
    /// The reason for which that unit was assumed; `None` if the file or the caller states it.
    pub no_unit: Option<String>,
    /// Layers that the drawing hides, of which nothing is read.
    pub hidden: Vec<String>,
    /// Faults of single elements, which are left out.
    pub faults: Vec<String>,
}

/// The layers of the drawing `bytes`, a file called `name`, with roles that suit them. A `unit` overrides that of the file.
///
/// # Errors
/// Every reason for which it cannot be read.
pub fn propose_layers(name: &str, bytes: &[u8], unit: Option<Unit>) -> Result<LayerProposal, Refusals> {
    let options = Options { unit, assume: true, ..Options::new(0.001) };
    let read = artwork::read(name, bytes, &options);
    let read = read.map_err(|faults| faults.iter().map(faults::unreadable).collect::<Refusals>())?;
    let is_dxf = Format::of_name(name) == Some(Format::Dxf);
    if read.elements.is_empty() && !read.faults.is_empty() {
        let unit = read.assumed.map(|assumed| Fault {
            place: Place::default(),
            text: assumed.reason,
            remedy: "Give the unit.".to_owned(),
        });
        let faults = unit.iter().chain(read.faults.iter().take(LISTED_FAULTS));
        return Err(faults.map(faults::unreadable).collect());
    }
    if read.elements.is_empty() {
        return Err(nothing_drawn(&read, is_dxf).into());
    }
    let layers = proposal::proposed(&read, is_dxf);
    let hidden = LeftOut::hidden(&read, is_dxf).into_iter().map(|left_out| left_out.layer).collect();
    let size = proposal::size(&read, &layers);
    let (unit, no_unit) = match read.assumed {
        Some(assumed) => (Some(assumed.unit), Some(assumed.reason)),
        None => (unit, None),
    };
    Ok(LayerProposal {
        layers,
        size,
        unit,
        no_unit,
        hidden,
        faults: read.faults.iter().map(ToString::to_string).collect(),
    })
}

/// The figures of the drawing of `spec`, as far as the file can be read; none of a spec without one.
pub fn figures(spec: &Spec) -> Vec<Path> {
    let read = spec.drawing.as_ref().and_then(|drawing| read(spec, drawing).ok());
    read.iter().flat_map(|read| paths(read)).cloned().collect()
}

/// A figure of a drawing, with the names that may give it a role.
#[derive(Clone, Debug, PartialEq)]
pub struct RoledFigure {
    /// Id of the element in the file.
    pub id: String,
    /// Names of the element's layers, innermost first.
    pub layers: Vec<String>,
    /// The name that decides its role; without a role the one that a proposal takes.
    pub layer: String,
    /// Role of the element; `None` if the spec gives it none.
    pub role: Option<LayerRole>,
    /// The name that decides the process of its seams, and that process; `None` where it is that of `[seal]`.
    pub process: Option<(String, String)>,
    /// Curve of the element; of a point a line without length.
    pub path: Path,
}

/// The figures of the drawing of `spec` with their roles, as far as the file can be read; none of a spec without a drawing.
pub fn roled_figures(spec: &Spec) -> Vec<RoledFigure> {
    let Some(drawing) = &spec.drawing else { return Vec::new() };
    let Ok(artwork) = read(spec, drawing) else { return Vec::new() };
    let names = layer_names(&artwork, drawing.is_dxf());
    let figures = artwork.elements.iter().zip(names).map(|(element, name)| {
        let entry = drawing.entry(element.names());
        let path = match &element.figure {
            Figure::Path(path) => path.clone(),
            Figure::Point(point) => Path::polyline(&[*point; 2]),
        };
        RoledFigure {
            id: element.id.clone(),
            layers: element
                .names()
                .filter(|name| artwork.root.iter().all(|root| root != name))
                .map(str::to_owned)
                .collect(),
            layer: entry.map_or(name, |(layer, _)| layer.as_str()).to_owned(),
            role: entry.map(|(_, role)| *role),
            process: process_entry(drawing, element).map(|entry| drawing.processes[entry].clone()),
            path,
        }
    });
    figures.collect()
}

/// The figures of a drawing without its points.
fn paths(read: &Artwork) -> impl Iterator<Item = &Path> {
    read.elements.iter().filter_map(|element| match &element.figure {
        Figure::Path(path) => Some(path),
        Figure::Point(_) => None,
    })
}

/// The notes on a drawing that could be read, in the order of the file; none of a spec without one.
pub fn drawing_notes(spec: &Spec) -> Vec<String> {
    let Some(drawing) = &spec.drawing else { return Vec::new() };
    read(spec, drawing).map_or_else(|_| Vec::new(), |read| roles::notes(&read, drawing))
}

/// The refusal of a drawing without air and seams, which names the layers that are hidden or cannot be read.
fn nothing_drawn(read: &Artwork, is_dxf: bool) -> Refusal {
    let mut problem = "no edge of air and no seam is drawn".to_owned();
    let mut remedy = if read.elements.is_empty() {
        "draw the edges of the air, and export the drawing again"
    } else {
        "give a layer the role air or seam"
    };
    for LeftOut { layer, text, .. } in LeftOut::unread(read, is_dxf) {
        let _ = write!(problem, "; nothing on layer {layer:?} can be read ({})", text.trim_end_matches('.'));
        remedy =
            "draw the edges on that layer as lines and arcs in the plane, and give it the role air or seam";
    }
    for LeftOut { layer, .. } in LeftOut::hidden(read, is_dxf) {
        let _ = write!(problem, "; layer {layer:?} is hidden");
        remedy = "show the layer in the drawing program and save again, then give it the role air or seam";
    }
    Refusal::new(key::drawing::LAYERS, RefusalCode::NothingDrawn, problem, remedy)
}

/// The question about the unit of a sketch whose size is unusual.
fn unusual_size(sketch: &Sketch) -> Option<String> {
    let curves = sketch.air.iter().chain(&sketch.seams).chain(&sketch.cuts);
    let bounds = curves.fold(Bounds::EMPTY, |all, curve| all.union(curve.path.bounds()));
    unit_question([bounds.width(), bounds.height()])
}

/// The question about the unit of a drawing whose size is unusual.
pub fn unit_question([width, height]: [f64; 2]) -> Option<String> {
    let is_usual = USUAL_SIZES.contains(&width.max(height));
    let (unit, scale) = if width.max(height) >= 1e4 { ("m", 1000.0) } else { ("mm", 1.0) };
    let [width, height] = [width, height].map(|side| Readable(side / scale));
    (!is_usual)
        .then(|| format!("The drawing is {width} x {height} {unit}: is the unit right (mm, cm, m, in, px)?"))
}

/// The sketch of `drawing` by its roles, and the notes on its repairs.
fn sketch(spec: &Spec, drawing: &DrawingSpec) -> Result<(Sketch, Vec<String>), Refusals> {
    let artwork = read(spec, drawing)?;
    roles::refusals(&artwork, drawing).or_value(())?;
    let mut sketch = roles::sketch(&artwork, drawing);
    let own_seams = own_seal::complete(&mut sketch, &artwork, drawing, &rules(spec, drawing));
    if sketch.air.is_empty() && sketch.seams.is_empty() {
        return Err(nothing_drawn(&artwork, drawing.is_dxf()).into());
    }
    let mut notes = roles::notes(&artwork, drawing);
    notes.extend(own_seams);
    notes.extend(unusual_size(&sketch));
    Ok((sketch, notes))
}
