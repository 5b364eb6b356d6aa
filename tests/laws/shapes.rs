//! Random shapes for property tests.

use std::f64::consts::TAU;

use proptest::prelude::*;
use stargrip_cam::geom::{Arc, Line, Path, Point, Segment, Vec2};

/// A point at most `size` from the axes.
pub(crate) fn point(size: f64) -> impl Strategy<Value = Point> {
    (-size..size, -size..size).prop_map(|(x, y)| Point::new(x, y))
}

/// An arc of any direction, from next to nothing to next to a full circle, either way round.
pub(crate) fn arc() -> impl Strategy<Value = Arc> {
    (point(10.0), 0.01..20.0, -7.0..7.0, prop_oneof![-6.2..-0.01, 0.01..6.2])
        .prop_map(|(center, radius, start, sweep)| Arc::new(center, radius, start, sweep))
}

/// A line with a length.
pub(crate) fn line() -> impl Strategy<Value = Line> {
    (point(10.0), point(10.0))
        .prop_filter_map("a point", |(a, b)| (a.distance(b) > 0.01).then(|| Line::new(a, b)))
}

/// A line or an arc.
pub(crate) fn segment() -> impl Strategy<Value = Segment> {
    prop_oneof![line().prop_map(Segment::Line), arc().prop_map(Segment::Arc)]
}

/// Fails a property if `a` and `b` are further apart than `tolerance`.
pub(crate) fn close(a: f64, b: f64, tolerance: f64) -> Result<(), TestCaseError> {
    prop_assert!((a - b).abs() <= tolerance, "{} is not {} (+- {})", a, b, tolerance);
    Ok(())
}

/// A closed curve that is star-shaped about its centre: vertices at growing angles, joined by lines and flat arcs.
pub(crate) fn blob() -> impl Strategy<Value = (Path, Point)> {
    let vertices =
        proptest::collection::vec((5.0..10.0, prop_oneof![-0.15..-0.01, 0.01..0.15], any::<bool>()), 5..12);
    (vertices, -50.0..50.0, -50.0..50.0).prop_map(|(vertices, x, y)| {
        let center = Point::new(x, y);
        let step = TAU / f64::from(u32::try_from(vertices.len()).unwrap());
        let mut angle = 0.0;
        let corners: Vec<(Point, Option<f64>)> = vertices
            .iter()
            .map(|(radius, bulge, curved)| {
                angle += step;
                (center + Vec2::unit(angle) * *radius, curved.then_some(*bulge))
            })
            .collect();
        let next = corners.iter().skip(1).chain(&corners[..1]);
        let segments = corners.iter().zip(next).map(|((a, bulge), (b, _))| {
            let arc = bulge.and_then(|bulge| Arc::from_bulge(*a, *b, bulge));
            arc.map_or_else(|| Line::new(*a, *b).into(), Segment::Arc)
        });
        (Path::closed(segments.collect()), center)
    })
}
