//! Two-point boundary-value problems by collocation, with residual control and mesh refinement.
//!
//! The solution of `y' = f(x, y)` is a cubic on each interval of a mesh that satisfies the equation at both
//! ends and in the middle (three-point Lobatto); its error is of fourth order in the interval.
//! With the left conditions first and the right ones last, Newton's matrix is a narrow band:
//!
//! ```text
//! [ left                ]
//! [ A0  B0              ]
//! [     A1  B1          ]
//! [         ...  ...    ]
//! [               right ]
//! ```
//!
//! After each solution the **residual** of the cubics, `y' - f`, relative to `1 + |f|`, is measured between
//! the collocation points; intervals above the tolerance are split, needlessly short ones merged.
//!
//! Method after Kierzenka and Shampine, "A BVP solver based on residual control and the MATLAB PSE", ACM TOMS
//! 27 (2001), with separated conditions and a banded instead of a general sparse solver.

mod refine;
#[cfg(test)]
mod tests;

use self::refine::{remesh, residuals};
use crate::numerics::band::{Banded, Factors};

/// A system of `N` equations with conditions that fix some components at the ends.
pub trait Problem<const N: usize> {
    /// The right-hand side f(x, y).
    fn slope(&self, x: f64, y: &[f64; N]) -> [f64; N];
    /// Jacobian of the right side: row by row, by component of y.
    fn jacobian(&self, x: f64, y: &[f64; N]) -> [[f64; N]; N];
    /// Components fixed at the left end, with their values.
    fn values_at_left(&self) -> &[(usize, f64)];
    /// Components fixed at the right end, with their values; `N` together with the left ones.
    fn right(&self) -> &[(usize, f64)];
}

/// Reason for a missing solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CollocationFault {
    /// Newton's matrix is singular or not finite.
    Singular,
    /// Newton's iteration does not come closer.
    Diverged,
    /// More intervals than allowed would be needed; the largest relative residual reached.
    TooFine {
        /// Largest relative residual.
        residual: f64,
    },
}

/// A mesh and the solution at its nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile<const N: usize> {
    /// The nodes, rising.
    pub mesh: Vec<f64>,
    /// The solution there.
    pub values: Vec<[f64; N]>,
}

/// A solution with its evidence.
#[derive(Clone, Debug)]
pub struct Solution<const N: usize> {
    /// Mesh and values.
    pub profile: Profile<N>,
    /// Largest relative residual between the collocation points.
    pub residual: f64,
    /// Newton steps, all meshes together.
    pub iterations: u32,
    /// Factors of Newton's matrix at the solution.
    factors: Factors,
}

/// Newton steps on one mesh: from a fair start 4 to 6 are needed; more means that there is no fair start.
const MOST_STEPS: u32 = 25;
/// Newton ends when the scaled step is below this; the next one would be its square.
const STEP_TOLERANCE: f64 = 1e-8;

/// Solves `problem` from `start` to the relative residual `tolerance`, with at most `max_intervals` intervals.
///
/// # Errors
/// See [`CollocationFault`].
pub fn solve<const N: usize>(
    problem: &impl Problem<N>,
    start: Profile<N>,
    tolerance: f64,
    max_intervals: usize,
) -> Result<Solution<N>, CollocationFault> {
    let mut profile = start;
    let mut iterations = 0;
    loop {
        let factors = newton(problem, &mut profile, &mut iterations)?;
        let interval_residuals = residuals(problem, &profile);
        let residual = interval_residuals.iter().copied().fold(0.0, f64::max);
        if residual <= tolerance {
            return Ok(Solution { profile, residual, iterations, factors });
        }
        profile = remesh(problem, &profile, &interval_residuals, tolerance);
        if profile.mesh.len() > max_intervals + 1 {
            return Err(CollocationFault::TooFine { residual });
        }
    }
}

/// Solves on the mesh of `start` as it is; for studies of convergence.
///
/// # Errors
/// See [`CollocationFault`].
#[cfg(test)]
pub fn solve_on_mesh<const N: usize>(
    problem: &impl Problem<N>,
    start: Profile<N>,
) -> Result<Solution<N>, CollocationFault> {
    solve(problem, start, f64::INFINITY, usize::MAX - 1)
}

