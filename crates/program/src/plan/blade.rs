//! The way of a drag knife's axis, so that the tip of the blade goes along a path.
//!
//! The blade trails behind the axis by its **offset** d: where the tip goes in the direction T, the axis is at tip + d T. A straight
//! piece is led d further on. An arc of radius R is led along one of radius sqrt(R^2 + d^2) about the same centre, atan(d / R) further
//! on. At a corner the axis turns about the tip along an arc of radius d, a **swivel**, while the tip stays in its place.

use std::f64::consts::FRAC_PI_2;

use geom::{Arc, Line, Path, Segment, Vec2};

/// Smallest turn that is a corner, rad: less is rounding between pieces that go on smoothly.
const CORNER: f64 = 1e-6;

/// The ways of the axis for `paths` of the tip, each of which begins where the one before it ends. A swivel between two of them belongs
/// to the second one.
pub(super) fn axis_paths<const N: usize>(paths: [&Path; N], offset: f64) -> [Path; N] {
    let mut heading: Option<Vec2> = None;
    paths.map(|path| {
        let mut segments = Vec::with_capacity(path.segments.len());
        for segment in &path.segments {
            segments.extend(heading.and_then(|heading| swivel(segment, heading, offset)));
            segments.push(axis_segment(segment, offset));
            heading = Some(segment.tangent(1.0));
        }
        Path::open(segments)
    })
}

/// The swivel from `heading` to the start of `segment`; `None` where the tip goes straight on.
fn swivel(segment: &Segment, heading: Vec2, offset: f64) -> Option<Segment> {
    let next = segment.tangent(0.0);
    let turn = libm::atan2(heading.cross(next), heading.dot(next));
    (turn.abs() > CORNER).then(|| Arc::new(segment.start(), offset, heading.angle(), turn).into())
}

/// The way of the axis for a piece of the tip's path.
fn axis_segment(segment: &Segment, offset: f64) -> Segment {
    match segment {
        Segment::Line(line) => {
            let ahead = segment.tangent(0.0) * offset;
            Line::new(line.start + ahead, line.end + ahead).into()
        }
        Segment::Arc(arc) => {
            let ahead = libm::atan2(offset, arc.radius) * arc.sweep.signum();
            let direction = (segment.tangent(0.0).angle() - FRAC_PI_2 * arc.sweep.signum()) + ahead;
            Arc::new(arc.center, libm::hypot(arc.radius, offset), direction, arc.sweep).into()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use geom::Point;

    /// Square with one round corner, in either direction: the axis is at the offset ahead of the tip, without a gap.
    #[test]
    fn the_axis_is_ahead_of_the_tip_and_its_way_has_no_gap() {
        let points = [(0.0, 0.0), (10.0, 0.0), (10.0, 6.0)].map(|(x, y)| Point::new(x, y));
        let mut segments = Path::polyline(&points).segments;
        segments.push(Arc::new(Point::new(8.0, 6.0), 2.0, 0.0, FRAC_PI_2).into());
        segments.extend(Path::polyline(&[Point::new(8.0, 8.0), Point::new(0.0, 8.0), points[0]]).segments);
        let square = Path::open(segments);
        for tip in [square.clone(), square.reversed()] {
            let [axis] = axis_paths([&tip], 0.5);
            assert!(axis.largest_gap() < 1e-12, "{}", axis.largest_gap());
            // Two corners within the open path.
            assert_eq!(axis.segments.len(), tip.segments.len() + 2);
            for (piece, led) in tip.segments.iter().zip(
                axis.segments
                    .iter()
                    .filter(|segment| !matches!(segment, Segment::Arc(arc) if arc.radius < 0.6)),
            ) {
                for t in [0.0, 0.3, 1.0] {
                    let ahead = piece.point(t) + piece.tangent(t) * 0.5;
                    assert!(led.point(t).distance(ahead) < 1e-12, "{t}");
                }
            }
        }
    }
}
