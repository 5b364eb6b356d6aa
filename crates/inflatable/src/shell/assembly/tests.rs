//! Gradients and Hessians against finite differences.

mod exact;

use super::*;
use crate::shell::element::{Fabric, Weave};
use crate::shell::mesh::{Border, Diagonal, Mesh, MeshFault, rectangle};

const FABRIC: Fabric = Fabric::isotropic(1.3, 0.07, 0.39);
/// Woven askew to the mesh, and soft in shear.
const WOVEN: Fabric = FABRIC.woven(Weave { shear: 0.2, warp: 0.4 });
const PRESSURE: f64 = 0.4;

/// A number from -1 to 1 that looks like chance.
fn noise(seed: usize) -> f64 {
    let x = (f64::from(u32::try_from(seed).unwrap_or(0)) * 12.9898 + 4.1).sin() * 43758.5453;
    2.0 * (x - x.floor()) - 1.0
}

fn mesh(diagonal: Diagonal, turn: f64) -> Result<Mesh, MeshFault> {
    let borders = [Border::Rim(0), Border::Mirror(1), Border::Free, Border::Mirror(0)];
    rectangle([1.5, 1.0], [3, 2], diagonal, turn, borders)
}

/// The rectangle between two planes, turned; its supports; and a crumpled state that they allow.
fn crumpled(fabric: Fabric, diagonal: Diagonal, turn: f64) -> Result<(Assembly, State), MeshFault> {
    with_margin(fabric, diagonal, turn, None)
}

/// The mesh with its upper row as a margin.
fn with_margin(
    fabric: Fabric,
    diagonal: Diagonal,
    turn: f64,
    margin: Option<Compression>,
) -> Result<(Assembly, State), MeshFault> {
    let strip = mesh(diagonal, turn)?;
    let (sine, cosine) = turn.sin_cos();
    let planes = vec![
        Plane { point: [0.0, 0.0], normal: [-cosine, -sine] },
        Plane { point: [1.5 * cosine, 1.5 * sine], normal: [cosine, sine] },
    ];
    let mut supports = Supports::new(&strip, planes);
    let mut sheet = Sheet::new(&strip, fabric);
    if let Some(law) = margin {
        let first = strip.triangles.len() / 2;
        sheet.set_margin(first, law);
        supports.keep_level(&strip, first);
    }
    let assembly = Assembly::new(sheet, supports);
    let mut state = assembly.sheet.flat();
    let step: Vec<f64> = (0..assembly.unknowns()).map(|k| 0.12 * noise(k)).collect();
    assembly.advance(&mut state, &step, 1.0);
    Ok((assembly, state))
}

fn moved(assembly: &Assembly, state: &State, unknown: usize, distance: f64) -> State {
    let mut moved = state.clone();
    let mut step = vec![0.0; assembly.unknowns()];
    step[unknown] = distance;
    assembly.advance(&mut moved, &step, 1.0);
    moved
}

/// What gradients and Hessians are tried on.
fn all_sheets() -> impl Iterator<Item = (Assembly, State)> {
    let margins = [None, Some(Compression::Elastic), Some(Compression::Wrinkled(0.01))];
    let sheet =
        |(fabric, diagonal, turn), margin| with_margin(fabric, diagonal, turn, margin).expect("a mesh");
    let with_margins = move |cut| margins.map(|margin| sheet(cut, margin)).into_iter();
    fabrics_and_cuts().flat_map(move |cut| with_margins(cut).chain([wrinkled(cut)]))
}

/// A crumpled sheet that wrinkles.
fn wrinkled((fabric, diagonal, turn): (Fabric, Diagonal, f64)) -> (Assembly, State) {
    let (assembly, state) = crumpled(fabric, diagonal, turn).expect("a mesh");
    let Assembly { mut sheet, supports, .. } = assembly;
    sheet.wrinkle(0.01, 0.5);
    (Assembly::new(sheet, supports), state)
}

/// Steps of differences. The law of sheets that give way, the last two of four, has kinks: steps as short as this meet none.
fn step_of(index: usize) -> f64 {
    if index % 4 >= 2 { 1e-4 } else { 1e-3 }
}

fn fabrics_and_cuts() -> impl Iterator<Item = (Fabric, Diagonal, f64)> {
    [FABRIC, WOVEN].into_iter().flat_map(|fabric| CUTS.map(|(diagonal, turn)| (fabric, diagonal, turn)))
}

const CUTS: [(Diagonal, f64); 4] = [
    (Diagonal::Rising, 0.0),
    (Diagonal::Falling, 0.7),
    (Diagonal::Alternating, 2.9),
    (Diagonal::Crossed, -1.1),
];

