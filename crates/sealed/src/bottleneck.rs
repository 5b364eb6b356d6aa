//! **Bottlenecks** of curves: places where two stretches come nearest to each other, exactly.
//!
//! A pair of points p, q is a bottleneck if no neighbour of p on its curve is nearer to q, and no neighbour of q nearer to p: the line
//! between them is normal to both curves, or within the cone of normals of a corner or an end.

use crate::doubles::quarters;
use crate::fault::Crowd;
use geom::order::sort_by;
use geom::{Arc, BoxIndex, Line, Path, Point, Segment, Vec2, intersections};
use std::cmp::Ordering;

/// Directions closer to a right angle than this are right, rad.
const RIGHT: f64 = 1e-7;
/// Points nearer than this are one, mm.
const ONE: f64 = 1e-7;

/// Widths that differ by less are alike, mm.
const ALIKE: f64 = 1e-6;
/// Sides are parallel but for the rounding of a drawing if the width between them changes by at most this, mm, and by a tenth of it.
const ROUNDED: f64 = 0.02;
/// A side bulges by the rounding of a drawing if its arrow is at most half of [`ROUNDED`] and this part of the width. On a circle of many
/// arcs, chords are nearer than the arcs, and [`AROUND`] allows for less than three times as much.
const BULGE: f64 = 0.01;
/// Largest sine of the angle between such sides.
const SLIGHT: f64 = 0.02;
/// Points of one curve face each other if the way between them along it is longer than this many widths. Half around a spot it is shorter,
/// 1.57 on a circle and 1.61 on a polygon of twelve sides; so it is on steps as short as the rounding of a drawing, 1.41 at 45 degrees.
const AROUND: f64 = 1.65;
/// Pairs of stretches that are compared at most: a hundred thousand of them with a thousand others within reach of each.
const MOST_PAIRS: usize = 100_000_000;

/// The nearest points of two stretches.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bottleneck {
    /// The numbers of the curves.
    pub curves: [usize; 2],
    /// A point on each.
    pub points: [Point; 2],
    /// Lengths of the curves before these points, mm.
    pub stations: [f64; 2],
    /// The distance between the points, mm.
    pub width: f64,
    /// Whether a point is a corner or an end.
    at_corner: bool,
}

impl Bottleneck {
    /// The middle of it.
    pub(crate) fn middle(&self) -> Point {
        self.points[0].midpoint(self.points[1])
    }

    /// Whether its points face each other. Those of one curve do unless the curve goes from one to the other in steps, or around a spot;
    /// `closed_length` is its length if it is closed, mm.
    fn is_opposite(&self, closed_length: Option<f64>) -> bool {
        let stretch = (self.stations[0] - self.stations[1]).abs();
        let rest = closed_length.map_or(stretch, |length| length - stretch);
        self.curves[0] != self.curves[1] || stretch.min(rest) > AROUND * self.width
    }
}

/// A curve, and whether its start and end are joined to others, so that they do not count as ends.
pub(crate) struct GapCurve<'a> {
    pub path: &'a Path,
    pub joined: [bool; 2],
}

/// A quarter turn at most, or a line, with its beginning (and the end of an open curve) as corners.
struct CurvePart {
    curve: usize,
    /// Number of the part in its curve.
    at: usize,
    /// Length of the curve before it, mm.
    before: f64,
    segment: Segment,
    ends: [Point; 2],
    middle: Point,
    half: f64,
    tangent: Vec2,
    /// Sine of how far tangents in it and at its corners turn from `tangent`.
    turn: f64,
    corners: Vec<TurnPoint>,
}

struct TurnPoint {
    at: Point,
    arriving: Option<Vec2>,
    leaving: Option<Vec2>,
    bends: [Option<Arc>; 2],
}

