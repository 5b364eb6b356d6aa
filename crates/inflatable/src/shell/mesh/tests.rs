//! Meshes of the cases.

use std::collections::BTreeSet;
use std::f64::consts::PI;

use proptest::prelude::*;

use crate::shell::mesh::{
    Border, Edge, HalfActuator, HalfSector, HingeSector, Mesh, MeshFault, Meshed, Piece, Region, Sizes,
    plane, rim,
};
use geom::{Isometry, Point};

const PAPER: HalfSector = HalfSector { n: 5, rho_0: 50.0, w: 30.0, phi_i: PI / 6.0, r_i: 0.0, r_e: 0.0 };

fn radius() -> impl Strategy<Value = f64> {
    // A point, which is the paper's case, as often as an arc.
    prop_oneof![Just(0.0), 0.001..3.0_f64]
}

/// Stars over the range that the level promises, and how many edges go across their hinges.
fn star() -> impl Strategy<Value = (HalfSector, f64)> {
    let shape = (3_u32..=16, 20.0..160.0_f64, radius(), radius(), 10.0..100.0_f64, 0.001..8.0_f64);
    (shape, 5.0..10.0_f64).prop_filter_map("no such star", |((n, phi, tip, corner, w, arm), cells)| {
        let half = PI / f64::from(n);
        let phi_i = phi.to_radians().min(0.95 * (PI - 2.0 * half));
        let (r_i, r_e) = (tip * w, corner * w);
        let (sin, cos) = (0.5 * phi_i).sin_cos();
        let rho_0 = (arm * w * sin + (w + r_i + r_e) * cos) / half.sin() - w - r_e;
        (rho_0 > 0.0).then_some((HalfSector { n, rho_0, w, phi_i, r_i, r_e }, cells))
    })
}

/// It is a mesh by its triangles alone, its border lies on its pieces and is as long as they are, nearly, no triangle is
/// thin, and the exact area follows from it and the finer one.
fn check(meshed: &Meshed, thinnest: f64) -> Result<(), TestCaseError> {
    let fine = test_case(meshed.refined())?;
    for meshed in [meshed, &fine] {
        let mesh = &meshed.mesh;
        let named = |ends| mesh.edges[mesh.edges.binary_search_by_key(&ends, |edge| edge.ends).ok()?].border;
        let rebuilt = Mesh::from_triangles(mesh.points.clone(), mesh.triangles.clone(), named);
        prop_assert_eq!(rebuilt.as_ref(), Ok(mesh));
        on_curves(meshed)?;
        let smallest = mesh.smallest_angle().to_degrees();
        prop_assert!(smallest > thinnest, "{smallest} deg");
    }
    let region = Region { pieces: meshed.pieces.clone(), holes: Vec::new(), welds: Vec::new() };
    let (coarse, fine, exact) = (meshed.mesh.total_area(), fine.mesh.total_area(), region.area());
    let extrapolated = fine + (fine - coarse) / 3.0;
    prop_assert!((extrapolated - exact).abs() < 1e-4 * exact, "{extrapolated} for {exact}");
    // Inner and outer arcs err in opposite directions; where they nearly cancel, the next order is left.
    prop_assert!(
        (fine - exact).abs() <= 0.26 * (coarse - exact).abs() + 3e-5 * exact,
        "{coarse}, {fine} for {exact}"
    );
    Ok(())
}

