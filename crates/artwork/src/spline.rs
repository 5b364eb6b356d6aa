//! B-splines as Bezier pieces, one a knot span.

use geom::{Point, Vec2};

use crate::piece::Piece;

/// Highest degree that is read. CAD programs write 3 and 5.
pub(crate) const HIGHEST_DEGREE: usize = 11;

/// A non-uniform rational B-spline.
#[derive(Debug)]
pub(crate) struct Nurbs {
    /// Degree of the polynomials, 1 to [`HIGHEST_DEGREE`].
    pub(crate) degree: usize,
    /// Knots in ascending order, as many as points + degree + 1.
    pub(crate) knots: Vec<f64>,
    /// Control points with their weights.
    pub(crate) points: Vec<(Point, f64)>,
}

impl Nurbs {
    /// The finding if degree, numbers of knots and points, or weights do not fit.
    pub(crate) fn finding(&self) -> Option<String> {
        let (n, p) = (self.points.len(), self.degree);
        if !(1..=HIGHEST_DEGREE).contains(&p) {
            return Some(format!("A spline has degree {p}; 1 to {HIGHEST_DEGREE} are allowed."));
        }
        if n <= p {
            return Some(format!(
                "A spline of degree {p} has {n} control points; it needs at least {}.",
                p + 1
            ));
        }
        if self.knots.len() != n + p + 1 {
            let knot_count = self.knots.len();
            return Some(format!(
                "A spline of degree {p} with {n} points has {knot_count} knots instead of {}.",
                n + p + 1
            ));
        }
        if self.knots.windows(2).any(|pair| pair[0] > pair[1]) || self.knots[p] >= self.knots[n] {
            return Some("The knots of a spline do not ascend.".into());
        }
        let weights = self.points.iter().map(|point| point.1);
        (!weights.clone().all(|w| w > 0.0 && w.is_finite()))
            .then(|| "A weight of a spline is not greater than 0.".into())
    }

    /// Bezier pieces of a spline without a finding.
    ///
    /// The control points of the Bezier over a span [a, b] are the blossoms of a (p - j times) and b (j times).
    pub(crate) fn pieces(&self) -> Vec<Piece> {
        let (n, p) = (self.points.len(), self.degree);
        let rational = self.points.iter().any(|point| point.1 != self.points[0].1);
        let spans = (p..n).filter(|&k| self.knots[k] < self.knots[k + 1]);
        spans
            .map(|k| {
                let control: Vec<[f64; 3]> = (0..=p).map(|j| self.blossom(k, j)).collect();
                match (&control[..], rational) {
                    ([a, b], _) => Piece::Line(point(a), point(b)),
                    ([a, b, c, d], false) => Piece::Cubic([a, b, c, d].map(point)),
                    _ => Piece::Rational(control),
                }
            })
            .collect()
    }

    /// The blossom on span `k` of its end `j` times and of its start for the rest, in homogeneous coordinates.
    fn blossom(&self, k: usize, j: usize) -> [f64; 3] {
        let p = self.degree;
        let mut level: Vec<[f64; 3]> =
            self.points[k - p..=k].iter().map(|(q, w)| [q.x * w, q.y * w, *w]).collect();
        for r in 1..=p {
            let u = if r <= j { self.knots[k + 1] } else { self.knots[k] };
            for i in (r..=p).rev() {
                let (low, high) = (self.knots[k - p + i], self.knots[k + 1 + i - r]);
                let share = (u - low) / (high - low);
                let previous = level[i - 1];
                level[i] = [0, 1, 2].map(|c| (1.0 - share) * previous[c] + share * level[i][c]);
            }
        }
        level[p]
    }
}

/// The point of homogeneous coordinates.
fn point(control: &[f64; 3]) -> Point {
    Point::new(control[0] / control[2], control[1] / control[2])
}