/// The bottlenecks of `curves` narrower than `limit` mm that no other curve passes through, the narrowest first.
///
/// # Errors
/// If more than [`MOST_PAIRS`] stretches would have to be compared.
pub(crate) fn bottlenecks(curves: &[GapCurve<'_>], limit: f64) -> Result<Vec<Bottleneck>, Crowd> {
    let mut parts = Vec::new();
    let mut counts = Vec::new();
    for (number, curve) in curves.iter().enumerate() {
        let first = parts.len();
        add_parts(&mut parts, number, curve);
        counts.push(parts.len() - first);
    }
    let index = BoxIndex::new(parts.iter().map(|part| part.segment.bounds_of(part.ends)));
    let mut bottlenecks: Vec<Bottleneck> = Vec::new();
    let mut compared = 0;
    for (i, a) in parts.iter().enumerate() {
        if compared > MOST_PAIRS {
            return Err(Crowd(a.middle));
        }
        index.visit(&a.segment.bounds_of(a.ends).outset(limit), |j| {
            compared += 1;
            if j <= i || !may_face(a, &parts[j], limit) {
                return;
            }
            let b = &parts[j];
            let steps = b.at.abs_diff(a.at);
            let round = curves[a.curve].path.closed && steps + 1 == counts[a.curve];
            if a.curve == b.curve && (steps <= 1 || round) {
                return;
            }
            pairs(a, b, &mut |p, q, at_corner| {
                let width = p.distance(q);
                if width < limit && width > ONE {
                    let (curves, stations) = ([a.curve, b.curve], [a.station(p), b.station(q)]);
                    bottlenecks.push(Bottleneck { curves, points: [p, q], stations, width, at_corner });
                }
            });
        });
    }
    let lengths: Vec<Option<f64>> =
        curves.iter().map(|curve| curve.path.closed.then(|| curve.path.length())).collect();
    bottlenecks.retain(|bottleneck| bottleneck.is_opposite(lengths[bottleneck.curves[0]]));
    sort_by(&mut bottlenecks, narrowest_first);
    bottlenecks.retain(|bottleneck| is_clear(&parts, &index, bottleneck));
    Ok(bottlenecks)
}

/// The order of bottlenecks. At equal widths, those inside segments come first: they are in the middle of the narrow part.
fn narrowest_first(a: &Bottleneck, b: &Bottleneck) -> Ordering {
    let (p, q) = (a.points[0], b.points[0]);
    let width = (a.width / ALIKE).round().total_cmp(&(b.width / ALIKE).round());
    let place = || p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y));
    width.then(a.at_corner.cmp(&b.at_corner)).then(a.curves.cmp(&b.curves)).then_with(place)
}

/// Adds the parts of a curve, each of a quarter turn at most.
///
/// A part has the corner at its start, and the last one of an open curve that at its end. An end that is joined to another curve is no
/// corner. `turn` bounds how far tangents of the part turn from the middle one, so that most pairs of parts need no closer look.
fn add_parts(parts: &mut Vec<CurvePart>, curve: usize, GapCurve { path, joined }: &GapCurve<'_>) {
    let pieces: Vec<Segment> = path.segments.iter().flat_map(quarters).map(|(part, ..)| part).collect();
    let count = pieces.len();
    let mut length_before = 0.0;
    for (at, segment) in pieces.iter().enumerate() {
        let previous = if at > 0 { Some(at - 1) } else { path.closed.then_some(count - 1) };
        let previous = previous.map(|previous| &pieces[previous]);
        let ends = [segment.start(), segment.end()];
        let mut corners = Vec::new();
        if previous.is_some() || !joined[0] {
            corners.push(TurnPoint {
                at: ends[0],
                arriving: previous.map(|previous| previous.tangent(1.0)),
                leaving: Some(segment.tangent(0.0)),
                bends: [previous.and_then(arc_of), arc_of(segment)],
            });
        }
        if at + 1 == count && !path.closed && !joined[1] {
            let arriving = Some(segment.tangent(1.0));
            corners.push(TurnPoint { at: ends[1], arriving, leaving: None, bends: [arc_of(segment), None] });
        }
        let (middle, half) = (segment.point(0.5), segment.length() / 2.0);
        parts.push(CurvePart {
            curve,
            at,
            before: length_before,
            segment: *segment,
            ends,
            middle,
            half,
            tangent: segment.tangent(0.5),
            turn: turn_of(segment, &corners),
            corners,
        });
        length_before += 2.0 * half;
    }
}

/// The arc that a segment is.
fn arc_of(segment: &Segment) -> Option<Arc> {
    if let Segment::Arc(arc) = segment { Some(*arc) } else { None }
}

