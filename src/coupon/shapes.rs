//! Pouches: the centre line of a band around a flat tube, open at a mouth for a hose.

use std::f64::consts::PI;

use crate::geom::{Arc, Line, Path, Point, Segment, Vec2};
use crate::spec::StarSpec;

/// Half the flat width of the channel for a hose of 4 mm: pi d / 4.
const HALF_MOUTH: f64 = PI;
/// Length of the channel.
const MOUTH: f64 = 20.0;

/// A disc of flat diameter `diameter` between the inner edges of a band of width `band`, its mouth on +X.
pub fn disc(diameter: f64, band: f64) -> Path {
    let (r, h) = (f64::midpoint(diameter, band), HALF_MOUTH + band / 2.0);
    let turn = (h / r).asin();
    let (junction, end) = (r * turn.cos(), r + MOUTH);
    let line = |a: (f64, f64), b: (f64, f64)| -> Segment {
        Line::new(Point::new(a.0, a.1), Point::new(b.0, b.1)).into()
    };
    Path::open(vec![
        line((end, h), (junction, h)),
        Arc::new(Point::ORIGIN, r, turn, 2.0 * (PI - turn)).into(),
        line((junction, -h), (end, -h)),
    ])
}

/// The paper's single actuator: two arms of the star's width, one tip of its angle and radius, 4 W from the hinge to
/// the arms' straight ends, the mouth at the end of the upper arm. The hinge points along +X.
pub fn vee(star: &StarSpec, band: f64) -> Path {
    let (w, r, half) = (star.tube_width.0, star.tip_radius.0, star.tip_angle.rad() / 2.0);
    let delta = band / 2.0;
    let arm = 4.0 * w + delta;
    let (sin, cos) = half.sin_cos();
    // In the frame of an arm: away from the hinge, and outwards.
    let at = |side: f64, along: f64, out: f64| {
        Point::ORIGIN + Vec2::new(-cos, side * sin) * along + Vec2::new(sin, side * cos) * out
    };
    let (outer, inner) = (r + w + delta, r - delta);
    let (middle, h) = (r + w / 2.0, HALF_MOUTH + delta);
    // A sharp inner hinge is a vertex that eats into the arms.
    let eaten = (-inner).max(0.0) / half.tan();
    let mut points = vec![at(1.0, arm + MOUTH, middle + h), at(1.0, arm, middle + h), at(1.0, arm, outer)];
    let mut segments = lines(&points);
    segments.push(Line::new(at(1.0, arm, outer), at(1.0, 0.0, outer)).into());
    segments.push(Arc::new(Point::ORIGIN, outer, PI / 2.0 - half, 2.0 * half - PI).into());
    segments.extend(lines(&[
        at(-1.0, 0.0, outer),
        at(-1.0, arm, outer),
        at(-1.0, arm, inner),
        at(-1.0, eaten, inner),
    ]));
    if inner > 0.0 {
        segments.push(Arc::new(Point::ORIGIN, inner, half - PI / 2.0, PI - 2.0 * half).into());
    }
    points = vec![
        at(1.0, eaten, inner),
        at(1.0, arm, inner),
        at(1.0, arm, middle - h),
        at(1.0, arm + MOUTH, middle - h),
    ];
    segments.extend(lines(&points));
    Path::open(segments)
}

fn lines(points: &[Point]) -> Vec<Segment> {
    points.windows(2).map(|pair| Line::new(pair[0], pair[1]).into()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::{Angle, Length};

    #[test]
    fn a_disc_has_its_diameter_and_a_mouth() {
        let path = disc(100.0, 2.0);
        assert!(path.largest_gap() < 1e-9);
        assert!((path.bounds().height() - 102.0).abs() < 1e-9);
        assert!((path.start().expect("a path").y - (PI + 1.0)).abs() < 1e-12);
    }

    #[test]
    fn a_v_is_one_unbroken_line_as_wide_as_its_tube() {
        for radius in [0.0, 0.5, 3.0] {
            let star = StarSpec {
                points: 5,
                inner_radius: Length(50.0),
                tube_width: Length(30.0),
                tip_angle: Angle(30.0),
                tip_radius: Length(radius),
                corner_radius: Length(0.0),
                rotation: Angle(0.0),
                pitch: Length(40.0),
                inlet_tip: 1,
            };
            let path = vee(&star, 2.0);
            assert!(path.largest_gap() < 1e-9, "{radius}: {}", path.largest_gap());
            // Half way along an arm the two bands are a tube's width and a band apart.
            let out = Vec2::new(15_f64.to_radians().sin(), 15_f64.to_radians().cos());
            let middle = Point::ORIGIN + Vec2::new(-out.y, out.x) * 60.0 + out * (radius + 15.0);
            assert!((path.distance(middle) - 16.0).abs() < 1e-9, "{radius}");
        }
    }
}
