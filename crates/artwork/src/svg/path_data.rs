//! Path data: the attribute `d`, all its commands.

use geom::{Point, Vec2};
use svgtypes::{PathParser, PathSegment};

use crate::affine::sin_cos_degrees;
use crate::collector::CurveChain;
use crate::piece::Piece;

/// The subpaths of path data, in user units.
pub(super) fn chains(data: &str) -> Result<Vec<CurveChain>, String> {
    let mut pen = ChainPen::default();
    for segment in PathParser::from(data) {
        pen.draw(segment.map_err(|error| format!("Its path data is faulty: {error}."))?);
    }
    pen.lift();
    Ok(pen.done)
}

/// The state of a path: where the pen is, and the last control point for smooth curves.
#[derive(Default)]
struct ChainPen {
    at: Point,
    start: Point,
    cubic: Option<Point>,
    quadratic: Option<Point>,
    chain: CurveChain,
    done: Vec<CurveChain>,
}

impl ChainPen {
    /// Ends the subpath. One without a drawing command shows nothing.
    fn lift(&mut self) {
        let chain = std::mem::take(&mut self.chain);
        if chain.closed || !chain.pieces.is_empty() {
            self.done.push(chain);
        }
        self.chain.start = self.at;
    }

    fn push(&mut self, piece: Piece, end: Point) {
        self.chain.pieces.push(piece);
        self.at = end;
    }

    fn line(&mut self, end: Point) {
        self.push(Piece::Line(self.at, end), end);
    }

    fn curve(&mut self, first: Point, second: Point, end: Point) {
        self.push(Piece::Cubic([self.at, first, second, end]), end);
        self.cubic = Some(second);
    }

    /// A quadratic Bezier as the cubic that it is.
    fn bend(&mut self, control: Point, end: Point) {
        self.curve(self.at.lerp(control, 2.0 / 3.0), end.lerp(control, 2.0 / 3.0), end);
        (self.cubic, self.quadratic) = (None, Some(control));
    }

    /// The place (`x`, `y`), which counts from the pen unless it is absolute.
    fn place(&self, abs: bool, x: f64, y: f64) -> Point {
        if abs { Point::new(x, y) } else { self.at + Vec2::new(x, y) }
    }

    /// The last control point on the other side of the pen, or the pen where there is none.
    fn mirrored(&self, control: Option<Point>) -> Point {
        control.map_or(self.at, |control| self.at + (self.at - control))
    }

    fn draw(&mut self, segment: PathSegment) {
        // A smooth curve mirrors the last control point only if the segment before it was a curve of its own kind, so both are
        // taken first.
        let (cubic, quadratic) = (self.cubic.take(), self.quadratic.take());
        match segment {
            PathSegment::MoveTo { abs, x, y } => {
                self.at = self.place(abs, x, y);
                self.start = self.at;
                self.lift();
            }
            PathSegment::LineTo { abs, x, y } => self.line(self.place(abs, x, y)),
            PathSegment::HorizontalLineTo { abs, x } => {
                self.line(Point::new(if abs { x } else { self.at.x + x }, self.at.y));
            }
            PathSegment::VerticalLineTo { abs, y } => {
                self.line(Point::new(self.at.x, if abs { y } else { self.at.y + y }));
            }
            PathSegment::CurveTo { abs, x1, y1, x2, y2, x, y } => {
                self.curve(self.place(abs, x1, y1), self.place(abs, x2, y2), self.place(abs, x, y));
            }
            PathSegment::SmoothCurveTo { abs, x2, y2, x, y } => {
                self.curve(self.mirrored(cubic), self.place(abs, x2, y2), self.place(abs, x, y));
            }
            PathSegment::Quadratic { abs, x1, y1, x, y } => {
                self.bend(self.place(abs, x1, y1), self.place(abs, x, y));
            }
            PathSegment::SmoothQuadratic { abs, x, y } => {
                self.bend(self.mirrored(quadratic), self.place(abs, x, y));
            }
            PathSegment::EllipticalArc { abs, rx, ry, x_axis_rotation, large_arc, sweep, x, y } => {
                let end = self.place(abs, x, y);
                let flags = [large_arc, sweep];
                self.push(elliptical([self.at, end], [rx.abs(), ry.abs()], x_axis_rotation, flags), end);
            }
            PathSegment::ClosePath { .. } => {
                self.chain.closed = true;
                self.at = self.start;
                self.lift();
            }
        }
    }
}

