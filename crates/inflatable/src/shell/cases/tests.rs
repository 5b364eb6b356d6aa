//! Cases on coarse meshes: laws that hold on every mesh, and published numbers.

use super::arm_line::ArmLine;
use super::bend::{Bend, angle_of};
use super::cell::{Cell, cell};
use super::*;
use crate::shell::assembly::{Plane, Sheet, Supports};
use crate::shell::contact::{Contact, Obstacle};
use crate::shell::element::Fabric;
use crate::shell::mesh::{HalfActuator, HalfSector, Sizes};
use crate::shell::solver::{Aim, Solver};
use std::f64::consts::PI;

/// The paper's fabric, E = 128 MPa, nu = 0.39, of thickness `t`, m.
fn fabric(t: f64) -> Fabric {
    let (e, nu) = (128e6, 0.39);
    Fabric::isotropic(e * t, e * t.powi(3) / (12.0 * (1.0 - nu * nu)), nu)
}

/// As thick as the paper's: t = 0.3 mm.
pub(super) fn tube(width: f64, pressure: f64) -> Tube {
    Tube { width, fabric: fabric(0.3e-3), pressure }
}

fn v_actuator() -> VActuator {
    VActuator {
        tube: tube(0.02, 14e3),
        radius: 0.002,
        arm_length: 0.06,
        angle: PI / 3.0,
        margin: Margin::NONE,
    }
}

#[test]
fn the_moment_is_the_energy_s_slope() {
    let case = v_actuator();
    let half = HalfActuator { r: 0.1, w: 1.0, l: 3.0, phi_0: case.angle };
    let mesh = half.mesh(&Sizes::for_tube(1.0, 4.0)).expect("a mesh").mesh;
    let mut supports = Supports::new(&mesh, vec![Plane { point: [0.0, 0.0], normal: [0.0, -1.0] }]);
    let inner = (0..mesh.points.len()).filter(|k| mesh.points[*k][1] == 0.0);
    supports.fix(inner.min_by(|a, b| mesh.points[*a][0].total_cmp(&mesh.points[*b][0])).expect("a point"), 0);
    let mut solver = Solver::new(Sheet::new(&mesh, case.tube.scaled()), supports).expect("small");
    let continuation = case.tube.continuation();
    let equilibrium = continuation.run(&mut solver, |_| {}).expect("an equilibrium");
    let (sine, cosine) = (PI / 3.0).sin_cos();
    let line = ArmLine::new(&mesh, [-sine, cosine], [1.0, 2.0]);
    let free = angle_of(&line, &equilibrium.state);
    let bend = Bend { line: &line, aim: Aim { pressure: continuation.last, tolerance: 1e-13 } };
    for opening in [-0.02, 0.03, 0.06] {
        let mut state = equilibrium.state.clone();
        let moment = bend.hold(&mut solver, &mut state, free + opening).expect("held");
        assert!((angle_of(&line, &state) - free - opening).abs() < 1e-9);
        let mut energy = |by: f64| {
            let mut state = state.clone();
            let _ = bend.hold(&mut solver, &mut state, free + opening + by).expect("held");
            solver.assembly.energy(&state).total(continuation.last)
        };
        let step = 1e-3;
        let slope = (8.0 * (energy(step) - energy(-step)) - (energy(2.0 * step) - energy(-2.0 * step)))
            / (12.0 * step);
        assert!((4.0 * slope / moment - 1.0).abs() < 1e-6, "{opening}: {slope} {moment}");
    }
}

#[test]
fn an_actuator_coils_and_its_stiffness_is_the_moment_s_slope() {
    let case = v_actuator();
    let fineness = Fineness { cells: 4.0, cuts: 2 };
    let inflated = actuator(&case, &[], fineness, &Watch::default()).expect("an equilibrium");
    assert!((1.05..1.4).contains(&inflated.coiling.value), "{inflated:?}");
    assert!(inflated.volume.error < 0.03 * inflated.volume.value, "{:?}", inflated.volume);
    assert_eq!(inflated.evidence.unknowns.len(), 3);
    assert!(inflated.evidence.residual < 2e-8, "{}", inflated.evidence.residual);
    // The finest mesh's stiffness against the moments on both sides of its angle.
    let free = inflated.angle.meshes[2];
    let (angle_below, angle_above) = (free - 0.002, free + 0.002);
    let bent_actuator =
        actuator(&case, &[angle_below, angle_above], fineness, &Watch::default()).expect("an equilibrium");
    let slope = (bent_actuator.moments[1].1.meshes[2] - bent_actuator.moments[0].1.meshes[2]) / 0.004;
    assert!((slope / inflated.stiffness.meshes[2] - 1.0).abs() < 1e-3, "{slope} {:?}", inflated.stiffness);
}

