//! Laws that hold for any drawing: accuracy of arcs, exactness of lines and circles, bounds on hostile input.

#![expect(
    clippy::cast_precision_loss,
    clippy::needless_for_each,
    reason = "knots are few, and written in a row"
)]

use std::f64::consts::{FRAC_PI_2, TAU};
use std::fmt::Write;

use artwork::{Artwork, Figure, Options, read_dxf, read_svg};
use geom::{Path, Point, Segment};
use proptest::prelude::*;

fn svg(body: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200mm\" height=\"100mm\" viewBox=\"0 0 200 100\">{body}</svg>"
    )
}

fn paths(drawing: &Artwork) -> Vec<&Path> {
    let mut found = Vec::new();
    for element in &drawing.elements {
        if let Figure::Path(path) = &element.figure {
            found.push(path);
        }
    }
    found
}

fn only(text: &str, tolerance: f64) -> Path {
    let drawing = read_svg(text.as_bytes(), &Options::new(tolerance)).expect(text);
    let [path] = paths(&drawing)[..] else { panic!("{drawing:?}") };
    path.clone()
}

fn distance(path: &Path, p: Point) -> f64 {
    path.segments.iter().map(|segment| segment.distance(p)).fold(f64::INFINITY, f64::min)
}

/// The largest distance of densely sampled points from the path, and of the path from their polygon.
fn deviation(path: &Path, points: &[Point]) -> f64 {
    let there = points.iter().map(|p| distance(path, *p)).fold(0.0, f64::max);
    let chord = |pair: &[Point], p: Point| {
        let (a, d) = (pair[0], pair[1] - pair[0]);
        let t = if d.dot(d) > 0.0 { ((p - a).dot(d) / d.dot(d)).clamp(0.0, 1.0) } else { 0.0 };
        a.lerp(pair[1], t).distance(p)
    };
    let near = |p: Point| points.windows(2).map(|pair| chord(pair, p)).fold(f64::INFINITY, f64::min);
    let own = path.segments.iter().flat_map(|s| (0..4).map(|i| s.point((f64::from(i) + 0.5) / 4.0)));
    own.map(near).fold(there, f64::max)
}

/// Largest angle between the tangents of neighbouring segments.
fn largest_kink(path: &Path) -> f64 {
    let kink = |pair: &[Segment]| pair[0].tangent(1.0).cross(pair[1].tangent(0.0)).abs();
    path.segments.windows(2).map(kink).fold(0.0, f64::max)
}

fn bezier(c: [Point; 4], t: f64) -> Point {
    let level = |a: Point, b: Point| a.lerp(b, t);
    let [p, q, r] = [level(c[0], c[1]), level(c[1], c[2]), level(c[2], c[3])];
    let [p, q] = [level(p, q), level(q, r)];
    level(p, q)
}

fn point() -> impl Strategy<Value = Point> {
    (0.0..200.0, 0.0..100.0).prop_map(|(x, y)| Point::new(x, y))
}

