//! The two **sides** of a port's channel, as stretches of centre lines: they run straight back from the two ends at its mouth.

use crate::bottleneck::Bottleneck;
use crate::layout::{Layout, Line};
use crate::mouth::Mouth;
use crate::sketch::Rules;
use geom::{Path, Point, Segment};

/// Points nearer than this are one, mm.
const ONE: f64 = 1e-6;

/// The sides of one port's channel.
pub(super) struct ChannelSides<'a> {
    pub mouth: &'a Mouth,
    /// Distance of the centre lines from the middle of the channel, mm.
    across: f64,
    /// How far out the left side begins, and the right one, from the middle of the mouth, mm.
    begin: [f64; 2],
}

impl<'a> ChannelSides<'a> {
    /// The sides of all channels whose two ends `layout` has.
    pub(super) fn all(layout: &'a Layout, rules: &Rules) -> Vec<Self> {
        let sides = |mouth: &'a Mouth| {
            let across = mouth.half + rules.band / 2.0;
            let begin = [across, -across].map(|side| begin(mouth, side, &layout.lines, rules.overrun));
            let [Some(left), Some(right)] = begin else { return None };
            Some(Self { mouth, across, begin: [left, right] })
        };
        layout.mouths.iter().filter_map(sides).collect()
    }

    /// Whether `neck` lies between the two sides: as wide as the hose needs, by its making.
    pub(super) fn are_around(&self, neck: &Bottleneck) -> bool {
        let [p, q] = neck.points.map(|p| self.mouth.local(p).1 > 0.0);
        p != q && neck.points.iter().all(|p| self.has(*p))
    }

    /// Whether `p` lies on a side.
    fn has(&self, p: Point) -> bool {
        let (along, aside) = self.mouth.local(p);
        let begin = self.begin[usize::from(aside < 0.0)];
        (aside.abs() - self.across).abs() < ONE && along >= begin - ONE && along <= self.mouth.beyond
    }

    /// Whether `path` ends at the mouth.
    pub(super) fn ends(&self, path: &Path) -> bool {
        let ends = [path.start(), path.end()].into_iter().flatten();
        ends.map(|end| self.mouth.local(end)).any(|(along, aside)| {
            (aside.abs() - self.across).abs() < ONE && (-ONE..=self.mouth.beyond).contains(&along)
        })
    }

    /// Whether `p` lies on a side where it is no drawn edge: outside of the edge that the port opens.
    pub(super) fn has_outside(&self, p: Point) -> bool {
        self.has(p) && self.mouth.local(p).0 > ONE - self.mouth.length
    }

    /// Whether `p` lies on a side past the mouth, where no air is.
    pub(super) fn has_past_mouth(&self, p: Point) -> bool {
        self.has(p) && self.mouth.local(p).0 > ONE
    }
}

/// How far out from the middle of `mouth` the side `across` mm to its left begins: where the line that ends there leaves it.
fn begin(mouth: &Mouth, across: f64, lines: &[Line], overrun: f64) -> Option<f64> {
    let end = mouth.point(overrun, across);
    let is_end = |p: Option<Point>| p.is_some_and(|p| p.distance(end) < ONE);
    let outwards = lines.iter().find_map(|line| {
        let reversed = || is_end(line.path.start()).then(|| line.path.reversed());
        if is_end(line.path.end()) { Some(line.path.clone()) } else { reversed() }
    })?;
    let back = outwards.segments.iter().rev().map(|segment| (segment, mouth.local(segment.start())));
    let straight = back.take_while(|(segment, (_, aside))| {
        matches!(segment, Segment::Line(_)) && (aside - across).abs() < ONE
    });
    Some(straight.map(|(_, (along, _))| along).fold(overrun, f64::min))
}