#[test]
fn a_hinge_without_arms_is_what_the_section_says() {
    // W = 20 mm, R* = 0.1, 1/eps = 330: one dimension (a section of revolution with full hoop stiffness, t/W = 0.015,
    // nu = 0.39) gives lambda = 1.1536 and C alpha_0 = 1.6533 p W^3.
    let width = 0.02_f64;
    let mut slender = tube(width, 0.0);
    slender.pressure = 330.0 * slender.fabric.bending / width.powi(3);
    let case = Cell { tube: slender, radius: 0.002, arc: PI / 12.0 };
    let answer = cell(&case, Fineness { cells: 12.0, cuts: 2 }, &Watch::default()).expect("an equilibrium");
    assert!((answer.lambda.value - 1.1536).abs() < 0.003, "{:?}", answer.lambda);
    let stiffness = answer.stiffness.scaled(1.0 / (slender.pressure * width.powi(3)));
    assert!((stiffness.value / 1.6533 - 1.0).abs() < 0.06, "{stiffness:?}");
}

#[test]
fn size_does_not_matter_at_the_same_ratios() {
    // Lengths by 3, t with them: the same pressure, the same angle.
    let case = v_actuator();
    let Fabric { stretch, bending, poisson, .. } = case.tube.fabric;
    let large = VActuator {
        tube: Tube {
            width: 0.06,
            fabric: Fabric::isotropic(3.0 * stretch, 27.0 * bending, poisson),
            pressure: 14e3,
        },
        radius: 0.006,
        arm_length: 0.18,
        angle: case.angle,
        margin: Margin::NONE,
    };
    let fineness = Fineness { cells: 3.0, cuts: 2 };
    let run = |case| actuator(case, &[], fineness, &Watch::default()).expect("an equilibrium");
    let (small, large) = (run(&case), run(&large));
    assert!((small.angle.meshes[0] / large.angle.meshes[0] - 1.0).abs() < 1e-6);
    assert!((27.0 * small.volume.meshes[0] / large.volume.meshes[0] - 1.0).abs() < 1e-6);
    assert!((27.0 * small.stiffness.meshes[0] / large.stiffness.meshes[0] - 1.0).abs() < 1e-4);
}

#[test]
fn arms_that_meet_press_and_do_not_pass() {
    // The flat arms of six points meet when they inflate. They press on the plane between them and stay on their side
    // of it. Then an object in the middle is widened twice, and is pressed harder each time.
    let pressure = 37e3;
    let paper_tube = tube(0.03, pressure);
    let sector = HalfSector { n: 6, rho_0: 5.0 / 3.0, w: 1.0, phi_i: PI / 6.0, r_i: 0.0, r_e: 0.0 };
    let mesh = sector.mesh(&Sizes::for_tube(1.0, 4.0)).expect("a mesh").mesh;
    let (sine, cosine) = (PI / 6.0).sin_cos();
    let tip = Plane { point: [0.0, 0.0], normal: [-sine, cosine] };
    let supports = Supports::new(&mesh, vec![Plane { point: [0.0, 0.0], normal: [0.0, -1.0] }, tip]);
    let mut solver = Solver::new(Sheet::new(&mesh, paper_tube.scaled()), supports).expect("small");
    let contact = Contact::new(&solver.assembly, vec![Obstacle::Wall(tip), Obstacle::Post { radius: 0.0 }]);
    solver.contact = Some(contact);
    let equilibrium = paper_tube.continuation().run(&mut solver, |_| {}).expect("an equilibrium");
    let force = |solver: &Solver, k| solver.contact.as_ref().map_or(0.0, |contact| contact.force(k));
    assert!(force(&solver, 0) > 0.0, "the arms do not touch");
    let deepest = equilibrium.state.points.iter().map(|x| tip.distance(*x)).fold(f64::INFINITY, f64::min);
    assert!(deepest > -1e-3, "{deepest}");
    // An object that the corners close on is pressed; a larger one more.
    let nearest = equilibrium.state.points.iter().map(|x| x[0].hypot(x[1])).fold(f64::INFINITY, f64::min);
    let (mut state, mut previous_force) = (equilibrium.state.clone(), 0.0);
    for opening in [0.03, 0.06] {
        let radius = nearest + opening;
        if let Some(contact) = &mut solver.contact {
            contact.replace(1, Obstacle::Post { radius });
        }
        let _ = solver
            .rest(&mut state, paper_tube.continuation().aim(equilibrium.pressure))
            .expect("an equilibrium");
        let least_radius = state.points.iter().map(|x| x[0].hypot(x[1])).fold(f64::INFINITY, f64::min);
        assert!(least_radius > radius - 1e-3, "{least_radius} {radius}");
        assert!(force(&solver, 1) > previous_force, "{opening}");
        previous_force = force(&solver, 1);
    }
}

