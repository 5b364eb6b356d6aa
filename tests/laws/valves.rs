//! Valves in the face of a chamber: a hole in one sheet, a flange off the bands, and no seam of the shape.

use std::f64::consts::PI;

use proptest::prelude::*;

use stargrip_cam::geom::{Isometry, Path, Vec2};
use stargrip_cam::sealed::{
    Rules, SealedShape, Sealing, ShapeCode, ShapeFault, Sketch, sealed_shape, separate,
};

use crate::sketches::{RULES, circle, drawn, open, p, port, rectangle, sketch};

/// An air of 100 x 60 mm without a port, with these valves.
fn cushion(valves: Vec<(&str, Path)>) -> Sketch {
    let valves = valves.into_iter().map(|(name, path)| drawn(name, path)).collect();
    Sketch { valves, ..sketch(vec![("r", rectangle(20.0, 20.0, 100.0, 60.0))], vec![]) }
}

fn sealed(sketch: &Sketch) -> Sealing {
    sealed_shape(sketch, &RULES).unwrap_or_else(|faults| panic!("{faults:#?}"))
}

fn faults(sketch: &Sketch) -> Vec<ShapeFault> {
    sealed_shape(sketch, &RULES).expect_err("faulty")
}

fn codes(sketch: &Sketch) -> Vec<ShapeCode> {
    faults(sketch).iter().map(|fault| fault.code).collect()
}

/// The valves of each chamber, and the area of each hole and flange.
fn areas(shape: &SealedShape) -> Vec<[f64; 2]> {
    let topology = shape.topology();
    assert_eq!(topology.leaks, []);
    let valves = topology.chambers.iter().flat_map(|chamber| &chamber.valves);
    valves.map(|valve| [&shape.valves[*valve].hole, &shape.valves[*valve].rim].map(Path::area)).collect()
}

fn close(areas: &[[f64; 2]], radii: [f64; 2]) {
    let [pair] = areas else { panic!("{areas:?}") };
    for (area, radius) in pair.iter().zip(radii) {
        assert!((area - PI * radius * radius).abs() < 1e-3, "{areas:?} {radii:?}");
    }
}

/// The ring around the hole is no seam: through both sheets it would close the valve.
#[test]
fn a_valve_is_the_mouth_of_its_chamber() {
    let sealing = sealed(&cushion(vec![("v", circle(70.0, 50.0, 3.0))]));
    close(&areas(&sealing.shape), [3.0, 13.0]);
    let seams: Vec<&str> = sealing.shape.seams.iter().map(|seam| seam.name.as_str()).collect();
    assert_eq!((seams, sealing.holes.len(), sealing.shape.ports.len()), (vec!["r"], 0, 0));
    // The paper of a heat press keeps the whole flange from the other sheet.
    let paper = sealing.air.separator(&sealing.shape, 0.0).expect("a separator");
    assert!((paper.area() - 6000.0).abs() < 1e-6 && paper.windows.is_empty(), "{}", paper.area());
    let motion = Isometry { rotation: 0.7, shift: Vec2::new(300.0, -40.0), ..Isometry::IDENTITY };
    close(&areas(&sealing.shape.moved(motion)), [3.0, 13.0]);
}

/// The rim may be drawn around the hole, in any order and direction.
#[test]
fn a_drawn_rim_counts_before_the_width_of_the_flange() {
    let curves = [("h", circle(60.0, 50.0, 4.0)), ("f", circle(60.0, 50.0, 9.0))];
    for i in 0..4 {
        let mut curves = curves.clone();
        curves[i % 2].1 = curves[i % 2].1.reversed();
        curves.rotate_left(i / 2);
        close(&areas(&sealed(&cushion(curves.to_vec())).shape), [4.0, 9.0]);
    }
}

