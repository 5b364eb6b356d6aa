//! **Spikes**: parts of a closed curve that go out and come back along themselves. They enclose no air: the curve is read without them.

use crate::pieces::{NOTHING, Piece, with_start};
use geom::{Path, Point, Segment, SegmentIndex};

/// Largest cosine of the turn at a tip: both legs lead nearly the same way.
const TURN_BACK: f64 = -0.9;
/// Legs that go on within this cosine of each other, 14 degrees, are a sharp corner in small steps, not a spike.
const PARTING: f64 = 0.97;
/// Widest spike that is taken away at any corner, as a fraction of its length: wider ones may be sharp corners.
const HAIR: f64 = 1e-3;
/// Most spikes that are taken away from one curve: each costs a pass over it.
const MOST_SPIKES: usize = 1_000;

/// A spike of a curve.
#[derive(Clone, Debug)]
pub(super) struct Spike {
    /// The number of the curve.
    pub source: usize,
    /// The place farthest out.
    pub tip: Point,
    /// Length of a leg, mm.
    pub length: f64,
}

/// The legs of a spike: the segments before and after its tip, from the tip on.
struct Legs {
    /// Numbers of the last segment before the tip, and of the first one after it. Segments between them are the tip.
    first: [usize; 2],
    /// Whole segments of each leg.
    whole: [usize; 2],
    /// The next segment of each leg from where the spike ends, away from the tip.
    onward: [Segment; 2],
    /// Length of a leg, mm.
    length: f64,
}

/// The pieces without the spikes of their closed paths, and the spikes. A spike whose tip lies on another curve, or elsewhere on its own, is
/// a wall and stays.
pub(super) fn without_spikes(pieces: Vec<Piece>, join: f64) -> (Vec<Piece>, Vec<Spike>) {
    let (mut smooth, mut spikes): (Vec<Piece>, Vec<Vec<Spike>>) =
        pieces.iter().map(|piece| trimmed(piece, &[], join)).unzip();
    if spikes.iter().all(Vec::is_empty) {
        return (pieces, Vec::new());
    }
    let segments = SegmentIndex::new(smooth.iter().flat_map(|piece| piece.path.segments.clone()).collect());
    for (number, piece) in pieces.iter().enumerate() {
        let long_spikes = spikes[number].iter().filter(|spike| spike.length > 2.0 * join);
        let walls: Vec<Point> =
            long_spikes.map(|spike| spike.tip).filter(|tip| segments.has_within(*tip, join)).collect();
        if !walls.is_empty() {
            (smooth[number], spikes[number]) = trimmed(piece, &walls, join);
        }
    }
    (smooth, spikes.concat())
}

/// A piece without its spikes, and the spikes, except for those with a tip in `walls`. An open path whose ends do not meet
/// within `join` keeps them: a weld may be drawn there and back.
fn trimmed(piece: &Piece, walls: &[Point], join: f64) -> (Piece, Vec<Spike>) {
    let Piece { mut path, source } = piece.clone();
    let mut spikes = Vec::new();
    let gap = path.start().zip(path.end()).map_or(f64::INFINITY, |(start, end)| start.distance(end));
    if !path.closed && gap > join {
        return (Piece { path, source }, spikes);
    }
    let mut number = 0;
    while number < path.segments.len() && spikes.len() < MOST_SPIKES {
        let tip = path.segments[number].end();
        match legs_at(&path, number, join).filter(|_| !walls.contains(&tip)) {
            Some(legs) => {
                spikes.push(Spike { source, tip, length: legs.length });
                path.segments = without_legs(&path.segments, &legs);
                // The legs of another spike, of which this one was a part, may meet now.
                number = 0;
            }
            None => number += 1,
        }
    }
    (Piece { path, source }, spikes)
}

