//! The factor against nalgebra's dense one, and against answers that are exact.

use super::*;
use crate::numerics::Threads;
use nalgebra::{DMatrix, DVector};

/// The lower triangle of a matrix, without its zeros: where its columns begin, their rows, its values.
fn lower(matrix: &DMatrix<f64>) -> (Vec<u32>, Vec<u32>, Vec<f64>) {
    let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
    for column in 0..matrix.ncols() {
        for row in column..matrix.nrows() {
            if row == column || matrix[(row, column)] != 0.0 {
                rows.push(u32::try_from(row).unwrap_or(u32::MAX));
                values.push(matrix[(row, column)]);
            }
        }
        starts.push(u32::try_from(rows.len()).unwrap_or(u32::MAX));
    }
    (starts, rows, values)
}

/// The solution by the factor in single precision, and by that in double precision.
fn answers(matrix: &DMatrix<f64>, rhs: &[f64]) -> [Option<Vec<f64>>; 2] {
    let (starts, rows, values) = lower(matrix);
    let mut factor = Factor::new(&starts, &rows).expect("memory");
    let mut solve = |in_double: bool| {
        let mut vector = rhs.to_vec();
        let is_single = factor.compute(&values, 0.0, &[]) && !in_double;
        let is_definite = is_single || factor.compute_double();
        is_definite.then(|| factor.solve(&mut vector, EXACT))?;
        Some(vector)
    };
    [solve(false), solve(true)]
}

fn answer(matrix: &DMatrix<f64>, rhs: &[f64]) -> Option<Vec<f64>> {
    let [_, double] = answers(matrix, rhs);
    double
}

/// A symmetric matrix of which `density` percent differ from zero, with `diagonal` on the diagonal.
fn random(size: usize, density: u64, diagonal: f64, seed: &mut u64) -> DMatrix<f64> {
    let mut matrix = DMatrix::from_diagonal_element(size, size, diagonal);
    for column in 0..size {
        for row in column + 1..size {
            *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let bits = *seed >> 33;
            if bits % 100 < density {
                matrix[(row, column)] =
                    f64::from(u32::try_from(bits / 100 % 2001).unwrap_or(0)) / 1000.0 - 1.0;
                matrix[(column, row)] = matrix[(row, column)];
            }
        }
    }
    matrix
}

#[test]
fn random_matrices_as_by_nalgebra() {
    let mut seed = 1;
    let (mut definite, mut refused) = (0, 0);
    for size in [1, 2, 3, 7, 20, 50, 90, 150] {
        for density in [0, 2, 5, 10, 30, 100] {
            for diagonal in [0.5, 2.0, 5.0, 20.0] {
                let matrix = random(size, density, diagonal, &mut seed);
                let rhs = DVector::from_fn(size, |k, _| if k % 3 == 0 { 1.0 } else { -0.5 });
                let expected = matrix.clone().cholesky().map(|factor| factor.solve(&rhs));
                let solutions = answers(&matrix, rhs.as_slice());
                *(if expected.is_some() { &mut definite } else { &mut refused }) += 1;
                for (solution, accuracy) in solutions.into_iter().zip([1e-9, 1e-11]) {
                    assert_eq!(solution.is_some(), expected.is_some(), "{size}, {density} %, {diagonal}");
                    let Some((computed, expected)) = solution.zip(expected.as_ref()) else { continue };
                    let error = (DVector::from_vec(computed) - expected).norm() / expected.norm();
                    assert!(error < accuracy, "{size}, {density} %, {diagonal}: {error:e}");
                }
            }
        }
    }
    assert!(definite > 90 && refused > 30, "{definite} {refused}");
}

#[test]
fn whole_numbers_come_out_exactly() {
    // L L^T of the rows 2; 1 3; 0 2 1; 4 0 0 5.
    let numbers = [4.0, 2.0, 0.0, 8.0, 2.0, 10.0, 6.0, 4.0, 0.0, 6.0, 5.0, 0.0, 8.0, 4.0, 0.0, 41.0];
    let matrix = DMatrix::from_row_slice(4, 4, &numbers);
    let rhs = matrix.clone() * DVector::from_vec(vec![1.0, -2.0, 3.0, 4.0]);
    assert_eq!(answer(&matrix, rhs.as_slice()), Some(vec![1.0, -2.0, 3.0, 4.0]));
    assert_eq!(answer(&DMatrix::from_element(1, 1, 4.0), &[2.0]), Some(vec![0.5]));
    assert_eq!(answer(&DMatrix::zeros(0, 0), &[]), Some(vec![]));
}

#[test]
fn what_is_not_positive_definite_is_refused() {
    for bad in [0.0, -1.0, f64::NAN] {
        assert_eq!(answer(&DMatrix::from_element(1, 1, bad), &[1.0]), None);
    }
    let saddle = DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 1.0]);
    assert_eq!(answer(&saddle, &[1.0, 1.0]), None);
}

/// A matrix of which the least eigenvalue is about `eigenvalue`, and the others are near one.
fn nearly_singular(seed: &mut u64, eigenvalue: f64) -> DMatrix<f64> {
    let root = random(12, 100, 0.5, seed);
    let flat = DMatrix::from_fn(11, 12, |i, j| root[(i, j)]);
    flat.transpose() * flat + DMatrix::identity(12, 12) * eigenvalue
}

