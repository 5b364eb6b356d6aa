//! Room on the flap of a drawn piece: off its air, its bands, its cuts and the way of its hoses.

use crate::DrawnCut;
use geom::{Enclosures, Point, SegmentIndex};
use sealed::{AirSide, SealedShape};

/// The limits of the flap, indexed for measurements from many points.
pub(super) struct Clearance<'a> {
    air: &'a AirSide,
    airy: Enclosures,
    seams: SegmentIndex,
    cuts: SegmentIndex,
    outline: Enclosures,
    half_band: f64,
}

impl<'a> Clearance<'a> {
    /// The room on a piece of this `shape` around `air` that is cut along `cut`.
    pub(super) fn new(shape: &SealedShape, air: &'a AirSide, cut: &DrawnCut) -> Self {
        let seams = shape.seams.iter().flat_map(|seam| seam.center_line.segments.clone());
        let cuts = cut.inside.iter().chain([&cut.outside]).flat_map(|path| path.segments.clone());
        Self {
            air,
            airy: Enclosures::new(air.edges()),
            seams: SegmentIndex::new(seams.collect()),
            cuts: SegmentIndex::new(cuts.collect()),
            outline: Enclosures::new([&cut.outside]),
            half_band: 0.5 * shape.band,
        }
    }

    /// Whether `p` lies on the flap or an island, at least `from_band` mm from every band and `from_cut` mm from every cut.
    pub(super) fn is_free(&self, p: Point, from_band: f64, from_cut: f64) -> bool {
        !self.cuts.has_within(p, from_cut)
            && !self.seams.has_within(p, from_band + self.half_band)
            && !self.outline.enclosing(p).is_empty()
            && self.airy.enclosing(p).len().is_multiple_of(2)
            && !self.air.is_on_hose(p, from_cut)
    }
}
