//! **Mouths**: where a port opens an edge. A channel as wide as the hose leads straight outwards from the edge; the seam along its sides
//! ends past the cut.

use crate::offset_graph::ONE;
use crate::sketch::PortPlace;
use geom::{Line, Path, Point, Segment, Vec2, intersections};

/// Points nearer to the sides of a channel lie on them, mm: twice by how much the joints of offsets are moved.
pub(super) const ON_SIDE: f64 = 2.0 * ONE;

/// The mouth of a port.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Mouth {
    /// The number of the port.
    pub port: usize,
    /// The middle of the mouth: on the cut.
    pub at: Point,
    /// Outwards, of length 1.
    pub outwards: Vec2,
    /// Half the width between the air's edges, mm.
    pub half: f64,
    /// Distance of the mouth from the drawn edge, mm.
    pub length: f64,
    /// Distance of the closed edge past the mouth, mm.
    pub beyond: f64,
    /// Largest distance of the channel's start behind the mouth, mm.
    pub depth: f64,
}

impl Mouth {
    /// `p` from the middle of the mouth: how far along the way out, and how far to its left.
    pub(crate) fn local(&self, p: Point) -> (f64, f64) {
        let offset = p - self.at;
        (offset.dot(self.outwards), offset.dot(self.outwards.perp()))
    }

    /// Whether the corner `p` of a centre line `half` mm outside the air is one where the channel itself begins or ends.
    pub(crate) fn has_corner(&self, p: Point, half: f64) -> bool {
        let (ahead, lateral) = self.local(p);
        (lateral.abs() - self.half - half).abs() < ON_SIDE
            && (-self.depth..=self.beyond + half + ON_SIDE).contains(&ahead)
    }

    /// Whether the point `p` of the air's edge lies on the channel outside the drawn edge: on one of its sides, or its end.
    pub(crate) fn has_edge(&self, p: Point) -> bool {
        let (ahead, lateral) = self.local(p);
        let is_within = ahead > ON_SIDE - self.length && ahead < self.beyond + ON_SIDE;
        let is_on = (lateral.abs() - self.half).abs() < ON_SIDE || (ahead - self.beyond).abs() < ON_SIDE;
        is_within && is_on && lateral.abs() < self.half + ON_SIDE
    }

    /// Whether `p` lies beside the channel, at most `margin` mm from it.
    pub(crate) fn is_beside(&self, p: Point, margin: f64) -> bool {
        let (ahead, lateral) = self.local(p);
        (-self.depth..=self.beyond + 1.0).contains(&ahead) && lateral.abs() <= self.half + margin
    }

    /// Whether `p` lies before the end of the channel, at most `distance` mm from it.
    pub(crate) fn is_in_front(&self, p: Point, distance: f64) -> bool {
        let (ahead, lateral) = self.local(p);
        (self.beyond..=self.beyond + distance).contains(&ahead) && lateral.abs() <= self.half
    }

    /// The point `along` the way out and `across` it to the left, from the middle of the mouth.
    pub(crate) fn point(&self, along: f64, across: f64) -> Point {
        self.at + self.outwards * along + self.outwards.perp() * across
    }

    /// The distance past the mouth from which `path` runs along both sides of the channel, `lateral` mm from its middle: 0 where it does at
    /// the mouth. More where an edge is not square to the channel, or bends towards it. `None` if it does not run there.
    pub(crate) fn sides_begin(&self, path: &Path, lateral: f64) -> Option<f64> {
        let begin = self.side_begins(path, lateral)?.max(self.side_begins(path, -lateral)?);
        Some(if begin < 1e-6 { 0.0 } else { begin })
    }

    /// The distance past the mouth from which `path` runs along the side `lateral` mm to the left, at least 0.
    fn side_begins(&self, path: &Path, lateral: f64) -> Option<f64> {
        let lines = path.segments.iter().filter(|segment| matches!(segment, Segment::Line(_)));
        let parts_ahead = lines.filter_map(|line| self.part_ahead([line.start(), line.end()]));
        let is_on_side = |(_, aside): &(f64, f64)| (aside - lateral).abs() < ON_SIDE;
        let begins = parts_ahead.filter(|ends| ends.iter().all(is_on_side)).map(|[(begin, _), _]| begin);
        begins.reduce(f64::min)
    }

    /// The ends, from the middle of the mouth, of the part of a line that lies in front of the mouth, the nearer one first.
    fn part_ahead(&self, ends: [Point; 2]) -> Option<[(f64, f64); 2]> {
        let [a, b] = ends.map(|p| self.local(p));
        let [nearer, farther] = if a.0 < b.0 { [a, b] } else { [b, a] };
        let part = (-nearer.0 / (farther.0 - nearer.0)).clamp(0.0, 1.0);
        let begin = if nearer.0 < 0.0 { (0.0, nearer.1 + (farther.1 - nearer.1) * part) } else { nearer };
        (farther.0 > 0.0).then_some([begin, farther])
    }

