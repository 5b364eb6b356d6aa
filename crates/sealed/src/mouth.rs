//! **Mouths**: where a port opens an edge. A channel as wide as the hose leads straight outwards from the edge; the seam along its sides
//! ends past the cut.

use crate::offset_graph::ONE;
use crate::sketch::PortPlace;
use geom::{Line, Path, Point, Segment, Vec2, intersections};

/// Points nearer to the sides of a channel lie on them, mm: twice by how much the joints of offsets are moved.
pub(super) const ON_SIDE: f64 = 2.0 * ONE;

/// The mouth of a port.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Mouth {
    /// The number of the port.
    pub port: usize,
    /// The middle of the mouth: on the cut.
    pub at: Point,
    /// Outwards, of length 1.
    pub out: Vec2,
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
    pub(super) fn local(&self, p: Point) -> (f64, f64) {
        let from = p - self.at;
        (from.dot(self.out), from.dot(self.out.perp()))
    }

    /// Whether the corner `p` of a centre line `half` mm outside the air is one where the channel itself begins or ends.
    pub(super) fn has_corner(&self, p: Point, half: f64) -> bool {
        let (along, across) = self.local(p);
        (across.abs() - self.half - half).abs() < ON_SIDE
            && (-self.depth..=self.beyond + half + ON_SIDE).contains(&along)
    }

    /// Whether the point `p` of the air's edge lies on the channel outside the drawn edge: on one of its sides, or its end.
    pub(super) fn has_edge(&self, p: Point) -> bool {
        let (along, across) = self.local(p);
        let is_within = along > ON_SIDE - self.length && along < self.beyond + ON_SIDE;
        let is_on = (across.abs() - self.half).abs() < ON_SIDE || (along - self.beyond).abs() < ON_SIDE;
        is_within && is_on && across.abs() < self.half + ON_SIDE
    }

    /// Whether `p` lies beside the channel, at most `aside` mm from it.
    pub(super) fn is_beside(&self, p: Point, aside: f64) -> bool {
        let (along, across) = self.local(p);
        (-self.depth..=self.beyond + 1.0).contains(&along) && across.abs() <= self.half + aside
    }

    /// Whether `p` lies before the end of the channel, at most `far` mm from it.
    pub(super) fn is_in_front(&self, p: Point, far: f64) -> bool {
        let (along, across) = self.local(p);
        (self.beyond..=self.beyond + far).contains(&along) && across.abs() <= self.half
    }

    /// The point `along` the way out and `across` it to the left, from the middle of the mouth.
    pub(super) fn point(&self, along: f64, across: f64) -> Point {
        self.at + self.out * along + self.out.perp() * across
    }

    /// The distance past the mouth from which `path` runs along both sides of the channel, `across` mm from its middle: 0 where it does at
    /// the mouth. More where an edge is not square to the channel, or bends towards it. `None` if it does not run there.
    pub(super) fn sides_begin(&self, path: &Path, across: f64) -> Option<f64> {
        let side = |sign: f64| {
            let lines = path.segments.iter().filter(|segment| matches!(segment, Segment::Line(_)));
            let ahead = lines.filter_map(|line| self.part_ahead([line.start(), line.end()]));
            let is_on = |(_, aside): &(f64, f64)| (sign * aside - across).abs() < ON_SIDE;
            let begins = ahead.filter(|ends| ends.iter().all(is_on)).map(|[(along, _), _]| along);
            begins.reduce(f64::min)
        };
        let begin = side(1.0)?.max(side(-1.0)?);
        Some(if begin < 1e-6 { 0.0 } else { begin })
    }

    /// The ends, from the middle of the mouth, of the part of a line that lies in front of the mouth, the nearer one first.
    fn part_ahead(&self, ends: [Point; 2]) -> Option<[(f64, f64); 2]> {
        let [a, b] = ends.map(|p| self.local(p));
        let [near, far] = if a.0 < b.0 { [a, b] } else { [b, a] };
        let part = (-near.0 / (far.0 - near.0)).clamp(0.0, 1.0);
        let begin = if near.0 < 0.0 { (0.0, near.1 + (far.1 - near.1) * part) } else { near };
        (far.0 > 0.0).then_some([begin, far])
    }

    /// The closed `path` without the part farther out than `along` mm past the mouth, on sides `across` mm from its middle: an
    /// open path
    /// with its ends there. `None` if it does not pass there.
    pub(super) fn open(&self, path: &Path, along: f64, across: f64) -> Option<Path> {
        let sides = [across, -across].map(|across| self.point(along, across));
        let [a, b] = [path.nearest(sides[0])?, path.nearest(sides[1])?];
        if a.distance.max(b.distance) > ON_SIDE {
            return None;
        }
        let length = path.length();
        let onward = |from: f64, to: f64| if to > from { to } else { to + length };
        // Air on the left: outwards on the right side, seen along the way out, and back on the left.
        let (from, to) = if path.area() > 0.0 { (a.s, b.s) } else { (b.s, a.s) };
        Some(path.part(from, onward(from, to)))
    }
}