#[test]
fn double_precision_decides_where_single_precision_cannot() {
    let mut seed = 3;
    let (mut hidden, mut by_double) = (0, 0);
    for _ in 0..60 {
        for least in [1e-9, -1e-9] {
            let matrix = nearly_singular(&mut seed, least);
            let (starts, rows, values) = lower(&matrix);
            let mut factor = Factor::new(&starts, &rows).expect("memory");
            let is_definite = factor.compute(&values, 0.0, &[]) || factor.compute_double();
            hidden += u32::from(is_definite && least < 0.0);
            by_double += u32::from(factor.is_double);
            assert_eq!(is_definite && factor.is_confirmed(), least > 0.0, "{least:e}");
            if least > 0.0 {
                let expected = DVector::from_fn(12, |k, _| if k % 2 == 0 { 1.0 } else { -3.0 });
                let mut solution = (&matrix * &expected).as_slice().to_vec();
                factor.solve(&mut solution, EXACT);
                let error = DVector::from_vec(solution) - &expected;
                let energy = |x: &DVector<f64>| (&matrix * x).dot(x);
                assert!(
                    energy(&error) < 1e-18 * energy(&expected),
                    "{:e}",
                    energy(&error) / energy(&expected)
                );
            }
        }
    }
    assert!(hidden > 10 && by_double > 10, "{hidden} {by_double}");
}

#[test]
fn separate_columns_stay_separate_and_a_chain_becomes_one() {
    let supernodes = |matrix: &DMatrix<f64>| {
        let (starts, rows, _) = lower(matrix);
        Factor::new(&starts, &rows).map_or(0, |factor| factor.symbolic.supernodes.len())
    };
    assert_eq!(supernodes(&DMatrix::identity(6, 6)), 6);
    assert_eq!(supernodes(&DMatrix::from_fn(4, 4, |i, j| if i.abs_diff(j) < 2 { 1.0 } else { 0.0 })), 1);
    // An arrow: no column is like the last, and together they are too many zeros.
    let arrow = DMatrix::from_fn(99, 99, |i, j| if i == j || i.max(j) == 98 { 1.0 } else { 0.0 });
    assert!(supernodes(&arrow) > 80);
}

/// Five points on a grid of `side` by `side`, row by row.
fn laplacian(side: u32) -> (Vec<u32>, Vec<u32>, Vec<f64>) {
    let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
    for k in 0..side * side {
        let column = [(k, 4.0), (k + 1, -1.0), (k + side, -1.0)];
        let is_there = |row: u32| row < side * side && (row != k + 1 || !row.is_multiple_of(side));
        for (row, value) in column.into_iter().filter(|(row, _)| is_there(*row)) {
            rows.push(row);
            values.push(value);
        }
        starts.push(u32::try_from(rows.len()).unwrap_or(u32::MAX));
    }
    (starts, rows, values)
}

#[test]
fn one_analysis_serves_many_matrices() {
    let (starts, rows, values) = laplacian(40);
    let mut factor = Factor::new(&starts, &rows).expect("memory");
    let unit_diagonal = vec![1.0; 1600];
    let mut solved = |shift: f64| {
        let mut vector = unit_diagonal.clone();
        factor.compute(&values, shift, &unit_diagonal).then(|| {
            factor.solve(&mut vector, EXACT);
            vector
        })
    };
    let solution = solved(0.0).expect("positive definite");
    assert!(solved(-1.0).is_none());
    let shifted = solved(2.0).expect("positive definite");
    assert_eq!(solved(0.0), Some(solution.clone()));
    for (vector, diagonal) in [(solution, 4.0), (shifted, 6.0)] {
        let value_at = |row: usize, column: usize| vector[40 * row + column];
        for k in 0..1600 {
            let (i, j) = (k / 40, k % 40);
            let mut residual = 1.0 - diagonal * value_at(i, j);
            residual +=
                if i > 0 { value_at(i - 1, j) } else { 0.0 } + if i < 39 { value_at(i + 1, j) } else { 0.0 };
            residual +=
                if j > 0 { value_at(i, j - 1) } else { 0.0 } + if j < 39 { value_at(i, j + 1) } else { 0.0 };
            assert!(residual.abs() < 1e-9, "{k}: {residual:e}");
        }
    }
}

