//! **Narrow places**: bottlenecks between which the curves stay narrow all along are one place, told where it is narrowest.

use crate::bottleneck::{Bottleneck, GapCurve};
use crate::graph::DisjointSets;
use crate::segments::Segments;
use geom::order::sort_by;
use geom::{Line, Point, Segment, Vec2, intersections};

/// How much longer than the limit the way across may be, along a normal of one curve, where the place is narrower than the limit:
/// normals of the other curve are shorter.
const SLANT: f64 = 1.1;
/// Looks across a narrow stretch, for each of its limits in length: a pouch shorter than an eighth of the limit does not part two places.
const LOOKS: f64 = 8.0;

/// Bottlenecks whose middles are nearer are at one place, mm.
const AT_ONE_PLACE: f64 = 1e-6;

/// Where a bottleneck touches a curve.
struct NarrowContact {
    curve: usize,
    /// Whether the bottleneck lies on the curve's left.
    is_left: bool,
    /// Length of the curve before it, mm.
    station: f64,
    bottleneck: usize,
}

/// The narrowest bottleneck of each narrow place of `curves`. `bottlenecks` come with the narrowest first; a place is a stretch that is
/// narrower than `limit` mm.
///
/// Two bottlenecks that follow each other on one side of a curve are in one place if the way across is short all along between them.
pub(crate) fn narrow_places(
    bottlenecks: Vec<Bottleneck>,
    curves: &[GapCurve<'_>],
    limit: f64,
) -> Vec<Bottleneck> {
    if bottlenecks.len() < 2 {
        return bottlenecks;
    }
    let segments = Segments::new(curves.iter().map(|curve| curve.path));
    let mut contacts: Vec<NarrowContact> = bottlenecks
        .iter()
        .enumerate()
        .flat_map(|(number, bottleneck)| contacts(number, bottleneck, &segments))
        .collect();
    sort_by(&mut contacts, |a, b| {
        (a.curve, a.is_left).cmp(&(b.curve, b.is_left)).then(a.station.total_cmp(&b.station))
    });
    let mut places = DisjointSets::new(bottlenecks.len());
    for side in contacts.chunk_by(|a, b| (a.curve, a.is_left) == (b.curve, b.is_left)) {
        let NarrowContact { curve, .. } = side[0];
        let path = curves[curve].path;
        let round = side.last().zip(side.first()).filter(|_| path.closed && side.len() > 1);
        let closing = round.map(|(last, first)| (last, first, path.length()));
        for (a, b, more) in side.windows(2).map(|pair| (&pair[0], &pair[1], 0.0)).chain(closing) {
            let is_apart = !places.are_united(a.bottleneck, b.bottleneck);
            let [place, next_place] = [a, b].map(|contact| bottlenecks[contact.bottleneck].middle());
            if is_apart
                && (place.distance(next_place) <= AT_ONE_PLACE
                    || is_narrow(&segments, a, b.station + more, limit * SLANT))
            {
                places.unite(a.bottleneck, b.bottleneck);
            }
        }
    }
    let narrowest = places.least_members().into_iter().enumerate().filter(|(number, least)| number == least);
    narrowest.map(|(number, _)| bottlenecks[number]).collect()
}

/// The two contacts of a bottleneck.
fn contacts(number: usize, bottleneck: &Bottleneck, segments: &Segments) -> [NarrowContact; 2] {
    let [p, q] = bottleneck.points;
    [(0, q - p), (1, p - q)].map(|(which, across)| {
        let (curve, station) = (bottleneck.curves[which], bottleneck.stations[which]);
        let (_, along) = segments.place(curve, station);
        NarrowContact { curve, is_left: along.cross(across) > 0.0, station, bottleneck: number }
    })
}

/// Whether the way across is at most `longest` mm long all along a curve, from a contact to the station `end`.
fn is_narrow(segments: &Segments, contact: &NarrowContact, end: f64, longest: f64) -> bool {
    let length = end - contact.station;
    let looks = (length * LOOKS / longest).ceil().clamp(1.0, 1e6);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count up to a million")]
    let looks = looks as u32;
    (0..looks).all(|look| {
        let station = contact.station + length * (f64::from(look) + 0.5) / f64::from(looks);
        let (p, along) = segments.place(contact.curve, station);
        let across = if contact.is_left { along.perp() } else { -along.perp() };
        let way = Segment::Line(Line::new(p + across * 1e-6, p + across * longest));
        segments.overlapping(way.bounds()).any(|other| !intersections(&other.segment, &way).is_empty())
    })
}

impl Segments {
    /// The point and the direction at a station of path number `path`; past its end it goes on from its start.
    fn place(&self, path: usize, station: f64) -> (Point, Vec2) {
        let begin = self.list.partition_point(|part| part.path < path);
        let end = self.list.partition_point(|part| part.path <= path);
        let parts = &self.list[begin..end];
        let Some(last) = parts.last() else { return (Point::ORIGIN, Vec2::new(1.0, 0.0)) };
        let length = last.before + last.segment.length();
        let station = if station > length { station - length } else { station };
        let number = parts.partition_point(|part| part.before <= station).saturating_sub(1);
        let part = &parts[number];
        let fraction = ((station - part.before) / part.segment.length().max(1e-12)).clamp(0.0, 1.0);
        (part.segment.point(fraction), part.segment.tangent(fraction))
    }
}