impl<const N: usize> Profile<N> {
    /// The middle of interval `i` by the cubic with the given slopes at its ends.
    fn middle(&self, i: usize, f0: &[f64; N], f1: &[f64; N]) -> [f64; N] {
        let h = self.mesh[i + 1] - self.mesh[i];
        std::array::from_fn(|k| {
            0.5 * (self.values[i][k] + self.values[i + 1][k]) - 0.125 * h * (f1[k] - f0[k])
        })
    }

    /// The slope of the solution at the mesh point `index`.
    fn slope(&self, problem: &impl Problem<N>, index: usize) -> [f64; N] {
        problem.slope(self.mesh[index], &self.values[index])
    }

    /// This profile with every interval halved.
    pub fn halved(&self, problem: &impl Problem<N>) -> Self {
        let mut finer = Self { mesh: vec![self.mesh[0]], values: vec![self.values[0]] };
        for i in 0..self.mesh.len() - 1 {
            finer.mesh.extend([0.5 * (self.mesh[i] + self.mesh[i + 1]), self.mesh[i + 1]]);
            finer.values.extend([
                self.middle(i, &self.slope(problem, i), &self.slope(problem, i + 1)),
                self.values[i + 1],
            ]);
        }
        finer
    }

    /// `∫ g dx` by Simpson's rule on each interval, with the middle from the cubic: fourth order, as the solution.
    pub fn integral(&self, problem: &impl Problem<N>, g: impl Fn(f64, &[f64; N]) -> f64) -> f64 {
        let slopes: Vec<[f64; N]> =
            self.mesh.iter().zip(&self.values).map(|(&x, y)| problem.slope(x, y)).collect();
        (0..self.mesh.len() - 1)
            .map(|i| {
                let (a, b) = (self.mesh[i], self.mesh[i + 1]);
                let middle = self.middle(i, &slopes[i], &slopes[i + 1]);
                let ends = g(a, &self.values[i]) + g(b, &self.values[i + 1]);
                (b - a) / 6.0 * (ends + 4.0 * g(0.5 * (a + b), &middle))
            })
            .sum()
    }
}

impl<const N: usize> Solution<N> {
    /// Derivatives of the solution's nodes by a parameter, from the right-hand side's derivative with respect to it.
    pub fn sensitivity(
        &self,
        problem: &impl Problem<N>,
        by_parameter: impl Fn(f64, &[f64; N]) -> [f64; N],
    ) -> Vec<[f64; N]> {
        let Profile { mesh, values } = &self.profile;
        let mut right = vec![0.0; N * mesh.len()];
        let first = problem.values_at_left().len();
        for i in 0..mesh.len() - 1 {
            let h = mesh[i + 1] - mesh[i];
            let xm = 0.5 * (mesh[i] + mesh[i + 1]);
            let ym =
                self.profile.middle(i, &self.profile.slope(problem, i), &self.profile.slope(problem, i + 1));
            let (p0, p1) = (by_parameter(mesh[i], &values[i]), by_parameter(mesh[i + 1], &values[i + 1]));
            let (pm, jm) = (by_parameter(xm, &ym), problem.jacobian(xm, &ym));
            for row in 0..N {
                let shift: f64 = (0..N).map(|k| jm[row][k] * (-0.125 * h) * (p1[k] - p0[k])).sum();
                right[first + N * i + row] = h / 6.0 * (p0[row] + p1[row] + 4.0 * (pm[row] + shift));
            }
        }
        self.factors.solve(&mut right);
        right.chunks_exact(N).map(|chunk| std::array::from_fn(|k| chunk[k])).collect()
    }
}

/// Newton's iteration on one mesh, damped by the natural monotonicity test: the step that the old matrix
/// gives at the new point must be shorter.
fn newton<const N: usize>(
    problem: &impl Problem<N>,
    profile: &mut Profile<N>,
    iterations: &mut u32,
) -> Result<Factors, CollocationFault> {
    let mut rest = defects(problem, profile).ok_or(CollocationFault::Diverged)?;
    for _ in 0..MOST_STEPS {
        let factors = matrix(problem, profile).factor().ok_or(CollocationFault::Singular)?;
        *iterations += 1;
        factors.solve(&mut rest);
        let size = scaled(&rest, profile);
        if !size.is_finite() {
            return Err(CollocationFault::Diverged);
        }
        let mut fraction = 1.0;
        loop {
            let trial = moved(profile, &rest, fraction);
            if let Some(mut next) = defects(problem, &trial) {
                let raw = next.clone();
                factors.solve(&mut next);
                if scaled(&next, &trial) <= (1.0 - 0.25 * fraction) * size || size <= STEP_TOLERANCE {
                    *profile = trial;
                    rest = raw;
                    break;
                }
            }
            fraction *= 0.5;
            if fraction < 1e-3 {
                return Err(CollocationFault::Diverged);
            }
        }
        if fraction == 1.0 && size <= STEP_TOLERANCE {
            return Ok(factors);
        }
    }
    Err(CollocationFault::Diverged)
}