#[test]
fn a_kept_factor_serves_a_matrix_near_by_and_finds_that_one_is_indefinite() {
    let mut seed = 5;
    for size in [2, 30, 90] {
        let matrix = random(size, 10, 20.0, &mut seed);
        let growth = |i: usize| if i.is_multiple_of(2) { 1.0 } else { 1.02 };
        let perturbed =
            DMatrix::from_fn(size, size, |i, j| matrix[(i, j)] * if i == j { growth(i) } else { 1.0 });
        let expected = DVector::from_fn(size, |k, _| if k % 2 == 0 { 1.0 } else { -3.0 });
        let rhs = (&perturbed * &expected).as_slice().to_vec();
        let (starts, rows, values) = lower(&matrix);
        let mut factor = Factor::new(&starts, &rows).expect("memory");
        assert!(!factor.keep_for(&values), "there is none yet");
        assert!(factor.compute(&values, 0.0, &[]) && factor.keep_for(&lower(&perturbed).2));
        let mut solution = rhs.clone();
        assert!(factor.solve_within(10, &mut solution, EXACT) && factor.residual() < 1e-6);
        assert!((DVector::from_vec(solution) - &expected).amax() < 1e-8);
        assert!(!factor.solve_within(1, &mut rhs.clone(), EXACT) && factor.is_confirmed());
        let indefinite = DMatrix::from_fn(size, size, |i, j| if i + j == 0 { -1.0 } else { matrix[(i, j)] });
        assert!(factor.keep_for(&lower(&indefinite).2) && !factor.is_confirmed());
        assert!(factor.compute(&values, 1.0, &vec![1.0; size]) && !factor.keep_for(&values), "shifted");
    }
}

/// The cells of a block of a grid, each half before the cells that part it from the other one.
fn dissected(cells: &mut Vec<[u32; 2]>, [left, right]: [u32; 2], [low, high]: [u32; 2]) {
    if left >= right || low >= high {
        return;
    }
    let (middle, is_wide) =
        if right - left > high - low { (left.midpoint(right), true) } else { (low.midpoint(high), false) };
    if is_wide {
        dissected(cells, [left, middle], [low, high]);
        dissected(cells, [middle + 1, right], [low, high]);
        cells.extend((low..high).map(|y| [middle, y]));
    } else {
        dissected(cells, [left, right], [low, middle]);
        dissected(cells, [left, right], [middle + 1, high]);
        cells.extend((left..right).map(|x| [x, middle]));
    }
}

/// Nine points on a grid, in an order in which its elimination tree has many branches, and the diagonal of its last corner.
fn branched(side: u32, last: f64) -> (Vec<u32>, Vec<u32>, Vec<f64>) {
    let mut cells = Vec::new();
    dissected(&mut cells, [0, side], [0, side]);
    let mut ranks = vec![0; cells.len()];
    for (rank, [x, y]) in (0_u32..).zip(&cells) {
        ranks[(side * y + x) as usize] = rank;
    }
    let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
    for (rank, &[x, y]) in (0_u32..).zip(&cells) {
        let neighbours = |at: u32| at.saturating_sub(1)..side.min(at + 2);
        let mut column: Vec<u32> = neighbours(y)
            .flat_map(|y| neighbours(x).map(move |x| side * y + x))
            .map(|cell| ranks[cell as usize])
            .collect();
        column.retain(|&row| row >= rank);
        column.sort_unstable();
        let diagonal = if [x, y] == [side - 1, side - 1] { last } else { 8.5 };
        values.extend(column.iter().map(|&row| if row == rank { diagonal } else { -1.0 }));
        rows.append(&mut column);
        starts.push(u32::try_from(rows.len()).unwrap_or(u32::MAX));
    }
    (starts, rows, values)
}

#[test]
fn subtrees_give_the_same_bits_on_one_thread_and_on_all() {
    // A matrix with branches is factored and solved in both precisions, on all threads and in a pool of one. The bits
    // are equal, the solutions right, and an indefinite matrix leaves nothing behind.
    let side = 150;
    let (starts, rows, values) = branched(side, 8.5);
    let expected: Vec<f64> = (0..side * side).map(|k| f64::from(k % 7) - 2.0).collect();
    let matrix = Matrix {
        lower: Lists {
            starts: starts.iter().map(|start| *start as usize).collect(),
            items: rows.iter().map(|row| *row as usize).collect(),
        },
        values: values.clone(),
    };
    let mut rhs = expected.clone();
    matrix.times(&expected, &mut rhs);
    let solve = || {
        let mut factor = Factor::new(&starts, &rows).expect("memory");
        let parts = &factor.symbolic.whole.parts;
        assert!(parts.len() > 1 && parts.iter().any(|part| !part.parts.is_empty()), "{parts:?}");
        let single = {
            let mut single = rhs.clone();
            assert!(factor.compute(&values, 0.0, &[]));
            factor.solve(&mut single, EXACT);
            single
        };
        let mut double = rhs.clone();
        assert!(factor.compute_double());
        factor.solve(&mut double, EXACT);
        (single, double)
    };
    let (single, double) = solve();
    for (solution, accuracy) in [(&single, 1e-9), (&double, 1e-12)] {
        let worst = solution.iter().zip(&expected).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        assert!(worst < accuracy, "{worst:e}");
    }
    // In a pool each computation has one thread.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
    assert_eq!(pool.install(|| (Threads::available(), solve())), (Threads::One, (single, double)));
    assert_eq!(Threads::available(), Threads::All);
    let (_, _, indefinite) = branched(side, -1.0);
    let mut factor = Factor::new(&starts, &rows).expect("memory");
    assert!(!factor.compute(&indefinite, 0.0, &[]) && !factor.compute_double());
    assert!(factor.compute(&values, 0.0, &[]), "nothing is left of the attempt");
}