/// Sine of how far tangents in a segment and at its `corners` turn from that in its middle; 1 where a corner is an end.
fn turn_of(segment: &Segment, corners: &[TurnPoint]) -> f64 {
    let tangent = segment.tangent(0.5);
    let sides = corners.iter().flat_map(|corner| [corner.arriving, corner.leaving]);
    let sides = sides.flatten().chain([segment.tangent(0.0), segment.tangent(1.0)]);
    let cosine = sides.map(|side| side.dot(tangent)).fold(1.0, f64::min);
    let is_end = corners.iter().any(|corner| corner.arriving.is_none() || corner.leaving.is_none());
    if is_end || cosine <= 0.0 { 1.0 } else { (1.0 - cosine * cosine).max(0.0).sqrt() }
}

impl CurvePart {
    /// Length of the curve before the point `p` of the part, mm.
    fn station(&self, p: Point) -> f64 {
        self.before + self.segment.nearest_fraction(p) * 2.0 * self.half
    }
}

/// Whether a line shorter than `limit` that is normal to both can exist; may be wrongly true, never wrongly false.
fn may_face(a: &CurvePart, b: &CurvePart, limit: f64) -> bool {
    let way = b.middle - a.middle;
    let (length, reach) = (way.length(), a.half + b.half);
    length <= limit + reach
        && [a, b].iter().all(|part| way.dot(part.tangent).abs() <= (length + reach) * part.turn + reach + ONE)
}

/// Calls `see` with the pairs of points of two parts that are nearest to each other, and whether one of them is a corner.
fn pairs(a: &CurvePart, b: &CurvePart, see: &mut impl FnMut(Point, Point, bool)) {
    inner_pairs(&a.segment, &b.segment, &mut |p, q| see(p, q, false));
    for corner in &a.corners {
        if let Some(q) = foot(&b.segment, corner.at).filter(|q| corner.faces(*q)) {
            see(corner.at, q, true);
        }
        for other in &b.corners {
            if corner.faces(other.at) && other.faces(corner.at) {
                see(corner.at, other.at, true);
            }
        }
    }
    for corner in &b.corners {
        if let Some(p) = foot(&a.segment, corner.at).filter(|p| corner.faces(*p)) {
            see(p, corner.at, true);
        }
    }
}

impl TurnPoint {
    /// Whether no neighbour of the corner is nearer to `q`.
    fn faces(&self, q: Point) -> bool {
        let way = (q - self.at).normalized();
        self.leaving.is_none_or(|tangent| self.has_no_nearer(q, way.dot(tangent), self.bends[1].as_ref()))
            && self
                .arriving
                .is_none_or(|tangent| self.has_no_nearer(q, -way.dot(tangent), self.bends[0].as_ref()))
    }

    /// Whether a side of the corner, along the arc `bend` or straight, has no point nearer to `q`. `cosine` is that between the side and the
    /// way to `q`.
    fn has_no_nearer(&self, q: Point, cosine: f64, bend: Option<&Arc>) -> bool {
        cosine < -RIGHT || (cosine <= RIGHT && bend.is_none_or(|arc| is_least(arc, self.at, q)))
    }
}

/// Whether the point `p` of an arc, on a normal to `q`, is nearer to `q` than its neighbours.
fn is_least(arc: &Arc, p: Point, q: Point) -> bool {
    let inwards = (arc.center - p).dot(q - p) > 0.0;
    !inwards || p.distance(q) <= arc.radius * (1.0 + 1e-9)
}

/// The nearest point to `p` inside a segment.
fn foot(segment: &Segment, p: Point) -> Option<Point> {
    match segment {
        Segment::Line(line) => inside_line(line, p),
        Segment::Arc(arc) => on_arc(arc, p - arc.center).filter(|q| is_least(arc, *q, p)),
    }
}

/// The foot of `p` inside a line.
fn inside_line(line: &Line, p: Point) -> Option<Point> {
    let t = line.nearest_fraction(p);
    (t > 0.0 && t < 1.0).then(|| line.start.lerp(line.end, t))
}

/// The point of an arc in the direction `way` from its centre.
fn on_arc(arc: &Arc, way: Vec2) -> Option<Point> {
    if way.length() <= 1e-12 * arc.radius {
        return None;
    }
    let _ = arc.fraction_of(way.angle(), 0.0)?;
    Some(arc.center + way.normalized() * arc.radius)
}

