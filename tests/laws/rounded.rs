//! The rounding of a drawing decides nothing: sides that are parallel but for it, spots of any number of segments, steps as short as it.

use std::f64::consts::TAU;

use stargrip_cam::geom::{Arc, Line, Path, Point, Vec2};
use stargrip_cam::sealed::{Role, ShapeCode, Sketch, sealed_shape};

use crate::sketches::{RULES, circle, drawn, open, p, polygon, port, rectangle, sketch};

/// How much wider one end of a narrow part is than the other, mm.
const TAPERS: [f64; 9] = [0.0, 1e-6, -1e-6, 5e-4, -5e-4, 0.004, -0.004, 0.015, -0.015];

fn codes(sketch: &Sketch) -> Vec<ShapeCode> {
    let faults = sealed_shape(sketch, &RULES).err().unwrap_or_default();
    faults.iter().map(|fault| fault.code).collect()
}

/// A part of 2.6 mm between parallel sides, whose end at `x` = 80 is wider by `taper`, from `x` = 50 on.
fn sides(taper: f64) -> [Point; 4] {
    let (half, end) = (1.3, 1.3 + taper / 2.0);
    [p(50.0, 30.0 - half), p(80.0, 30.0 - end), p(80.0, 30.0 + end), p(50.0, 30.0 + half)]
}

#[test]
fn slits_islands_and_fingers_are_narrow_whatever_the_rounding() {
    for taper in TAPERS {
        let [a, b, c, d] = sides(taper);
        let slit = polygon(&[p(0.0, 0.0), p(80.0, 0.0), b, a, d, c, p(80.0, 60.0), p(0.0, 60.0)]);
        let slit = sketch(vec![("r", slit)], vec![port(0.0, 30.0)]);
        assert_eq!(codes(&slit), [ShapeCode::BandsOverlap], "slit, {taper}");
        let island = vec![("r", rectangle(0.0, 0.0, 100.0, 60.0)), ("i", polygon(&[a, b, c, d]))];
        let island = sketch(island, vec![port(0.0, 30.0)]);
        assert_eq!(codes(&island), [ShapeCode::BandsOverlap], "island, {taper}");
        let finger = polygon(&[p(0.0, 0.0), p(50.0, 0.0), a, b, c, d, p(50.0, 60.0), p(0.0, 60.0)]);
        let finger = sketch(vec![("r", finger)], vec![port(0.0, 30.0)]);
        assert_eq!(codes(&finger), [ShapeCode::NarrowTube], "finger, {taper}");
    }
}

/// An island between two arcs around centres that are as far from each other as rounding moves them.
#[test]
fn a_bent_island_is_narrow_whatever_the_rounding() {
    for shift in [0.0, 1e-6, -1e-6, 1e-3, -1e-3, 0.01, -0.01] {
        for side in [Vec2::new(0.0, 1.0), Vec2::new(1.0, 0.0)] {
            let inner = Arc::new(p(60.0, 20.0), 20.0, 0.4, 2.0);
            let outer = Arc::new(p(60.0, 20.0) + side * shift, 22.6, 2.4, -2.0);
            let ends = [Line::new(inner.end(), outer.start()), Line::new(outer.end(), inner.start())];
            let island = vec![inner.into(), ends[0].into(), outer.into(), ends[1].into()];
            let air = vec![("r", rectangle(0.0, 0.0, 120.0, 60.0)), ("i", Path::closed(island))];
            assert_eq!(codes(&sketch(air, vec![port(0.0, 30.0)])), [ShapeCode::BandsOverlap], "{shift}");
        }
    }
}

