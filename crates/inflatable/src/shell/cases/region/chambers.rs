//! From loops and welds to chambers.

use crate::shell::cases::region::pressures::PartialPressure;
use crate::shell::element::Fabric;
use crate::shell::mesh::{FlatChamber, MeshFault};
use geom::Path;

/// One flat chamber and its load, SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct FlatRegion {
    /// Sealed outline, m.
    pub chamber: FlatChamber,
    /// Y, N/m, B, N m, and nu of one sheet.
    pub fabric: Fabric,
    /// Gauge pressure p, Pa.
    pub pressure: f64,
    /// Width of the band that seals it, m: over so long a piece of seam the pull is the mean.
    pub band: f64,
    /// Places of the flat sheet whose positions after inflation are wanted, m.
    pub probes: Vec<[f64; 2]>,
    /// Chambers of lower pressure between its walls.
    pub partial: Vec<PartialPressure>,
    /// Distance of two rigid level plates between which it is inflated, m.
    pub plates: Option<f64>,
}

/// The chambers that `loops` enclose, in the order of their outlines, each with its islands and with those of the open `welds` that begin in
/// it or on its outline. A loop in an even number of others is an outline, one in an odd number an island, or a hole if one of the closed
/// curves `cuts`, along which fabric is cut out, lies in it. Loops may run either way.
///
/// # Errors
/// If a curve is empty or has a gap, or a weld lies in no chamber.
pub fn chambers(loops: &[Path], welds: &[Path], cuts: &[Path]) -> Result<Vec<FlatChamber>, MeshFault> {
    if let Some(bad) = loops.iter().chain(welds).chain(cuts).find(|path| !is_sound(path)) {
        return Err(MeshFault::Dimension {
            name: "the largest gap of a curve, m",
            found: bad.largest_gap(),
            allowed: "a millionth of its length",
        });
    }
    let depth = |at: usize| {
        let p = loops[at].segments[0].point(0.5);
        (0..loops.len()).filter(|other| *other != at && loops[*other].encloses(p)).count()
    };
    let depths: Vec<usize> = (0..loops.len()).map(depth).collect();
    let mut nested: Vec<(usize, FlatChamber)> = Vec::new();
    for (outline, depth) in loops.iter().zip(&depths).filter(|(_, depth)| *depth % 2 == 0) {
        let outline = outline.counterclockwise();
        nested.push((*depth, FlatChamber { outline, ..FlatChamber::default() }));
    }
    for (island, depth) in loops.iter().zip(&depths).filter(|(_, depth)| *depth % 2 == 1) {
        let p = island.segments[0].point(0.5);
        let enclosing =
            nested.iter_mut().find(|(outer, chamber)| outer + 1 == *depth && chamber.outline.encloses(p));
        let Some((_, chamber)) = enclosing else { continue };
        if cuts.iter().any(|cut| cut.start().is_some_and(|p| island.encloses(p))) {
            let is_clockwise = island.area() < 0.0;
            chamber.holes.push(if is_clockwise { island.clone() } else { island.reversed() });
        } else {
            chamber.islands.push(island.clone());
        }
    }
    for weld in welds {
        let p = weld.segments[0].point(0.5);
        let enclosing = nested.iter_mut().filter(|(_, chamber)| chamber.outline.encloses(p));
        match enclosing.max_by_key(|(depth, _)| *depth) {
            Some((_, chamber)) => chamber.welds.push(weld.clone()),
            None => return Err(MeshFault::Outside { at: [p.x, p.y] }),
        }
    }
    Ok(nested.into_iter().map(|(_, chamber)| chamber).collect())
}

/// Whether a curve is valid: finite, of positive length, and without gaps.
fn is_sound(path: &Path) -> bool {
    let length = path.length();
    length > 0.0 && length.is_finite() && path.largest_gap() <= 1e-6 * length
}
