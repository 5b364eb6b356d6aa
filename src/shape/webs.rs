//! Webs: the fabric between two cuts of a piece.

use crate::shape::fault::{ShapeCode, ShapeFault, quoted};
use crate::shape::notes::SealingNotes;
use crate::shape::sketch::Rules;
use inflatable::geom::{BoxIndex, Path, Point, Segment};

/// A narrower web of fabric between two cuts tears easily, mm: registration holes of a drawing keep as far from its cuts.
const LEAST_WEB: f64 = 3.0;

/// Faults of cuts and holes that cross or touch each other, and warnings of thin webs between them.
pub(super) fn webs(
    outlines: &[(Path, Vec<String>)],
    inner: &[(Path, Vec<String>)],
    rules: &Rules,
    notes: &mut SealingNotes,
) {
    let cuts = || outlines.iter().chain(inner).enumerate();
    let segments: Vec<(usize, Segment)> =
        cuts().flat_map(|(at, (path, _))| path.segments.iter().map(move |s| (at, *s))).collect();
    let index = BoxIndex::new(segments.iter().map(|(_, segment)| segment.bounds()));
    for (number, (path, names)) in cuts().skip(outlines.len()) {
        let mut least = (LEAST_WEB, Point::ORIGIN, number);
        for segment in &path.segments {
            for i in index.overlapping(&segment.bounds().grown(LEAST_WEB)) {
                let (other, across) = &segments[i];
                let far = inflatable::geom::segment_distance(segment, across);
                if *other < number && far < least.0 - 1e-6 {
                    let near = across.point(across.nearest_fraction(segment.point(0.5)));
                    least = (far, segment.point(segment.nearest_fraction(near)), *other);
                }
            }
        }
        let (far, place, other) = least;
        if other == number {
            continue;
        }
        let own =
            [names.clone(), cuts().nth(other).map_or(Vec::new(), |(_, (_, names))| names.clone())].concat();
        let hole = quoted(names);
        let cut = match cuts().nth(other).map(|(_, (_, names))| names.as_slice()) {
            Some([]) | None => "the cut".to_owned(),
            Some(names) => quoted(names),
        };
        if far <= rules.join.max(1e-6) {
            let text = (
                format!("{hole} crosses or touches {cut}"),
                format!(
                    "move it, so that {LEAST_WEB} mm of fabric stay between them, or draw both as one cut"
                ),
            );
            notes.fault(ShapeCode::CutInBand, &own, place, text, [far, LEAST_WEB]);
        } else {
            let what = format!("only {far:.3} mm of fabric between {hole} and {cut}");
            let remedy = format!("it may tear: leave {LEAST_WEB} mm, or more");
            let (code, allowed) = (ShapeCode::ThinWeb, LEAST_WEB);
            notes.warnings.push(ShapeFault { code, names: own, place, found: far, allowed, what, remedy });
        }
    }
}