/// A spot narrower than two bands, of so many arcs or lines between places rounded to 0.001 mm.
fn spot(diameter: f64, count: u32, has_arcs: bool) -> Path {
    let places: Vec<Point> = (0..count)
        .map(|i| p(60.0, 30.0) + Vec2::unit(0.3 + TAU * f64::from(i) / f64::from(count)) * (diameter / 2.0))
        .map(|place| p((place.x * 1e3).round() / 1e3, (place.y * 1e3).round() / 1e3))
        .collect();
    if !has_arcs {
        return polygon(&places);
    }
    let bulge = (TAU / f64::from(count) / 4.0).tan();
    let ends = places.iter().zip(places.iter().cycle().skip(1));
    let arcs = ends.map(|(a, b)| Arc::from_bulge(*a, *b, bulge).expect("an arc").into());
    Path::closed(arcs.collect())
}

#[test]
fn a_spot_is_sealed_however_it_is_drawn() {
    for diameter in [2.2, 3.0, 3.8, 4.2] {
        let arcs = [2, 3, 4, 5, 6, 8, 12].map(|count| (count, true));
        for (count, has_arcs) in arcs.into_iter().chain([12, 13, 24, 25, 71, 72].map(|count| (count, false)))
        {
            let air = vec![("r", rectangle(0.0, 0.0, 100.0, 60.0)), ("i", spot(diameter, count, has_arcs))];
            let sealing = sealed_shape(&sketch(air, vec![port(0.0, 30.0)]), &RULES);
            let sealing =
                sealing.unwrap_or_else(|faults| panic!("{diameter} mm of {count}, {has_arcs}: {faults:#?}"));
            assert_eq!(sealing.shape.seams.len(), 2, "{diameter} mm of {count}, {has_arcs}");
        }
    }
}

/// A spot hardly wider than one band has no centre line that a program could follow.
#[test]
fn a_spot_of_one_band_has_no_room() {
    for diameter in [2.001, 2.01, 2.03, 2.06] {
        let air = vec![("r", rectangle(0.0, 0.0, 100.0, 60.0)), ("i", spot(diameter, 4, true))];
        assert_eq!(codes(&sketch(air, vec![port(0.0, 30.0)])), [ShapeCode::NoRoom], "{diameter} mm");
        let pillow = sketch(vec![("r", rectangle(0.0, 0.0, 100.0, 60.0))], vec![port(0.0, 30.0)]);
        let point = Sketch { seams: vec![drawn("w", circle(60.0, 30.0, diameter / 2.0 - 1.0))], ..pillow };
        assert_eq!(codes(&point), [ShapeCode::NoRoom], "a seam of {} mm", diameter - 2.0);
    }
    let air = vec![("r", rectangle(0.0, 0.0, 100.0, 60.0)), ("i", spot(2.07, 4, true))];
    assert!(sealed_shape(&sketch(air, vec![port(0.0, 30.0)]), &RULES).is_ok(), "0.07 mm more are enough");
}

/// A weld whose points are rounded to 0.01 mm is one, with steps of 0.012 mm too.
#[test]
fn a_weld_may_have_steps_as_short_as_the_rounding() {
    for turn in 0..12 {
        for step in [0.012, 0.02, 0.05] {
            let way = Vec2::unit(0.13 + f64::from(turn) * TAU / 12.0);
            let mut points: Vec<Point> = Vec::new();
            for i in 0..600 {
                let station = step * f64::from(i) - step * 300.0;
                let place = p(50.0, 30.0) + way * station + way.perp() * (0.3 * (station * 0.8).sin());
                let place = p((place.x * 100.0).round() / 100.0, (place.y * 100.0).round() / 100.0);
                if points.last() != Some(&place) {
                    points.push(place);
                }
            }
            let pillow = sketch(vec![("r", rectangle(0.0, 0.0, 100.0, 60.0))], vec![port(0.0, 30.0)]);
            let sealing = sealed_shape(&Sketch { seams: vec![drawn("w", open(&points))], ..pillow }, &RULES);
            let sealing = sealing.unwrap_or_else(|faults| panic!("{turn} {step}: {faults:#?}"));
            let welds = sealing.shape.seams.iter().filter(|seam| seam.role == Role::Weld);
            assert_eq!(welds.count(), 1, "{turn} {step}");
        }
    }
}