/// The elliptical arc between two points, by section B.2.4 of SVG 2; radii that are too small grow until the ends are met.
fn elliptical(
    [from, to]: [Point; 2],
    [rx, ry]: [f64; 2],
    degrees: f64,
    [large, positive]: [bool; 2],
) -> Piece {
    if rx == 0.0 || ry == 0.0 || from == to {
        return Piece::Line(from, to);
    }
    let (sin, cos) = sin_cos_degrees(degrees);
    let half = (from - to) * 0.5;
    // Half the chord in units of the radii, in the ellipse's frame: there the arc is on a unit circle.
    let p = Vec2::new((cos * half.x + sin * half.y) / rx, (cos * half.y - sin * half.x) / ry);
    let square = p.dot(p);
    if square.sqrt() < 1e-12 && !large {
        return Piece::Line(from, to); // see `bulged`
    }
    let grow = square.sqrt().max(1.0);
    let distance = ((1.0 - square).max(0.0) / square).sqrt() * if large == positive { -1.0 } else { 1.0 };
    let q = Vec2::new(p.y, -p.x) * distance; // centre in that frame, from the middle of the chord
    let (first, last) = (p + -q, -p + -q);
    let start = first.angle();
    let turn = libm::atan2(first.cross(last), first.dot(last));
    let sweep = match (positive, turn > 0.0) {
        (true, false) => turn + std::f64::consts::TAU,
        (false, true) => turn - std::f64::consts::TAU,
        _ => turn,
    };
    let (u, v) = (Vec2::new(cos, sin) * (rx * grow), Vec2::new(-sin, cos) * (ry * grow));
    let center = from.midpoint(to) + u * (q.x / grow) + v * (q.y / grow);
    Piece::ellipse(center, [u, v], start, sweep).with_ends([from, to])
}

/// Excess of a radius over half the chord, relative, that the rounding of a file explains.
const ROUNDED: f64 = 2e-3;

