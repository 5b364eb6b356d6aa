//! Arcs by end point and centre, as controllers check and trace them.

use std::f64::consts::TAU;

use crate::verify::read::gcode::ArcTolerance;
use inflatable::geom::{Arc, Point};

/// Turns below this are full circles: GRBL's `ARC_ANGULAR_TRAVEL_EPSILON`, rad.
const FULL_CIRCLE: f64 = 5e-7;

/// Up to this turn an arc is read as passing through both of its ends, rad.
const LARGEST_CHORDAL: f64 = 1.5 * std::f64::consts::PI;

/// The arc from `from` to `to` about `center`, or why a controller would refuse it (found, allowed).
///
/// Rounded words never give two equal radii. Controllers spread the difference along the arc; here the arc
/// passes through both ends and turns by the angle that they are apart seen from `center`. Up to 90 degrees
/// both agree to a fortieth of the difference, however short the chord. Near full circles, where the chord hardly
/// determines the radius, the mean radius is taken.
pub(super) fn arc(
    from: Point,
    to: Point,
    center: Point,
    ccw: bool,
    tolerance: &ArcTolerance,
) -> Result<Arc, (String, String)> {
    let (r1, r2) = (center.distance(from), center.distance(to));
    let difference = (r1 - r2).abs();
    let allowed = tolerance.free.max((tolerance.relative * r1.max(r2)).min(tolerance.limit));
    if difference > allowed || r1 <= 0.0 || r2 <= 0.0 {
        let found = format!("radius {r1:.4} mm at the start, {r2:.4} mm at the end");
        return Err((found, format!("radii > 0 that differ by at most {allowed:.4} mm")));
    }
    let (u, v) = (from - center, to - center);
    let sign = if ccw { 1.0 } else { -1.0 };
    let turn = sign * libm::atan2(u.cross(v), u.dot(v));
    let sweep = sign * if turn < FULL_CIRCLE { (turn + TAU).min(TAU) } else { turn };
    let chordal =
        Arc::from_bulge(from, to, libm::tan(sweep / 4.0)).filter(|_| sweep.abs() <= LARGEST_CHORDAL);
    Ok(chordal.unwrap_or_else(|| Arc::new(center, 0.5 * (r1 + r2), u.angle(), sweep)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::read::gcode::Dialect;

    fn round(p: Point) -> Point {
        Point::new((p.x * 1e3).round() / 1e3, (p.y * 1e3).round() / 1e3)
    }

    #[test]
    fn any_turn_and_size_both_ways() {
        for radius in [0.01, 0.5, 30.0, 2000.0] {
            for degrees in [5.0_f64, 90.0, 170.0, 180.0, 190.0, 355.0] {
                for sign in [1.0, -1.0] {
                    let exact = Arc::new(Point::new(7.0, -3.0), radius, 0.7, sign * degrees.to_radians());
                    let found =
                        arc(exact.start(), exact.end(), exact.center, sign > 0.0, &Dialect::GENERIC.arcs)
                            .unwrap();
                    assert!((found.sweep - exact.sweep).abs() < 1e-9, "{radius} {degrees}: {found:?}");
                    assert!((found.radius - radius).abs() < 1e-9 * radius.max(1.0));
                }
            }
        }
    }

    #[test]
    fn rounded_ends_stay_ends() {
        for degrees in [0.02_f64, 0.2, 30.0, 89.0, 180.0, 260.0] {
            let exact = Arc::new(Point::new(7.1234, -3.4321), 30.0, 0.7, degrees.to_radians());
            let (from, to) = (round(exact.start()), round(exact.end()));
            let found = arc(from, to, round(exact.center), true, &Dialect::GENERIC.arcs).unwrap();
            assert!(found.start().distance(from) < 1e-9 && found.end().distance(to) < 1e-9, "{degrees}");
            let middle = exact.at_angle(exact.start_angle + 0.5 * exact.sweep);
            let off = found.at_angle(found.start_angle + 0.5 * found.sweep).distance(middle);
            assert!(off < 0.0015, "{degrees}: {off}");
        }
    }

    #[test]
    fn full_circle_and_refusals() {
        let p = Point::new(1.0, 0.0);
        let circle = arc(p, p, Point::ORIGIN, false, &Dialect::GENERIC.arcs).unwrap();
        assert_eq!(circle.sweep, -TAU);
        let off = |dx: f64| arc(p, Point::new(0.0, 1.0 + dx), Point::ORIGIN, true, &Dialect::GENERIC.arcs);
        assert!(off(0.0049).is_ok() && off(0.0051).is_err());
        assert!(arc(p, p, p, true, &Dialect::GENERIC.arcs).is_err());
        let far = Point::new(100.0, 0.0);
        let big = |d: f64| arc(far, Point::new(0.0, 100.0 + d), Point::ORIGIN, true, &Dialect::GENERIC.arcs);
        assert!(big(0.027).is_ok() && big(0.029).is_err());
    }
}