/// The legs of the spike whose tip is at the end of segment number `before`, if there is one.
fn legs_at(path: &Path, before: usize, join: f64) -> Option<Legs> {
    let count = path.segments.len();
    let mut tip_length = 0.0;
    // A tip may be blunt: some short segments from leg to leg.
    for tip in 0..count.saturating_sub(2) {
        let after = before + 1 + tip;
        if after >= count && !path.closed || tip_length > 2.0 * join {
            return None;
        }
        let segment = &path.segments[after % count];
        if path.segments[before].tangent(1.0).dot(segment.tangent(0.0)) < TURN_BACK
            && path.segments[before].end().distance(segment.start()) <= join
            && let Some(legs) = legs_from(path, [before, after % count], tip, join)
        {
            return Some(legs);
        }
        tip_length += segment.length();
    }
    None
}

/// The legs from the tip between two segments, of `tip` segments itself, as far as they run within `join` of each other.
///
/// The shorter next segment of both legs is compared with the longer one, and both are followed to its end. A spike ends where the
/// legs part or turn back. Legs that part slowly are a sharp corner.
fn legs_from(path: &Path, first: [usize; 2], tip: usize, join: f64) -> Option<Legs> {
    let count = path.segments.len();
    let mut legs = Legs {
        first,
        whole: [0; 2],
        onward: [leg_segment(path, first, 0, 0)?, leg_segment(path, first, 1, 0)?],
        length: 0.0,
    };
    let mut width = 0.0_f64;
    // The last segment is not compared with itself.
    while legs.whole[0] + legs.whole[1] + tip + 2 <= count {
        let shorter = usize::from(legs.onward[1].length() < legs.onward[0].length());
        let (short, long) = (legs.onward[shorter], legs.onward[1 - shorter]);
        let length = legs.length + short.length();
        let widths = (1..=4).map(|quarter| long.distance(short.point(f64::from(quarter) / 4.0)));
        let widest = widths.fold(width, f64::max);
        if widest > join.min(length / 4.0) {
            break;
        }
        (width, legs.length) = (widest, length);
        let foot = long.nearest_fraction(short.end());
        let mut turns_back = false;
        let ends = [(shorter, 1.0, short), (1 - shorter, foot, long)];
        for (side, fraction, segment) in ends {
            if (1.0 - fraction) * segment.length() > NOTHING {
                legs.onward[side] = if fraction > 0.0 { segment.part(fraction, 1.0) } else { segment };
                continue;
            }
            legs.whole[side] += 1;
            legs.onward[side] = leg_segment(path, first, side, legs.whole[side])?;
            turns_back |= segment.tangent(1.0).dot(legs.onward[side].tangent(0.0)) < TURN_BACK;
        }
        if turns_back {
            break;
        }
    }
    let [a, b] = legs.onward.map(|segment| segment.tangent(0.0));
    let is_spike = legs.length > NOTHING && (width <= HAIR * legs.length || a.dot(b) < PARTING);
    (is_spike && legs.whole[0] + legs.whole[1] + tip < count).then_some(legs)
}

/// The segment `number` of one of two legs, from the tip on; `first` are the numbers of those at the tip. `None` past the end of an open
/// path.
fn leg_segment(path: &Path, first: [usize; 2], side: usize, number: usize) -> Option<Segment> {
    let count = path.segments.len();
    if side == 0 {
        let place =
            if path.closed { (first[0] + count - number) % count } else { first[0].checked_sub(number)? };
        Some(path.segments[place].reversed())
    } else {
        let place = first[1] + number;
        (path.closed || place < count).then(|| path.segments[place % count])
    }
}

/// The segments of a curve without two legs; the first one stays the first if it is not among them.
fn without_legs(segments: &[Segment], legs: &Legs) -> Vec<Segment> {
    let count = segments.len();
    let [before, after] = legs.first;
    let [last, next] = [(before + count - legs.whole[0]) % count, (after + legs.whole[1]) % count];
    let end = legs.onward[0].start();
    // From the segment after the spike round to the one before it.
    let length = (last + count - next) % count + 1;
    let mut rest: Vec<Segment> = (next..next + length).map(|number| segments[number % count]).collect();
    if length > 1 {
        rest[length - 1] = legs.onward[0].reversed();
        rest[0] = with_start(&legs.onward[1], end);
    }
    let to_first = (count - next) % count;
    if to_first < length {
        rest.rotate_left(to_first);
    }
    rest
}