/// An island one band wide, whose sides are steps of 0.05 to 0.2 mm between places rounded to 0.0001 mm, is sealed once along its
/// middle or refused as crossing itself; it panicked.
#[test]
fn an_island_of_one_band_of_short_steps_has_an_answer() {
    for turn in 0..8 {
        for steps in [40, 20, 13, 10] {
            let way = Vec2::unit(0.3 + f64::from(turn) * TAU / 8.0);
            let corners = [(-8.0, -1.0), (8.0, -1.0), (8.0, 1.0), (-8.0, 1.0)]
                .map(|(x, y)| p(50.0, 30.0) + way * x + way.perp() * y);
            let sides = corners.iter().zip(corners.iter().cycle().skip(1));
            let points: Vec<Point> = sides
                .zip([8 * steps, steps, 8 * steps, steps])
                .flat_map(|((a, b), count)| {
                    (0..count).map(move |i| a.lerp(*b, f64::from(i) / f64::from(count)))
                })
                .map(|place| p((place.x * 1e4).round() / 1e4, (place.y * 1e4).round() / 1e4))
                .collect();
            let air = vec![("r", rectangle(0.0, 0.0, 100.0, 60.0)), ("i", polygon(&points))];
            match sealed_shape(&sketch(air, vec![port(0.0, 30.0)]), &RULES) {
                Ok(sealing) => assert_eq!(sealing.shape.seams.len(), 2, "{turn} {steps}"),
                Err(faults) => assert_eq!(faults[0].code, ShapeCode::Crossing, "{turn} {steps}"),
            }
        }
    }
}

/// A weld may end on a corner of the fabric: from there it goes on to the centre line, which keeps farther off than half a band.
#[test]
fn a_weld_may_end_on_a_corner_of_the_fabric() {
    for count in [3, 4, 6, 8, 12, 40] {
        let corner = |i: u32| p(60.0, 30.0) + Vec2::unit(TAU * f64::from(i) / f64::from(count)) * 8.0;
        let island = polygon(&(0..count).map(corner).collect::<Vec<_>>());
        let notch = [
            p(0.0, 0.0),
            p(100.0, 0.0),
            p(100.0, 20.0),
            p(80.0, 30.0),
            p(100.0, 40.0),
            p(100.0, 60.0),
            p(0.0, 60.0),
        ];
        let air = vec![("r", polygon(&notch)), ("i", island)];
        let weld = drawn("w", open(&[p(80.0, 30.0), p(68.0, 30.0)]));
        let sketch = Sketch { seams: vec![weld], ..sketch(air, vec![port(0.0, 30.0)]) };
        let sealing = sealed_shape(&sketch, &RULES).unwrap_or_else(|faults| panic!("{count}: {faults:#?}"));
        assert_eq!(sealing.shape.seams.len(), 3, "{count}");
        assert_eq!(sealing.shape.topology().leaks, [], "{count}");
    }
}

/// A closed seam that is hardly more than a line is refused with a width below the one that is allowed, however it is turned.
#[test]
fn a_closed_seam_is_refused_by_the_width_of_its_loop() {
    for turn in [0.0, 0.8] {
        let (way, middle) = (Vec2::unit(turn), p(50.0, 30.0));
        let corners = [(-5.0, -0.015), (5.0, -0.015), (5.0, 0.015), (-5.0, 0.015)]
            .map(|(x, y)| middle + way * x + way.perp() * y);
        let sketch = Sketch {
            seams: vec![drawn("w", polygon(&corners))],
            ..sketch(vec![("r", rectangle(0.0, 0.0, 100.0, 60.0))], vec![port(0.0, 30.0)])
        };
        let faults = sealed_shape(&sketch, &RULES).expect_err("too narrow");
        // Four times 10 x 0.03 mm^2 by 20.06 mm.
        let width = faults.iter().find(|fault| fault.code == ShapeCode::NoRoom).map(|fault| fault.found);
        assert!(width.is_some_and(|width| (width - 0.05982).abs() < 1e-5), "{turn}: {faults:#?}");
    }
}
