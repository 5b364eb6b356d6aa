//! Drawings that leave their plane: the shape out of it, and measures in space against the exported mesh.

use crate::measures::{Drawn, drawing};
use stargrip_cam::forecast::drawn::chamber_prediction::PlaneAnswer;
use stargrip_cam::forecast::drawn::measures::MeasurePrediction;
use stargrip_cam::forecast::drawn::out_of_plane::SpaceQuantity;
use stargrip_cam::forecast::drawn::prediction::DrawnPrediction;
use stargrip_cam::forecast::drawn::text::text;
use stargrip_cam::forecast::drawn::{InflatedDrawing, inflate, inflate_out_of_plane};
use stargrip_cam::forecast::shell::Detail;
use stargrip_cam::shell::cases::{InflatedShape, Watch};

/// A pouch of 80 x 30 mm with a welded diamond across its middle, between whose tips and the corners measures go: nodes of every mesh.
fn hinge(kilopascals: &str) -> Drawn {
    drawing(
        "<rect x=\"60\" y=\"65\" width=\"80\" height=\"30\"/><path d=\"M90 80L100 69L110 80L100 91Z\"/>",
        "<path d=\"M60 76V84\"/>",
        "<path id=\"arm\" d=\"M60 65L90 80\"/><path id=\"other\" d=\"M110 80L140 65\"/>\
         <path id=\"fold\" d=\"M60 65L100 69L140 65L141 66\"/><circle id=\"tip\" cx=\"90\" cy=\"80\" r=\"1\"/>",
        kilopascals,
    )
}

fn out_of_plane(Drawn { spec, pieces }: &Drawn) -> InflatedDrawing {
    inflate_out_of_plane(spec, pieces, Detail::Coarse, &Watch::default())
        .unwrap_or_else(|why| panic!("{why:?}"))
}

fn by_name<'p>(prediction: &'p DrawnPrediction, name: &str) -> &'p MeasurePrediction {
    prediction.measures.iter().find(|measure| measure.measure == name).expect(name)
}

/// The position of the point at `place` of the flat `sheet`, mm.
fn position(sheet: &InflatedShape, place: [f64; 2]) -> [f64; 3] {
    let is_there = |k: &usize| (0..2).all(|axis| (1e3 * sheet.flat[*k][axis] - place[axis]).abs() < 1e-6);
    let point = (0..sheet.flat.len()).find(is_there).expect("a point of the mesh");
    sheet.points[point].map(|x| 1e3 * x)
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn length(a: [f64; 3]) -> f64 {
    a.iter().map(|x| x * x).sum::<f64>().sqrt()
}

#[track_caller]
fn assert_is(quantity: Option<SpaceQuantity>, expected: f64) {
    let quantity = quantity.expect("measured");
    assert!(
        (quantity.finest_mesh - expected).abs() < 1e-5 * expected.abs().max(1.0),
        "{quantity:?} {expected}"
    );
    assert!(
        (quantity.value - expected).abs() <= 1.0001 * quantity.mesh_error + 1e-5,
        "{quantity:?} {expected}"
    );
}

/// Measures in space are those of the exported mesh, read from its file.
#[test]
fn measures_out_of_the_plane_are_those_of_the_exported_sheets() {
    let sketch = hinge("14");
    let InflatedDrawing { prediction, shapes, lower_shapes, .. } = out_of_plane(&sketch);
    let chamber = &prediction.chambers[0];
    assert_ne!(chamber.plane, Some(PlaneAnswer::Stays), "{:?}", chamber.plane_eigenvalue);
    let shape = chamber.out_of_plane.as_ref().expect("asked for");
    let [energy, rise] = [shape.less_energy_mJ, shape.rise_mm].map(|value| value.expect("a shape"));
    assert!(energy.value > 0.0 && rise.value > 1.0, "{shape:?}");
    // The drawing counts y upwards from the bottom of the page.
    let places = [[60.0, 95.0], [90.0, 80.0], [110.0, 80.0], [140.0, 95.0]];
    let [corner, tip, other_tip, other_corner] = places.map(|place| position(&shapes[0], place));
    // Welds and rims join both sheets.
    assert_eq!((tip, corner), (position(&lower_shapes[0], places[1]), position(&lower_shapes[0], places[0])));
    let [arm, other] =
        ["arm", "other"].map(|name| by_name(&prediction, name).out_of_plane.expect("measured"));
    assert_is(arm.distance_mm, length(minus(tip, corner)));
    assert_is(other.distance_mm, length(minus(other_corner, other_tip)));
    let (first, second) = (minus(tip, corner), minus(other_corner, other_tip));
    let dot: f64 = first.iter().zip(second).map(|(a, b)| a * b).sum();
    assert_is(other.angle_deg, (dot / (length(first) * length(second))).acos().to_degrees());
    let tip_measure = by_name(&prediction, "tip").out_of_plane.expect("measured");
    assert_is(tip_measure.x_mm, tip[0]);
    assert_is(tip_measure.y_mm, tip[1]);
    assert_is(tip_measure.z_mm, tip[2]);
    assert_is(tip_measure.height_mm, 0.0);
    let page = text(&sketch.spec, &prediction, false);
    for line in ["  energy released outside it", "  rise of its middle surface", "other, angle out of plane"]
    {
        assert!(page.contains(line), "{page}");
    }
}

/// Only a shape that leaves its plane is followed, and only where that was asked for; nothing else changes.
#[test]
fn a_shape_is_followed_out_of_its_plane_when_asked() {
    let sketch = hinge("14");
    let inside = inflate(&sketch.spec, &sketch.pieces, Detail::Coarse, &Watch::default()).expect("a shell");
    assert_eq!(inside.prediction.chambers[0].out_of_plane, None);
    let mut outside = out_of_plane(&sketch).prediction;
    assert!(outside.chambers[0].out_of_plane.take().is_some());
    outside.measures.iter_mut().for_each(|measure| measure.out_of_plane = None);
    assert_eq!(outside, inside.prediction);
    let flat = hinge("0.02");
    let low_pressure = out_of_plane(&flat).prediction;
    let chamber = &low_pressure.chambers[0];
    assert_eq!((chamber.plane, &chamber.out_of_plane), (Some(PlaneAnswer::Stays), &None));
}

/// Plates hold the shape between them.
#[test]
fn plates_are_refused_out_of_the_plane() {
    let Drawn { mut spec, pieces } = hinge("14");
    let load = spec.load.as_mut().expect("a load");
    load.plates = Some(stargrip_cam::spec::units::Length(10.0));
    let refusal = inflate_out_of_plane(&spec, &pieces, Detail::Coarse, &Watch::default());
    let text = format!("{:?}", refusal.expect_err("plates"));
    assert!(text.contains("plates hold the shape between them"), "{text}");
}