#[cfg(test)]
mod tests {
    use geom::{Arc, Line, Path, Point, Segment, Vec2};
    use proptest::prelude::*;

    use crate::{DrawnCurve, DrawnPort, PortPlace, Rules, Sealing, Sketch, sealed_shape};

    const JOIN: f64 = Rules::SAMPLE.join;

    /// A rectangle of 100 x 60 mm with one rounded corner, one cut off and a round bay; from the middle of the left side on, where the
    /// port is.
    fn outline() -> Vec<Segment> {
        let p = Point::new;
        let line = |a: (f64, f64), b: (f64, f64)| Segment::from(Line::new(p(a.0, a.1), p(b.0, b.1)));
        let arc = |a: (f64, f64), b: (f64, f64), bulge| {
            Segment::from(Arc::from_bulge(p(a.0, a.1), p(b.0, b.1), bulge).unwrap())
        };
        let quarter = libm::tan(std::f64::consts::PI / 8.0);
        vec![
            line((0.0, 30.0), (0.0, 0.0)),
            line((0.0, 0.0), (100.0, 0.0)),
            line((100.0, 0.0), (100.0, 40.0)),
            arc((100.0, 40.0), (80.0, 60.0), quarter),
            arc((80.0, 60.0), (50.0, 60.0), -0.3),
            line((50.0, 60.0), (15.0, 60.0)),
            line((15.0, 60.0), (0.0, 45.0)),
            line((0.0, 45.0), (0.0, 30.0)),
        ]
    }

    /// A way out and back from the end of `before`, between the directions of the curve there.
    #[derive(Clone, Debug)]
    struct Way {
        /// The segment that it lies on, and where on it.
        segment: usize,
        fraction: f64,
        inwards: bool,
        /// From the middle between the sides, radians.
        lean: f64,
        length: f64,
        /// Distance of the legs, as a fraction of `JOIN`.
        width: f64,
        blunt: bool,
        bulge: f64,
        branch: bool,
    }

    fn ways() -> impl Strategy<Value = Vec<Way>> {
        let place = (1_usize..7, prop_oneof![Just(1.0), 0.3..0.7], any::<bool>(), -0.3..0.3);
        let width = prop_oneof![Just(0.0), Just(1e-7), 0.0..0.9];
        let form = (0.4..12.0, width, any::<bool>(), prop_oneof![Just(0.0), -0.2..0.2], any::<bool>());
        let way = (place, form).prop_map(
            |((segment, fraction, inwards, lean), (length, width, blunt, bulge, branch))| Way {
                segment,
                fraction,
                inwards,
                lean,
                length,
                width,
                blunt,
                bulge,
                branch,
            },
        );
        proptest::collection::vec(way, 1..3)
    }

    fn leg(from: Point, to: Point, bulge: f64) -> Segment {
        Arc::from_bulge(from, to, bulge).map_or_else(|| Line::new(from, to).into(), Segment::from)
    }

    /// The segments of a spike from `base`, where the curve leads from `before` to `after` with the air on its left.
    fn spike(way: &Way, base: Point, before: Vec2, after: Vec2) -> Vec<Segment> {
        let outwards = -(before + after).perp().normalized();
        let way_out = if way.inwards { -outwards } else { outwards };
        let way_out = (way_out + way_out.perp() * way.lean).normalized();
        let offset = way_out.perp() * (way.width * JOIN.min(way.length / 5.0));
        let tip = base + way_out * way.length;
        let mut legs = vec![leg(base, tip, way.bulge)];
        if way.branch {
            let middle = legs[0].point(0.5);
            let twig = middle - way_out.perp() * (0.1 * way.length);
            let halves = [legs[0].part(0.0, 0.5), legs[0].part(0.5, 1.0)];
            legs = vec![halves[0], Line::new(middle, twig).into(), Line::new(twig, middle).into(), halves[1]];
        }
        let back = if way.blunt { tip + offset } else { tip };
        if way.blunt && way.width > 1e-3 {
            legs.push(Line::new(tip, back).into());
        }
        let back = if way.width > 1e-3 { back } else { tip };
        legs.push(leg(back, base, -way.bulge));
        legs
    }

