//! Cuts and holes inside the outline: those that would cut out bands, those that touch each other, and fabric between them that
//! is too narrow.

use crate::air::beside;
use crate::fault::{ShapeCode, ShapeFault, quoted};
use crate::layout::Layout;
use crate::notes::SealingNotes;
use crate::segments::{Approach, Segments};
use crate::sketch::Rules;
use geom::{Enclosures, Path, Point};

/// Faults of cuts inside the outline that have bands inside: these would fall out of the piece. The first `holes` of `inner` are
/// drawn as holes.
pub(super) fn around_bands(
    inner: &[(Path, Vec<String>)],
    holes: usize,
    lines: &Layout,
    notes: &mut SealingNotes,
) {
    let around = Enclosures::new(inner.iter().map(|(path, _)| path));
    let mut within: Vec<usize> =
        lines.lines.iter().flat_map(|line| around.around(beside(&line.path, 1e-6).0)).collect();
    within.sort_unstable();
    within.dedup();
    for number in within {
        let (path, names) = &inner[number];
        // One that crosses a band is known.
        if notes.faults.iter().any(|fault| fault.code == ShapeCode::CutInBand && fault.names == *names) {
            continue;
        }
        let place = path.start().unwrap_or(Point::ORIGIN);
        let own = quoted(names);
        let (code, what, remedy) = if number < holes {
            let remedy =
                "draw holes beside the bands; the cut around all of it is on a layer with the role `cut`";
            (ShapeCode::CutInBand, format!("the hole {own} lies around a band"), remedy)
        } else {
            let remedy = "draw one cut around all of it; a frame belongs on a layer with the role `ignore`";
            (ShapeCode::Outlines, format!("{own} lies around a band and within another cut"), remedy)
        };
        notes.fault(code, names, place, (what, remedy), [f64::NAN; 2]);
    }
}

/// A narrower web of fabric between two cuts tears easily, mm: registration holes of a drawing keep as far from its cuts.
const LEAST_WEB: f64 = 3.0;

/// Faults of cuts and holes that cross or touch each other, and warnings of thin webs between them.
///
/// Each cut is compared with those before it, so that a pair is told once. Of all places of a pair the narrowest is told.
pub(super) fn webs(
    outlines: &[(Path, Vec<String>)],
    inner: &[(Path, Vec<String>)],
    rules: &Rules,
    notes: &mut SealingNotes,
) {
    let cuts: Vec<&(Path, Vec<String>)> = outlines.iter().chain(inner).collect();
    let segments = Segments::of(cuts.iter().map(|(path, _)| path));
    for (number, (path, names)) in cuts.iter().enumerate().skip(outlines.len()) {
        let mut least = (LEAST_WEB, Point::ORIGIN, number);
        for Approach { distance, place, path } in segments.approaches(path, LEAST_WEB) {
            if path < number && distance < least.0 - 1e-6 {
                least = (distance, place, path);
            }
        }
        let (far, place, other) = least;
        if other == number {
            continue;
        }
        let across = &cuts[other].1;
        let (hole, own) = (quoted(names), [&names[..], across].concat());
        let cut = if across.is_empty() { "the cut".to_owned() } else { quoted(across) };
        if far <= rules.join.max(1e-6) {
            let what = format!("{hole} crosses or touches {cut}");
            let remedy = format!(
                "move it, so that {LEAST_WEB} mm of fabric stay between them, or draw both as one cut"
            );
            notes.fault(ShapeCode::CutInBand, &own, place, (what, remedy), [far, LEAST_WEB]);
        } else {
            let what = format!("only {far:.3} mm of fabric between {hole} and {cut}");
            let remedy = format!("it may tear: leave {LEAST_WEB} mm, or more");
            notes.warnings.push(ShapeFault::new(
                ShapeCode::ThinWeb,
                &own,
                place,
                (what, remedy),
                [far, LEAST_WEB],
            ));
        }
    }
}
