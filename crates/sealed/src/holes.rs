//! Cuts and holes inside the outline: those that would cut out bands, those that touch each other, and fabric between them that
//! is too narrow.

use crate::bands::Bands;
use crate::fault::{Quoted, SealingNotes, ShapeCode, ShapeFault};
use crate::mended::NamedPath;
use crate::regions::side_points;
use crate::segments::{Approach, Segments};
use crate::sketch::Rules;
use geom::{Enclosures, Point};

/// Closed cuts with the names of their curves.
pub(super) struct CutPaths {
    /// Around all, drawn or along the bands: one, where there are no faults.
    pub outlines: Vec<NamedPath>,
    /// Holes, then drawn cuts inside an outline.
    pub inner: Vec<NamedPath>,
    /// Number of the inner ones that are drawn as holes.
    pub holes: usize,
    /// Whether cuts are drawn.
    pub are_drawn: bool,
}

/// Faults of cuts inside the outline that have bands inside: these would fall out of the piece. `earlier` are faults that cuts have.
pub(super) fn cuts_around_bands(cuts: &CutPaths, bands: &Bands, earlier: &[ShapeFault]) -> Vec<ShapeFault> {
    let enclosures = Enclosures::new(cuts.inner.iter().map(|cut| &cut.path));
    let mut numbers: Vec<usize> =
        bands.list.iter().flat_map(|band| enclosures.enclosing(side_points(&band.path, 1e-6).0)).collect();
    numbers.sort_unstable();
    numbers.dedup();
    let mut faults: Vec<ShapeFault> = Vec::new();
    for number in numbers {
        let NamedPath { path, names } = &cuts.inner[number];
        // One that crosses a band has its fault.
        let is_known = earlier
            .iter()
            .chain(&faults)
            .any(|fault| fault.code == ShapeCode::CutInBand && fault.names == *names);
        if is_known {
            continue;
        }
        let place = path.start().unwrap_or(Point::ORIGIN);
        let (code, finding, remedy) = if number < cuts.holes {
            let remedy =
                "draw holes beside the bands; the cut around all of it is on a layer with the role `cut`";
            (ShapeCode::CutInBand, format!("the hole {} lies around a band", Quoted(names)), remedy)
        } else {
            let finding = format!("{} lies around a band and within another cut", Quoted(names));
            let remedy = "draw one cut around all of it; a frame belongs on a layer with the role `ignore`";
            (ShapeCode::Outlines, finding, remedy)
        };
        let fault = ShapeFault::new(code, place, finding, remedy);
        faults.push(ShapeFault { names: names.clone(), ..fault });
    }
    faults
}

/// A narrower web of fabric between two cuts tears easily, mm: registration holes of a drawing keep as far from its cuts.
const LEAST_WEB: f64 = 3.0;

/// Faults of cuts and holes that cross or touch each other, and warnings of thin webs between them.
///
/// Each cut is compared with those before it, so that a pair is told once. Of all places of a pair the narrowest is told.
pub(super) fn webs(cuts: &CutPaths, rules: &Rules) -> SealingNotes {
    let paths: Vec<&NamedPath> = cuts.outlines.iter().chain(&cuts.inner).collect();
    let segments = Segments::new(paths.iter().map(|cut| &cut.path));
    let mut notes = SealingNotes::default();
    for (number, cut) in paths.iter().enumerate().skip(cuts.outlines.len()) {
        let mut thinnest = (LEAST_WEB, Point::ORIGIN, number);
        for Approach { distance, place, path } in segments.approaches(&cut.path, LEAST_WEB) {
            if path < number && distance < thinnest.0 - 1e-6 {
                thinnest = (distance, place, path);
            }
        }
        let (width, place, other) = thinnest;
        if other == number {
            continue;
        }
        let other_names = &paths[other].names;
        let hole = Quoted(&cut.names);
        let other_cut =
            if other_names.is_empty() { "the cut".to_owned() } else { Quoted(other_names).to_string() };
        let names = [&cut.names[..], other_names].concat();
        if width <= rules.join.max(1e-6) {
            let finding = format!("{hole} crosses or touches {other_cut}");
            let remedy = format!(
                "move it, so that {LEAST_WEB} mm of fabric stay between them, or draw both as one cut"
            );
            let fault = ShapeFault::new(ShapeCode::CutInBand, place, finding, remedy);
            notes.faults.push(ShapeFault { names, found: width, allowed: LEAST_WEB, ..fault });
        } else {
            let finding = format!("only {width:.3} mm of fabric between {hole} and {other_cut}");
            let remedy = format!("it may tear: leave {LEAST_WEB} mm, or more");
            let fault = ShapeFault::new(ShapeCode::ThinWeb, place, finding, remedy);
            notes.warnings.push(ShapeFault { names, found: width, allowed: LEAST_WEB, ..fault });
        }
    }
    notes
}
