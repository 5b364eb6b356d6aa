//! A linear function of the points that is held at a value, and the multiplier that holds it.
//!
//! Where the sheet alone would snap, its Hessian H has one negative eigenvalue, and no Cholesky factor. A **brace**, a
//! stiff spring s on one point along e, makes A = H + s e e^T positive definite, and Sherman and Morrison take it back out:
//! H^-1 v = A^-1 v + s (e.A^-1 v)/(1 - s e.A^-1 e) A^-1 e. H has as many negative eigenvalues as 1 - s e.A^-1 e, none or
//! one, and is positive definite under the constraint c if c.H^-1 c has the sign of that.

use crate::numerics;
use crate::shell::assembly::Assembly;
use crate::shell::element::vector::{Vector, dot, times};
use crate::shell::solver::factor::{EXACT, Factor};

/// Constraint on a linear function of the unknowns.
#[derive(Clone, Debug)]
pub struct DisplacementControl {
    /// c, by the unknowns.
    pub row: Vec<f64>,
    /// The point that is braced.
    pub point: usize,
    /// e, of length 1.
    pub direction: [f64; 3],
    /// s.
    pub brace: f64,
}

/// The solves of one step.
#[derive(Clone, Debug, Default)]
pub(crate) struct ControlledSolve {
    /// H^-1 c.
    pub(crate) answer: Vec<f64>,
    /// c.H^-1 c.
    pub(crate) gives: f64,
    braced: Vec<f64>,
    /// s/(1 - s e.A^-1 e).
    taken_back: f64,
}

impl DisplacementControl {
    /// Adds the brace to the assembled Hessian.
    pub(crate) fn add(&self, assembly: &mut Assembly) {
        let (e, s) = (self.direction, self.brace);
        assembly.add_at_point(self.point, [0.0; 3], |v: Vector| times(s * dot(e, v), e));
    }

    /// The solves with A's factor that each step needs; `None` where the sheet is not stable even held.
    pub(crate) fn hold(&self, assembly: &Assembly, factor: &mut Factor) -> Option<ControlledSolve> {
        let brace = assembly.project(&[(self.point, self.direction)]);
        let mut solve =
            ControlledSolve { braced: brace.clone(), answer: self.row.clone(), ..ControlledSolve::default() };
        factor.solve(&mut solve.braced, EXACT);
        factor.solve(&mut solve.answer, EXACT);
        let remainder = 1.0 - self.brace * numerics::dot(&brace, &solve.braced);
        solve.taken_back = self.brace / remainder;
        let back = solve.taken_back * numerics::dot(&brace, &solve.answer);
        solve.answer.iter_mut().zip(&solve.braced).for_each(|(answer, braced)| *answer += back * braced);
        solve.gives = numerics::dot(&self.row, &solve.answer);
        (solve.gives * remainder > 0.0).then_some(solve)
    }

    /// Turns A^-1 v, in `vector`, into H^-1 v without the component that the constraint forbids.
    pub(crate) fn constrain(&self, assembly: &Assembly, control: &ControlledSolve, vector: &mut [f64]) {
        let brace = assembly.project(&[(self.point, self.direction)]);
        let back = control.taken_back * numerics::dot(&brace, vector);
        vector.iter_mut().zip(&control.braced).for_each(|(x, braced)| *x += back * braced);
        let multiplier = numerics::dot(&self.row, vector) / control.gives;
        vector.iter_mut().zip(&control.answer).for_each(|(x, answer)| *x -= multiplier * answer);
    }
}
