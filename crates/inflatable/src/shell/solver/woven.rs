//! Woven sheets against closed forms of orthotropic ones: coupons cut askew, a shear frame, an inflated tube that twists.

use super::*;
use crate::shell::assembly::{Sheet, Supports};
use crate::shell::element::{Fabric, Weave};
use crate::shell::mesh::{Border, Diagonal, Mesh, MeshFault, rectangle};

const STRETCH: f64 = 3.0;
const POISSON: f64 = 0.3;
/// Length and width of coupons.
const SIZE: [f64; 2] = [3.0, 1.0];

fn fabric(shear: f64, degrees: f64) -> Fabric {
    let weave = Weave { shear, warp: degrees.to_radians() };
    Fabric::isotropic(STRETCH, 1e-3, POISSON).woven(weave)
}

/// Supports of a flat sheet that prevent rigid motions only.
fn free(mesh: &Mesh) -> Supports {
    let mut supports = Supports::free(mesh.points.len());
    let corner_at = |place: [f64; 2]| mesh.points.iter().position(|point| *point == place).expect("a corner");
    let [first, second, third] =
        [corner_at([0.0, 0.0]), corner_at([SIZE[0], 0.0]), corner_at([0.0, SIZE[1]])];
    for (point, axis) in [(first, 0), (first, 1), (first, 2), (second, 1), (second, 2), (third, 2)] {
        supports.fix(point, axis);
    }
    supports
}

/// Compliance of a flat coupon to unit stresses, normal and tangential, on its four sides: their work.
fn compliance(fabric: Fabric, normal: [f64; 2], tangential: f64) -> f64 {
    let mesh = rectangle(SIZE, [9, 4], Diagonal::Alternating, 0.0, [Border::Free; 4]).expect("a rectangle");
    let mut solver = Solver::new(Sheet::new(&mesh, fabric), free(&mesh)).expect("small");
    let mut state = solver.assembly.sheet.flat();
    let rest = solver.settle(&mut state, Aim { pressure: 0.0, tolerance: 1e-12 });
    assert!(rest.is_ok(), "{rest:?}");
    let mut parts = Vec::new();
    for edge in mesh.border_edges(Border::Free) {
        let ends = mesh.edges[edge].ends;
        let half = mesh.length(edge) / 2.0;
        let is_on =
            |axis: usize, at: f64| ends.iter().all(|end| (mesh.points[*end][axis] - at).abs() < 1e-12);
        let [x, y] = normal;
        let force = if is_on(0, 0.0) {
            [-x, -tangential]
        } else if is_on(0, SIZE[0]) {
            [x, tangential]
        } else if is_on(1, 0.0) {
            [-tangential, -y]
        } else {
            [tangential, y]
        };
        parts.extend(ends.map(|end| (end, [half * force[0], half * force[1], 0.0])));
    }
    solver.compliance(&parts) / (SIZE[0] * SIZE[1])
}

/// 1/E(theta) = c^4/E_1 + s^4/E_2 + (1/G - 2 nu/E_1) c^2 s^2, theta between pull and warp. Jones, "Mechanics of composite materials" (1999),
/// equation 2.97.
#[test]
fn a_coupon_askew_stretches_as_an_orthotropic_one() {
    for shear in [0.05, 0.2, 1.0, 2.5] {
        let g = shear * STRETCH / (2.0 * (1.0 + POISSON));
        for degrees in [0.0, 17.0, 45.0, -30.0, 90.0, 110.0] {
            let (s, c) = f64::to_radians(degrees).sin_cos();
            let exact =
                (c.powi(4) + s.powi(4)) / STRETCH + (1.0 / g - 2.0 * POISSON / STRETCH) * (c * s).powi(2);
            let computed = compliance(fabric(shear, degrees), [1.0, 0.0], 0.0);
            assert!((computed / exact - 1.0).abs() < 1e-9, "{shear} {degrees}: {computed} {exact}");
        }
    }
}

