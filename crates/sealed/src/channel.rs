//! The two **sides** of a port's channel, as stretches of centre lines, which run straight back from the two ends at its mouth; and
//! **flanks**: the two bands beside a place, by the words of a message.

use crate::bands::{Band, Bands};
use crate::bottleneck::Bottleneck;
use crate::fault::flank_text;
use crate::mouth::Mouth;
use crate::sketch::{DrawnPort, Rules};
use geom::{Path, Point, Segment};

/// Points nearer than this are one, mm.
const ONE: f64 = 1e-6;

/// The sides of one port's channel.
pub(super) struct ChannelSides<'a> {
    pub mouth: &'a Mouth,
    /// Distance of the centre lines from the middle of the channel, mm.
    lateral: f64,
    /// How far out the left side begins, and the right one, from the middle of the mouth, mm.
    begin: [f64; 2],
}

impl<'a> ChannelSides<'a> {
    /// The sides of all channels whose two ends are among `bands`.
    pub(super) fn list(bands: &'a Bands, rules: &Rules) -> Vec<Self> {
        let sides = |mouth: &'a Mouth| {
            let lateral = mouth.half + rules.band / 2.0;
            let begin = [lateral, -lateral].map(|side| side_begin(mouth, side, &bands.list, rules.overrun));
            let [Some(left), Some(right)] = begin else { return None };
            Some(Self { mouth, lateral, begin: [left, right] })
        };
        bands.mouths.iter().filter_map(sides).collect()
    }

    /// Whether `neck` lies between the two sides: as wide as the hose needs, by its making.
    pub(super) fn are_around(&self, neck: &Bottleneck) -> bool {
        let [p, q] = neck.points.map(|p| self.mouth.local(p).1 > 0.0);
        p != q && neck.points.iter().all(|p| self.has_point(*p))
    }

    /// Whether `p` lies on a side.
    fn has_point(&self, p: Point) -> bool {
        let (distance, lateral) = self.mouth.local(p);
        let begin = self.begin[usize::from(lateral < 0.0)];
        (lateral.abs() - self.lateral).abs() < ONE && distance >= begin - ONE && distance <= self.mouth.beyond
    }

    /// Whether `path` ends at the mouth.
    pub(super) fn ends(&self, path: &Path) -> bool {
        let ends = [path.start(), path.end()].into_iter().flatten();
        ends.map(|end| self.mouth.local(end)).any(|(distance, lateral)| {
            (lateral.abs() - self.lateral).abs() < ONE && (-ONE..=self.mouth.beyond).contains(&distance)
        })
    }

    /// Whether `p` lies on a side where it is no drawn edge: outside of the edge that the port opens.
    pub(super) fn has_outside(&self, p: Point) -> bool {
        self.has_point(p) && self.mouth.local(p).0 > ONE - self.mouth.length
    }

    /// Whether `p` lies on a side past the mouth, where no air is.
    pub(super) fn has_past_mouth(&self, p: Point) -> bool {
        self.has_point(p) && self.mouth.local(p).0 > ONE
    }
}

/// How far out from the middle of `mouth` the side `across` mm to its left begins: where the band that ends there leaves it.
fn side_begin(mouth: &Mouth, across: f64, bands: &[Band], overrun: f64) -> Option<f64> {
    let end = mouth.point(overrun, across);
    let outwards = bands.iter().find_map(|band| {
        let [starts, ends] =
            [band.path.start(), band.path.end()].map(|p| p.is_some_and(|p| p.distance(end) < ONE));
        if ends { Some(band.path.clone()) } else { starts.then(|| band.path.reversed()) }
    })?;
    let inwards = outwards.segments.iter().rev().map(|segment| (segment, mouth.local(segment.start())));
    let straight = inwards.take_while(|(segment, (_, aside))| {
        matches!(segment, Segment::Line(_)) && (aside - across).abs() < ONE
    });
    Some(straight.map(|(_, (along, _))| along).fold(overrun, f64::min))
}

/// The bands and ports that a check tells of.
pub(super) struct CheckedSketch<'a> {
    pub bands: &'a Bands,
    pub ports: &'a [DrawnPort],
    pub channels: Vec<ChannelSides<'a>>,
}

/// The bands on both sides of a place.
pub(super) struct Flanks {
    /// The curves and ports, in that order.
    pub names: Vec<String>,
    /// "the bands of 'a' and 'b'", "the channel of port 'p' and the band of 'a'".
    pub text: String,
    /// The ports whose channels they are.
    pub ports: Vec<String>,
}

impl Flanks {
    /// The bands along `curves`, each at its point. Where a band is the side of a channel, it is the port's.
    pub(super) fn of_curves(curves: [usize; 2], points: [Point; 2], check: &CheckedSketch<'_>) -> Self {
        let CheckedSketch { bands, ports, channels } = check;
        let (mut curve_names, mut numbers): (Vec<String>, Vec<usize>) = (Vec::new(), Vec::new());
        for (curve, p) in curves.into_iter().zip(points) {
            // Bands that cross share the point: the channel's has its ends at the mouth.
            let band = &bands.list[curve];
            let side = channels.iter().find(|channel| channel.has_outside(p) && channel.ends(&band.path));
            match side {
                Some(channel) => numbers.push(channel.mouth.port),
                None => curve_names.extend(band.names.clone()),
            }
        }
        numbers.dedup();
        let ports: Vec<String> = numbers.iter().map(|port| ports[*port].name.clone()).collect();
        let text = flank_text(&curve_names, &ports, "band");
        curve_names.dedup();
        Self { names: [&curve_names[..], &ports[..]].concat(), text, ports }
    }
}
