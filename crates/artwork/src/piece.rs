//! Pieces of which files make their figures, closed under affine maps.

use std::f64::consts::{FRAC_PI_2, PI};

use geom::straight::{SHORT, is_straight, push_arc, push_line};
use geom::{Arc, Line, Point, Segment, Vec2};

use crate::affine::Affine;
use crate::biarc::{Curve, fit};

/// Relative difference of the two radii, and cosine between them, up to which an ellipse is a circle. Transforms of a
/// file have 5 to 17 digits; at 1e-9 and a radius of 1 m the error is 1 nm.
const ROUND: f64 = 1e-9;

/// A curve in the coordinates of the file or of the drawing.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Piece {
    /// A straight line.
    Line(Point, Point),
    /// The points `center + u cos t + v sin t` for t from `start`, over `sweep` (rad, |sweep| <= 2 pi).
    /// Its `ends` are exact however far away the centre is.
    Ellipse { center: Point, u: Vec2, v: Vec2, start: f64, sweep: f64, ends: [Point; 2] },
    /// A cubic Bezier.
    Cubic([Point; 4]),
    /// A rational Bezier with control points (w x, w y, w), w > 0.
    Rational(Vec<[f64; 3]>),
}

impl Piece {
    /// A circular arc of radius `r`.
    pub(crate) fn arc(center: Point, r: f64, start: f64, sweep: f64) -> Self {
        Self::ellipse(center, [Vec2::new(r, 0.0), Vec2::new(0.0, r)], start, sweep)
    }

    /// An elliptical arc with two conjugate half axes.
    pub(crate) fn ellipse(center: Point, [u, v]: [Vec2; 2], start: f64, sweep: f64) -> Self {
        let ends = [start, start + sweep].map(|t| EllipsePart { center, u, v, start: t, end: t }.point(0.0));
        Self::Ellipse { center, u, v, start, sweep, ends }
    }

    /// The elliptical arc, between these ends.
    pub(crate) fn with_ends(self, ends: [Point; 2]) -> Self {
        match self {
            Self::Ellipse { center, u, v, start, sweep, .. } => {
                Self::Ellipse { center, u, v, start, sweep, ends }
            }
            Self::Line(..) | Self::Cubic(_) | Self::Rational(_) => self,
        }
    }

    /// The image under an affine map.
    pub(crate) fn mapped(&self, map: &Affine) -> Self {
        match self {
            Self::Line(a, b) => Self::Line(map.point(*a), map.point(*b)),
            Self::Ellipse { center, u, v, start, sweep, ends } => Self::Ellipse {
                ends: ends.map(|end| map.point(end)),
                center: map.point(*center),
                u: map.vector(*u),
                v: map.vector(*v),
                start: *start,
                sweep: *sweep,
            },
            Self::Cubic(points) => Self::Cubic(points.map(|p| map.point(p))),
            Self::Rational(points) => Self::Rational(
                points
                    .iter()
                    .map(|[x, y, w]| {
                        let v = map.vector(Vec2::new(*x, *y));
                        [v.x + w * map.origin.x, v.y + w * map.origin.y, *w]
                    })
                    .collect(),
            ),
        }
    }

    /// Largest absolute coordinate of the points that span the piece; NaN counts as infinite. The centre of an arc that turns by half a
    /// circle at most is no point of it.
    pub(crate) fn extent(&self) -> f64 {
        let largest = match self {
            Self::Line(a, b) => [a, b].into_iter().map(farthest_coordinate).fold(0.0, worse),
            Self::Ellipse { center, u, v, start, sweep, ends } => {
                let reach = if sweep.abs() <= PI { rise(*u, *v, *sweep) } else { u.length() + v.length() };
                let farthest = if sweep.abs() <= PI {
                    ends.iter().map(farthest_coordinate).fold(0.0, worse)
                } else {
                    farthest_coordinate(center)
                };
                farthest + reach + 0.0 * (start + sweep)
            }
            Self::Cubic(points) => points.iter().map(farthest_coordinate).fold(0.0, worse),
            Self::Rational(points) => {
                points.iter().map(|[x, y, w]| farthest_coordinate(&Point::new(x / w, y / w))).fold(0.0, worse)
            }
        };
        if largest.is_nan() { f64::INFINITY } else { largest }
    }

    /// Appends the piece as lines and arcs that leave it by at most `tolerance`; lines and circular arcs are exact.
    /// `false` if there would be more than `limit` segments.
    pub(crate) fn append(&self, tolerance: f64, limit: usize, segments: &mut Vec<Segment>) -> bool {
        match self {
            Self::Line(a, b) => {
                push_line(Line::new(*a, *b), segments);
                segments.len() <= limit
            }
            Self::Ellipse { center, u, v, start, sweep, ends } => {
                if sweep.abs() <= PI && is_straight(rise(*u, *v, *sweep), sweep.abs(), tolerance) {
                    push_line(Line::new(ends[0], ends[1]), segments);
                    return segments.len() <= limit;
                }
                if let Some(arc) = circular(*center, *u, *v, *start, *sweep) {
                    return push_arc(&arc, *ends, 0.5 * tolerance, limit, segments);
                }
                quarters(*u, *v, *start, *sweep).windows(2).all(|ends| {
                    let part = EllipsePart { center: *center, u: *u, v: *v, start: ends[0], end: ends[1] };
                    fit(&part, tolerance, limit, segments)
                })
            }
            Self::Cubic(points) => fit(points, tolerance, limit, segments),
            Self::Rational(points) => fit(points, tolerance, limit, segments),
        }
    }
}

