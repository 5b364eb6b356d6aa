//! A sketch as a sealed shape, or all its faults: the passes, in their order.

use crate::bands::{BandKind, Bands, bands_around};
use crate::checks::checked;
use crate::cut::{SketchCuts, cuts};
use crate::drawn_seams::{join_ends, with_seams};
use crate::fabric::FabricSketch;
use crate::fault::{Noted, Quoted, Repair, SealingNotes, ShapeCode, ShapeFault, ShapeWarning};
use crate::mended::{MendedCurves, MendedEdges, MendedSketch, mended};
use crate::mouth::Mouth;
use crate::order::{ordered, seam_names};
use crate::ports::{lost_ports, opened_regions};
use crate::regions::regions;
use crate::sketch::{Rules, Sketch};
use crate::unsound::unsound_chambers;
use crate::valve::placed_valves;
use crate::{AirSide, Port, Role, SealedShape, Seam};
use geom::order::sort_by_key;
use geom::{Path, Point};

/// A sketch that can be sealed.
#[derive(Clone, Debug, PartialEq)]
pub struct Sealing {
    /// The shape.
    pub shape: SealedShape,
    /// The air that the seams enclose.
    pub air: AirSide,
    /// Bands within the air: walls and welds, by their centre lines as they are sealed.
    pub inner: Vec<Path>,
    /// Closed paths that are cut inside the outline: holes, and drawn cuts inside it.
    pub holes: Vec<Path>,
    /// The repairs of the drawing.
    pub repairs: Vec<Repair>,
    /// Places that may fail or differ from the drawing.
    pub warnings: Vec<ShapeWarning>,
}

/// The sealed shape of a sketch.
///
/// Each pass takes the result of the one before and returns its own with notes. The passes up to the bands look at all that is drawn; where
/// they find faults, what comes after would only repeat them.
///
/// # Errors
/// All faults that were found, each with its place. Faults of single curves hide those of bands.
pub fn sealed_shape(sketch: &Sketch, rules: &Rules) -> Result<Sealing, Vec<ShapeFault>> {
    let (mended_sketch, mut notes) = mended(sketch, rules);
    let MendedSketch { ports, edges, seams, cuts: mended_cuts, valves: valve_curves } = mended_sketch;
    let fabric = FabricSketch { ports: &ports, has_cuts: !sketch.cuts.is_empty() };
    let (bands, band_notes) = all_bands(&edges, seams, &fabric, rules, &notes.faults);
    notes += band_notes;
    if !notes.faults.is_empty() {
        return Err(notes.faults);
    }
    let bands = Bands { list: join_ends(bands.list, rules.band), ..bands };
    let (SketchCuts { outline, inner: holes }, cut_notes) =
        cuts(&sketch.cuts, mended_cuts, &ports, rules, &bands);
    notes += cut_notes;
    let (valves, valve_notes) = placed_valves(valve_curves, rules, &bands);
    notes += valve_notes;
    let bands = Bands { list: ordered(bands.list), ..bands };
    notes += checked(&bands, &ports, rules, &notes.faults);
    let inner = bands.list.iter().filter(|band| band.kind.is_inner()).map(|band| band.path.clone()).collect();
    let (seams, seam_notes) = seams_along(&bands, rules);
    notes += seam_notes;
    let ports_of_shape = placed_ports(&bands.mouths);
    let shape = SealedShape { seams, band: rules.band, cut: outline, ports: ports_of_shape, valves };
    let faults = unsound_chambers(&shape, &bands, &ports, rules, &notes.faults);
    notes.faults.extend(faults);
    if !notes.faults.is_empty() {
        return Err(notes.faults);
    }
    let air = AirSide { mouths: bands.mouths, ..bands.air };
    Ok(Sealing { shape, air, inner, holes, repairs: notes.repairs, warnings: notes.warnings })
}

/// The bands around the air, and those that are drawn. The notes of drawn seams follow those of the air. `earlier` are the faults of edges.
fn all_bands(
    edges: &MendedEdges,
    seams: Noted<MendedCurves>,
    sketch: &FabricSketch<'_>,
    rules: &Rules,
    earlier: &[ShapeFault],
) -> Noted<Bands> {
    let (seams, seam_notes) = seams;
    let (air, mut notes) = regions(&edges.network, &edges.rings, &edges.names, rules.join);
    let (opened, port_notes) = opened_regions(air, edges, sketch.ports, !seams.names.is_empty(), rules);
    notes += port_notes;
    let faults = [earlier, &notes.faults].concat();
    let (bands, band_notes) = bands_around(opened, &edges.names, sketch, rules, &faults);
    notes += band_notes;
    notes += seam_notes;
    let (bands, drawn_notes) = with_seams(bands, seams, sketch.ports, rules);
    notes += drawn_notes;
    let has_faults = !earlier.is_empty() || !notes.faults.is_empty();
    if !has_faults {
        notes.faults.extend(lost_ports(sketch.ports, &bands.taken_ports, rules));
    }
    if bands.list.is_empty() && !has_faults && notes.faults.is_empty() {
        let (finding, remedy) = ("no edge of air and no seam is drawn", "give a layer the role air or seam");
        let fault = ShapeFault::new(ShapeCode::Empty, Point::ORIGIN, finding, remedy);
        notes.faults.push(ShapeFault { found: 0.0, allowed: 1.0, ..fault });
    }
    (bands, notes)
}

/// The ports of a shape, in the order of the drawn ones.
fn placed_ports(mouths: &[Mouth]) -> Vec<Port> {
    let mut mouths = mouths.to_vec();
    sort_by_key(&mut mouths, |mouth| mouth.port);
    mouths.iter().map(|mouth| Port { at: mouth.at, width: 2.0 * mouth.half }).collect()
}

/// The seams along bands. A closed seam is sealed twice along half of its length at most.
fn seams_along(bands: &Bands, rules: &Rules) -> Noted<Vec<Seam>> {
    let names = seam_names(&bands.list);
    let mut seams: Vec<Seam> = Vec::with_capacity(names.len());
    for (band, name) in bands.list.iter().zip(names) {
        let overlap = if band.path.closed { rules.overlap.min(0.5 * band.path.length()) } else { 0.0 };
        let role = if band.kind == BandKind::Weld { Role::Weld } else { Role::Boundary };
        seams.push(Seam { name, role, center_line: band.path.clone(), overlap });
    }
    let is_short = |seam: &&Seam| seam.center_line.closed && seam.overlap < rules.overlap;
    let shortest = seams.iter().filter(is_short).min_by(|a, b| a.overlap.total_cmp(&b.overlap));
    let mut notes = SealingNotes::default();
    if let Some((overlap, place)) = shortest.and_then(|seam| Some((seam.overlap, seam.center_line.start()?)))
    {
        let names: Vec<String> = seams.iter().filter(is_short).map(|seam| seam.name.clone()).collect();
        let finding = format!(
            "closed seams shorter than twice the overlap of {} mm overlap by half their length, at least {overlap:.3} mm: {}",
            rules.overlap,
            Quoted(&names)
        );
        notes.repairs.push(Repair { names, place, what: finding });
    }
    (seams, notes)
}
