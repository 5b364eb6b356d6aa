//! One piece as it lies on its sheet: fabric, tube, bands, edges, holes.

use crate::emit::picture::{Group, Pen};
use crate::emit::preview::place::Places;
use crate::emit::preview::style::{CUT, FABRIC, LABEL, PAGE, Style, TUBE, band_ink, circle};
use design::{CutEdge, FlatPiece, PlacedPart};
use geom::Path;
use spec::Spec;

/// Fabric, tube, bands and edges of one piece.
pub(super) fn piece_group(spec: &Spec, part: FlatPiece<'_>, placed: &PlacedPart, style: Style) -> Group {
    let motion = &placed.placement;
    let mut group = Group::new(format!("{}-{}", placed.kind, placed.index));
    let (shape, lines) = (part.shape(), part.cut(CutEdge::Part));
    let cut: Vec<Path> =
        std::iter::once(lines.outside).chain(lines.inside).map(|path| motion.path(path)).collect();
    group.area(cut.clone(), FABRIC);
    // The outermost edge first, the edges inside it after.
    group.area(part.tube().iter().rev().map(|path| motion.path(path)).collect(), TUBE);
    for (seam, lines) in shape.seams.iter().zip(part.seam_lines()) {
        group.line(motion.path(&seam.center_line), Pen::new(band_ink(spec, &lines.process), shape.band));
    }
    // As drawn, where a round iron cannot follow: in the cusps.
    let thin = (1.2 / style.unit * shape.band).min(1.0);
    for edge in part.edges() {
        group.line(motion.path(edge), style.dashes(LABEL, 0.5 * thin));
    }
    if let FlatPiece::Star(_) = part {
        for edge in part.tube() {
            group.line(motion.path(edge), style.pen(LABEL, 0.7 * thin));
        }
    }
    for edge in cut {
        group.line(edge, style.pen(CUT, 1.0));
    }
    for valve in &shape.valves {
        // Through the hole in the upper sheet the lower one is seen.
        group.area(vec![motion.path(&valve.hole)], FABRIC);
        group.line(motion.path(&valve.hole), style.pen(CUT, 1.0));
        group.line(motion.path(&valve.rim), style.dashes(LABEL, thin));
    }
    for hole in lines.holes {
        let edge = circle(placed.placement.point(hole.center), hole.diameter / 2.0);
        group.area(vec![edge.clone()], PAGE);
        group.line(edge, style.pen(CUT, 1.0));
    }
    group
}

/// Labels keep off everything of the piece that is thinner than they are.
pub(super) fn keep_off_piece(places: &mut Places, part: FlatPiece<'_>, placed: &PlacedPart, ramp: f64) {
    let motion = &placed.placement;
    let (shape, cut) = (part.shape(), part.cut(CutEdge::Part));
    for edge in std::iter::once(cut.outside).chain(cut.inside) {
        places.keep_off(&motion.path(edge), 0.0);
    }
    for seam in &shape.seams {
        places.keep_off(&motion.path(&seam.center_line), shape.band);
        for lead in [seam.lead_in(ramp), seam.lead_out(ramp)] {
            places.keep_off(&motion.path(&lead), shape.band);
        }
    }
    for valve in &shape.valves {
        places.keep_off(&motion.path(&valve.hole), 0.0);
        places.keep_off(&motion.path(&valve.rim), 0.0);
    }
    for hole in cut.holes {
        places.keep_off(&circle(placed.placement.point(hole.center), hole.diameter / 2.0), 0.0);
    }
}
