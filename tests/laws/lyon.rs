//! `geom` and the curves of the PDF against lines, arcs and Bézier curves that someone else wrote: lyon_geom in f64.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_6, PI};

use lyon_geom::{Angle, ArcFlags, CubicBezierSegment, LineSegment, SvgArc};
use proptest::prelude::*;
use stargrip_cam::design::{Drawing, Layer, Origin, PaperPage, Shape};
use stargrip_cam::emit::pdf;
use stargrip_cam::geom::{Arc, Bounds, Line, Path, Point, Segment, Vec2, intersections};

use crate::shapes::{arc, blob, close, line, point, segment};

fn lyon_point(p: Point) -> lyon_geom::Point<f64> {
    lyon_geom::point(p.x, p.y)
}

fn own_point(p: lyon_geom::Point<f64>) -> Point {
    Point::new(p.x, p.y)
}

fn their_line(line: &Line) -> LineSegment<f64> {
    LineSegment { from: lyon_point(line.start), to: lyon_point(line.end) }
}

fn their_arc(arc: &Arc) -> lyon_geom::Arc<f64> {
    lyon_geom::Arc {
        center: lyon_point(arc.center),
        radii: lyon_geom::vector(arc.radius, arc.radius),
        start_angle: Angle::radians(arc.start_angle),
        sweep_angle: Angle::radians(arc.sweep),
        x_rotation: Angle::zero(),
    }
}

/// Their flattening of a segment: the corners after its first point.
fn flattened(segment: &Segment, tolerance: f64) -> Vec<Point> {
    match segment {
        Segment::Line(line) => vec![line.end],
        Segment::Arc(arc) => their_arc(arc).flattened(tolerance).map(own_point).collect(),
    }
}

fn same_box(bounds: Bounds, lyon_box: lyon_geom::Box2D<f64>) -> Result<(), TestCaseError> {
    let differences = [
        bounds.min.x - lyon_box.min.x,
        bounds.min.y - lyon_box.min.y,
        bounds.max.x - lyon_box.max.x,
        bounds.max.y - lyon_box.max.y,
    ];
    prop_assert!(differences.iter().all(|d| d.abs() < 1e-12), "{:?} is not {:?}", bounds, lyon_box);
    Ok(())
}