/// The closed line over the mouth between two free ends of an edge, from one to the other, and the mouth itself. The ends lead to
/// `towards`.
pub(super) fn cap(port: usize, ends: [Point; 2], leading: [Vec2; 2], beyond: f64) -> (Path, Mouth) {
    let across = (ends[1] - ends[0]).normalized();
    let mut out = across.perp();
    if out.dot(leading[0] + leading[1]) < 0.0 {
        out = -out;
    }
    let at = ends[0].midpoint(ends[1]);
    let half = ends[0].distance(ends[1]) / 2.0;
    let mouth = Mouth { port, at, out, half, length: 0.0, beyond, depth: 1.0 };
    let far = ends.map(|end| end + out * beyond);
    (Path::through(&[ends[0], far[0], far[1], ends[1]]), mouth)
}

/// The reason why a port has no channel.
pub(super) enum NoChannel {
    /// The edge is this far away, mm.
    Far(f64),
    /// The edge is at most this wide there, mm.
    Narrow { width: f64, at: Point },
    /// Across the channel the edge falls back by this much, mm, and may by at most `most`.
    Deep { depth: f64, most: f64, at: Point },
    /// The channel meets the edge again, this far in front of the port, mm.
    Blocked { far: f64, at: Point },
    /// The channel of another port is too near.
    Beside,
    /// Its line runs along the edge.
    Along,
    /// Its line crosses outer edges at these places, more than one.
    Twice(Vec<Point>),
}

/// Least sine of the angle at which the line of a port crosses an edge: 15 degrees.
const STEEP: f64 = 0.26;

/// Whether the line of a port marks one place at most on `edges`, or is a point.
pub(super) fn unambiguous(place: &PortPlace, edges: &[Path]) -> Result<(), NoChannel> {
    let PortPlace::Across([a, b]) = place else { return Ok(()) };
    let line = Segment::Line(Line::new(*a, *b));
    let way = (*b - *a).normalized();
    let (mut met, mut flat): (Vec<Point>, bool) = (Vec::new(), false);
    for segment in edges.iter().flat_map(|edge| &edge.segments) {
        for p in intersections(segment, &line) {
            flat |= segment.tangent(segment.nearest_fraction(p)).cross(way).abs() < STEEP;
            if met.iter().all(|known| known.distance(p) > 1e-3) {
                met.push(p);
            }
        }
    }
    match met.len() {
        0 => Ok(()),
        _ if flat => Err(NoChannel::Along),
        1 => Ok(()),
        _ => Err(NoChannel::Twice(met)),
    }
}