/// The full circle or ellipse that a subpath of two arcs means whose numbers have few decimals; `None` for any other subpath.
///
/// A radius that is too long by 0.1 % moves the centre of a half turn by 4 % of the radius, to opposite sides in both halves.
pub(super) fn full_turn(chain: &CurveChain) -> Option<CurveChain> {
    let [
        Piece::Ellipse { center, u, v, start, sweep, .. },
        Piece::Ellipse { center: second, u: u2, v: v2, start: begin, sweep: turn, .. },
    ] = &chain.pieces[..]
    else {
        return None;
    };
    let tolerance = ROUNDED * u.length().min(v.length());
    let alike =
        (*u - *u2).length().max((*v - *v2).length()) <= 1e-9 * tolerance && sweep.signum() == turn.signum();
    let ends = [(*center, *start), (*center, start + sweep), (*second, begin + turn)];
    let [start_point, middle_point, back] = ends.map(|(center, angle)| {
        let (sin, cos) = libm::sincos(angle);
        center + *u * cos + *v * sin
    });
    let half = (start_point - middle_point) * 0.5;
    let (along, across) = (half.dot(*u) / u.dot(*u), half.dot(*v) / v.dot(*v));
    let factor = libm::hypot(along, across);
    let is_rounded = center.distance(*second) > 1e-9 * tolerance
        && factor > 1.0 - ROUNDED
        && start_point.distance(back) <= tolerance;
    (alike && is_rounded).then(|| CurveChain {
        pieces: vec![Piece::ellipse(
            start_point.midpoint(middle_point),
            [*u * factor, *v * factor],
            libm::atan2(across, along),
            sweep.signum() * std::f64::consts::TAU,
        )],
        closed: true,
        start: start_point,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn single_path(data: &str) -> Vec<Piece> {
        let mut subpaths = chains(data).expect("path data");
        assert_eq!(subpaths.len(), 1, "{data}");
        subpaths.remove(0).pieces
    }

    #[test]
    fn flags_choose_among_the_four_arcs() {
        // From (10, 0) to (0, 10) with radius 10: centres (0, 0) and (10, 10).
        for (flags, center, sweep) in
            [("0 1", 0.0, 90.0), ("1 0", 0.0, -270.0), ("0 0", 10.0, -90.0), ("1 1", 10.0, 270.0)]
        {
            let pieces = single_path(&format!("M10 0A10 10 0 {flags} 0 10"));
            let [Piece::Ellipse { center: c, sweep: s, .. }] = pieces[..] else { panic!("{pieces:?}") };
            assert!(c.distance(Point::new(center, center)) < 1e-12, "{flags}: {c:?}");
            assert!((s.to_degrees() - sweep).abs() < 1e-12, "{flags}: {s}");
        }
    }

    #[test]
    fn radii_that_are_too_small_grow() {
        let pieces = single_path("M-10 0a1 1 0 0 1 20 0");
        let [Piece::Ellipse { center, u, sweep, .. }] = pieces[..] else { panic!("{pieces:?}") };
        assert!((u.length() - 10.0).abs() < 1e-12 && center.distance(Point::ORIGIN) < 1e-12);
        assert!((sweep - std::f64::consts::PI).abs() < 1e-12);
    }

    /// Radii of 30.015 mm, written with two decimals: read literally the centres are 1.1 mm apart.
    #[test]
    fn two_half_arcs_with_rounded_ends_are_a_full_circle() {
        for flags in ["0 1", "1 1"] {
            let data = format!("M34.87 50A30.02 30.02 0 {flags} 94.9 50A30.02 30.02 0 {flags} 34.87 50Z");
            let read = chains(&data).expect("path data");
            let circle = full_turn(&read[0]).expect("a circle");
            let [Piece::Ellipse { center, u, sweep, .. }] = circle.pieces[..] else { panic!("{circle:?}") };
            assert!(center.distance(Point::new(64.885, 50.0)) < 1e-9 && (u.length() - 30.015).abs() < 1e-9);
            assert!((sweep - std::f64::consts::TAU).abs() < 1e-12);
        }
        // A lens, a circle whose two arcs have one centre, and an arc with its chord are what they are.
        for data in [
            "M0 0A30 30 0 0 1 50 0A30 30 0 0 1 0 0Z",
            "M34.87 50A30.02 30.02 0 0 1 94.9 50A30.02 30.02 0 1 1 34.87 50Z",
            "M34.87 50A30.02 30.02 0 0 1 94.9 50Z",
        ] {
            assert!(full_turn(&chains(data).expect("path data")[0]).is_none(), "{data}");
        }
    }

    #[test]
    fn relative_smooth_and_short_commands_continue_the_path() {
        let pieces = single_path("m1,1 2 0h-1v3c0 1 1 2 2 2s2-1 2-2q0-1 1-1t1-1");
        assert_eq!(pieces.len(), 7);
        let Piece::Cubic(smooth) = pieces[4] else { panic!("{:?}", pieces[4]) };
        assert_eq!(smooth.map(|p| (p.x, p.y)), [(4.0, 6.0), (5.0, 6.0), (6.0, 5.0), (6.0, 4.0)]);
        let Piece::Cubic(t) = pieces[6] else { panic!("{:?}", pieces[6]) };
        // The control point (6, 3) mirrored in (7, 3) is (8, 3).
        assert!(t[1].distance(Point::new(7.0 + 2.0 / 3.0, 3.0)) < 1e-15 && t[3] == Point::new(8.0, 2.0));
    }

    #[test]
    fn subpaths_start_where_the_last_closed() {
        let subpaths = chains("M1 1h2v2zl5 5M9 9").expect("path data");
        assert_eq!(
            subpaths.iter().map(|chain| (chain.pieces.len(), chain.closed)).collect::<Vec<_>>(),
            [(2, true), (1, false)]
        );
        assert_eq!(subpaths[1].pieces[0], Piece::Line(Point::new(1.0, 1.0), Point::new(6.0, 6.0)));
        assert!(super::chains("M1 1 L nan 3").is_err());
        assert!(super::chains("L1 1").is_err());
    }
}