    /// The closed `path` without the part farther out than `along` mm past the mouth, on sides `across` mm from its middle: an
    /// open path with its ends there. `None` if it does not pass there.
    pub(crate) fn open(&self, path: &Path, along: f64, across: f64) -> Option<Path> {
        let sides = [across, -across].map(|across| self.point(along, across));
        let [a, b] = [path.nearest(sides[0])?, path.nearest(sides[1])?];
        if a.distance.max(b.distance) > ON_SIDE {
            return None;
        }
        // Air on the left: outwards on the right side, seen along the way out, and back on the left.
        let (from, to) = if path.area() > 0.0 { (a.s, b.s) } else { (b.s, a.s) };
        Some(path.part(from, if to > from { to } else { to + path.length() }))
    }
}

/// The closed line over the mouth between two free ends of an edge, from one to the other, and the mouth itself. The ends lead in
/// the directions `leading`.
pub(crate) fn cap(port: usize, ends: [Point; 2], leading: [Vec2; 2], overrun: f64) -> (Path, Mouth) {
    let chord = (ends[1] - ends[0]).normalized();
    let mut outwards = chord.perp();
    if outwards.dot(leading[0] + leading[1]) < 0.0 {
        outwards = -outwards;
    }
    let middle = ends[0].midpoint(ends[1]);
    let half = ends[0].distance(ends[1]) / 2.0;
    let mouth = Mouth { port, at: middle, outwards, half, length: 0.0, beyond: overrun, depth: 1.0 };
    let corners = ends.map(|end| end + outwards * overrun);
    (Path::polyline(&[ends[0], corners[0], corners[1], ends[1]]), mouth)
}

/// The reason why a port has no channel.
pub(super) enum NoChannel {
    /// The edge is this far away, mm.
    Far(f64),
    /// The edge is at most this wide there, mm.
    Narrow { width: f64, place: Point },
    /// Across the channel the edge falls back by this much, mm, and may by at most `largest`.
    Deep { depth: f64, largest: f64, place: Point },
    /// The channel meets the edge again, this far in front of the port, mm.
    Blocked { distance: f64, place: Point },
    /// The channel of another port is too near.
    Beside,
    /// The line of the port runs along the edge.
    Along,
    /// The line of the port crosses outer edges at these places, more than one.
    Twice(Vec<Point>),
}

/// Least sine of the angle at which the line of a port crosses an edge: 15 degrees.
const STEEP: f64 = 0.26;

/// Whether the line of a port marks one place at most on `edges`, or is a point.
pub(super) fn unambiguous(place: &PortPlace, edges: &[Path]) -> Result<(), NoChannel> {
    let PortPlace::Across([a, b]) = place else { return Ok(()) };
    let line = Segment::Line(Line::new(*a, *b));
    let way = (*b - *a).normalized();
    let (mut crossings, mut is_flat): (Vec<Point>, bool) = (Vec::new(), false);
    for segment in edges.iter().flat_map(|edge| &edge.segments) {
        for p in intersections(segment, &line) {
            is_flat |= segment.tangent(segment.nearest_fraction(p)).cross(way).abs() < STEEP;
            if crossings.iter().all(|crossing| crossing.distance(p) > 1e-3) {
                crossings.push(p);
            }
        }
    }
    match crossings.len() {
        0 => Ok(()),
        _ if is_flat => Err(NoChannel::Along),
        1 => Ok(()),
        _ => Err(NoChannel::Twice(crossings)),
    }
}

/// The size of a channel, mm.
#[derive(Clone, Copy)]
pub(super) struct ChannelSize {
    /// Width of the channel.
    pub width: f64,
    /// Length past the edge to the mouth.
    pub length: f64,
    /// Length past the mouth.
    pub overrun: f64,
}

/// A channel through the closed `path` (air on its left) for the port number `port` at `place`: the path with it, and the mouth. `original`
/// is the path before other ports opened it: the port lies on it.
///
/// From the foot of the port the path is followed to both sides, up to where it lies half a width aside: there the sides of the channel
/// begin. The remainder of the path is closed by three lines, which must meet no other part of the edge.
pub(super) fn channel(
    path: &Path,
    original: &Path,
    port: usize,
    place: &PortPlace,
    size: ChannelSize,
) -> Result<(Path, Mouth), NoChannel> {
    let ChannelSize { width, length, overrun } = size;
    let port_foot = foot(original, place, width)?;
    let Foot { place: middle, outwards } = port_foot;
    // The channel of another port has taken the edge there.
    let on_path = path.nearest(middle).filter(|nearest| nearest.distance < 1e-6);
    let s = on_path.ok_or(NoChannel::Beside)?.s;
    let (half, total) = (width / 2.0, path.length());
    // Travelling with the air on the left, the way out is on the right: the edge goes on to the left of it.
    let ahead = first_across(path, s, middle, outwards.perp(), half);
    let back = first_across(&path.reversed(), total - s, middle, -outwards.perp(), half);
    let narrow = || NoChannel::Narrow { width: port_foot.extent(path, s), place: middle };
    let (from, to) = ahead.zip(back).map(|(ahead, back)| (ahead, total - back)).ok_or_else(narrow)?;
    let rest = path.part(from, if to > from { to } else { to + total });
    let (Some(start), Some(end)) = (rest.start(), rest.end()) else {
        return Err(NoChannel::Narrow { width: port_foot.extent(path, s), place: middle });
    };
    // Sides that begin deep inside have run past a narrower neck, or along a bend.
    let depth = [start, end].map(|p| port_foot.distance(p).abs()).into_iter().fold(0.0, f64::max);
    if depth > width {
        return Err(NoChannel::Deep { depth, largest: width, place: middle });
    }
    let corners =
        [end, port_foot.point(-half, length + overrun), port_foot.point(half, length + overrun), start];
    let lines = Path::polyline(&corners).segments;
    let meetings =
        lines.iter().flat_map(|line| original.segments.iter().flat_map(|edge| intersections(edge, line)));
    let meetings = meetings.filter(|p| p.distance(start).min(p.distance(end)) > 1e-6);
    let meetings = meetings.map(|p| (port_foot.distance(p), p));
    if let Some((distance, place)) = meetings.min_by(|a, b| a.0.total_cmp(&b.0)) {
        return Err(NoChannel::Blocked { distance, place });
    }
    let opened = Path::closed(rest.segments.iter().copied().chain(lines).collect());
    let mouth = Mouth {
        port,
        at: port_foot.point(0.0, length),
        outwards,
        half,
        length,
        beyond: overrun,
        depth: length + width,
    };
    Ok((opened, mouth))
}