fn moved<const N: usize>(profile: &Profile<N>, step: &[f64], fraction: f64) -> Profile<N> {
    let mut moved = profile.clone();
    for (value, change) in moved.values.iter_mut().flatten().zip(step) {
        *value -= fraction * change;
    }
    moved
}

/// Largest change relative to `1 + |y|`.
fn scaled<const N: usize>(step: &[f64], profile: &Profile<N>) -> f64 {
    let sizes = step.iter().zip(profile.values.iter().flatten()).map(|(d, y)| d.abs() / (1.0 + y.abs()));
    // `f64::max` would drop a NaN.
    sizes.fold(0.0, |most: f64, size| if size > most || size.is_nan() { size } else { most })
}

/// Defects of conditions and collocation equations; `None` if they are not finite.
fn defects<const N: usize>(problem: &impl Problem<N>, profile: &Profile<N>) -> Option<Vec<f64>> {
    let Profile { mesh, values } = profile;
    let mut defects = Vec::with_capacity(N * mesh.len());
    defects.extend(problem.values_at_left().iter().map(|&(k, fixed)| values[0][k] - fixed));
    let mut f0 = problem.slope(mesh[0], &values[0]);
    for i in 0..mesh.len() - 1 {
        let (a, b) = (mesh[i], mesh[i + 1]);
        let f1 = problem.slope(b, &values[i + 1]);
        let fm = problem.slope(0.5 * (a + b), &profile.middle(i, &f0, &f1));
        let rows =
            (0..N).map(|k| values[i + 1][k] - values[i][k] - (b - a) / 6.0 * (f0[k] + f1[k] + 4.0 * fm[k]));
        defects.extend(rows);
        f0 = f1;
    }
    let last = values[values.len() - 1];
    defects.extend(problem.right().iter().map(|&(k, fixed)| last[k] - fixed));
    defects.iter().all(|d| d.is_finite()).then_some(defects)
}

/// Newton's matrix, the derivative of [`defects`].
fn matrix<const N: usize>(problem: &impl Problem<N>, profile: &Profile<N>) -> Banded {
    // The boundary conditions of the left end come first, those of the right end last. Between them stands a block of
    // N rows for each interval, with its derivatives by the values at both of its ends. The value in the interval's
    // middle depends on both ends, which the chain rule accounts for.
    let Profile { mesh, values } = profile;
    let first = problem.values_at_left().len();
    let mut matrix = Banded::zero(N * mesh.len(), first + N - 1, 2 * N - 1 - first);
    for (row, &(k, _)) in problem.values_at_left().iter().enumerate() {
        matrix.set(row, k, 1.0);
    }
    let mut f0 = problem.slope(mesh[0], &values[0]);
    let mut j0 = problem.jacobian(mesh[0], &values[0]);
    for i in 0..mesh.len() - 1 {
        let (a, b) = (mesh[i], mesh[i + 1]);
        let h = b - a;
        let (f1, j1) = (problem.slope(b, &values[i + 1]), problem.jacobian(b, &values[i + 1]));
        let jm = problem.jacobian(0.5 * (a + b), &profile.middle(i, &f0, &f1));
        for row in 0..N {
            for column in 0..N {
                let chain = |j: &[[f64; N]; N]| (0..N).map(|k| jm[row][k] * j[k][column]).sum::<f64>();
                let unit = if row == column { 1.0 } else { 0.0 };
                let by_a = -unit - h / 6.0 * (j0[row][column] + 2.0 * jm[row][column] + 0.5 * h * chain(&j0));
                let by_b = unit - h / 6.0 * (j1[row][column] + 2.0 * jm[row][column] - 0.5 * h * chain(&j1));
                matrix.set(first + N * i + row, N * i + column, by_a);
                matrix.set(first + N * i + row, N * (i + 1) + column, by_b);
            }
        }
        (f0, j0) = (f1, j1);
    }
    let last = mesh.len() - 1;
    for (row, &(k, _)) in problem.right().iter().enumerate() {
        matrix.set(first + N * last + row, N * last + k, 1.0);
    }
    matrix
}
