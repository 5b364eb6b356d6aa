//! Gradients and Hessians against finite differences; states that the elements must reproduce exactly.

use super::*;
use crate::shell::element::Fabric;
use crate::shell::mesh::{Border, Diagonal, Mesh, MeshFault, rectangle};

const FABRIC: Fabric = Fabric { stretch: 1.3, bending: 0.07, poisson: 0.39 };
const PRESSURE: f64 = 0.4;

/// A number from -1 to 1 that looks like chance.
fn noise(seed: usize) -> f64 {
    let x = (seed as f64 * 12.9898 + 4.1).sin() * 43758.5453;
    2.0 * (x - x.floor()) - 1.0
}

fn mesh(diagonal: Diagonal, turn: f64) -> Result<Mesh, MeshFault> {
    let borders = [Border::Rim(0), Border::Mirror(1), Border::Free, Border::Mirror(0)];
    rectangle([1.5, 1.0], [3, 2], diagonal, turn, borders)
}

/// The rectangle between two planes, turned; its supports; and a crumpled state that they allow.
fn crumpled(diagonal: Diagonal, turn: f64) -> Result<(Assembly, State), MeshFault> {
    let mesh = mesh(diagonal, turn)?;
    let (sine, cosine) = turn.sin_cos();
    let planes = vec![
        Plane { point: [0.0, 0.0], normal: [-cosine, -sine] },
        Plane { point: [1.5 * cosine, 1.5 * sine], normal: [cosine, sine] },
    ];
    let supports = Supports::new(&mesh, planes);
    let assembly = Assembly::new(Sheet::new(&mesh, FABRIC), supports, None);
    let mut state = assembly.sheet.flat();
    let step: Vec<f64> = (0..assembly.unknowns()).map(|k| 0.12 * noise(k)).collect();
    assembly.advance(&mut state, &step, 1.0);
    Ok((assembly, state))
}

fn moved(assembly: &Assembly, state: &State, unknown: usize, by: f64) -> State {
    let mut moved = state.clone();
    let mut step = vec![0.0; assembly.unknowns()];
    step[unknown] = by;
    assembly.advance(&mut moved, &step, 1.0);
    moved
}

const CUTS: [(Diagonal, f64); 4] =
    [(Diagonal::Rising, 0.0), (Diagonal::Falling, 0.7), (Diagonal::Alternating, 2.9), (Diagonal::Crossed, -1.1)];

#[test]
fn the_gradient_is_that_of_the_energy() -> Result<(), MeshFault> {
    for (diagonal, turn) in CUTS {
        let (mut assembly, state) = crumpled(diagonal, turn)?;
        let _ = assembly.differentiate(&state, PRESSURE);
        let gradient = assembly.gradient().to_vec();
        let largest = gradient.iter().fold(0.0_f64, |most, g| most.max(g.abs()));
        for unknown in 0..assembly.unknowns() {
            let mut at = |by: f64| {
                let moved = moved(&assembly, &state, unknown, by);
                assembly.energy(&moved).total(PRESSURE)
            };
            let step = 1e-3;
            // Of sixth order.
            let found = (45.0 * (at(step) - at(-step)) - 9.0 * (at(2.0 * step) - at(-2.0 * step))
                + (at(3.0 * step) - at(-3.0 * step)))
                / (60.0 * step);
            let error = (found - gradient[unknown]).abs() / largest;
            assert!(error < 1e-7, "{diagonal:?} {turn} {unknown}: {found} {} {error:e}", gradient[unknown]);
        }
    }
    Ok(())
}

#[test]
fn the_hessian_is_that_of_the_gradient() -> Result<(), MeshFault> {
    for (diagonal, turn) in CUTS {
        let (mut assembly, state) = crumpled(diagonal, turn)?;
        let _ = assembly.linearise(&state, PRESSURE);
        let count = assembly.unknowns();
        let mut hessian = vec![vec![0.0; count]; count];
        let (starts, rows, values) = assembly.hessian();
        for column in 0..count {
            for place in starts[column] as usize..starts[column + 1] as usize {
                hessian[rows[place] as usize][column] = values[place];
                hessian[column][rows[place] as usize] = values[place];
            }
        }
        let largest = hessian.iter().flatten().fold(0.0_f64, |most, h| most.max(h.abs()));
        for unknown in 0..count {
            let mut at = |by: f64| {
                let moved = moved(&assembly, &state, unknown, by);
                let _ = assembly.differentiate(&moved, PRESSURE);
                assembly.gradient().to_vec()
            };
            let step = 1e-3;
            let sides = [at(step), at(-step), at(2.0 * step), at(-2.0 * step), at(3.0 * step), at(-3.0 * step)];
            for other in 0..count {
                let pair = |k: usize| sides[k][other] - sides[k + 1][other];
                let found = (45.0 * pair(0) - 9.0 * pair(2) + pair(4)) / (60.0 * step);
                let error = (found - hessian[unknown][other]).abs() / largest;
                assert!(error < 1e-6, "{diagonal:?} {turn} {unknown} {other}: {found} {error:e}");
            }
        }
    }
    Ok(())
}