/// The pairs inside both segments.
///
/// A side of curves that a drawing rounds bulges by a few micrometres, inwards or outwards. Where sides that bulge face each other nowhere at
/// a right angle, their chords may.
fn inner_pairs(a: &Segment, b: &Segment, see: &mut impl FnMut(Point, Point)) {
    let mut count = 0;
    exact_pairs(a, b, &mut |p, q| {
        count += 1;
        see(p, q);
    });
    if count > 0 || (arc_of(a).is_none() && arc_of(b).is_none()) {
        return;
    }
    let largest_arrow = arrow(a).max(arrow(b));
    let [p, q] = [a, b].map(|segment| Line::new(segment.start(), segment.end()));
    line_line(&p, &q, &mut |p, q| {
        if largest_arrow <= (ROUNDED / 2.0).min(BULGE * p.distance(q)) {
            see(p, q);
        }
    });
}

/// The pairs inside both segments at right angles to both.
fn exact_pairs(a: &Segment, b: &Segment, see: &mut impl FnMut(Point, Point)) {
    match (a, b) {
        (Segment::Line(p), Segment::Line(q)) => line_line(p, q, see),
        (Segment::Line(line), Segment::Arc(arc)) => line_arc(line, arc, see),
        (Segment::Arc(arc), Segment::Line(line)) => line_arc(line, arc, &mut |p, q| see(q, p)),
        (Segment::Arc(p), Segment::Arc(q)) => arc_arc(p, q, see),
    }
}

/// How far the middle of a segment lies from that of its chord, mm.
fn arrow(segment: &Segment) -> f64 {
    segment.point(0.5).distance(segment.start().midpoint(segment.end()))
}

fn line_line(p: &Line, q: &Line, see: &mut impl FnMut(Point, Point)) {
    let (t, u) = (p.nearest_fraction(q.start), p.nearest_fraction(q.end));
    let (slope, shared) = (p.direction().cross(q.direction()).abs(), (t - u).abs() * p.length());
    let middle = p.start.lerp(p.end, f64::midpoint(t, u));
    let foot = q.start.lerp(q.end, q.nearest_fraction(middle));
    if shared > ONE && slope <= SLIGHT && is_rounding(slope * shared, middle, foot) {
        see(middle, foot);
    }
}

/// Whether the width between `p` and `q` is all along the same but for the rounding of a drawing, if it changes by `change` mm.
fn is_rounding(change: f64, p: Point, q: Point) -> bool {
    change <= RIGHT.max(ROUNDED.min(0.1 * p.distance(q)))
}

fn line_arc(line: &Line, arc: &Arc, see: &mut impl FnMut(Point, Point)) {
    let Some(foot) = inside_line(line, arc.center) else { return };
    let mut normal = foot - arc.center;
    if normal.length() <= ONE {
        normal = line.direction().perp();
    }
    for way in [normal, -normal] {
        if let Some(q) = on_arc(arc, way).filter(|q| is_least(arc, *q, foot)) {
            see(foot, q);
        }
    }
}

fn arc_arc(a: &Arc, b: &Arc, see: &mut impl FnMut(Point, Point)) {
    let way = b.center - a.center;
    if way.length() <= ROUNDED {
        // Along circles around one centre, as exactly as it is drawn, all widths are alike: the middle of the facing part.
        let ends = [b.start(), b.at_angle(b.start_angle + b.sweep / 2.0), b.end()];
        if let Some(p) = ends.iter().find_map(|end| on_arc(a, *end - a.center))
            && let Some(q) = on_arc(b, p - b.center)
            && is_rounding(way.length(), p, q)
        {
            see(p, q);
        }
    }
    if way.length() <= ONE {
        return;
    }
    for p in [way, -way].into_iter().filter_map(|way| on_arc(a, way)) {
        for q in [way, -way].into_iter().filter_map(|way| on_arc(b, way)) {
            if is_least(a, p, q) && is_least(b, q, p) {
                see(p, q);
            }
        }
    }
}

/// Whether no curve passes between the points of a bottleneck.
fn is_clear(parts: &[CurvePart], index: &BoxIndex, bottleneck: &Bottleneck) -> bool {
    let [p, q] = bottleneck.points;
    let line = Segment::Line(Line::new(p.lerp(q, 1e-6), q.lerp(p, 1e-6)));
    let mut clear = true;
    index.visit(&line.bounds(), |i| {
        clear = clear && intersections(&parts[i].segment, &line).is_empty();
    });
    clear
}
