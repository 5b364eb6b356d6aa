//! States that the elements must reproduce: constant stretch and curvature, an even pull, kinks of a bent plate.

use super::*;

/// Unknowns of the points within the sheet around which no triangle has an edge on the border.
fn inner_unknowns(mesh: &Mesh, assembly: &Assembly) -> Vec<[u32; 3]> {
    let mut on_border = vec![false; mesh.points.len()];
    for (corners, edges) in mesh.triangles.iter().zip(&mesh.triangle_edges) {
        if edges.iter().any(|edge| mesh.edges[*edge].border.is_some()) {
            for corner in corners {
                on_border[*corner] = true;
            }
        }
    }
    let inner = (0..mesh.points.len()).filter(|point| !on_border[*point]);
    inner.map(|point| assembly.numbering.points[point]).collect()
}

/// An irregular mesh of free borders: the grid's inner points moved.
fn irregular(diagonal: Diagonal, turn: f64) -> Result<Mesh, MeshFault> {
    let mut mesh = rectangle([1.5, 1.0], [5, 4], diagonal, turn, [Border::Free; 4])?;
    let on_border: Vec<usize> =
        mesh.edges.iter().filter(|edge| edge.border.is_some()).flat_map(|edge| edge.ends).collect();
    for (k, point) in mesh.points.iter_mut().enumerate().filter(|(k, _)| !on_border.contains(k)) {
        *point = [point[0] + 0.05 * noise(3 * k), point[1] + 0.05 * noise(3 * k + 1)];
    }
    Ok(mesh)
}

#[test]
fn a_constant_stretch_is_exact_on_every_mesh() -> Result<(), MeshFault> {
    for (fabric, diagonal, turn) in fabrics_and_cuts() {
        let mesh = irregular(diagonal, turn)?;
        let mut assembly = Assembly::new(Sheet::new(&mesh, fabric), Supports::new(&mesh, Vec::new()));
        let mut state = assembly.sheet.flat();
        // A plane sheet in space, stretched and sheared.
        for x in &mut state.points {
            *x = [1.1 * x[0] + 0.07 * x[1], 0.2 * x[0] + 0.93 * x[1], 0.3 * x[0] - 0.4 * x[1]];
        }
        let energy = assembly.differentiate(&state, 0.0);
        let [e11, e22, e12] = [
            (1.1 * 1.1 + 0.04 + 0.09 - 1.0) / 2.0,
            (0.07 * 0.07 + 0.93 * 0.93 + 0.16 - 1.0) / 2.0,
            0.077 + 0.186 - 0.12,
        ];
        let Fabric { stretch, poisson: nu, weave, .. } = fabric;
        // In the axes of warp and weft.
        let [e11, e22, e12] = in_axes(weave.warp, [e11, e22, e12 / 2.0]);
        let shear = weave.shear * stretch / (2.0 * (1.0 + nu));
        let density = stretch / (1.0 - nu * nu) * (e11 * e11 + e22 * e22 + 2.0 * nu * e11 * e22) / 2.0
            + shear * (2.0 * e12) * (2.0 * e12) / 2.0;
        assert!((energy.membrane / (1.5 * density) - 1.0).abs() < 1e-12, "{diagonal:?}");
        assert!(energy.bending < 1e-25, "{diagonal:?} {:e}", energy.bending);
        for unknown in inner_unknowns(&mesh, &assembly).into_iter().flatten() {
            assert!(
                assembly.gradient()[unknown as usize].abs() < 1e-10 * FABRIC.stretch,
                "{diagonal:?} {unknown}"
            );
        }
    }
    Ok(())
}

/// A symmetric matrix (11, 22, 12) in axes that are turned by `angle`.
fn in_axes(angle: f64, [a11, a22, a12]: [f64; 3]) -> [f64; 3] {
    let (s, c) = angle.sin_cos();
    [
        c * c * a11 + s * s * a22 + 2.0 * s * c * a12,
        s * s * a11 + c * c * a22 - 2.0 * s * c * a12,
        s * c * (a22 - a11) + (c * c - s * s) * a12,
    ]
}