/// A channel of `width` through the closed `path` (air on its left) at `place`, which runs `length` mm past the edge to its mouth and
/// `beyond` on: the path with it, and the mouth. `drawn` is the path before other ports opened it: the port lies on it.
pub(super) fn channel(
    (path, drawn): (&Path, &Path),
    port: usize,
    place: &PortPlace,
    width: f64,
    length: f64,
    beyond: f64,
) -> Result<(Path, Mouth), NoChannel> {
    let (middle, out) = foot(drawn, place, width)?;
    // The channel of another port has taken the edge there.
    let on_path = path.nearest(middle).filter(|nearest| nearest.distance < 1e-6);
    let s = on_path.ok_or(NoChannel::Beside)?.s;
    let (across, half, total) = (out.perp(), width / 2.0, path.length());
    let side = |s: f64| (path.point_at(s.rem_euclid(total)).unwrap_or(middle) - middle).dot(across);
    let narrow = || NoChannel::Narrow { width: extent(path, s, side), at: middle };
    // Travelling with the air on the left, the way out is on the right: the edge goes on to the left of it.
    let ahead = first_across(path, s, middle, across, half).ok_or_else(narrow)?;
    let back = first_across(&path.reversed(), total - s, middle, -across, half).ok_or_else(narrow)?;
    let far = |lateral: f64, along: f64| middle + across * lateral + out * along;
    let (from, to) = (ahead, total - back);
    let rest = path.part(from, if to > from { to } else { to + total });
    let (Some(start), Some(end)) = (rest.start(), rest.end()) else { return Err(narrow()) };
    // Sides that begin deep inside have run past a narrower neck, or along a bend.
    let depth = [start, end].map(|p| (p - middle).dot(out).abs()).into_iter().fold(0.0, f64::max);
    if depth > width {
        return Err(NoChannel::Deep { depth, most: width, at: middle });
    }
    let corners = [end, far(-half, length + beyond), far(half, length + beyond), start];
    let lines = Path::through(&corners).segments;
    let met = lines.iter().flat_map(|line| drawn.segments.iter().flat_map(|edge| intersections(edge, line)));
    let met = met.filter(|p| p.distance(start).min(p.distance(end)) > 1e-6);
    let met = met.map(|p| ((p - middle).dot(out), p)).min_by(|a, b| a.0.total_cmp(&b.0));
    if let Some((far, at)) = met {
        return Err(NoChannel::Blocked { far, at });
    }
    let opened = Path::closed(rest.segments.iter().copied().chain(lines).collect());
    Ok((opened, Mouth { port, at: far(0.0, length), out, half, length, beyond, depth: length + width }))
}

/// The place of the port on the path, and the way out.
fn foot(path: &Path, place: &PortPlace, width: f64) -> Result<(Point, Vec2), NoChannel> {
    let nearest = path.nearest(place.middle()).ok_or(NoChannel::Far(f64::INFINITY))?;
    if let PortPlace::Across([a, b]) = place {
        let line = Segment::Line(Line::new(*a, *b));
        for segment in &path.segments {
            if let Some(p) = intersections(segment, &line).first() {
                let t = segment.nearest_fraction(*p);
                let way = (*b - *a).normalized();
                let outwards = segment.tangent(t).cross(way) < 0.0;
                return Ok((*p, if outwards { way } else { -way }));
            }
        }
    }
    if nearest.distance > width.max(5.0) {
        return Err(NoChannel::Far(nearest.distance));
    }
    let tangent = path.tangent_at(nearest.s).unwrap_or(Vec2::new(1.0, 0.0));
    // At a corner the way out lies between both sides.
    let before = path.part(nearest.s - 1e-6, nearest.s);
    let before = before.tangent_at(0.0).unwrap_or(tangent);
    let out = -(tangent + before).perp().normalized();
    Ok((nearest.point, out))
}

/// The arc length at which the path, from `s` on, first lies `half` to the side `across` of `middle`.
fn first_across(path: &Path, s: f64, middle: Point, across: Vec2, half: f64) -> Option<f64> {
    let total = path.length();
    let way = across.perp();
    let reach = 1e3 + total;
    let rail =
        Segment::Line(Line::new(middle + across * half - way * reach, middle + across * half + way * reach));
    let from = path.starting_at(s.rem_euclid(total));
    let mut before = 0.0;
    for segment in &from.segments {
        let length = segment.length();
        let end = (segment.end() - middle).dot(across);
        let mut met: Vec<f64> =
            intersections(segment, &rail).iter().map(|p| segment.nearest_fraction(*p)).collect();
        if (end - half).abs() < 1e-9 {
            met.push(1.0);
        }
        met.sort_by(f64::total_cmp);
        if let Some(t) = met.first() {
            return Some((s + before + t * length).rem_euclid(total));
        }
        before += length;
        if before > total / 2.0 {
            return None;
        }
    }
    None
}

/// The largest width that the path has to both sides of `s`, roughly.
fn extent(path: &Path, s: f64, side: impl Fn(f64) -> f64) -> f64 {
    let total = path.length();
    let samples = |sign: f64| {
        let reach = (0..100).map(|i| sign * side(s + sign * total * f64::from(i) / 200.0));
        reach.fold(0.0, f64::max)
    };
    2.0 * samples(1.0).min(samples(-1.0))
}