/// The stress is G gamma along warp and weft, and does not depend on G half way between them, where shear is a pull and a push.
#[test]
fn a_shear_frame_feels_the_shear_modulus_alone() {
    for shear in [0.05, 0.2, 2.5] {
        let even = STRETCH / (2.0 * (1.0 + POISSON));
        for (degrees, modulus) in [(0.0, shear * even), (90.0, shear * even), (45.0, even), (-45.0, even)] {
            let computed = compliance(fabric(shear, degrees), [0.0, 0.0], 1.0);
            assert!((computed * modulus - 1.0).abs() < 1e-9, "{shear} {degrees}: {computed} {modulus}");
        }
    }
}

/// Which way a pull shears a coupon: by the sign of the warp's angle. By reciprocity half the difference of the works of both together.
#[test]
fn a_pull_shears_towards_the_warp() {
    let (shear, degrees) = (0.2, 25.0);
    let g = shear * STRETCH / (2.0 * (1.0 + POISSON));
    let (s, c) = f64::to_radians(degrees).sin_cos();
    // S_16 of the compliance in the coupon's axes: Jones, equation 2.85, with E_1 = E_2.
    let bracket = 2.0 / STRETCH + 2.0 * POISSON / STRETCH - 1.0 / g;
    let exact = bracket * s * c * (c * c - s * s);
    for (side, exact) in [(degrees, exact), (-degrees, -exact)] {
        let compliance_at = |tangential: f64| compliance(fabric(shear, side), [1.0, 0.0], tangential);
        let coupling = (compliance_at(1.0) - compliance_at(-1.0)) / 4.0;
        assert!((coupling / exact - 1.0).abs() < 1e-9, "{side}: {coupling} {exact}");
    }
}

/// The compliance of an orthotropic sheet of Y = 1 in axes of which the first lies at `angle` to the warp, by S11, S22, S12; the last row gives
/// 2 E12. Jones, "Mechanics of composite materials" (1999), equation 2.85.
fn compliances(g: f64, angle: f64) -> [[f64; 3]; 3] {
    let (s, c) = angle.sin_cos();
    let (fourth, square, mixed) = (c.powi(4) + s.powi(4), (c * s).powi(2), s * c * (c * c - s * s));
    let s11 = fourth + (1.0 / g - 2.0 * POISSON) * square;
    let s12 = (2.0 - 1.0 / g) * square - POISSON * fourth;
    let s16 = (2.0 + 2.0 * POISSON - 1.0 / g) * mixed;
    let s66 = 4.0 * (2.0 + 2.0 * POISSON) * square + (c * c - s * s).powi(2) / g;
    [[s11, s12, s16], [s12, s11, -s16], [s16, -s16, s66]]
}

/// Stretches a (along) and b (hoop) of a round tube of two sheets of width 1 and Y = 1 under `pressure`, and how far one seam shifts along
/// the other, k: x = a X + k Y, hoop b Y. Its ends bear the pressure as walls do, so its potential is Psi(E) - p a b^2 / (2 pi) by flat area.
fn tube(compliance: [[f64; 3]; 3], pressure: f64) -> [f64; 3] {
    let [mut a, mut b, mut k] = [1.0_f64, 1.0, 0.0];
    for _ in 0..100 {
        let s22 = pressure * a / std::f64::consts::PI;
        let s12 = -s22 * k / a;
        let s11 = (pressure * b * b / (2.0 * std::f64::consts::PI) - s12 * k) / a;
        let [e11, e22, e12] = compliance.map(|row| row[0] * s11 + row[1] * s22 + row[2] * s12);
        a = (1.0 + 2.0 * e11).sqrt();
        k = e12 / a;
        b = (1.0 + 2.0 * e22 - k * k).sqrt();
    }
    [a, b, k]
}