/// A corner's rim of R* = 0.003: its smallest triangles have a millionth of W^2. Finer meshes begin from the coarser shape all the same,
/// and do not start from flat, which takes several hundred steps.
#[test]
fn a_rim_that_is_sharp_and_not_a_point_is_found() {
    let case = FlatStar {
        tube: Tube { width: 0.0293, fabric: fabric(0.484e-3), pressure: 18.5e3 },
        points: 3,
        inner_radius: 0.0349,
        tip_angle: 23.2_f64.to_radians(),
        tip_radius: 0.006,
        corner_radius: 0.0001,
        band: 0.002,
        margin: Margin::NONE,
    };
    let fineness = Fineness { cells: 4.0, cuts: 2 };
    let inflated = star(&case, Objects::Radii(&[]), fineness, &Watch::default()).expect("an equilibrium");
    let iterations: u32 = inflated.evidence.efforts.iter().map(|effort| effort.iterations).sum();
    assert!(iterations < 200, "{iterations}");
    assert!((0.015..0.025).contains(&inflated.final_radius.value), "{:?}", inflated.final_radius);
}

/// At 1/eps = 1 this thin sheet is stretched by a millionth, and its energy depends on the square of that: a test of rounding.
#[test]
fn a_sheet_that_is_hardly_stretched_comes_to_rest() {
    let fabric = Fabric::isotropic(8452.0, 3.8726e-6, 0.455);
    let case = VActuator {
        tube: Tube { width: 0.0637, fabric, pressure: 0.183 },
        radius: 0.0,
        arm_length: 0.546,
        angle: 0.722,
        margin: Margin::NONE,
    };
    let answer = actuator(&case, &[], Fineness { cells: 4.0, cuts: 2 }, &Watch::default());
    let coiling = answer.expect("an equilibrium").coiling.value;
    assert!((1.0..1.01).contains(&coiling), "{coiling}");
}

/// The mesh that one family begins objects on is the second of the other, which has its starts from the first.
#[test]
fn objects_begun_from_a_coarser_mesh_push_as_those_opened_step_by_step() {
    let case = FlatStar {
        tube: Tube { width: 0.03, fabric: fabric(0.6e-3), pressure: 20e3 },
        points: 5,
        inner_radius: 0.05,
        tip_angle: 50.0_f64.to_radians(),
        tip_radius: 0.003,
        corner_radius: 0.003,
        band: 0.002,
        margin: Margin::NONE,
    };
    let openings = [0.004];
    let run = |cuts| {
        let fineness = Fineness { cells: 2.0, cuts };
        star(&case, Objects::Openings(&openings), fineness, &Watch::default()).expect("equilibria")
    };
    let (from_coarse, stepped) = (run(2), run(3));
    for ((_, from_coarse), (_, stepped)) in from_coarse.forces.iter().zip(&stepped.forces) {
        let ratio = from_coarse.meshes[1] / stepped.meshes[0];
        assert!((ratio - 1.0).abs() < 1e-3, "{ratio}: {from_coarse:?} {stepped:?}");
        assert!(from_coarse.meshes[1] > 0.5, "{from_coarse:?}");
    }
}

#[test]
fn what_no_shell_describes_is_refused_in_words() {
    let run = |case: &VActuator| actuator(case, &[], Fineness { cells: 3.0, cuts: 2 }, &Watch::default());
    let mut case = v_actuator();
    case.tube.pressure = 1e6;
    let fault = run(&case).expect_err("too much pressure");
    let ShellFault::Pressure { least: minimum, most: maximum, .. } = fault else { panic!("{fault}") };
    for (pressure, fits) in
        [(1.001 * minimum, true), (0.999 * maximum, true), (0.999 * minimum, false), (1.001 * maximum, false)]
    {
        case.tube.pressure = pressure;
        assert_eq!(case.tube.check().is_ok(), fits, "{pressure}");
    }
    case = v_actuator();
    case.arm_length = 0.02;
    assert!(matches!(run(&case), Err(ShellFault::Range { name: Input::Arms, .. })));
    case.tube.width = f64::NAN;
    assert!(matches!(run(&case), Err(ShellFault::Range { name: Input::Width, .. })));
}