/// The cubic spline with continuous curvature through points, its parameter the length of the chords, as CAD programs draw
/// splines that have fit points alone. `ends` are tangents at first and last point (their length is not used); without one the
/// curvature there is 0. A closed spline starts and ends at the first point.
pub(crate) fn interpolated(points: &[Point], ends: [Option<Vec2>; 2], closed: bool) -> Vec<Piece> {
    let mut points: Vec<Point> = points.to_vec();
    if closed && points.first() != points.last() {
        points.extend(points.first().copied());
    }
    points.dedup();
    if points.len() < 2 {
        return Vec::new();
    }
    // A closed one is continued round by some points: the influence of an end falls to a quarter with each point.
    let overlap = if closed { 16 } else { 0 };
    let count = points.len() - 1;
    let point_around = |i: usize| points[(i + count * overlap - overlap) % count];
    let extended: Vec<Point> =
        if closed { (0..=count + 2 * overlap).map(point_around).collect() } else { points.clone() };
    let knot_slopes = slopes(&extended, ends);
    let steps = (overlap..overlap + count).map(|i| {
        let (a, b) = (extended[i], extended[i + 1]);
        let third = a.distance(b) / 3.0;
        Piece::Cubic([a, a + knot_slopes[i] * third, b + knot_slopes[i + 1] * -third, b])
    });
    steps.collect()
}

/// Derivatives by chord length at each of at least two points: the tridiagonal system of the cubic spline.
fn slopes(points: &[Point], ends: [Option<Vec2>; 2]) -> Vec<Vec2> {
    let n = points.len();
    let h: Vec<f64> = points.windows(2).map(|pair| pair[0].distance(pair[1])).collect();
    let rates: Vec<Vec2> =
        points.windows(2).zip(&h).map(|(pair, h)| (pair[1] - pair[0]) * (1.0 / h)).collect();
    let mut solved: Vec<(f64, Vec2)> = Vec::with_capacity(n);
    for i in 0..n {
        let (below, diagonal, above, right) = slope_row(i, ends, &h, &rates);
        let (upper, value) = solved.last().copied().unwrap_or_default();
        let pivot = diagonal - below * upper;
        solved.push((above / pivot, (right - value * below) * (1.0 / pivot)));
    }
    let mut slopes = vec![Vec2::default(); n];
    let mut next = Vec2::default();
    for (slot, (upper, value)) in slopes.iter_mut().zip(solved).rev() {
        next = value - next * upper;
        *slot = next;
    }
    slopes
}

/// Row `i` of the system of [`slopes`], where `h` are the chords and `rates` their directions by length: below, diagonal, above, right
/// side.
fn slope_row(i: usize, ends: [Option<Vec2>; 2], h: &[f64], rates: &[Vec2]) -> (f64, f64, f64, Vec2) {
    let last = rates.len();
    match (i, ends) {
        (0, [Some(t), _]) => (0.0, 1.0, 0.0, t.normalized()),
        (0, _) => (0.0, 2.0, 1.0, rates[0] * 3.0),
        (i, [_, Some(t)]) if i == last => (0.0, 1.0, 0.0, t.normalized()),
        (i, _) if i == last => (1.0, 2.0, 0.0, rates[last - 1] * 3.0),
        _ => (
            h[i],
            2.0 * (h[i - 1] + h[i]),
            h[i - 1],
            rates[i - 1] * (3.0 * h[i]) + rates[i] * (3.0 * h[i - 1]),
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spline_through_points_of_a_circle_is_nearly_the_circle() {
        let points: Vec<Point> =
            (0..24).map(|i| Point::polar(10.0, f64::from(i).to_radians() * 15.0)).collect();
        let pieces = interpolated(&points, [None, None], true);
        assert_eq!(pieces.len(), 24);
        for piece in pieces {
            let Piece::Cubic(c) = piece else { panic!("a cubic") };
            let middle = crate::biarc::Curve::point(&c, 0.5);
            assert!((middle.distance(Point::ORIGIN) - 10.0).abs() < 2e-3, "{middle:?}");
        }
    }

    #[test]
    fn a_rational_quadratic_is_a_quarter_circle() {
        let w = 0.5_f64.sqrt();
        let points =
            vec![(Point::new(1.0, 0.0), 1.0), (Point::new(1.0, 1.0), w), (Point::new(0.0, 1.0), 1.0)];
        let knots = vec![0.0, 0.0, 0.0, 2.0, 2.0, 2.0];
        let pieces = Nurbs { degree: 2, knots, points }.pieces();
        let [Piece::Rational(control)] = &pieces[..] else { panic!("{pieces:?}") };
        for t in [0.1, 0.4, 0.9] {
            assert!((crate::biarc::Curve::point(control, t).distance(Point::ORIGIN) - 1.0).abs() < 1e-15);
        }
    }
}
