//! Welds that are drawn, thin hoses, and sketches with numbers that are none.

use crate::sketches::{RULES, drawn, open, p, polygon, port, rectangle, refused, sealed, sketch};
use stargrip_cam::geom::{Arc, Line, Path, Point, Segment, Vec2};
use stargrip_cam::sealed::{Role, Rules, ShapeCode, Sketch, sealed_shape};

#[test]
fn what_is_no_number_or_far_away_is_refused() {
    for x in [f64::NAN, f64::INFINITY, 1e9] {
        let faults = refused(&sketch(vec![("far", rectangle(0.0, 0.0, x, 10.0))], vec![port(0.0, 5.0)]));
        assert!(
            faults.iter().any(|fault| fault.code == ShapeCode::NotFinite && fault.names == ["far"]),
            "{faults:?}"
        );
    }
    assert!(refused(&Sketch::default()).iter().any(|fault| fault.code == ShapeCode::Empty));
}

/// Straight and bent welds of steps from a fortieth of the band up, drawn as one curve or as lines that meet.
#[test]
fn a_weld_may_have_steps_of_any_length() {
    for (step, count) in [(0.005, 1600), (0.05, 160), (0.085, 94), (0.3, 27), (0.35, 23), (2.0, 4)] {
        for bend in [0.0, 0.05, -0.2] {
            let mut points = vec![p(40.0, 30.0)];
            for i in 0..count {
                points.push(points[points.len() - 1] + Vec2::unit(bend * step * f64::from(i)) * step);
            }
            let whole = vec![drawn("w", open(&points))];
            let chain = points.windows(2).map(|ends| drawn("w", open(ends))).collect();
            for seams in [whole, chain] {
                let pillow = sketch(vec![("r", rectangle(0.0, 0.0, 100.0, 60.0))], vec![port(0.0, 30.0)]);
                let sealing = sealed(&Sketch { seams, ..pillow });
                let welds: Vec<_> =
                    sealing.shape.seams.iter().filter(|seam| seam.role == Role::Weld).collect();
                let [weld] = welds[..] else { panic!("{step} {bend}: {} welds", welds.len()) };
                assert!((weld.center_line.length() - step * f64::from(count)).abs() < 1e-6, "{step} {bend}");
            }
        }
    }
}

/// A cross and a grid in the air.
#[test]
fn welds_that_cross_are_split_there() {
    let with = |lines: &[[(f64, f64); 2]]| {
        let pillow = sketch(vec![("r", rectangle(0.0, 0.0, 100.0, 60.0))], vec![port(0.0, 30.0)]);
        let seam = |[a, b]: &[(f64, f64); 2]| drawn("w", open(&[p(a.0, a.1), p(b.0, b.1)]));
        Sketch { seams: lines.iter().map(seam).collect(), ..pillow }
    };
    let cross = sealed(&with(&[[(40.0, 30.0), (70.0, 30.0)], [(55.0, 15.0), (52.0, 45.0)]]));
    assert_eq!((cross.shape.seams.len(), cross.repairs.len()), (5, 1), "{:?}", cross.repairs);
    assert_eq!(cross.shape.topology().chambers.len(), 1);
    // Two welds across two others close a chamber without a port.
    let grid = [
        [(35.0, 20.0), (75.0, 20.0)],
        [(35.0, 40.0), (75.0, 40.0)],
        [(45.0, 12.0), (45.0, 48.0)],
        [(65.0, 12.0), (65.0, 48.0)],
    ];
    let faults = refused(&with(&grid));
    assert!(faults.iter().all(|fault| fault.code == ShapeCode::NoPort) && faults.len() == 1, "{faults:?}");
    // So does one that crosses itself, whether it goes on or ends there.
    for last in [10.0, 30.0] {
        let points = [p(40.0, 30.0), p(70.0, 30.0), p(70.0, 45.0), p(55.0, 45.0), p(55.0, last)];
        let crossing = Sketch { seams: vec![drawn("w", open(&points))], ..with(&[]) };
        let faults = refused(&crossing);
        assert!(
            faults.iter().all(|fault| fault.code == ShapeCode::NoPort) && faults.len() == 1,
            "{faults:?}"
        );
    }
}

/// A side that departs from its chord by `arrow` mm.
fn bulging_side(start: Point, end: Point, arrow: f64) -> Segment {
    let arc = Arc::from_bulge(start, end, 2.0 * arrow / start.distance(end));
    arc.map_or_else(|| Line::new(start, end).into(), Segment::from)
}

/// The long sides of an island bulge by the rounding of a drawing, as curves of few digits do: the fabric between them is too narrow all
/// the same.
#[test]
fn bulging_sides_face_each_other() {
    for arrow in [-0.004, 0.0, 0.004] {
        let corners = [p(40.0, 20.0), p(60.0, 20.0), p(60.0, 22.4), p(40.0, 22.4)];
        let sides = (0..4).map(|k| bulging_side(corners[k], corners[(k + 1) % 4], arrow)).collect();
        let air = vec![("r", rectangle(0.0, 0.0, 100.0, 60.0)), ("i", Path::closed(sides))];
        let faults = refused(&sketch(air, vec![port(0.0, 30.0)]));
        assert!(faults.iter().any(|fault| fault.code == ShapeCode::BandsOverlap), "{arrow}: {faults:#?}");
    }
}

#[test]
fn a_thin_hose_has_a_mouth() {
    let pillow = sketch(vec![("r", rectangle(0.0, 0.0, 100.0, 60.0))], vec![port(0.0, 30.0)]);
    for port_width in [0.05, 0.3, 0.63, 2.0] {
        let rules = Rules { band: 0.3 * port_width, port_width, ..RULES };
        let sealing = sealed_shape(&pillow, &rules).unwrap_or_else(|faults| panic!("{faults:?}"));
        assert!((sealing.shape.port_width(0).unwrap() - port_width).abs() < 1e-9, "{port_width}");
    }
}

/// The ends of its seam beside the hose are then longer than the edge. One side leans, and any side has the port.
#[test]
fn an_edge_may_be_shorter_than_the_ends_of_its_seam() {
    for length in [0.3, 0.5, 1.0, 3.0] {
        let corners = [p(0.0, 0.0), p(1.7 * length, 0.0), p(2.1 * length, length), p(0.0, length)];
        for (k, corner) in corners.iter().enumerate() {
            let middle = corner.lerp(corners[(k + 1) % 4], 0.5);
            let tiny = sketch(vec![("r", polygon(&corners))], vec![port(middle.x, middle.y)]);
            let port_width = 0.2 * length;
            let rules = Rules { band: 0.1 * length, allowance: 0.2 * length, port_width, ..RULES };
            let sealing =
                sealed_shape(&tiny, &rules).unwrap_or_else(|faults| panic!("{length} {k}: {faults:?}"));
            assert_eq!(sealing.shape.seams.len(), 1, "{length} {k}");
        }
    }
}