fn on_curves(meshed: &Meshed) -> Result<(), TestCaseError> {
    let mesh = &meshed.mesh;
    let mut lengths = vec![0.0; meshed.pieces.len()];
    for (edge, piece) in meshed.piece_of.iter().enumerate() {
        let Some(piece) = *piece else {
            prop_assert_eq!(mesh.edges[edge].border, None);
            continue;
        };
        let Piece { curve, border } = meshed.pieces[piece];
        prop_assert_eq!(mesh.edges[edge].border, Some(border));
        lengths[piece] += mesh.length(edge);
        for [x, y] in mesh.edges[edge].ends.map(|end| mesh.points[end]) {
            let distance = curve.distance(Point::new(x, y));
            prop_assert!(distance <= 1e-12 * (x.abs() + y.abs()).max(1.0), "{distance} off its curve");
        }
    }
    for (found, piece) in lengths.iter().zip(&meshed.pieces) {
        let exact = piece.curve.length();
        // An arc has as many edges as it turns by 0.3 rad, rounded: one that turns by 0.45 rad is shorter by 0.84 %.
        prop_assert!(*found <= exact * (1.0 + 1e-12) && *found > 0.9915 * exact, "{found} of {exact}");
    }
    Ok(())
}

fn test_case<T>(result: Result<T, MeshFault>) -> Result<T, TestCaseError> {
    result.map_err(|fault| TestCaseError::fail(fault.to_string()))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn half_sectors_of_any_star((star, cells) in star()) {
        check(&test_case(star.mesh(&Sizes::for_tube(star.w, cells)))?, 20.0)?;
    }

    #[test]
    fn half_actuators(r in radius(), w in 10.0..100.0_f64, l in 0.01..8.0_f64, phi in 20.0..160.0_f64, cells in 5.0..10.0_f64) {
        let case = HalfActuator { r: r * w, w, l: l * w, phi_0: phi.to_radians() };
        check(&test_case(case.mesh(&Sizes::for_tube(w, cells)))?, 20.0)?;
    }

    #[test]
    fn cells(r in radius(), w in 10.0..100.0_f64, arc in 10.0..160.0_f64, cells in 5.0..10.0_f64) {
        let case = HingeSector { r: r * w, w, arc: arc.to_radians() };
        // Where the inner rim is a point, the two planes meet there, and the triangle between them is as narrow as half of the hinge.
        let thinnest = if r == 0.0 { 20.0_f64.min(0.5 * arc) } else { 20.0 };
        check(&test_case(case.mesh(&Sizes::for_tube(w, cells)))?, thinnest)?;
    }
}

#[test]
fn the_same_bits_each_time() -> Result<(), MeshFault> {
    let sizes = Sizes::for_tube(30.0, 8.0);
    let (first, two) = (PAPER.mesh(&sizes)?, PAPER.mesh(&sizes)?);
    assert_eq!(first, two);
    assert_eq!(first.refined()?, two.refined()?);
    assert_eq!(first.mesh.elimination_order(), two.mesh.elimination_order());
    Ok(())
}

#[test]
fn a_half_sector_lies_between_its_planes() -> Result<(), MeshFault> {
    for star in [PAPER, HalfSector { r_i: 3.0, r_e: 6.0, ..PAPER }] {
        let meshed = star.mesh(&Sizes::for_tube(star.w, 6.0))?;
        let region = Region { pieces: meshed.pieces.clone(), holes: Vec::new(), welds: Vec::new() };
        // Arc lengths and area of a tube of constant width: along its middle.
        let (phi_i, phi_e) = (star.phi_i, star.phi_i + 2.0 * star.half_angle());
        let middle =
            star.l() + 0.5 * (PI - phi_i) * (star.r_i + 15.0) + 0.5 * (PI - phi_e) * (star.r_e + 15.0);
        assert!((region.area() - 30.0 * middle).abs() < 1e-10);
        let points_on = |border| {
            let ends = meshed
                .mesh
                .edges
                .iter()
                .filter(move |edge| edge.border == Some(border))
                .flat_map(|edge| edge.ends);
            ends.map(|end| meshed.mesh.points[end]).collect::<Vec<_>>()
        };
        assert!(points_on(Border::Mirror(plane::FIRST)).iter().all(|p| p[1] == 0.0));
        let (sin, cos) = star.half_angle().sin_cos();
        assert!(
            points_on(Border::Mirror(plane::SECOND))
                .iter()
                .all(|p| (p[1] * cos - p[0] * sin).abs() < 1e-13 * p[0])
        );
        // The rim around the hole touches the circle of the inner radius at the corner's apex.
        let least_radius =
            points_on(Border::Rim(rim::INNER)).into_iter().map(|[x, y]| x.hypot(y)).fold(f64::MAX, f64::min);
        assert!((least_radius - star.rho_0).abs() < 1e-12);
    }
    assert!((PAPER.l() - 69.720_701_533_297_07).abs() < 1e-10);
    Ok(())
}