proptest! {
    #[test]
    fn points_tangents_and_parts_of_an_arc(arc in arc(), t in 0.0..1.0, share in 0.0..1.0) {
        let (segment, lyon) = (Segment::from(arc), their_arc(&arc));
        for t in [0.0, t, 1.0] {
            close(segment.point(t).distance(own_point(lyon.sample(t))), 0.0, 1e-12)?;
            // Lyon's tangent is as long as the radius, and does not depend on the direction of travel.
            let tangent = lyon.sample_tangent(t) * (arc.sweep.signum() / arc.radius);
            close((segment.tangent(t) - Vec2::new(tangent.x, tangent.y)).length(), 0.0, 1e-12)?;
        }
        close(segment.end().distance(own_point(lyon.to())), 0.0, 1e-12)?;
        close(segment.reversed().point(t).distance(own_point(lyon.flip().sample(t))), 0.0, 1e-12)?;
        let (part, cut) = (segment.part(t * share, t), lyon.split_range(t * share..t));
        close(part.point(share).distance(own_point(cut.sample(share))), 0.0, 1e-12)?;
    }

    #[test]
    fn boxes(arc in arc(), line in line()) {
        same_box(Segment::from(arc).bounds(), their_arc(&arc).bounding_box())?;
        same_box(Segment::from(line).bounds(), their_line(&line).bounding_box())?;
    }

    #[test]
    fn lengths_areas_and_distances_of_their_flattening((path, _) in blob(), p in point(60.0)) {
        let tolerance = 1e-4;
        let corners: Vec<Point> = path.segments.iter().flat_map(|s| flattened(s, tolerance)).collect();
        let next = corners.iter().cycle().skip(1);
        let chords: Vec<Line> = corners.iter().zip(next).map(|(a, b)| Line::new(*a, *b)).collect();
        let (mut length, mut area, mut nearest) = (0.0, 0.0, f64::INFINITY);
        for chord in &chords {
            length += their_line(chord).length();
            area += 0.5 * (chord.start - Point::ORIGIN).cross(chord.end - Point::ORIGIN);
            nearest = their_line(chord).distance_to_point(lyon_point(p)).min(nearest);
            prop_assert!(path.distance(chord.start) < 1e-9 && path.distance(chord.start.midpoint(chord.end)) <= 1.001 * tolerance);
        }
        // A chord is shorter than its flat arc by 8/3 of the square of the sagitta over the chord.
        prop_assert!(length <= path.length() + 1e-9 && length >= path.length() - 1e-3, "{} {}", length, path.length());
        close(area, path.area(), tolerance * path.length())?;
        close(nearest, path.distance(p), 1.001 * tolerance)?;
    }

    #[test]
    fn an_arc_by_its_ends_as_svg_writes_it(arc in arc()) {
        // Near half a turn the large-arc flag decides by a rounding; next to a full turn the ends nearly coincide.
        prop_assume!((arc.sweep.abs() - PI).abs() > 1e-3 && arc.start().distance(arc.end()) > 0.05 * arc.radius);
        let flags = ArcFlags { large_arc: arc.sweep.abs() > PI, sweep: arc.is_ccw() };
        let radii = lyon_geom::vector(arc.radius, arc.radius);
        let svg = SvgArc { from: lyon_point(arc.start()), to: lyon_point(arc.end()), radii, x_rotation: Angle::zero(), flags };
        let (read, bulged) = (svg.to_arc(), Arc::from_bulge(arc.start(), arc.end(), arc.bulge()).unwrap());
        close(own_point(read.center).distance(bulged.center), 0.0, 1e-7 * arc.radius.max(1.0))?;
        // Theirs comes from an arctangent that is only good to 1e-4 (euclid's `fast_atan2`).
        close(read.sweep_angle.radians, bulged.sweep, 1e-3)?;
    }

    #[test]
    fn the_nearest_point_of_a_line_and_where_two_lines_cross(a in line(), b in line(), p in point(20.0)) {
        let segment = Segment::from(a);
        let nearest = segment.point(segment.nearest_fraction(p));
        close(nearest.distance(own_point(their_line(&a).closest_point(lyon_point(p)))), 0.0, 1e-9)?;
        close(segment.distance(p), their_line(&a).distance_to_point(lyon_point(p)), 1e-9)?;
        let (crossings, lyon_crossing) = (intersections(&segment, &b.into()), their_line(&a).intersection(&their_line(&b)));
        // Lines that meet at a hair's breadth, or nearly in line, are a matter of slack.
        let ends = [a.start, a.end].map(|p| Segment::from(b).distance(p)).into_iter()
            .chain([b.start, b.end].map(|p| segment.distance(p)));
        prop_assume!(ends.fold(f64::INFINITY, f64::min) > 1e-6 && a.direction().cross(b.direction()).abs() > 1e-6);
        prop_assert_eq!(crossings.len(), usize::from(lyon_crossing.is_some()));
        if let (Some(crossing), Some(lyon_crossing)) = (crossings.first(), lyon_crossing) {
            close(crossing.distance(own_point(lyon_crossing)), 0.0, 1e-7)?;
        }
    }

    #[test]
    fn a_segment_is_no_nearer_than_its_flattening(segment in segment(), p in point(30.0)) {
        let corners = flattened(&segment, 1e-5);
        let starts = std::iter::once(segment.start()).chain(corners.iter().copied());
        let nearest = starts.zip(&corners).map(|(a, b)| their_line(&Line::new(a, *b)).distance_to_point(lyon_point(p)));
        close(segment.distance(p), nearest.fold(f64::INFINITY, f64::min), 1.1e-5)?;
    }
}

