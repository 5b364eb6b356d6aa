//! Random shapes for property tests.

use std::f64::consts::TAU;

use proptest::prelude::*;
use stargrip_cam::geom::{Arc, Line, Path, Point, Segment, Vec2};

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