/// xi of every edge where the sheet's slope in the middle of it is that of the field: that of the height given at its corners.
fn leans(mesh: &Mesh, heights: &[f64], slope: impl Fn([f64; 2]) -> [f64; 2]) -> Vec<f64> {
    let outward = |t: usize, e: usize| {
        // alpha of triangle t on edge e: how much steeper the field is there than the triangle, outwards.
        let corners = mesh.triangles[t];
        let flat = crate::shell::element::membrane::Flat::new(corners.map(|corner| mesh.points[corner]));
        let constant_slope =
            [0, 1].map(|c| (0..3).map(|k| flat.slopes[k][c] * heights[corners[k]]).sum::<f64>());
        let [a, b] = mesh.edges[e].ends.map(|end| mesh.points[end]);
        let exact_slope = slope([f64::midpoint(a[0], b[0]), f64::midpoint(a[1], b[1])]);
        let i = mesh.triangle_edges[t].iter().position(|edge| *edge == e).unwrap_or(0);
        let [x, y] = flat.slopes[i];
        -((exact_slope[0] - constant_slope[0]) * x + (exact_slope[1] - constant_slope[1]) * y) / x.hypot(y)
    };
    let lean = |(e, edge): (usize, &crate::shell::mesh::Edge)| match edge.sides {
        [Some(left), Some(right)] => (outward(left, e) - outward(right, e)) / 2.0,
        [Some(left), None] => outward(left, e),
        [None, Some(right)] => -outward(right, e),
        [None, None] => 0.0,
    };
    mesh.edges.iter().enumerate().map(lean).collect()
}

#[test]
fn a_constant_curvature_is_exact_on_every_mesh() -> Result<(), MeshFault> {
    // So soft in its plane that only bending matters.
    let [xx, yy, xy] = [0.8, -0.5, 0.3];
    for (fabric, diagonal, turn) in fabrics_and_cuts() {
        let fabric = Fabric::isotropic(1e-6, 1.0, 0.3).woven(fabric.weave);
        let mesh = irregular(diagonal, turn)?;
        let mut assembly = Assembly::new(Sheet::new(&mesh, fabric), Supports::new(&mesh, Vec::new()));
        let mut energy_and_first = |height: f64| {
            let field = |[x, y]: [f64; 2]| height * (xx * x * x / 2.0 + yy * y * y / 2.0 + xy * x * y);
            let slope = |[x, y]: [f64; 2]| [height * (xx * x + xy * y), height * (yy * y + xy * x)];
            let heights: Vec<f64> = mesh.points.iter().copied().map(field).collect();
            let mut state = assembly.sheet.flat();
            state.leans = leans(&mesh, &heights, slope);
            for (x, z) in state.points.iter_mut().zip(&heights) {
                x[2] = *z;
            }
            let energy = assembly.differentiate(&state, 0.0);
            (energy.bending, assembly.gradient().to_vec())
        };
        // The linear plate: differences between two heights cancel the terms of higher order in the height.
        let height = 1e-3;
        let ((single, first), (double, second)) = (energy_and_first(height), energy_and_first(2.0 * height));
        // In the axes of warp and weft, where the stiffness against twist is G t^3 / 12 = shear B (1 - nu)/2.
        let [k11, k22, k12] = in_axes(fabric.weave.warp, [xx, yy, xy]);
        let twist = fabric.weave.shear * 0.7 / 2.0;
        let density =
            (k11 * k11 + k22 * k22 + 2.0 * 0.3 * k11 * k22) * 0.5 + twist * (2.0 * k12).powi(2) * 0.5;
        let energy = (16.0 * single - double) / (12.0 * height * height);
        assert!((energy / (1.5 * density) - 1.0).abs() < 1e-10, "{diagonal:?} {energy}");
        let force = |unknown: usize| (8.0 * first[unknown] - second[unknown]) / 6.0 / height;
        // Upwards: forces in the plane are of second order.
        for unknown in inner_unknowns(&mesh, &assembly).into_iter().map(|numbers| numbers[2] as usize) {
            assert!(force(unknown).abs() < 1e-10, "{diagonal:?} {unknown} {:e}", force(unknown));
        }
        let inner = (0..mesh.edges.len()).filter(|edge| mesh.edges[*edge].border.is_none());
        for number in inner.map(|edge| assembly.numbering.edges[edge] as usize) {
            assert!(force(number).abs() < 1e-10, "{diagonal:?} {number} {:e}", force(number));
        }
    }
    Ok(())
}

