//! Plates and strips with exact solutions; laws that equilibria must obey.

use super::*;
use crate::shell::assembly::{Plane, Sheet, State, Supports};
use crate::shell::element::Fabric;
use crate::shell::mesh::{Border, Diagonal, HalfActuator, Mesh, MeshFault, Sizes, rectangle};

const RIM: Border = Border::Rim(0);

/// A quarter of the square of side 1, between the planes x = 0 and y = 0 through its middle.
fn quarter(cells: usize, diagonal: Diagonal, outer: [Border; 2]) -> Result<(Mesh, Vec<Plane>), MeshFault> {
    let borders = [Border::Mirror(1), outer[0], outer[1], Border::Mirror(0)];
    let mesh = rectangle([0.5, 0.5], [cells, cells], diagonal, 0.0, borders)?;
    let plane = |point, normal| Plane { point, normal };
    let planes = vec![
        plane([0.0, 0.0], [-1.0, 0.0]),
        plane([0.0, 0.0], [0.0, -1.0]),
        plane([0.5, 0.0], [1.0, 0.0]),
        plane([0.0, 0.5], [0.0, 1.0]),
    ];
    Ok((mesh, planes))
}

/// The height of the middle of a plate of B = 1 under so little pressure that it is linear, by p a^4/B.
fn middle(mesh: &Mesh, supports: Supports) -> Result<f64, Stop> {
    let fabric = Fabric::isotropic(100.0, 1.0, 0.3);
    let mut solver = Solver::new(Sheet::new(mesh, fabric), supports).ok_or(Stop::Iterations)?;
    let mut state = solver.assembly.sheet.flat();
    let pressure = 1e-4;
    let _ = solver.settle(&mut state, Aim { pressure, tolerance: 1e-12 })?;
    Ok(state.points[0][2] / pressure)
}

#[test]
fn a_simply_supported_square_plate_rises_as_it_must() -> Result<(), MeshFault> {
    for diagonal in [Diagonal::Rising, Diagonal::Falling, Diagonal::Alternating, Diagonal::Crossed] {
        let (mesh, planes) = quarter(16, diagonal, [RIM, RIM])?;
        let height = middle(&mesh, Supports::new(&mesh, planes));
        let error = height.map(|height| (height / 0.004_062_4 - 1.0).abs());
        assert!(error.is_ok_and(|error| error < 0.01), "{diagonal:?}: {height:?}");
    }
    Ok(())
}

#[test]
fn a_clamped_square_plate_rises_as_it_must() -> Result<(), MeshFault> {
    // A mirror plane that is also held down is a clamp.
    let (mesh, planes) = quarter(20, Diagonal::Alternating, [Border::Mirror(2), Border::Mirror(3)])?;
    let mut supports = Supports::new(&mesh, planes);
    for (k, point) in mesh.points.iter().enumerate().filter(|(_, p)| p[0] == 0.5 || p[1] == 0.5) {
        assert!(point[0] <= 0.5);
        supports.fix(k, 2);
    }
    let height = middle(&mesh, supports);
    let error = height.map(|height| (height / 0.001_265_3 - 1.0).abs());
    assert!(error.is_ok_and(|error| error < 0.015), "{height:?}");
    Ok(())
}

#[test]
fn an_endless_strip_without_bending_becomes_an_arc() -> Result<(), MeshFault> {
    // Half the strip |x| < 1/2 of a membrane held at its edges: its stretch and its arc from one equation.
    let (stretch, nu, pressure) = (1.0, 0.39, 0.05);
    let fabric = Fabric::isotropic(stretch, 1e-8, nu);
    let sides = [Border::Mirror(1), RIM, Border::Mirror(2), Border::Mirror(0)];
    let mesh = rectangle([0.5, 0.1], [40, 3], Diagonal::Alternating, 0.0, sides)?;
    let planes = vec![
        Plane { point: [0.0, 0.0], normal: [-1.0, 0.0] },
        Plane { point: [0.0, 0.0], normal: [0.0, -1.0] },
        Plane { point: [0.0, 0.1], normal: [0.0, 1.0] },
    ];
    let mut supports = Supports::new(&mesh, planes);
    for k in (0..mesh.points.len()).filter(|k| mesh.points[*k][0] == 0.5) {
        supports.fix(k, 0); // along x, which is also the way along the mirror planes
    }
    let solved = Solver::new(Sheet::new(&mesh, fabric), supports).map(|mut solver| {
        let continuation = Continuation { first: fabric.bending, last: pressure, floor: 1e-13 };
        continuation.run(&mut solver, |_| {}).map(|equilibrium| equilibrium.rest.energy.volume)
    });
    let tension = |angle: f64| {
        let stretched = angle / angle.sin();
        stretch / (1.0 - nu * nu) * (stretched * stretched - 1.0) / 2.0 * stretched
    };
    let (mut low, mut high) = (1e-3, 1.5);
    for _ in 0..60 {
        let angle = f64::midpoint(low, high);
        // p R = T, R = (1/2)/sin.
        if tension(angle) * angle.sin() * 2.0 < pressure { low = angle } else { high = angle }
    }
    let radius = 0.5 / low.sin();
    let exact = 0.1 * radius * radius * (low - low.sin() * low.cos()) / 2.0;
    let volume = solved.and_then(Result::ok);
    assert!(volume.is_some_and(|volume| (volume / exact - 1.0).abs() < 0.003), "{volume:?} {exact}");
    Ok(())
}

