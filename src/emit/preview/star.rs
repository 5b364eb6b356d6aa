//! One star as it lies on its sheet: fabric, tube, bands, edges, holes.

use crate::design::{PlacedStar, StarDesign};
use crate::emit::picture::{Group, Pen};
use crate::emit::preview::place::Places;
use crate::emit::preview::style::{BAND, CUT, FABRIC, LABEL, PAGE, Style, TUBE, circle};
use inflatable::geom::Path;

/// Fabric, tube, bands and edges of one star.
pub(super) fn star_group(part: &StarDesign, star: &PlacedStar, style: Style) -> Group {
    let place = |path: &Path| star.placement.path(path);
    let mut group = Group::new(format!("star-{}", star.index));
    let cut = [&part.outline.outside, &part.outline.hole].map(place);
    group.area(cut.to_vec(), FABRIC);
    let [inner, outer] = &part.realised_edges;
    group.area(vec![place(outer), place(inner)], TUBE);
    for seam in &part.shape.seams {
        group.line(place(&seam.center_line), Pen::new(BAND, part.shape.band));
    }
    // As drawn, where a round iron cannot follow: in the cusps.
    let thin = (1.2 / style.unit * part.shape.band).min(1.0);
    for edge in &part.edges {
        group.line(place(edge), style.dashes(LABEL, 0.5 * thin));
    }
    for edge in &part.realised_edges {
        group.line(place(edge), style.pen(LABEL, 0.7 * thin));
    }
    for edge in cut {
        group.line(edge, style.pen(CUT, 1.0));
    }
    for hole in &part.outline.registration {
        let edge = circle(star.placement.point(hole.center), hole.diameter / 2.0);
        group.area(vec![edge.clone()], PAGE);
        group.line(edge, style.pen(CUT, 1.0));
    }
    group
}

/// Labels keep off everything of the star that is thinner than they are.
pub(super) fn keep_off_star(places: &mut Places, part: &StarDesign, star: &PlacedStar, ramp: f64) {
    let place = |path: &Path| star.placement.path(path);
    for edge in [&part.outline.outside, &part.outline.hole] {
        places.keep_off(&place(edge), 0.0);
    }
    for seam in &part.shape.seams {
        places.keep_off(&place(&seam.center_line), part.shape.band);
        for lead in [seam.lead_in(ramp), seam.lead_out(ramp)] {
            places.keep_off(&place(&lead), part.shape.band);
        }
    }
    for hole in &part.outline.registration {
        places.keep_off(&circle(star.placement.point(hole.center), hole.diameter / 2.0), 0.0);
    }
}
