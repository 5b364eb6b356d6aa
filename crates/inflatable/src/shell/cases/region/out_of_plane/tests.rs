//! Both sheets as one against the sheet and its image, and laws for shapes out of the plane.

use super::*;
use crate::shell::cases::{Fineness, FlatRegion, PlaneState, chambers, region};
use crate::shell::element::Fabric;
use geom::{Line, Path, Point};

/// E = 128 MPa, nu = 0.39, of thickness `t`, m.
fn fabric(t: f64) -> Fabric {
    let (e, nu) = (128e6, 0.39);
    Fabric::isotropic(e * t, e * t.powi(3) / (12.0 * (1.0 - nu * nu)), nu)
}

fn polygon(points: &[[f64; 2]]) -> Path {
    let point = |k: usize| Point::new(points[k % points.len()][0], points[k % points.len()][1]);
    Path::closed((0..points.len()).map(|k| Line::new(point(k), point(k + 1)).into()).collect())
}

/// A pouch of fabric 0.3 mm thick, 30 mm wide and 80 mm long, with a welded diamond across its middle that is `length` long, m, and leaves
/// 4 mm on both sides. The probes lie along its middle: ends and hinge.
fn hinge(length: f64, pressure: f64) -> FlatRegion {
    let (width, half) = (0.03, 0.04);
    let diamond = [[-length / 2.0, 0.0], [0.0, -0.011], [length / 2.0, 0.0], [0.0, 0.011]];
    let outline = [[-half, -width / 2.0], [half, -width / 2.0], [half, width / 2.0], [-half, width / 2.0]];
    FlatRegion {
        chamber: chambers(&[polygon(&outline), polygon(&diamond)], &[], &[]).expect("a chamber").remove(0),
        fabric: fabric(0.3e-3),
        pressure,
        band: 0.003,
        probes: vec![[-half, 0.0], [-length / 2.0, 0.0], [length / 2.0, 0.0], [half, 0.0]],
        partial: Vec::new(),
        plates: None,
    }
}

/// A pressure at which the hinge stays in its plane.
const STAYS: f64 = 20.0;

/// A coarse answer in the plane.
fn in_plane(case: &FlatRegion) -> InflatedRegion {
    region(case, Fineness { cells: 2.0, cuts: 2 }, &Watch::default()).expect("an equilibrium in the plane")
}

/// The coarsest mesh of `inflated`, and its upper sheet in the plane.
fn coarsest(case: &FlatRegion, inflated: &InflatedRegion) -> (FreeMesh, Meshed, State) {
    let Equilibria { tube, fineness, states } = inflated.equilibria.as_ref().expect("resolved");
    let scaled = ScaledChamber::new(case, *tube, inflated.wrinkles);
    let (meshed, _) = scaled.chamber.mesh(fineness.cells).expect("a mesh");
    let mesh = FreeMesh::new(&scaled, &meshed, &states[0], &Watch::default()).expect("small");
    (mesh, meshed, states[0].clone())
}

/// The parts of the energy of both sheets, their total, and the norm of their forces.
fn differentiated(mesh: &mut FreeMesh, state: &State) -> ([f64; 4], f64) {
    let pressure = mesh.tube.stretch();
    let energy = mesh.solver.assembly.differentiate(state, pressure);
    let residual = mesh.solver.assembly.gradient().iter().map(|x| x * x).sum::<f64>().sqrt();
    ([energy.membrane, energy.bending, energy.volume, energy.total(pressure)], residual / pressure)
}

/// The largest distance between the sheets.
fn height([upper, lower]: &[State; 2]) -> f64 {
    upper.points.iter().zip(&lower.points).map(|(a, b)| a[2] - b[2]).fold(0.0, f64::max)
}

/// The point of `sheet` that is nearest to `place` of the flat chamber.
fn nearest(sheet: &InflatedShape, place: [f64; 2]) -> usize {
    let distances = sheet.flat.iter().map(|[x, y]| libm::hypot(x - place[0], y - place[1]));
    distances.enumerate().min_by(|(_, a), (_, b)| a.total_cmp(b)).expect("points").0
}

fn is_near(a: f64, b: f64, relative: f64) -> bool {
    (a - b).abs() <= relative * b.abs()
}

/// A sheet in equilibrium and its image are an equilibrium of both, with twice each part of the energy, whether that is stable or not.
#[test]
fn a_sheet_and_its_image_are_an_equilibrium_of_both() {
    let case = hinge(0.02, 14e3);
    let inflated = in_plane(&case);
    let (mut mesh, _, state) = coarsest(&case, &inflated);
    let energy = mesh.upper.energy(&state);
    let joined = mesh.state.clone();
    let (parts, residual) = differentiated(&mut mesh, &joined);
    let total = energy.total(mesh.tube.stretch());
    for (part, of_sheet) in parts.into_iter().zip([energy.membrane, energy.bending, energy.volume, total]) {
        assert!(is_near(part, 2.0 * of_sheet, 1e-12), "{part} {of_sheet}");
    }
    assert!(residual < 1e-7, "{residual}");
    let [upper, lower] = mesh.numbers.parted(&joined);
    assert_eq!((&upper, &lower), (&state, &state.image()));
}