/// Half a coarse V-actuator, with W = Y = 1.
fn actuator() -> Result<(Solver, f64), MeshFault> {
    let half = HalfActuator { r: 0.1, w: 1.0, l: 2.5, phi_0: 1.0 };
    let mesh = half.mesh(&Sizes::for_tube(1.0, 4.0))?.mesh;
    let mut supports = Supports::new(&mesh, vec![Plane { point: [0.0, 0.0], normal: [0.0, -1.0] }]);
    let inner = (0..mesh.points.len()).filter(|k| mesh.points[*k][1] == 0.0);
    let inner = inner.min_by(|a, b| mesh.points[*a][0].total_cmp(&mesh.points[*b][0])).unwrap_or(0);
    supports.fix(inner, 0);
    let fabric = Fabric::isotropic(1.0, 2e-5, 0.39);
    let solver = Solver::new(Sheet::new(&mesh, fabric), supports).ok_or(MeshFault::Empty)?;
    Ok((solver, fabric.bending))
}

fn continuation(bending: f64, bendability: f64) -> Continuation {
    Continuation { first: bending, last: bendability * bending, floor: 1e-14 }
}

#[test]
fn more_pressure_gains_the_volume() -> Result<(), MeshFault> {
    let (mut solver, bending) = actuator()?;
    for bendability in [5.0, 30.0, 100.0] {
        let Ok(equilibrium) = continuation(bending, bendability).run(&mut solver, |_| {}) else {
            panic!("no equilibrium at {bendability}");
        };
        let mut volume_at = |factor: f64| {
            let (mut state, pressure) = (equilibrium.state.clone(), factor * equilibrium.pressure);
            let rest = solver.settle(&mut state, Aim { pressure, tolerance: 1e-14 });
            rest.map_or(f64::NAN, |rest| rest.energy.total(pressure))
        };
        let step = 1e-3;
        let slope = (8.0 * (volume_at(1.0 + step) - volume_at(1.0 - step))
            - (volume_at(1.0 + 2.0 * step) - volume_at(1.0 - 2.0 * step)))
            / (12.0 * step * equilibrium.pressure);
        let error = (slope / -equilibrium.rest.energy.volume - 1.0).abs();
        assert!(error < 1e-6, "{bendability}: {error:e}");
    }
    Ok(())
}

#[test]
fn repeats_have_the_same_bits_and_threads_do_not_matter() {
    let run = || -> Option<State> {
        let (mut solver, bending) = actuator().ok()?;
        continuation(bending, 20.0).run(&mut solver, |_| {}).ok().map(|equilibrium| equilibrium.state)
    };
    let first = run();
    let repeats: Vec<Option<State>> = std::thread::scope(|scope| {
        let threads = [0, 1].map(|_| scope.spawn(run));
        threads.into_iter().map(|thread| thread.join().ok().flatten()).collect()
    });
    assert!(first.is_some() && repeats.iter().all(|other| *other == first));
}

#[test]
fn the_factor_is_small() -> Result<(), MeshFault> {
    let (solver, _) = actuator()?;
    let by_unknown = solver.factor_size() / solver.assembly.unknowns();
    assert!(by_unknown < 100, "{by_unknown} numbers an unknown");
    Ok(())
}

#[test]
fn a_told_stop_ends_at_the_next_step() -> Result<(), MeshFault> {
    let (mut solver, bending) = actuator()?;
    solver.cancel.store(true, std::sync::atomic::Ordering::Relaxed);
    let stopped = continuation(bending, 20.0).run(&mut solver, |_| {});
    assert!(stopped.is_err_and(|stopped| stopped.why == Stop::Cancelled && stopped.last.is_none()));
    Ok(())
}

/// A flap is a plate that is clamped along one edge and free along the other: the load on the free one under which it buckles is Euler's.
#[test]
fn a_flap_buckles_under_eulers_load() -> Result<(), MeshFault> {
    // Depth, and bending stiffness of one sheet of the paper's fabric.
    let (depth, bending) = (3e-3, 3.397e-4);
    let borders = [Border::Mirror(1), Border::Mirror(2), Border::Free, Border::Mirror(0)];
    let mesh = rectangle([0.3, 1.0], [5, 16], Diagonal::Alternating, 0.0, borders)?;
    let plane = |point, normal| Plane { point, normal };
    let planes =
        vec![plane([0.0, 0.0], [-1.0, 0.0]), plane([0.0, 0.0], [0.0, -1.0]), plane([0.3, 0.0], [1.0, 0.0])];
    let mut supports = Supports::new(&mesh, planes);
    for k in (0..mesh.points.len()).filter(|k| mesh.points[*k][1] == 0.0) {
        supports.fix(k, 2);
    }
    // Two fused sheets, lengths by the depth; so stiff in its plane that it buckles before it is shortened.
    let (stretch, fused) = (1e9, 8.0 * bending / (depth * depth));
    let mut solver = Solver::new(Sheet::new(&mesh, Fabric::isotropic(stretch, fused, 0.39)), supports)
        .ok_or(MeshFault::Empty)?;
    let mut lowest = |load: f64| {
        let mut state = solver.assembly.sheet.flat();
        // Held to its length, under a load across it.
        let strain = load * (1.0 - 0.39 * 0.39) / stretch;
        state.points.iter_mut().for_each(|x| x[1] *= 1.0 - strain);
        solver.lowest_eigenvalue(&state, 1e-3 * load, &[]).unwrap_or(f64::NAN)
    };
    let euler = 8.0 * bending * (std::f64::consts::PI / (2.0 * depth)).powi(2);
    let (below, above) = (lowest(0.99 * euler), lowest(1.01 * euler));
    assert!(below > 0.0 && above < 0.0, "{euler}: {below} {above}");
    Ok(())
}