#[test]
fn the_gradient_is_that_of_the_energy() {
    for (index, (mut assembly, state)) in all_sheets().enumerate() {
        let _ = assembly.differentiate(&state, PRESSURE);
        let gradient = assembly.gradient().to_vec();
        let largest = gradient.iter().fold(0.0_f64, |most, g| most.max(g.abs()));
        for (unknown, slope) in gradient.iter().enumerate() {
            let mut energy_at = |by: f64| {
                let shifted = moved(&assembly, &state, unknown, by);
                assembly.energy(&shifted).total(PRESSURE)
            };
            let step = step_of(index);
            // A difference of sixth order.
            let difference_quotient = (45.0 * (energy_at(step) - energy_at(-step))
                - 9.0 * (energy_at(2.0 * step) - energy_at(-2.0 * step))
                + (energy_at(3.0 * step) - energy_at(-3.0 * step)))
                / (60.0 * step);
            let error = (difference_quotient - slope).abs() / largest;
            assert!(error < 1e-7, "sheet {index}, {unknown}: {difference_quotient} {slope} {error:e}");
        }
    }
}

#[test]
fn the_hessian_is_that_of_the_gradient() {
    // The sparse lower triangle is filled into a dense matrix. Each of its rows is compared with a sixth-order
    // difference quotient of the gradient.
    for (index, (mut assembly, state)) in all_sheets().enumerate() {
        let _ = assembly.linearise(&state, PRESSURE, Tangent::Exact);
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
        for (unknown, row) in hessian.iter().enumerate() {
            let mut gradient_at = |by: f64| {
                let shifted = moved(&assembly, &state, unknown, by);
                let _ = assembly.differentiate(&shifted, PRESSURE);
                assembly.gradient().to_vec()
            };
            let step = step_of(index);
            let sides = [
                gradient_at(step),
                gradient_at(-step),
                gradient_at(2.0 * step),
                gradient_at(-2.0 * step),
                gradient_at(3.0 * step),
                gradient_at(-3.0 * step),
            ];
            for (other, entry) in row.iter().enumerate() {
                let pair = |k: usize| sides[k][other] - sides[k + 1][other];
                let difference_quotient = (45.0 * pair(0) - 9.0 * pair(2) + pair(4)) / (60.0 * step);
                let error = (difference_quotient - entry).abs() / largest;
                assert!(error < 1e-6, "sheet {index}, {unknown} {other}: {difference_quotient} {error:e}");
            }
        }
    }
}

#[test]
fn a_weave_as_stiff_in_shear_as_isotropic_fabric_changes_no_bit() -> Result<(), MeshFault> {
    let numbers = |fabric: Fabric| -> Result<_, MeshFault> {
        let (mut assembly, state) = crumpled(fabric, Diagonal::Falling, 0.7)?;
        let energy = assembly.linearise(&state, PRESSURE, Tangent::Exact);
        Ok((energy, assembly.gradient().to_vec(), assembly.hessian().2.to_vec()))
    };
    let isotropic = numbers(FABRIC)?;
    assert!(numbers(FABRIC.woven(Weave { shear: 1.0, warp: 0.7 }))? == isotropic);
    // And nearly so is nearly the same: no jump.
    let (energy, ..) = numbers(FABRIC.woven(Weave { shear: 1.0 + 1e-12, warp: 0.7 }))?;
    for (near, even) in [(energy.membrane, isotropic.0.membrane), (energy.bending, isotropic.0.bending)] {
        assert!((near / even - 1.0).abs() < 1e-11, "{near} {even}");
    }
    Ok(())
}

/// Without compression a sheet resists every motion at least as much as with it, and a taut one as much.
#[test]
fn a_sheet_without_compression_is_nowhere_softer() {
    // The quadratic form of both Hessians is taken for random motions of each sheet. Then the sheets are pulled taut,
    // where both must agree.
    for (index, (mut assembly, mut state)) in all_sheets().enumerate() {
        let flat = assembly.sheet.flat();
        let mut second_change = |state: &State, tangent, seed: usize| {
            let _ = assembly.linearise(state, PRESSURE, tangent);
            let (starts, rows, values) = assembly.hessian();
            let x = |k: u32| noise(seed + k as usize);
            let mut sum = 0.0;
            for (column, start) in (0..).zip(starts.windows(2)) {
                for at in start[0]..start[1] {
                    let (row, value) = (rows[at as usize], values[at as usize]);
                    sum += if row == column { 1.0 } else { 2.0 } * value * x(row) * x(column);
                }
            }
            sum
        };
        let mut gains = 0;
        for seed in 0..20 {
            let [tensile, exact] =
                [Tangent::Tensile, Tangent::Exact].map(|tangent| second_change(&state, tangent, seed));
            assert!(tensile >= exact - 1e-9 * exact.abs(), "sheet {index}: {tensile} {exact}");
            gains += usize::from(tensile > exact);
        }
        assert!(gains > 0, "sheet {index}");
        for (x, flat) in state.points.iter_mut().zip(&flat.points) {
            *x = [1.3 * flat[0], 1.2 * flat[1], 0.0];
        }
        let [tensile, exact] =
            [Tangent::Tensile, Tangent::Exact].map(|tangent| second_change(&state, tangent, 7));
        assert!((tensile / exact - 1.0).abs() < 1e-12, "sheet {index}: {tensile} {exact}");
    }
}