/// The Bézier curves with which the PDF draws `arc`, read from the content of a page by their operators alone.
fn pdf_curves(arc: &Arc, size: f64) -> Vec<CubicBezierSegment<f64>> {
    let shapes = vec![Shape::Path(Path::open(vec![(*arc).into()]))];
    let layers = vec![(Layer::CutOutside, shapes)];
    let drawing = Drawing { origin: Origin::LowerLeft, width: size, height: size, layers };
    let window = Bounds { min: Point::ORIGIN, max: Point::new(size, size) };
    let bytes = pdf("arc", &[PaperPage { name: "A1".to_owned(), window, drawing }]);
    let text = String::from_utf8_lossy(&bytes);
    let mut pen = None;
    let mut curves = Vec::new();
    for row in text.lines() {
        let Some((numbers, operator)) = row.rsplit_once(' ') else { continue };
        let numbers: Vec<f64> = numbers.split(' ').filter_map(|word| word.parse().ok()).collect();
        match (operator, numbers.as_slice(), pen) {
            ("m", &[x, y], _) => pen = Some(lyon_geom::point(x, y)),
            ("c", &[ax, ay, bx, by, x, y], Some(from)) => {
                let to = lyon_geom::point(x, y);
                let (ctrl1, ctrl2) = (lyon_geom::point(ax, ay), lyon_geom::point(bx, by));
                curves.push(CubicBezierSegment { from, ctrl1, ctrl2, to });
                pen = Some(to);
            }
            _ => {}
        }
    }
    curves
}

/// The farthest that a curve leaves the circle of `arc`.
fn error(curve: &CubicBezierSegment<f64>, arc: &Arc) -> f64 {
    let error_at = |i: u32| own_point(curve.sample(f64::from(i) / 64.0)).distance(arc.center) - arc.radius;
    (0..=64).map(|i| error_at(i).abs()).fold(0.0, f64::max)
}

proptest! {
    #[test]
    fn the_curves_of_the_pdf_stay_on_the_circle(
        size in 20.0..8_000.0_f64, part in 0.001..0.5_f64, start in -7.0..7.0, sweep in prop_oneof![-6.2..-0.01, 0.01..6.2]
    ) {
        let arc = Arc::new(Point::new(size / 2.0, size / 2.0), part * size, start, sweep);
        let curves = pdf_curves(&arc, size);
        prop_assert_eq!(f64::from(u32::try_from(curves.len()).unwrap()), (sweep.abs() / FRAC_PI_6 - 1e-9).ceil());
        // Four decimals, then single precision.
        let rounding = 0.5e-4 * 2.0_f64.sqrt() + size * f64::from(f32::EPSILON);
        for curve in &curves {
            let deviation = error(curve, &arc);
            prop_assert!(deviation <= 4e-7 * arc.radius + rounding, "{} at {}", deviation, arc.radius);
        }
        // Pieces in order, each as long as its share, turning the same way.
        let length: f64 = curves.iter().map(|curve| curve.approximate_length(1e-6)).sum();
        close(length, arc.length(), 1e-4 * arc.length() + 4.0 * rounding * 13.0)?;
        close(own_point(curves[0].from).distance(arc.start()), 0.0, rounding)?;
        close(own_point(curves[curves.len() - 1].to).distance(arc.end()), 0.0, rounding)?;
    }
}

/// Errors of lyon's own curves, so that the figures in the documentation stay true: its arcs are cut at 90 degrees.
#[test]
fn our_curves_are_nearer_to_the_circle_than_theirs() {
    let worst = |arc: &Arc| {
        let mut largest = 0.0_f64;
        their_arc(arc).for_each_cubic_bezier(&mut |curve| largest = largest.max(error(curve, arc)));
        largest / arc.radius
    };
    let quarter = worst(&Arc::new(Point::ORIGIN, 50.0, 0.2, FRAC_PI_2));
    let twelfth = worst(&Arc::new(Point::ORIGIN, 50.0, 0.2, FRAC_PI_6));
    let large = Arc::new(Point::new(4000.0, 4000.0), 4000.0, 0.2, FRAC_PI_6);
    let pdf_error = pdf_curves(&large, 8000.0).iter().map(|curve| error(curve, &large)).fold(0.0, f64::max)
        / large.radius;
    println!(
        "error / radius: theirs at 90 deg {quarter:.2e}, at 30 deg {twelfth:.2e}, in the PDF {pdf_error:.2e}"
    );
    assert!((1.9e-3..2.1e-3).contains(&quarter), "{quarter}");
    assert!((2.4e-6..2.6e-6).contains(&twelfth), "{twelfth}");
    assert!(pdf_error < 4.5e-7, "{pdf_error}");
}
