//! Separators: the paper covers the air, spares every band, and reaches the cut's edge through each port.

use std::f64::consts::PI;

use proptest::prelude::*;

use stargrip_cam::geom::{Arc, Enclosures, Line, Path, Point, Segment};
use stargrip_cam::sealed::{DrawnPort, PortPlace, Sealing, Separator, Sketch, sealed_shape};

use crate::shapes::blob;
use crate::sketches::{RULES, circle, drawn, open, p, port, rectangle, samples, scaled, sketch};

/// The separator of a sealed shape.
fn separator(sealing: &Sealing, creep: f64) -> Option<Separator> {
    sealing.air.separator(&sealing.shape, creep)
}

fn sealed(sketch: &Sketch) -> Sealing {
    sealed_shape(sketch, &RULES).unwrap_or_else(|faults| panic!("{faults:#?}"))
}

/// No edge of the paper lies in a band, nor nearer to one than the creep.
pub(crate) fn spares_the_bands(sealing: &Sealing, creep: f64) -> Result<(), TestCaseError> {
    let Some(paper) = separator(sealing, creep) else { return Ok(()) };
    let required = 0.5 * RULES.band + creep;
    for path in paper.pieces.iter().chain(&paper.windows) {
        prop_assert!(path.area() > 0.0 && path.largest_gap() < 1e-4);
        for at in samples(path) {
            let seams = sealing.shape.seams.iter().map(|seam| seam.center_line.distance(at));
            let nearest = seams.fold(f64::INFINITY, f64::min);
            prop_assert!(nearest > required - 1e-4, "{nearest} mm at {at:?}, {required} mm at least");
        }
    }
    Ok(())
}

#[test]
fn slivers_of_air_have_no_broken_paper() {
    // The port closes the line's own two ends, and the operations leave an edge with no paper in it.
    let sliver = sketch(
        vec![("", open(&[p(10.0, 40.0), p(0.0, 40.0)]))],
        vec![port(0.445_519_462_094_059_57, 41.311_750_531_621_94)],
    );
    if let Ok(sealing) = sealed_shape(&sliver, &RULES) {
        for creep in [0.0, 0.7] {
            spares_the_bands(&sealing, creep).expect("whole");
        }
    }
}

#[test]
fn the_paper_covers_all_that_no_band_takes() {
    let air = vec![("", rectangle(0.0, 0.0, 200.0, 100.0)), ("eye", circle(50.0, 50.0, 10.0))];
    let mut air_and_welds = sketch(air, vec![port(0.0, 50.0)]);
    air_and_welds.seams.push(drawn("spot", open(&[p(150.0, 30.0), p(150.0, 70.0)])));
    air_and_welds.seams.push(drawn("barrier", open(&[p(100.0, 0.0), p(100.0, 60.0)])));
    let sealing = sealed(&air_and_welds);
    for c in [0.0, 0.5, 2.0] {
        let paper = separator(&sealing, c).expect("a separator");
        assert_eq!((paper.pieces.len(), paper.windows.len()), (1, 2), "{c}");
        let h = 1.0 + c;
        let (spot, barrier) = (80.0 * h + PI * h * h, 2.0 * h * (60.0 - c) + 0.5 * PI * h * h);
        let tongue = (6.0 - 2.0 * c) * (10.0 + c);
        // At the start of the tongue the edge keeps its distance by an arc.
        let round = 2.0 * (1.0 - 0.25 * PI) * c * c;
        let right =
            round + (200.0 - 2.0 * c) * (100.0 - 2.0 * c) + tongue - PI * (10.0 + c).powi(2) - spot - barrier;
        assert!((paper.area() - right).abs() < 0.01, "{c}: {} mm2, not {right}", paper.area());
        // The tongue ends on the cut.
        assert!((paper.pieces[0].bounds().min.x + 10.0).abs() < 1e-9);
        spares_the_bands(&sealing, c).expect("clear");
    }
    // More than half of the hose's channel.
    assert_eq!(separator(&sealing, 3.1), None);
}

