//! Room on the flap of a drawn piece: off its air, its bands, its cuts and the way of its hoses.

use crate::design::DrawnCut;
use crate::shape::{AirSide, SealedShape};
use inflatable::geom::{Bounds, BoxIndex, Enclosures, Point, Segment};

/// What the flap ends at, to be measured from many points.
pub(super) struct Clearance<'a> {
    air: &'a AirSide,
    airy: Enclosures,
    seams: Segments,
    cuts: Segments,
    outline: Enclosures,
    half_band: f64,
}

struct Segments {
    list: Vec<Segment>,
    index: BoxIndex,
}

impl Segments {
    fn new(list: Vec<Segment>) -> Self {
        Self { index: BoxIndex::new(list.iter().map(Segment::bounds)), list }
    }

    /// Distance of `p` from the nearest of them, mm; at most `reach`.
    fn distance(&self, p: Point, reach: f64) -> f64 {
        let near = self.index.overlapping(&Bounds::of_points([p]).grown(reach));
        near.into_iter().map(|i| self.list[i].distance(p)).fold(reach, f64::min)
    }
}

impl<'a> Clearance<'a> {
    /// The room on a piece of this `shape` around `air` that is cut along `cut`.
    pub(super) fn new(shape: &SealedShape, air: &'a AirSide, cut: &DrawnCut) -> Self {
        let seams = shape.seams.iter().flat_map(|seam| seam.center_line.segments.clone());
        let cuts = cut.inside.iter().chain([&cut.outside]).flat_map(|path| path.segments.clone());
        Self {
            air,
            airy: Enclosures::new(air.edges()),
            seams: Segments::new(seams.collect()),
            cuts: Segments::new(cuts.collect()),
            outline: Enclosures::new([&cut.outside]),
            half_band: 0.5 * shape.band,
        }
    }

    /// Whether `p` lies on the flap or an island, at least `from_band` mm from every band and `from_cut` mm from every cut.
    pub(super) fn is_free(&self, p: Point, from_band: f64, from_cut: f64) -> bool {
        let seams = from_band + self.half_band;
        self.cuts.distance(p, from_cut) >= from_cut
            && self.seams.distance(p, seams) >= seams
            && !self.outline.around(p).is_empty()
            && self.airy.around(p).len().is_multiple_of(2)
            && !self.air.is_on_hose(p, from_cut)
    }
}
