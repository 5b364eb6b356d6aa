//! Ramps on which the iron presses past the ends of open seams: it seals there what no seam is drawn on.

use crate::plan::seal::batches;
use design::{Design, FlatPiece, Refusal, RefusalCode};
use geom::{Enclosures, Path, Point};
use sealed::{PlacedPiece, laid_seams};
use spec::units::Most;
use spec::{Machine, ProgramScope, Spec, key};

/// The reason for which a ramp of the profile seals more than half a band past an end of an open seam: it is below the top of the release
/// layer there, within a cut. Past a mouth there is no fabric of the piece.
pub fn pressed_beyond(spec: &Spec, machine: &Machine, design: &Design) -> Option<Refusal> {
    let (ramp, heights) = (machine.process.ramp.0, machine.process.heights);
    let (low, high) = (lowest_contact(spec, machine, design), heights.travel.0);
    if low >= 0.0 {
        return None;
    }
    let excess = ramp * -low / (high - low);
    batches(design, ProgramScope::Sheet).iter().find_map(|(_, placed)| {
        let (name, band, end) = sealed_beyond(&design.pieces(placed), excess)?;
        let half = band / 2.0;
        let place = format!("X {:.3} Y {:.3} mm", end.x, end.y);
        Some(Refusal::new(
            key::machine::PROFILE,
            RefusalCode::LongRamp,
            format!("on the profile's ramp of {ramp} mm the iron presses {excess:.3} mm past an end of {name} at {place} of the sheet"),
            format!(
                "{half} mm are allowed, half a band: a ramp of at most {} mm, or `contact` nearer to 0",
                Most(ramp * half / excess)
            ),
        ))
    })
}

/// The lowest height in contact of the processes of `design`, mm.
fn lowest_contact(spec: &Spec, machine: &Machine, design: &Design) -> f64 {
    let parts = design.firsts().map(|placed| design.part(placed));
    let processes = parts.flat_map(FlatPiece::seam_lines).map(|seam| spec.process(&seam.process));
    let heights = processes.map(|process| process.seal.contact(&machine.process).0);
    heights.fold(f64::INFINITY, f64::min)
}

/// The first open seam of `pieces` past whose end `excess` mm reach more than half a band into a piece: its name, its band, and the end.
fn sealed_beyond(pieces: &[PlacedPiece<'_>], excess: f64) -> Option<(String, f64, Point)> {
    let band = pieces.iter().map(|piece| piece.shape.band).fold(f64::INFINITY, f64::min);
    if excess <= band / 2.0 + 1e-6 {
        return None;
    }
    let cuts: Vec<Path> =
        pieces.iter().filter_map(|piece| Some(piece.placement.path(piece.shape.cut.as_ref()?))).collect();
    let cuts = Enclosures::new(&cuts);
    let is_on_piece = |way: &Path| {
        // From the end of the seam outwards; a stretch shorter than half a band is no seam.
        let steps = (excess / band).ceil().max(1.0) * 4.0;
        let share = |i: f64| band / 2.0 + (excess - band / 2.0) * i / steps;
        let mut distances = (0..).map(f64::from).take_while(|i| *i <= steps).map(share);
        distances.any(|s| way.point_at(s).is_some_and(|p| !cuts.enclosing(p).is_empty()))
    };
    laid_seams(pieces, excess).into_iter().filter(|seam| seam.overlap <= 0.0).find_map(|seam| {
        let ways = [seam.lead_in.reversed(), seam.lead_out];
        let way = ways.into_iter().find(is_on_piece)?;
        Some((seam.name.to_string(), band, way.start()?))
    })
}
