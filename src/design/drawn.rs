//! A piece by a person's own drawing, in the drawing's frame.
//!
//! The file's **elements** get **roles** by their layers; what has a role becomes a **sketch**, and that a sealed shape. Every
//! element without a role, every role without an element, and every fault of the shape is a refusal with names and a place.

mod roles;
mod said;

use crate::design::offset::offset;
use crate::design::placement::{SheetLayout, footprint, place};
use crate::design::star_seam::MOUTH_OVERRUN;
use crate::design::{PlacedPart, Refusal, RefusalCode, Refusals, Warning};
use crate::shape::{Role, Rules, SealedShape, Sealing, Sketch, sealed_shape};
use crate::spec::{DrawingSpec, LayerRole, Machine, Spec, key};
use crate::units::Readable;
use drawings::{Drawing, Figure, Options, Unit};
use inflatable::geom::{Bounds, Path};

/// A passage narrower than this is warned of, mm: the least that makers report to inflate well.
const LEAST_PASSAGE: f64 = 15.0;

/// A drawn piece, and its copies on sheets.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnPiece {
    /// Seams, cut and ports.
    pub shape: SealedShape,
    /// The edges of the air as drawn.
    pub edges: Vec<Path>,
    /// Outlines of the regions that hold the air, for pictures.
    pub tube: Vec<Path>,
    /// The piece's own edges.
    pub part: DrawnCut,
    /// The lines that a tool follows to cut it.
    pub tool: DrawnCut,
    /// Width of the narrowest passage, mm; `None` where none is narrower than 15 mm.
    pub passage: Option<f64>,
    /// What was resolved or mended as the drawing was read, a sentence each.
    pub notes: Vec<String>,
    /// Its copies where they lie.
    pub copies: Vec<PlacedPart>,
}

/// Where a drawn piece is cut, closed and counterclockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnCut {
    /// Around the piece.
    pub outside: Path,
    /// Out of the piece.
    pub inside: Vec<Path>,
    /// Width of the cut, mm.
    pub kerf: f64,
}

impl DrawnPiece {
    /// The kind of its copies.
    const KIND: &'static str = "piece";

    /// The piece that `drawing` of `spec` shows, laid on sheets for `machine`, and what is to be known of it.
    ///
    /// # Errors
    /// Every reason for which it cannot be read, made, or laid on a sheet.
    pub(super) fn new(
        spec: &Spec,
        drawing: &DrawingSpec,
        machine: &Machine,
    ) -> Result<(Self, Vec<SheetLayout>, Vec<Warning>), Refusals> {
        let (sketch, mut notes) = sketch(spec, drawing)?;
        let rules = rules(spec, drawing);
        let sealing = sealed_shape(&sketch, &rules);
        let Sealing { shape, holes, repairs, warnings: warned } =
            sealing.map_err(|faults| faults.iter().map(said::refusal).collect::<Refusals>())?;
        notes.extend(repairs.iter().map(said::repair));
        let narrow = warned.iter().filter(|warning| said::is_passage(warning)).map(|warning| warning.found);
        let passage = narrow.reduce(f64::min);
        let warnings = warned.iter().map(said::warning).collect();
        let part = cut(&shape, &holes)?;
        let tool = part.for_tool(spec.cut.kerf.0)?;
        let edges: Vec<Path> = sketch.air.into_iter().map(|drawn| drawn.path).collect();
        let tube = regions(&shape, &edges);
        let bounds = footprint(&shape, &tool.outside, machine.process.ramp.0);
        let number = usize::try_from(spec.sheet.copies).unwrap_or(1);
        let boxes: Vec<Bounds> = vec![bounds; number];
        let (places, sheets) = place(&boxes, &spec.sheet, machine)?;
        let copies = PlacedPart::all(Self::KIND, &vec![0; number], places);
        Ok((Self { shape, edges, tube, part, tool, passage, notes, copies }, sheets, warnings))
    }

    /// Width of the tube by which labels are sized, mm.
    pub fn label_width(&self) -> f64 {
        self.passage.unwrap_or(LEAST_PASSAGE)
    }
}

impl DrawnCut {
    /// The lines of a tool whose cut is `kerf` wide.
    fn for_tool(&self, kerf: f64) -> Result<Self, Refusal> {
        let moved = |path: &Path, by: f64, what: &str| {
            offset(path, by).ok_or_else(|| {
                Refusal::new(
                    key::cut::KERF,
                    RefusalCode::WideKerf,
                    format!("a cut of {} mm leaves nothing of {what}", Readable(kerf)),
                    "make kerf smaller".to_owned(),
                )
            })
        };
        let inside =
            self.inside.iter().map(|path| moved(path, -0.5 * kerf, "a hole")).collect::<Result<_, _>>()?;
        Ok(Self { outside: moved(&self.outside, 0.5 * kerf, "the outline")?, inside, kerf })
    }
}

