//! Drawings that are mended, merged or refused, with the places.

use crate::sketches::{circle, open, p, polygon, port, rectangle, refused, samples, sealed, sketch};
use stargrip_cam::geom::{Arc, Path, Point, Segment};
use stargrip_cam::sealed::{ShapeCode, ShapeFault};
use std::f64::consts::TAU;

#[test]
fn gaps_and_doubles_are_mended_and_said() {
    let whole = sealed(&sketch(vec![("", rectangle(0.0, 0.0, 100.0, 60.0))], vec![port(50.0, 60.0)]));
    let lines = vec![
        ("a", open(&[p(0.0, 0.0), p(100.0, 0.0)])),
        ("b", open(&[p(0.0, 60.0), p(100.0, 60.0), p(100.0, 0.0)])),
        ("c", open(&[p(0.0, 60.0), p(0.0, 0.012)])),
        ("b", open(&[p(100.0, 0.0), p(100.0, 60.0), p(0.0, 60.0)])),
        ("d", open(&[p(0.0, 10.0), p(0.0, 50.0)])),
        ("e", open(&[p(7.0, 7.0), p(7.0, 7.0)])),
    ];
    let mended = sealed(&sketch(lines, vec![port(50.0, 60.0)]));
    let (a, b) = (&whole.shape.seams[0].center_line, &mended.shape.seams[0].center_line);
    assert!((a.length() - b.length()).abs() < 0.02, "{} {}", a.length(), b.length());
    assert!(samples(b).iter().all(|at| a.distance(*at) < 0.01));
    let said: Vec<&str> = mended.repairs.iter().map(|repair| repair.what.as_str()).collect();
    assert_eq!(said.len(), 4, "{said:?}");
    assert!(said[0].contains("no length in 'e'"), "{said:?}");
    assert!(said[1].contains("twice in 'b'") && said[2].contains("twice in 'c' and 'd'"), "{said:?}");
    assert!(said[3].starts_with("gap of 0.0120 mm"), "{said:?}");
}

#[test]
fn faults_have_their_places() {
    let only = |faults: &[ShapeFault]| -> (ShapeCode, Point, f64) {
        assert_eq!(faults.len(), 1, "{faults:#?}");
        (faults[0].code, faults[0].place, faults[0].found)
    };
    let is = |faults: &[ShapeFault], code: ShapeCode, place: Point, found: f64| {
        let (c, at, f) = only(faults);
        assert_eq!(c, code);
        assert!(at.distance(place) < 1e-6, "{at:?}");
        assert!((f.is_nan() && found.is_nan()) || (f - found).abs() < 1e-9, "{f}");
    };
    let with = |air: Vec<(&str, Path)>| refused(&sketch(air, vec![port(50.0, 60.0)]));
    let box_ = || rectangle(0.0, 0.0, 100.0, 60.0);
    let gap = open(&[p(0.0, 0.0), p(100.0, 0.0), p(100.0, 60.0), p(0.0, 60.0), p(0.0, 0.4)]);
    let faults = with(vec![("a", gap)]);
    let (code, _, found) = only(&faults);
    assert!(
        code == ShapeCode::Gap && (found - 0.4).abs() < 1e-9 && faults[0].remedy.contains("0.4 mm"),
        "{faults:?}"
    );
    is(
        &with(vec![("a", box_()), ("b", open(&[p(0.0, 30.0), p(50.0, 30.0)]))]),
        ShapeCode::DanglingEnd,
        p(50.0, 30.0),
        f64::NAN,
    );
    let crossed = with(vec![("a", box_()), ("b", rectangle(80.0, 20.0, 100.0, 20.0))]);
    assert!(
        crossed.len() == 2
            && crossed.iter().all(|f| f.code == ShapeCode::Crossing && (f.place.x - 100.0).abs() < 1e-9),
        "{crossed:#?}"
    );
    let nested =
        with(vec![("a", box_()), ("b", rectangle(20.0, 20.0, 40.0, 20.0)), ("c", circle(40.0, 30.0, 5.0))]);
    assert_eq!(only(&nested).0, ShapeCode::NestedIsland);
    // An island 1.5 mm wide: its own fabric is too narrow for two bands.
    let slim = with(vec![("a", box_()), ("s", rectangle(30.0, 30.0, 1.5, 20.0))]);
    assert!(
        slim.iter()
            .any(|f| f.code == ShapeCode::BandsOverlap && (f.found - 1.5).abs() < 1e-9 && f.names == ["s"]),
        "{slim:#?}"
    );
    let dot = with(vec![("a", box_()), ("s", circle(30.0, 30.0, 0.8))]);
    is(&dot, ShapeCode::NoRoom, p(30.0, 30.0), 1.6);
    // Two chambers 3 mm apart: neither a wall nor room for two bands.
    let close = refused(&sketch(
        vec![("a", rectangle(0.0, 0.0, 40.0, 40.0)), ("b", rectangle(43.0, 0.0, 40.0, 40.0))],
        vec![port(0.0, 20.0), port(83.0, 20.0)],
    ));
    let (code, at, found) = only(&close);
    assert!(code == ShapeCode::BandsOverlap && (at.x - 41.5).abs() < 1e-9 && (found - 3.0).abs() < 1e-9);
    is(
        &with(vec![("a", rectangle(0.0, 0.0, 100.0, 60.0)), ("i", rectangle(3.0, 25.0, 40.0, 10.0))]),
        ShapeCode::NarrowTube,
        p(1.5, 30.0),
        3.0,
    );
    let closed = refused(&sketch(vec![("a", box_())], vec![]));
    // In the middle of the air, not on a band.
    let (code, at, _) = only(&closed);
    let band = box_().distance(at);
    assert!(code == ShapeCode::NoPort && band > 10.0, "{at:?} is {band} mm from the edge");
    let lost = refused(&sketch(vec![("a", box_())], vec![port(50.0, 60.0), port(50.0, 90.0)]));
    is(&lost, ShapeCode::LostPort, p(50.0, 90.0), 30.0);
}

