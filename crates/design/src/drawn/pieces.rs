//! All pieces of a drawing, and their copies on sheets.

use crate::drawn::process::SeamProcesses;
use crate::drawn::{DrawnPiece, Measure, measure, read, rules, sketch};
use crate::placement::{SheetLayout, footprint, place};
use crate::{FlatPiece, PlacedPart, RefusalCode, Refusals, Warning};
use geom::{Bounds, Path};
use sealed::{DrawnPort, separate};
use spec::{DrawingSpec, Fabric, LayerRole, Machine, Spec};

/// The pieces of one drawing: what its cuts part.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnPieces {
    /// The pieces in the order in which they are drawn, in the drawing's frame.
    pub pieces: Vec<DrawnPiece>,
    /// The repairs and choices made as the drawing was read, a sentence each.
    pub notes: Vec<String>,
    /// The places where hoses go in, in the order of the file.
    pub ports: Vec<DrawnPort>,
    /// The points and lines that are measured after inflation: those of the file in its order, then those of the spec.
    pub measures: Vec<Measure>,
    /// The lines along seams that rigid bars hold, in the order of the file.
    pub bars: Vec<Measure>,
    /// Every piece where it lies; the copies of the drawing one after another.
    pub copies: Vec<PlacedPart>,
}

impl DrawnPieces {
    /// The kind of its copies.
    const KIND: &'static str = "piece";

    /// The pieces that `drawing` of `spec` shows, laid on sheets for `machine`, and the warnings about them.
    ///
    /// # Errors
    /// Every reason for which the drawing cannot be read, or a piece not be made or laid on a sheet.
    pub(crate) fn new(
        spec: &Spec,
        drawing: &DrawingSpec,
        machine: &Machine,
    ) -> Result<(Self, Vec<SheetLayout>, Vec<Warning>), Refusals> {
        let (whole_sketch, mut notes) = sketch(spec, drawing)?;
        let (mut pieces, mut warnings, mut refusals) = (Vec::new(), Vec::new(), Refusals::new());
        let artwork = read(spec, drawing)?;
        let mut processes = SeamProcesses::new(&artwork, drawing, spec.seal.band.0);
        for whole_sketch in separate(&whole_sketch, &rules(spec, drawing)) {
            if let Some((piece, warned, repairs)) =
                refusals.keep(DrawnPiece::new(spec, drawing, &whole_sketch, &mut processes))
            {
                pieces.push(piece);
                warnings.extend(warned);
                notes.extend(repairs);
            }
        }
        if refusals.is_empty() {
            let seams = pieces.iter().flat_map(|piece: &DrawnPiece| &piece.shape.seams);
            let names: Vec<&str> = seams.map(|seam| seam.name.as_str()).collect();
            refusals.extend(processes.without_seam(&names));
        }
        let [mut measures, bars] =
            [LayerRole::Measure, LayerRole::Pull].map(|role| measure::of_role(&artwork, drawing, role));
        match measure::of_spec(&artwork, drawing) {
            Ok(of_spec) => measures.extend(of_spec),
            Err(unknown) => refusals.extend(unknown),
        }
        without_missing_ports(refusals).or_value(())?;
        let ramp = machine.process.ramp.0;
        let bounds: Vec<Bounds> =
            pieces.iter().map(|piece| footprint(&piece.shape, &piece.tool.outside, ramp)).collect();
        let number = usize::try_from(spec.sheet.copies).unwrap_or(1);
        let distinct: Vec<usize> = (0..number).flat_map(|_| 0..pieces.len()).collect();
        let boxes: Vec<Bounds> = distinct.iter().map(|number| bounds[*number]).collect();
        let (places, sheets) = place(&boxes, &spec.sheet, machine)?;
        let copies = PlacedPart::place_all(Self::KIND, &distinct, places);
        Ok((Self { pieces, notes, ports: whole_sketch.ports, measures, bars, copies }, sheets, warnings))
    }

    /// The closed boundaries of the air of all pieces.
    pub fn air(&self) -> Vec<Path> {
        self.pieces.iter().flat_map(|piece| piece.air.clone()).collect()
    }

    /// Walls and welds of all pieces, as far as they lie in the air.
    pub fn inner(&self) -> Vec<Path> {
        self.pieces.iter().flat_map(|piece| piece.inner.clone()).collect()
    }

    /// The openings that are cut out of the pieces.
    pub fn holes(&self) -> Vec<Path> {
        self.pieces.iter().flat_map(|piece| piece.part.inside.clone()).collect()
    }

    /// The box around all pieces.
    pub fn bounds(&self) -> Bounds {
        self.pieces.iter().map(|piece| piece.part.outside.bounds()).fold(Bounds::EMPTY, Bounds::union)
    }

    /// Mass of the fabric of one copy of the drawing, g; `None` if the fabric's is unknown.
    pub fn mass(&self, fabric: &Fabric) -> Option<f64> {
        self.pieces.iter().map(|piece| FlatPiece::Drawn(piece).mass(fabric)).sum()
    }
}

/// The refusals of all pieces without those of chambers that have no port, where as many ports were refused: those are meant for them.
fn without_missing_ports(refusals: Refusals) -> Refusals {
    use RefusalCode::{ChamberWithoutPort, PortOffEdge, PortTooWide};
    let missing = refusals.iter().filter(|refusal| refusal.code == ChamberWithoutPort).count();
    let refused = refusals.iter().filter(|refusal| matches!(refusal.code, PortOffEdge | PortTooWide)).count();
    let are_meant = missing <= refused;
    refusals.into_iter().filter(|refusal| !(are_meant && refusal.code == ChamberWithoutPort)).collect()
}