/// What is filled to show the air: the drawn edges where each is closed, else the middle of the bands.
fn regions(shape: &SealedShape, edges: &[Path]) -> Vec<Path> {
    if !edges.is_empty() && edges.iter().all(|edge| edge.closed) {
        return edges.to_vec();
    }
    let boundaries = shape.seams.iter().filter(|seam| seam.role == Role::Boundary);
    boundaries.map(|seam| seam.center_line.clone()).collect()
}

/// The rules by which a sketch becomes a shape.
fn rules(spec: &Spec, drawing: &DrawingSpec) -> Rules {
    let hose = spec.inlet.as_ref().map_or(0.0, |inlet| inlet.tube_diameter.0);
    Rules {
        band: spec.seal.band.0,
        allowance: spec.seal.allowance.0,
        join: drawing.join.0,
        overlap: spec.seal.overlap.0,
        // A hose of diameter d lies flat in a channel half as wide as its circumference.
        port_width: std::f64::consts::FRAC_PI_2 * hose,
        overrun: MOUTH_OVERRUN,
        least_passage: LEAST_PASSAGE,
    }
}

/// The drawing of `spec` as it was read.
fn read(spec: &Spec, drawing: &DrawingSpec) -> Result<Drawing, Refusals> {
    let Some(content) = &drawing.content else {
        let found = format!("the drawing {:?} was not read", drawing.file);
        let remedy = "it must lie beside the spec".to_owned();
        return Err(Refusal::new(key::drawing::FILE, RefusalCode::DrawingUnread, found, remedy).into());
    };
    let options = Options { unit: drawing.units, ..Options::new(0.5 * spec.accuracy.path.0) };
    drawings::read(&drawing.file, &content.0, &options)
        .map_err(|faults| faults.iter().map(said::unreadable).collect())
}

/// Layers of a file with roles that suit them.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerProposal {
    /// Every layer with a role and the reason for it, in the order of the file.
    pub layers: Vec<(String, LayerRole, String)>,
    /// Whether the file states the unit of its numbers; else mm were taken.
    pub has_unit: bool,
}

/// The layers of the drawing `bytes`, a file called `name`, with roles that suit them.
///
/// # Errors
/// Every reason for which it cannot be read.
pub fn propose_layers(name: &str, bytes: &[u8]) -> Result<LayerProposal, Refusals> {
    let options = |unit| Options { unit, ..Options::new(0.001) };
    let own = drawings::read(name, bytes, &options(None));
    let has_unit = own.is_ok();
    let read = own
        .or_else(|faults| drawings::read(name, bytes, &options(Some(Unit::Millimetre))).map_err(|_| faults));
    let read = read.map_err(|faults| faults.iter().map(said::unreadable).collect::<Refusals>())?;
    Ok(LayerProposal { layers: roles::proposed(&read), has_unit })
}

/// The figures of the drawing of `spec`, as far as the file can be read; none of a spec without one.
pub fn figures(spec: &Spec) -> Vec<Path> {
    let read = spec.drawing.as_ref().and_then(|drawing| read(spec, drawing).ok());
    let elements = read.into_iter().flat_map(|read| read.elements);
    let paths = elements.filter_map(|element| match element.figure {
        Figure::Path(path) => Some(path),
        Figure::Point(_) => None,
    });
    paths.collect()
}

/// What `drawing` shows by its roles, and what was resolved as it was read.
fn sketch(spec: &Spec, drawing: &DrawingSpec) -> Result<(Sketch, Vec<String>), Refusals> {
    let read = read(spec, drawing)?;
    roles::refusals(&read, drawing).or(())?;
    Ok((roles::sketch(&read, drawing), read.notes.iter().map(ToString::to_string).collect()))
}

/// Where the piece is cut: the outline of `shape`, and `holes` inside it.
fn cut(shape: &SealedShape, holes: &[Path]) -> Result<DrawnCut, Refusal> {
    let Some(outside) = &shape.cut else {
        let found = "the drawn shape has no outline".to_owned();
        let remedy = "draw a closed curve on a layer of `cut`".to_owned();
        return Err(Refusal::new(key::drawing::LAYERS, RefusalCode::WrongOutlines, found, remedy));
    };
    let around = |path: &Path| if path.area() < 0.0 { path.reversed() } else { path.clone() };
    let inside = holes.iter().map(around).collect();
    Ok(DrawnCut { outside: around(outside), inside, kerf: 0.0 })
}