    fn with_spikes(ways: &[Way]) -> Vec<Segment> {
        let mut segments = Vec::new();
        let sides = outline();
        for (number, segment) in sides.iter().enumerate() {
            let Some(way) = ways.iter().find(|way| way.segment == number) else {
                segments.push(*segment);
                continue;
            };
            let next = sides[(number + 1) % sides.len()];
            let t = way.fraction;
            segments.push(segment.part(0.0, t));
            let leaving = if t < 1.0 { segment.tangent(t) } else { next.tangent(0.0) };
            segments.extend(spike(way, segment.point(t), segment.tangent(t), leaving));
            if t < 1.0 {
                segments.push(segment.part(t, 1.0));
            }
        }
        segments
    }

    fn sealed(path: Path) -> Sealing {
        let air = vec![DrawnCurve { name: "edge".to_owned(), path }];
        let port = DrawnPort { name: "port".to_owned(), place: PortPlace::At(Point::new(0.0, 30.0)) };
        sealed_shape(&Sketch { air, ports: vec![port], ..Sketch::default() }, &Rules::SAMPLE)
            .unwrap_or_else(|faults| panic!("{faults:?}"))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]

        /// Spikes in the middle of a side, at a corner, at the start and on each other; bent, blunt, wedged; either way round.
        #[test]
        fn an_outline_is_sealed_without_its_spikes(ways in ways(), start in 0_usize..20, reversed in any::<bool>()) {
            let plain = sealed(Path::closed(outline()));
            let mut segments = with_spikes(&ways);
            let count = segments.len();
            segments.rotate_left(start % count);
            let path = Path::closed(segments);
            let sealing = sealed(if reversed { path.reversed() } else { path });
            let [seam, expected] = [&sealing, &plain].map(|sealing| &sealing.shape.seams[0].center_line);
            prop_assert_eq!(sealing.shape.seams.len(), 1);
            prop_assert!((seam.length() - expected.length()).abs() < 0.5, "{} {}", seam.length(), expected.length());
            for segment in &seam.segments {
                let distance = (0..=4).map(|k| expected.distance(segment.point(f64::from(k) / 4.0))).fold(0.0, f64::max);
                prop_assert!(distance <= JOIN + 1e-6, "{distance} {segment:?}");
            }
            let notes = sealing.repairs.iter().filter(|repair| repair.what.contains("spike"));
            prop_assert!(notes.count() >= ways.iter().map(|way| way.segment).collect::<std::collections::BTreeSet<_>>().len());
        }
    }

    /// A line from side to side there and back is a wall, and a sharp corner in small steps a corner.
    #[test]
    fn walls_and_corners_stay() {
        let p = Point::new;
        let wall = [
            p(0.0, 30.0),
            p(0.0, 0.0),
            p(50.0, 0.0),
            p(50.0, 60.0),
            p(50.0, 0.0),
            p(100.0, 0.0),
            p(100.0, 60.0),
            p(0.0, 60.0),
        ];
        let air = vec![DrawnCurve { name: "edge".to_owned(), path: Path::polygon(&wall) }];
        let port = |x| DrawnPort { name: "port".to_owned(), place: PortPlace::At(p(x, 30.0)) };
        let sketch = Sketch { air, ports: vec![port(0.0), port(100.0)], ..Sketch::default() };
        let sealing = sealed_shape(&sketch, &Rules::SAMPLE).unwrap();
        assert_eq!(sealing.shape.topology().chambers.len(), 2);
        // A corner of 10 degrees.
        let side = |sign: f64| {
            (1..=1500).map(move |step| f64::from(step) * 0.05).map(move |x| p(x, sign * 0.0875 * x))
        };
        let mut corners: Vec<Point> = side(1.0).rev().collect();
        corners.push(p(0.0, 0.0));
        corners.extend(side(-1.0));
        let piece = super::Piece { path: Path::polygon(&corners), source: 0 };
        let (pieces, spikes) = super::without_spikes(vec![piece.clone()], JOIN);
        assert!(spikes.is_empty(), "{spikes:?}");
        assert_eq!(pieces[0].path.segments, piece.path.segments);
    }
}