/// Pulled evenly in its plane, tube and margin are one sheet: no point within has a force, also not along the rim between them.
#[test]
fn a_margin_bears_a_pull_as_the_tube_does() -> Result<(), MeshFault> {
    for law in [Compression::Elastic, Compression::Wrinkled(0.01)] {
        for (diagonal, turn) in CUTS {
            let mesh = irregular(diagonal, turn)?;
            let first = mesh.triangles.len() / 2;
            let (mut sheet, mut supports) = (Sheet::new(&mesh, FABRIC), Supports::new(&mesh, Vec::new()));
            sheet.set_margin(first, law);
            supports.keep_level(&mesh, first);
            let mut assembly = Assembly::new(sheet, supports);
            let mut state = assembly.sheet.flat();
            state
                .points
                .iter_mut()
                .for_each(|x| *x = [1.1 * x[0] + 0.02 * x[1], 0.05 * x[0] + 1.06 * x[1], 0.0]);
            let _ = assembly.differentiate(&state, PRESSURE);
            for unknown in inner_unknowns(&mesh, &assembly).into_iter().flat_map(|[x, y, _]| [x, y]) {
                assert!(
                    assembly.gradient()[unknown as usize].abs() < 1e-12,
                    "{law:?} {diagonal:?} {unknown}"
                );
            }
            // The pressure lifts the tube and not the margin.
            let lifted = |point: &usize| assembly.forces()[*point][2] < -1e-3;
            let mut of_margin = mesh.triangles[first..].iter().flatten().filter(|point| lifted(point));
            let rim: Vec<usize> = mesh.triangles[..first].iter().flatten().copied().collect();
            assert!(of_margin.all(|point| rim.contains(point)), "{law:?} {diagonal:?}");
        }
    }
    Ok(())
}

/// On equilateral triangles the kinks of a shape of one small curvature, in whatever direction, have a plate's energy; only the edges of the
/// patch have none.
#[test]
fn kinks_have_the_energy_of_a_bent_plate() -> Result<(), MeshFault> {
    const ROWS: usize = 60;
    let number = |i: usize, j: usize| i + j * (ROWS + 1);
    let real = |k: usize| f64::from(u32::try_from(k).unwrap_or(0));
    let place = |k: usize| {
        let (i, j) = (real(k % (ROWS + 1)), real(k / (ROWS + 1)));
        [i + j / 2.0, j * 3.0_f64.sqrt() / 2.0]
    };
    let rhombus = |k: usize| {
        let (i, j) = (k % ROWS, k / ROWS);
        let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i, j + 1), number(i + 1, j + 1)];
        [[a, b, c], [b, d, c]]
    };
    let points: Vec<[f64; 2]> = (0..(ROWS + 1) * (ROWS + 1)).map(place).collect();
    let triangles = (0..ROWS * ROWS).flat_map(rhombus).collect();
    let mesh = Mesh::from_triangles(points, triangles, |_| Some(Border::Free))?;
    let mut sheet = Sheet::new(&mesh, FABRIC);
    sheet.wrinkle(0.01, 0.0);
    let curvature = 1e-3;
    for direction in [0.0, 0.3, 1.2, 2.0] {
        let mut state = sheet.flat();
        for x in &mut state.points {
            let distance = x[0] * f64::cos(direction) + x[1] * f64::sin(direction);
            x[2] = curvature * distance * distance / 2.0;
        }
        let energy: f64 = sheet.kinks.iter().map(|kink| kink.energy(&state.points)).sum();
        let plate = FABRIC.bending * curvature * curvature / 2.0 * mesh.total_area();
        assert!((energy / plate - 1.0).abs() < 0.02, "{direction}: {energy:e} {plate:e}");
    }
    Ok(())
}