#[test]
fn triangles_are_as_small_as_asked() -> Result<(), MeshFault> {
    let case = HalfActuator { r: 2.0, w: 20.0, l: 80.0, phi_0: PI / 3.0 };
    let sizes = Sizes { hinge: 1.5, point: 0.5, arm: 4.0 };
    let mesh = case.mesh(&sizes)?.mesh;
    let mean = |within: &dyn Fn(f64) -> bool| {
        let middle = |edge: &Edge| {
            let [a, b] = edge.ends.map(|end| mesh.points[end]);
            (0.5 * (a[0] + b[0])).hypot(0.5 * (a[1] + b[1]))
        };
        let lengths: Vec<f64> = (0..mesh.edges.len())
            .filter(|&e| within(middle(&mesh.edges[e])))
            .map(|e| mesh.length(e))
            .collect();
        lengths.iter().sum::<f64>() / lengths.iter().map(|_| 1.0).sum::<f64>()
    };
    let (inner, hinge, arm) = (mean(&|d| d < 2.6), mean(&|d| d > 5.0 && d < 11.0), mean(&|d| d > 55.0));
    assert!(inner > 0.4 && inner < 0.8, "{inner}");
    assert!(hinge > 1.3 && hinge < 1.7, "{hinge}");
    assert!(arm > 3.5 && arm < 4.5, "{arm}");
    Ok(())
}

#[test]
fn what_cannot_be_meshed_is_refused() {
    let sizes = Sizes::for_tube(30.0, 6.0);
    let name = |result: Result<Meshed, MeshFault>| match result {
        Err(MeshFault::Dimension { name, .. }) => name,
        other => panic!("{other:?}"),
    };
    assert_eq!(name(HalfSector { n: 2, ..PAPER }.mesh(&sizes)), "n");
    assert_eq!(name(HalfSector { n: 9, ..PAPER }.mesh(&sizes)), "the arm's length l");
    assert_eq!(name(HalfSector { w: f64::NAN, ..PAPER }.mesh(&sizes)), "the width W");
    assert_eq!(name(HalfSector { phi_i: 2.0, ..PAPER }.mesh(&sizes)), "the tips' angle phi_i0");
    assert_eq!(name(HalfSector { r_i: -1.0, ..PAPER }.mesh(&sizes)), "the tips' radius R_i");
    assert_eq!(name(PAPER.mesh(&Sizes { arm: f64::INFINITY, ..sizes })), "the size along arms");
    assert_eq!(name(HingeSector { r: 0.0, w: 30.0, arc: 4.0 }.mesh(&sizes)), "the arc");
    let fine = Sizes { hinge: 0.03, point: 0.03, arm: 0.03 };
    let cell = HingeSector { r: 3000.0, w: 30.0, arc: 3.0 }.mesh(&fine);
    assert_eq!(cell, Err(MeshFault::TooMany { most: 30_000 }));
}