#[test]
fn each_chamber_and_each_piece_has_a_valve_of_its_own() {
    let mut two = cushion(vec![("v", circle(45.0, 50.0, 3.0)), ("w", circle(95.0, 50.0, 3.0))]);
    two.seams.push(drawn("wall", open(&[p(70.0, 20.0), p(70.0, 80.0)])));
    let shape = sealed(&two).shape;
    let chambers = shape.topology().chambers;
    assert_eq!(chambers.len(), 2);
    for chamber in &chambers {
        assert!(chamber.ports.is_empty() && chamber.valves.len() == 1, "{chambers:?}");
    }
    let _ = two.valves.pop();
    let lacking = faults(&two);
    assert!(lacking.len() == 1 && lacking[0].code == ShapeCode::NoPort, "{lacking:#?}");
    assert!(lacking[0].place.x > 70.0, "{lacking:#?}");
    two.ports.push(port(120.0, 50.0));
    assert_eq!(sealed(&two).shape.topology().chambers.iter().map(|one| one.ports.len()).sum::<usize>(), 1);
    // Two pieces beside each other.
    let mut pair = cushion(vec![("v", circle(45.0, 50.0, 3.0)), ("w", circle(245.0, 50.0, 3.0))]);
    pair.air.push(drawn("s", rectangle(200.0, 20.0, 90.0, 60.0)));
    let pieces = separate(&pair, &RULES);
    assert_eq!(pieces.iter().map(|piece| sealed(piece).shape.valves.len()).collect::<Vec<_>>(), [1, 1]);
}

#[test]
fn a_misplaced_valve_is_a_fault_with_its_place() {
    let wrong = [ShapeCode::MisplacedValve];
    for hole in [circle(200.0, 50.0, 3.0), circle(140.0, 50.0, 3.0)] {
        assert!(codes(&cushion(vec![("v", hole)])).contains(&wrong[0]));
    }
    // On an island there is no air.
    let mut island = cushion(vec![("v", circle(70.0, 50.0, 3.0))]);
    island.air.push(drawn("i", circle(70.0, 50.0, 20.0)));
    island.ports.push(port(20.0, 50.0));
    assert_eq!(codes(&island), wrong);
    // A weld and an island within the flange, which no band of it touches.
    for (seam, air) in [(Some(circle(70.0, 50.0, 6.0)), None), (None, Some(circle(70.0, 43.0, 1.5)))] {
        let mut covered = cushion(vec![("h", circle(70.0, 50.0, 3.0)), ("f", circle(70.0, 50.0, 25.0))]);
        covered.seams.extend(seam.map(|path| drawn("w", path)));
        covered.air.extend(air.map(|path| drawn("i", path)));
        assert!(codes(&covered).contains(&wrong[0]), "{:#?}", faults(&covered));
    }
    let pair = cushion(vec![("v", circle(50.0, 50.0, 3.0)), ("w", circle(75.9, 50.0, 3.0))]);
    let overlap = faults(&pair);
    assert!(
        overlap.len() == 1 && overlap[0].code == wrong[0] && overlap[0].names == ["v", "w"],
        "{overlap:#?}"
    );
    assert!(
        sealed_shape(&cushion(vec![("v", circle(50.0, 50.0, 3.0)), ("w", circle(76.1, 50.0, 3.0))]), &RULES)
            .is_ok()
    );
    let three = [3.0, 5.0, 9.0].map(|radius| ("v", circle(70.0, 50.0, radius)));
    assert_eq!(codes(&cushion(three.to_vec())), [wrong[0], ShapeCode::NoPort]);
    let open = cushion(vec![("v", open(&[p(60.0, 50.0), p(70.0, 50.0), p(65.0, 55.0)]))]);
    assert!(codes(&open).contains(&ShapeCode::Gap) || codes(&open).contains(&ShapeCode::DanglingEnd));
}

proptest! {
    /// Exactly the valves whose flange stays in the air are taken, and the remedy holds.
    #[test]
    fn a_flange_keeps_off_the_edges(
        x in 20.0..120.0_f64,
        y in 20.0..80.0_f64,
        radius in 1.0..8.0_f64,
        flange in 0.5..20.0_f64,
        turn in 0.0..6.0_f64,
    ) {
        let rules = Rules { flange, ..RULES };
        let motion = Isometry::rotation(turn);
        let mut sketch = cushion(vec![("v", circle(x, y, radius))]);
        for curve in sketch.air.iter_mut().chain(&mut sketch.valves) {
            curve.path = motion.path(&curve.path);
        }
        let room = (x - 20.0).min(120.0 - x).min(y - 20.0).min(80.0 - y) - radius - flange;
        prop_assume!(room.abs() > 1e-3);
        match sealed_shape(&sketch, &rules) {
            Ok(sealing) => {
                prop_assert!(room > 0.0, "{room}");
                prop_assert_eq!(sealing.shape.topology().chambers[0].valves.len(), 1);
            }
            Err(faults) => {
                prop_assert!(room < 0.0, "{room}: {faults:?}");
                prop_assert_eq!(faults[0].code, ShapeCode::MisplacedValve);
                prop_assert!(faults[0].found < 1.0 && faults[0].allowed == 1.0, "{faults:?}");
            }
        }
    }
}