#[test]
fn every_chamber_has_its_own_piece() {
    let ports = || vec![port(0.0, 20.0), port(100.0, 20.0)];
    let wall = open(&[p(50.0, 0.0), p(50.0, 40.0)]);
    for air in [
        vec![("a", rectangle(0.0, 0.0, 100.0, 40.0)), ("w", wall)],
        vec![("a", rectangle(0.0, 0.0, 49.0, 40.0)), ("b", rectangle(51.0, 0.0, 49.0, 40.0))],
    ] {
        let paper = separator(&sealed(&sketch(air, ports())), 0.0).expect("a separator");
        assert_eq!((paper.pieces.len(), paper.windows.len()), (2, 0));
        for piece in &paper.pieces {
            assert!((piece.area() - 49.0 * 40.0 - 60.0).abs() < 0.01, "{}", piece.area());
        }
    }
}

/// A drawn cut is as far away as it likes: the tongue goes on to it.
#[test]
fn a_tongue_reaches_a_drawn_cut() {
    let mut wide_cut = sketch(vec![("", rectangle(0.0, 0.0, 60.0, 60.0))], vec![port(60.0, 30.0)]);
    wide_cut.cuts.push(drawn("cut", rectangle(-20.0, -20.0, 140.0, 100.0)));
    let paper = separator(&sealed(&wide_cut), 0.0).expect("a separator");
    assert!((paper.pieces[0].bounds().max.x - 120.0).abs() < 1e-9);
    assert!((paper.area() - 3600.0 - 6.0 * 60.0).abs() < 1e-3, "{}", paper.area());
    // The same from a drawn seam, whose air begins half a band inside: round where the tongue begins.
    let mut seam = Sketch { seams: vec![drawn("s", rectangle(-1.0, -1.0, 62.0, 62.0))], ..wide_cut };
    seam.air.clear();
    let of_seam = separator(&sealed(&seam), 0.0).expect("a separator");
    let round = 2.0 * (1.0 - 0.25 * PI);
    assert!((of_seam.area() - paper.area() - round).abs() < 1e-3, "{}", of_seam.area());
}

/// The way out of this port leads over the band of another side of the air.
#[test]
fn a_tongue_never_lies_on_another_band() {
    let corners = [p(40.0, 0.0), p(0.0, 20.0), p(40.0, 10.0), p(30.0, 40.0)];
    let arc = Arc::new(p(24.8985, 17.4746), 23.0958, 1.34808, -2.20620);
    let mut air = open(&corners);
    air.segments.push(Line::new(p(30.0, 40.0), arc.start()).into());
    air.segments.push(arc.into());
    air.segments.push(Line::new(arc.end(), p(40.0, 0.0)).into());
    let blob = sketch(vec![("a", Path { closed: true, ..air })], vec![port(35.928, 28.788)]);
    if let Ok(sealing) = sealed_shape(&blob, &RULES) {
        for creep in [0.0, 0.7] {
            spares_the_bands(&sealing, creep).expect("clear");
        }
    }
}

proptest! {
    #[test]
    fn a_separator_covers_the_air_and_no_band((blob, center) in blob(), scale in 4.0..8.0, creep in 0.0..1.5) {
        let outline = Path::closed(blob.segments.iter().map(|s| scaled(s, center, scale)).collect::<Vec<Segment>>());
        let island = circle(center.x, center.y, 4.0);
        let mut with_island = sketch(vec![("a", outline.clone()), ("i", island.clone())], vec![]);
        let mouth = outline.point_at(0.1 * outline.length()).unwrap();
        with_island.ports = vec![DrawnPort { name: String::new(), place: PortPlace::At(mouth) }];
        let Ok(sealing) = sealed_shape(&with_island, &RULES) else { return Ok(()) };
        spares_the_bands(&sealing, creep)?;
        let Some(paper) = separator(&sealing, creep) else { return Ok(()) };
        let enclosures = Enclosures::new([&outline, &island]);
        let covered = Enclosures::new(paper.pieces.iter().chain(&paper.windows));
        for i in 0..400 {
            let (x, y) = (f64::from(i % 20) / 10.0 - 1.0, f64::from(i / 20) / 10.0 - 1.0);
            let q = Point::new(center.x + 10.0 * scale * x, center.y + 10.0 * scale * y);
            let edge = outline.distance(q).min(island.distance(q));
            let is_air = enclosures.enclosing(q).len() == 1;
            let is_covered = covered.enclosing(q).len() == 1;
            if is_air && edge > creep + 1e-3 {
                prop_assert!(is_covered, "{q:?} is air and welds");
            } else if q.distance(mouth) > 40.0 {
                prop_assert!(!is_covered || edge > creep - 1e-3 && is_air, "{q:?} is no air and does not weld");
            }
        }
    }
}