/// A long tube with straight seams: its length, and the shift of one seam, which is zero where the warp lies at 0 or 45 deg.
#[test]
fn an_inflated_tube_changes_its_length_and_shifts_its_seams() -> Result<(), MeshFault> {
    let (shear, pressure, bending) = (0.2, 0.03, 1e-5);
    let [length, width] = [6.0, 1.0];
    for degrees in [20.0, -20.0, 45.0] {
        let weave = Weave { shear, warp: f64::to_radians(degrees) };
        let fabric = Fabric::isotropic(1.0, bending, POISSON).woven(weave);
        let borders = [Border::Rim(0), Border::Free, Border::Rim(1), Border::Free];
        let mesh = rectangle([length, width], [36, 16], Diagonal::Alternating, 0.0, borders)?;
        let mut supports = Supports::new(&mesh, Vec::new());
        let point_at =
            |place: [f64; 2]| mesh.points.iter().position(|point| *point == place).expect("a point");
        let places = [[2.0, 0.0], [4.0, 0.0], [2.0, width], [4.0, width]].map(point_at);
        for (point, axis) in [(places[0], 0), (places[0], 1), (places[1], 1)] {
            supports.fix(point, axis);
        }
        let mut solver = Solver::new(Sheet::new(&mesh, fabric), supports).expect("small");
        let continuation = Continuation { first: bending, last: pressure, floor: 1e-13 };
        let equilibrium = continuation.run(&mut solver, |_| {}).map_err(|broken| broken.why).expect("a tube");
        let x = places.map(|place| equilibrium.state.points[place]);
        let computed = [
            (x[1][0] - x[0][0] + x[3][0] - x[2][0]) / 4.0,
            (x[2][0] + x[3][0] - x[0][0] - x[1][0]) / (2.0 * width),
            (x[2][1] + x[3][1] - x[0][1] - x[1][1]) / 4.0 * std::f64::consts::PI / width,
        ];
        let g = shear / (2.0 * (1.0 + POISSON));
        let [a, b, k] = tube(compliances(g, weave.warp), pressure);
        assert!(((computed[0] - 1.0) / (a - 1.0) - 1.0).abs() < 0.01, "{degrees}: {computed:?} {a}");
        assert!((computed[1] - k).abs() < 0.01 * k.abs().max(1e-9), "{degrees}: {computed:?} {k}");
        // The sheet is bent beside its seams, which makes the tube a little wider.
        assert!((computed[2] / b - 1.0).abs() < 0.015, "{degrees}: {computed:?} {b}");
    }
    Ok(())
}

/// Factor by which a bias strip of `widths` widths seems stiffer than 1/E(45 deg) between clamps, which hold its width at both ends.
fn clamped(shear: f64, widths: f64) -> f64 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few cells")]
    let cells = [(16.0 * widths) as usize, 16];
    let mesh =
        rectangle([widths, 1.0], cells, Diagonal::Alternating, 0.0, [Border::Free; 4]).expect("a rectangle");
    let mut supports = Supports::free(mesh.points.len());
    let at_end = |x: f64| x == 0.0 || (x - widths).abs() < 1e-12;
    for (point, place) in mesh.points.iter().enumerate() {
        supports.fix(point, 2);
        if at_end(place[0]) {
            supports.fix(point, 0);
            supports.fix(point, 1);
        }
    }
    let mut solver = Solver::new(Sheet::new(&mesh, fabric(shear, 45.0)), supports).expect("small");
    let mut state = solver.assembly.sheet.flat();
    let strain = 1e-5;
    state.points.iter_mut().for_each(|x| x[0] *= 1.0 + strain);
    let rest = solver.settle(&mut state, Aim { pressure: 0.0, tolerance: 1e-12 }).expect("an equilibrium");
    let stiffness = 2.0 * rest.energy.membrane / (widths * strain * strain);
    let g = shear * STRETCH / (2.0 * (1.0 + POISSON));
    let exact = 4.0 / (1.0 / g + 2.0 * (1.0 - POISSON) / STRETCH);
    stiffness / exact
}

#[test]
fn clamps_stiffen_a_short_bias_strip() {
    let [long, short] = [5.0, 2.0].map(|widths| clamped(0.2, widths));
    assert!((1.0..1.1).contains(&long) && short > long + 0.05, "{long} {short}");
}