fn sampled(curve: impl Fn(f64) -> Point) -> Vec<Point> {
    (0..=2000).map(|i| curve(f64::from(i) / 2000.0)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn beziers_stay_within_the_tolerance(c in [point(), point(), point(), point()], exponent in 1..4) {
        let tolerance = 0.1_f64.powi(exponent);
        let [a, b, d, e] = c;
        let data = format!("M{} {}C{} {} {} {} {} {}", a.x, a.y, b.x, b.y, d.x, d.y, e.x, e.y);
        let path = only(&svg(&format!("<path d='{data}'/>")), tolerance);
        let up = c.map(|p| Point::new(p.x, 100.0 - p.y));
        let points = sampled(|t| bezier(up, t));
        // The polygon of the samples is itself 1e-4 mm off at most.
        prop_assert!(deviation(&path, &points) <= tolerance + 1e-4, "{} of {tolerance}", deviation(&path, &points));
        prop_assert!(path.largest_gap() < 1e-9, "{}", path.largest_gap());
    }

    #[test]
    fn ellipses_under_any_transform_stay_within_the_tolerance(
        m in prop::array::uniform4(-2.0..2.0_f64), rx in 0.1..50.0_f64, ry in 0.1..50.0_f64,
    ) {
        let [a, b, c, d] = m;
        let body = format!("<ellipse rx='{rx}' ry='{ry}' transform='matrix({a} {b} {c} {d} 10 20)'/>");
        let path = only(&svg(&body), 0.01);
        let points = sampled(|t| {
            let (sin, cos) = (t * TAU).sin_cos();
            Point::new(a * rx * cos + c * ry * sin + 10.0, 80.0 - (b * rx * cos + d * ry * sin))
        });
        prop_assert!(path.closed);
        prop_assert!(deviation(&path, &points) <= 0.01 + 1e-3, "{}", deviation(&path, &points));
    }

    #[test]
    fn similar_transforms_keep_arcs_and_scale_lengths(
        angle in -400.0..400.0_f64, scale in 0.01..20.0_f64, flip: bool, r in 0.1..50.0_f64, sweep in 0.01..6.2_f64,
    ) {
        let end = Point::polar(r, sweep);
        let large = u8::from(sweep > std::f64::consts::PI);
        let sign = if flip { -1.0 } else { 1.0 };
        let body = format!(
            "<g transform='rotate({angle} 3 4) scale({scale} {})'><path d='M{r} 0A{r} {r} 17 {large} 1 {} {}L0 0'/></g>",
            sign * scale, end.x, end.y
        );
        let path = only(&svg(&body), 0.01);
        prop_assert_eq!(path.segments.len(), 2);
        let Segment::Arc(arc) = path.segments[0] else { panic!("an arc") };
        prop_assert!((arc.radius - scale * r).abs() <= 1e-9 * scale * r);
        prop_assert!((path.length() - scale * r * (sweep + 1.0)).abs() <= 1e-6 * scale * r, "{}", path.length());
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let _ = read_svg(&bytes, &Options::new(0.01));
        let _ = read_dxf(&bytes, &Options::new(0.01));
    }

    #[test]
    fn any_groups_are_read_or_refused(groups in prop::collection::vec((0..80_i32, "[0-9.e-]{0,6}|LINE|ARC|SPLINE|INSERT|A"), 0..60)) {
        let mut text = "0\nSECTION\n2\nENTITIES\n".to_owned();
        for (code, value) in groups {
            writeln!(text, "{code}\n{value}").expect("a string");
        }
        text.push_str("0\nENDSEC\n0\nEOF\n");
        let unit = Some(artwork::Unit::Inch);
        let _ = read_dxf(text.as_bytes(), &Options { unit, ..Options::new(0.01) });
    }

    #[test]
    fn splines_stay_within_the_tolerance(
        points in prop::collection::vec(point(), 4..9), weights in prop::collection::vec(0.2..5.0_f64, 9), degree in 2..4_usize,
    ) {
        let off = off_spline(&points, &weights, degree);
        prop_assert!(off <= 0.02 + 2e-3, "{off}");
    }
}

/// How far a rational spline that ends at its first and last point is from the arcs that it is read as within 0.02 mm.
fn off_spline(points: &[Point], weights: &[f64], degree: usize) -> f64 {
    let n = points.len();
    let inner = n - degree;
    let knot = |i: usize| i.saturating_sub(degree).min(inner) as f64;
    let knots: Vec<f64> = (0..=n + degree).map(knot).collect();
    let mut text = format!("0\nSECTION\n2\nENTITIES\n0\nSPLINE\n5\n1\n8\na\n70\n4\n71\n{degree}\n");
    knots.iter().for_each(|k| writeln!(text, "40\n{k}").expect("a string"));
    weights[..n].iter().for_each(|w| writeln!(text, "41\n{w}").expect("a string"));
    points.iter().for_each(|p| writeln!(text, "10\n{}\n20\n{}\n30\n0", p.x, p.y).expect("a string"));
    text.push_str("0\nENDSEC\n0\nEOF\n");
    let options = Options { unit: Some(artwork::Unit::Millimetre), ..Options::new(0.02) };
    let drawing = read_dxf(text.as_bytes(), &options).expect("a spline");
    let curve = |t: f64| {
        let u = t * inner as f64;
        let weight = |i: usize| weights[i] * cox(&knots, i, degree, u, t == 1.0 && i == n - 1);
        let basis: Vec<f64> = (0..n).map(weight).collect();
        let sum: f64 = basis.iter().sum();
        let at = |f: fn(&Point) -> f64| points.iter().zip(&basis).map(|(p, b)| f(p) * b).sum::<f64>() / sum;
        Point::new(at(|p| p.x), at(|p| p.y))
    };
    deviation(paths(&drawing)[0], &sampled(curve))
}

/// It comes back from a place 0.026 mm beyond the end of a knot span, faster than it is sampled.
#[test]
fn a_spline_that_turns_shortly_before_an_end_stays_within_the_tolerance() {
    let points =
        [(0.0, 0.0), (0.0, 0.0), (14.4217, 43.81154), (87.03297, 13.85483), (81.34200, 16.40619), (0.0, 0.0)];
    let points = points.map(|(x, y)| Point::new(x, y));
    let off = off_spline(&points, &[0.2, 0.2, 3.48242, 2.49695, 0.43405, 0.2], 2);
    assert!(off <= 0.02 + 2e-3, "{off}");
}

/// The basis function of a B-spline by the recursion of Cox and de Boor.
fn cox(knots: &[f64], i: usize, degree: usize, u: f64, last: bool) -> f64 {
    if last {
        return 1.0;
    }
    if degree == 0 {
        return f64::from(u8::from(knots[i] <= u && u < knots[i + 1]));
    }
    let share = |a: f64, b: f64| if b > a { (u - a) / (b - a) } else { 0.0 };
    let (low, high) = (knots[i + degree], knots[i + degree + 1]);
    let rise = share(knots[i], low) * cox(knots, i, degree - 1, u, false);
    let fall = if high > knots[i + 1] { (high - u) / (high - knots[i + 1]) } else { 0.0 };
    rise + fall * cox(knots, i + 1, degree - 1, u, false)
}

#[test]
fn smooth_curves_have_no_kinks_and_few_arcs() {
    let wave = only(&svg("<path d='M0 50C40 0 60 100 100 50S160 100 200 50'/>"), 0.01);
    assert!(largest_kink(&wave) < 1e-3, "{}", largest_kink(&wave));
    assert!(wave.segments.len() <= 56, "{}", wave.segments.len());
    let ellipse = only(&svg("<ellipse cx='60' cy='50' rx='50' ry='20'/>"), 0.01);
    assert!(largest_kink(&ellipse) < 1e-9, "{}", largest_kink(&ellipse));
    assert!(ellipse.segments.len() <= 56, "{}", ellipse.segments.len());
    assert!((ellipse.length() - 230.131).abs() < 0.1, "{}", ellipse.length());
}

#[test]
fn circles_are_one_arc_and_quarter_beziers_one_arc_each() {
    let circle = only(&svg("<circle cx='60' cy='50' r='20' transform='rotate(30) scale(-0.5 .5)'/>"), 0.01);
    let [Segment::Arc(arc)] = circle.segments[..] else { panic!("{circle:?}") };
    assert!((arc.radius - 10.0).abs() < 1e-12 && arc.sweep.abs() == TAU);
    let k = 0.552_284_749_831 * 20.0;
    let quarter = only(&svg(&format!("<path d='M20 0C20 {k} {k} 20 0 20'/>")), 0.01);
    let [Segment::Arc(arc)] = quarter.segments[..] else { panic!("{quarter:?}") };
    assert!((arc.radius - 20.0).abs() < 1e-5 && (arc.sweep.abs() - FRAC_PI_2).abs() < 1e-9, "{arc:?}");
}

#[test]
fn cusps_loops_and_flat_curves_are_read() {
    let cases = [
        [(0.0, 0.0), (60.0, 60.0), (0.0, 60.0), (60.0, 0.0)], // a loop or a cusp
        [(0.0, 0.0), (40.0, 40.0), (0.0, 40.0), (40.0, 0.0)],
        [(10.0, 50.0), (90.0, 50.0), (-40.0, 50.0), (60.0, 50.0)], // there and back on a line
        [(10.0, 10.0), (10.0, 10.0), (50.0, 90.0), (50.0, 90.0)],  // handles on the ends
        [(10.0, 10.0), (90.0, 10.0), (90.0, 10.0), (10.0, 10.0)],  // ends meet
    ];
    for case in cases {
        let c = case.map(|(x, y)| Point::new(x, y));
        let [a, b, d, e] = c;
        let data = format!("M{} {}C{} {} {} {} {} {}", a.x, a.y, b.x, b.y, d.x, d.y, e.x, e.y);
        let path = only(&svg(&format!("<path d='{data}'/>")), 0.01);
        let points = sampled(|t| bezier(c.map(|p| Point::new(p.x, 100.0 - p.y)), t));
        assert!(deviation(&path, &points) <= 0.011, "{case:?}: {}", deviation(&path, &points));
        assert!(path.segments.len() < 80, "{case:?}: {}", path.segments.len());
    }
}

/// A side that rises by less than the tolerance is a line, from a millimetre to ten metres, and arcs of kilometres are chords.
#[test]
fn nearly_straight_curves_are_lines() {
    let dxf = |length: f64, bulge: f64| {
        format!(
            "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\na\n90\n2\n70\n0\n\
             10\n20\n20\n20\n42\n{bulge:.18}\n10\n{}\n20\n20\n0\nENDSEC\n0\nEOF\n",
            20.0 + length
        )
    };
    for length in [1.0, 200.0, 10_000.0] {
        // A bulge is twice the rise over the length.
        for rise in [1e-12, 1e-9, 1e-6, 2e-5] {
            let read = read_dxf(dxf(length, 2.0 * rise / length).as_bytes(), &Options::new(5e-4))
                .expect("a polyline");
            let drawn = [
                paths(&read)[0].clone(),
                only(
                    &svg(&format!(
                        "<path d='M20 20C{} {y} {} {y} {} 20'/>",
                        20.0 + length / 3.0,
                        20.0 + length / 1.5,
                        20.0 + length,
                        y = 20.0 + rise
                    )),
                    5e-4,
                ),
                only(
                    &svg(&format!(
                        "<path d='M20 20A{r} {r} 0 0 1 {} 20'/>",
                        20.0 + length,
                        r = length * length / (8.0 * rise)
                    )),
                    5e-4,
                ),
            ];
            for path in drawn {
                assert!(matches!(path.segments[..], [Segment::Line(_)]), "{length} {rise}: {path:?}");
                assert!((path.length() - length).abs() < 1e-6, "{length} {rise}: {path:?}");
            }
        }
        for rise in [1e-3, 0.01] {
            let read = read_dxf(dxf(length, 2.0 * rise / length).as_bytes(), &Options::new(5e-4))
                .expect("a polyline");
            let path = paths(&read)[0];
            let top = Point::new(20.0 + length / 2.0, 20.0 - rise);
            assert!(path.distance(top) < 5e-4 && path.largest_gap() < 1e-9, "{length} {rise}: {path:?}");
            let is_small = |segment: &Segment| !matches!(segment, Segment::Arc(arc) if arc.radius > 1e5);
            assert!(
                path.segments.iter().all(is_small) && path.segments.len() < 100,
                "{length} {rise}: {path:?}"
            );
        }
    }
}