/// Where the shape in the plane is stable, both sheets settle to it from a shape without any symmetry.
#[test]
fn both_sheets_settle_in_the_plane_where_that_is_stable() {
    let case = hinge(0.02, STAYS);
    let inflated = in_plane(&case);
    assert_eq!(inflated.plane(), PlaneState::Stays, "{:?}", inflated.antisymmetric_eigenvalue);
    let (mut mesh, _, _) = coarsest(&case, &inflated);
    let flat = mesh.state.clone();
    for (k, point) in (0_u32..).zip(&mut mesh.state.points) {
        let noise = [0.7, 1.3, 2.1].map(|c| 2e-3 * libm::sin(c * f64::from(k) + c));
        *point = std::array::from_fn(|axis| point[axis] + noise[axis]);
    }
    assert_eq!(mesh.settle(), Ok(false), "no energy is released");
    assert!(is_near(mesh.energies[1], mesh.energies[0], 1e-6), "{:?}", mesh.energies);
    let sheets = mesh.laid_sheets();
    assert!(rise(&sheets) < 1e-6, "{}", rise(&sheets));
    let expected = height(&mesh.numbers.parted(&flat));
    assert!(is_near(height(&sheets), expected, 1e-6), "{} {expected}", height(&sheets));
}

/// The image in the plane and any turned shape have the same energy and no forces, and the image is stable, too.
#[test]
fn a_shape_out_of_the_plane_may_be_turned_and_mirrored() {
    let case = hinge(0.02, 14e3);
    let inflated = in_plane(&case);
    let eigenvalue = inflated.antisymmetric_eigenvalue;
    assert!(eigenvalue.meshes.iter().all(|value| *value < 0.0), "{eigenvalue:?}");
    let (mut mesh, _, state) = coarsest(&case, &inflated);
    assert_eq!(mesh.leave(&state), Ok(true));
    let settled = mesh.state.clone();
    let (parts, residual) = differentiated(&mut mesh, &settled);
    assert!(residual < 1e-7, "{residual}");
    let [upper, lower] = mesh.numbers.parted(&settled);
    let image = mesh.numbers.joined(&lower.image(), &upper.image());
    let (sine, cosine) = f64::sin_cos(0.7);
    let mut turned = settled.clone();
    for point in &mut turned.points {
        let [x, y, z] = *point;
        let [y, z] = [cosine * y - sine * z, sine * y + cosine * z];
        *point = [cosine * x - sine * y + 3.0, sine * x + cosine * y, z - 0.4];
    }
    for other in [image, turned] {
        let (other_parts, residual) = differentiated(&mut mesh, &other);
        for (part, other_part) in parts.into_iter().zip(other_parts) {
            assert!(is_near(part, other_part, 1e-11), "{parts:?} {other_parts:?}");
        }
        assert!(residual < 1e-7, "{residual}");
    }
    let (released, rise_of_first) = (mesh.released(), rise(&mesh.laid_sheets()));
    // From a little above the image, where the opposite push leads.
    let [upper, lower] = mesh.numbers.parted(&settled);
    mesh.state = mesh.numbers.joined(&lower.image(), &upper.image());
    mesh.state.points.iter_mut().for_each(|[x, _, z]| *z += 0.01 * *x * *x);
    assert_eq!(mesh.settle(), Ok(true));
    assert!(is_near(mesh.released(), released, 1e-6), "{} {released}", mesh.released());
    let rise_of_second = rise(&mesh.laid_sheets());
    assert!(is_near(rise_of_second, rise_of_first, 1e-4), "{rise_of_second} {rise_of_first}");
}

/// A diamond hinge folds on all three meshes. The rise is that of the positions in its sheets; the probes lie on them.
#[test]
fn a_diamond_hinge_leaves_its_plane() {
    let case = hinge(0.02, 14e3);
    let inflated = in_plane(&case);
    let shape = out_of_plane(&case, &inflated, &Watch::default()).expect("computed").expect("a shape");
    assert!(shape.released.meshes.iter().all(|released| *released > 0.0), "{:?}", shape.released);
    let [upper, lower] = &shape.sheets;
    let middle: Vec<f64> = upper
        .points
        .iter()
        .zip(&lower.points)
        .map(|(over, under)| f64::midpoint(over[2], under[2]))
        .collect();
    let [low, high] = [f64::min, f64::max].map(|end| middle.iter().copied().reduce(end).expect("points"));
    assert!(is_near(high - low, shape.rise.meshes[2], 1e-12), "{} {:?}", high - low, shape.rise);
    // Ends lie on the rim, where both sheets are joined.
    let probes = shape.probed.last().expect("three meshes");
    assert_eq!((shape.probed.len(), probes.len()), (3, 4));
    assert_eq!(probes[0][0], probes[0][1]);
    for (place, sheets) in case.probes.iter().zip(probes) {
        let point = nearest(upper, *place);
        for (sheet, position) in [upper, lower].iter().zip(sheets) {
            let distance: f64 =
                (0..3).map(|axis| (sheet.points[point][axis] - position[axis]).powi(2)).sum::<f64>().sqrt();
            let flat = libm::hypot(sheet.flat[point][0] - place[0], sheet.flat[point][1] - place[1]);
            assert!(distance <= 1.2 * flat + 1e-9, "{distance} {flat}");
        }
    }
}

/// Without a mesh of its own a blend of shapes is followed nowhere, nor a chamber between plates.
#[test]
fn blends_and_chambers_between_plates_are_not_followed() {
    let mut case = hinge(0.02, STAYS);
    let inflated = in_plane(&case);
    let blend = InflatedRegion { equilibria: None, ..inflated.clone() };
    assert_eq!(out_of_plane(&case, &blend, &Watch::default()), Ok(None));
    case.plates = Some(0.01);
    assert_eq!(out_of_plane(&case, &inflated, &Watch::default()), Ok(None));
}