/// The foot of a port on an edge.
#[derive(Clone, Copy)]
struct Foot {
    place: Point,
    /// The way out, of length 1.
    outwards: Vec2,
}

impl Foot {
    /// The point `lateral` mm to the left of the foot and `distance` mm out.
    fn point(&self, lateral: f64, distance: f64) -> Point {
        self.place + self.outwards.perp() * lateral + self.outwards * distance
    }

    /// How far out `p` lies from the foot, mm.
    fn distance(&self, p: Point) -> f64 {
        (p - self.place).dot(self.outwards)
    }

    /// The largest width that the path has to both sides of `s`, roughly, mm.
    fn extent(&self, path: &Path, s: f64) -> f64 {
        2.0 * self.side_extent(path, s, 1.0).min(self.side_extent(path, s, -1.0))
    }

    /// How far the path goes to one side within half of its length from `s` on, in the direction `sign`.
    fn side_extent(&self, path: &Path, s: f64, sign: f64) -> f64 {
        let total = path.length();
        let stations = (0..100).map(|i| s + sign * total * f64::from(i) / 200.0);
        let points = stations.map(|s| path.point_at(s.rem_euclid(total)).unwrap_or(self.place));
        points.map(|p| sign * (p - self.place).dot(self.outwards.perp())).fold(0.0, f64::max)
    }
}

/// The place of the port on the path, and the way out.
fn foot(path: &Path, place: &PortPlace, width: f64) -> Result<Foot, NoChannel> {
    let nearest = path.nearest(place.middle()).ok_or(NoChannel::Far(f64::INFINITY))?;
    if let PortPlace::Across([a, b]) = place {
        let line = Segment::Line(Line::new(*a, *b));
        for segment in &path.segments {
            if let Some(p) = intersections(segment, &line).first() {
                let t = segment.nearest_fraction(*p);
                let way = (*b - *a).normalized();
                let leads_outwards = segment.tangent(t).cross(way) < 0.0;
                return Ok(Foot { place: *p, outwards: if leads_outwards { way } else { -way } });
            }
        }
    }
    if nearest.distance > width.max(5.0) {
        return Err(NoChannel::Far(nearest.distance));
    }
    let leaving = path.tangent_at(nearest.s).unwrap_or(Vec2::new(1.0, 0.0));
    // At a corner the way out lies between both sides.
    let last_stretch = path.part(nearest.s - 1e-6, nearest.s);
    let arriving = last_stretch.tangent_at(0.0).unwrap_or(leaving);
    let outwards = -(leaving + arriving).perp().normalized();
    Ok(Foot { place: nearest.point, outwards })
}

/// The arc length at which the path, from `s` on, first lies `half` to the side `across` of `middle`.
fn first_across(path: &Path, s: f64, middle: Point, normal: Vec2, half: f64) -> Option<f64> {
    let total = path.length();
    let way = normal.perp();
    let reach = 1e3 + total;
    let rail =
        Segment::Line(Line::new(middle + normal * half - way * reach, middle + normal * half + way * reach));
    let path_onward = path.starting_at(s.rem_euclid(total));
    let mut length_before = 0.0;
    for segment in &path_onward.segments {
        let length = segment.length();
        let end = (segment.end() - middle).dot(normal);
        let mut fractions: Vec<f64> =
            intersections(segment, &rail).iter().map(|p| segment.nearest_fraction(*p)).collect();
        if (end - half).abs() < 1e-9 {
            fractions.push(1.0);
        }
        fractions.sort_by(f64::total_cmp);
        if let Some(t) = fractions.first() {
            return Some((s + length_before + t * length).rem_euclid(total));
        }
        length_before += length;
        if length_before > total / 2.0 {
            return None;
        }
    }
    None
}