#[test]
fn a_whole_star_is_its_half_sector_2n_times() -> Result<(), MeshFault> {
    let half = PAPER.mesh(&Sizes::for_tube(30.0, 5.0))?;
    let area = half.mesh.total_area();
    let (sector, star) = (half.unfolded(5, 2)?, half.unfolded(5, 10)?);
    assert_eq!(half.unfolded(5, 1)?, half);
    for (meshed, times, loops) in [(&sector, 2.0, 1), (&star, 10.0, 0)] {
        let mesh = &meshed.mesh;
        assert!((mesh.total_area() - times * area).abs() < 1e-12 * times * area);
        // Euler: points - edges + triangles is 1 for a disc and 0 for a ring.
        assert_eq!(mesh.points.len() + mesh.triangles.len(), mesh.edges.len() + loops);
        assert!(on_curves(meshed).is_ok());
        assert!(on_curves(&meshed.refined()?).is_ok());
    }
    let has_border =
        |meshed: &Meshed, border| meshed.mesh.edges.iter().any(|edge| edge.border == Some(border));
    assert!(
        has_border(&sector, Border::Mirror(plane::FIRST))
            && has_border(&sector, Border::Mirror(plane::SECOND))
    );
    assert!(
        !star.mesh.edges.iter().any(|edge| matches!(edge.border, Some(Border::Mirror(_) | Border::Free)))
    );
    // A turn by a fifth is a symmetry: the same points, to rounding.
    let turn = Isometry::rotation(0.4 * PI);
    for &[x, y] in &star.mesh.points {
        let p = turn.point(Point::new(x, y));
        assert!(star.mesh.points.iter().any(|&[x, y]| (x - p.x).hypot(y - p.y) < 1e-11));
    }
    assert!(half.unfolded(5, 11).is_err());
    assert!(half.unfolded(5, 0).is_err());
    Ok(())
}

/// Nonzeros of the Cholesky factor of a graph's matrix in an order of elimination, and the multiplications for it.
fn fill(mesh: &Mesh, order: &[usize]) -> (usize, usize) {
    let count = mesh.points.len() + mesh.edges.len();
    let mut position = vec![0; count];
    order.iter().zip(0..).for_each(|(&node, place)| position[node] = place);
    let mut later_nodes: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); count];
    for triangle in 0..mesh.triangles.len() {
        let nodes: Vec<usize> = mesh.coupled(triangle).into_iter().map(|node| position[node]).collect();
        for &a in &nodes {
            later_nodes[a].extend(nodes.iter().filter(|&&b| b > a));
        }
    }
    let size = |place: usize| if order[place] < mesh.points.len() { 3 } else { 1 };
    let (mut nonzeros, mut work) = (0, 0);
    for place in 0..count {
        let column = std::mem::take(&mut later_nodes[place]);
        let rows: usize = column.iter().map(|&row| size(row)).sum();
        for k in 0..size(place) {
            nonzeros += rows + k + 1;
            work += (rows + k + 1).pow(2);
        }
        if let Some(&parent) = column.first() {
            later_nodes[parent].extend(column.into_iter().skip(1));
        }
    }
    (nonzeros, work)
}

#[test]
fn any_order_will_not_do() -> Result<(), MeshFault> {
    let mesh = PAPER.mesh(&Sizes::for_tube(30.0, 6.0))?.mesh;
    let as_numbered: Vec<usize> = (0..mesh.points.len() + mesh.edges.len()).collect();
    assert!(fill(&mesh, &as_numbered).1 > 3 * fill(&mesh, &mesh.elimination_order()).1);
    Ok(())
}

#[test]
fn dissection_keeps_the_factor_sparse() -> Result<(), MeshFault> {
    let actuator =
        HalfActuator { r: 2.0, w: 20.0, l: 80.0, phi_0: PI / 3.0 }.mesh(&Sizes::for_tube(20.0, 18.0))?;
    for meshed in [actuator.refined()?, PAPER.mesh(&Sizes::for_tube(30.0, 14.0))?.refined()?] {
        let mesh = &meshed.mesh;
        let order = mesh.elimination_order();
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..mesh.points.len() + mesh.edges.len()));
        // Measured: 162 and 170 nonzeros and 41,000 and 45,000 multiplications an unknown.
        let unknowns = 3 * mesh.points.len() + mesh.edges.len();
        let (nonzeros, work) = fill(mesh, &order);
        assert!((12_000..18_000).contains(&unknowns), "{unknowns}");
        assert!(nonzeros < 200 * unknowns, "{nonzeros} nonzeros for {unknowns} unknowns");
        assert!(work < 56_000 * unknowns, "{work} multiplications for {unknowns} unknowns");
    }
    Ok(())
}
