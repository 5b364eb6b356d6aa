//! Meshes of the cases.

use std::f64::consts::PI;

use proptest::prelude::*;

use crate::shell::mesh::*;

/// The base mesh of any case in the range that the level promises, its smallest angle, and its exact area.
fn star() -> impl Strategy<Value = (HalfSector, f64)> {
    let shape = (3_u32..=16, 20.0..160.0_f64, 0.0..3.0_f64, 0.0..3.0_f64, 10.0..100.0_f64, 0.001..8.0_f64);
    (shape, 5.0..16.0_f64).prop_filter_map("no star", |((n, phi, tip, corner, w, arm), cells)| {
        let half = PI / f64::from(n);
        let phi_i = phi.to_radians().min(0.95 * (PI - 2.0 * half));
        // Every other radius is 0, which is the paper's case.
        let round = |x: f64| if x < 1.5 { 0.0 } else { 2.0 * (x - 1.5) * w };
        let (r_i, r_e) = (round(tip), round(corner));
        let (sin, cos) = (0.5 * phi_i).sin_cos();
        let rho_0 = (arm * w * sin + (w + r_i + r_e) * cos) / half.sin() - w - r_e;
        (rho_0 > 0.0).then_some((HalfSector { n, rho_0, w, phi_i, r_i, r_e }, cells))
    })
}

fn sound(meshed: &Meshed) -> Result<(), TestCaseError> {
    let mesh = &meshed.mesh;
    let again = Mesh::from_triangles(mesh.points.clone(), mesh.triangles.clone(), |ends| {
        let found = mesh.edges.binary_search_by_key(&ends, |edge| edge.ends).ok()?;
        mesh.edges[found].border
    });
    prop_assert_eq!(again.as_ref(), Ok(mesh));
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]
    #[test]
    fn stars((star, cells) in star()) {
        let sizes = Sizes::across(star.w, cells);
        let meshed = star.mesh(&sizes).map_err(|e| TestCaseError::fail(e.to_string()))?;
        sound(&meshed)?;
        let fine = meshed.refined().map_err(|e| TestCaseError::fail(e.to_string()))?;
        sound(&fine)?;
        prop_assert!(fine.mesh.smallest_angle().to_degrees() > 20.0, "{} {} points", fine.mesh.smallest_angle().to_degrees(), meshed.mesh.points.len());
    }
}