/// Copies cost little. What would take minutes is refused, at a place.
#[test]
fn crowds_of_curves_are_merged_or_refused() {
    let many =
        |count: u32, path: &dyn Fn(f64) -> Path| (0..count).map(|i| ("", path(f64::from(i)))).collect();
    let copies = sealed(&sketch(many(20_000, &|_| circle(0.0, 0.0, 50.0)), vec![port(50.0, 0.0)]));
    assert_eq!((copies.shape.seams.len(), copies.repairs.len()), (1, 19_999));
    let ring = |i: f64| p(5.0 * (i * TAU / 2e4).cos(), 5.0 * (i * TAU / 2e4).sin());
    let fine: Vec<Point> = (0..20_000).map(|i| ring(f64::from(i))).collect();
    for crowd in [
        many(6_000, &|i| circle(0.0, 0.0, 50.0 + 0.1 * i)),
        many(6_000, &|i| circle(0.001 * i, 0.0, 50.0)),
        many(10_000, &|i| open(&[p(0.0, 0.0), ring(i)])),
        vec![("", polygon(&fine))],
    ] {
        let faults = refused(&sketch(crowd, vec![port(50.0, 0.0)]));
        assert!(faults.iter().any(|fault| fault.code == ShapeCode::Crowded), "{faults:?}");
    }
}

/// A slot as wide as the band whose mouth has a kink is sealed once.
#[test]
fn a_kinked_slot_is_one_wall() {
    for (aside, along) in [(1e-6, 1e-3), (-1e-6, 1e-3), (1e-4, 0.01), (-1e-4, 0.01)] {
        for width in [1.99, 2.0, 2.005, 2.015] {
            let (a, b) = (30.0, 30.0 + width);
            let mouth = [p(b + aside, 40.0), p(b, 40.0 - along), p(b, 15.0), p(a, 15.0), p(a, 40.0)];
            let corners = [&[p(0.0, 0.0), p(60.0, 0.0), p(60.0, 40.0)][..], &mouth, &[p(0.0, 40.0)]].concat();
            let sealing = sealed(&sketch(vec![("a", polygon(&corners))], vec![port(0.0, 20.0)]));
            let counts = (sealing.shape.seams.len(), sealing.inner.len());
            assert_eq!(counts, (2, 1), "{aside} {along} {width}");
        }
    }
}

/// Sketches of plain data are treated as those of files: an arc of kilometres is its chords.
#[test]
fn an_arc_of_kilometres_is_its_chords() {
    for radius in [2e5, 5e6, 1e9] {
        let mut air = rectangle(20.0, 20.0, 100.0, 60.0);
        let [start, end] = [air.segments[2].start(), air.segments[2].end()];
        air.segments[2] = Arc::from_bulge(start, end, 25.0 / radius).expect("an arc").into();
        let sealing = sealed(&sketch(vec![("a", air)], vec![port(20.0, 50.0)]));
        let rise = 100.0 * 100.0 / (8.0 * radius);
        for seam in &sealing.shape.seams {
            let arcs = seam.center_line.segments.iter().filter(|segment| matches!(segment, Segment::Arc(_)));
            assert!(arcs.map(Segment::length).all(|length| length < 2.0), "{radius}: {:?}", seam.center_line);
            let top = seam.center_line.bounds().max.y;
            assert!((top - 81.0 - rise).abs() < 1e-3, "{radius}: {top}");
        }
    }
}

/// Between its sides the iron seals nothing of a slit that is narrower than the band.
#[test]
fn a_narrow_slit_is_told_with_its_depth() {
    for (mouth, unsealed) in [(1.8, 19.44), (3.0, 9.95)] {
        let sides = [50.0 - mouth / 2.0, 50.0 + mouth / 2.0];
        let slit = [p(sides[1], 60.0), p(50.4, 40.0), p(49.6, 40.0), p(sides[0], 60.0)];
        let corners = [[p(0.0, 60.0), p(0.0, 0.0), p(100.0, 0.0), p(100.0, 60.0)], slit].concat();
        let sealing = sealed(&sketch(vec![("a", polygon(&corners))], vec![port(0.0, 30.0)]));
        let sharp: Vec<&ShapeFault> =
            sealing.warnings.iter().filter(|warning| warning.code == ShapeCode::SharpCorner).collect();
        let [one] = sharp[..] else { panic!("{sharp:?}") };
        assert!(one.place.y == 40.0 && (one.found - unsealed).abs() < 0.02, "{one:?}");
    }
}