/// Upper bound of how far an elliptical arc that turns by half a circle at most leaves its chord.
fn rise(u: Vec2, v: Vec2, sweep: f64) -> f64 {
    libm::hypot(u.length(), v.length()) * 2.0 * libm::sin(0.25 * sweep).powi(2)
}

/// The larger of two numbers, NaN if one is.
fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

/// The arc that equals an ellipse with equal and perpendicular half axes; `None` if it is not a circle or has no length.
fn circular(center: Point, u: Vec2, v: Vec2, start: f64, sweep: f64) -> Option<Arc> {
    let (a, b) = (u.length(), v.length());
    let round = (a - b).abs() <= ROUND * a && u.dot(v).abs() <= ROUND * a * b;
    if !round || a * sweep.abs() <= SHORT {
        return None;
    }
    let turn = if u.cross(v) > 0.0 { 1.0 } else { -1.0 };
    // sqrt(a b) keeps the area, and is exact when the map only turns the axes.
    let radius = if a == b { a } else { (a * b).sqrt() };
    Some(Arc::new(center, radius, u.angle() + turn * start, turn * sweep))
}

/// Parameters from `start` over `sweep`, cut at the ends of the principal axes, where curvature is extreme.
fn quarters(u: Vec2, v: Vec2, start: f64, sweep: f64) -> Vec<f64> {
    let axis = 0.5 * libm::atan2(2.0 * u.dot(v), u.dot(u) - v.dot(v));
    let (low, high) = (start.min(start + sweep), start.max(start + sweep));
    let mut cuts = vec![low];
    let mut next = axis + ((low - axis) / FRAC_PI_2).floor() * FRAC_PI_2;
    // At most TAU / FRAC_PI_2 + 2 steps, since |sweep| <= TAU; they are counted, since a step may be lost in a large `start`.
    for _ in 0..6 {
        if next > low + 1e-9 && next < high - 1e-9 {
            cuts.push(next);
        }
        next += FRAC_PI_2;
    }
    cuts.push(high);
    if sweep < 0.0 {
        cuts.reverse();
    }
    cuts
}

/// An elliptical arc between two parameters.
struct EllipsePart {
    center: Point,
    u: Vec2,
    v: Vec2,
    start: f64,
    end: f64,
}

impl Curve for EllipsePart {
    fn point(&self, t: f64) -> Point {
        let (sin, cos) = libm::sincos(self.start + (self.end - self.start) * t);
        self.center + self.u * cos + self.v * sin
    }

    fn derivative(&self, t: f64) -> Vec2 {
        let span = self.end - self.start;
        let (sin, cos) = libm::sincos(self.start + span * t);
        (self.v * cos - self.u * sin) * span
    }
}

impl Curve for [Point; 4] {
    fn point(&self, t: f64) -> Point {
        let s = 1.0 - t;
        let [a, b, c, d] = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
        let [p, q, r, w] = self;
        Point::new(a * p.x + b * q.x + c * r.x + d * w.x, a * p.y + b * q.y + c * r.y + d * w.y)
    }

    fn derivative(&self, t: f64) -> Vec2 {
        let s = 1.0 - t;
        let [p, q, r, w] = *self;
        ((q - p) * (s * s) + (r - q) * (2.0 * s * t) + (w - r) * (t * t)) * 3.0
    }
}

impl Curve for Vec<[f64; 3]> {
    fn point(&self, t: f64) -> Point {
        let [x, y, w] = casteljau(self, t).1;
        Point::new(x / w, y / w)
    }

    fn derivative(&self, t: f64) -> Vec2 {
        let (tangent, [x, y, w]) = casteljau(self, t);
        Vec2::new(tangent[0] - x / w * tangent[2], tangent[1] - y / w * tangent[2]) * (1.0 / w)
    }
}

/// Largest absolute coordinate; NaN or infinite if one of them is.
fn farthest_coordinate(p: &Point) -> f64 {
    p.x.abs().max(p.y.abs()) + 0.0 * (p.x + p.y)
}

/// Derivative and value of a Bezier in homogeneous coordinates, by de Casteljau's algorithm.
fn casteljau(points: &[[f64; 3]], t: f64) -> ([f64; 3], [f64; 3]) {
    let mut level = points.to_vec();
    while level.len() > 2 {
        level = level.windows(2).map(|pair| mixed(pair[0], pair[1], t)).collect();
    }
    #[expect(clippy::cast_precision_loss, reason = "a degree is small")]
    let degree = (points.len() - 1) as f64;
    let [a, b] = [level[0], level[level.len() - 1]];
    ([0, 1, 2].map(|i| degree * (b[i] - a[i])), mixed(a, b, t))
}

/// The point at the fraction `t` from `a` to `b`.
fn mixed(a: [f64; 3], b: [f64; 3], t: f64) -> [f64; 3] {
    [0, 1, 2].map(|i| (1.0 - t) * a[i] + t * b[i])
}
