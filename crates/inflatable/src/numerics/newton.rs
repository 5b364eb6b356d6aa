//! Damped Newton iteration for small dense systems.

use nalgebra::{Const, DimMin, SMatrix, SVector};

/// Reason for a Newton iteration without a root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NewtonFault {
    /// The Jacobian is singular at an iterate.
    Singular,
    /// No fraction of the step brings the residual down, or leads to a point where it is defined.
    Stalled {
        /// Largest residual at the last iterate.
        residual: f64,
    },
    /// The iterations were used up.
    Exhausted {
        /// Largest residual at the last iterate.
        residual: f64,
    },
}

/// A root and how it was reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewtonReport<const N: usize> {
    /// The root.
    pub point: [f64; N],
    /// Largest residual there.
    pub residual: f64,
    /// Newton steps taken.
    pub iterations: u32,
}

/// Steps allowed. Quadratic convergence needs four to six from a fair start, damping some more.
const MOST_ITERATIONS: u32 = 60;
/// Halvings of a step before it is given up: 2^-20 of a Newton step cannot help any more.
const MOST_HALVINGS: u32 = 20;

/// Solves `system(x) = 0` from `start`; the system gives residuals and Jacobian rows, or `None` where it is not defined.
///
/// Residuals and unknowns should be scaled to order one. The iteration ends when all residuals are
/// at most `tolerance`; one more step is then taken if it still reduces the residual.
///
/// # Errors
/// See [`NewtonFault`].
pub fn newton<const N: usize>(
    start: [f64; N],
    tolerance: f64,
    mut system: impl FnMut([f64; N]) -> Option<([f64; N], [[f64; N]; N])>,
) -> Result<NewtonReport<N>, NewtonFault>
where
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    let defined = |(residuals, jacobian): &([f64; N], [[f64; N]; N])| {
        residuals.iter().chain(jacobian.iter().flatten()).all(|x| x.is_finite())
    };
    let mut point = start;
    let mut current = system(point).filter(defined).ok_or(NewtonFault::Stalled { residual: f64::MAX })?;
    for iterations in 1..=MOST_ITERATIONS {
        let size = largest(&current.0);
        let matrix = SMatrix::<f64, N, N>::from_fn(|row, column| current.1[row][column]);
        let Some(step) = solve_dense(matrix, &SVector::from(current.0)) else {
            return if size <= tolerance {
                Ok(NewtonReport { point, residual: size, iterations: iterations - 1 })
            } else {
                Err(NewtonFault::Singular)
            };
        };
        let mut fraction = 1.0;
        let mut accepted = None;
        for _ in 0..MOST_HALVINGS {
            let trial: [f64; N] = std::array::from_fn(|i| point[i] - fraction * step[i]);
            if let Some(next) = system(trial).filter(defined)
                && largest(&next.0) < (1.0 - 0.1 * fraction) * size
            {
                accepted = Some((trial, next));
                break;
            }
            if size <= tolerance {
                break;
            }
            fraction *= 0.5;
        }
        match accepted {
            Some((trial, next)) => (point, current) = (trial, next),
            None if size <= tolerance => {
                return Ok(NewtonReport { point, residual: size, iterations });
            }
            None => return Err(NewtonFault::Stalled { residual: size }),
        }
        let residual = largest(&current.0);
        if residual <= 0.1 * tolerance {
            return Ok(NewtonReport { point, residual, iterations });
        }
    }
    Err(NewtonFault::Exhausted { residual: largest(&current.0) })
}

/// Solution of `matrix x = right`; `None` if the matrix is singular or the solution not finite.
///
/// By LU with partial pivoting.
pub fn solve_dense<const N: usize>(
    matrix: SMatrix<f64, N, N>,
    right: &SVector<f64, N>,
) -> Option<SVector<f64, N>>
where
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    matrix.lu().solve(right).filter(|x| x.iter().all(|x| x.is_finite()))
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| most.max(value.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn circle_and_line([x, y]: [f64; 2]) -> ([f64; 2], [[f64; 2]; 2]) {
        ([x * x + y * y - 4.0, x - y], [[2.0 * x, 2.0 * y], [1.0, -1.0]])
    }

    #[test]
    fn finds_a_root_to_rounding() {
        let report = newton([3.0, 0.5], 1e-13, |x| Some(circle_and_line(x))).expect("has a root");
        assert!((report.point[0] - 2.0_f64.sqrt()).abs() < 1e-14);
        assert!(report.residual <= 1e-13 && report.iterations < 10);
    }

    #[test]
    fn damps_a_step_out_of_the_domain() {
        // ln x: a full Newton step from 10 leads below 0, where the system is not defined.
        let report = newton([10.0], 1e-13, |[x]| (x > 0.0).then(|| ([x.ln()], [[1.0 / x]])));
        assert!((report.expect("has a root").point[0] - 1.0).abs() < 1e-13);
    }

    #[test]
    fn says_why_it_fails() {
        let no_root = newton([1.0], 1e-12, |[x]| Some(([x * x + 1.0], [[2.0 * x]])));
        assert!(matches!(no_root, Err(NewtonFault::Stalled { .. } | NewtonFault::Singular)), "{no_root:?}");
        let undefined = newton([1.0], 1e-12, |_| None);
        assert!(matches!(undefined, Err(NewtonFault::Stalled { .. })));
        let nan = newton([1.0], 1e-12, |_| Some(([f64::NAN], [[1.0]])));
        assert!(matches!(nan, Err(NewtonFault::Stalled { .. })));
    }
}
